#include "rod/bit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "rod/head.hpp"

namespace drillstrand {

using Eigen::Vector3d;

Bit::Bit(const Scene& scene)
    : Bit(scene.bit, scene.mesh.node.back().outer_radius,
          static_cast<std::size_t>(scene.segments)) {}

double Bit::full_torque(double time) const {
    if (!loads_.friction) return loads_.torque(time);
    return *loads_.friction * std::numbers::pi * radius_ / 4 * loads_.weight(time);
}

double Bit::torque(double opposed_rate, double time) const {
    // sgn of the rotation, falling linearly to zero below the smoothing speed
    const double sense = loads_.smoothing_speed > 0
                             ? std::clamp(opposed_rate / loads_.smoothing_speed, -1.0, 1.0)
                             : static_cast<double>((opposed_rate > 0) - (opposed_rate < 0));
    return sense * full_torque(time);
}

Vector6 Bit::stress(const BitMotion& motion, double time) const {
    const Vector3d push = loads_.direction == BitDirection::follower
                              ? Vector3d(Vector3d::UnitX())
                              : Vector3d(motion.frame.transpose() * motion.well_direction);
    Vector6 stress;
    stress.head<3>() = loads_.moment(time) + motion.frame.transpose() * loads_.dead_moment(time);
    stress[0] -= torque(motion.opposed_rate, time);
    stress.tail<3>() = motion.frame.transpose() * loads_.force(time) - loads_.weight(time) * push;
    return stress;
}

EndLoad Bit::load(const BitMotion& motion, double time) const {
    const Vector6 body = stress(motion, time);
    return {motion.frame * body.tail<3>(), motion.frame * body.head<3>()};
}

// ------------------------------------------------------------------ on directors

void Bit::load(const BitState& bit, Table<SegmentRow>& segments, const Table<DirectorRow>& rod,
               const Vector3d& well_direction, double opposed_rate, double time) const {
    const Vector3d t = rod.vector(DirectorRow::director, node_);
    BitMotion motion{{}, well_direction, opposed_rate};
    motion.frame << t, bit.d1, t.cross(bit.d1);
    write_end_load(segments, static_cast<std::ptrdiff_t>(node_), load(motion, time), t);
}

void Bit::finish(BitState& bit, const Table<SegmentRow>& segments, const Table<DirectorRow>& rod,
                 Table<DirectorRow>& next, const DirectorStep& step) const {
    const auto mean = [&](DirectorRow row) {
        return Vector3d(0.5 * (rod.vector(row, node_) + next.vector(row, node_)));
    };
    const double next_spin = next.row(DirectorRow::spin)[node_];
    const Vector3d before = rod.vector(DirectorRow::director, node_);
    const Vector3d couple = before.cross(segments.vector(SegmentRow::first_lean, node_));
    bit.work +=
        step.kick * (segments.vector(SegmentRow::pull, node_).dot(mean(DirectorRow::velocity)) +
                     couple.dot(mean(DirectorRow::angular_velocity)) +
                     segments.row(SegmentRow::torque)[node_] * 0.5 *
                         (rod.row(DirectorRow::spin)[node_] + next_spin));
    const Vector3d t = next.vector(DirectorRow::director, node_);
    bit.d1 = followed(bit.d1, before, t, step.drift * next_spin);
    const auto beyond = static_cast<std::ptrdiff_t>(node_) + 1;
    next.set(DirectorRow::position, beyond, next.vector(DirectorRow::position, node_));
    next.set(DirectorRow::director, beyond, t);
    next.set(DirectorRow::last_director, beyond, t);
}

}  // namespace drillstrand
