// A mud motor between string and bit: its curve, what it does to the string, and what it tells.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "drillstrand/equilibrium.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double stall_torque = 12e3;    // N m
constexpr double no_load_speed = 11.31;  // rad/s
constexpr double exponent = 4.538;
constexpr double displacement = 0.02;  // m3
constexpr double inertia = 8;          // kg m2

/// Pipe with a motor at its end, and a bit with the rest of its table.
std::string motor(const std::string& bit, double rotation, double duration,
                  const std::string& pipe =
                      "length = 100\nouter_diameter = 0.127\n"
                      "inner_diameter = 0.1086") {
    return fmt::format(R"(
        gravity = 0
        [[string.component]]
        {}
        density = 7850
        youngs_modulus = 206e9
        [mesh]
        segments = 20
        [head]
        rotation = [[0, 0], [2, {}]]
        [bit]
        inertia = {}
        {}
        [bit.motor]
        stall_torque = {}
        no_load_speed = {}
        exponent = {}
        displacement = {}
        [damping]
        external_rotation = 1
        [run]
        duration = {}
        [output]
        interval = 0.001
        profile_interval = 0
        )",
                       pipe, rotation, inertia, bit, stall_torque, no_load_speed, exponent,
                       displacement, duration);
}

double speed_under(double torque) {
    return no_load_speed * (1 - std::pow(torque / stall_torque, exponent));
}

TEST(MudMotor, AddsItsSpeedToThatOfTheStringAndTwistsItWithTheTorqueOfTheRock) {
    const double torque = 7e3;
    const double rotation = 5;
    const test::Run run = test::run(motor("law = \"stribeck\"\nstatic_torque = 7e3", rotation, 20));
    const SeriesRecord& last = run.last();
    EXPECT_NEAR(last.bit_rotation_rate, rotation + speed_under(torque), 1e-3 * rotation);
    EXPECT_NEAR(last.bit_torque, torque, 1e-6 * torque);
    EXPECT_NEAR(last.motor_pressure, 2 * pi * torque / displacement, 1e-4 * last.motor_pressure);
    // D_ex brakes the free cells: all but half a cell at the head, and at the last segment's middle
    // half a cell still counts
    EXPECT_NEAR(last.bit_stress[0], -torque - 2.5 * rotation, 1e-3 * torque);
    EXPECT_NEAR(last.surface_torque, torque + 97.5 * rotation, 1e-3 * torque);
    const EnergyAccount& energy = last.energy;
    EXPECT_NEAR(energy.stored() + energy.dissipation - energy.work, 0,
                1e-3 * (energy.dissipation + energy.stored()));
}

TEST(MudMotor, OpposesAScheduledTorqueAlike) {
    const test::Run run = test::run(motor("torque = 7e3", 0, 20));
    EXPECT_NEAR(run.last().bit_rotation_rate, speed_under(7e3), 1e-3);
    EXPECT_NEAR(run.last().surface_torque, 7e3, 7);
}

TEST(MudMotor, StallsOnRockThatAsksForMore) {
    const test::Run run = test::run(motor("law = \"stribeck\"\nstatic_torque = 13e3", 0, 20));
    for (const SeriesRecord& record : run.series)
        ASSERT_EQ(record.bit_rotation_rate, 0) << record.time;
    EXPECT_NEAR(run.last().surface_torque, stall_torque, 1e-3 * stall_torque);
    EXPECT_NEAR(run.last().motor_pressure, 2 * pi * stall_torque / displacement, 10);
}

/// Without rock J dw/dt = T_max (1 - w/w_0)^(1/alpha): with x = 1 - w/w_0 and
/// b = 1 - 1/alpha, x^b = 1 - b T_max t / (J w_0), until x = 0. The string is so stiff that it
/// stands still.
TEST(MudMotor, SpinsItsRotorUpAsItsCurveHasIt) {
    const test::Run run = test::run(motor("law = \"stribeck\"\nstatic_torque = 0", 0, 0.02,
                                          "length = 1\nouter_diameter = 0.5"));
    const double b = 1 - 1 / exponent;
    const double pace = b * stall_torque / (inertia * no_load_speed);
    ASSERT_GT(run.series.size(), 2U);
    for (const SeriesRecord& record : run.series) {
        const double left = 1 - pace * record.time;
        if (left <= 0) break;
        const double rotor = no_load_speed * (1 - std::pow(left, 1 / b));
        EXPECT_NEAR(record.bit_rotation_rate, rotor, 2e-3 * no_load_speed) << record.time;
    }
}

TEST(MudMotor, TwistsAStringThatSlidesInStaticsToo) {
    for (const auto& [asked, given] : {std::pair(7e3, 7e3), std::pair(13e3, stall_torque)}) {
        const Case input = test::case_from(motor(fmt::format("torque = {}", asked), 0, 1));
        EquilibriumOptions sliding;
        sliding.motion = steady_motion(StringMotion::sliding, 0.1);
        const Equilibrium found = find_equilibrium(build_static_scene(input), sliding);
        EXPECT_NEAR(found.surface_torque, given, 1e-3);
    }
}

TEST(MudMotor, LetsAnAutodrillerKeepItsPressure) {
    // the rock asks for torque as the bit is fed: pressure is all that limits the drum
    const double pressure = 2e6;
    const test::Run run =
        test::run(fmt::format(R"(
        gravity = 9.81
        [[string.component]]
        length = 200
        outer_diameter = 0.127
        inner_diameter = 0.1086
        density = 7850
        youngs_modulus = 206e9
        [mesh]
        segments = 20
        [head.hoist]
        mass = 12e3
        line_stiffness = 1e6
        lines = 10
        [head.hoist.autodriller]
        pressure = {}
        pressure_gain = 2e-9
        pressure_reset = 4
        [bit]
        law = "cutting"
        inertia = {}
        off_bottom = 0.002
        blades = 4
        intrinsic_specific_energy = "600 MPa"
        inclination_number = 0.1
        [bit.motor]
        stall_torque = {}
        no_load_speed = {}
        displacement = {}
        [damping]
        kelvin_voigt = 0.01
        external_translation = 50
        external_rotation = 0.5
        [run]
        duration = 90
        [output]
        interval = 0.1
        profile_interval = 0
        )",
                              pressure, inertia, stall_torque, no_load_speed, displacement));
    double mean = 0;
    double rate = 0;
    int count = 0;
    for (const SeriesRecord& record : run.series) {
        if (record.time < 60) continue;
        mean += record.motor_pressure;
        rate += record.bit_rotation_rate;
        ++count;
    }
    EXPECT_NEAR(mean / count, pressure, 0.01 * pressure);
    const double torque = pressure * displacement / (2 * pi);
    EXPECT_NEAR(rate / count, speed_under(torque), 0.02 * no_load_speed);
}

}  // namespace
}  // namespace drillstrand
