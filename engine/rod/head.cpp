#include "rod/head.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace drillstrand {

using Eigen::Vector3d;

namespace {

double torque_on_head(const Table<SegmentRow>& segments) {
    return segments.row(SegmentRow::torque)[0] + segments.row(SegmentRow::viscous_torque)[0];
}

}  // namespace

Head::Head(const Scene& scene)
    : motion_(scene.head.motion),
      rotation_(scene.head.rotation),
      force_(scene.head.force),
      moment_(scene.head.moment),
      start_{scene.head_frame, scene.head_position},
      polar_inertia_(scene.mesh.node.front().polar_inertia),
      cell_(scene.mesh.cell.front()),
      weight_(cell_ * scene.weight.front() * scene.down) {
    if (scene.head.drive) drive_.emplace(*scene.head.drive, scene);
}

double Head::driven_rate(double time) const {
    return is_driven() ? rotation_(time) : 0.0;
}

double Head::opposed_rate(double time, double bit_rate) const {
    return is_driven() ? rotation_(time) : bit_rate;
}

HeadState Head::start() const {
    HeadState head;
    head.d1 = start_.frame.col(1);
    head.position = start_.position;
    head.quaternion = Eigen::Quaterniond(start_.frame).coeffs();
    return head;
}

double Head::hook_load(const Vector3d& pull, double time) const {
    const Vector3d d3 = start_.frame.col(0);
    return is_driven() ? (pull + weight_).dot(d3) : -force_(time).dot(d3);
}

double Head::surface_torque(double torque, double time) const {
    return is_driven() ? -torque : moment_(time).dot(start_.frame.col(0));
}

// ------------------------------------------------------------------ on directors

void Head::load(Table<SegmentRow>& segments, const Table<DirectorRow>& rod, double time) const {
    if (is_driven()) return;
    write_end_load(segments, -1, {-force_(time), -moment_(time)},
                   rod.vector(DirectorRow::director, 0));
}

void Head::finish(HeadState& head, const Table<SegmentRow>& segments, const Table<DirectorRow>& rod,
                  Table<DirectorRow>& next, const DirectorStep& step) const {
    const Vector3d t = rod.vector(DirectorRow::director, 0);
    const double spin = rod.row(DirectorRow::spin)[0];
    if (!is_driven()) {
        const auto mean = [&](DirectorRow row) {
            return Vector3d(0.5 * (rod.vector(row, 0) + next.vector(row, 0)));
        };
        const double next_spin = next.row(DirectorRow::spin)[0];
        const Vector3d moment = moment_(step.time);
        head.work += step.kick * (force_(step.time).dot(mean(DirectorRow::velocity)) +
                                  moment.dot(mean(DirectorRow::angular_velocity)) +
                                  moment.dot(t) * 0.5 * (spin + next_spin));
        head.d1 =
            followed(head.d1, t, next.vector(DirectorRow::director, 0), step.drift * next_spin);
        return;
    }
    const double rate = next_rate(head, segments, spin, step);
    next.set(DirectorRow::position, 0, rod.vector(DirectorRow::position, 0));
    next.set(DirectorRow::velocity, 0, Vector3d::Zero());
    next.set(DirectorRow::director, 0, t);
    next.set(DirectorRow::angular_velocity, 0, Vector3d::Zero());
    next.set(DirectorRow::material, 0, d1(head, step.time + step.drift));
    next.row(DirectorRow::spin)[0] = rate;
    head.work -= step.kick * segments.row(SegmentRow::torque)[0] * 0.5 * (spin + rate);
}

double Head::next_rate(HeadState& head, const Table<SegmentRow>& segments, double rate,
                       const DirectorStep& step) const {
    const double turn = rotation_.integral(step.time + step.drift) - rotation_.integral(step.time);
    if (!drive_) return step.drift > 0 ? turn / step.drift : rotation_(step.time);
    const DriveDemand demand{rotation_(step.time), turn, torque_on_head(segments), step.kick,
                             step.drift};
    return drive_->advance(head, rate, demand);
}

void Head::settle(const HeadState& head, const Table<SegmentRow>& segments, double rate,
                  Table<DirectorRow>& rod, double time, double half_kick) const {
    if (!is_driven()) return;
    rod.set(DirectorRow::velocity, 0, Vector3d::Zero());
    rod.set(DirectorRow::angular_velocity, 0, Vector3d::Zero());
    double& spin = rod.row(DirectorRow::spin)[0];
    spin = drive_ ? rate : rotation_(time);
    if (drive_ && half_kick > 0) {
        HeadState copy = head;
        spin = drive_->advance(copy, rate,
                               {rotation_(time), 0, torque_on_head(segments), half_kick, 0});
    }
}

Vector3d Head::d1(const HeadState& head, double time) const {
    if (!is_driven()) return head.d1;
    const double angle = drive_ ? head.angle : rotation_.integral(time);
    return std::cos(angle) * start_.frame.col(1) + std::sin(angle) * start_.frame.col(2);
}

// ------------------------------------------------------------------ on the strand

Pose Head::pose(const HeadState& head, double time) const {
    if (!is_driven())
        return {Eigen::Quaterniond(head.quaternion).normalized().toRotationMatrix(), head.position};
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(rotation_.integral(time), Vector3d::UnitX()).toRotationMatrix();
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

void Head::prescribe(Table<StrandRow>& rod, double time) const {
    if (!is_driven()) return;
    hold(rod);
    rod.row(StrandRow::angular_momentum)[0] = polar_inertia_ * rotation_(time);
}

void Head::hold(Table<StrandRow>& rate) const {
    if (!is_driven()) return;
    rate.set(StrandRow::angular_momentum, 0, Vector3d::Zero());
    rate.set(StrandRow::linear_momentum, 0, Vector3d::Zero());
}

Vector3d followed(const Vector3d& d1, const Vector3d& from, const Vector3d& to, double angle) {
    const Vector3d along = carried(d1, from, to);
    return (std::cos(angle) * along + std::sin(angle) * to.cross(along)).normalized();
}

}  // namespace drillstrand
