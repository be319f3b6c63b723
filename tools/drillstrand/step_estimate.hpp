/// What a run will cost, as far as can be told before it.
#pragma once

#include <string>

#include "drillstrand/case.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand::program {

/// The fastest process of the discrete string bounds the time step of an explicit integrator.
struct StepEstimate {
    double rate = 0;      ///< of that process (1/s)
    std::string process;  ///< its name
    double step = 0;      ///< s
    double steps = 0;     ///< over the run
    int evaluations = 1;  ///< of the right-hand side, per step
};

StepEstimate estimate_step(const Case& input, const Scene& scene);

/// Wall seconds that one evaluation of the right-hand side takes on this machine, timed over the
/// first steps of the scene.
double time_evaluation(const Case& input, const Scene& scene);

}  // namespace drillstrand::program
