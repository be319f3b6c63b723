/// What a run will cost, as far as can be told before it.
#pragma once

#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/step_bound.hpp"

namespace drillstrand::program {

/// Steps at the bound of stability, for the leapfrog times cfl; error control may keep them
/// shorter.
struct StepEstimate {
    StepBound bound;
    double steps = 0;  ///< over the run, at that step
    /// Where it takes substeps, a sentence for each stretch; none with one step for all.
    std::vector<std::string> substeps;
};

StepEstimate estimate_step(const Case& input, const Scene& scene);

/// What the first steps of a run were like on this machine.
struct FirstSteps {
    double count = 0;
    double mean_step = 0;  ///< s
    int threads = 1;
    double seconds_a_step = 0;  ///< wall time of an accepted step, with its share of rejected ones
};

FirstSteps time_first_steps(const Case& input, const Scene& scene);

}  // namespace drillstrand::program
