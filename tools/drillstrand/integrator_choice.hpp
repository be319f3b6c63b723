/// The integrator that a case asks for.
#pragma once

#include "drillstrand/case.hpp"
#include "drillstrand/simulation.hpp"

namespace drillstrand::program {

/// As the case says; threads = 0 becomes the number of cores.
IntegratorOptions integrator_options(const RunCase& input);

}  // namespace drillstrand::program
