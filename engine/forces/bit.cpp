#include "forces/bit.hpp"

#include <algorithm>
#include <numbers>

namespace drillstrand {

double bit_torque(const BitCase& bit, double radius, double time) {
    if (!bit.friction) return bit.torque(time);
    return *bit.friction * std::numbers::pi * radius / 4 * bit.weight(time);
}

Vector6 bit_stress(const BitCase& bit, const BitMotion& motion, double time) {
    // sgn of the rotation, falling linearly to zero below the smoothing speed
    const double sense =
        bit.smoothing_speed > 0
            ? std::clamp(motion.rotation_rate / bit.smoothing_speed, -1.0, 1.0)
            : static_cast<double>((motion.rotation_rate > 0) - (motion.rotation_rate < 0));
    const Eigen::Vector3d push =
        bit.direction == BitDirection::follower
            ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
            : Eigen::Vector3d(motion.frame.transpose() * motion.well_direction);
    Vector6 stress;
    stress.head<3>() = bit.moment(time) + motion.frame.transpose() * bit.dead_moment(time);
    stress[0] -= sense * bit_torque(bit, motion.radius, time);
    stress.tail<3>() = motion.frame.transpose() * bit.force(time) - bit.weight(time) * push;
    return stress;
}

}  // namespace drillstrand
