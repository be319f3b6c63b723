/// Minimum curvature between two stations of a survey. Equations: README.md of this folder.
#pragma once

#include <Eigen/Core>

#include "drillstrand/case.hpp"

namespace drillstrand {

/// Unit tangent of the hole at a station (north-east-down).
Eigen::Vector3d station_tangent(const SurveyStation& station);

/// Angle between two unit vectors (rad), accurate down to rounding for nearly parallel ones, where
/// the arc cosine of their product loses half of the digits.
double angle_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// sin(x)/x.
double sine_ratio(double x);

/// From the start to the end of the circular arc of the given length that leaves along `from` and
/// arrives along `to` (unit vectors, less than half a turn apart).
Eigen::Vector3d arc_displacement(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                 double length);

}  // namespace drillstrand
