#include "input/descent.hpp"

#include <algorithm>
#include <vector>

#include "drillstrand/schedule_parts.hpp"

namespace drillstrand {

namespace {

/// Times at which a place may be deepest: ends, and where the speed changes its sign.
std::vector<double> turning_times(const ScalarSchedule& speed, double duration) {
    std::vector<double> times{0.0};
    const std::vector<double>& t = speed.times();
    const std::vector<double>& v = speed.values();
    for (std::size_t k = 0; k < t.size(); ++k) {
        times.push_back(t[k]);
        if (k > 0 && v[k - 1] * v[k] < 0)
            times.push_back(t[k - 1] + (t[k] - t[k - 1]) * v[k - 1] / (v[k - 1] - v[k]));
    }
    times.push_back(duration);
    return times;
}

}  // namespace

Descent deepest_descent(const HeadCase& head, double duration) {
    const ScalarSchedule speed = head.hoist ? head.hoist->block_speed : part_of_d3(head.velocity);
    const double end = duration > 0 ? duration : std::max(0.0, speed.times().back());
    Descent deepest;
    for (const double time : turning_times(speed, end)) {
        if (time < 0 || time > end) continue;
        const double depth = speed.integral(time);
        if (depth > deepest.depth) deepest = {depth, time};
    }
    return deepest;
}

}  // namespace drillstrand
