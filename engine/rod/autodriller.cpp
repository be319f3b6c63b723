#include "rod/autodriller.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace drillstrand {

std::array<std::optional<DrillerLoop>, 4> driller_loops(const AutodrillerCase& autodriller) {
    return {autodriller.weight, autodriller.rate, autodriller.torque, autodriller.pressure};
}

Autodriller::Autodriller(const AutodrillerCase& autodriller)
    : loops_(driller_loops(autodriller)), off_bottom_load_(autodriller.off_bottom_load) {}

double Autodriller::drum_speed(HeadState& head, const DrillerReadings& readings, double time,
                               double step) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < loops_.size(); ++i) {
        if (!loops_[i]) continue;
        const double error = loops_[i]->limit(time) - readings[i];
        least = std::min(least, loops_[i]->gain * error + head.resets[static_cast<int>(i)]);
    }
    const double speed = std::max(least, 0.0);
    for (std::size_t i = 0; i < loops_.size(); ++i) {
        if (!loops_[i]) continue;
        double& reset = head.resets[static_cast<int>(i)];
        reset += std::min(1.0, step / loops_[i]->reset_time) * (speed - reset);
    }
    return speed;
}

}  // namespace drillstrand
