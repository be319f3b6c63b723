// Blades that cut what the one before has left: steady drilling, and axial vibration that grows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/run_case.hpp"

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double length = 2000;        // m
constexpr double bit_radius = 0.0635;  // m, of the pipe

/// 2000 m of 5 in pipe, c_a/c_t = 1.6: Poisson's ratio of 0.28.
struct Pipe {
    static constexpr double youngs_modulus = 203e9;
    static constexpr double density = 7850;
    double area = pi / 4 * (0.127 * 0.127 - 0.1086 * 0.1086);
    double shear_speed = std::sqrt(youngs_modulus / (2 * 1.28) / density);
    double impedance = area * std::sqrt(youngs_modulus * density);
};

std::string drilling(double metres, const std::string& mesh, const std::string& bit,
                     const std::string& cutting, double rotation, double duration,
                     const std::string& rest = "") {
    return fmt::format(R"(
        gravity = 0
        [[string.component]]
        length = {}
        outer_diameter = 0.127
        inner_diameter = 0.1086
        density = {}
        youngs_modulus = {}
        poisson_ratio = 0.28
        [mesh]
        {}
        [head]
        rotation = [[0, 0], [20, {}]]
        [bit]
        law = "cutting"
        {}
        {}
        [run]
        duration = {}
        [output]
        interval = 0.01
        profile_interval = 0
        {}
        )",
                       metres, Pipe::density, Pipe::youngs_modulus, mesh, rotation, bit, cutting,
                       duration, rest);
}

class CuttingBitOn : public testing::TestWithParam<const char*> {};

TEST_P(CuttingBitOn, DrillsAsDetournayAndDefournyHaveIt) {
    // short and damped enough not to vibrate
    const double speed = 1e-3;  // m/s
    const double rotation = 10;
    const test::Run run = test::run(drilling(
        50, GetParam(), "feed = 1e-3",
        "blades = 4\nintrinsic_specific_energy = \"30 MPa\"\ninclination_number = 0.7\nwear_length "
        "= 1e-3\n"
        "contact_strength = \"20 MPa\"\nfriction = 0.5",
        rotation, 120,
        "[damping]\nexternal_translation = 2000\nexternal_rotation = 0.5\nkelvin_voigt = 1e-3"));
    const SeriesRecord& last = run.last();
    const double depth = speed * 2 * pi / rotation;
    const double cutting = bit_radius * 0.7 * 30e6 * depth;
    const double flats = bit_radius * 1e-3 * 20e6;
    EXPECT_NEAR(last.depth_of_cut, depth, 1e-3 * depth);
    EXPECT_NEAR(last.weight_on_bit, cutting + flats, 1e-3 * cutting);
    EXPECT_NEAR(last.bit_torque, 0.5 * bit_radius * (bit_radius * 30e6 * depth + 0.5 * flats),
                1e-3 * cutting);
    EXPECT_NEAR(last.bit_rotation_rate, rotation, 1e-3 * rotation);
    const EnergyAccount& energy = last.energy;
    EXPECT_NEAR(energy.stored() + energy.dissipation - energy.work, 0,
                2e-3 * std::abs(energy.work));
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, CuttingBitOn,
    testing::Values("segments = 10",
                    "element_length = 5\nrefine = [{from = 40, to = 50, element_length = 0.5}]"),
    [](const auto& of) { return of.index == 0 ? "Even" : "FineAtTheBit"; });

TEST(CuttingBit, PressesOnNothingBeforeItIsOnBottom) {
    const test::Run run = test::run(drilling(100, "segments = 20", "feed = 1e-3\noff_bottom = 5e-3",
                                             "intrinsic_specific_energy = \"60 MPa\"", 5, 15));
    for (const SeriesRecord& record : run.series) {
        if (record.time > 4.99) continue;
        EXPECT_NEAR(record.drilled, 1e-3 * record.time - 5e-3, 1e-9);
        EXPECT_EQ(record.weight_on_bit, 0);
        EXPECT_EQ(record.bit_torque, 0);
    }
    EXPECT_GT(run.last().weight_on_bit, 100);
}

/// Turns over time of the depth of cut about its mean, and how much larger its swings are late.
struct Swing {
    double rate;    ///< rad/s
    double growth;  ///< of the root of the mean square, from one window to one 100 L/c_t later
};

/// K of the string with its head held: K = a zeta eps n L / (Z c_t).
Swing swing(double number, double delay) {
    const Pipe pipe;
    const double unit = length / pipe.shear_speed;  // s
    const int blades = 6;
    const double rotation = 2 * pi / (blades * delay * unit);
    // force along the rock is a thousandth of that into it: the torque does not turn the string
    const double inclination = 1000;
    const double energy =
        number * pipe.impedance * pipe.shear_speed / length / (bit_radius * inclination * blades);
    const double damping = 0.3567 / unit * Pipe::density * pipe.area;
    const test::Run run = test::run(drilling(
        length, "segments = 160", "feed = [[0, 0], [30, 1e-3]]",
        fmt::format("blades = {}\ninclination_number = {}\nintrinsic_specific_energy = {:.17g}",
                    blades, inclination, energy),
        rotation, 260 * unit,
        fmt::format("[damping]\nexternal_translation = {:.17g}\nexternal_rotation = 0.3",
                    damping)));
    const auto window = [&](double begin) {
        std::vector<double> depth;
        for (const SeriesRecord& record : run.series)
            if (record.time >= begin * unit && record.time < (begin + 60) * unit)
                depth.push_back(record.depth_of_cut);
        double mean = 0;
        for (const double d : depth)
            mean += d / static_cast<double>(depth.size());
        for (double& d : depth)
            d -= mean;
        return depth;
    };
    const auto size = [](const std::vector<double>& depth) {
        double sum = 0;
        for (const double d : depth)
            sum += d * d;
        return std::sqrt(sum / static_cast<double>(depth.size()));
    };
    const std::vector<double> late = window(200);
    int crossings = 0;
    for (std::size_t i = 1; i < late.size(); ++i)
        crossings += late[i - 1] < 0 && late[i] >= 0 ? 1 : 0;
    return {2 * pi * crossings / (60 * unit), size(late) / size(window(100))};
}

struct Threshold {
    double delay;   ///< of a blade after the one before, c_t/L
    double number;  ///< K*
    double rate;    ///< omega L/c_t
};

// From the characteristic equation q coth(q c_t/c_a) + K (1 - exp(- s t)) = 0, q^2 = s (s +
// 0.3567), all in L/c_t: the least K with a root on the imaginary axis.
class Regeneration : public testing::TestWithParam<Threshold> {};

TEST_P(Regeneration, GrowsAboveItsThresholdAlone) {
    const auto& [delay, number, rate] = GetParam();
    const double unit = length / Pipe().shear_speed;
    const Swing below = swing(0.97 * number, delay);
    const Swing above = swing(1.03 * number, delay);
    EXPECT_LT(below.growth, 1) << delay;
    EXPECT_GT(above.growth, 1) << delay;
    EXPECT_NEAR(above.rate * unit, rate, 0.03 * rate);
    SCOPED_TRACE(fmt::format("growth {} and {}", below.growth, above.growth));
}

INSTANTIATE_TEST_SUITE_P(AtDelays, Regeneration,
                         testing::Values(Threshold{0.25, 2.119, 17.83}, Threshold{0.5, 1.341, 7.98},
                                         Threshold{1, 1.729, 3.68}, Threshold{2, 0.357, 2.63}),
                         [](const auto& of) {
                             return "Of" + std::to_string(std::lround(100 * of.param.delay));
                         });

}  // namespace
}  // namespace drillstrand
