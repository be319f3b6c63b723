#include "drillstrand/well.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stdexcept>

#include "model/published_survey.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using test::degree;

// Positions are sums of some hundred arcs over some kilometres: rounding stays below this (m).
constexpr double rounding = 1e-9;

Vector3d random_unit(std::mt19937& random) {
    std::normal_distribution<double> gauss;
    return Vector3d(gauss(random), gauss(random), gauss(random)).normalized();
}

/// Stations whose directions wander, as deviated wells do.
WellCase random_well(std::mt19937& random) {
    std::uniform_real_distribution<double> step(10, 40);
    std::normal_distribution<double> turn(0, 3 * degree);
    WellCase well;
    SurveyStation station{0, 20 * degree, 1.0};
    for (int k = 0; k < 30; ++k) {
        well.survey.push_back(station);
        station.measured_depth += step(random);
        station.inclination = std::abs(station.inclination + turn(random));
        station.azimuth += 2 * turn(random);
    }
    well.sections = {{200, 0.40}, {350, 0.31}, {1e4, 0.22}};
    return well;
}

/// A point of the cross section at a measured depth, `distance` from the axis.
Vector3d point_in_section(const Well& well, double measured_depth, double distance,
                          std::mt19937& random) {
    const WellCrossSection section = well.at(measured_depth);
    const Vector3d across = section.direction.cross(random_unit(random)).normalized();
    return section.axis + distance * across;
}

/// Measured depth of the nearest point of the axis: dense samples, then golden-section search.
double brute_force_depth(const Well& well, const Vector3d& point) {
    const auto distance = [&](double depth) { return (well.at(depth).axis - point).norm(); };
    const double spacing = 0.5;
    double best = well.measured_depth_start() - 20;
    for (double depth = best; depth <= well.measured_depth_end() + 20; depth += spacing)
        if (distance(depth) < distance(best)) best = depth;
    double low = best - spacing;
    double high = best + spacing;
    const double golden = 0.6180339887498949;
    while (high - low > 1e-7) {
        const double left = high - golden * (high - low);
        const double right = low + golden * (high - low);
        (distance(left) < distance(right) ? high : low) =
            distance(left) < distance(right) ? right : left;
    }
    return 0.5 * (low + high);
}

TEST(Well, FootPointIsTheNearestPointOfTheAxis) {
    std::mt19937 random(20240601);
    for (int k = 0; k < 5; ++k) {
        const Well well(random_well(random));
        std::uniform_real_distribution<double> depth(well.measured_depth_start() - 10,
                                                     well.measured_depth_end() + 10);
        std::uniform_real_distribution<double> distance(0, 2);
        for (int n = 0; n < 60; ++n) {
            const Vector3d point = point_in_section(well, depth(random), distance(random), random);
            const WellCrossSection foot = well.project(point, well.find_arc(point, 0));
            const double nearest = brute_force_depth(well, point);
            // A minimum of distance locates its place to the square root of rounding only.
            EXPECT_NEAR(foot.measured_depth, nearest, 1e-4);
            EXPECT_NEAR((foot.axis - point).norm(), (well.at(nearest).axis - point).norm(),
                        rounding);
        }
    }
}

TEST(Well, ProjectionReturnsTheSectionAPointWasMadeIn) {
    std::mt19937 random(7);
    const Well well(random_well(random));
    std::uniform_real_distribution<double> depth(-50, well.measured_depth_end() + 50);
    for (int n = 0; n < 2000; ++n) {
        const double made_at = depth(random);
        const WellCrossSection section = well.at(made_at);
        const Vector3d point = point_in_section(well, made_at, 0.1, random);
        const WellCrossSection foot = well.project(point, well.find_arc(point, 10));
        EXPECT_NEAR(foot.measured_depth, made_at, rounding);
        EXPECT_LT((foot.axis - section.axis).norm(), rounding);
        EXPECT_LT((foot.direction - section.direction).norm(), 1e-12);
        EXPECT_NEAR(foot.radius, section.radius, rounding);
    }
}

TEST(Well, ProjectionOnTwoThousandArcsIsExactForEveryCurvature) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> exponent(std::log(1e-9), std::log(0.03));
    std::uniform_real_distribution<double> unit(0, 1);
    for (int n = 0; n < 2000; ++n) {
        const double curvature = std::exp(exponent(random));
        const double length = 30;
        const SurveyStation upper{0, 90 * degree * unit(random), 6 * unit(random)};
        const SurveyStation lower{length, upper.inclination + curvature * length, upper.azimuth};
        const Well well(WellCase{{upper, lower}, {{length, 0.3}}});
        const WellArc& arc = well.arcs()[1];
        // 1 - cos of the angle is below rounding for the straightest arcs, hence the floor.
        ASSERT_NEAR(arc.curvature, curvature, 1e-9 * curvature + 1e-16);

        // The exact arc in the vertical plane, about its centre.
        const double angle = arc.curvature * length * unit(random);
        const double half = 0.5 * angle;
        const double along = std::sin(angle) / arc.curvature;
        const double across = 2 * std::sin(half) * std::sin(half) / arc.curvature;
        const Vector3d axis = along * arc.tangent + across * arc.normal;
        const Vector3d direction = std::cos(angle) * arc.tangent + std::sin(angle) * arc.normal;
        const Vector3d offset = direction.cross(random_unit(random)).normalized() * unit(random);
        const WellCrossSection foot = well.project(axis + offset, 1);
        EXPECT_LT((foot.axis - axis).norm(), 1e-13 * length) << curvature;
        EXPECT_LT((foot.direction - direction).norm(), 1e-14) << curvature;
        EXPECT_NEAR(foot.measured_depth, angle / arc.curvature, 1e-13 * length) << curvature;
    }
}

TEST(Well, EveryStationLiesOnTheAxis) {
    for (const char* name : {"ullrigg_U3.csv", "ullrigg_U4Lat.csv", "iscwsa_reference.csv"}) {
        const std::vector<SurveyStation> survey = test::read_published_survey(name).stations;
        const Well well(WellCase{survey, {{500, 0.3}, {1e4, 0.2}}});
        const std::vector<Vector3d> positions = station_positions(survey);
        for (std::size_t k = 0; k < survey.size(); ++k)
            EXPECT_LT((well.at(survey[k].measured_depth).axis - positions[k]).norm(), rounding);
    }
}

TEST(Well, TangentAndPositionAreContinuousAcrossJoints) {
    std::mt19937 random(3);
    const Well well(random_well(random));
    const std::vector<WellArc>& arcs = well.arcs();
    for (std::size_t k = 0; k + 1 < arcs.size(); ++k) {
        EXPECT_EQ(arcs[k].end, arcs[k + 1].start);
        EXPECT_EQ(arcs[k].end_tangent, arcs[k + 1].tangent);
        const double joint = arcs[k + 1].measured_depth_start;
        EXPECT_NEAR(arcs[k].measured_depth_start + arcs[k].length, joint, rounding);
        const double before = std::nextafter(joint, joint - 1);
        EXPECT_LT((well.at(before).axis - well.at(joint).axis).norm(), rounding);
        EXPECT_LT((well.at(before).direction - well.at(joint).direction).norm(), 1e-12);
    }
}

TEST(Well, FramesOfArcsAreOrthonormal) {
    std::mt19937 random(4);
    for (int n = 0; n < 20; ++n) {
        const Well well(random_well(random));
        for (const WellArc& arc : well.arcs()) {
            EXPECT_NEAR(arc.tangent.norm(), 1, 1e-14);
            EXPECT_NEAR(arc.normal.norm(), 1, 1e-14);
            EXPECT_NEAR(arc.tangent.dot(arc.normal), 0, 1e-14);
            EXPECT_NEAR(arc.end_tangent.norm(), 1, 1e-14);
        }
    }
}

TEST(Well, ArcLengthsAddUpToTheMeasuredDepth) {
    std::mt19937 random(5);
    const Well well(random_well(random));
    double sum = 0;
    for (std::size_t k = 1; k + 1 < well.arcs().size(); ++k)
        sum += well.arcs()[k].length;
    EXPECT_NEAR(sum, well.measured_depth_end() - well.measured_depth_start(), rounding);

    // A polygon inscribed in the axis: h^2 c^2 / 24 short, here 1e-7 at most.
    double polygon = 0;
    const int sides = 20000;
    const double h = well.measured_depth_end() / sides;
    for (int k = 0; k < sides; ++k)
        polygon += (well.at(h * (k + 1)).axis - well.at(h * k).axis).norm();
    EXPECT_NEAR(polygon, well.measured_depth_end(), 1e-7 * well.measured_depth_end());
}

TEST(Well, DiameterChangesWhereTheSectionsSaySo) {
    std::mt19937 random(6);
    const WellCase input = random_well(random);
    const Well well(input);
    EXPECT_EQ(well.at(-10).radius, 0.20);
    EXPECT_EQ(well.at(199.999).radius, 0.20);
    EXPECT_EQ(well.at(200.401).radius, 0.155);
    EXPECT_EQ(well.at(349.999).radius, 0.155);
    EXPECT_EQ(well.at(350.311).radius, 0.11);
    EXPECT_EQ(well.at(1e5).radius, 0.11);

    // over one diameter of the wider, in the narrower
    EXPECT_NEAR(well.at(200.1).radius, 0.20 - 0.25 * 0.045, 1e-6);
    EXPECT_NEAR(well.at(200.3).radius, 0.20 - 0.75 * 0.045, 1e-6);

    // The cuts leave the axis where it was.
    WellCase uncut = input;
    uncut.sections = {{1e4, 0.3}};
    const Well plain(uncut);
    EXPECT_EQ(well.arcs().size(), plain.arcs().size() + 4);
    for (double depth = -20; depth < well.measured_depth_end() + 20; depth += 1.7) {
        EXPECT_LT((well.at(depth).axis - plain.at(depth).axis).norm(), rounding);
        EXPECT_LT((well.at(depth).direction - plain.at(depth).direction).norm(), 1e-12);
    }
}

TEST(Well, SectionsMayEndAtAStationAboveTheFirstOrBelowTheLast) {
    const std::vector<SurveyStation> survey{{100, 0, 0}, {200, 0.1, 0}, {300, 0.2, 0}};
    const Well at_station(WellCase{survey, {{200, 0.4}, {300, 0.3}}});
    EXPECT_EQ(at_station.arcs().size(), 5U);  // nothing to cut but the end of the shoulder
    EXPECT_EQ(at_station.at(199.9).radius, 0.2);
    EXPECT_EQ(at_station.at(200.41).radius, 0.15);
    const Well outside(WellCase{survey, {{50, 0.5}, {400, 0.4}, {500, 0.3}}});
    EXPECT_EQ(outside.arcs().size(), 8U);
    EXPECT_EQ(outside.at(49).radius, 0.25);
    EXPECT_EQ(outside.at(150).radius, 0.2);
    EXPECT_EQ(outside.at(401).radius, 0.15);
}

TEST(Well, WideningHoleGoesOverInTheNarrowerOneToo) {
    const Well well(WellCase{{{0, 0, 0}, {300, 0, 0}}, {{100, 0.2}, {300, 0.3}}});
    EXPECT_EQ(well.at(99.6).radius, 0.1);
    EXPECT_NEAR(well.at(99.85).radius, 0.125, 1e-12);
    EXPECT_NEAR(well.at(99.9999).radius, 0.15, 1e-4);
    EXPECT_EQ(well.at(100.0001).radius, 0.15);
}

TEST(Well, ShouldersTakeHalfOfASectionAtMost) {
    const Well well(WellCase{{{0, 0, 0}, {300, 0, 0}}, {{100, 0.4}, {100.2, 0.2}, {300, 0.4}}});
    EXPECT_NEAR(well.at(100.05).radius, 0.15, 1e-12);
    EXPECT_NEAR(well.at(100.1).radius, 0.1, 1e-12);
    EXPECT_NEAR(well.at(100.15).radius, 0.15, 1e-12);
}

// Linear in sin(c s)/c of each arc: exact at stations, and near it between them.
TEST(Well, DiameterVariesLinearlyBetweenTwoDepths) {
    WellCase input{{{0, 0, 0}, {30, 0.1, 0}, {60, 0.2, 0.1}, {300, 1.4, 0.1}}, {{20, 0.3}}};
    WellSectionCase narrowing{.to = 280, .diameter = 0.3};
    narrowing.end_diameter = 0.2;
    input.sections.push_back(narrowing);
    const Well well(input);
    EXPECT_TRUE(well.varies_along());
    EXPECT_EQ(well.at(10).radius, 0.15);
    for (const double depth : {30.0, 60.0})
        EXPECT_NEAR(well.at(depth).radius, 0.15 - 0.05 * (depth - 20) / 260, 1e-12);
    for (double depth = 20; depth < 280; depth += 3.1)
        EXPECT_NEAR(well.at(depth).radius, 0.15 - 0.05 * (depth - 20) / 260, 2e-5);
    EXPECT_NEAR(well.at(290).radius, 0.1, 1e-12);
    for (const WellArc& arc : well.arcs())
        if (arc.measured_depth_start > 0 && arc.length < 1e4) {
            EXPECT_NEAR(well.at(arc.measured_depth_start).radius,
                        well.at(arc.measured_depth_start - 1e-9).radius, 1e-10);
        }
}

TEST(Well, WallGoesOverFromOneStiffnessToTheNext) {
    WellCase input{{{0, 0, 0}, {300, 0, 0}}, {{100, 0.2}}};
    WellSectionCase firm{.to = 300, .diameter = 0.2};
    firm.normal_stiffness = 3e7;
    input.sections.push_back(firm);
    const Well well(input, 1e7);
    EXPECT_EQ(well.largest_firmness(), 3);
    const WellArc& shoulder = well.arcs()[well.arc_at(100.1)];
    EXPECT_EQ(shoulder.section, 1U);
    EXPECT_EQ(shoulder.firmness, 1);
    EXPECT_NEAR(shoulder.firming * 0.2, 2, 1e-9);
    EXPECT_EQ(well.arcs()[well.arc_at(101)].firmness, 3);
    EXPECT_FALSE(Well({input.survey, {{300, 0.2}}}).varies_along());
}

TEST(Well, GoesOnStraightAboveTheStartAndBelowTheEnd) {
    const Well well(WellCase{{{0, 0, 0}, {100, 30 * degree, 90 * degree}}, {{100, 0.3}}});
    const WellCrossSection above = well.project({0.05, 0, -40}, well.find_arc({0.05, 0, -40}, 2));
    EXPECT_LT((above.axis - Vector3d(0, 0, -40)).norm(), rounding);
    EXPECT_EQ(above.direction, Vector3d(0, 0, 1));
    EXPECT_NEAR(above.measured_depth, -40, rounding);

    const Vector3d end = well.at(100).axis;
    const Vector3d ahead(0, 0.5, std::sqrt(0.75));
    const Vector3d point = end + 25 * ahead + Vector3d(0.1, 0, 0);
    const WellCrossSection below = well.project(point, well.find_arc(point, 0));
    EXPECT_LT((below.axis - (end + 25 * ahead)).norm(), rounding);
    EXPECT_LT((below.direction - ahead).norm(), 1e-14);
    EXPECT_NEAR(below.measured_depth, 125, rounding);
}

TEST(Well, StraightArcsHaveNoCurvatureAtAll) {
    const Well well(WellCase{{{0, 0.7, 0.3}, {30, 0.7, 0.3}, {60, 0.7, 0.3}}, {{60, 0.3}}});
    for (const WellArc& arc : well.arcs()) {
        EXPECT_EQ(arc.curvature, 0.0);
        EXPECT_NEAR(arc.normal.norm(), 1, 1e-15);
        EXPECT_NEAR(arc.normal.dot(arc.tangent), 0, 1e-15);
    }
}

TEST(Well, FindsTheSameArcFromEveryGuess) {
    std::mt19937 random(8);
    const Well well(random_well(random));
    std::uniform_real_distribution<double> depth(-20, well.measured_depth_end() + 20);
    for (int n = 0; n < 300; ++n) {
        const double made_at = depth(random);
        const Vector3d point = point_in_section(well, made_at, 0.2, random);
        for (std::size_t guess = 0; guess < well.arcs().size(); ++guess)
            EXPECT_EQ(well.find_arc(point, guess), well.arc_at(made_at));
    }
}

TEST(Well, APointAtAJointKeepsItsArc) {
    std::mt19937 random(9);
    const Well well(random_well(random));
    std::normal_distribution<double> jitter(0, 1e-15);
    for (std::size_t joint = 1; joint < well.arcs().size(); ++joint) {
        const WellArc& arc = well.arcs()[joint];
        for (int n = 0; n < 50; ++n) {
            const Vector3d across = arc.tangent.cross(random_unit(random)).normalized();
            const Vector3d point = arc.start + 0.1 * across + jitter(random) * arc.tangent;
            const std::size_t found = well.find_arc(point, joint);
            EXPECT_TRUE(found == joint || found == joint - 1);
            EXPECT_EQ(well.find_arc(point, found), found);
            // Either neighbour gives the same section.
            const WellCrossSection here = well.project(point, joint);
            const WellCrossSection there = well.project(point, joint - 1);
            EXPECT_LT((here.axis - there.axis).norm(), rounding);
            EXPECT_LT((here.direction - there.direction).norm(), 1e-12);
        }
    }
}

TEST(Well, RefusesASurveyThatTurnsBackOrTooSharply) {
    const std::vector<WellSectionCase> sections{{100, 0.3}};
    EXPECT_THROW(Well(WellCase{{{0, 0, 0}, {30, 180 * degree, 0}}, sections}),
                 std::invalid_argument);
    EXPECT_THROW(Well(WellCase{{{0, 0, 0}, {0.1, 90 * degree, 0}}, sections}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace drillstrand
