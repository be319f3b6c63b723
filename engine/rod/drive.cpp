#include "rod/drive.hpp"

#include <algorithm>
#include <cmath>

namespace drillstrand {

Drive::Drive(const DriveCase& drive, const Scene& scene)
    : stiff_(drive.control == DriveControl::stiff),
      inertia_(scene.mesh.node.front().polar_inertia * scene.mesh.cell.front()),
      proportional_(drive.proportional),
      integral_(drive.integral),
      torque_limit_(drive.torque_limit),
      power_limit_(drive.power_limit) {
    const double zeta = impedance(scene.mesh.segment.front());
    // a matched drive takes the inertia on itself
    if (drive.control != DriveControl::matched) inertia_ += drive.inertia;
    if (drive.control == DriveControl::tuned) {
        proportional_ = drive.impedance_factor * zeta;
        integral_ = drive.inertia * drive.frequency * drive.frequency;
    }
    if (drive.control == DriveControl::matched) {
        proportional_ = zeta;
        integral_ = drive.filter > 0 ? zeta / drive.filter : 0.0;
    }
}

double Drive::impedance(const SectionProperties& pipe) {
    return std::sqrt(pipe.polar_inertia * pipe.torsional_stiffness);
}

double Drive::unlimited(const HeadState& head, double rate, const DriveDemand& demand) const {
    if (stiff_) return demand.drift > 0 ? demand.turn / demand.drift : demand.rate;
    const double torque = integral_ * head.lag + demand.string_torque;
    if (proportional_ == 0) return rate + demand.kick * torque / inertia_;
    // the flow of J dw/dt = K_p (set - w) + torque: exact for any K_p
    const double settled = demand.rate + torque / proportional_;
    return settled + (rate - settled) * std::exp(-demand.kick * proportional_ / inertia_);
}

double Drive::limited(double torque, double rate, const DriveDemand& demand) const {
    torque = std::clamp(torque, -torque_limit_, torque_limit_);
    // what drives at full power falls with the rate that it leads to: w (w - free) = mobility P
    const double mobility = demand.kick / inertia_;
    const double free = rate + mobility * demand.string_torque;
    if (torque * (free + mobility * torque) <= power_limit_) return torque;
    const double along = std::copysign(free, torque * free);
    const double next = 0.5 * (along + std::sqrt(along * along + 4 * mobility * power_limit_));
    return std::copysign((next - along) / mobility, torque);
}

double Drive::advance(HeadState& head, double rate, const DriveDemand& demand) const {
    double next = unlimited(head, rate, demand);
    bool is_limited = false;
    if (demand.kick > 0) {
        const double wanted = inertia_ * (next - rate) / demand.kick - demand.string_torque;
        head.drive_torque = limited(wanted, rate, demand);
        is_limited = head.drive_torque != wanted;
        if (is_limited)
            next = rate + demand.kick * (head.drive_torque + demand.string_torque) / inertia_;
    }
    // what a drive at its limit lags behind it does not make good later
    if (!is_limited) head.lag += demand.turn - demand.drift * next;
    head.angle += demand.drift * next;
    return next;
}

}  // namespace drillstrand
