/// Side force: the force of the wall per length as engineers hold it against limits.
#pragma once

#include <vector>

namespace drillstrand {

/// Mean over windows of a length (m) of the normal force of the wall per length (N/m), around the
/// places `at` (m): nodes carry their own force on their cells, from the middle of one segment to
/// the middle of the next. Windows are cut at the ends of the string. Commands and files all use
/// this one definition.
std::vector<double> side_force(const std::vector<double>& node_s,
                               const std::vector<double>& normal_force, double window,
                               const std::vector<double>& at);

}  // namespace drillstrand
