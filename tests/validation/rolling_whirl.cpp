// Backward whirl of short collars that roll along the wall without slip: the rate that kinematics
// gives, and the normal force that holds what goes around.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Component collar(double length) {
    Component collar;
    collar.length = length;
    collar.outer_diameter = 0.171;
    collar.inner_diameter = 0.071;
    collar.linear_density = 149.2;
    collar.youngs_modulus = 206e9;
    return collar;
}

/// What the last second of a run, with a profile every 2 ms, says of the node at the bit.
struct Orbit {
    double rate = 0;    ///< around the well (rad/s)
    double spin = 0;    ///< rad/s
    double normal = 0;  ///< N, of the node's cell
};

Orbit orbit_of(const test::Run& result, double polar_inertia) {
    constexpr std::size_t samples = 500;
    Orbit orbit;
    for (std::size_t i = result.profiles.size() - samples; i < result.profiles.size(); ++i) {
        const Profile& now = result.profiles[i];
        const Vector3d& a = result.profiles[i - 1].position.back();
        const Vector3d& b = now.position.back();
        const double angle =
            std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
        orbit.rate += angle / (now.time - result.profiles[i - 1].time) / samples;
        orbit.spin += now.momentum.back()[0] / polar_inertia / samples;
        orbit.normal += now.normal_force.back() * result.cell.back() / samples;
    }
    return orbit;
}

Case collar_without_weight(double length) {
    Case input = short_pipe(IntegratorKind::leapfrog, 0);
    input.gravity = 0;
    input.string.components = {collar(length)};
    input.contact.rolling_creep = 0;
    input.output.profile_interval = 0.002;
    return input;
}

// ------------------------------------------------------------------ all of it on the wall

// Pushed along the wall and spun, a tenth too fast for rolling: friction takes that away.
TEST(RollingWhirl, OfAFreeCollarHasTheRateOfKinematicsAndTheForceOfItsOrbit) {
    constexpr double length = 3;
    constexpr double gap = hole_radius - 0.171 / 2;
    for (const double speed : {0.3, 1.0}) {
        Case input = collar_without_weight(length);
        input.contact.normal_stiffness = 1e9;
        input.initial.offset = gap * Vector3d::UnitX();
        const double mass = input.string.components.front().linear_density;
        const double polar_inertia = mass * (0.171 * 0.171 + 0.071 * 0.071) / 8;
        const double peak = 1 / 0.05;
        const double spin = -1.1 * speed / (0.171 / 2);
        const auto pulse = [peak](double t) { return std::abs(t - 0.05) < 1e-6 ? peak : 0.0; };
        load(
            input, 0.1, 0.05,
            [&](double t) {
                return Vector3d(0, length / pipe_length * mass * speed * pulse(t), 0);
            },
            [&](double t) {
                return Vector3d(0, 0, length / pipe_length * polar_inertia * spin * pulse(t));
            });
        input.run.duration = 2;
        const Orbit orbit = orbit_of(run(input), polar_inertia);
        EXPECT_GT(orbit.rate, 0.9 * speed / gap);
        const double rolling = -orbit.spin * (0.171 / 2) / gap;
        EXPECT_NEAR(orbit.rate, rolling, 2e-3 * rolling) << speed;
        const double held = mass * 0.5 * length * gap * orbit.rate * orbit.rate;
        EXPECT_NEAR(orbit.normal, held, 5e-3 * held) << speed;
    }
}

// ------------------------------------------------------------------ its bit on the wall

constexpr double bit_radius = 0.1;
constexpr double hole = 0.2159;
constexpr double bit_gap = 0.5 * hole - bit_radius;

/// A collar held on the axis at its head, which turns it; its bit, of less than gauge, is brought
/// to the wall and carried around by a load that comes and goes, at the rate at which it rolls.
Case collar_that_rolls_on_its_bit(double length, HeadMotion held, double rate) {
    Case input = collar_without_weight(length);
    input.well->sections.front().diameter = hole;
    input.string.components.front().contact = ContactPoint{length, 2 * bit_radius, 0.15, {}};
    input.mesh.segments = 16;
    input.head.motion = held;
    const double most = 4e3;  // N
    std::vector<double> times;
    std::vector<double> spins;
    std::vector<Vector3d> forces;
    double angle = 0;
    constexpr double step = 0.01;
    for (double t = 0; t < 4; t += step) {
        const double now = rate * smooth_step(t, 0.5, 2.5);
        times.push_back(t);
        spins.push_back(-now * bit_gap / bit_radius);
        forces.emplace_back(most * (smooth_step(t, 0, 0.5) - smooth_step(t, 2.5, 3.5)) *
                            Vector3d(std::cos(angle), std::sin(angle), 0));
        angle += step * rate * smooth_step(t + 0.5 * step, 0.5, 2.5);
    }
    input.head.rotation = ScalarSchedule(times, spins);
    input.bit.force = VectorSchedule(times, forces);
    input.run.duration = 5;
    return input;
}

/// Force that keeps the end of a beam, which goes around with a rate, at the distance of a gap:
/// EI y'''' = m rate^2 y along it, without moment at that end (N).
double holding_force(double length, HeadMotion held, double rate, double gap) {
    const double bending = 206e9 * pi / 64 * (std::pow(0.171, 4) - std::pow(0.071, 4));
    const double b = std::pow(149.2 * rate * rate / bending, 0.25);
    const double x = b * length;
    const double slender = bending * b * b * b * gap;
    if (held == HeadMotion::pinned)  // y = sin bx/(2 sin x) + sinh bx/(2 sinh x)
        return 0.5 * slender * (1 / std::tanh(x) - 1 / std::tan(x));
    // y = p (cos bx - cosh bx) + q (sin bx - sinh bx), y'' = 0 at the end
    const double q = (std::cos(x) + std::cosh(x));
    const double p = -(std::sin(x) + std::sinh(x));
    const double end = p * (std::cos(x) - std::cosh(x)) + q * (std::sin(x) - std::sinh(x));
    const double third = p * (std::sin(x) - std::sinh(x)) - q * (std::cos(x) + std::cosh(x));
    return slender * third / end;
}

TEST(RollingWhirl, OfACollarThatRollsOnItsBitHasTheRateOfKinematicsAndTheForceOfItsBeam) {
    struct Held {
        HeadMotion head;
        double length, rate;
    };
    // a collar that only swings, one that bends, and one whose clamp pulls its bit off the wall
    // against its orbit
    for (const Held& held : {Held{HeadMotion::pinned, 3, 20}, Held{HeadMotion::pinned, 5, 40},
                             Held{HeadMotion::driven, 6, 40}}) {
        SCOPED_TRACE(held.length);
        const Case input = collar_that_rolls_on_its_bit(held.length, held.head, held.rate);
        const test::Run result = run(input);
        const double polar_inertia = 149.2 * (0.171 * 0.171 + 0.071 * 0.071) / 8;
        const Orbit orbit = orbit_of(result, polar_inertia);
        const double rolling = -orbit.spin * bit_radius / bit_gap;
        EXPECT_NEAR(rolling, held.rate, 0.01 * held.rate);
        EXPECT_NEAR(orbit.rate, rolling, 0.01 * rolling);
        const double force = holding_force(held.length, held.head, orbit.rate, bit_gap);
        EXPECT_GT(force, 100);
        EXPECT_NEAR(orbit.normal, force, 0.01 * force);
    }
}

}  // namespace
}  // namespace drillstrand::test
