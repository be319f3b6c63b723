/// What bounds the time step of an explicit integrator on a scene.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

/// Largest step at which an integrator is stable, and the process of the discrete string that sets
/// it. Control of the error, or the factor cfl, keeps the step shorter.
struct StepBound {
    double step = 0;      ///< s
    double rate = 0;      ///< of that process (1/s)
    std::string process;  ///< its name
};

/// Neighbouring segments that are shorter than the step of the string allows: the leapfrog takes
/// them through it in substeps (engine/rod/README.md, "Substeps").
struct FineStretch {
    std::size_t first = 0;  ///< segment
    std::size_t end = 0;    ///< one past the last
    double free_step = 0;   ///< at which its rod is stable without substeps and damping (s)
    double grip = 0;        ///< of walls: mass that they move over that of a node, over sqrt(step)
    int substeps = 1;       ///< in a step of the string at its bound

    /// What it takes in a step of the string besides its nodes' own part in it, in such parts.
    [[nodiscard]] double work() const;
};

/// The leapfrog's step and the stretches that take substeps in it; none where the scene asks for
/// one step for all, or where substeps would save less than a quarter of the work.
struct StepPlan {
    StepBound bound;
    std::vector<FineStretch> stretches;
    /// What the step could be if nothing damped over what it is, at least 1.
    [[nodiscard]] double undamped() const { return 2.0 / (bound.rate * bound.step); }
};
StepPlan step_plan(const Scene& scene);

/// The least over the string: of dormand-prince each node with the stiffest of its own segments, of
/// the leapfrog each segment under the loads that the scene lets expect. The leapfrog solves
/// contact and fluid implicitly, so that only the rod bounds it: that of its step_plan().
StepBound step_bound(const Scene& scene, IntegratorKind integrator);

/// The leapfrog's, of each segment alone (s): the least of them is that of the string without
/// substeps.
std::vector<double> segment_steps(const Scene& scene);

}  // namespace drillstrand
