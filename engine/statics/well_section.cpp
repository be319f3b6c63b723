#include "statics/well_section.hpp"

#include <cmath>

namespace drillstrand {

WellSection well_section(const Eigen::Vector3d& point, const WellArc& arc) {
    const WellFrame frame = well_frame(
        triple(point),
        {triple(arc.start), triple(arc.tangent), triple(arc.normal), arc.curvature, arc.radius});
    const double a_c = frame.along * arc.curvature;
    const double rho = std::hypot(a_c, frame.toward);
    return {frame,
            vector(frame.r),
            vector(frame.l),
            vector(frame.t),
            (frame.toward * arc.normal - a_c * arc.tangent) / rho,
            arc.curvature / rho,
            frame.eccentricity};
}

}  // namespace drillstrand
