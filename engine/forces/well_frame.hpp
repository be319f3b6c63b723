/// The cross section of the well through a node: engine/forces/README.md, "Well frame".
#pragma once

#include <cmath>

#include "numerics/triple.hpp"

namespace drillstrand {

/// The numbers of the arc of well that a node carries with it.
struct ArcNumbers {
    Triple start;      ///< first point of the axis (m)
    Triple tangent;    ///< unit tangent there
    Triple normal;     ///< unit normal there, toward the centre
    double curvature;  ///< 1/m
    double radius;     ///< of the hole (m)
};

/// Eccentricity and the orthonormal directions at a node: r toward the axis, l down the well,
/// t = r x l around it.
struct WellFrame {
    Triple r, l, t;
    double eccentricity;  ///< distance of the node from the axis (m)
    double along;         ///< a = (x - p) . t, coordinate of the node along the arc's first tangent
    double toward;        ///< q = 1 - c e, e the coordinate toward the centre
    double inverse;       ///< 1 / rho, rho the distance from the centre times c
};

/// Something that is linear in sin(c s)/c of the foot point, s its distance from the start of the
/// arc: its value, and its growth as the node moves along l.
struct AlongArc {
    double value;
    double slope;
};

DRILLSTRAND_INLINE AlongArc along_arc(const WellFrame& frame, double at_start, double growth) {
    return {at_start + growth * frame.along * frame.inverse,
            growth * frame.toward * frame.inverse * frame.inverse};
}

/// Foot-point projection onto an arc without trigonometry (physics: engine/model/README.md).
/// On the axis itself any unit vector normal to l serves as r; nothing divides by zero.
DRILLSTRAND_INLINE WellFrame well_frame(const Triple& x, const ArcNumbers& arc) {
    constexpr double on_axis = 1e-12;  // m; nearer than this the direction of r is rounding
    const Triple from_start = combine(1.0, x, -1.0, arc.start);
    const double c = arc.curvature;
    const double a = dot(from_start, arc.tangent);
    const double e = dot(from_start, arc.normal);
    const double q = 1.0 - e * c;
    const double radius = std::sqrt(a * a * c * c + q * q);
    const double inverse = 1.0 / radius;
    const Triple l = combine(q * inverse, arc.tangent, a * c * inverse, arc.normal);
    const Triple inward = combine(q * inverse, arc.normal, -a * c * inverse, arc.tangent);

    const double axis_normal = inverse * (e + (c * (a * a + e * e) - 2.0 * e) / (radius + 1.0));
    const Triple axis = combine(inverse * a, arc.tangent, axis_normal, arc.normal);
    const Triple to_axis = combine(1.0, axis, -1.0, from_start);
    const double eccentricity = std::sqrt(dot(to_axis, to_axis));
    const bool off_axis = eccentricity > on_axis;
    const double scale = 1.0 / (off_axis ? eccentricity : 1.0);
    const Triple r = {off_axis ? to_axis.x * scale : inward.x,
                      off_axis ? to_axis.y * scale : inward.y,
                      off_axis ? to_axis.z * scale : inward.z};
    return {r, {l.x, l.y, l.z}, cross(r, l), eccentricity, a, q, inverse};
}

/// Whether the foot lies past the end of the arc (sine and cosine are of its total angle; reach =
/// sine / curvature, the length where the arc is straight) or before its start.
DRILLSTRAND_INLINE bool foot_leaves(const WellFrame& frame, double end_cosine, double reach) {
    return frame.along < 0.0 || frame.along * end_cosine - frame.toward * reach > 0.0;
}

}  // namespace drillstrand
