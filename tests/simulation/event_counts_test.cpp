// Records count what happened at the wall since the start of the run.
#include <gtest/gtest.h>

#include <numbers>

#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

constexpr int segments = 20;

/// A level pipe with free ends, 20 mm above the wall; pulled along from 0.5 s on with twice the
/// force that friction can hold.
Case falling_pipe(IntegratorKind integrator) {
    Case input;
    WellCase well;
    const double level = std::numbers::pi / 2;
    well.survey = {{0, level, 0}, {100, level, 0}};
    well.sections = {{100, 0.14 + 2 * 0.02}};
    input.well = well;
    Component pipe;
    pipe.length = 20;
    pipe.outer_diameter = 0.14;
    pipe.inner_diameter = 0.12;
    pipe.linear_density = 31.8557;
    pipe.youngs_modulus = 200e9;
    input.string.components = {pipe};
    input.mesh.segments = segments;
    input.mesh.segment_inertia = true;
    input.head.motion = HeadMotion::free;
    input.contact.normal_stiffness = 1e6;
    input.contact.normal_damping = 1e5;  // no rebound
    input.contact.static_friction = {0.5, 0.5};
    input.contact.dynamic_friction = {0.4, 0.4};
    const double weight = pipe.linear_density * pipe.length * input.gravity;
    input.head.force = VectorSchedule(
        {0.5, 0.6}, {Eigen::Vector3d::Zero(), Eigen::Vector3d(-2 * 0.5 * weight, 0, 0)});
    input.run.integrator = integrator;
    input.run.threads = 1;
    input.run.duration = 0.8;
    input.output.interval = 0.1;
    return input;
}

class EventCounts : public testing::TestWithParam<IntegratorKind> {};

TEST_P(EventCounts, ShowOneImpactAndOneSlipOfEachNodeOfAPipeThatFallsAndIsPulledAway) {
    const test::Run result = run(falling_pipe(GetParam()));
    const auto at = [&](double time) {
        return result.series[static_cast<std::size_t>(time / 0.1 + 0.5)];
    };
    // nothing touches before sqrt(2 d / g) = 64 ms
    EXPECT_EQ(result.series.front().impacts, 0);
    EXPECT_EQ(at(0.5).impacts, segments + 1);
    EXPECT_EQ(at(0.5).contact_changes, segments + 1);
    EXPECT_EQ(at(0.5).contact_nodes, segments + 1);
    EXPECT_EQ(at(0.5).slips, 0);
    EXPECT_EQ(result.last().impacts, segments + 1);
    EXPECT_EQ(result.last().slips, segments + 1);
}

TEST_P(EventCounts, ShowAPipeThatBouncesLeavingAndComingBack) {
    Case input = falling_pipe(GetParam());
    input.contact.normal_damping = 0;
    input.head.force = Eigen::Vector3d(0, 0, 0);
    input.run.duration = 0.3;  // back at the wall after 64 + 2 x 64 ms
    const test::Run result = run(input);
    EXPECT_EQ(result.series[1].impacts, segments + 1);
    EXPECT_EQ(result.series[1].contact_changes, 2 * (segments + 1));
    EXPECT_EQ(result.last().impacts, 2 * (segments + 1));
}

INSTANTIATE_TEST_SUITE_P(OfBothIntegrators, EventCounts,
                         testing::Values(IntegratorKind::leapfrog, IntegratorKind::dormand_prince));

}  // namespace
}  // namespace drillstrand::test
