/// Limits of compression against hand values and closed forms.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "statics/buckling_limits.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

// Pipe of 0.14 m x 0.12 m in a hole of 0.22 m: sqrt(EI w / r) = 108729.2 N
constexpr double stiffness = 1735729.9411;
constexpr double weight = 272.43968589;
constexpr double clearance = 0.04;

/// In a well that runs north, inclined, and bends upward (positive) or downward.
LyingString pipe(double inclination, double build_rate = 0, double pipe_weight = weight) {
    const Vector3d direction(std::sin(inclination), 0, std::cos(inclination));
    const Vector3d upward(std::cos(inclination), 0, -std::sin(inclination));
    return {stiffness, pipe_weight, clearance, direction, build_rate * upward, Vector3d::UnitZ()};
}

TEST(BucklingLimits, InHorizontalWellAreThoseOfDawsonPaslayAndChenLinCheatham) {
    const BucklingLimits limits = buckling_limits(pipe(90 * degree));
    EXPECT_NEAR(limits.sinusoidal, 217458.4, 1);
    EXPECT_NEAR(limits.helical, 307532.6, 1);
}

TEST(BucklingLimits, GrowWithTheRootOfTheSineOfTheInclination) {
    const BucklingLimits limits = buckling_limits(pipe(30 * degree));
    EXPECT_NEAR(limits.sinusoidal, 217458.4 / std::sqrt(2.0), 1);
    EXPECT_NEAR(limits.helical, 307532.6 / std::sqrt(2.0), 1);
}

TEST(BucklingLimits, InVerticalWellAreLubinskisAndThatOfTheFirstHelix) {
    const BucklingLimits limits = buckling_limits(pipe(0));
    EXPECT_NEAR(limits.sinusoidal, 9798, 1);
    EXPECT_NEAR(limits.helical, 28031, 1);
}

TEST(BucklingLimits, WithoutWeightInBendAreFourAndEightTimesStiffnessAndCurvatureOverClearance) {
    const double curvature = 1.0 / 500;
    for (const double sign : {-1.0, 1.0}) {
        const BucklingLimits limits = buckling_limits(pipe(60 * degree, sign * curvature, 0));
        EXPECT_NEAR(limits.sinusoidal, 4 * stiffness * curvature / clearance, 1e-3);
        EXPECT_NEAR(limits.helical, 8 * stiffness * curvature / clearance, 1e-3);
    }
}

/// The root of F^2 = c (w_perp + sign kappa F).
double planar_limit(double c, double lateral_weight, double signed_curvature) {
    const double half = 0.5 * c * signed_curvature;
    return half + std::sqrt(half * half + c * lateral_weight);
}

TEST(BucklingLimits, RiseWhereTheWellBuildsAndFallWhereItDrops) {
    const double c = 4 * stiffness / clearance;
    for (const double inclination : {20 * degree, 60 * degree, 90 * degree}) {
        for (const double curvature : {1e-5, 1e-4, 1.0 / 1500}) {
            const double lateral = weight * std::sin(inclination);
            EXPECT_NEAR(buckling_limits(pipe(inclination, curvature)).sinusoidal,
                        planar_limit(c, lateral, curvature), 1e-3);
            EXPECT_NEAR(buckling_limits(pipe(inclination, -curvature)).sinusoidal,
                        planar_limit(c, lateral, -curvature), 1e-3);
        }
    }
}

TEST(BucklingLimits, InTurnCountWeightAndCompressionAtRightAngles) {
    LyingString turning = pipe(90 * degree);
    turning.curvature = Vector3d::UnitY() / 800;
    const double force = buckling_limits(turning).sinusoidal;
    EXPECT_NEAR(force * force, 4 * stiffness / clearance * std::hypot(weight, force / 800),
                1e-6 * force * force);
}

}  // namespace
}  // namespace drillstrand
