/// The matrix of a cross product.
#pragma once

#include <Eigen/Core>

namespace drillstrand {

/// skew(v) u = v x u.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

}  // namespace drillstrand
