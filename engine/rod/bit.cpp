#include "rod/bit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rod/head.hpp"

namespace drillstrand {

using Eigen::Vector3d;

namespace {

EndLoad in_space(const Eigen::Matrix3d& frame, const Vector6& stress) {
    return {frame * stress.tail<3>(), frame * stress.head<3>()};
}

}  // namespace

double bit_radius(const Scene& scene) {
    return scene.bit.radius > 0 ? scene.bit.radius : scene.mesh.node.back().outer_radius;
}

double rock_stiffness(const Scene& scene) {
    const BitCase& bit = scene.bit;
    if (bit.law == BitLaw::cutting) return Cutting::stiffness(bit.cutting, bit_radius(scene));
    return bit.law == BitLaw::roller_cone ? bit.roller_cone.stiffness : 0.0;
}

Bit::Bit(const Scene& scene)
    : Bit(scene.bit, bit_radius(scene), static_cast<std::size_t>(scene.segments)) {
    inertia_ = scene.mesh.node.back().polar_inertia * scene.mesh.cell.back();
    mass_ = scene.mesh.node.back().mass * scene.mesh.cell.back();
    material_turns_ = scene.features.curved;
    if (loads_.motor) motor_.emplace(*loads_.motor);
    if (loads_.law == BitLaw::cutting)
        drilling_.emplace(Cutting(loads_.cutting, radius_));
    else if (loads_.law == BitLaw::roller_cone)
        drilling_.emplace(RollerCone(loads_.roller_cone, loads_.friction.value_or(0), radius_));
}

double Bit::full_torque(double time) const {
    if (loads_.law == BitLaw::stribeck) return loads_.static_torque;
    if (drills()) return 0;  // of what it drills, not of time
    if (!loads_.friction) return loads_.torque(time);
    return *loads_.friction * std::numbers::pi * radius_ / 4 * loads_.weight(time);
}

double Bit::torque(double opposed_rate, double time) const {
    if (turns_by_itself()) {
        const double most = friction(std::abs(opposed_rate), time);
        // a motor drives on where it is stalled
        if (motor_ && opposed_rate >= 0) return std::min(most, motor_->stall_torque());
        return opposed_rate == 0 ? 0.0 : std::copysign(most, opposed_rate);
    }
    // sgn of the rotation, falling linearly to zero below the smoothing speed
    const double sense = loads_.smoothing_speed > 0
                             ? std::clamp(opposed_rate / loads_.smoothing_speed, -1.0, 1.0)
                             : static_cast<double>((opposed_rate > 0) - (opposed_rate < 0));
    return sense * full_torque(time);
}

Vector6 Bit::stress_of_schedules(const BitMotion& motion, double time) const {
    const Vector3d push = loads_.direction == BitDirection::follower
                              ? Vector3d(Vector3d::UnitX())
                              : Vector3d(motion.frame.transpose() * motion.well_direction);
    Vector6 stress;
    stress.head<3>() = loads_.moment(time) + motion.frame.transpose() * loads_.dead_moment(time);
    stress.tail<3>() = motion.frame.transpose() * loads_.force(time) - loads_.weight(time) * push;
    return stress;
}

Vector6 Bit::stress(const BitMotion& motion, double time) const {
    Vector6 stress = stress_of_schedules(motion, time);
    stress[0] -= torque(motion.opposed_rate, time);
    return stress;
}

EndLoad Bit::load(const BitMotion& motion, double time) const {
    return in_space(motion.frame, stress(motion, time));
}

double Bit::friction(double speed, double time) const {
    if (loads_.law != BitLaw::stribeck) return full_torque(time);
    const double part = loads_.decay_speed > 0 ? std::exp(-speed / loads_.decay_speed) : 0.0;
    return loads_.dynamic_torque + part * (loads_.static_torque - loads_.dynamic_torque);
}

double Bit::steady_rate(double string_rate, double time) const {
    if (!motor_) return string_rate;
    constexpr double fast = std::numeric_limits<double>::infinity();
    return string_rate + motor_->speed(friction(fast, time));
}

// ------------------------------------------------------------------ on directors

RockState Bit::start_on_rock() const {
    return of_rock([&](const auto& law) { return law.start(loads_.off_bottom); }, RockState());
}

double Bit::weight(const RockState& rock, double time) const {
    return of_rock([&](const auto& law) { return law.weight(rock); }, loads_.weight(time));
}

double Bit::depth_of_cut(const RockState& rock) const {
    return of_rock([&](const auto& law) { return law.depth_of_cut(rock); }, 0.0);
}

void Bit::load(const BitState& bit, const RockState& rock, Table<SegmentRow>& segments,
               const Table<DirectorRow>& rod, const Vector3d& well_direction, double opposed_rate,
               double time) const {
    const Vector3d t = rod.vector(DirectorRow::director, node_);
    BitMotion motion{{}, well_direction, opposed_rate};
    motion.frame << t, bit.d1, t.cross(bit.d1);
    Vector6 body = stress_of_schedules(motion, time);
    if (!turns_by_itself()) body[0] -= torque(opposed_rate, time);
    EndLoad outside = in_space(motion.frame, body);
    // what follows from the bit's own rate is the state's
    outside.couple -= (motor_ ? bit.rotor_torque : bit.torque) * t;
    if (drilling_) outside.force -= weight(rock, time) * down(t, well_direction);
    write_end_load(segments, static_cast<std::ptrdiff_t>(node_), outside, t);
}

/// Of s + mobility T(s) = free speed the largest solution: the left side is convex, and Newton's
/// method from above comes down to it, or past 0 where there is none.
double Bit::speed_left(double free_speed, double mobility, double time) const {
    double speed = free_speed;
    constexpr int most_tries = 50;
    for (int i = 0; i < most_tries && speed > 0; ++i) {
        const double torque = friction(speed, time);
        const double excess = speed + mobility * torque - free_speed;
        const double falling =
            loads_.decay_speed > 0 ? (torque - loads_.dynamic_torque) / loads_.decay_speed : 0.0;
        const double slope = 1 - mobility * falling;
        if (slope <= 0) return 0;
        const double change = excess / slope;
        speed -= change;
        if (std::abs(change) <= 1e-14 * free_speed) break;
    }
    return std::max(speed, 0.0);
}

double Bit::spin_left(const BitState& bit, const RockState& rock, const Turning& turning,
                      double time) const {
    const auto& [before, free, mobility] = turning;
    if (drilling_) {
        const RockTorque torque =
            of_rock([&](const auto& law) { return law.torque(rock); }, RockTorque());
        return torque.spin_left(free, mobility);
    }
    double left = 0;
    if (bit.sticks == 0) {
        // it slides on the way it went, as far as it goes that way
        const double onward = std::max(std::copysign(1.0, before) * free, 0.0);
        left = std::copysign(speed_left(onward, mobility, time), before);
    }
    if (left == 0 && std::abs(free) > mobility * full_torque(time))
        left = std::copysign(speed_left(std::abs(free), mobility, time), free);
    return left;
}

double Bit::turn_on_rock(BitState& bit, const RockState& rock, const Turning& turning,
                         double time) const {
    const double left = spin_left(bit, rock, turning, time);
    bit.sticks = left == 0 ? 1 : 0;
    bit.torque = (turning.free - left) / turning.mobility;
    return left;
}

double Bit::turn_rotor(BitState& bit, const RockState& rock, const Turning& end,
                       const DirectorStep& step) const {
    const double mobility = step.kick / loads_.inertia;
    const auto driven = [&](double torque) {
        return Turning{bit.rotor_speed, bit.rotor_speed + mobility * torque, mobility};
    };
    const auto held = [&](double torque) { return end.free - end.mobility * torque; };
    bit.rotor_torque = motor_->torque([&](double torque) {
        return spin_left(bit, rock, driven(torque), step.time) - held(torque);
    });
    bit.rotor_speed = turn_on_rock(bit, rock, driven(bit.rotor_torque), step.time);
    (step.number % 2 == 0 ? bit.even_pressure : bit.odd_pressure) = motor_pressure(bit);
    return held(bit.rotor_torque);
}

void Bit::press_flats(BitState& bit, RockState& rock, const Table<DirectorRow>& rod,
                      Table<DirectorRow>& next, const Vector3d& down,
                      const DirectorStep& step) const {
    const double mobility = step.kick / mass_;
    const Vector3d velocity = next.vector(DirectorRow::velocity, node_);
    const double sinking =
        velocity.dot(down) + loads_.feed(step.time) + mobility * rock.flat_weight;
    const double weight = std::clamp(sinking / mobility, 0.0,
                                     std::get<Cutting>(*drilling_).largest_flat_weight(rock));
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
    if (!turns_by_itself()) return;
    if (loads_.law == BitLaw::cutting)
        press_flats(bit, rock, rod, next,
                    down(rod.vector(DirectorRow::director, node_), well_direction), step);
    const double mobility = step.kick / inertia_;
    const double before = rod.row(DirectorRow::spin)[node_];
    double& spin = next.row(DirectorRow::spin)[node_];
    const double& torque = motor_ ? bit.rotor_torque : bit.torque;
    const double last_torque = torque;
    const Turning end{before, spin + mobility * last_torque, mobility};
    const double left =
        motor_ ? turn_rotor(bit, rock, end, step) : turn_on_rock(bit, rock, end, step.time);
    // of what changes here; the torque of the step before does its work in finish()
    bit.work -= step.kick * (torque - last_torque) * 0.5 * (before + left);
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
    if (drilling_) {
        const double fed =
            loads_.feed.integral(step.time + step.drift) - loads_.feed.integral(step.time);
        const Vector3d moved = step.drift * next.vector(DirectorRow::velocity, node_);
        const double sink = moved.dot(down(before, well_direction)) + fed;
        const double turn = step.drift * rate(bit, next_spin);
        std::visit([&](const auto& law) { law.advance(rock, turn, sink); }, *drilling_);
    }
    const auto beyond = static_cast<std::ptrdiff_t>(node_) + 1;
    next.set(DirectorRow::position, beyond, next.vector(DirectorRow::position, node_));
    next.set(DirectorRow::director, beyond, t);
    next.set(DirectorRow::last_director, beyond, t);
}

}  // namespace drillstrand
