/// Where a string that goes down by its own weight alone comes to a stop: engine/statics/README.md,
/// "Lock-up".
#pragma once

#include "drillstrand/torque_drag.hpp"

namespace drillstrand {

/// Measured depth of the bit (m) at which the hook load of such a motion falls to nothing, between
/// the depths of a study; NaN where it does not.
double lock_up_depth(const Case& input, const std::vector<double>& bit_depth,
                     const TorqueDragCurve& curve);

/// The largest weight that reaches the bit (N) while the string slides, with the bit at a depth
/// (m): that with which nothing hangs on the hook. NaN where no equilibrium tells.
double largest_weight(const Case& input, double bit_depth);

}  // namespace drillstrand
