/// What bounds the time step of an explicit integrator on a scene.
#pragma once

#include <cmath>
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
    double free_step = 0;   ///< at which rod and wall are stable without substeps and damping (s)
    int substeps = 1;       ///< in a step of the string at its bound

    /// What it takes in a step of the string besides its nodes' own part in it, in such parts.
    [[nodiscard]] double work() const;
};

/// The leapfrog's step and the stretches that take substeps in it; none where the scene asks for
/// one step for all, or where substeps would save less than a quarter of the work.
struct StepPlan {
    StepBound bound;
    std::vector<FineStretch> stretches;
    double kelvin_voigt = 0;  ///< tau (s)
    /// The step (s) that polynomials of substeps must be made for, so that no motion that they
    /// leave has a rate above that which the damping allows at `step`: 2/rate where rate step/2 =
    /// sqrt(1 + z^2) - z, z = tau rate/2.
    [[nodiscard]] double undamped(double step) const {
        return std::sqrt(step * (step + 2 * kelvin_voigt));
    }
};
StepPlan step_plan(const Scene& scene);

/// Substeps of a stretch in a step (s) of a string that nothing damps (StepPlan::undamped); 1 where
/// it needs none.
int substeps_in(const FineStretch& stretch, double step);

/// The least over the string: of dormand-prince each node with the stiffest of its own segments, of
/// the leapfrog each segment under the loads that the scene lets expect. The leapfrog solves
/// contact and fluid implicitly, so that only the rod bounds it: that of its step_plan().
StepBound step_bound(const Scene& scene, IntegratorKind integrator);

/// The leapfrog's, of each segment alone (s): the least of them is that of the string without
/// substeps.
std::vector<double> segment_steps(const Scene& scene);

}  // namespace drillstrand
