// Rolling contact: friction that rolling relaxes, and friction that slides in several directions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
constexpr double degree = pi / 180;

using SpinningPipe = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, SpinningPipe, both_integrators, integrator_name);
using Creep = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Creep, both_integrators, integrator_name);

Vector3d none(double /*time*/) {
    return Vector3d::Zero();
}

/// The pipe that a load carries around the well, a turn a second, with a pull along the well (N/m)
/// that comes within the second second.
Case carried_around_and_pulled(IntegratorKind integrator, const ContactCase& contact, double pull) {
    Case input = pipe_carried_around(integrator, contact);
    const VectorSchedule around = input.head.force;
    load(
        input, 4, 0.005,
        [around, pull](double t) {
            return Vector3d(around(t) / (pipe_length / 2) +
                            pull * smooth_step(t, 1, 2) * Vector3d::UnitZ());
        },
        none);
    return input;
}

/// Way along the well over the last second of a run (m).
double way_of_last_second(const Run& run) {
    constexpr std::size_t samples = 500;
    const Profile& begin = run.profiles.at(run.profiles.size() - 1 - samples);
    EXPECT_NEAR(run.end().time - begin.time, 1, 1e-9);
    return run.end().position.front().z() - begin.position.front().z();
}

/// Mean normal force over the last second (N/m).
double pressing(const Run& run) {
    constexpr std::size_t samples = 500;
    double sum = 0;
    for (std::size_t i = run.profiles.size() - samples; i < run.profiles.size(); ++i)
        sum += run.profiles[i].normal_force.front() / samples;
    return sum;
}

constexpr double creep = 0.005;

// creepage xi F / (mu_d N) of the way that the contact rolls
void expect_creep(IntegratorKind integrator, FrictionLaw law, double part) {
    ContactCase contact;
    contact.law = law;
    contact.rolling_creep = creep;
    constexpr double contact_speed = 2 * pi * hole_radius;
    // press and centrifugal force
    const double normal = 300 + pipe_mass * 4 * pi * pi * clearance;
    const double pull = part * contact.dynamic_friction.axial * normal;
    const test::Run result = run(carried_around_and_pulled(integrator, contact, pull));
    EXPECT_NEAR(pressing(result), normal, 0.01 * normal);
    const double expected =
        creep * contact_speed * pull / (contact.dynamic_friction.axial * pressing(result));
    EXPECT_NEAR(way_of_last_second(result), expected, 0.02 * std::abs(expected)) << part;
}

TEST_P(Creep, OfAPipeThatRollsFreelyIsInProportionToThePullAlongIt) {
    expect_creep(integrator(), FrictionLaw::coulomb, 0.1);
    expect_creep(integrator(), FrictionLaw::coulomb, -0.5);
}

TEST_P(Creep, OfThePapersLawLikewise) {
    expect_creep(integrator(), FrictionLaw::paper, 0.1);
}

TEST_P(Creep, OfNoneLeavesARollingPipeWhereItsSpringsHoldIt) {
    for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::paper}) {
        ContactCase contact;
        contact.law = law;
        contact.rolling_creep = 0;
        const test::Run result = run(carried_around_and_pulled(integrator(), contact, 50));
        EXPECT_NEAR(way_of_last_second(result), 0, 2e-6);
    }
}

TEST_P(Creep, MovesAPipeForwardOnlyWhileItRolls) {
    // lies still under a pull of half of what it could hold, for two seconds after it has come
    const double inclination = 90 * degree;
    Case input = short_pipe(integrator(), inclination);
    input.contact.rolling_creep = creep;
    lay_down(input, inclination);
    const double hold = input.contact.dynamic_friction.axial * pipe_mass * input.gravity;
    load(
        input, 2, 0.01,
        [hold](double t) {
            return Vector3d(0.5 * hold * smooth_step(t, 0, 2) * Vector3d::UnitX());
        },
        none);
    input.run.duration = 4;
    input.output.profile_interval = 1;
    const test::Run result = run(input);
    const Vector3d way = result.end().position.front() - result.profiles.at(2).position.front();
    EXPECT_LT(way.norm(), 1e-7);
}

// A flywheel that spins in place: friction along the slip, of which the axial share is v_l / |v|.
TEST_P(SpinningPipe, GivesWayAlongTheWellByItsShareOfTheSlip) {
    const double inclination = 90 * degree;
    Case input = short_pipe(integrator(), inclination);
    constexpr double inertia = 10;  // kg m
    constexpr double share = 0.2;
    input.string.components.front().polar_inertia = inertia;
    input.contact.static_friction = input.contact.dynamic_friction;
    lay_down(input, inclination);
    const double friction = input.contact.dynamic_friction.axial * pipe_mass * input.gravity;
    // a side force holds against the friction around the well: it does not climb
    const Vector3d hold(share * friction, -std::sqrt(1 - share * share) * friction, 0);
    load(
        input, 3, 0.01, [hold](double /*time*/) { return hold; },
        [](double t) { return Vector3d(t < 0.105 ? inertia * 200 : 0.0, 0, 0); });
    input.run.duration = 3;
    input.output.profile_interval = 0.25;
    const test::Run result = run(input);
    const auto speed = [&](std::size_t i) {
        return result.profiles.at(i).momentum.front()[3] / pipe_mass;
    };
    for (std::size_t i = result.profiles.size() - 3; i + 1 < result.profiles.size(); ++i) {
        const Profile& profile = result.profiles[i];
        EXPECT_LT(std::abs(profile.position.front().y()), 0.1 * clearance);
        const double surface = pipe_radius * profile.momentum.front()[0] / inertia;
        EXPECT_GT(surface, 1);
        // what accelerates the pipe does not rub
        const double acceleration = (speed(i + 1) - speed(i - 1)) / 0.5;
        const double rubs = share - pipe_mass * acceleration / friction;
        EXPECT_NEAR(speed(i) / std::hypot(speed(i), surface), rubs, 0.02 * rubs);
    }
}

}  // namespace
}  // namespace drillstrand::test
