/// Substeps of the leapfrog where segments are shorter than its step allows: engine/rod/README.md,
/// "Substeps".
#pragma once

#include <cstddef>
#include <vector>

#include "drillstrand/scene.hpp"
#include "drillstrand/step_bound.hpp"
#include "numerics/block_table.hpp"
#include "rod/director.hpp"
#include "rod/substep_polynomial.hpp"
#include "rod/substep_rounds.hpp"

namespace drillstrand {

/// The fine stretches of a string in the layout of the step loop. Their rounds are reckoned in
/// numbers of type Real.
template <class Real>
class SubstepsOf {
  public:
    /// What a step writes of one stretch before it reads it, and the polynomial of the last step:
    /// of each thread its own.
    struct Work {
        BlockTable lines;
        SubstepRounds<Real> rounds;
        double step = 0;  ///< that the polynomial is for (s)
        SubstepPolynomial polynomial{1};
    };

    SubstepsOf() = default;
    explicit SubstepsOf(const Scene& scene);

    [[nodiscard]] std::size_t count() const { return constants_.size(); }
    [[nodiscard]] bool empty() const { return constants_.empty(); }
    [[nodiscard]] const StepPlan& plan() const { return plan_; }
    /// First and last node of a stretch.
    [[nodiscard]] std::size_t first_node(std::size_t i) const { return plan_.stretches[i].first; }
    [[nodiscard]] std::size_t last_node(std::size_t i) const { return plan_.stretches[i].end; }
    /// Substeps of a stretch in a step (s); 1 where it needs none.
    [[nodiscard]] int substeps(std::size_t i, double step) const;
    [[nodiscard]] Work work_for(std::size_t i) const;

    /// Changes what the segments of a stretch hand to its nodes: from their forces at the whole
    /// step to the mean of their forces over the substeps, in which the nodes of the stretch move
    /// from rest under the forces of all segments around them and of the wall. `segments` must be
    /// up to date from the one before the stretch to the one behind it, ends included.
    void average(const DirectorModel& model, const Table<DirectorRow>& rod, Table<WallRow>& wall,
                 std::size_t i, double step, Work& work, Table<SegmentRow>& segments) const;

    /// Gives the impulses of surroundings and damping, which director_nodes() has given to single
    /// nodes of `next`, to the stretch as a whole. To be called with the work of average(), which
    /// the step began with. Returns what must be added to the energy given away (J).
    double share(const DirectorModel& model, const Table<DirectorRow>& rod,
                 Table<DirectorRow>& next, std::size_t i, double kick, double drift,
                 Work& work) const;

    /// What substeps add to the kinetic energy of the motions of `rod` (J), for motions that the
    /// step of the string can follow.
    [[nodiscard]] double added_energy(const Table<DirectorRow>& rod, double step) const;

  private:
    [[nodiscard]] std::size_t nodes(std::size_t i) const {
        return last_node(i) - first_node(i) + 1;
    }
    void take(const DirectorModel& model, std::size_t i, Work& work) const;

    StepPlan plan_;
    std::vector<BlockTable> constants_;  ///< of each stretch
};

/// What runs use: half the time of double precision, for an error of 1e-7 of the forces.
using Substeps = SubstepsOf<float>;

}  // namespace drillstrand
