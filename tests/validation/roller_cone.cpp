// Cones that roll over a bottom with lobes: how fast they drill, and how they shake the string.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "support/run_case.hpp"

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radius = 0.0635;  // m, of the pipe
constexpr double density = 7850;
constexpr double youngs_modulus = 206e9;
constexpr double area = pi / 4 * (0.127 * 0.127 - 0.1086 * 0.1086);
constexpr double stiffness = 30e6;  // N/m, of rock and teeth
constexpr double drag = 50;         // N s/m2, on the string's axial motion
constexpr double length = 500;      // m

std::string cones(double lobe_height, const std::string& head, const std::string& bit,
                  double specific_energy, double duration, double friction = 0.4) {
    return fmt::format(R"(
        gravity = 0
        [[string.component]]
        length = {}
        outer_diameter = 0.127
        inner_diameter = 0.1086
        density = {}
        youngs_modulus = {}
        [mesh]
        segments = 100
        [head]
        rotation = {}
        [bit]
        law = "roller_cone"
        friction = {}
        {}
        lobe_height = {}
        rock_stiffness = {}
        specific_energy = {}
        [damping]
        external_translation = {}
        external_rotation = 1
        [run]
        duration = {}
        [output]
        interval = 0.005
        profile_interval = 0
        )",
                       length, density, youngs_modulus, head, friction, bit, lobe_height, stiffness,
                       specific_energy, drag, duration);
}

TEST(RollerCone, DrillsWithTheWorkThatTheRockTakes) {
    const double speed = 2e-3;  // m/s
    const double rotation = 10;
    const double specific_energy = 100e6;
    const test::Run run = test::run(
        cones(0, "[[0, 0], [5, 10]]", "feed = [[0, 0], [5, 2e-3]]", specific_energy, 120));
    const SeriesRecord& last = run.last();
    const double torque = specific_energy * pi * radius * radius * speed / rotation;
    EXPECT_NEAR(last.bit_torque, torque, 2e-3 * torque);
    EXPECT_NEAR(last.weight_on_bit, torque / (0.4 * pi * radius / 4), 2e-3 * last.weight_on_bit);
    EXPECT_NEAR(last.depth_of_cut, 2 * pi * speed / rotation, 2e-3 * last.depth_of_cut);
    EXPECT_NEAR(last.bit_rotation_rate, rotation, 1e-3 * rotation);
}

/// A string that is held above and damped by d per length answers a force at its end with the
/// stiffness EA k cot(k L), k^2 = (m w^2 - i w d)/EA. In series with that of the rock it carries
/// lobes of the amplitude h/2.
double exact_swing(double lobe_height, double frequency) {
    using Complex = std::complex<double>;
    constexpr double axial_stiffness = youngs_modulus * area;
    const Complex k = std::sqrt(Complex(density * area * frequency * frequency, -frequency * drag) /
                                axial_stiffness);
    const Complex string = axial_stiffness * k / std::tan(k * length);
    return std::abs(0.5 * lobe_height * stiffness * string / (stiffness + string));
}

TEST(RollerCone, ShakesTheStringThreeTimesATurn) {
    const double lobe_height = 4e-4;
    for (const double rotation : {6.0, 9.0, 14.0}) {
        // rock that is not drilled, under a bit that is pressed to it and stays on it, on a bottom
        // so smooth that it turns evenly
        const test::Run run =
            test::run(cones(lobe_height, fmt::format("[[0, 0], [5, {}]]", rotation),
                            "feed = [[0, 1e-3], [20, 1e-3], [20.1, 0]]", 1e12, 60, 1e-3));
        double least = 1e300;
        double most = 0;
        for (const SeriesRecord& record : run.series) {
            if (record.time < 40) continue;
            least = std::min(least, record.weight_on_bit);
            most = std::max(most, record.weight_on_bit);
        }
        EXPECT_GT(least, 0);
        const double swing = exact_swing(lobe_height, 3 * rotation);
        EXPECT_NEAR(0.5 * (most - least), swing, 0.02 * swing) << rotation;
    }
}

TEST(RollerCone, TakesNoMoreThanItGivesOnLobesWithoutFriction) {
    const test::Run run = test::run(
        cones(2e-3, "[[0, 0], [5, 12]]", "feed = [[0, 1e-3], [20, 1e-3], [20.1, 0]]", 1e12, 60, 0));
    const EnergyAccount& energy = run.last().energy;
    // lobes are potential: in the mean they brake the head with what the string's drag takes
    EXPECT_NEAR(energy.stored() + energy.dissipation - energy.work, 0,
                2e-3 * (energy.stored() + energy.dissipation));
}

}  // namespace
}  // namespace drillstrand
