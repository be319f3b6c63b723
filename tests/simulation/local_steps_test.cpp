// Steps of their own size where the mesh is fine (engine/rod/README.md, "Substeps"): as accurate as
// one small step for all, as sparing with energy, and free of all that a run must be free of.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drillstrand/energy_audit.hpp"
#include "drillstrand/equilibrium.hpp"
#include "drillstrand/simulation.hpp"
#include "drillstrand/step_bound.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;

std::string pipe(double length) {
    return fmt::format(R"(
        [[string.component]]
        length = {}
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        youngs_modulus = "200 GPa"
        )",
                       length);
}

/// The last 4 m in tenths of a segment elsewhere.
constexpr const char* graded_mesh = R"(
    [mesh]
    element_length = 2.5
    [[mesh.refine]]
    from = 0
    to = 4
    measured_from = "bit"
    element_length = 0.25
    )";

// ------------------------------------------------------------------ plan

TEST(StepPlan, TakesNoMoreSubstepsThanSinglePrecisionBears) {
    Case slivers = case_from(pipe(100) + R"(
        [mesh]
        element_length = 2.5
        [[mesh.refine]]
        from = 0
        to = 0.2
        measured_from = "bit"
        element_length = 0.004
        [run]
        duration = 1
        )");
    const StepPlan plan = step_plan(build_scene(slivers));
    ASSERT_FALSE(plan.stretches.empty());
    for (const FineStretch& stretch : plan.stretches)
        EXPECT_LE(stretch.substeps, 48);
}

TEST(StepPlan, HasNoStretchesWhereSegmentsAreAlikeOrTheCaseAsksForNone) {
    const std::string run = "[run]\nduration = 1\n";
    Case alike = case_from(pipe(100) + "[mesh]\nsegments = 40\n" + run);
    EXPECT_TRUE(step_plan(build_scene(alike)).stretches.empty());
    Case graded = case_from(pipe(100) + graded_mesh + run);
    const StepPlan plan = step_plan(build_scene(graded));
    ASSERT_EQ(plan.stretches.size(), 1U);
    EXPECT_GE(plan.stretches[0].substeps, 8);
    graded.run.local_steps = false;
    const StepPlan single = step_plan(build_scene(graded));
    EXPECT_TRUE(single.stretches.empty());
    EXPECT_GT(plan.bound.step, 8 * single.bound.step);
    // D_in carries momentum along the string: no substeps of the rod alone
    graded.run.local_steps = true;
    graded.damping.internal = {1e-2, 1e-2};
    EXPECT_TRUE(step_plan(build_scene(graded)).stretches.empty());
}

// ------------------------------------------------------------------ accuracy

/// Where the tip of a clamped, level pipe is some time after it was let go.
Vector3d falling_tip(const std::string& mesh, bool local_steps, double cfl = 0.9) {
    Case input =
        case_from(pipe(25) + mesh + "[head]\ndirection = [1, 0, 0]\n[run]\nduration = 1.5\n");
    input.run.local_steps = local_steps;
    input.run.cfl = cfl;
    return run(input).last().bit_position;
}

TEST(LocalSteps, ErrAsMuchAsOneSmallStepForAll) {
    const Vector3d exact = falling_tip("[mesh]\nsegments = 160\n", false);
    const double single = (falling_tip(graded_mesh, false) - exact).norm();
    const double local = (falling_tip(graded_mesh, true) - exact).norm();
    EXPECT_GT(single, 1e-5);
    EXPECT_NEAR(local, single, 0.1 * single);
}

/// A free pipe that is bent, turned and pushed, slowly beside its own motions; how far it gets is
/// its bit's x.
Case pushed_pipe() {
    return case_from("gravity = 0\n" + pipe(60) + graded_mesh + R"(
        [head]
        motion = "free"
        moment = [[0, [0, 0, 0]], [2, [0, 300, 200]], [4, [0, 0, 0]]]
        [bit]
        moment = [[0, [0, 0, 0]], [2, [100, 0, 0]], [4, [0, 0, 0]]]
        force = [[0, [0, 0, 0]], [2, [0, 0, -1000]], [4, [0, 0, 0]]]
        [run]
        duration = 6
        )");
}

TEST(LocalSteps, AreOfSecondOrderInTime) {
    const auto deflection = [](double cfl) {
        Case input = pushed_pipe();
        input.run.cfl = cfl;
        return run(input).last().bit_position.x();
    };
    const double finest = deflection(0.9 / 32);
    const double coarse = std::abs(deflection(0.9) - finest);
    const double half = std::abs(deflection(0.45) - finest);
    const double quarter = std::abs(deflection(0.225) - finest);
    EXPECT_GT(std::log2(coarse / half), 1.8) << coarse << ", " << half << ", " << quarter;
    EXPECT_GT(std::log2(half / quarter), 1.8) << coarse << ", " << half << ", " << quarter;
}

// ------------------------------------------------------------------ invariants

/// Of all nodes.
Vector3d centre_of_mass(const Scene& scene, const std::vector<Vector3d>& position) {
    Vector3d sum = Vector3d::Zero();
    double mass = 0;
    for (std::size_t k = 0; k < position.size(); ++k) {
        const double of_node = scene.mesh.cell[k] * scene.mesh.node[k].mass;
        sum += of_node * position[k];
        mass += of_node;
    }
    return sum / mass;
}

TEST(LocalSteps, LeaveTheCentreOfMassOfAFreeStringWhereItIsAndItsEnergyWithinBounds) {
    Case input = case_from("gravity = 0\n" + pipe(40) + graded_mesh + R"(
        [head]
        motion = "free"
        [initial]
        curvature = [0.001, 0.003, 0.002]
        [run]
        duration = 20
        [output]
        interval = 0.05
        profile_interval = 2
        )");
    const Scene scene = build_scene(input);
    ASSERT_EQ(step_plan(scene).stretches.size(), 1U);
    for (const double cfl : {0.3, 0.45, 0.6, 0.75, 0.9}) {
        SCOPED_TRACE(cfl);
        input.run.cfl = cfl;
        const test::Run flight = run(input);
        const double elastic = flight.series.front().energy.elastic;
        EXPECT_GT(elastic, 50);
        double least = elastic;
        for (const SeriesRecord& record : flight.series) {
            EXPECT_NEAR(record.energy.stored(), elastic, 2e-3 * elastic) << record.time;
            least = std::min(least, record.energy.elastic);
        }
        EXPECT_LT(least, 0.5 * elastic);  // it does swing
        const Vector3d start = centre_of_mass(scene, flight.profiles.front().position);
        for (const Profile& profile : flight.profiles)
            EXPECT_LT((centre_of_mass(scene, profile.position) - start).norm(), 1e-10);
    }
}

// ------------------------------------------------------------------ in a well

/// A stabilised assembly in a bent well with mud, finely divided.
Case assembly(const std::string& more) {
    Case input = case_from(R"(
        [[string.component]]
        name = "drill pipe"
        length = 240
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        youngs_modulus = "200 GPa"
        [[string.component]]
        name = "collars"
        length = 40
        linear_density = 150
        outer_diameter = 0.171
        inner_diameter = 0.07
        youngs_modulus = "200 GPa"
        element_length = 1
        [[string.component]]
        name = "stabiliser"
        length = 1.5
        linear_density = 150
        outer_diameter = 0.171
        inner_diameter = 0.07
        youngs_modulus = "200 GPa"
        contact_diameter = 0.212
        contact_length = 0.4
        [[string.component]]
        name = "bit"
        length = 0.5
        linear_density = 160
        outer_diameter = 0.171
        inner_diameter = 0.05
        youngs_modulus = "200 GPa"
        contact_diameter = 0.2159
        contact_length = 0.15
        [fluid]
        density = 1250
        viscosity = 0.02
        [mesh]
        element_length = 6
        [initial]
        state = "equilibrium"
        )" + more);
    WellCase well;
    well.survey = {{0, 0.3, 0}, {100, 0.4, 0.1}, {200, 0.8, 0.2}, {300, 1.1, 0.25}};
    well.sections = {{300, 0.2159}};
    input.well = well;
    return input;
}

constexpr const char* hertzs_wall = "[contact]\nnormal_law = \"hertz\"\n";

class LocalStepsOn : public testing::TestWithParam<const char*> {
  protected:
    [[nodiscard]] static Case assembly_on_the_wall(const std::string& more) {
        return assembly(more + GetParam());
    }
};
INSTANTIATE_TEST_SUITE_P(Walls, LocalStepsOn, testing::Values("", hertzs_wall),
                         [](const auto& wall) { return *wall.param == '\0' ? "Linear" : "Hertz"; });

TEST_P(LocalStepsOn, HoldAnEquilibriumAsStaticsFindIt) {
    const Case input = assembly_on_the_wall("[run]\nduration = 5\n");
    const Scene scene = starting_scene(input);
    const StepPlan plan = step_plan(scene);
    ASSERT_FALSE(plan.stretches.empty());
    EXPECT_GT(plan.stretches.back().substeps, 4);
    const Equilibrium at_rest = find_equilibrium(scene);
    const auto leapfrog = make_integrator(scene, integrator_options(input.run));
    const Vector3d start = leapfrog->series().bit_position;
    leapfrog->advance(5, 1'000'000);
    EXPECT_LT(leapfrog->series().energy.kinetic, 1e-6);
    EXPECT_LT((leapfrog->series().bit_position - start).norm(), 1e-7);
    const std::vector<double> force = leapfrog->profile().normal_force;
    for (std::size_t k = 0; k < force.size(); ++k)
        EXPECT_NEAR(force[k], at_rest.profile.normal_force[k],
                    1e-4 * (1 + at_rest.profile.normal_force[k]))
            << k;
}

constexpr const char* drilling = R"(
    [head]
    rotation = [[0, 0], [0.5, 6]]
    [bit]
    weight = [[0, 0], [0.5, 5e4]]
    friction = 0.5
    smoothing_speed = 0.5
    [run]
    duration = 6
    [output]
    interval = 0.01
    )";

TEST_P(LocalStepsOn, AccountForTheEnergyOfAStringThatDrills) {
    const test::Run drills = run(assembly_on_the_wall(drilling));
    EnergyAudit audit;
    for (const SeriesRecord& record : drills.series)
        audit.add(record.energy);
    EXPECT_GT(audit.moved(), 1e4);
    EXPECT_LT(std::abs(audit.residual()), 1e-3);
}

TEST_P(LocalStepsOn, DrillAsOneSmallStepForAllDoes) {
    Case input = assembly_on_the_wall(drilling);
    struct Drilled {
        double hook_load = 0, torque = 0, contacts = 0, deepest = 0;
    };
    const auto drill = [&](bool local_steps) {
        input.run.local_steps = local_steps;
        Drilled sum;
        int count = 0;
        for (const SeriesRecord& record : run(input).series) {
            sum.deepest = std::max(sum.deepest, record.max_penetration);
            if (record.time < 3) continue;
            sum.hook_load += record.hook_load;
            sum.torque += record.surface_torque;
            sum.contacts += static_cast<double>(record.contact_nodes);
            ++count;
        }
        return Drilled{sum.hook_load / count, sum.torque / count, sum.contacts / count,
                       sum.deepest};
    };
    const Drilled local = drill(true);
    const Drilled single = drill(false);
    EXPECT_NEAR(local.hook_load, single.hook_load, 2e-3 * single.hook_load);
    EXPECT_NEAR(local.torque, single.torque, 2e-2 * single.torque);
    EXPECT_NEAR(local.contacts, single.contacts, 0.5);
    // the string lies on the wall, not in it
    EXPECT_NEAR(local.deepest, single.deepest, 0.2 * single.deepest);
}

/// Spins of all nodes at the half step of a state.
std::vector<double> half_step_spins(const Integrator& integrator) {
    for (const SavedRow& row : integrator.save())
        if (row.name == "rod/spin") return row.values;
    return {};
}

/// How far spins of records are from the mean of the half steps before and after, over the largest
/// spin.
double error_of_recorded_spins(const Case& input) {
    const Scene scene = starting_scene(input);
    const auto leapfrog = make_integrator(scene, integrator_options(input.run));
    leapfrog->advance(2, 1'000'000);
    double worst = 0;
    double most = 0;
    for (int i = 0; i < 200; ++i) {
        const std::vector<double> before = half_step_spins(*leapfrog);
        const Profile profile = leapfrog->profile();
        leapfrog->advance(3, 1);
        const std::vector<double> after = half_step_spins(*leapfrog);
        for (std::size_t k = 1; k < profile.momentum.size(); ++k) {
            const double recorded = profile.momentum[k][0] / scene.mesh.node[k].polar_inertia;
            worst = std::max(worst, std::abs(recorded - 0.5 * (before[k] + after[k])));
            most = std::max(most, std::abs(recorded));
        }
    }
    return worst / most;
}

TEST(LocalSteps, DoNotFeedAViscousShaftThatSpins) {
    // gyroscopic couples given to single light nodes are no longer without work in a stretch
    Case input = case_from(R"(
        gravity = 0
        [[string.component]]
        length = 200
        outer_diameter = 0.2032
        inner_diameter = 0.0714
        density = 7850
        youngs_modulus = "206 GPa"
        [mesh]
        element_length = 9
        refine = [{from = 0, to = 15, measured_from = "bit", element_length = 0.6}]
        [head]
        rotation = [[0, 0], [2, "200 rpm"]]
        [initial]
        curvature = [0, 1e-5, 0]
        [run]
        duration = 10
        [output]
        interval = 0.1
        )");
    ASSERT_FALSE(step_plan(build_scene(input)).stretches.empty());
    for (const double tau : {0.0, 1e-6, 1e-5, 1e-4}) {
        input.damping.kelvin_voigt = tau;
        EnergyAudit audit;
        for (const SeriesRecord& record : run(input).series)
            audit.add(record.energy);
        EXPECT_LT(std::abs(audit.residual()), 1e-3) << tau;
    }
}

TEST(LocalSteps, TakeLittleFromAViscousPipeThatSpins) {
    // what gyroscopic couples lose in a stretch: the way of a free pipe at 240 rpm
    const auto deflection = [](double tau, double cfl, bool local_steps) {
        Case input = pushed_pipe();
        input.damping.kelvin_voigt = tau;
        input.run.cfl = cfl;
        input.run.local_steps = local_steps;
        return run(input).last().bit_position.x();
    };
    for (const double tau : {1e-6, 1e-5}) {
        const double exact = deflection(tau, 0.9, false);
        const double coarse = std::abs(deflection(tau, 0.9, true) - exact);
        const double half = std::abs(deflection(tau, 0.45, true) - exact);
        EXPECT_LT(coarse, 4e-6 * std::abs(exact)) << tau;
        EXPECT_GT(std::log2(coarse / half), 1) << tau << ": " << coarse << ", " << half;
    }
}

TEST(LocalSteps, LetABitStickAndSlipAsOneSmallStepDoes) {
    Case input = case_from("gravity = 0\n" + pipe(300) + graded_mesh + R"(
        [head]
        rotation = 2
        [bit]
        law = "stribeck"
        static_torque = 2000
        dynamic_torque = 1000
        decay_speed = 1
        inertia = 5
        [damping]
        kelvin_voigt = 1e-5
        [run]
        duration = 6
        [output]
        interval = 0.01
        )");
    struct Turned {
        double angle = 0, still = 0, least = 0;
    };
    const auto turn = [&](bool local_steps) {
        input.run.local_steps = local_steps;
        EXPECT_NE(step_plan(build_scene(input)).stretches.empty(), local_steps);
        Turned sum;
        for (const SeriesRecord& record : run(input).series) {
            sum.angle += 0.01 * record.bit_rotation_rate;
            sum.still += std::abs(record.bit_rotation_rate) < 1e-2 ? 0.01 : 0.0;
            sum.least = std::min(sum.least, record.bit_rotation_rate);
        }
        return sum;
    };
    const Turned local = turn(true);
    const Turned single = turn(false);
    EXPECT_NEAR(local.angle, single.angle, 0.02 * single.angle);
    EXPECT_GT(single.still, 1);
    EXPECT_NEAR(local.still, single.still, 0.05 * single.still);
    EXPECT_GT(local.least, -0.02);
}

TEST(LocalSteps, DoNotReachABitThatCuts) {
    // the rock gives way as the bit moves, which substeps do not see
    const auto steps = [](const std::string& law) {
        return step_plan(build_scene(case_from(pipe(300) + graded_mesh + "[bit]\n" + law)));
    };
    const StepPlan cutting = steps("law = \"cutting\"\nintrinsic_specific_energy = \"60 MPa\"");
    const StepPlan loaded = steps("weight = 1000");
    ASSERT_FALSE(loaded.stretches.empty());
    EXPECT_TRUE(cutting.stretches.empty());
    EXPECT_LT(cutting.bound.step, loaded.bound.step);
}

TEST(LocalSteps, AreRecordedAsTheMeanOfTheHalfStepsBeforeAndAfter) {
    // implicit: half a kick is half of a whole one to first order in the step
    EXPECT_LT(error_of_recorded_spins(assembly(drilling)), 0.03);
}

TEST(LocalSteps, GiveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
    const Case input = assembly(drilling);
    const Scene scene = starting_scene(input);
    IntegratorOptions options = integrator_options(input.run);
    const auto one = [&](int threads) {
        options.threads = threads;
        return make_integrator(scene, options);
    };
    const auto reference = one(1);
    reference->advance(0.7, 1'000'000);
    for (const int threads : {2, 3}) {
        const auto left = one(threads);
        left->advance(0.7, 250);
        const auto taken_up = one(threads);
        taken_up->restore(left->save());
        taken_up->advance(0.7, 1'000'000);
        EXPECT_EQ(taken_up->series().bit_position, reference->series().bit_position) << threads;
        EXPECT_EQ(taken_up->series().energy.dissipation, reference->series().energy.dissipation);
        EXPECT_EQ(taken_up->profile().momentum, reference->profile().momentum) << threads;
    }
}

}  // namespace
}  // namespace drillstrand::test
