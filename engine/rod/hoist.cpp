#include "rod/hoist.hpp"

#include <algorithm>

namespace drillstrand {

Hoist::Hoist(const Scene& scene)
    : weight_(scene.head.hoist->mass * scene.gravity * scene.down.dot(scene.head_frame.col(0))),
      inertia_(scene.head.hoist->mass + scene.mesh.node.front().mass * scene.mesh.cell.front()),
      stiffness_(scene.head.hoist->lines * scene.head.hoist->line_stiffness),
      lines_(scene.head.hoist->lines),
      block_speed_(scene.head.hoist->block_speed),
      brake_(scene.head.hoist->hook_load),
      slips_(scene.head.slips) {
    if (scene.head.hoist->autodriller) autodriller_.emplace(*scene.head.hoist->autodriller);
}

void Hoist::hang(HeadState& head, double pull) const {
    head.stretch = (pull + weight_) / stiffness_;
    if (autodriller_) head.off_bottom_load = autodriller_->off_bottom_load().value_or(pull);
}

double Hoist::tension(const HeadState& head) const {
    return stiffness_ * std::max(head.stretch, 0.0);
}

double Hoist::dead_line_tension(const HeadState& head, double time) const {
    return (is_in_slips(time) ? weight_ : tension(head)) / lines_;
}

bool Hoist::is_in_slips(double time) const {
    return std::any_of(slips_.begin(), slips_.end(), [time](const TimeSpan& span) {
        return time >= span.begin && time < span.end;
    });
}

double Hoist::kicked(const HeadState& head, double speed, double pull, double time, double kick,
                     double step) const {
    if (is_in_slips(time)) return 0.0;
    // of the trapezoidal rule, which is stable for lines of any stiffness
    const double inertia = inertia_ + 0.25 * stiffness_ * step * step;
    return speed + kick * (pull + weight_ - tension(head)) / inertia;
}

double Hoist::fed(HeadState& head, double speed, const HoistLoad& load,
                  const DirectorStep& step) const {
    if (!autodriller_)
        return block_speed_.integral(step.time + step.drift) - block_speed_.integral(step.time);
    const double hook_load = tension(head) - weight_;
    const DrillerReadings readings{head.off_bottom_load - hook_load, speed, load.torque,
                                   step.motor_pressure};
    return step.drift * autodriller_->drum_speed(head, readings, step.time, step.drift);
}

double Hoist::advance(HeadState& head, double speed, const HoistLoad& load,
                      const DirectorStep& step) const {
    if (is_in_slips(step.time)) return 0.0;
    const double next = kicked(head, speed, load.pull, step.time, step.kick, step.drift);
    head.stretch += step.drift * next - fed(head, speed, load, step);
    if (brake_) {
        const double held = (*brake_)(step.time + step.drift) + weight_;
        head.stretch = std::min(head.stretch, held / stiffness_);
    }
    return next;
}

}  // namespace drillstrand
