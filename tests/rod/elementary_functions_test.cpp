#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "numerics/vector_math.hpp"

namespace drillstrand {
namespace {

/// Distance from the exact value in units in the last place of the nearest double.
double ulps(double found, long double exact) {
    const double nearest = std::abs(static_cast<double>(exact));
    const double unit = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
    return static_cast<double>(std::abs(static_cast<long double>(found) - exact) /
                               static_cast<long double>(unit));
}

/// Calls check(x) for x spread evenly over the decades from `low` to `high`.
template <class Check>
void over_decades(double low, double high, const Check& check) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(std::log(low), std::log(high));
    for (int i = 0; i < 200000; ++i)
        check(std::exp(exponent(random)));
}

/// (t - sin t) / t^3 without cancellation.
long double difference_factor(long double t) {
    if (t > 0.5L) return (t - std::sin(t)) / (t * t * t);
    long double term = 1.0L / 6;
    long double sum = 0;
    for (int n = 1; n < 20; ++n) {
        sum += term;
        term *= -t * t / static_cast<long double>((2 * n + 2) * (2 * n + 3));
    }
    return sum;
}

TEST(ElementaryFunctions, RotationFactorsAreExactToRoundingUpToHalfATurn) {
    double worst = 0;
    over_decades(1e-160, std::numbers::pi * std::numbers::pi, [&](double t2) {
        const long double t = std::sqrt(static_cast<long double>(t2));
        const long double half = std::sin(t / 2);
        const RotationFactors f = rotation_factors(t2);
        // sin t / t passes through zero at t = pi: its error counts in units of its largest value
        EXPECT_LT(std::abs(static_cast<long double>(f.sine) - std::sin(t) / t),
                  3 * std::numeric_limits<double>::epsilon());
        worst = std::max({worst, ulps(f.cosine, 2 * half * half / (t * t)),
                          ulps(f.difference, difference_factor(t))});
    });
    EXPECT_LT(worst, 4);
    const RotationFactors none = rotation_factors(0.0);
    EXPECT_EQ(none.sine, 1.0);
    EXPECT_EQ(none.cosine, 0.5);
    EXPECT_EQ(none.difference, 1.0 / 6);
}

TEST(ElementaryFunctions, LogarithmAgreesWithTheMathematicsLibrary) {
    double worst = 0;
    over_decades(1e-300, 1e300, [&](double y) {
        worst =
            std::max(worst, ulps(log1p_nonnegative(y), std::log1p(static_cast<long double>(y))));
    });
    over_decades(1e-3, 1e3, [&](double y) {
        worst =
            std::max(worst, ulps(log1p_nonnegative(y), std::log1p(static_cast<long double>(y))));
    });
    EXPECT_LT(worst, 4);
    EXPECT_EQ(log1p_nonnegative(0.0), 0.0);
}

TEST(ElementaryFunctions, ExponentialAgreesWithTheMathematicsLibrary) {
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const double x = 1e-4 * i;
        worst = std::max(worst, std::abs(exp_of_minus(x) / std::exp(-x) - 1));
    }
    EXPECT_LT(worst, 1e-11);
    EXPECT_EQ(exp_of_minus(0.0), 1.0);
}

TEST(ElementaryFunctions, ArctangentRatioAgreesWithTheMathematicsLibrary) {
    double worst = 0;
    for (int i = 1; i <= 100000; ++i) {
        const double u = 1e-5 * i;  // up to a right angle between directors
        worst = std::max(worst, std::abs(arctangent_ratio(u * u) / (std::atan(u) / u) - 1));
    }
    EXPECT_LT(worst, 5e-14);
    EXPECT_NEAR(arctangent_ratio(0.0), 1.0, 5e-14);
}

}  // namespace
}  // namespace drillstrand
