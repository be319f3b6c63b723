// The autodriller on strings that are springs: against the exact solution of its loop.
#include "rod/autodriller.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace drillstrand {
namespace {

/// Weight on the bit (N) of a spring of 200 kN/m that an autodriller presses, every 0.1 s.
std::vector<double> pressed(const AutodrillerCase& limits, double duration) {
    constexpr double stiffness = 2e5;
    constexpr double step = 1e-3;
    const Autodriller driller(limits);
    HeadState head;
    double weight = 0;
    double speed = 0;
    std::vector<double> weights;
    for (int i = 0; i <= std::lround(duration / step); ++i) {
        if (i % 100 == 0) weights.push_back(weight);
        speed = driller.drum_speed(head, {weight, speed, 0}, i * step, step);
        weight += step * stiffness * speed;
    }
    return weights;
}

TEST(Autodriller, KeepsAWeightAsItsLoopHasIt) {
    // e'' + k g e' + k g/T e = 0 with k g = 0.4/s, T = 10 s: e = W (1 - t/(5 s)) exp(-t/(5 s)), as
    // far as the drum feeds
    AutodrillerCase limits;
    limits.weight = DrillerLoop{100e3, 2e-6, 10};
    const std::vector<double> weight = pressed(limits, 60);
    for (std::size_t i = 0; i < 90; ++i) {
        const double t = 0.02 * static_cast<double>(i);
        EXPECT_NEAR(weight[i], 100e3 * (1 - (1 - t) * std::exp(-t)), 50) << i;
    }
    // it overshoots by exp(-2) of W, and cannot hoist: what is too much stays
    EXPECT_NEAR(*std::max_element(weight.begin(), weight.end()), 100e3 * (1 + std::exp(-2.0)), 100);
}

TEST(Autodriller, LetsTheMostLimitingLoopRuleAndWindsNothingUp) {
    AutodrillerCase limits;
    limits.weight = DrillerLoop{100e3, 2e-6, 10};
    limits.rate = DrillerLoop{0.01, 1, 2};
    const std::vector<double> weight = pressed(limits, 120);
    // 2 kN/s at 0.01 m/s; the weight takes over where it is reached, from where
    // e = - 2 kN/s t exp(-t/(5 s)), until the drum stands still
    for (std::size_t i = 200; i < 450; ++i)
        EXPECT_NEAR((weight[i + 10] - weight[i]) / 1.0, 2e3, 40) << i;
    EXPECT_NEAR(*std::max_element(weight.begin(), weight.end()), 100e3 + 10e3 * std::exp(-1.0),
                100);
}

}  // namespace
}  // namespace drillstrand
