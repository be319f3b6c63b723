// Cycles of bending stress: of moments made by hand, and of a pipe that turns in a bend.
#include "drillstrand/bending_cycles.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "drillstrand/run_summary.hpp"
#include "support/both_integrators.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// Two pipes of 10 m, of 200 GPa; the lower one is thinner.
constexpr const char* two_pipes = R"(
    [[string.component]]
    name = "upper"
    length = 10
    outer_diameter = 0.14
    inner_diameter = 0.11
    linear_density = 34
    youngs_modulus = "200 GPa"
    [[string.component]]
    name = "lower"
    length = 10
    outer_diameter = 0.1
    inner_diameter = 0.07
    linear_density = 34
    youngs_modulus = "200 GPa"
    [mesh]
    segments = 10
    [run]
    duration = 1
    [output.cycles]
    )";
constexpr double modulus_lower =
    pi / 32 * (0.1 * 0.1 * 0.1 * 0.1 - 0.07 * 0.07 * 0.07 * 0.07) / 0.1;  // m3

/// Moments of all segments that turn by an angle in the section; those of one segment are greater.
BendingRecord turned(double moment, double angle, std::size_t greater) {
    BendingRecord record;
    for (std::size_t k = 0; k < 10; ++k)
        record.moment.emplace_back((k == greater ? 1.5 : 1) * moment *
                                   Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    return record;
}

TEST(BendingCycles, NameTheWorstSegmentOfEachComponent) {
    const Case input = case_from(two_pipes);
    const Scene scene = build_scene(input);
    BendingCycles cycles(scene.mesh, input.string, *input.output.cycles);
    for (int i = 0; i <= 160; ++i)
        cycles.add(turned(1000, pi * i / 16, 7));
    const SegmentCycles found = cycles.segments();
    const double range = 2 * 1000 / modulus_lower;
    EXPECT_NEAR(found.largest_range[6], range, 1e-9 * range);
    EXPECT_NEAR(found.largest_range[7], 1.5 * range, 1e-9 * range);
    EXPECT_NEAR(found.equivalent_range[7], 1.5 * range, 1e-9 * range);
    EXPECT_EQ(found.cycles[7], 5);
    const auto lines = cycles.findings();
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_THAT(lines[0], testing::StartsWith("cycles: upper: "));
    EXPECT_THAT(lines[1], AllOf(testing::StartsWith("cycles: lower: "), HasSubstr(" 15 m "),
                                HasSubstr(": 5 cycles"), HasSubstr("slope 4")));
}

TEST(BendingCycles, AVibrationInOnePlaneIsSeenWithinEightPercentWhateverThePlane) {
    const Case input = case_from(two_pipes);
    const Scene scene = build_scene(input);
    const double range = 2 * 1000 / modulus_lower;
    for (const double plane : {0.0, 0.2, 0.3927, 1.0, 2.5}) {
        BendingCycles cycles(scene.mesh, input.string, *input.output.cycles);
        for (int i = 0; i <= 20; ++i)
            cycles.add(turned(i % 2 == 0 ? 1000 : -1000, plane, 0));
        const double seen = cycles.segments().largest_range[9];
        EXPECT_LE(seen, range * (1 + 1e-12));
        EXPECT_GE(seen, range * std::cos(pi / 8) * (1 - 1e-12));
    }
}

TEST(BendingCycles, APipeWithoutDiametersHasNone) {
    const Case input = case_from(R"(
        [[string.component]]
        length = 10
        linear_density = 34
        bending_stiffness = 1e6
        torsional_stiffness = 1e6
        axial_stiffness = 1e9
        shear_stiffness = 1e8
        inertia = 0.1
        [mesh]
        segments = 10
        [output.cycles]
        )");
    const Scene scene = build_scene(input);
    BendingCycles cycles(scene.mesh, input.string, *input.output.cycles);
    for (int i = 0; i <= 20; ++i)
        cycles.add(turned(1e6, i, 0));
    EXPECT_THAT(cycles.findings(), testing::IsEmpty());
    EXPECT_EQ(cycles.segments().cycles[3], 0);
}

TEST(BendingCycles, OfARunSummaryGoOnFromWhatWasSaved) {
    const Case input = case_from(two_pipes);
    const Scene scene = build_scene(input);
    RunSummary whole(scene, input);
    RunSummary part(scene, input);
    for (int i = 0; i <= 100; ++i) {
        const BendingRecord record = turned(1000 + 300 * std::sin(0.7 * i), 0.31 * i, 4);
        whole.add(record);
        if (i == 37) {
            RunSummary later(scene, input);
            later.restore(part.save());
            part = later;
        }
        part.add(record);
    }
    EXPECT_EQ(part.cycles().equivalent_range, whole.cycles().equivalent_range);
    EXPECT_EQ(part.findings(), whole.findings());
    RunSummary none(scene);
    EXPECT_THAT(none.cycles().cycles, testing::IsEmpty());
    EXPECT_THROW(part.restore(none.save()), std::invalid_argument);
}

using TurningPipe = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, TurningPipe, both_integrators, integrator_name);

// A weightless pipe held in an arc of a circle by a couple that stays in space: while it turns
// about its own axis nothing else moves, and each fibre is bent to and fro once a turn.
TEST_P(TurningPipe, InABendHasAsManyCyclesAsTurnsOfTwiceItsBendingStress) {
    constexpr double curvature = 0.004;                                      // 1/m
    constexpr double stress = 200e9 * 0.07 * curvature;                      // E r kappa
    constexpr double stiffness = 200e9 * pi / 64 * (3.8416e-4 - 1.4641e-4);  // E I
    Case input = case_from(R"(
        gravity = 0
        [[string.component]]
        length = 10
        outer_diameter = 0.14
        inner_diameter = 0.11
        linear_density = 34
        youngs_modulus = "200 GPa"
        [mesh]
        segments = 10
        [head]
        direction = [0, 0, 1]
        rotation = "5 Hz"
        [initial]
        curvature = [0, 0.004, 0]
        [run]
        duration = 1
        [output]
        interval = 0.5
        cycles = {interval = 0.005}
        )");
    input.bit.dead_moment = VectorSchedule(Eigen::Vector3d(0, stiffness * curvature, 0));
    input.run.integrator = integrator();
    const Scene scene = starting_scene(input);
    const test::Run result = run(scene, input.run, input.output);
    RunSummary summary(scene, input);
    for (const BendingRecord& record : result.bending)
        summary.add(record);
    EXPECT_EQ(result.bending.size(), 201U);
    const SegmentCycles found = summary.cycles();
    for (std::size_t k = 0; k < found.cycles.size(); ++k) {
        EXPECT_EQ(found.cycles[k], 5) << "segment " << k;
        // 40 samples a turn, which torsional waves move a little
        EXPECT_NEAR(found.largest_range[k], 2 * stress, 4e-3 * stress);
        EXPECT_NEAR(found.equivalent_range[k], 2 * stress, 8e-3 * stress);
    }
}

}  // namespace
}  // namespace drillstrand::test
