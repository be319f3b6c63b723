#include "statics/lock_up.hpp"

#include <cmath>
#include <limits>

#include "numerics/bracketed_root.hpp"
#include "statics/tripping.hpp"

namespace drillstrand {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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
        if (!(curve.hook_load[i - 1] > 0 && curve.hook_load[i] <= 0)) continue;
        const auto hook_load = [&](double depth) {
            return hook_load_at(input, depth, curve.motion);
        };
        return bracketed_root(hook_load, {bit_depth[i], curve.hook_load[i]},
                              {bit_depth[i - 1], curve.hook_load[i - 1]}, close);
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
    if (!(none.value > 0)) return none.value <= 0 ? 0 : nan;
    Trial enough = none;
    // what is on the hook without weight on the bit is the least that takes all of it away
    for (double weight = none.value; enough.value > 0; weight *= 1.5)
        enough = {weight, hook_load(weight)};
    return std::isnan(enough.value) ? nan : bracketed_root(hook_load, enough, none, close);
}

}  // namespace drillstrand
