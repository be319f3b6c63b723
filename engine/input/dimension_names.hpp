/// Dimensions in words, for error messages.
#pragma once

#include <string>

#include "drillstrand/units.hpp"

namespace drillstrand {

/// "a force"; the powers of kg, m and s where the dimension has no name of its own.
std::string dimension_noun(const Dimension& dimension);

/// "N": the unit of SI; the powers of kg, m and s where the dimension has no name of its own.
std::string si_unit(const Dimension& dimension);

/// "a force such as N, kN, lbf": a noun with units to write it in.
std::string describe_dimension(const Dimension& dimension);

}  // namespace drillstrand
