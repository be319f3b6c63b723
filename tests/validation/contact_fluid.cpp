// Weight in mud, and pipes that sink through it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "forces/fluid.hpp"
#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

constexpr double degree = std::numbers::pi / 180;
// (31.8557 kg/m less the water displaced by the steel) g
constexpr double buoyed_weight = 272.43968589;  // N/m
constexpr double viscosity = 10;                // Pa s

using Buoyancy = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Buoyancy, both_integrators, integrator_name);
using Drag = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Drag, both_integrators, integrator_name);

/// The casing of the paper's table 4 in its well, made vertical.
Case casing_in_mud(IntegratorKind integrator, InsideOfPipe inside) {
    FluidCase mud;
    mud.density = 1917;
    mud.inside = inside;
    mud.drag = false;
    return hanging_casing(integrator, mud);
}

/// Pull on the head of the string at rest: the first segment's and that of the half cell above.
double head_load(const Case& input) {
    const Scene scene = build_scene(input);
    const test::Run result = run(scene, input.run, input.output);
    EXPECT_LT(result.last().energy.kinetic, 1e-2);
    return result.last().head_stress[3] + scene.weight.front() * scene.mesh.cell.front();
}

TEST_P(Buoyancy, OfTheSteelAloneLeavesAHeadLoadOf199Kilonewton) {
    EXPECT_NEAR(head_load(casing_in_mud(integrator(), InsideOfPipe::fluid)), 199035, 20);
}

TEST_P(Buoyancy, OfAnEmptyPipeMakesTheCasingFloat) {
    Case input = casing_in_mud(integrator(), InsideOfPipe::empty);
    input.mesh.segments = 32;  // the head holds it down: fine enough for the buckle
    // 52.0925 kg/m less 1917 kg/m3 times the area of the outer circle is -37.9 kg/m
    EXPECT_NEAR(head_load(input), -37.9133 * 9.81 * 515, 20);
}

Case sinking_pipe(IntegratorKind integrator, double inclination) {
    Case input = short_pipe(integrator, inclination);
    FluidCase fluid;
    fluid.density = 1000;
    fluid.viscosity = viscosity;
    // creeping flow, and the inertia of the pipe alone
    fluid.regime = FlowRegime::laminar;
    fluid.added_mass = false;
    input.fluid = fluid;
    input.run.cfl = 1e-3;  // the leapfrog takes drag to first order in its step
    return input;
}

/// Largest error of the speed at which a pipe sinks along a vertical well, over its last speed.
double sinking_error(const Case& input) {
    const double drag = viscosity * 13.901309970439268;  // 2 pi mu / ln(11/7)
    double worst = 0;
    for (const Profile& profile : run(input).profiles) {
        const double speed = profile.momentum.front()[3] / pipe_mass;
        const double part = 1 - std::exp(-drag / pipe_mass * profile.time);
        worst = std::max(worst, std::abs(speed * drag / buoyed_weight - part));
    }
    return worst;
}

Case pipe_sinking_along_the_well(IntegratorKind integrator) {
    Case input = sinking_pipe(integrator, 0);
    input.run.duration = 3;
    input.output.profile_interval = 0.25;
    return input;
}

TEST_P(Drag, PipeSinksAlongTheWellAtTheSpeedOfCouetteFlow) {
    EXPECT_LT(sinking_error(pipe_sinking_along_the_well(integrator())), 1e-4);
}

TEST(Drag, OfTheLeapfrogIsOfFirstOrderInItsStep) {
    Case input = pipe_sinking_along_the_well(IntegratorKind::leapfrog);
    input.run.cfl = RunCase().cfl;
    const double error = sinking_error(input);
    EXPECT_LT(error, 2e-3);
    input.run.cfl /= 2;
    EXPECT_NEAR(error / sinking_error(input), 2, 0.1);
}

TEST_P(Drag, PipeSinksToTheLowSideAsFastAsTheFilmLetsIt) {
    Case input = sinking_pipe(integrator(), 90 * degree);
    input.run.duration = 0.6;
    input.output.profile_interval = 0.05;
    const test::Run result = run(input);
    // momentum = weight t - integral of the drag over the way
    double resisted = 0;
    double eccentricity = 0;
    for (const Profile& profile : result.profiles) {
        const double end = profile.position.front().z();
        constexpr int parts = 1000;
        const double step = (end - eccentricity) / parts;
        for (int i = 0; i < parts; ++i) {
            const double middle = eccentricity + (i + 0.5) * step;
            resisted +=
                step * viscosity * drag_coefficients({middle, pipe_radius, hole_radius}).radial;
        }
        eccentricity = end;
        const double momentum = profile.momentum.front().tail<3>().norm();
        const double given = buoyed_weight * profile.time;
        EXPECT_NEAR(momentum, given - resisted, 1e-4 * given + 1e-6);
    }
    EXPECT_GT(eccentricity, 0.5 * clearance);
    EXPECT_LT(eccentricity, clearance);
}

}  // namespace
}  // namespace drillstrand::test
