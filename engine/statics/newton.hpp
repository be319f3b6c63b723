/// Newton's method on the balance of forces, made global in two ways:
/// engine/statics/README.md, "Search".
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "drillstrand/scene.hpp"
#include "statics/balance.hpp"
#include "statics/block_tridiagonal.hpp"
#include "statics/rod_state.hpp"

namespace drillstrand {

enum class SearchOutcome {
    converged,
    saddle,  ///< in balance, but not stable
    failed
};

class Newton {
  public:
    /// `budget`: iterations of all searches together.
    Newton(const Scene& scene, Balance& balance, int budget);

    /// Goes downhill in energy, held back by a bed of springs across the string that is taken away
    /// as steps succeed. `bed`: its stiffness at the start, in units of its own; 0: none.
    SearchOutcome descend(RodState& state, double bed);

    /// Newton's method with steps damped until the corrections shrink. Finds any equilibrium,
    /// stable or not, with loads of any kind. Leaves `state` alone where it fails.
    SearchOutcome follow(RodState& state);

    /// Pushes a state that is not stable along the motion that lowers its energy most.
    void leave_saddle(RodState& state);

    /// Factors of the stiffness at a state.
    [[nodiscard]] BlockFactors factors(const RodState& state);

    [[nodiscard]] int iterations() const { return iterations_; }
    /// Between the pipe and the hole at a node's place in the beginning (m).
    [[nodiscard]] double clearance(std::size_t node) const { return span_[node - first_]; }

  private:
    enum class Verdict { not_firm, too_far, uphill, taken };
    struct Downhill {
        Verdict verdict = Verdict::not_firm;
        double far = 0;                                         ///< reach of the whole step
        std::optional<RodState> state;                          ///< after the step
        Imbalance imbalance;                                    ///< there
        double size = std::numeric_limits<double>::infinity();  ///< of the whole step
        bool is_small = false;
        bool is_as_predicted = false;
    };
    /// What a motion does, to first and second order, with the bed.
    struct Work {
        double force;  ///< of the forces out of balance (J)
        double bed;    ///< twice the energy in the bed (J)
    };
    [[nodiscard]] Downhill downhill(const RodState& state, const Imbalance& now, double bed) const;
    void take(Downhill& step, const RodState& state, const Imbalance& now, const NodeMotion& motion,
              const Work& done, double scale) const;
    static double harder(const Downhill& step);

    struct Correction {
        RodState state;
        Imbalance imbalance;
        bool is_small;
    };
    std::optional<Correction> corrected(const RodState& state, const Imbalance& now);
    NodeMotion softest_motion(const RodState& state);

    [[nodiscard]] BlockFactors factors_on_bed(double bed) const;
    [[nodiscard]] RodState stepped(const RodState& state, const NodeMotion& motion,
                                   double scale) const;
    [[nodiscard]] double reach(const NodeMotion& motion) const;
    [[nodiscard]] double size(const NodeMotion& motion) const;
    [[nodiscard]] Work work(const NodeMotion& force, const NodeMotion& motion, double bed) const;
    [[nodiscard]] bool is_spent() const { return iterations_ >= budget_; }

    const Scene& scene_;
    Balance& balance_;
    int budget_;
    int iterations_ = 0;
    StepRule rule_;
    std::size_t first_;  ///< node that moves
    BlockTridiagonal stiffness_;
    // per node that moves
    std::vector<Eigen::Matrix3d> across_;  ///< projection on what the bed holds
    std::vector<double> firmness_;         ///< of the bed of unit strength (N/m)
    std::vector<double> turning_;          ///< its stiffness against turns, per firmness (m2)
    std::vector<double> span_;             ///< length to compare displacements with (m)
};

}  // namespace drillstrand
