// The tortuosity that planners add to a survey.
#include "input/tortuosity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

const std::vector<SurveyStation> straight{{0, 1, 0.5}, {600, 1, 0.5}};

Tortuosity of(TortuosityModel model) {
    return {.model = model,
            .build = 0.5 * degree,
            .turn = 0.3 * degree,
            .period = 60,
            .seed = 7,
            .from = 0,
            .to = 600};
}

TEST(Tortuosity, OfASineIsThatOfInclinationAndOfTheTurnAcrossIt) {
    const std::vector<SurveyStation> found = with_tortuosity(straight, of(TortuosityModel::sine));
    ASSERT_EQ(found.size(), 121U);
    for (std::size_t k = 0; k < found.size(); ++k) {
        const SurveyStation& station = found[k];
        EXPECT_NEAR(station.measured_depth, 5.0 * static_cast<double>(k), 1e-9);
        const double sine = std::sin(2 * pi * station.measured_depth / 60);
        // the planner's azimuth changes by the turn over the sine of the inclination
        EXPECT_NEAR(station.inclination, 1 + 0.5 * degree * sine, 1e-4 * degree + 2e-5);
        EXPECT_NEAR(station.azimuth, 0.5 + 0.3 * degree * sine / std::sin(1.0), 1e-4);
    }
}

TEST(Tortuosity, OfAHelixLeavesTheDirectionByItsAmplitudeAllAround) {
    Tortuosity helix = of(TortuosityModel::helical);
    helix.turn = helix.build;
    const std::vector<SurveyStation> found = with_tortuosity(straight, helix);
    EXPECT_EQ(found.front().inclination, 1);
    EXPECT_EQ(found.front().azimuth, 0.5);
    for (const SurveyStation& station : found) {
        if (station.measured_depth < 60) continue;
        const double cosine =
            std::cos(station.inclination) * std::cos(1.0) +
            std::sin(station.inclination) * std::sin(1.0) * std::cos(station.azimuth - 0.5);
        EXPECT_NEAR(std::acos(cosine), 0.5 * degree, 1e-9);
    }
}

TEST(Tortuosity, AtRandomKeepsWithinItsAmplitudeAndIsTheSameForTheSameSeed) {
    const Tortuosity seven = of(TortuosityModel::random);
    Tortuosity eight = seven;
    eight.seed = 8;
    const auto a = with_tortuosity(straight, seven);
    const auto b = with_tortuosity(straight, seven);
    const auto c = with_tortuosity(straight, eight);
    ASSERT_EQ(a.size(), 11U);
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a[k].inclination, b[k].inclination);
        EXPECT_EQ(a[k].azimuth, b[k].azimuth);
        if (k > 0) {
            EXPECT_NE(a[k].inclination, c[k].inclination);
        }
        most = std::max(most, std::abs(a[k].inclination - 1));
    }
    EXPECT_LT(most, 0.5 * degree + 2e-5);
    EXPECT_GT(most, 0.1 * degree);
    // splitmix64 of seed 7, as its authors' code gives it: the same on every machine
    EXPECT_NEAR(a[1].inclination, 1.0069948335666228, 1e-12);
}

TEST(Tortuosity, LeavesTheSurveyOutsideItsStretchAndKeepsItsStations) {
    const std::vector<SurveyStation> bent{{0, 0, 0}, {200, 0.3, 0.2}, {333, 0.5, 0.4}, {600, 1, 1}};
    Tortuosity sine = of(TortuosityModel::sine);
    sine.from = 150;
    sine.to = 420;
    const auto found = with_tortuosity(bent, sine);
    EXPECT_EQ(found.front().inclination, 0);
    EXPECT_EQ(found.back().azimuth, 1);
    for (std::size_t k = 1; k < found.size(); ++k)
        EXPECT_GT(found[k].measured_depth, found[k - 1].measured_depth);
    for (const SurveyStation& station : bent)
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const SurveyStation& other) {
            return other.measured_depth == station.measured_depth;
        }));
    // 150, 155, ..., 420 besides the four of the survey, of which 200 is one of these
    EXPECT_EQ(found.size(), 55U + 3U);
}

TEST(Tortuosity, OfAVerticalHoleIsInThePlaneOfTheStatedAzimuth) {
    const std::vector<SurveyStation> vertical{{0, 0, 0.7}, {600, 0, 0.7}};
    Tortuosity sine = of(TortuosityModel::sine);
    sine.turn = 0;
    for (const SurveyStation& station : with_tortuosity(vertical, sine)) {
        const double tilt = 0.5 * degree * std::sin(2 * pi * station.measured_depth / 60);
        EXPECT_NEAR(station.inclination, std::abs(tilt), 1e-12);
        if (std::abs(tilt) < 1e-9) continue;
        EXPECT_NEAR(station.azimuth, tilt > 0 ? 0.7 : 0.7 + pi, 1e-9);
    }
}

}  // namespace
}  // namespace drillstrand
