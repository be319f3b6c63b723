/// Pose of the rod from its strains by the exponential map: engine/rod/README.md, "Pose".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "numerics/kernel.hpp"
#include "numerics/triple.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// Turn and displacement over a segment, in the frame of its first node.
struct SegmentPose {
    double rotation[3][3];  ///< exp(h k^), row-major
    double position[3];     ///< h T(h k) g
};

/// exp(h k^) and h T g with T = I + (1 - cos t)/t^2 W + (t - sin t)/t^3 W^2, W = h k^, t = |h k|.
DRILLSTRAND_INLINE SegmentPose segment_pose(double h, double k3, double k1, double k2, double g3,
                                            double g1, double g2) {
    const double a = h * k3;
    const double b = h * k1;
    const double c = h * k2;
    const double t2 = a * a + b * b + c * c;
    const RotationFactors f = rotation_factors(t2);

    // W g and W^2 g = w (w . g) - t^2 g
    const double turned_3 = b * g2 - c * g1;
    const double turned_1 = c * g3 - a * g2;
    const double turned_2 = a * g1 - b * g3;
    const double along = a * g3 + b * g1 + c * g2;
    const double kept = 1.0 - f.difference * t2;
    return {{{1.0 - f.cosine * (b * b + c * c), f.cosine * a * b - f.sine * c,
              f.cosine * a * c + f.sine * b},
             {f.cosine * a * b + f.sine * c, 1.0 - f.cosine * (a * a + c * c),
              f.cosine * b * c - f.sine * a},
             {f.cosine * a * c - f.sine * b, f.cosine * b * c + f.sine * a,
              1.0 - f.cosine * (a * a + b * b)}},
            {h * (kept * g3 + f.cosine * turned_3 + f.difference * along * a),
             h * (kept * g1 + f.cosine * turned_1 + f.difference * along * b),
             h * (kept * g2 + f.cosine * turned_2 + f.difference * along * c)}};
}

/// Position and frame (d3, d1, d2 in the columns) of a cross section.
struct Pose {
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// v taken along by the shortest turn from one unit vector to another.
DRILLSTRAND_INLINE Triple carried(const Triple& v, const Triple& from, const Triple& to) {
    return combine(1.0, v, -dot(v, to) / (1.0 + dot(from, to)), combine(1.0, from, 1.0, to));
}
inline Eigen::Vector3d carried(const Eigen::Vector3d& v, const Eigen::Vector3d& from,
                               const Eigen::Vector3d& to) {
    return vector(carried(triple(v), triple(from), triple(to)));
}

/// Poses of all nodes of a rod, from the head's pose, the segments' lengths (m) and strains.
std::vector<Pose> poses_from_strains(const Pose& head, const std::vector<double>& length,
                                     const std::vector<Vector6>& strain);

}  // namespace drillstrand
