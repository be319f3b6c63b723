/// How far the head's schedules let the string down.
#pragma once

#include "drillstrand/case.hpp"

namespace drillstrand {

struct Descent {
    double depth = 0;  ///< m below the start, along d3
    double time = 0;   ///< s
};

/// The deepest place of the head in a run (s; 0: as long as its schedules change).
Descent deepest_descent(const HeadCase& head, double duration);

}  // namespace drillstrand
