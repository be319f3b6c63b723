#include "statics/lock_up.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "statics/tripping.hpp"

namespace drillstrand {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A place on an axis, and the hook load there (N).
struct Trial {
    double at;
    double hook_load;
};

/// Where the hook load passes 0 between two trials, to within `close`: regula falsi, with the load
/// of an end that stays halved (Illinois). None where a trial has no equilibrium.
template <class HookLoad>
std::optional<double> zero_between(Trial low, Trial high, double close, const HookLoad& hook_load) {
    constexpr int most_trials = 60;
    int kept = 0;
    for (int i = 0; i < most_trials && std::abs(high.at - low.at) > close; ++i) {
        const double share = low.hook_load / (low.hook_load - high.hook_load);
        Trial between{low.at + share * (high.at - low.at), 0};
        between.hook_load = hook_load(between.at);
        if (!std::isfinite(between.hook_load)) return std::nullopt;
        if (std::abs(between.hook_load) < 1) return between.at;
        if (between.hook_load > 0) {
            if (kept > 0) high.hook_load *= 0.5;
            low = between;
            kept = 1;
        } else {
            if (kept < 0) low.hook_load *= 0.5;
            high = between;
            kept = -1;
        }
    }
    return low.at;
}

double hook_load_at(const Case& input, double bit_depth, TorqueDragMotion motion) {
    const TrippedString string = string_at(input, bit_depth);
    return Tripping(string).answer(motion).hook_load;
}

}  // namespace

bool goes_by_its_weight(TorqueDragMotion motion) {
    return motion == TorqueDragMotion::tripping_in || motion == TorqueDragMotion::sliding;
}

double lock_up_depth(const Case& input, const std::vector<double>& bit_depth,
                     const TorqueDragCurve& curve) {
    if (!goes_by_its_weight(curve.motion)) return nan;
    constexpr double close = 0.05;  // m
    for (std::size_t i = 1; i < bit_depth.size(); ++i) {
        const Trial above{bit_depth[i - 1], curve.hook_load[i - 1]};
        const Trial below{bit_depth[i], curve.hook_load[i]};
        if (!(above.hook_load > 0 && below.hook_load <= 0)) continue;
        const auto hook_load = [&](double depth) {
            return hook_load_at(input, depth, curve.motion);
        };
        return zero_between(above, below, close, hook_load).value_or(nan);
    }
    return nan;
}

double largest_weight(const Case& input, double bit_depth) {
    const auto hook_load = [&](double weight) {
        Case loaded = input;
        loaded.bit.weight = weight;
        return hook_load_at(loaded, bit_depth, TorqueDragMotion::sliding);
    };
    constexpr double close = 10;  // N
    const Trial none{0, hook_load(0)};
    if (!(none.hook_load > 0)) return none.hook_load <= 0 ? 0 : nan;
    Trial enough = none;
    // what is on the hook without weight on the bit is the least that takes all of it away
    for (double weight = none.hook_load; enough.hook_load > 0; weight *= 1.5) {
        enough = {weight, hook_load(weight)};
        if (!std::isfinite(enough.hook_load)) return nan;
    }
    return zero_between(none, enough, close, hook_load).value_or(nan);
}

}  // namespace drillstrand
