// The hoist: block and travelling gear on lines, with a string below, against exact solutions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "support/run_case.hpp"

namespace drillstrand {
namespace {

using std::numbers::pi;
using Records = test::Run;

/// 1000 m of 5 in pipe that hangs: EA, mass per length and speed of axial waves.
constexpr double length = 1000;
constexpr double axial_stiffness = 7.1e8;
constexpr double mass = 30;

std::string hanging_pipe(int segments, const std::string& hoist, double duration,
                         const std::string& more = "") {
    return fmt::format(R"(
        [[string.component]]
        length = {}
        linear_density = {}
        inertia = 0.05
        polar_inertia = 0.1
        bending_stiffness = 2e6
        torsional_stiffness = 1.6e6
        axial_stiffness = {}
        shear_stiffness = 3e8
        [mesh]
        segments = {}
        [head.hoist]
        {}
        [run]
        duration = {}
        {})",
                       length, mass, axial_stiffness, segments, hoist, duration, more);
}

double unaccounted(const EnergyAccount& energy) {
    return energy.stored() + energy.dissipation - energy.work;
}

TEST(Hoist, StretchesItsLinesByWhatIsHungOnThem) {
    // the string is let go unstretched: block and string sink and come to rest
    const Records run =
        test::run(hanging_pipe(40, "mass = 12e3\nline_stiffness = 4e5\nlines = 10", 60,
                               "[damping]\nkelvin_voigt = 0.02\nexternal_translation = 20\n"
                               "[output]\ninterval = 1\n"));
    const double weight = mass * 9.80665 * length;
    const SeriesRecord& last = run.last();
    // they carried the block and the head's half cell from the start
    const double hung = weight * (1 - 0.5 / 40);
    EXPECT_NEAR(last.head_position.z(), hung / 4e6, 1e-4 * hung / 4e6);
    EXPECT_NEAR(last.hook_load, weight, 1e-5 * weight);
    EXPECT_NEAR(last.dead_line_tension, (weight + 12e3 * 9.80665) / 10, 1e-5 * weight);
    EXPECT_NEAR(run.series.front().dead_line_tension * 10, 12e3 * 9.80665 + weight - hung, 1);
    EXPECT_NEAR(unaccounted(last.energy), 0, 2e-3 * std::abs(last.energy.potential));
}

/// The first frequency (rad/s) of a bar, free below, whose upper end has a mass M on a spring K:
/// K - M w^2 = (EA/c) w tan(w L/c).
double first_frequency(double block, double stiffness) {
    const double c = std::sqrt(axial_stiffness / mass);
    const double z = axial_stiffness / c;
    double low = 1e-6;
    double high = 0.5 * pi * c / length * (1 - 1e-12);
    const auto left = [&](double w) {
        return stiffness - block * w * w - z * w * std::tan(w * length / c);
    };
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (left(middle) > 0 ? low : high) = middle;
    }
    return low;
}

/// The frequency (rad/s) of a record that swings about a mean, by its crossings.
double frequency_of(const Records& run, double begin) {
    double mean = 0;
    double count = 0;
    for (const SeriesRecord& record : run.series)
        if (record.time >= begin) {
            mean += record.head_position.z();
            ++count;
        }
    mean /= count;
    double first = -1;
    double last = 0;
    int periods = -1;
    for (std::size_t i = 1; i < run.series.size(); ++i) {
        const double a = run.series[i - 1].head_position.z() - mean;
        const double b = run.series[i].head_position.z() - mean;
        if (run.series[i].time < begin || !(a < 0 && b >= 0)) continue;
        last = run.series[i - 1].time + a / (a - b) * (run.series[i].time - run.series[i - 1].time);
        if (first < 0) first = last;
        ++periods;
    }
    return 2 * pi * periods / (last - first);
}

TEST(Hoist, BouncesOnItsLinesAtTheFrequencyOfABarWithMassAndSpring) {
    for (const double block : {2e3, 20e3})
        for (const double stiffness : {1e6, 2e7}) {
            const Records run = test::run(
                hanging_pipe(80, fmt::format("mass = {}\nline_stiffness = {}\n", block, stiffness),
                             40, "[damping]\nkelvin_voigt = 2e-3\n[output]\ninterval = 0.01\n"));
            const double exact = first_frequency(block, stiffness);
            EXPECT_NEAR(frequency_of(run, 5), exact, 2e-3 * exact)
                << block << " kg on " << stiffness << " N/m";
            EXPECT_NEAR(unaccounted(run.last().energy), 0,
                        2e-3 * std::abs(run.last().energy.potential));
        }
}

TEST(Hoist, ReflectsWavesByItsImpedance) {
    // a force at the bit sends a wave up a string so long that none comes twice; at the head
    // Z = i (M w - K/w), and F = Z v of block and lines
    constexpr double frequency = 1.5;
    constexpr double w = 2 * pi * frequency;
    constexpr double block = 15e3;
    constexpr double lines = 8e5;
    std::string sine = "[[0, [0, 0, 0]]";
    for (int i = 1; i <= 1200; ++i) {
        const double t = 0.01 * i;
        sine += fmt::format(", [{}, [0, 0, {:.6f}]]", t, 1000 * std::min(1.0, t) * std::sin(w * t));
    }
    std::string text = hanging_pipe(
        1000, fmt::format("mass = {}\nline_stiffness = {}", block, lines), 11.5,
        "[bit]\nforce = " + sine + "]\n[output]\ninterval = 0.01\nprofile_interval = 0\n");
    text.replace(text.find("length = 1000"), 13, "length = 30000");
    const Case input = test::case_from(text);
    // a string without weight: that of the block keeps the lines taut
    Scene scene = build_scene(input);
    std::fill(scene.weight.begin(), scene.weight.end(), 0.0);
    const Records run = test::run(scene, input.run, input.output);
    using Complex = std::complex<double>;
    Complex force = 0;
    Complex place = 0;
    for (const SeriesRecord& record : run.series) {
        if (record.time <= 11.5 - 4 / frequency + 1e-6) continue;
        const Complex turn = std::exp(Complex(0, -w * record.time));
        force += turn * record.hook_load;
        place += turn * record.head_position.z();
    }
    const Complex speed = Complex(0, w) * place;
    // the half cell at the head belongs to the string
    const Complex at_head = force / speed - Complex(0, w * mass * 15);
    const Complex exact(0, w * block - lines / w);
    EXPECT_NEAR(std::abs(at_head - exact), 0, 0.01 * std::abs(exact));
    const double zeta = std::sqrt(axial_stiffness * mass);
    const Complex reflected = (at_head - zeta) / (at_head + zeta);
    EXPECT_NEAR(std::abs(reflected), 1, 5e-3);
    EXPECT_NEAR(std::arg(reflected), std::arg((exact - zeta) / (exact + zeta)), 0.01);
}

TEST(Hoist, LowersTheStringAsTheDrumFeedsIt) {
    const Records run =
        test::run(hanging_pipe(40,
                               "mass = 12e3\nline_stiffness = 1e6\nlines = 8\n"
                               "block_speed = [[0, 0], [1, 0.5], [11, 0.5], [12, 0]]",
                               60,
                               "[damping]\nkelvin_voigt = 0.02\nexternal_translation = 20\n"
                               "[output]\ninterval = 1\n"));
    const double weight = mass * 9.80665 * length;
    EXPECT_NEAR(run.last().head_position.z(), 5.5 + weight / 8e6, 1e-3);
    EXPECT_NEAR(unaccounted(run.last().energy), 0, 1e-3 * std::abs(run.last().energy.potential));
}

TEST(Hoist, SlipsAtTheHookLoadThatItsBrakeHolds) {
    // the brake holds less than the string weighs: block and string fall by the rest, as one, and
    // on the mean with a = (W - H)/(M + m L)
    const double weight = mass * 9.80665 * length;
    const double held = 0.9 * weight;
    const Records run = test::run(
        hanging_pipe(40, fmt::format("mass = 12e3\nline_stiffness = 1e7\nhook_load = {}", held), 4,
                     "[damping]\nkelvin_voigt = 0.02\n[output]\ninterval = 0.1\n"));
    const SeriesRecord& last = run.last();
    EXPECT_NEAR(last.dead_line_tension, held + 12e3 * 9.80665, 1e-6 * held);
    const SeriesRecord& before = run.series[20];
    const SeriesRecord& middle = run.series[30];
    const double acceleration =
        last.head_position.z() - 2 * middle.head_position.z() + before.head_position.z();
    EXPECT_NEAR(acceleration, 0.1 * weight / (12e3 + mass * length), 0.03);
    // a brake that holds more than it has to does not slip
    const Records still = test::run(hanging_pipe(
        40, fmt::format("mass = 12e3\nline_stiffness = 1e7\nhook_load = {}", 3 * weight), 20,
        "[damping]\nkelvin_voigt = 0.02\n[output]\ninterval = 1\n"));
    EXPECT_NEAR(still.last().head_position.z(), weight / 1e7, 0.05 * weight / 1e7);
}

TEST(Hoist, OfLinesTooStiffToTellIsAClampedHead) {
    const auto bit = [](const std::string& hoist) {
        std::string text = hanging_pipe(40, hoist, 2, "[output]\ninterval = 0.1\n");
        if (hoist.empty()) text.replace(text.find("[head.hoist]"), 12, "");
        std::vector<double> place;
        for (const SeriesRecord& record : test::run(text).series)
            place.push_back(record.bit_position.z());
        return place;
    };
    const std::vector<double> clamped = bit("");
    const std::vector<double> stiff = bit("mass = 1\nline_stiffness = 1e14");
    for (std::size_t i = 0; i < clamped.size(); ++i)
        EXPECT_NEAR(stiff[i], clamped[i], 1e-4);
}

TEST(Autodriller, FeedsByTheMostLimitingLoopAndStopsAtTheWeight) {
    // as the rock takes weight from the hook, the drum slows, and stands still where it is too much
    Case input = test::case_from(hanging_pipe(40, R"(
        mass = 12e3
        line_stiffness = 1e7
        [head.hoist.autodriller]
        weight = "50 kN"
        weight_gain = 1e-6
        weight_reset = 5
        rate = 0.02
        rate_gain = 1
        rate_reset = 2)",
                                              80, R"(
        [bit]
        weight = [[20, 0], [50, "60 kN"]]
        [damping]
        kelvin_voigt = 0.02
        [output]
        interval = 0.1)"));
    WellCase well;
    well.survey = {{0, 0, 0}, {1100, 0, 0}};
    well.sections = {{1100, 0.5}};
    input.well = well;
    for (Component& component : input.string.components)
        component.outer_diameter = 0.127;
    input.initial.state = InitialState::equilibrium;
    const Records run = test::run(input);
    const auto speed = [&](double time) {
        const auto i = static_cast<std::size_t>(std::lround(time / 0.1));
        return (run.series[i + 10].head_position.z() - run.series[i - 10].head_position.z()) / 2;
    };
    EXPECT_NEAR(speed(18), 0.02, 2e-4);
    EXPECT_NEAR(speed(70), 0, 1e-4);
    for (const SeriesRecord& record : run.series)
        EXPECT_GE(record.head_position.z(), -0.01);
}

}  // namespace
}  // namespace drillstrand
