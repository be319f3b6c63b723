// Frequencies of small vibrations and large swings, against exact or independently computed ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "validation/rod_cases.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using namespace test;

using RodVibration = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, RodVibration, both_integrators, integrator_name);

/// A complex signal at times 0, step, 2 step, ...
struct Signal {
    std::vector<std::complex<double>> value;
    double step = 0;
};

/// Angular frequency between `low` and `high` (rad/s, negative turns backward) at which the
/// signal's spectrum, under a Blackman-Harris window (side lobes below -92 dB), is largest.
double strongest_frequency(const Signal& signal, double low, double high) {
    const std::size_t count = signal.value.size();
    std::vector<std::complex<double>> windowed(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double x = 2 * pi * static_cast<double>(i) / static_cast<double>(count - 1);
        windowed[i] = signal.value[i] * (0.35875 - 0.48829 * std::cos(x) +
                                         0.14128 * std::cos(2 * x) - 0.01168 * std::cos(3 * x));
    }
    const auto magnitude = [&](double omega) {
        const std::complex<double> turn = std::polar(1.0, -omega * signal.step);
        std::complex<double> phase = 1;
        std::complex<double> sum = 0;
        for (const std::complex<double>& value : windowed) {
            sum += value * phase;
            phase *= turn;
        }
        return std::abs(sum);
    };
    // a scan finer than the main lobe, then golden sections of the interval around the best
    constexpr int scans = 200;
    const double width = (high - low) / scans;
    double best = low;
    double most = 0;
    for (int i = 0; i <= scans; ++i) {
        const double here = magnitude(low + i * width);
        if (here > most) {
            most = here;
            best = low + i * width;
        }
    }
    double left = best - width;
    double right = best + width;
    while (right - left > 1e-9 * std::abs(best)) {
        const double third = (right - left) / 3;
        if (magnitude(left + third) < magnitude(right - third)) {
            left += third;
        } else {
            right -= third;
        }
    }
    return (left + right) / 2;
}

/// The bit's motion across a string that hangs or lies along `first` x `second`, from time `start`.
Signal bit_motion(const Run& run, double start, const Vector3d& first, const Vector3d& second) {
    Signal signal;
    signal.step = run.series[1].time - run.series[0].time;
    for (const SeriesRecord& record : run.series) {
        if (record.time < start) continue;
        signal.value.emplace_back(record.bit_position.dot(first), record.bit_position.dot(second));
    }
    return signal;
}

std::string output_every(double interval) {
    return fmt::format("[output]\ninterval = {}\nprofile_interval = 0\n", interval);
}

/// A dead force on the bit that rises and falls within `duration`.
std::string tap_on_bit(const Vector3d& force, double duration) {
    return fmt::format("[bit]\nforce = [[0, [0, 0, 0]], [{}, {}], [{}, [0, 0, 0]]]\n", duration / 2,
                       list(force), duration);
}

/// Frequencies on a coarse mesh and on one of twice as many segments tend to the exact ones at
/// second order: extrapolated, they agree to `within`.
template <std::size_t count, class Frequencies>
void expect_second_order(const std::array<double, count>& exact, const Frequencies& frequencies,
                         int coarse_segments, double within) {
    const std::array<double, count> coarse = frequencies(coarse_segments);
    const std::array<double, count> fine = frequencies(2 * coarse_segments);
    for (std::size_t i = 0; i < count; ++i) {
        const double coarse_error = coarse[i] / exact[i] - 1;
        const double fine_error = fine[i] / exact[i] - 1;
        EXPECT_NEAR(std::log2(coarse_error / fine_error), 2, 0.2)
            << "mode " << i + 1 << ", error " << fine_error;
        EXPECT_NEAR(fine_error + (fine_error - coarse_error) / 3, 0, within) << "mode " << i + 1;
    }
}

/// Likewise at `order` or better, with errors on the finer mesh of no more than `within`.
template <std::size_t count, class Frequencies>
void expect_order(const std::array<double, count>& exact, const Frequencies& frequencies,
                  int coarse_segments, double order, const std::array<double, count>& within) {
    const std::array<double, count> coarse = frequencies(coarse_segments);
    const std::array<double, count> fine = frequencies(2 * coarse_segments);
    for (std::size_t i = 0; i < count; ++i) {
        const double coarse_error = coarse[i] / exact[i] - 1;
        const double fine_error = fine[i] / exact[i] - 1;
        EXPECT_GT(std::log2(coarse_error / fine_error), order)
            << "mode " << i + 1 << ", errors " << coarse_error << ' ' << fine_error;
        EXPECT_LT(std::abs(fine_error), within[i]) << "mode " << i + 1;
    }
}

/// The first frequencies of a cantilever along x after a tap, each looked for within a tenth.
template <std::size_t count>
std::array<double, count> frequencies_after_tap(const std::string& rod,
                                                const std::array<double, count>& expected,
                                                const std::string& mesh, double tap) {
    const double interval = 0.1 / expected.back();
    const test::Run result =
        run("gravity = 0\n" + rod + mesh + "[head]\ndirection = [1, 0, 0]\n" +
            tap_on_bit({0, 0, tap}, 2 / expected.back()) + output_every(interval));
    const Signal signal =
        bit_motion(result, 2 / expected.back(), Vector3d::UnitZ(), Vector3d::Zero());
    std::array<double, count> found{};
    for (std::size_t i = 0; i < count; ++i)
        found[i] = strongest_frequency(signal, 0.9 * expected[i], 1.1 * expected[i]);
    return found;
}

TEST_P(RodVibration, PipeOfTable2SwingsAtTimoshenkosFrequencies) {
    // exact: transfer matrices in multiple precision, shear coefficient 1 (Hz)
    std::array<double, 4> exact = {0.23437231261569874, 1.4685681558197325, 4.111047292563715,
                                   8.053190562794628};
    for (double& f : exact)
        f *= 2 * pi;
    const auto frequencies = [](const auto& expected) {
        return [&](int segments) {
            return frequencies_after_tap(table_2_pipe(), expected,
                                         mesh_and_run(integrator(), segments, true, 30), 10);
        };
    };
    if (is_leapfrog()) {
        EXPECT_NEAR(frequencies(exact)(8)[0] / exact[0], 1, 1e-3);
        expect_order(exact, frequencies(exact), 8, 2.7, {1.1e-4, 1.2e-3, 3.1e-3, 6.1e-3});
    } else {
        // measured: -0.46, -1.6 and -2.6 over the square of the number of segments
        const std::array<double, 3> first = {exact[0], exact[1], exact[2]};
        expect_second_order(first, frequencies(first), 7, 2e-3);
    }
}

TEST_P(RodVibration, PipePinnedAtItsHeadVibratesAsAPinnedBeam) {
    // pinned and free: tan x = tanh x; rotary inertia and shear lower the second by 4e-4
    constexpr std::array<double, 2> roots = {3.926602, 7.068583};
    const double unit = std::sqrt(table_2_bending_stiffness / 34.2277) / (24 * 24);
    // pushed to and fro, so that no swing is left
    const test::Run result =
        run("gravity = 0\n" + table_2_pipe() + mesh_and_run(integrator(), 24, true, 20) + R"(
[head]
motion = "pinned"
direction = [1, 0, 0]
[bit]
force = [[0, [0, 0, 0]], [0.1, [0, 0, 10]], [0.2, [0, 0, 0]], [0.3, [0, 0, -10]], [0.4, [0, 0, 0]]]
)" + output_every(0.01));
    const Signal signal = bit_motion(result, 0.5, Vector3d::UnitZ(), Vector3d::Zero());
    for (const double root : roots) {
        const double exact = root * root * unit;
        EXPECT_NEAR(strongest_frequency(signal, 0.9 * exact, 1.1 * exact) / exact, 1,
                    is_leapfrog() ? 2e-3 : 1e-2)
            << root;
    }
}

TEST(GradedMesh, ErrsInFrequenciesByNoMoreThanTheEvenMeshOfItsLongestSegments) {
    // as above; segments shrink to a quarter of their length and grow again
    std::array<double, 3> exact = {0.23437231261569874, 1.4685681558197325, 4.111047292563715};
    for (double& f : exact)
        f *= 2 * pi;
    for (const int segments : {8, 16}) {
        const double h = 24.0 / segments;
        const std::string graded = fmt::format(
            "[mesh]\nelement_length = {:.17g}\n"
            "refine = [{{from = 8, to = 11, element_length = {:.17g}}}]\n"
            "[run]\nduration = 30\nstress_limit = 0\n",
            h, h / 4);
        const std::string even = mesh_and_run(IntegratorKind::leapfrog, segments, false, 30);
        const auto found = frequencies_after_tap(table_2_pipe(), exact, graded, 10);
        const auto beside = frequencies_after_tap(table_2_pipe(), exact, even, 10);
        for (std::size_t i = 0; i < exact.size(); ++i)
            EXPECT_LT(std::abs(found[i] / exact[i] - 1), std::abs(beside[i] / exact[i] - 1))
                << "mode " << i + 1 << " on " << segments;
    }
}

/// A beam of unit length, mass and bending stiffness, as thick as I/(A L2) = 0.0025 makes it.
Section thick_beam(double shear) {
    return {.length = 1,
            .mass = 1,
            .inertia = 0.0025,
            .bending = 1,
            .torsional = 1,
            .axial = 400,
            .shear = shear};
}

TEST_P(RodVibration, ThickBeamVibratesAtTimoshenkosFrequencies) {
    struct Beam {
        double shear;
        std::array<double, 3> exact;  // rad/s, exact characteristic equation
    };
    const Beam beams[] = {
        // nu = 0.3, k = 5/6: kGA = 5/6 400/2.6
        {5. / 6 * 400 / 2.6, {3.435274961958389, 19.103623277014766, 46.60313987236625}},
        // nu = 0, k = 1
        {200, {3.456659448153444, 19.784716817135653, 49.55755187604857}}};
    for (const Beam& beam : beams) {
        const auto frequencies = [&](int segments) {
            return frequencies_after_tap(section_component(thick_beam(beam.shear)), beam.exact,
                                         mesh_and_run(integrator(), segments, false, 30), 1e-3);
        };
        if (is_leapfrog())
            expect_order(beam.exact, frequencies, 15, 2.3, {1.5e-5, 2.1e-4, 8e-4});
        else
            expect_second_order(beam.exact, frequencies, 15, 5e-4);
    }
}

TEST_P(RodVibration, HangingPipeSwingsAtTheFrequenciesOfATensionedBeam) {
    // independent: Chebyshev collocation of the tensioned beam, 100 m of table 3 pipe, g = 9.81
    const std::array<double, 3> exact = {0.394717, 1.042393, 2.102437};
    const auto frequencies = [&](int segments) {
        const test::Run result = run("gravity = 9.81\n" + table_3_pipe(100) +
                                     mesh_and_run(integrator(), segments, true, 120) +
                                     tap_on_bit({0, 10, 0}, 0.5) + output_every(0.1));
        const Signal signal = bit_motion(result, 0.5, Vector3d::UnitY(), Vector3d::Zero());
        std::array<double, 3> found{};
        for (std::size_t i = 0; i < exact.size(); ++i)
            found[i] = strongest_frequency(signal, 0.85 * exact[i], 1.15 * exact[i]);
        return found;
    };
    if (is_leapfrog()) {
        expect_order(exact, frequencies, 10, 3, {4e-5, 7e-4, 1.8e-3});
    } else {
        // measured: -0.53, -3.5 and -6.1 over the square of the number of segments
        expect_second_order(exact, frequencies, 10, 2e-3);
    }
}

TEST_P(RodVibration, SpinSplitsTheFrequencyOfAShaftIntoForwardAndBackwardWhirl) {
    // exact: linear rotor dynamics of the thick beam, k = 1, polar inertia 2 rho I, at 10 rad/s.
    // The drive speeds up within five torsional periods 4 L/c, c2 = GJ/(rho Ip) = 200, so that no
    // torsional vibration is left.
    const double forward = 3.5676353423837806;
    const double backward = 3.3478542392998136;
    const double ramp = 5 * 4 / std::sqrt(200.0);
    const test::Run result =
        run("gravity = 0\n" + section_component(thick_beam(200)) +
            mesh_and_run(integrator(), 15, false, 150) +
            fmt::format("[head]\ndirection = [0, 0, 1]\nrotation = [[0, 0], [{:.17g}, 10]]\n"
                        "[bit]\nforce = [[2, [0, 0, 0]], [2.5, [1e-3, 0, 0]], [3, [0, 0, 0]]]\n",
                        ramp) +
            output_every(0.05));
    const Signal signal = bit_motion(result, 3, Vector3d::UnitX(), Vector3d::UnitY());
    const double found_forward = strongest_frequency(signal, 3, 4);
    const double found_backward = -strongest_frequency(signal, -4, -3);
    EXPECT_NEAR(found_forward / forward, 1, 2e-3);
    EXPECT_NEAR(found_backward / backward, 1, 2e-3);
    EXPECT_NEAR((found_forward - found_backward) / (forward - backward), 1, 5e-3);
}

TEST_P(RodVibration, UndampedPipeFallsAndSwingsAsAnIndependentSolutionDoes) {
    // independent: spectral discontinuous Galerkin solution of the intrinsic equations, converged
    // to the digits given; table 2 pipe let go level, g = 9.81
    struct Instant {
        double time;
        double x;
        double z;
    };
    const Instant reference[] = {
        {0.5, 23.931912919, 1.724811036},  {1, 23.118682909, 6.077534366},
        {1.5, 21.146898634, 10.519013881}, {2, 19.872558851, 12.390616597},
        {3, 22.855870743, 6.869061354},    {4, 23.999496493, -0.018200712}};
    const auto errors = [&](int segments) {
        const test::Run result = run("gravity = 9.81\n" + table_2_pipe() +
                                     mesh_and_run(integrator(), segments, true, 4) +
                                     "[head]\ndirection = [1, 0, 0]\n" + output_every(0.5));
        std::vector<double> error;
        for (const Instant& instant : reference) {
            const auto index = static_cast<std::size_t>(std::lround(instant.time / 0.5));
            const Vector3d tip = result.series.at(index).bit_position;
            error.push_back((tip - Vector3d(instant.x, 0, instant.z)).norm());
        }
        return error;
    };
    if (is_leapfrog()) {
        // Beam-columns and cubics are of fourth order; what is left on fine meshes is the rotary
        // inertia of the nodes, which is that of the pipe where h is below 0.2 m.
        constexpr std::size_t two_seconds = 3;
        EXPECT_LT(errors(8)[two_seconds], 5.3e-3);
        EXPECT_LT(errors(16)[two_seconds], 2.2e-3);
        for (const double error : errors(46))
            EXPECT_LT(error, 1e-3);
        return;
    }
    const std::vector<double> coarse = errors(23);
    const std::vector<double> fine = errors(46);
    for (std::size_t i = 0; i < fine.size(); ++i) {
        EXPECT_LT(fine[i], 8e-3) << reference[i].time << " s";
        EXPECT_NEAR(std::log2(coarse[i] / fine[i]), 2, 0.3)
            << reference[i].time << " s: " << coarse[i] << ' ' << fine[i];
    }
}

}  // namespace
}  // namespace drillstrand
