/// The eigenvalue problems of undamped vibration: engine/statics/README.md, "Modes".
#pragma once

#include <cstddef>
#include <vector>

#include "statics/block_tridiagonal.hpp"
#include "statics/mode_shape.hpp"
#include "statics/vibration_matrices.hpp"

namespace drillstrand {

/// A natural frequency (rad/s) and its motion.
struct FreeVibration {
    double frequency;
    ComplexMotion motion;
};

/// Free vibrations of matrices whose damping is left out. Keeps a reference to them.
class FreeVibrations {
  public:
    /// Throws SimulationError where the stiffness is not that of a stable state.
    explicit FreeVibrations(const VibrationMatrices& matrices);

    /// The lowest `count` of a string that turns at that rate (rad/s): of K - w^2 M + i w W G.
    [[nodiscard]] std::vector<FreeVibration> at(double rotation_rate, std::size_t count) const;

    /// The lowest `count` of a string that turns at 1/order of each frequency: of
    /// K - w^2 (M - i G/order).
    [[nodiscard]] std::vector<FreeVibration> critical(double order, std::size_t count) const;

    /// How many of these there are below a frequency (rad/s).
    [[nodiscard]] std::size_t count_critical(double order, double frequency) const;

  private:
    [[nodiscard]] std::vector<FreeVibration> at_rest(std::size_t count) const;
    [[nodiscard]] std::vector<FreeVibration> turning(double rotation_rate, std::size_t count) const;
    /// Number of negative eigenvalues of K - w^2 M + i w W G.
    [[nodiscard]] std::size_t count_below(double frequency, double rotation_rate) const;

    const VibrationMatrices& matrices_;
    double lift_;                 ///< s: K + s M is positive definite (1/s2)
    BlockTridiagonal stiffness_;  ///< K + s M
    BlockFactors factors_;        ///< of it
};

}  // namespace drillstrand
