/// Direction and curvature of the well's axis at a measured depth.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "drillstrand/well.hpp"

namespace drillstrand {

struct ArcSection {
    Eigen::Vector3d direction;  ///< unit, down the well
    Eigen::Vector3d curvature;  ///< toward the centre of the bend (1/m)
};

inline ArcSection arc_section(const WellArc& arc, double measured_depth) {
    const double angle = arc.curvature * (measured_depth - arc.measured_depth_start);
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {cosine * arc.tangent + sine * arc.normal,
            arc.curvature * (cosine * arc.normal - sine * arc.tangent)};
}

}  // namespace drillstrand
