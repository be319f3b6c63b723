/// Forces of one segment of the director rod on its two nodes, and their derivatives:
/// engine/statics/README.md, "Segment".
#pragma once

#include <Eigen/Core>

#include "drillstrand/drill_string.hpp"
#include "drillstrand/records.hpp"

namespace drillstrand {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// A node as its segments see it.
struct SegmentEnd {
    Eigen::Vector3d position;  ///< m
    Eigen::Vector3d director;  ///< t, unit
    Eigen::Vector3d material;  ///< d1, unit, normal to t
};

/// One segment between its nodes a (nearer to the head) and b.
struct RodSegment {
    double length;                     ///< h (m)
    const SectionProperties* section;  ///< stiffnesses and stress-free curvature
    SegmentEnd a;
    SegmentEnd b;
    double twist;  ///< tau (1/m)
};

/// Force (N) and couple (N m) on both nodes, in the space frame, and the energy (J).
struct SegmentForces {
    Vector6 on_a;
    Vector6 on_b;
    double energy;
};

/// Derivatives of the forces by displacements (m) and rotations (rad, space frame) of both nodes.
struct SegmentTangent {
    Matrix6 aa, ab, ba, bb;  ///< force on the first by motion of the second letter
};

/// z: axial force over EI/h^2.
double segment_load(const RodSegment& segment);

SegmentForces segment_forces(const RodSegment& segment);
SegmentTangent segment_tangent(const RodSegment& segment);

}  // namespace drillstrand
