#include "integrator_choice.hpp"

#include <algorithm>
#include <thread>

namespace drillstrand::program {

IntegratorOptions integrator_options(const RunCase& input) {
    IntegratorOptions options;
    options.kind = input.integrator;
    options.absolute_tolerance = input.absolute_tolerance;
    options.relative_tolerance = input.relative_tolerance;
    options.cfl = input.cfl;
    options.stress_limit = input.stress_limit;
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    options.threads = input.threads == 0 ? cores : input.threads;
    return options;
}

}  // namespace drillstrand::program
