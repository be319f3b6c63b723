/// What answers to small motions of a string about its static state: stiffness, inertia, gyroscopic
/// couples and damping of its nodes. Equations: engine/statics/README.md, "Modes".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drillstrand/modes.hpp"
#include "drillstrand/scene.hpp"
#include "statics/balance.hpp"
#include "statics/block_tridiagonal.hpp"
#include "statics/rod_state.hpp"

namespace drillstrand {

/// M u'' + (C + W G) u' + (K - W S) u = f, with u the displacement (m) and turn (rad, space frame)
/// of each node that moves, and W the rate at which the string turns about itself (rad/s).
struct VibrationMatrices {
    explicit VibrationMatrices(std::size_t rows)
        : stiffness(rows),
          mass(rows, Matrix6::Zero()),
          gyroscopic(rows, Matrix6::Zero()),
          damping(rows),
          carried_round(rows) {}

    BlockTridiagonal stiffness;       ///< K, symmetric
    std::vector<Matrix6> mass;        ///< M
    std::vector<Matrix6> gyroscopic;  ///< G, skew
    BlockTridiagonal damping;         ///< C, symmetric
    BlockTridiagonal carried_round;   ///< S, skew: internal damping, of a section that turns

    /// The wall's share of K at each node of the string, head included; 0 in the open hole.
    std::vector<Matrix6> walls;
    /// How hard the wall presses there in the static state (N); without end where what touches is
    /// as wide as the hole, and cannot leave it.
    std::vector<double> pressing;

    [[nodiscard]] std::size_t rows() const { return mass.size(); }
    /// K - w^2 M + i w (C + W G) - W S, what a motion with exp(i w t) meets.
    [[nodiscard]] ComplexBlockTridiagonal dynamic_stiffness(double frequency,
                                                            double rotation_rate) const;
};

/// `balance` is that of the static state; friction in it is held as dead forces from now on.
VibrationMatrices vibration_matrices(const Scene& scene, Balance& balance, const RodState& state,
                                     WallGrip grip);

}  // namespace drillstrand
