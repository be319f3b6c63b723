#include "rod/bit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rod/head.hpp"

namespace drillstrand {

using Eigen::Vector3d;

Bit::Bit(const Scene& scene)
    : Bit(scene.bit, scene.mesh.node.back().outer_radius,
          static_cast<std::size_t>(scene.segments)) {
    inertia_ = scene.mesh.node.back().polar_inertia * scene.mesh.cell.back();
    mass_ = scene.mesh.node.back().mass * scene.mesh.cell.back();
    material_turns_ = scene.features.curved;
    if (loads_.law == BitLaw::cutting) cutting_.emplace(loads_.cutting, radius_);
}

double Bit::full_torque(double time) const {
    if (loads_.law == BitLaw::stribeck) return loads_.static_torque;
    if (loads_.law == BitLaw::cutting) return 0;  // of what it cuts, not of time
    if (!loads_.friction) return loads_.torque(time);
    return *loads_.friction * std::numbers::pi * radius_ / 4 * loads_.weight(time);
}

double Bit::torque(double opposed_rate, double time) const {
    if (loads_.law == BitLaw::stribeck)
        return opposed_rate == 0 ? 0.0
                                 : std::copysign(friction(std::abs(opposed_rate)), opposed_rate);
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

double Bit::friction(double speed) const {
    const double part = loads_.decay_speed > 0 ? std::exp(-speed / loads_.decay_speed) : 0.0;
    return loads_.dynamic_torque + part * (loads_.static_torque - loads_.dynamic_torque);
}

// ------------------------------------------------------------------ on directors

double Bit::weight(const RockState& rock, double time) const {
    return cutting_ ? cutting_->weight(rock) + rock.flat_weight : loads_.weight(time);
}

double Bit::depth_of_cut(const RockState& rock) const {
    return cutting_ ? loads_.cutting.blades * cutting_->depth_of_cut(rock) : 0.0;
}

void Bit::load(const BitState& bit, const RockState& rock, Table<SegmentRow>& segments,
               const Table<DirectorRow>& rod, const Vector3d& well_direction, double opposed_rate,
               double time) const {
    const Vector3d t = rod.vector(DirectorRow::director, node_);
    // what a law of the bit's own rate gives is the state's
    BitMotion motion{{}, well_direction, law() == BitLaw::prescribed ? opposed_rate : 0.0};
    motion.frame << t, bit.d1, t.cross(bit.d1);
    EndLoad outside = load(motion, time);
    outside.couple -= bit.torque * t;
    if (cutting_) outside.force -= weight(rock, time) * down(t, well_direction);
    write_end_load(segments, static_cast<std::ptrdiff_t>(node_), outside, t);
}

/// Of s + mobility T(s) = free speed the largest solution: the left side is convex, and Newton's
/// method from above comes down to it, or past 0 where there is none.
double Bit::speed_left(double free_speed, double mobility) const {
    double speed = free_speed;
    constexpr int most_tries = 50;
    for (int i = 0; i < most_tries && speed > 0; ++i) {
        const double excess = speed + mobility * friction(speed) - free_speed;
        const double falling = loads_.decay_speed > 0
                                   ? (friction(speed) - loads_.dynamic_torque) / loads_.decay_speed
                                   : 0.0;
        const double slope = 1 - mobility * falling;
        if (slope <= 0) return 0;
        const double change = excess / slope;
        speed -= change;
        if (std::abs(change) <= 1e-14 * free_speed) break;
    }
    return std::max(speed, 0.0);
}

double Bit::spin_left(const BitState& bit, const RockState& rock, double before, double free,
                      double mobility) const {
    if (cutting_) {
        // what it cuts resists on the way on only, its wear flats both ways
        const double flats = cutting_->flat_torque(rock.flat_weight);
        const double on = mobility * (flats + cutting_->torque(rock));
        if (free > on) return free - on;
        return std::min(free + mobility * flats, 0.0);
    }
    double left = 0;
    if (bit.sticks == 0) {
        // it slides on the way it went, as far as it goes that way
        left = std::copysign(speed_left(std::max(std::copysign(1.0, before) * free, 0.0), mobility),
                             before);
    }
    if (left == 0 && std::abs(free) > mobility * loads_.static_torque)
        left = std::copysign(speed_left(std::abs(free), mobility), free);
    return left;
}

void Bit::press_flats(BitState& bit, RockState& rock, const Table<DirectorRow>& rod,
                      Table<DirectorRow>& next, const Vector3d& down,
                      const DirectorStep& step) const {
    const double mobility = step.kick / mass_;
    const Vector3d velocity = next.vector(DirectorRow::velocity, node_);
    const double sinking =
        velocity.dot(down) + loads_.feed(step.time) + mobility * rock.flat_weight;
    const double weight = std::clamp(sinking / mobility, 0.0, cutting_->largest_flat_weight(rock));
    const double change = mobility * (rock.flat_weight - weight);
    const double before = rod.vector(DirectorRow::velocity, node_).dot(down);
    // of what changes here; the weight of the step before does its work in finish()
    bit.work += mass_ * change * 0.5 * (before + velocity.dot(down) + change);
    next.set(DirectorRow::velocity, node_, velocity + change * down);
    next.set(DirectorRow::position, node_,
             next.vector(DirectorRow::position, node_) + step.drift * change * down);
    rock.flat_weight = weight;
}

void Bit::resist(BitState& bit, RockState& rock, const Table<DirectorRow>& rod,
                 Table<DirectorRow>& next, const Vector3d& well_direction,
                 const DirectorStep& step) const {
    if (loads_.law == BitLaw::prescribed) return;
    if (cutting_)
        press_flats(bit, rock, rod, next,
                    down(rod.vector(DirectorRow::director, node_), well_direction), step);
    const double mobility = step.kick / inertia_;
    const double before = rod.row(DirectorRow::spin)[node_];
    double& spin = next.row(DirectorRow::spin)[node_];
    const double free = spin + mobility * bit.torque;
    const double left = spin_left(bit, rock, before, free, mobility);
    bit.sticks = left == 0 ? 1 : 0;
    const double torque = (free - left) / mobility;
    // of what changes here; the torque of the step before does its work in finish()
    bit.work -= step.kick * (torque - bit.torque) * 0.5 * (before + left);
    bit.torque = torque;
    if (material_turns_) {
        const Vector3d t = next.vector(DirectorRow::director, node_);
        next.set(
            DirectorRow::material, node_,
            followed(next.vector(DirectorRow::material, node_), t, t, step.drift * (left - spin)));
    }
    spin = left;
}

void Bit::finish(BitState& bit, RockState& rock, const Table<SegmentRow>& segments,
                 const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                 const Vector3d& well_direction, const DirectorStep& step) const {
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
    if (cutting_) {
        const double fed =
            loads_.feed.integral(step.time + step.drift) - loads_.feed.integral(step.time);
        const Vector3d moved = step.drift * next.vector(DirectorRow::velocity, node_);
        cutting_->advance(rock, step.drift * next_spin,
                          moved.dot(down(before, well_direction)) + fed);
    }
    const auto beyond = static_cast<std::ptrdiff_t>(node_) + 1;
    next.set(DirectorRow::position, beyond, next.vector(DirectorRow::position, node_));
    next.set(DirectorRow::director, beyond, t);
    next.set(DirectorRow::last_director, beyond, t);
}

}  // namespace drillstrand
