/// The strand equations under a stiff integrator that this project has not written: ARKODE of
/// SUNDIALS, diagonally implicit Runge-Kutta with adaptive step. For comparison only.
///
/// The right-hand side is the engine's own (rod/strand.hpp), kernels and all. Each stage is solved
/// by Newton's method with GMRES; its preconditioner is the band of the Jacobian that stays when
/// the pose of the string is held, which leaves segments and nodes coupled to their neighbours
/// alone. Friction springs and arcs are held during a step and follow it, as in `dormand-prince`.
#pragma once

#include <cstdint>
#include <memory>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand::bench {

class ArkodeStrand {
  public:
    /// `order` 2 to 5: SUNDIALS' default tableau of that order. Errors are held below `tolerance`
    /// times the sum of a number's size and the typical size of its kind. The head must be driven.
    /// The scene must outlive this object.
    ArkodeStrand(const Scene& scene, double tolerance, int order);
    ArkodeStrand(const ArkodeStrand&) = delete;
    ArkodeStrand& operator=(const ArkodeStrand&) = delete;
    ~ArkodeStrand();

    /// Advances until `end` is reached exactly. Throws std::runtime_error where ARKODE gives up.
    void advance(double end);

    /// Positions of the nodes and stresses of the segments; the rest is left empty.
    [[nodiscard]] Profile profile() const;
    /// Evaluations include those for the Jacobian and its products.
    [[nodiscard]] StepStatistics statistics() const;

  private:
    struct Solver;
    std::unique_ptr<Solver> solver_;
};

}  // namespace drillstrand::bench
