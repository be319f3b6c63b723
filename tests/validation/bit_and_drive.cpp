// Bits that stick and slip and drives that turn them, against the wave equation of a uniform pipe.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "drillstrand/equilibrium.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

using Records = test::Run;

constexpr double pi = std::numbers::pi;

/// 2000 m of 5 in pipe: Z = J sqrt(G rho) = 296.5008 N m s, 2 L/c = 1.2585145 s.
constexpr double impedance = 296.5008;
constexpr double round_trip = 1.2585145;

std::string pipe(double length, int segments) {
    return fmt::format(R"(
        gravity = 0
        [[string.component]]
        length = {}
        outer_diameter = 0.127
        inner_diameter = 0.1086
        density = 7850
        youngs_modulus = 206.18e9  # G = 79.3e9
        poisson_ratio = 0.3
        [mesh]
        segments = {}
        )",
                       length, segments);
}

// Waves that jump ring on any mesh; damping of 0.1 ms rounds them within a hundredth of a trip.
std::string sticking_bit(const std::string& head, const std::string& bit, double duration) {
    return pipe(2000, 200) + fmt::format(R"(
        [head]
        {}
        [bit]
        law = "stribeck"
        {}
        [damping]
        kelvin_voigt = 1e-4
        [run]
        duration = {}
        [output]
        interval = 0.01
        )",
                                         head, bit, duration);
}

/// A stretch of time in which the bit turns.
struct Slip {
    double begin;
    double end;
    double rate;  ///< median
};

std::vector<Slip> slips_of(const Records& run) {
    std::vector<Slip> slips;
    std::vector<double> rates;
    double begin = 0;
    for (const SeriesRecord& record : run.series) {
        if (record.bit_rotation_rate != 0) {
            if (rates.empty()) begin = record.time;
            rates.push_back(record.bit_rotation_rate);
        } else if (!rates.empty()) {
            std::sort(rates.begin(), rates.end());
            slips.push_back({begin, record.time, rates[rates.size() / 2]});
            rates.clear();
        }
    }
    return slips;
}

TEST(StickSlip, AlternatesAsTheWaveEquationHasIt) {
    // 20 rpm from rest: the torque on a bit that sticks rises by 2 Z Omega in each round trip, to
    // 8693.9 and 8274.1 N m in turn; then the bit turns at (that - 6000)/Z for one of them
    const Records run = test::run(
        sticking_bit("rotation = \"20 rpm\"", "static_torque = 8000\ndynamic_torque = 6000", 40));
    const std::vector<Slip> slips = slips_of(run);
    ASSERT_GE(slips.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(slips[i].rate, i % 2 == 0 ? 9.085499 : 7.669662, 0.01) << i;
        EXPECT_NEAR(slips[i].end - slips[i].begin, round_trip, 0.03) << i;
        EXPECT_NEAR(slips[i].begin, (6.5 + 4 * static_cast<double>(i)) * round_trip, 0.06) << i;
    }
    for (const SeriesRecord& record : run.series) {
        EXPECT_LT(record.bit_torque, 8001);
        EXPECT_GE(record.bit_rotation_rate, 0);
    }
    const EnergyAccount& energy = run.last().energy;
    EXPECT_NEAR(energy.stored() + energy.dissipation - energy.work, 0, 1e-3 * energy.work);
}

/// The bit's rate at times i dt on a uniform pipe whose head turns at a rate from time 0 on, by
/// characteristics: what comes down, T + Z w at the bit, is what went up a round trip before,
/// T - Z w, and 2 Z Omega.
std::vector<double> by_characteristics(double set, const BitCase& bit, double dt,
                                       std::size_t count) {
    const auto delay = static_cast<std::size_t>(std::lround(round_trip / dt));
    std::vector<double> up(count, 0.0);
    std::vector<double> rate(count, 0.0);
    for (std::size_t i = 1; i < count; ++i) {
        const double came_up = i >= delay ? up[i - delay] : 0.0;
        const double down = i >= delay / 2 ? came_up + 2 * impedance * set : 0.0;
        double w = rate[i - 1];
        if (w == 0 && down > bit.static_torque) w = 1e-9;
        if (w > 0) {
            const double friction = bit.dynamic_torque + (bit.static_torque - bit.dynamic_torque) *
                                                             std::exp(-w / bit.decay_speed);
            w = std::max(0.0, w + dt * (down - impedance * w - friction) / bit.inertia);
        }
        rate[i] = w;
        up[i] = down - 2 * impedance * w;
    }
    return rate;
}

/// How far a bit's rate is off the wave equation, of its mean, on a mesh.
double off_the_wave_equation(double rpm, int segments) {
    BitCase bit;
    bit.static_torque = 8000;
    bit.dynamic_torque = 6000;
    bit.decay_speed = 2;
    bit.inertia = 60;
    const Records run = test::run(pipe(2000, segments) + fmt::format(R"(
        [head]
        rotation = "{} rpm"
        [bit]
        law = "stribeck"
        static_torque = 8000
        dynamic_torque = 6000
        decay_speed = 2
        inertia = 60
        [damping]
        kelvin_voigt = 1e-5
        [run]
        duration = 20
        [output]
        interval = 0.01
        )",
                                                                     rpm));
    const double dt = 1e-4;
    const std::vector<double> exact = by_characteristics(rpm * pi / 30, bit, dt, 200001);
    double off = 0;
    double all = 0;
    for (const SeriesRecord& record : run.series) {
        const double w = exact[static_cast<std::size_t>(std::lround(record.time / dt))];
        off += std::abs(record.bit_rotation_rate - w);
        all += w;
    }
    return off / all;
}

TEST(StickSlip, OfABitWithInertiaConvergesToTheWaveEquation) {
    for (const double rpm : {20.0, 45.0}) {
        const double coarse = off_the_wave_equation(rpm, 100);
        const double fine = off_the_wave_equation(rpm, 600);
        EXPECT_LT(coarse, 0.15) << rpm;
        EXPECT_LT(fine, 0.025) << rpm;
        EXPECT_LT(fine, coarse) << rpm;
    }
}

TEST(StickSlip, EndsWithAMatchedDriveAndGoesOnWithAStiffOne) {
    const auto least_rate = [](const std::string& control) {
        const Records run = test::run(sticking_bit(
            "rotation = [[0, 0], [5, \"60 rpm\"]]\n[head.drive]\n" + control,
            "static_torque = 8000\ndynamic_torque = 6000\ndecay_speed = 1\ninertia = 100", 60));
        double least = 1e9;
        for (const SeriesRecord& record : run.series)
            if (record.time > 40) least = std::min(least, record.bit_rotation_rate);
        return least;
    };
    EXPECT_EQ(least_rate("control = \"stiff\""), 0);
    EXPECT_EQ(least_rate("control = \"pi\"\ninertia = 2900\nproportional = 38e3\nintegral = 1e5"),
              0);
    EXPECT_NEAR(least_rate("control = \"matched\"\nfilter = 2"), 2 * pi, 0.05);
}

TEST(StickSlip, OfAStringThatDoesNotStickHasTheTorqueOfStatics) {
    // friction of bit and wall at a steady rate, by Newton's method and by the run that settles
    Case input = read_case(std::filesystem::path(DRILLSTRAND_SOURCE_DIR) / "cases" /
                           "stick_slip_matched_drive.toml");
    double torque = 0;
    double bit = 0;
    int count = 0;
    for (const SeriesRecord& record : test::run(input).series) {
        if (record.time <= 40) continue;
        torque += record.surface_torque;
        bit += record.bit_torque;
        ++count;
    }
    EquilibriumOptions drilling;
    drilling.motion = steady_motion(StringMotion::drilling, 2 * pi);
    const Equilibrium statics = find_equilibrium(build_static_scene(input), drilling);
    EXPECT_NEAR(torque / count, statics.surface_torque, 0.01 * statics.surface_torque);
    EXPECT_NEAR(bit / count, 3500 * (1 + std::exp(-2.0)), 0.005 * 3500);
}

/// |r| of a drive for waves of a frequency (Hz) that come up a pipe so long that none comes twice.
double reflected(const std::string& drive, double frequency) {
    // J sqrt(G rho) = 498.26 N m s, waves of 3000 m/s
    constexpr double zeta = 498.26;
    constexpr double polar_inertia = zeta / 3000;
    constexpr double length = 60e3;
    constexpr int segments = 600;
    constexpr double end = 55;
    std::string sine = "[[0, [0, 0, 0]]";
    for (int i = 1; i <= 5500; ++i) {
        const double t = 0.01 * i;
        const double grown = std::min(1.0, t * frequency);
        sine += fmt::format(", [{}, [{:.6f}, 0, 0]]", t,
                            1000 * grown * std::sin(2 * pi * frequency * t));
    }
    const Records run = test::run(fmt::format(R"(
        gravity = 0
        [[string.component]]
        length = {}
        linear_density = 34
        polar_inertia = {:.17g}
        inertia = {:.17g}
        torsional_stiffness = {:.17g}
        bending_stiffness = 4e6
        axial_stiffness = 9e8
        shear_stiffness = 3e8
        [mesh]
        segments = {}
        [bit]
        moment = {}]
        [head.drive]
        {}
        [run]
        duration = {}
        [output]
        interval = 0.01
        )",
                                              length, polar_inertia, polar_inertia / 2, zeta * 3000,
                                              segments, sine, drive, end));
    // over the last two periods: a wave needs 20 s to the head, its echo 40 s to come again
    using Complex = std::complex<double>;
    Complex torque = 0;
    Complex rate = 0;
    for (const SeriesRecord& record : run.series) {
        if (record.time <= end - 2 / frequency + 1e-6) continue;
        const Complex turn = std::exp(Complex(0, -2 * pi * frequency * record.time));
        torque += turn * record.surface_torque;
        rate += turn * record.head_rotation_rate;
    }
    // the half cell at the head belongs to the pipe
    const double half_cell = polar_inertia * length / segments / 2;
    const Complex at_head = -torque / rate - Complex(0, 2 * pi * frequency * half_cell);
    return std::abs((at_head - zeta) / (at_head + zeta));
}

double by_theory(double zeta, double proportional, double integral, double inertia,
                 double frequency) {
    const std::complex<double> at_head(
        proportional, 2 * pi * frequency * inertia - integral / (2 * pi * frequency));
    return std::abs((at_head - zeta) / (at_head + zeta));
}

TEST(TopDrive, ReflectsWavesByItsImpedance) {
    // a field drive on its pipe: |r| of 0.1, 0.2, 0.5 and 1 Hz
    const std::vector<std::pair<double, double>> field = {
        {0.1, 0.9986}, {0.2, 0.9948}, {0.5, 0.9809}, {1, 0.9742}};
    for (const auto& [frequency, part] : field)
        EXPECT_NEAR(reflected("control = \"pi\"\ninertia = 2900\nproportional = 38e3\n"
                              "integral = 1e5",
                              frequency),
                    part, 1e-3)
            << frequency;
    EXPECT_NEAR(reflected("control = \"tuned\"\ninertia = 2900\nfrequency = \"0.2 Hz\"", 0.2), 0.6,
                3e-3);
    for (const double frequency : {0.1, 0.2, 0.5, 1.0}) {
        EXPECT_LT(reflected("control = \"matched\"", frequency), 0.005) << frequency;
        EXPECT_NEAR(
            reflected("control = \"tuned\"\ninertia = 1500\nfrequency = \"0.3 Hz\"\n"
                      "impedance_factor = 3",
                      frequency),
            by_theory(498.26, 3 * 498.26, 1500 * std::pow(2 * pi * 0.3, 2), 1500, frequency), 5e-3)
            << frequency;
        EXPECT_NEAR(reflected("control = \"matched\"\nfilter = 2", frequency),
                    by_theory(498.26, 498.26, 498.26 / 2, 0, frequency), 5e-3)
            << frequency;
    }
}

TEST(TopDrive, StallsAtItsLimits) {
    const Records run =
        test::run(sticking_bit("rotation = [[0, 0], [5, \"6 rpm\"]]\n[head.drive]\n"
                               "control = \"pi\"\ninertia = 2900\nproportional = 38e3\n"
                               "integral = 1e5\ntorque_limit = 5000",
                               "static_torque = 8000\ndynamic_torque = 6000", 60));
    for (const SeriesRecord& record : run.series) {
        EXPECT_LE(std::abs(record.drive_torque), 5000 * (1 + 1e-12));
        EXPECT_EQ(record.bit_rotation_rate, 0);
    }
    EXPECT_EQ(run.last().drive_torque, 5000);
    const Records weak =
        test::run(sticking_bit("rotation = [[0, 0], [1, \"60 rpm\"]]\n[head.drive]\n"
                               "power_limit = 40e3\ntorque_limit = 30e3",
                               "static_torque = 8000\ndynamic_torque = 8000\ninertia = 100", 60));
    // 8 kN m at 40 kW: 5 rad/s, not 6.28
    double turned = 0;
    for (const SeriesRecord& record : weak.series)
        if (record.time > 40) turned += record.head_rotation_rate * 0.01 / 20;
    EXPECT_NEAR(turned, 5, 0.1);
}

}  // namespace
}  // namespace drillstrand
