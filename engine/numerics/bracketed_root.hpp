/// Zeros of functions of one number that are dear or jump.
#pragma once

#include <cmath>

namespace drillstrand {

/// A place, and the value of a function there.
struct Trial {
    double at;
    double value;
};

/// Where a function passes 0 between two places, `below` with a value under 0 and `above` with one
/// over it, to within `close`: regula falsi, with the value of an end that stays halved (Illinois).
/// NaN where a value between is.
template <class Function>
double bracketed_root(const Function& function, Trial below, Trial above, double close) {
    constexpr int most_rounds = 200;
    int side = 0;
    for (int i = 0; i < most_rounds && std::abs(above.at - below.at) > close; ++i) {
        // every third round halves: jumps and flat parts then cost no more than that
        const bool halves = i % 3 == 2;
        const double at =
            halves ? 0.5 * (below.at + above.at)
                   : below.at - below.value * (above.at - below.at) / (above.value - below.value);
        const double value = function(at);
        if (value == 0 || std::isnan(value)) return value == 0 ? at : value;
        if (value < 0) {
            below = {at, value};
            if (side < 0) above.value *= 0.5;
            side = -1;
        } else {
            above = {at, value};
            if (side > 0) below.value *= 0.5;
            side = 1;
        }
    }
    return 0.5 * (below.at + above.at);
}

}  // namespace drillstrand
