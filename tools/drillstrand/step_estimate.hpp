/// What a run will cost, as far as can be told before it.
#pragma once

#include <string>

#include "drillstrand/case.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand::program {

/// The fastest process of the discrete string bounds the time step of an explicit integrator; error
/// control may keep it shorter.
struct StepEstimate {
    double rate = 0;      ///< of that process (1/s)
    std::string process;  ///< its name
    double step = 0;      ///< s
    double steps = 0;     ///< over the run, at that step
};

StepEstimate estimate_step(const Case& input, const Scene& scene);

/// What the first steps of a run were like on this machine.
struct FirstSteps {
    double count = 0;
    double mean_step = 0;       ///< s
    double seconds_a_step = 0;  ///< wall time of an accepted step, with its share of rejected ones
};

FirstSteps time_first_steps(const Case& input, const Scene& scene);

}  // namespace drillstrand::program
