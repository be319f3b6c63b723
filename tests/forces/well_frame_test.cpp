// The cross section of the well through a node, as the step loop computes it.
#include "forces/well_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "drillstrand/well.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;

ArcNumbers numbers_of(const WellArc& arc) {
    return {triple(arc.start), triple(arc.tangent), triple(arc.normal), arc.curvature, arc.radius};
}

/// A well of 30 m arcs that turn by up to 0.9 rad, some of them straight.
Well crooked_well(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> turn(-0.4, 0.4);
    WellCase well;
    SurveyStation station{0, 0.8, 1};
    for (int i = 0; i < 12; ++i) {
        well.survey.push_back(station);
        station.measured_depth += 30;
        if (i % 4 == 3) continue;
        station.inclination = std::abs(station.inclination + turn(random));
        station.azimuth += turn(random);
    }
    well.sections = {{1e4, 0.3111}};
    return Well(well);
}

/// Points in and around the hole, and the arcs they are near to.
template <class Check>
void for_points_near(const Well& well, Check check) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> depth(-20, well.measured_depth_end() + 20);
    std::uniform_real_distribution<double> angle(0, 6.3);
    std::uniform_real_distribution<double> distance(0, 0.3);
    for (int i = 0; i < 1000; ++i) {
        const WellCrossSection section = well.at(depth(random));
        const Vector3d side = section.direction.unitOrthogonal();
        check(Vector3d(section.axis +
                       distance(random) *
                           (Eigen::AngleAxisd(angle(random), section.direction) * side)));
    }
}

TEST(WellFrame, IsTheCrossSectionThatTheWellFinds) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Well well = crooked_well(seed);
        for_points_near(well, [&](const Vector3d& x) {
            const std::size_t arc = well.find_arc(x, well.arc_at(0));
            const WellCrossSection section = well.project(x, arc);
            const WellFrame frame = well_frame(triple(x), numbers_of(well.arcs()[arc]));
            // the straight arcs outside the survey start 1e5 m away and round accordingly
            EXPECT_LT((vector(frame.l) - section.direction).norm(), 1e-12);
            EXPECT_LT((x + frame.eccentricity * vector(frame.r) - section.axis).norm(), 1e-9);
            EXPECT_NEAR(frame.eccentricity, (x - section.axis).norm(), 1e-9);
        });
    }
}

TEST(WellFrame, DirectionsAreOrthonormalAndTurnFromRToLToT) {
    const Well well = crooked_well(2);
    for_points_near(well, [&](const Vector3d& x) {
        const WellFrame frame = well_frame(triple(x), numbers_of(well.arcs()[well.find_arc(x, 0)]));
        EXPECT_NEAR(vector(frame.r).norm(), 1, 1e-12);
        EXPECT_NEAR(vector(frame.l).norm(), 1, 1e-12);
        EXPECT_LT((vector(frame.t) - vector(frame.r).cross(vector(frame.l))).norm(), 1e-15);
        // r is the direction of a difference of positions, near to the axis of few digits
        EXPECT_NEAR(vector(frame.r).dot(vector(frame.l)), 0,
                    1e-10 / std::max(frame.eccentricity, 1e-3));
    });
}

TEST(WellFrame, OnTheAxisAnyNormalDirectionServes) {
    const Well well = crooked_well(3);
    for (double depth = 1; depth < 300; depth += 7) {
        const WellCrossSection section = well.at(depth);
        const WellArc& arc = well.arcs()[well.arc_at(depth)];
        const WellFrame frame = well_frame(triple(section.axis), numbers_of(arc));
        EXPECT_LT(frame.eccentricity, 1e-12);
        EXPECT_NEAR(vector(frame.r).norm(), 1, 1e-12);
        EXPECT_NEAR(vector(frame.r).dot(section.direction), 0, 1e-3);
        EXPECT_LT((vector(frame.l) - section.direction).norm(), 1e-12);
    }
}

TEST(WellFrame, FootLeavesAnArcWhereTheWellFindsAnother) {
    constexpr double rounding = 1e-9;  // m, of the planes at the joints
    const Well well = crooked_well(4);
    int left = 0;
    for_points_near(well, [&](const Vector3d& x) {
        for (std::size_t i = 1; i + 1 < well.arcs().size(); ++i) {
            const WellArc& arc = well.arcs()[i];
            const double past_start = (x - arc.start).dot(arc.tangent);
            const double past_end = (x - arc.end).dot(arc.end_tangent);
            const bool near = (x - arc.start).norm() < 2 * arc.length;
            if (!near || std::min(std::abs(past_start), std::abs(past_end)) < rounding) continue;
            const double angle = arc.curvature * arc.length;
            const double reach = angle > 0 ? std::sin(angle) / arc.curvature : arc.length;
            const WellFrame frame = well_frame(triple(x), numbers_of(arc));
            const bool leaves = foot_leaves(frame, std::cos(angle), reach);
            EXPECT_EQ(leaves, well.find_arc(x, i) != i);
            left += leaves ? 1 : 0;
        }
    });
    EXPECT_GT(left, 100);
}

}  // namespace
}  // namespace drillstrand
