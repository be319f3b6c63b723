// Mud that has inertia: its mass goes along with a pipe, its flow resists with the square of speed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "drillstrand/energy_audit.hpp"
#include "support/annular_flow.hpp"
#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

using FluidMass = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, FluidMass, both_integrators, integrator_name);
using InertialDrag = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, InertialDrag, both_integrators, integrator_name);

FluidCase water() {
    FluidCase fluid;
    fluid.density = 1000;
    fluid.viscosity = 1e-3;
    return fluid;
}

Vector3d none(double /*time*/) {
    return Vector3d::Zero();
}

/// The pipe, held at its head, weightless, in the middle of a vertical well full of a fluid that
/// does not rub; a force bends it aside (N) and lets it go at once.
Case swinging_pipe(IntegratorKind integrator, double hole, double aside) {
    Case input = short_pipe(integrator, 0);
    input.gravity = 0;
    input.well->sections.front().diameter = 2 * hole;
    input.mesh.segments = 10;
    input.head.motion = HeadMotion::driven;
    input.fluid = water();
    input.fluid->drag = false;
    constexpr double rise = 2;
    std::vector<double> times;
    std::vector<Vector3d> forces;
    for (int i = 0; i <= 20; ++i) {
        times.push_back(rise * i / 20);
        forces.emplace_back(0, aside * smooth_step(times.back(), 0, rise), 0);
    }
    times.push_back(rise + 1e-3);
    forces.emplace_back(0, 0, 0);
    input.bit.force = VectorSchedule(times, forces);
    input.output.interval = 0.01;
    return input;
}

/// Mean period of the bit's swing toward the East between its first and last passages upward.
double period(const Run& run, double start) {
    double first = 0;
    double last = 0;
    int passages = 0;
    for (std::size_t i = 1; i < run.series.size(); ++i) {
        const SeriesRecord& a = run.series[i - 1];
        const SeriesRecord& b = run.series[i];
        if (a.time < start || a.bit_position.y() >= 0 || b.bit_position.y() < 0) continue;
        const double part = a.bit_position.y() / (a.bit_position.y() - b.bit_position.y());
        last = a.time + part * (b.time - a.time);
        if (passages == 0) first = last;
        ++passages;
    }
    EXPECT_GT(passages, 5);
    return (last - first) / (passages - 1);
}

/// First period of a cantilever of that pipe with a mass (kg/m).
double period_of_cantilever(double mass) {
    constexpr double beta = 1.8751040687119611;
    const double bending = 200e9 * pi / 64 * (std::pow(0.14, 4) - std::pow(0.12, 4));
    return 2 * pi / (beta * beta / (pipe_length * pipe_length) * std::sqrt(bending / mass));
}

TEST_P(FluidMass, InAndAroundAPipeSlowsItsSwingAsItsMassWould) {
    constexpr double hole = 0.5;
    const double bore = pi / 4 * 0.12 * 0.12;
    for (const InsideOfPipe inside : {InsideOfPipe::fluid, InsideOfPipe::empty}) {
        Case input = swinging_pipe(integrator(), hole, 20);
        input.fluid->inside = inside;
        input.run.duration = 12;
        const double mass = pipe_mass + lateral_fluid(*input.fluid, {pipe_radius, hole, 0}, bore);
        const double expected = period_of_cantilever(mass);
        EXPECT_NEAR(period(run(input), 2.5), expected, 0.005 * expected);
    }
    Case dry = swinging_pipe(integrator(), hole, 20);
    dry.fluid->added_mass = false;
    dry.run.duration = 12;
    const double expected = period_of_cantilever(pipe_mass);
    EXPECT_NEAR(period(run(dry), 2.5), expected, 0.005 * expected);
}

/// Residual of the energy account over what moves in a pipe that swings far across a narrow well,
/// where the mass of the fluid grows by half.
double residual_of_a_wide_swing(IntegratorKind integrator, bool added_mass) {
    Case input = swinging_pipe(integrator, hole_radius, 170);
    input.fluid->added_mass = added_mass;
    input.run.duration = 8;
    const test::Run result = run(input);
    EnergyAudit audit;
    double aside = 0;
    for (const SeriesRecord& record : result.series) {
        audit.add(record.energy);
        aside = std::max(aside, std::abs(record.bit_position.y()));
    }
    EXPECT_GT(aside, 0.6 * clearance);
    EXPECT_LT(aside, clearance);
    return std::abs(audit.residual());
}

TEST_P(FluidMass, ThatChangesWithThePlaceNeitherMakesNorLosesEnergy) {
    EXPECT_LT(residual_of_a_wide_swing(integrator(), false), 1e-3);
    EXPECT_LT(residual_of_a_wide_swing(integrator(), true), 1e-3);
}

// p^2 / (2 M(e)) does not change along the way: a pipe that comes near the wall slows down
TEST_P(FluidMass, TakesSpeedFromAPipeThatComesNearTheWall) {
    Case input = short_pipe(integrator(), 0);
    input.gravity = 0;
    input.fluid = water();
    input.fluid->drag = false;
    const double bore = pi / 4 * 0.12 * 0.12;
    const auto mass_at = [&](double e) {
        return pipe_mass + lateral_fluid(*input.fluid, {pipe_radius, hole_radius, e}, bore);
    };
    push_east(input, 0.05 * mass_at(0));
    input.run.duration = 0.8;
    input.run.cfl = 0.1;
    input.output.profile_interval = 0.05;
    const test::Run result = run(input);
    const auto speed = [&](const Profile& profile) {
        return profile.momentum.front()[4] / mass_at(profile.eccentricity.front());
    };
    const Profile& start = result.profiles.at(3);
    const double energy = mass_at(start.eccentricity.front()) * std::pow(speed(start), 2);
    EXPECT_NEAR(speed(start), 0.05, 1e-3);
    double nearest = 0;
    for (std::size_t i = 4; i < result.profiles.size(); ++i) {
        const Profile& profile = result.profiles[i];
        const double e = profile.eccentricity.front();
        if (e > 0.98 * clearance) break;
        nearest = e;
        EXPECT_NEAR(profile.fluid_mass.front(), mass_at(e) - pipe_mass, 2e-3 * mass_at(e));
        EXPECT_NEAR(mass_at(e) * std::pow(speed(profile), 2), energy, 5e-3 * energy) << e;
    }
    EXPECT_GT(nearest, 0.8 * clearance);
}

TEST_P(InertialDrag, BrakesAPipeThatMovesAcrossAWideHoleByTheSquareOfItsSpeed) {
    constexpr double hole = 1.1;
    Case input = short_pipe(integrator(), 0);
    input.gravity = 0;
    input.well->sections.front().diameter = 2 * hole;
    input.fluid = water();
    input.fluid->viscosity = 0;
    input.fluid->drag_coefficient = 1.2;
    const double bore = pi / 4 * 0.12 * 0.12;
    const double mass = pipe_mass + lateral_fluid(*input.fluid, {pipe_radius, hole, 0}, bore);
    push_east(input, mass * 1);
    input.run.duration = 0.6;
    input.run.cfl = 0.05;
    input.output.profile_interval = 0.1;
    const test::Run result = run(input);
    const auto speed = [&](const Profile& profile) {
        return profile.momentum.front()[4] / (pipe_mass + profile.fluid_mass.front());
    };
    // C_d rho R (Rw / (Rw - R))^2
    const double drag = 1.2 * 1000 * pipe_radius * std::pow(hole / (hole - pipe_radius), 2);
    const Profile& start = result.profiles.at(1);
    EXPECT_GT(speed(start), 0.8);
    for (std::size_t i = 2; i < result.profiles.size(); ++i) {
        const double time = result.profiles[i].time - start.time;
        const double expected = speed(start) / (1 + drag * speed(start) * time / mass);
        EXPECT_NEAR(speed(result.profiles[i]), expected, 5e-3 * expected) << time;
    }
    EXPECT_LT(speed(result.end()), 0.6 * speed(start));
}

/// Spin at which a pipe in the middle of the well turns under a torque (N m/m) in the end.
double terminal_spin(IntegratorKind integrator, const FluidCase& fluid, double torque) {
    Case input = short_pipe(integrator, 0);
    input.gravity = 0;
    input.fluid = fluid;
    constexpr double inertia = 1e-4;  // kg m: soon at its last speed
    input.string.components.front().polar_inertia = inertia;
    load(input, 1, 0.5, none, [torque](double /*time*/) { return Vector3d(0, 0, torque); });
    input.run.duration = 3;
    input.output.profile_interval = 1.5;
    const test::Run result = run(input);
    const auto spin_of = [](const Profile& profile) {
        return profile.momentum.front()[0] / inertia;
    };
    EXPECT_NEAR(spin_of(result.end()) / spin_of(result.profiles.at(1)), 1, 1e-3);
    EXPECT_LT(result.end().eccentricity.front(), 1e-6);
    return spin_of(result.end());
}

TEST_P(InertialDrag, LetsAPipeSpinAsFastAsThePrintedCorrelationBearsItsTorque) {
    const Annulus annulus = {pipe_radius, hole_radius, 0};
    const FluidCase fluid = water();
    // Reynolds numbers R w t / nu of 5 600, where vortices rule, and of 56 000, turbulent
    for (const double spin : {2.0, 20.0}) {
        const double torque = turbulent_torque(fluid, annulus, spin);
        const double found = terminal_spin(integrator(), fluid, torque);
        // the laminar couple adds the square of its share: one part in a hundred at most
        EXPECT_NEAR(found, spin, 0.01 * spin);
        const double laminar = fluid.viscosity * 4 * pi * std::pow(pipe_radius * hole_radius, 2) /
                               (std::pow(hole_radius, 2) - std::pow(pipe_radius, 2)) * found;
        EXPECT_NEAR(std::hypot(laminar, turbulent_torque(fluid, annulus, found)), torque,
                    5e-3 * torque);
    }
}

}  // namespace
}  // namespace drillstrand::test
