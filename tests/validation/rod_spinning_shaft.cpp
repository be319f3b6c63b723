// A shaft that turns and is viscous within itself (Kelvin-Voigt: moments EI k + tau EI dk/dt, k the
// curvature that the turning material sees). In space its bending stiffness is EI (1 - i tau
// Omega).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "validation/rod_cases.hpp"

namespace drillstrand {
namespace {

using namespace test;

using SpinningShaft = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, SpinningShaft, both_integrators, integrator_name);

/// Displacement of the tip across a level shaft along x: y + i z, so that i is down and a positive
/// spin turns from y to z.
std::complex<double> displacement(const SeriesRecord& record) {
    return {record.bit_position.y(), record.bit_position.z()};
}

/// A clamped shaft of unit length, mass and bending stiffness, that sags by an eight-hundredth.
std::complex<double> sag(IntegratorKind integrator, double spin, double tau) {
    const Section section{.length = 1,
                          .mass = 1,
                          .inertia = 0.0025,
                          .bending = 1,
                          .torsional = 1,
                          .axial = 400,
                          .shear = 200};
    // swings decay by exp(-0.96 t)
    const test::Run result = run(
        "gravity = 0.01\n" + section_component(section) + mesh_and_run(integrator, 8, true, 20) +
        fmt::format("[head]\ndirection = [1, 0, 0]\nrotation = [[0, 0], [1, {}]]\n"
                    "[damping]\nkelvin_voigt = {}\n[output]\ninterval = 20\n",
                    spin, tau));
    return displacement(result.last());
}

TEST_P(SpinningShaft, SagsAsideByTheAngleWhoseTangentIsViscosityTimesSpin) {
    const double spin = 1.5;  // below the first frequency of 3.46 rad/s, beyond which it whirls
    const double tau = 0.3;
    const std::complex<double> at_rest = sag(integrator(), 0, tau);
    // w L^4/(8 EI) + w L^2/(2 kGA); meshes miss it by second order
    EXPECT_NEAR(at_rest.imag(), 0.01 / 8 + 0.01 / 400, 0.02 * 0.01 / 8);
    EXPECT_NEAR(at_rest.real(), 0, 1e-9);
    // on any mesh, up to the square of the sag
    const std::complex<double> ratio = sag(integrator(), spin, tau) / at_rest;
    EXPECT_NEAR(std::arg(ratio), std::atan(tau * spin), 1e-4);
    EXPECT_NEAR(std::abs(ratio), std::cos(std::atan(tau * spin)), 1e-4);
}

// A slender shaft with viscosity D = tau EI in an outer damping c: modes exp(lambda t) of
// m lambda^2 + (c + D b^4) lambda + EI b^4 - i Omega D b^4 = 0, EI b^4 = m omega1^2. One of them is
// unstable where Omega > omega1 (1 + c/(D b^4)). c damps turning sections also, by a hundredth of
// what it takes from motion across: hence a length of 20 m.
struct Whirl {
    double mass = 1;
    double omega1 = 3.5070628210676706;  // exact characteristic equation of Timoshenko's beam
    double tau = 0.02;
    double outer = 0.1;

    [[nodiscard]] double inner() const { return tau * mass * omega1 * omega1; }  // D b^4
    [[nodiscard]] double critical_spin() const { return omega1 * (1 + outer / inner()); }
    [[nodiscard]] double growth(double spin) const {
        const std::complex<double> half = 0.5 * (outer + inner()) / mass;
        const std::complex<double> stiffness(omega1 * omega1, -spin * inner() / mass);
        return (-half + std::sqrt(half * half - stiffness)).real();
    }
};

/// Rate at which the whirl grows (1/s), from its mean square over a second whirl a few later.
double measured_growth(IntegratorKind integrator, const Whirl& whirl, double spin) {
    const Section section{.length = 20,
                          .mass = whirl.mass,
                          .inertia = 0.04,
                          .bending = 160000,
                          .torsional = 160000,
                          .axial = 4e5,
                          .shear = 4e5};
    constexpr double interval = 0.02;
    constexpr double begin = 12;  // the backward whirl has decayed
    constexpr double end = 24;
    const double period = 2 * std::numbers::pi / whirl.omega1;
    const test::Run result =
        run("gravity = 0\n" + section_component(section) +
            mesh_and_run(integrator, 8, true, end + period) +
            fmt::format("[head]\ndirection = [1, 0, 0]\nrotation = {:.17g}\n"
                        "[bit]\nforce = [[0, [0, 0, 0]], [0.5, [0, 0, 1]], [1, [0, 0, 0]]]\n"
                        "[damping]\nkelvin_voigt = {}\nexternal = {}\n"
                        "[output]\ninterval = {}\nprofile_interval = 0\n",
                        spin, whirl.tau, whirl.outer, interval));
    const auto mean_square = [&](double from) {
        double sum = 0;
        for (const SeriesRecord& record : result.series) {
            if (record.time >= from && record.time < from + period)
                sum += std::norm(displacement(record));
        }
        return sum;
    };
    return std::log(mean_square(end) / mean_square(begin)) / 2 / (end - begin);
}

TEST_P(SpinningShaft, WhirlsBeyondTheSpinAtWhichItsViscosityOvercomesTheOuterDamping) {
    const Whirl whirl;
    for (const double part : {0.5, 0.9, 1.1, 1.5}) {
        const double spin = part * whirl.critical_spin();
        const double predicted = whirl.growth(spin);
        const double measured = measured_growth(integrator(), whirl, spin);
        EXPECT_GT(measured * (part - 1), 0) << part;
        // 1 % of the critical spin: mesh, gyroscopic splitting and damping of turning sections
        EXPECT_NEAR(measured, predicted, 0.01 * whirl.growth(2 * whirl.critical_spin())) << part;
    }
}

// A slender shaft clamped at its head, an eccentric mass at its tip: in the turning frame
// EI d4y/dx4 = (m W^2 - i c W) y, and EI d3y/dx3 = - U W^2 at the tip.
TEST(EccentricMass, WhirlsAShaftOnTheRadiusOfForcedVibration) {
    const Section section{.length = 20,
                          .mass = 1,
                          .inertia = 1e-3,
                          .bending = 160000,
                          .torsional = 160000,
                          .axial = 4e7,
                          .shear = 4e7};
    const double unbalance = 1e-3;  // kg m
    const double outer = 0.4;       // N s/m2
    const double first = 3.5160 * std::sqrt(section.bending / std::pow(section.length, 4));
    for (const double part : {0.5, 0.8, 1.3}) {
        const double spin = part * first;
        const std::complex<double> square(section.mass * spin * spin, -outer * spin);
        const std::complex<double> b = std::pow(square / section.bending, 0.25);
        const std::complex<double> x = b * section.length;
        const std::complex<double> exact =
            unbalance * spin * spin / (section.bending * b * b * b) *
            (std::sin(x) * std::cosh(x) - std::cos(x) * std::sinh(x)) /
            (1.0 + std::cos(x) * std::cosh(x));
        const std::string mass =
            fmt::format("eccentric_mass = {:.17g}\neccentric_mass_position = 20\n", unbalance);
        const test::Run result =
            run("gravity = 0\n" + section_component(section, mass) +
                mesh_and_run(IntegratorKind::leapfrog, 8, false, 60) +
                fmt::format("[head]\ndirection = [1, 0, 0]\nrotation = [[0, 0], [5, {:.17g}]]\n"
                            "[damping]\nexternal = {}\n[output]\ninterval = 60\n",
                            spin, outer));
        EXPECT_NEAR(std::abs(displacement(result.last())) / std::abs(exact), 1, 0.01) << part;
    }
}

// A couple that follows a free end does work on its turning, whatever the mode: amplitudes grow by
// T/(L sqrt(EI m)), those of one sense of turning (energy in of T times the cone that the end
// describes, over the energy of a mode).
TEST(FollowingTorque, MakesAFreeEndFlutterAtTheSameRateOnEveryMesh) {
    const Section section{.length = 50,
                          .mass = 52.1,
                          .inertia = 0.36,
                          .bending = 9.2e6,
                          .torsional = 7e6,
                          .axial = 1.3e9,
                          .shear = 6.6e8};
    const double torque = 1e4;
    const double rate = torque / (section.length * std::sqrt(section.bending * section.mass));
    const double duration = 120;
    for (const int segments : {8, 16, 32}) {
        const test::Run result =
            run("gravity = 0\n" + section_component(section) +
                mesh_and_run(IntegratorKind::leapfrog, segments, false, duration) +
                fmt::format("[head]\ndirection = [1, 0, 0]\n[bit]\nmoment = [{:.17g}, 0, 0]\n"
                            "force = [[0, [0, 0, 0]], [0.01, [0, 0, 50]], [0.02, [0, 0, 0]]]\n"
                            "[output]\ninterval = 0.01\nprofile_interval = 0\n",
                            -torque));
        const auto bending = [&](double from, double to) {
            double sum = 0;
            for (const SeriesRecord& record : result.series)
                if (record.time >= from * duration && record.time < to * duration)
                    sum += record.bit_stress.segment<2>(1).squaredNorm();
            return std::sqrt(sum);
        };
        const double growth =
            std::log(bending(0.85, 0.95) / bending(0.45, 0.55)) / (0.4 * duration);
        EXPECT_LT(growth, 1.6 * rate) << segments;
        EXPECT_GT(growth, 0.5 * rate) << segments;
    }
}

}  // namespace
}  // namespace drillstrand
