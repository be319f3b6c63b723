// Natural frequencies, critical speeds and harmonic response against exact solutions of bars and
// beams.
#include "drillstrand/modes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "drillstrand/error.hpp"
#include "statics/beam_vibration.hpp"
#include "statics/statics_cases.hpp"

namespace drillstrand {
namespace {

using std::numbers::pi;
using test::BeamHead;
using test::BeamSpan;
using test::ExactBeam;

/// A component that is given by its section, and the same as a span of an exact beam.
struct Section {
    double length, mass, inertia, polar_inertia, bending, torsional, axial, shear;
};

std::string component(const Section& s, const std::string& more = "") {
    return fmt::format(R"(
[[string.component]]
length = {:.17g}
linear_density = {:.17g}
inertia = {:.17g}
polar_inertia = {:.17g}
bending_stiffness = {:.17g}
torsional_stiffness = {:.17g}
axial_stiffness = {:.17g}
shear_stiffness = {:.17g}
{}
)",
                       s.length, s.mass, s.inertia, s.polar_inertia, s.bending, s.torsional,
                       s.axial, s.shear, more);
}

BeamSpan span(const Section& s, double tension = 0) {
    return {s.length, s.mass, s.inertia, s.polar_inertia, s.bending, s.shear, tension};
}

/// A level string without weight.
Case level(const std::string& string, int segments, const std::string& more = "") {
    return test::case_from("gravity = 0\n" + string + test::mesh(segments) +
                           "[head]\ndirection = [1, 0, 0]\n" + more);
}

/// The string of a case about its static state.
struct Vibrating {
    explicit Vibrating(const Case& its_case, WallGrip grip = WallGrip::sticks)
        : input(its_case),
          scene(build_static_scene(input)),
          string(scene, equilibrium_options(input), grip) {}

    Case input;
    Scene scene;
    StringVibration string;
};

std::vector<VibrationMode> of_kind(const std::vector<VibrationMode>& modes, ModeKind kind) {
    std::vector<VibrationMode> result;
    std::copy_if(modes.begin(), modes.end(), std::back_inserter(result),
                 [&](const VibrationMode& mode) { return mode.kind == kind; });
    return result;
}

/// Unit length, mass and bending stiffness; I/(A L^2) = 0.0025, nu = 0, shear coefficient 1.
constexpr Section stocky{1, 1, 0.0025, 0.005, 1, 1, 400, 200};
/// A pipe of 5 1/2 in, roughly.
constexpr Section slender{20, 34, 0.07, 0.14, 2e6, 2e6, 9.7e8, 4.9e8};

TEST(Modes, AClampedFreeBeamHasTimoshenkosFrequenciesInEqualPairs) {
    const Vibrating beam(level(component(stocky), 64));
    const std::vector<VibrationMode> bending = of_kind(beam.string.modes(0, 14), ModeKind::lateral);
    const std::vector<double> exact =
        ExactBeam(BeamHead::clamped, {span(stocky)}).frequencies(4, 0.5);
    ASSERT_GE(bending.size(), 8U);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(bending[2 * k].frequency / exact[k], 1, 1e-3) << k;
        EXPECT_NEAR(bending[2 * k + 1].frequency / bending[2 * k].frequency, 1, 1e-6) << k;
        EXPECT_EQ(bending[2 * k].crossings, static_cast<std::int64_t>(k));
        EXPECT_GT(bending[2 * k].lateral_share, 0.999);
    }
    EXPECT_LT(bending[0].bending_place, 1.0 / 64) << "the clamp bends most";
}

TEST(Modes, OfABeamConvergeAtFourthOrder) {
    const double exact = ExactBeam(BeamHead::clamped, {span(slender)}).frequencies(3, 5)[2];
    const auto error = [&](int segments) {
        return std::abs(
            Vibrating(level(component(slender), segments)).string.modes(0, 6)[4].frequency / exact -
            1);
    };
    EXPECT_LT(error(24), 1e-3);
    EXPECT_GT(std::log2(error(24) / error(48)), 3);
}

TEST(Modes, ABarHasTheTorsionalAndAxialFrequenciesOfItsWaves) {
    const Vibrating bar(level(component(slender), 40));
    const std::vector<VibrationMode> modes = bar.string.modes(0, 60);
    const auto expect_waves = [&](ModeKind kind, double speed, double share) {
        const std::vector<VibrationMode> found = of_kind(modes, kind);
        ASSERT_GE(found.size(), 2U);
        for (std::size_t n = 0; n < 2; ++n) {
            const double exact = (static_cast<double>(n) + 0.5) * pi * speed / slender.length;
            EXPECT_NEAR(found[n].frequency / exact, 1, 1e-3) << n;
            EXPECT_EQ(found[n].crossings, static_cast<std::int64_t>(n));
        }
        EXPECT_NEAR(share, 1, 1e-9);
    };
    expect_waves(ModeKind::torsional, std::sqrt(slender.torsional / slender.polar_inertia),
                 of_kind(modes, ModeKind::torsional).front().torsional_share);
    expect_waves(ModeKind::axial, std::sqrt(slender.axial / slender.mass),
                 of_kind(modes, ModeKind::axial).front().axial_share);
}

TEST(Modes, TensionRaisesTheFrequenciesOfAClampedAndOfAPinnedBeamByTheExactAmount) {
    for (const double tension : {-2e3, 5e4, 1e6}) {
        for (const bool pinned : {false, true}) {
            if (pinned && tension < 0) continue;  // no static state
            const Vibrating beam(level(component(slender), 40,
                                       (pinned ? "motion = \"pinned\"\n" : "") +
                                           fmt::format("[bit]\nforce = [{}, 0, 0]\n", tension)));
            const std::vector<double> exact =
                ExactBeam(pinned ? BeamHead::pinned : BeamHead::clamped, {span(slender, tension)})
                    .frequencies(3, 0.5);
            const std::vector<VibrationMode> bending =
                of_kind(beam.string.modes(0, 8), ModeKind::lateral);
            ASSERT_GE(bending.size(), 6U);
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(bending[2 * k].frequency / exact[k], 1, 1e-3)
                    << tension << (pinned ? " pinned " : " clamped ") << k;
        }
    }
}

// Catalogue of exact solutions: clamped-free shaft that turns at 10 sqrt(EI/(m L^4)).
TEST(Modes, AShaftThatTurnsWhirlsFasterForwardThanBackward) {
    const Vibrating shaft(level(component(stocky), 32), WallGrip::slides);
    const std::vector<VibrationMode> modes = shaft.string.modes(10, 8);
    EXPECT_NEAR(modes[0].frequency / 3.34785424, 1, 1e-3);
    EXPECT_NEAR(modes[1].frequency / 3.56763534, 1, 1e-3);
    EXPECT_NEAR(modes[0].whirl, -1, 1e-3);
    EXPECT_NEAR(modes[1].whirl, 1, 1e-3);
    const ExactBeam exact(BeamHead::clamped, {span(stocky)});
    const std::vector<double> forward = exact.frequencies(3, 0.1, [](double) { return 10.0; });
    const std::vector<double> backward = exact.frequencies(3, 0.1, [](double) { return -10.0; });
    const std::vector<VibrationMode> bending =
        of_kind(shaft.string.modes(10, 12), ModeKind::lateral);
    ASSERT_GE(bending.size(), 6U);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(bending[2 * k].frequency / backward[k], 1, 1e-3) << k;
        EXPECT_NEAR(bending[2 * k + 1].frequency / forward[k], 1, 1e-3) << k;
    }
}

/// A circular motion: a quarter of a period later each node is where a quarter of a turn about the
/// axis takes it.
TEST(Modes, AForwardWhirlGoesRoundWithTheRotation) {
    const Vibrating shaft(level(component(stocky), 8), WallGrip::slides);
    for (const VibrationMode& mode : shaft.string.modes(10, 2)) {
        const Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
        const Eigen::Vector3d turned = axis.cross(mode.displacement.back());
        EXPECT_NEAR(mode.displacement.back().norm(), 1, 1e-9);
        EXPECT_LT((mode.later_displacement.back() - mode.whirl * turned).norm(), 1e-2);
    }
}

TEST(Modes, ASlowTurnOfAnEvenStringLosesNoneOfItsNearlyEqualFrequencies) {
    const Vibrating shaft(level(component(slender), 24), WallGrip::slides);
    const std::vector<VibrationMode> at_rest = shaft.string.modes(0, 12);
    const std::vector<VibrationMode> turning = shaft.string.modes(1e-3, 12);
    for (std::size_t k = 0; k < at_rest.size(); ++k)
        EXPECT_NEAR(turning[k].frequency / at_rest[k].frequency, 1, 1e-5) << k;
}

TEST(Modes, CriticalSpeedsAreThoseAtWhichTheExactShaftWhirlsAtAnOrderOfItsRate) {
    const Vibrating shaft(level(component(stocky), 32), WallGrip::slides);
    for (const double order : {1.0, 3.0}) {
        const std::vector<CriticalSpeed> speeds = shaft.string.critical_speeds(order, 25, 100);
        EXPECT_EQ(speeds.size(), shaft.string.count_critical_speeds(order, 25));
        for (const double sense : {1.0, -1.0}) {
            std::vector<double> found;
            for (const CriticalSpeed& speed : speeds)
                if (speed.kind == ModeKind::lateral && speed.whirl * sense > 0)
                    found.push_back(speed.rotation_rate);
            const std::vector<double> exact =
                ExactBeam(BeamHead::clamped, {span(stocky)}).frequencies(2, 0.1, [&](double w) {
                    return sense * w / order;
                });
            ASSERT_GE(found.size(), 1U);
            for (std::size_t k = 0; k < std::min<std::size_t>(found.size(), 2); ++k)
                EXPECT_NEAR(found[k] * order / exact[k], 1, 1e-3) << order << " " << sense;
        }
    }
}

TEST(Modes, TheCampbellDiagramIsMadeOfTheModesAtEachRate) {
    const Vibrating shaft(level(component(stocky), 8), WallGrip::slides);
    const std::vector<double> rates{0, 4, 8};
    const std::vector<CampbellPoint> points = shaft.string.campbell(rates, 5, 2);
    ASSERT_EQ(points.size(), 15U);
    for (std::size_t i = 0; i < rates.size(); ++i) {
        const std::vector<VibrationMode> modes = shaft.string.modes(rates[i], 5);
        for (std::size_t k = 0; k < 5; ++k) {
            EXPECT_EQ(points[5 * i + k].rotation_rate, rates[i]);
            EXPECT_NEAR(points[5 * i + k].frequency, modes[k].frequency, 1e-9);
            EXPECT_EQ(points[5 * i + k].kind, modes[k].kind);
        }
    }
}

/// The rate (rad/s) near an expected one at which a signal swings most, by its Fourier transform
/// under Hann's window.
double strongest_rate(const std::vector<double>& time, const std::vector<double>& signal,
                      double expected) {
    double mean = 0;
    for (const double value : signal)
        mean += value / static_cast<double>(signal.size());
    const auto strength = [&](double rate) {
        std::complex<double> sum = 0;
        for (std::size_t k = 0; k < signal.size(); ++k) {
            const double window = 1 - std::cos(2 * pi * time[k] / time.back());
            sum += window * (signal[k] - mean) * std::polar(1.0, -rate * time[k]);
        }
        return std::abs(sum);
    };
    double best = 0;
    double most = 0;
    for (double rate = 0.95 * expected; rate < 1.05 * expected; rate += 1e-4 * expected) {
        const double now = strength(rate);
        if (now <= most) continue;
        most = now;
        best = rate;
    }
    return best;
}

TEST(Modes, AreTheSwingsOfTheLeapfrogAboutAStateThatSagsByAFifthOfItsLength) {
    const std::string pipe = test::table_2_pipe + "[mesh]\nsegments = 16\n";
    const std::string head = "[head]\ndirection = [1, 0, 0]\n";
    const Vibrating string(
        test::case_from("gravity = 9.81\n" + pipe + head + "[run]\nduration = 1\n"));
    ASSERT_GT(string.string.static_shape().position.back().z(), 24.0 / 5);
    // a knock sideways and down, then free
    const test::Run run =
        test::run("gravity = 9.81\n" + pipe + head +
                  "[initial]\nstate = \"equilibrium\"\n[run]\nduration = 100\n"
                  "[bit]\nforce = [[0, [0, 0, 0]], [0.5, [0, 20, 20]], [1, [0, 0, 0]]]\n"
                  "[output]\ninterval = 0.05\nprofile_interval = 0\n");
    std::vector<double> time, sideways, down;
    for (const SeriesRecord& record : run.series) {
        time.push_back(record.time);
        sideways.push_back(record.bit_position.y());
        down.push_back(record.bit_position.z());
    }
    const std::vector<VibrationMode> modes = string.string.modes(0, 2);
    for (const VibrationMode& mode : modes) {
        const bool goes_sideways = std::abs(mode.displacement.back().y()) > 0.5;
        const double swing = strongest_rate(time, goes_sideways ? sideways : down, mode.frequency);
        EXPECT_NEAR(swing / mode.frequency, 1, 2e-3) << goes_sideways;
    }
    EXPECT_GT(modes[1].frequency / modes[0].frequency, 1.01) << "they differ";
}

// -- in a well ------------------------------------------------------------------------------------

/// A string in a straight hole.
Case in_hole(const std::string& toml, double inclination, double diameter) {
    Case input = test::case_from(toml);
    input.well = test::well_through({{0, inclination, 0}, {1000, inclination, 0}}, diameter);
    return input;
}

TEST(Modes, ACollarBetweenTwoStabilisersInMudHasTheFrequenciesOfABeamOnSpringsWithAddedMass) {
    // full-gauge stabilisers, held on the axis; the sag between them stays clear of the wall
    const auto collar = [](double length, bool stabilised) {
        return fmt::format(R"(
[[string.component]]
length = {}
outer_diameter = 0.17
inner_diameter = 0.07
density = 7850
youngs_modulus = 206e9
{}
)",
                           length,
                           stabilised ? fmt::format("contact_diameter = 0.25\ncontact_length = "
                                                    "0.5\ncontact_position = {}\n"
                                                    "contact_stiffness = 6e8",
                                                    length)
                                      : "");
    };
    const Vibrating string(
        in_hole("gravity = 0.01\n" + collar(8, true) + collar(15, true) + collar(4, false) +
                    "[fluid]\ndensity = 1200\nviscosity = 0.02\n[mesh]\nelement_length = 0.5\n"
                    "[contact]\ninterference = 0.01\n[run]\nduration = 1\n",
                pi / 2, 0.25),
        WallGrip::slides);
    const double outer = 0.085;
    const double inner = 0.035;
    const double hole = 0.125;
    const double metal = pi * (outer * outer - inner * inner);
    const double mass = 7850 * metal;
    const double coefficient =
        (hole * hole + outer * outer) / (hole * hole - outer * outer);  // Stokes
    const double moving = mass + 1200 * pi * (inner * inner + outer * outer * coefficient);
    const double second_moment = pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
    const double shear = 206e9 / 2.6 * metal;
    const auto part = [&](double length, double spring) {
        return BeamSpan{length,
                        moving,
                        7850 * second_moment,
                        2 * 7850 * second_moment,
                        206e9 * second_moment,
                        shear,
                        0,
                        spring};
    };
    const double spring = 6e8 * 0.5;
    const std::vector<double> exact =
        ExactBeam(BeamHead::clamped, {part(8, spring), part(15, spring), part(4, 0)})
            .frequencies(3, 2);
    const std::vector<VibrationMode> bending =
        of_kind(string.string.modes(0, 8), ModeKind::lateral);
    ASSERT_GE(bending.size(), 6U);
    for (std::size_t k = 0; k < 3; ++k)
        for (const std::size_t of_pair : {2 * k, 2 * k + 1})
            EXPECT_NEAR(bending[of_pair].frequency / exact[k], 1, 5e-3) << of_pair;
}

TEST(Modes, APartAsWideAsItsHoleHoldsAStringOnTheAxisOfAVerticalHole) {
    const std::string pipe = R"(
[[string.component]]
length = 10
outer_diameter = 0.17
inner_diameter = 0.07
density = 7850
youngs_modulus = 206e9
contact_diameter = 0.25
contact_length = 0.5
contact_position = 10
)";
    const auto lowest = [&](double hole) {
        return Vibrating(in_hole("gravity = 0\n" + pipe +
                                     "[mesh]\nelement_length = 0.5\n[run]\nduration = 1\n",
                                 0, hole),
                         WallGrip::slides)
            .string.modes(0, 1)[0]
            .frequency;
    };
    const double second_moment = pi / 4 * (std::pow(0.085, 4) - std::pow(0.035, 4));
    const double mass = 7850 * pi * (0.085 * 0.085 - 0.035 * 0.035);
    const double unit = std::sqrt(206e9 * second_moment / mass) / 100;
    // slender beams: clamped-pinned and clamped-free
    EXPECT_NEAR(lowest(0.25) / unit, 15.418, 0.15);
    EXPECT_NEAR(lowest(0.30) / unit, 3.516, 0.02);
}

TEST(Modes, AStringThatSticksToItsWallTwistsAgainstFrictionSpringsAndOneThatTurnsDoesNot) {
    const std::string pipe = R"(
[[string.component]]
length = 200
outer_diameter = 0.127
inner_diameter = 0.108
density = 7850
youngs_modulus = 206e9
[mesh]
segments = 40
[run]
duration = 1
)";
    const auto torsion = [&](WallGrip grip) {
        const Vibrating string(in_hole(pipe, pi / 2, 0.25), grip);
        return of_kind(string.string.modes(0, 40), ModeKind::torsional);
    };
    const std::vector<VibrationMode> free = torsion(WallGrip::slides);
    ASSERT_FALSE(free.empty());
    const double exact = pi / 2 * std::sqrt(206e9 / 2.6 / 7850) / 200;
    EXPECT_NEAR(free.front().frequency / exact, 1, 2e-3);
    for (const VibrationMode& held : torsion(WallGrip::sticks))
        EXPECT_GT(held.frequency, 5 * exact);
}

// -- response -------------------------------------------------------------------------------------

/// Amplitude of the tip of a slender clamped beam under a force across its end, over that force.
double tip_flexibility(const Section& section, double mass, double rate) {
    const double b = std::pow(mass * rate * rate / section.bending, 0.25);
    const double x = b * section.length;
    return std::abs((std::sin(x) * std::cosh(x) - std::cos(x) * std::sinh(x)) /
                    (section.bending * b * b * b * (1 + std::cos(x) * std::cosh(x))));
}

/// The part of a beam's own response at its end that its first mode has: f/(k - m w^2) with the
/// modal mass of a quarter of the beam's.
double first_mode_flexibility(const Section& section, double mass, double rate) {
    const double modal = 0.25 * mass * section.length;
    const double first =
        3.5160153 * std::sqrt(section.bending / mass) / (section.length * section.length);
    return std::abs(1 / (modal * (first * first - rate * rate)));
}

TEST(ForcedResponse, AnEccentricMassWhirlsAShaftOnTheExactRadius) {
    const Section light{20, 1, 1e-3, 2e-3, 160000, 160000, 4e7, 4e7};
    const double unbalance = 1e-3;
    const Vibrating shaft(
        level(component(light, fmt::format("eccentric_mass = {}\neccentric_mass_position = 20\n",
                                           unbalance)),
              24),
        WallGrip::slides);
    const double first = 3.5160 * std::sqrt(light.bending) / 400;
    for (const double part : {0.5, 0.8, 0.97, 1.3}) {
        const double rate = part * first;
        const double force = unbalance * rate * rate;
        const ForcedResponse found = shaft.string.response({1, true, 0, 0}, {rate}, 1).front();
        EXPECT_EQ(found.frequency, rate);
        EXPECT_NEAR(found.displacement.back() / (force * tip_flexibility(light, 1, rate)), 1, 5e-3)
            << part;
        EXPECT_EQ(found.displacement.front(), 0);
        if (part == 0.97) {
            EXPECT_NEAR(
                found.displacement.back() / (force * first_mode_flexibility(light, 1, rate)), 1,
                0.02);
        }
    }
}

TEST(ForcedResponse, MudAroundTheShaftAddsItsMass) {
    const Section pipe{10, 50, 0.1, 0.2, 3e6, 2e6, 1e9, 5e8};
    const Vibrating shaft(
        in_hole("gravity = 0\n" +
                    component(pipe,
                              "outer_diameter = 0.1\ninner_diameter = 0.05\n"
                              "eccentric_mass = 0.01\neccentric_mass_position = 10\n") +
                    "[fluid]\ndensity = 1200\nviscosity = 0\n[run]\nduration = 1\n[mesh]\n"
                    "segments = 24\n",
                0, 0.25),
        WallGrip::slides);
    const double coefficient = (0.125 * 0.125 + 0.05 * 0.05) / (0.125 * 0.125 - 0.05 * 0.05);
    const double moving = pipe.mass + 1200 * pi * (0.025 * 0.025 + 0.05 * 0.05 * coefficient);
    for (const double rate : {4.0, 6.0, 12.0}) {
        const ForcedResponse found = shaft.string.response({1, true, 0, 0}, {rate}, 1).front();
        EXPECT_NEAR(
            found.displacement.back() / (0.01 * rate * rate * tip_flexibility(pipe, moving, rate)),
            1, 0.01)
            << rate;
    }
}

TEST(ForcedResponse, ForceAndTorqueAtTheBitMakeTheWavesOfABarThatDampsThem) {
    const double tau = 1e-4;
    const Vibrating bar(
        level(component(slender), 40, fmt::format("[damping]\nkelvin_voigt = {}\n", tau)),
        WallGrip::slides);
    const Excitation excitation{6, false, 1e4, 500};
    const double rate = 30;
    const std::complex<double> i(0, 1);
    const double frequency = 6 * rate;
    const std::complex<double> lossy = 1.0 + i * frequency * tau;
    const auto flexibility = [&](double stiffness, double inertia) {
        const std::complex<double> k = frequency * std::sqrt(inertia / (stiffness * lossy));
        return std::abs(std::tan(k * slender.length) / (stiffness * lossy * k));
    };
    const ForcedResponse found = bar.string.response(excitation, {rate}, 1).front();
    EXPECT_EQ(found.frequency, frequency);
    EXPECT_NEAR(found.displacement.back(), 1e4 * flexibility(slender.axial, slender.mass),
                1e-3 * found.displacement.back());
    EXPECT_NEAR(found.twist.back(), 500 * flexibility(slender.torsional, slender.polar_inertia),
                1e-3 * found.twist.back());
    // in the middle of the last segment
    const auto below = [&](double stiffness, double inertia) {
        const std::complex<double> k = frequency * std::sqrt(inertia / (stiffness * lossy));
        return std::abs(std::cos(k * (slender.length - 0.25)) / std::cos(k * slender.length));
    };
    EXPECT_NEAR(found.axial_force.back() / 1e4, below(slender.axial, slender.mass), 5e-3);
    EXPECT_NEAR(found.torque.back() / 500, below(slender.torsional, slender.polar_inertia), 5e-3);
}

TEST(ForcedResponse, InnerDampingDoesNotSeeAWhirlAtTheRateOfTurning) {
    // a section that whirls as it turns is bent the same all the time
    const auto tip = [](double tau, double order) {
        const Vibrating shaft(
            level(component(stocky, "eccentric_mass = 1e-3\neccentric_mass_position = 1\n"), 16,
                  fmt::format("[damping]\nkelvin_voigt = {}\n", tau)),
            WallGrip::slides);
        return shaft.string.response({order, true, 0, 0}, {3}, 1).front().displacement.back();
    };
    EXPECT_NEAR(tip(0.05, 1) / tip(0, 1), 1, 1e-9);
    EXPECT_LT(tip(0.05, 1.15), 0.75 * tip(0, 1.15));
}

TEST(ForcedResponse, ASideForceOfTheWallIsWhatHoldsAnUnbalancedStabiliser) {
    // far below the first frequency the springs of the wall carry the unbalance
    const std::string pipe = R"(
[[string.component]]
length = 20
outer_diameter = 0.17
inner_diameter = 0.07
density = 7850
youngs_modulus = 206e9
contact_diameter = 0.25
contact_length = 0.5
contact_position = 20
eccentric_mass = 1
eccentric_mass_position = 20
)";
    const Vibrating string(in_hole(pipe + "[mesh]\nelement_length = 0.5\n[contact]\n"
                                          "interference = 0.01\n[run]\nduration = 1\n",
                                   pi / 2, 0.25),
                           WallGrip::slides);
    const ForcedResponse found = string.string.response({1, true, 0, 0}, {1}, 1).front();
    EXPECT_NEAR(found.side_force.back(), 1, 1e-2);
    EXPECT_GT(string.string.static_shape().side_force.back(), 1000);
    EXPECT_EQ(found.lifts_off, 0);
}

TEST(ForcedResponse, APipeLiftsOffTheWallWhereItsUnbalanceIsMoreThanItsWeight) {
    const std::string pipe = R"(
[[string.component]]
length = 60
outer_diameter = 0.127
inner_diameter = 0.07
density = 7850
youngs_modulus = 206e9
eccentric_mass = 1
eccentric_mass_position = 50
)";
    const Vibrating string(in_hole(pipe + test::mesh(60), pi / 2, 0.2), WallGrip::slides);
    const auto lifts_off = [&](double rate) {
        return string.string.response({1, true, 0, 0}, {rate}, 1).front().lifts_off;
    };
    EXPECT_EQ(lifts_off(3), 0);
    EXPECT_EQ(lifts_off(200), 1);
}

TEST(Modes, OfAStringThatNothingHoldsThereAreNone) {
    EXPECT_THROW(Vibrating(level(component(slender), 4, "motion = \"free\"\n")),
                 std::invalid_argument);
}

}  // namespace
}  // namespace drillstrand
