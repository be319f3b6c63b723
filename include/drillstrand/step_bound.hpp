/// What bounds the time step of an explicit integrator on a scene.
#pragma once

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

/// The least over the string: of dormand-prince each node with the stiffest of its own segments, of
/// the leapfrog each segment under the loads that the scene lets expect. The leapfrog solves
/// contact and fluid implicitly, so that only the rod bounds it.
StepBound step_bound(const Scene& scene, IntegratorKind integrator);

/// The leapfrog's, of each segment alone (s): the least of them is that of the string.
std::vector<double> segment_steps(const Scene& scene);

}  // namespace drillstrand
