#include "rod/head.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "rod/strand.hpp"

namespace drillstrand {

using Eigen::Vector3d;

namespace {

double torque_on_head(const Table<SegmentRow>& segments) {
    return segments.row(SegmentRow::torque)[0] + segments.row(SegmentRow::viscous_torque)[0];
}

}  // namespace

Head::Head(const Scene& scene)
    : motion_(scene.head.motion),
      course_(scene.head),
      force_(scene.head.force),
      moment_(scene.head.moment),
      start_{scene.head_frame, scene.head_position},
      polar_inertia_(scene.mesh.node.front().polar_inertia),
      cell_(scene.mesh.cell.front()),
      weight_(cell_ * scene.weight.front() * scene.down) {
    if (scene.head.drive) drive_.emplace(*scene.head.drive, scene);
    if (scene.head.hoist) hoist_.emplace(scene);
}

double Head::opposed_rate(double time, double bit_rate) const {
    return is_held() ? course_.rate(time) : bit_rate;
}

HeadState Head::start(const Vector3d& director) const {
    HeadState head;
    head.d1 = start_.frame.col(1);
    if (is_pinned()) head.d1 = (head.d1 - head.d1.dot(director) * director).normalized();
    head.position = start_.position;
    head.quaternion = Eigen::Quaterniond(start_.frame).coeffs();
    return head;
}

double Head::hook_load(const Vector3d& pull, const Vector3d& d3, double time) const {
    return is_held() ? (pull + weight_).dot(d3) : -force_(time).dot(start_.frame.col(0));
}

double Head::surface_torque(double torque, double time) const {
    return is_held() ? -torque : moment_(time).dot(start_.frame.col(0));
}

double Head::dead_line_tension(const HeadState& head, double time) const {
    return hoist_ ? hoist_->dead_line_tension(head, time) : 0.0;
}

double Head::prescribed_energy(double whole, double rate) const {
    if (!is_held()) return 0;
    return is_pinned() ? 0.5 * cell_ * polar_inertia_ * rate * rate : whole;
}

// ------------------------------------------------------------------ on directors

void Head::load(Table<SegmentRow>& segments, const Table<DirectorRow>& rod, double time) const {
    if (is_held()) return;
    write_end_load(segments, -1, {-force_(time), -moment_(time)},
                   rod.vector(DirectorRow::director, 0));
}

void Head::hang(HeadState& head, const Table<SegmentRow>& segments) const {
    if (hoist_) hoist_->hang(head, hoist_load(segments).pull);
}

HoistLoad Head::hoist_load(const Table<SegmentRow>& segments) const {
    const Vector3d pull = segments.vector(SegmentRow::pull, 0) +
                          segments.vector(SegmentRow::viscous_pull, 0) + weight_;
    return {pull.dot(start_.frame.col(0)), -torque_on_head(segments)};
}

void Head::finish(HeadState& head, const Table<SegmentRow>& segments, const Table<DirectorRow>& rod,
                  Table<DirectorRow>& next, const DirectorStep& step) const {
    if (!is_held()) return follow(head, rod, next, step);
    const double spin = rod.row(DirectorRow::spin)[0];
    const Vector3d t = rod.vector(DirectorRow::director, 0);
    double& next_spin = next.row(DirectorRow::spin)[0];
    if (course_.is_axial()) {
        next_spin = next_rate(head, segments, spin, step);
        move_along(head, segments, rod, next, step);
        if (is_pinned())
            head.d1 =
                followed(head.d1, t, next.vector(DirectorRow::director, 0), step.drift * next_spin);
        next.set(DirectorRow::material, 0, d1(head, step.time + step.drift));
    } else {
        move_freely(head, rod, next, step);
    }
    head.work -= step.kick * segments.row(SegmentRow::torque)[0] * 0.5 * (spin + next_spin);
    if (!course_.moves() && !hoist_) return;
    const auto mean = [&](DirectorRow row) {
        return Vector3d(0.5 * (rod.vector(row, 0) + next.vector(row, 0)));
    };
    head.work -= step.kick * power_taken(segments, t, mean(DirectorRow::velocity),
                                         mean(DirectorRow::angular_velocity));
}

/// A free head: its d1 goes along, its loads do work.
void Head::follow(HeadState& head, const Table<DirectorRow>& rod, const Table<DirectorRow>& next,
                  const DirectorStep& step) const {
    const auto mean = [&](DirectorRow row) {
        return Vector3d(0.5 * (rod.vector(row, 0) + next.vector(row, 0)));
    };
    const Vector3d t = rod.vector(DirectorRow::director, 0);
    const double spin = rod.row(DirectorRow::spin)[0];
    const double next_spin = next.row(DirectorRow::spin)[0];
    const Vector3d moment = moment_(step.time);
    head.work += step.kick * (force_(step.time).dot(mean(DirectorRow::velocity)) +
                              moment.dot(mean(DirectorRow::angular_velocity)) +
                              moment.dot(t) * 0.5 * (spin + next_spin));
    head.d1 = followed(head.d1, t, next.vector(DirectorRow::director, 0), step.drift * next_spin);
}

/// Along d3, as scheduled or by the hoist: a clamped head keeps its direction, a pinned one has
/// that of its node.
void Head::move_along(HeadState& head, const Table<SegmentRow>& segments,
                      const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                      const DirectorStep& step) const {
    const Vector3d x = rod.vector(DirectorRow::position, 0);
    const Vector3d t = rod.vector(DirectorRow::director, 0);
    next.set(DirectorRow::position, 0, x);
    next.set(DirectorRow::velocity, 0, Vector3d::Zero());
    if (course_.moves() || hoist_) {
        const double speed =
            hoist_ ? hoist_->advance(head, rod.vector(DirectorRow::velocity, 0).dot(t),
                                     hoist_load(segments), step)
                   : course_.travel(step.time, step.drift) / step.drift;
        next.set(DirectorRow::position, 0, x + step.drift * speed * t);
        next.set(DirectorRow::velocity, 0, speed * t);
    }
    if (is_pinned()) return;
    next.set(DirectorRow::director, 0, t);
    next.set(DirectorRow::angular_velocity, 0, Vector3d::Zero());
}

double Head::settled_speed(const HeadState& head, const Table<SegmentRow>& segments,
                           const Table<DirectorRow>& rod, double time, double half_kick) const {
    if (!hoist_) return course_.velocity(time)[3];
    const double speed =
        rod.vector(DirectorRow::velocity, 0).dot(rod.vector(DirectorRow::director, 0));
    return hoist_->kicked(head, speed, hoist_load(segments).pull, time, half_kick, 2 * half_kick);
}

/// In all six components: the velocities are those that lead from pose to pose, as nodes move.
void Head::move_freely(HeadState& head, const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                       const DirectorStep& step) const {
    const Vector3d t = rod.vector(DirectorRow::director, 0);
    Pose pose{{}, rod.vector(DirectorRow::position, 0)};
    pose.frame << t, head.d1, t.cross(head.d1);
    const Pose after = course_.after(pose, step.time, step.drift);
    const Vector3d to = after.frame.col(0).normalized();
    const Vector3d along = carried(head.d1, t, to);
    head.d1 = (after.frame.col(1) - after.frame.col(1).dot(to) * to).normalized();
    const double per_step = 1 / step.drift;
    const Vector3d axis = t.cross(to);
    const double sine = axis.norm();
    const double angle = std::atan2(sine, t.dot(to));
    next.set(DirectorRow::position, 0, after.position);
    next.set(DirectorRow::velocity, 0, per_step * (after.position - pose.position));
    next.set(DirectorRow::director, 0, to);
    next.set(DirectorRow::angular_velocity, 0, per_step * (sine > 0 ? angle / sine : 1.0) * axis);
    next.set(DirectorRow::material, 0, head.d1);
    next.row(DirectorRow::spin)[0] =
        per_step * std::atan2(head.d1.dot(to.cross(along)), head.d1.dot(along));
}

double Head::next_rate(HeadState& head, const Table<SegmentRow>& segments, double rate,
                       const DirectorStep& step) const {
    const double turn = course_.turn(step.time, step.drift);
    if (!drive_) return step.drift > 0 ? turn / step.drift : course_.rate(step.time);
    const DriveDemand demand{course_.rate(step.time), turn, torque_on_head(segments), step.kick,
                             step.drift};
    return drive_->advance(head, rate, demand);
}

double Head::power_taken(const Table<SegmentRow>& segments, const Vector3d& director,
                         const Vector3d& velocity, const Vector3d& turning) const {
    const Vector3d couple = director.cross(segments.vector(SegmentRow::first_lean, 0)) +
                            segments.vector(SegmentRow::first_couple, 0);
    return (segments.vector(SegmentRow::pull, 0) + weight_).dot(velocity) + couple.dot(turning);
}

void Head::settle(const HeadState& head, const Table<SegmentRow>& segments,
                  const Table<DirectorRow>& rod, Table<DirectorRow>& at, double time,
                  double half_kick) const {
    if (!is_held()) return;
    const double rate = rod.row(DirectorRow::spin)[0];
    at.set(DirectorRow::velocity, 0, Vector3d::Zero());
    if (!is_pinned()) at.set(DirectorRow::angular_velocity, 0, Vector3d::Zero());
    if (course_.moves() || hoist_) {
        const Vector3d t = rod.vector(DirectorRow::director, 0);
        const Vector3d d1 = this->d1(head, time);
        Eigen::Matrix3d frame;
        frame << t, d1, t.cross(d1);
        Vector6 velocity = course_.velocity(time);
        velocity[3] = settled_speed(head, segments, rod, time, half_kick);
        at.set(DirectorRow::velocity, 0, frame * velocity.tail<3>());
        at.set(DirectorRow::angular_velocity, 0, frame.rightCols<2>() * velocity.segment<2>(1));
    }
    double& spin = at.row(DirectorRow::spin)[0];
    spin = drive_ ? rate : course_.rate(time);
    if (drive_ && half_kick > 0) {
        HeadState copy = head;
        spin = drive_->advance(copy, rate,
                               {course_.rate(time), 0, torque_on_head(segments), half_kick, 0});
    }
}

Vector3d Head::d1(const HeadState& head, double time) const {
    if (motion_ != HeadMotion::driven || !course_.is_axial()) return head.d1;
    const double angle = drive_ ? head.angle : course_.angle(time);
    return std::cos(angle) * start_.frame.col(1) + std::sin(angle) * start_.frame.col(2);
}

// ------------------------------------------------------------------ on the strand

Pose Head::pose(const HeadState& head, double time) const {
    if (keeps_pose())
        return {Eigen::Quaterniond(head.quaternion).normalized().toRotationMatrix(), head.position};
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(course_.angle(time), Vector3d::UnitX()).toRotationMatrix();
    return {start_.frame * turn, start_.position};
}

HeadState Head::rate(const HeadState& head, const Vector6& velocity) const {
    const Eigen::Quaterniond q(head.quaternion);
    const Eigen::Quaterniond spin(0, velocity[0], velocity[1], velocity[2]);
    HeadState rate;
    rate.position = pose(head, 0).frame * velocity.tail<3>();
    rate.quaternion = 0.5 * (q * spin).coeffs();
    return rate;
}

Vector6 Head::stress(const Eigen::Matrix3d& frame, double time) const {
    const Eigen::Matrix3d to_body = frame.transpose();
    Vector6 stress;
    stress << to_body * moment_(time), to_body * force_(time);
    return stress;
}

Vector6 Head::holding(const Vector6& wrench, const Eigen::Matrix3d& frame) const {
    Vector6 held = -wrench;
    if (is_pinned()) held.segment<2>(1).setZero();
    if (course_.moves()) held.tail<3>() -= frame.transpose() * weight_;
    return held;
}

void Head::prescribe(Table<StrandRow>& rod, const Vector6& inertia, double time) const {
    if (!is_held()) return;
    const Vector6 momentum = inertia.cwiseProduct(course_.velocity(time));
    hold(rod);
    rod.row(StrandRow::angular_momentum)[0] = momentum[0];
    if (!course_.moves()) return;
    set_momentum(rod, 0, momentum);
}

void Head::hold(Table<StrandRow>& rate) const {
    if (!is_held()) return;
    if (is_pinned())
        rate.row(StrandRow::angular_momentum)[0] = 0.0;
    else
        rate.set(StrandRow::angular_momentum, 0, Vector3d::Zero());
    rate.set(StrandRow::linear_momentum, 0, Vector3d::Zero());
}

Vector3d followed(const Vector3d& d1, const Vector3d& from, const Vector3d& to, double angle) {
    const Vector3d along = carried(d1, from, to);
    return (std::cos(angle) * along + std::sin(angle) * to.cross(along)).normalized();
}

}  // namespace drillstrand
