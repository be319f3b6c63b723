#include "model/survey.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drillstrand/well.hpp"
#include "model/published_survey.hpp"

namespace drillstrand {
namespace {

using test::degree;

// Printed to 0.01 in the source, from stations that may themselves be rounded to 0.01.
constexpr double published_rounding = 0.01;

TEST(Survey, TextbookStationsGiveThePublishedPosition) {
    // Lengths in feet: the formulas do not know the unit.
    const std::vector<SurveyStation> survey{{3500, 15 * degree, 20 * degree},
                                            {3600, 25 * degree, 45 * degree}};
    const Eigen::Vector3d end = station_positions(survey).back();
    // drillingformulas.com prints 27.22, 19.45, 94.01.
    EXPECT_NEAR(end.x(), 27.22, 0.005);
    EXPECT_NEAR(end.y(), 19.45, 0.005);
    EXPECT_NEAR(end.z(), 94.01, 0.005);
    // The same closed form in extended precision.
    EXPECT_NEAR(end.x(), 27.21832856975436, 1e-11);
    EXPECT_NEAR(end.y(), 19.45077374667728, 1e-11);
    EXPECT_NEAR(end.z(), 94.01234323216107, 1e-11);
    EXPECT_NEAR(dogleg_severities(survey).front() * 100, 12.951650724128202 * degree, 1e-14);
}

TEST(Survey, SecondTextbookPairGivesThePublishedDoglegSeverity) {
    const std::vector<SurveyStation> survey{{6750, 30.9 * degree, 78.2 * degree},
                                            {7050, 43.2 * degree, 100.6 * degree}};
    const Eigen::Vector3d end = station_positions(survey).back();
    EXPECT_NEAR(end.x(), -3.1622707678722555, 1e-11);
    EXPECT_NEAR(end.y(), 177.81423705163616, 1e-11);
    EXPECT_NEAR(end.z(), 240.05454188718468, 1e-11);
    EXPECT_NEAR(dogleg_severities(survey).front() * 100, 6.033055729192244 * degree, 1e-14);
}

class PublishedSurveyTest : public testing::TestWithParam<std::string> {};

TEST_P(PublishedSurveyTest, PositionsAgreeWithThePublishedOnes) {
    const test::PublishedSurvey survey = test::read_published_survey(GetParam());
    const std::vector<Eigen::Vector3d> positions = station_positions(survey.stations);
    ASSERT_EQ(positions.size(), survey.positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(positions[k][axis], survey.positions[k][axis], published_rounding + 1e-9)
                << "station at " << survey.stations[k].measured_depth << " m, axis " << axis;
}

INSTANTIATE_TEST_SUITE_P(Wells, PublishedSurveyTest,
                         testing::Values("ullrigg_U1.csv", "ullrigg_U3.csv", "ullrigg_U4.csv",
                                         "ullrigg_U4Lat.csv", "ullrigg_U5.csv", "ullrigg_U6.csv",
                                         "ullrigg_U6B.csv", "ullrigg_U7.csv",
                                         "iscwsa_reference.csv"),
                         [](const auto& instance) {
                             return instance.param.substr(0, instance.param.find('.'));
                         });

TEST(Survey, SmallDoglegsKeepTheirDigits) {
    // The arc cosine of the tangents' product would give zero below 1e-8 rad.
    for (const double turn : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const std::vector<SurveyStation> survey{{0, 0, 0}, {30, turn, 0}};
        EXPECT_NEAR(dogleg_severities(survey).front() * 30 / turn, 1.0, 1e-9) << turn;
        const double offset = station_positions(survey).back().x();
        EXPECT_NEAR(offset / (15 * turn), 1.0, 1e-6) << turn;  // arc: L/2 times the angle
    }
}

TEST(Survey, AzimuthMeansNothingInAVerticalHole) {
    const std::vector<SurveyStation> survey{{0, 0, 0}, {30, 0, 2.0}, {60, 0, 5.0}};
    EXPECT_EQ(station_positions(survey).back(), Eigen::Vector3d(0, 0, 60));
    EXPECT_EQ(dogleg_severities(survey), (std::vector<double>{0, 0}));
}

TEST(Survey, CompassAndDepthAreNorthEastDown) {
    const auto end_of = [](double inclination, double azimuth) {
        return station_positions({{0, inclination, azimuth}, {10, inclination, azimuth}}).back();
    };
    EXPECT_LT((end_of(90 * degree, 0) - Eigen::Vector3d(10, 0, 0)).norm(), 1e-14);
    EXPECT_LT((end_of(90 * degree, 90 * degree) - Eigen::Vector3d(0, 10, 0)).norm(), 1e-14);
    EXPECT_LT((end_of(0, 0) - Eigen::Vector3d(0, 0, 10)).norm(), 1e-14);
}

}  // namespace
}  // namespace drillstrand
