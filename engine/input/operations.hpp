/// Operations of a rig in words, as schedules of the head: engine/input/KEYS.md, "Operations".
#pragma once

#include <vector>

#include "drillstrand/case.hpp"
#include "input/value.hpp"

namespace drillstrand {

struct Operations {
    ScalarSchedule rotation;      ///< rad/s about d3
    ScalarSchedule speed;         ///< m/s along d3
    std::vector<TimeSpan> slips;  ///< in which slips hold the string
};

/// One after the other, from a list of texts; speeds change over `ramp` (s). Throws InputError at
/// the operation that it does not understand.
Operations operations_in_words(const Value& list, double ramp);

}  // namespace drillstrand
