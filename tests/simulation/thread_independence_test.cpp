// A run gives the same numbers, digit by digit, on any number of threads.
#include <gtest/gtest.h>

#include <cmath>

#include "drillstrand/simulation.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

/// 60 m of pipe, 75 segments (five blocks of nodes), that falls to the low side of a bent well in
/// mud and is turned at the head.
Case rubbing_string() {
    Case input;
    WellCase well;
    well.survey = {{0, 0.6, 0}, {20, 0.6, 0}, {60, 1.1, 0.3}, {100, 1.1, 0.3}};
    well.sections = {{100, 0.2}};
    input.well = well;
    FluidCase mud;
    mud.density = 1200;
    mud.viscosity = 0.1;
    input.fluid = mud;
    Component pipe;
    pipe.length = 60;
    pipe.outer_diameter = 0.14;
    pipe.inner_diameter = 0.12;
    pipe.linear_density = 31.8557;
    pipe.youngs_modulus = 200e9;
    input.string.components = {pipe};
    input.mesh.segments = 75;
    input.mesh.segment_inertia = true;
    input.head.rotation = ScalarSchedule({0, 0.1}, {0, 10});
    input.bit.weight = 5e3;
    input.bit.direction = BitDirection::well;
    input.contact.normal_stiffness = 1e6;
    input.contact.normal_damping = 1e3;
    input.damping.internal = 1e-2;
    input.run.duration = 0.2;
    input.output.interval = 0.02;
    input.output.profile_interval = 0.1;
    return input;
}

void expect_identical(const SeriesRecord& a, const SeriesRecord& b) {
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.head_stress, b.head_stress);
    EXPECT_EQ(a.bit_stress, b.bit_stress);
    EXPECT_EQ(a.bit_position, b.bit_position);
    EXPECT_EQ(a.bit_rotation_rate, b.bit_rotation_rate);
    EXPECT_EQ(a.energy.kinetic, b.energy.kinetic);
    EXPECT_EQ(a.energy.elastic, b.energy.elastic);
    EXPECT_EQ(a.energy.potential, b.energy.potential);
    EXPECT_EQ(a.energy.work, b.energy.work);
    EXPECT_EQ(a.energy.dissipation, b.energy.dissipation);
    EXPECT_EQ(a.step_size, b.step_size);
    EXPECT_EQ(a.max_penetration, b.max_penetration);
    EXPECT_EQ(a.contact_nodes, b.contact_nodes);
    EXPECT_EQ(a.impacts, b.impacts);
    EXPECT_EQ(a.contact_changes, b.contact_changes);
    EXPECT_EQ(a.slips, b.slips);
}

void expect_identical(const Profile& a, const Profile& b) {
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.director, b.director);
    EXPECT_EQ(a.momentum, b.momentum);
    EXPECT_EQ(a.stress, b.stress);
    EXPECT_EQ(a.contact_force, b.contact_force);
    EXPECT_EQ(a.normal_force, b.normal_force);
}

void expect_identical_on_any_number_of_threads(Case input) {
    input.run.threads = 1;
    const test::Run alone = run(input);
    EXPECT_GT(alone.last().contact_nodes, 10);
    for (const int threads : {2, 3}) {
        input.run.threads = threads;
        const test::Run together = run(input);
        EXPECT_EQ(together.statistics.steps, alone.statistics.steps);
        EXPECT_EQ(together.statistics.rejected, alone.statistics.rejected);
        ASSERT_EQ(together.series.size(), alone.series.size());
        for (std::size_t i = 0; i < alone.series.size(); ++i)
            expect_identical(together.series[i], alone.series[i]);
        ASSERT_EQ(together.profiles.size(), alone.profiles.size());
        for (std::size_t i = 0; i < alone.profiles.size(); ++i)
            expect_identical(together.profiles[i], alone.profiles[i]);
    }
}

class Threads : public testing::TestWithParam<IntegratorKind> {
  protected:
    static Case string_of_this_integrator() {
        Case input = rubbing_string();
        input.run.integrator = GetParam();
        return input;
    }
};

TEST_P(Threads, DoNotChangeADigitOfAStringThatRubsInMud) {
    expect_identical_on_any_number_of_threads(string_of_this_integrator());
}

TEST_P(Threads, DoNotChangeADigitOfAStringWithAFreeHead) {
    Case input = string_of_this_integrator();
    input.head.motion = HeadMotion::free;
    input.head.rotation = 0;
    input.head.force = Eigen::Vector3d(100, 200, -3000);
    input.head.moment = Eigen::Vector3d(10, 0, 500);
    input.run.duration = 0.1;
    expect_identical_on_any_number_of_threads(input);
}

TEST_P(Threads, MoreThanBlocksOfNodesAreHarmless) {
    Case input = string_of_this_integrator();
    input.mesh.segments = 12;
    input.run.duration = 0.05;
    input.run.threads = 1;
    const test::Run alone = run(input);
    input.run.threads = 8;
    expect_identical(run(input).last(), alone.last());
}

TEST_P(Threads, RunsInPiecesEqualRunsInOneGo) {
    const Case input = string_of_this_integrator();
    const Scene scene = build_scene(input);
    IntegratorOptions options = integrator_options(input.run);
    options.threads = 2;
    const auto whole = make_integrator(scene, options);
    whole->advance(0.05, 1'000'000);
    const auto pieces = make_integrator(scene, options);
    while (pieces->time() < 0.05)
        pieces->advance(0.05, 7);
    EXPECT_EQ(pieces->statistics().steps, whole->statistics().steps);
    expect_identical(pieces->series(), whole->series());
}

INSTANTIATE_TEST_SUITE_P(Integrators, Threads,
                         testing::Values(IntegratorKind::dormand_prince, IntegratorKind::leapfrog),
                         [](const auto& instance) {
                             return instance.param == IntegratorKind::leapfrog ? "Leapfrog"
                                                                               : "DormandPrince";
                         });

}  // namespace
}  // namespace drillstrand::test
