// Weight in mud, and pipes that sink through it.
#include <gtest/gtest.h>

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

/// The casing of the paper's table 4 in its well, made vertical.
Case casing_in_mud(InsideOfPipe inside) {
    Case input;
    input.gravity = 9.81;
    WellCase well;
    well.survey = {{0, 0, 0}, {520, 0, 0}};
    well.sections = {{520, 0.3111}};
    input.well = well;
    FluidCase mud;
    mud.density = 1917;
    mud.inside = inside;
    mud.drag = false;
    input.fluid = mud;
    Component casing;
    casing.length = 515;
    casing.outer_diameter = 0.2445;
    casing.inner_diameter = 0.2266;
    casing.linear_density = 52.0925;
    casing.youngs_modulus = 200e9;
    casing.poisson_ratio = 0;
    input.string.components = {casing};
    input.mesh.segments = 10;
    input.mesh.segment_inertia = true;
    input.damping.external = 600;  // brings the string to rest within seconds
    input.run.integrator = IntegratorKind::dormand_prince;
    input.run.duration = 8;
    input.run.threads = 1;
    input.output.interval = 8;
    return input;
}

/// Pull on the head of the string at rest: the first segment's and that of the half cell above.
double head_load(const Case& input) {
    const Scene scene = build_scene(input);
    const test::Run result = run(scene, input.run, input.output);
    EXPECT_LT(result.last().energy.kinetic, 1e-2);
    return result.last().head_stress[3] + scene.weight.front() * scene.mesh.cell.front();
}

TEST(Buoyancy, OfTheSteelAloneLeavesAHeadLoadOf199Kilonewton) {
    EXPECT_NEAR(head_load(casing_in_mud(InsideOfPipe::fluid)), 199035, 20);
}

TEST(Buoyancy, OfAnEmptyPipeMakesTheCasingFloat) {
    // 52.0925 kg/m less 1917 kg/m3 times the area of the outer circle is -37.9 kg/m
    EXPECT_NEAR(head_load(casing_in_mud(InsideOfPipe::empty)), -37.9133 * 9.81 * 515, 20);
}

Case sinking_pipe(double inclination) {
    Case input = short_pipe(inclination);
    FluidCase fluid;
    fluid.density = 1000;
    fluid.viscosity = viscosity;
    input.fluid = fluid;
    return input;
}

TEST(Drag, PipeSinksAlongTheWellAtTheSpeedOfCouetteFlow) {
    Case input = sinking_pipe(0);
    input.run.duration = 3;
    input.output.profile_interval = 0.25;
    const test::Run result = run(input);
    const double drag = viscosity * 13.901309970439268;  // 2 pi mu / ln(11/7)
    for (const Profile& profile : result.profiles) {
        const double speed = profile.momentum.front()[3] / pipe_mass;
        const double expected =
            buoyed_weight / drag * (1 - std::exp(-drag / pipe_mass * profile.time));
        EXPECT_NEAR(speed, expected, 1e-4 * buoyed_weight / drag);
    }
}

TEST(Drag, PipeSinksToTheLowSideAsFastAsTheFilmLetsIt) {
    Case input = sinking_pipe(90 * degree);
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
                step * viscosity * drag_coefficients(middle, pipe_radius, hole_radius).radial;
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
