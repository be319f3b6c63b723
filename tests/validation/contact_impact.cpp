// A pipe thrown against the wall of the well: rebound of a mass on a spring and dashpot.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;

/// Speed of the pipe toward East (d1).
double speed(const Profile& profile) {
    return profile.momentum.front()[4] / pipe_mass;
}

/// A pipe that a push of 0.1 s sends from the axis of a vertical well to the East at 0.5 m/s,
/// without weight; it reaches the wall at 0.13 s.
Case thrown_pipe() {
    Case input = short_pipe(0);
    input.gravity = 0;
    input.contact.static_friction = input.contact.dynamic_friction = {0, 0};
    const double peak = pipe_mass * 0.5 / 0.05;
    load(
        input, 0.1, 0.05,
        [peak](double t) { return Vector3d(0, std::abs(t - 0.05) < 1e-6 ? peak : 0, 0); },
        [](double) { return Vector3d(Vector3d::Zero()); });
    input.run.absolute_tolerance = 1e-9;
    input.run.relative_tolerance = 1e-7;
    input.run.duration = 0.25;
    input.output.profile_interval = 0.01;
    return input;
}

/// Speed after the impact over speed before.
double restitution(const Case& input) {
    const test::Run result = run(input);
    const double before = speed(result.profiles.at(11));
    EXPECT_NEAR(before, 0.5, 1e-6);
    return -speed(result.end()) / before;
}

struct Impact {
    double stiffness, damping, clipped, adhesive;
};

// Closed form for 31.8557 kg/m: exp(-pi z / sqrt(1 - z^2)) where the dashpot may pull, z the
// damping ratio; where it may not, contact ends when the force vanishes.
constexpr Impact impacts[] = {
    {1e5, 356.963, 0.7440793977217798, 0.7292476142876709},
    {1e5, 1e3, 0.47185882104538035, 0.3997971446874867},
};

TEST(Impact, PipeReboundsWithTheRestitutionOfAWallThatOnlyPushes) {
    for (const Impact& impact : impacts) {
        Case input = thrown_pipe();
        input.contact.normal_stiffness = impact.stiffness;
        input.contact.normal_damping = impact.damping;
        EXPECT_NEAR(restitution(input), impact.clipped, 1e-3 * impact.clipped);
    }
}

TEST(Impact, PipeReboundsWithTheRestitutionOfADashpotThatAlsoPulls) {
    for (const Impact& impact : impacts) {
        Case input = thrown_pipe();
        input.contact.normal_stiffness = impact.stiffness;
        input.contact.normal_damping = impact.damping;
        input.contact.tension = true;
        EXPECT_NEAR(restitution(input), impact.adhesive, 1e-3 * impact.adhesive);
    }
}

TEST(Impact, OverdampedWallHardlyReturnsThePipe) {
    Case input = thrown_pipe();
    input.contact.normal_stiffness = 1e5;
    input.contact.normal_damping = 1e6;
    EXPECT_NEAR(restitution(input), 3.1853334220129373e-06, 0.02e-6);
}

// The paper's wall: stiffness 1e5 Pa and damping 1e6 Pa s stand in its examples.
TEST(Impact, OverdampedDashpotThatPullsKeepsThePipe) {
    Case input = thrown_pipe();
    input.contact.normal_stiffness = 1e5;
    input.contact.normal_damping = 1e6;
    input.contact.tension = true;
    const test::Run result = run(input);
    EXPECT_NEAR(speed(result.end()), 0, 1e-4);
    EXPECT_GT(result.end().eccentricity.front(), clearance);
}

TEST(Impact, RestitutionOfTheCaseFileIsTheRestitutionOfThePipe) {
    for (const double wanted : {0.9, 0.5, 0.2}) {
        Case input = thrown_pipe();
        input.contact.normal_stiffness = 1e6;
        input.contact.restitution = wanted;
        EXPECT_NEAR(restitution(input), wanted, 1e-3 * wanted);
    }
}

}  // namespace
}  // namespace drillstrand::test
