// A pipe that goes from one section of the well into the next: casing and open hole, shoes, walls
// of other stiffness, holes that narrow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drillstrand/energy_audit.hpp"
#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;
constexpr double degree = std::numbers::pi / 180;
constexpr double g = 9.81;

using Sections = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Sections, both_integrators, integrator_name);

/// The pipe on the low side of a hole of 45 degrees, let go.
Case pipe_let_go(IntegratorKind integrator, double friction) {
    Case input = short_pipe(integrator, 45 * degree);
    input.contact.static_friction = input.contact.dynamic_friction = {friction, friction};
    lay_down(input, 45 * degree);
    input.run.duration = 2.5;
    input.output.interval = 0.005;
    return input;
}

double way(const test::Run& result) {
    return (result.end().position.front() - result.profiles.front().position.front()).norm();
}

double speed(const test::Run& result) {
    return result.end().momentum.front()[3] / pipe_mass;
}

TEST_P(Sections, PipeThatSlidesFromCasingToOpenHoleFeelsTheFrictionOfEach) {
    Case input = pipe_let_go(integrator(), 0.6);
    const double casing = 0.2;
    const double open = 0.5;
    WellSectionCase above{.to = 12, .diameter = 2 * hole_radius};
    above.static_friction = above.dynamic_friction = {casing, casing};
    WellSectionCase below{.to = 1000, .diameter = 2 * hole_radius};
    below.static_friction = below.dynamic_friction = {open, open};
    input.well->sections = {above, below};
    const test::Run result = run(input);
    // the lower end goes 2 m in casing, the upper 12 m; what the wall takes is friction times way
    const double s = way(result);
    ASSERT_GT(s, 13);
    const double rubbed = 0.5 * casing * (2 + 12) + 0.5 * open * (s - 2 + s - 12);
    const double expected = std::sqrt(2 * g * std::sqrt(0.5) * (s - rubbed));
    EXPECT_NEAR(speed(result), expected, 2e-3 * expected);
}

/// The largest growth of kinetic, potential and elastic energy from one record to the next, and
/// what the account does not explain (J).
struct Gain {
    double stored = 0;
    double unexplained = 0;
    double penetration = 0;
};

Gain gain_of(const test::Run& result) {
    Gain gain;
    EnergyAudit audit;
    double least = result.series.front().energy.stored();
    for (const SeriesRecord& record : result.series) {
        audit.add(record.energy);
        gain.stored = std::max(gain.stored, record.energy.stored() - least);
        least = std::min(least, record.energy.stored());
        gain.penetration = std::max(gain.penetration, record.max_penetration);
    }
    gain.unexplained = std::abs(audit.appeared());
    return gain;
}

// The wall's springs would take 5 kJ, a tenth of what falls, out of nothing if the hole jumped by
// 10 mm under the pipe. (What is left comes from the leapfrog's step: 3e-4, 8e-10 with half of it.)
TEST_P(Sections, PipeClimbsTheShoulderOfANarrowerHoleAndLeavesItAgainWithoutAGainOfEnergy) {
    Case input = pipe_let_go(integrator(), 0);
    input.well->sections = {{12, 0.22}, {14, 0.20}, {1000, 0.22}};
    const test::Run result = run(input);
    const Gain gain = gain_of(result);
    EXPECT_GT(way(result), 14);
    EXPECT_LT(gain.penetration, 1.5e-3);
    const double fallen = pipe_mass * pipe_length * g * std::sqrt(0.5) * way(result);
    EXPECT_LT(gain.stored, 1e-3 * fallen);
    EXPECT_LT(gain.unexplained, 1e-4 * fallen);
}

// A heavy pipe that comes slowly: it stops before the shoulder, which it cannot climb.
TEST_P(Sections, ShoulderHoldsAPipeThatIsTooSlowForIt) {
    Case input = short_pipe(integrator(), 89.5 * degree);
    input.contact.static_friction = input.contact.dynamic_friction = {0, 0};
    lay_down(input, 89.5 * degree);
    input.well->sections = {{10.4, 0.22}, {1000, 0.18}};
    input.run.duration = 6;
    const test::Run result = run(input);
    // 0.4 m at 0.5 degrees give 3.5 mm of height; the shoulder is 20 mm high, 0.22 m long
    EXPECT_LT(result.end().position.back().x(), 10.4 + 0.06);
    EXPECT_GT(result.end().position.back().x(), 10.1);
}

TEST_P(Sections, PipeInAHoleThatNarrowsIsPushedToWhereItIsWide) {
    const double level = 90 * degree;
    Case input = short_pipe(integrator(), level);
    input.contact.static_friction = input.contact.dynamic_friction = {0, 0};
    WellSectionCase narrowing{.to = 100, .diameter = 0.24};
    narrowing.end_diameter = 0.16;
    input.well->sections = {narrowing};
    const double slope = 0.5 * (0.16 - 0.24) / 100;
    // on the low side all along, from the head's room on
    const double room = 0.12 + 20 * slope - pipe_radius;
    input.head.direction = Vector3d(1, 0, slope).normalized();
    lay_down(input, level);
    input.initial.offset += (room - clearance) * low_side(level) + 20 * down_the_well(level);
    input.run.duration = 3;
    const double expected = 0.5 * g * std::abs(slope) * 3 * 3;
    EXPECT_NEAR(way(run(input)), expected, 0.01 * expected);
}

TEST_P(Sections, WallThatIsFirmerFurtherDownGivesNoEnergy) {
    for (const auto& [above, below] : {std::pair(1e5, 1e7), std::pair(1e7, 1e5)}) {
        Case input = pipe_let_go(integrator(), 0);
        input.contact.normal_stiffness = 1e5;
        input.contact.normal_damping = 0;
        lay_down(input, 45 * degree);
        WellSectionCase first{.to = 12, .diameter = 2 * hole_radius};
        first.normal_stiffness = above;
        WellSectionCase second{.to = 1000, .diameter = 2 * hole_radius};
        second.normal_stiffness = below;
        input.well->sections = {first, second};
        const test::Run result = run(input);
        const Gain gain = gain_of(result);
        EXPECT_GT(way(result), 13);
        const double fallen = pipe_mass * pipe_length * g * std::sqrt(0.5) * way(result);
        EXPECT_LT(gain.stored, 1e-3 * fallen);
        EXPECT_LT(gain.unexplained, 1e-4 * fallen);
    }
}

}  // namespace
}  // namespace drillstrand::test
