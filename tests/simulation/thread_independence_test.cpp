// A run gives the same numbers, digit by digit, on any number of threads.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "drillstrand/simulation.hpp"
#include "support/both_integrators.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

/// 60 m of pipe, 75 segments (five blocks of nodes), that falls to the low side of a bent well in
/// mud and is turned at the head.
Case rubbing_string(IntegratorKind integrator) {
    Case input;
    input.run.integrator = integrator;
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
    input.damping.internal = {1e-2, 1e-2};
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
    if (input.well) {
        EXPECT_GT(alone.last().contact_nodes, 10);
    }
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

/// Advances by pieces of that many steps, over one record time.
Profile profile_after(Case input, std::int64_t piece) {
    input.run.threads = 1;
    const Scene scene = build_scene(input);
    const auto integrator = make_integrator(scene, integrator_options(input.run));
    for (const double end : {0.5 * input.run.duration, input.run.duration})
        while (integrator->time() < end)
            integrator->advance(end, piece);
    EXPECT_EQ(integrator->time(), input.run.duration);
    return integrator->profile();
}

using Pieces = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Pieces, both_integrators, integrator_name);

TEST_P(Pieces, OfAnySizeGiveTheSameDigitByDigit) {
    const Case input = rubbing_string(integrator());
    const Profile whole = profile_after(input, std::int64_t{1} << 40);
    for (const std::int64_t piece : {1, 2, 7, 1000}) {
        SCOPED_TRACE(piece);
        expect_identical(profile_after(input, piece), whole);
    }
}

/// What makes a scene another one for the kernels.
struct Feature {
    std::string name;
    std::function<void(Case&)> set;
};

const std::vector<Feature> features = {
    {"WellAndMud", [](Case&) {}},
    {"MudInMotion",
     [](Case& input) {
         input.fluid->flow_index = 0.7;
         input.fluid->yield_stress = 2;
         input.fluid->flow_rate = 0.03;
     }},
    {"WellOnly", [](Case& input) { input.fluid.reset(); }},
    {"NoWell",
     [](Case& input) {
         input.fluid.reset();
         input.well.reset();
         input.head.direction = Eigen::Vector3d(0.5, 0, 0.8);
         input.bit.direction = BitDirection::follower;
     }},
    {"BuoyancyAlone", [](Case& input) { input.fluid->drag = false; }},
    {"ConcentricDrag", [](Case& input) { input.fluid->axial_drag = AxialDrag::concentric; }},
    {"PapersFriction", [](Case& input) { input.contact.law = FrictionLaw::paper; }},
    {"FrictionOfTwoCoefficients",
     [](Case& input) {
         input.contact.static_friction = {0.2, 0.5};
         input.contact.dynamic_friction = {0.1, 0.4};
     }},
    {"NoFriction",
     [](Case& input) {
         input.contact.static_friction = input.contact.dynamic_friction = {0, 0};
     }},
    {"DashpotThatPulls", [](Case& input) { input.contact.tension = true; }},
    {"Restitution", [](Case& input) { input.contact.restitution = 0.5; }},
    {"HertzsWall",
     [](Case& input) {
         if (input.run.integrator != IntegratorKind::leapfrog) return;
         input.contact.normal_law = NormalLaw::hertz;
         input.contact.normal_stiffness = 1e9;
     }},
    {"BentPipe",
     [](Case& input) {
         input.string.components[0].curvature = {0.002, 0.004, -0.003};
     }},
    {"BentPipeWithoutWell",
     [](Case& input) {
         input.fluid.reset();
         input.well.reset();
         input.string.components[0].curvature = {0.002, 0.004, -0.003};
     }},
    {"NoDamping", [](Case& input) { input.damping = {}; }},
    {"KelvinVoigt", [](Case& input) { input.damping.kelvin_voigt = 1e-5; }},
    {"BentPipeWithKelvinVoigt",
     [](Case& input) {
         input.damping.kelvin_voigt = 1e-5;
         input.string.components[0].curvature = {0, 0.004, 0};
     }},
    {"OuterDamping",
     [](Case& input) {
         input.damping.external = {5, 5};
     }},
    {"FreeHead",
     [](Case& input) {
         input.head.motion = HeadMotion::free;
         input.head.rotation = 0;
         input.head.force = Eigen::Vector3d(100, 200, -3000);
         input.head.moment = Eigen::Vector3d(10, 0, 500);
     }},
    {"FollowerLoads",
     [](Case& input) {
         input.bit.direction = BitDirection::follower;
         input.bit.torque = 500;
         input.bit.moment = Eigen::Vector3d(100, 200, -300);
     }},
    {"DeadLoads",
     [](Case& input) {
         input.bit.force = Eigen::Vector3d(500, 200, 1000);
         input.bit.dead_moment = Eigen::Vector3d(100, 200, -300);
     }},
    {"SeveralComponents",
     [](Case& input) {
         Component pipe = input.string.components[0];
         Component collar = pipe;
         pipe.length = 41.3;
         collar.length = 18.7;
         collar.outer_diameter = 0.17;
         collar.inner_diameter = 0.07;
         collar.linear_density = 147;
         input.string.components = {pipe, collar};
         input.initial.penetration_limit = 0.02;
     }},
};

class ThreadsWith : public testing::TestWithParam<std::tuple<IntegratorKind, Feature>> {};

TEST_P(ThreadsWith, DoNotChangeADigit) {
    const auto& [integrator, feature] = GetParam();
    Case input = rubbing_string(integrator);
    input.mesh.segments = 40;                                        // three blocks
    input.initial.offset = 0.031 * Eigen::Vector3d(-0.66, 0, 0.75);  // at the low side
    input.run.duration = 0.04;
    input.output.profile_interval = 0.02;
    feature.set(input);
    expect_identical_on_any_number_of_threads(input);
}

INSTANTIATE_TEST_SUITE_P(Features, ThreadsWith,
                         testing::Combine(testing::Values(IntegratorKind::dormand_prince,
                                                          IntegratorKind::leapfrog),
                                          testing::ValuesIn(features)),
                         [](const auto& instance) {
                             return integrator_label(std::get<0>(instance.param)) +
                                    std::get<1>(instance.param).name;
                         });

using Threads = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Threads, both_integrators, integrator_name);

TEST_P(Threads, MoreThanBlocksOfNodesAreHarmless) {
    Case input = rubbing_string(integrator());
    input.mesh.segments = 12;
    input.run.duration = 0.05;
    input.run.threads = 1;
    const test::Run alone = run(input);
    input.run.threads = 8;
    expect_identical(run(input).last(), alone.last());
}

TEST_P(Threads, RunsInPiecesEqualRunsInOneGo) {
    const Case input = rubbing_string(integrator());
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

}  // namespace
}  // namespace drillstrand::test
