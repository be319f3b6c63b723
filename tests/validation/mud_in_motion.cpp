// Pipes that sink, turn and hang in mud which thins, yields and is pumped.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drillstrand/energy_audit.hpp"
#include "drillstrand/hydraulics.hpp"
#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

constexpr double pi = std::numbers::pi;
// (31.8557 kg/m less the water displaced by the steel) g
constexpr double buoyed_weight = 272.43968589;  // N/m

using MudInMotion = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, MudInMotion, both_integrators, integrator_name);

FluidCase power_law(double consistency, double index) {
    FluidCase fluid;
    fluid.density = 1000;
    fluid.viscosity = consistency;
    fluid.flow_index = index;
    fluid.regime = FlowRegime::laminar;
    fluid.added_mass = false;
    return fluid;
}

/// Speed at which a cylinder slides in another where it bears a stress (Pa).
double sliding_speed(const FluidCase& fluid, double stress) {
    const double power = 1 / fluid.flow_index - 1;
    const double rate = std::pow(stress / fluid.viscosity, 1 / fluid.flow_index);
    return rate * pipe_radius * (1 - std::pow(pipe_radius / hole_radius, power)) / power;
}

TEST_P(MudInMotion, PipeSinksInAPowerLawAsFastAsItsWeightShearsIt) {
    Case input = short_pipe(integrator(), 0);
    input.fluid = power_law(50, 0.7);
    input.run.duration = 2;
    input.run.cfl = 0.01;  // the leapfrog takes drag to first order in its step
    const test::Run result = run(input);
    const double speed = result.end().momentum.front()[3] / pipe_mass;
    const double expected = sliding_speed(*input.fluid, buoyed_weight / (2 * pi * pipe_radius));
    EXPECT_NEAR(speed, expected, 1e-3 * expected);
}

/// Couple per length on a cylinder that turns in a power law in another (N).
double turning_couple(const FluidCase& fluid, double spin) {
    const double n = fluid.flow_index;
    const double rate = 2 * spin / (n * (1 - std::pow(pipe_radius / hole_radius, 2 / n)));
    return 2 * pi * pipe_radius * pipe_radius * fluid.viscosity * std::pow(rate, n);
}

TEST_P(MudInMotion, PipeThatTurnsInAPowerLawTakesTheTorqueOfItsShear) {
    Case input = short_pipe(integrator(), 0);
    input.fluid = power_law(5, 0.6);
    input.head.motion = HeadMotion::driven;
    input.head.rotation = ScalarSchedule({0, 0.5}, {0, 10});
    input.damping.kelvin_voigt = 1e-3;
    input.run.duration = 10;
    input.output.interval = 10;
    const Scene scene = build_scene(input);
    // what the cell of the head takes does not go through the first segment
    const double turned = pipe_length - scene.mesh.cell.front();
    const double expected = turning_couple(*input.fluid, 10) * turned;
    EXPECT_NEAR(run(scene, input.run, input.output).last().surface_torque, expected,
                2e-3 * expected);
}

/// Casing that hangs in a vertical well while mud is pumped, damped.
Case pumped_casing(IntegratorKind integrator) {
    FluidCase mud;
    mud.density = 1200;
    mud.viscosity = 0.5;
    mud.flow_index = 0.7;
    mud.yield_stress = 5;
    mud.flow_rate = 0.04;
    mud.nozzle_area = 1e-3;
    return hanging_casing(integrator, mud);
}

TEST_P(MudInMotion, HangingStringWeighsItsBuoyedWeightLessTheLift) {
    const Case input = pumped_casing(integrator());
    const Scene scene = build_scene(input);
    const Hydraulics mud = hydraulics_of(scene, mud_motion(scene));
    EXPECT_LT(mud.axial_force, -2000);
    double weight = 0;
    for (std::size_t k = 0; k < scene.weight.size(); ++k)
        weight += scene.weight[k] * scene.mesh.cell[k];
    EXPECT_NEAR(run(scene, input.run, input.output).last().hook_load, weight + mud.axial_force, 20);
}

TEST_P(MudInMotion, StringThatFallsIntoPumpedMudKeepsItsAccountOfEnergy) {
    Case input = pumped_casing(integrator());
    input.damping.external = {};
    input.run.duration = 3;
    input.run.cfl = 0.1;
    input.initial.state = InitialState::coaxial;
    input.initial.by_default = false;
    EnergyAudit audit;
    for (const SeriesRecord& record : run(input).series)
        audit.add(record.energy);
    EXPECT_LT(std::abs(audit.residual()), 5e-3);
}

}  // namespace
}  // namespace drillstrand::test
