// A pipe thrown against the wall of the well: rebound of a mass on a spring and dashpot.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Impact = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Impact, both_integrators, integrator_name);

constexpr double thrown_at = 0.49;  // m/s: the pipe reaches the wall at 0.1316 s

/// Speed after the impact over speed before.
double restitution(const Case& input) {
    const test::Run result = run(input);
    const double before = speed_east(result.profiles.at(11));
    EXPECT_NEAR(before, thrown_at, 1e-6);
    return -speed_east(result.end()) / before;
}

struct Wall {
    double stiffness, damping, clipped, adhesive;
};

// Closed form for 31.8557 kg/m: exp(-pi z / sqrt(1 - z^2)) where the dashpot may pull, z the
// damping ratio; where it may not, contact ends when the force vanishes.
constexpr Wall walls[] = {
    {1e5, 356.963, 0.7440793977217798, 0.7292476142876709},
    {1e5, 1e3, 0.47185882104538035, 0.3997971446874867},
};

TEST_P(Impact, PipeReboundsWithTheRestitutionOfAWallThatOnlyPushes) {
    for (const Wall& wall : walls) {
        Case input = thrown_pipe(integrator(), thrown_at);
        input.contact.normal_stiffness = wall.stiffness;
        input.contact.normal_damping = wall.damping;
        EXPECT_NEAR(restitution(input), wall.clipped, 1e-3 * wall.clipped);
    }
}

TEST_P(Impact, PipeReboundsWithTheRestitutionOfADashpotThatAlsoPulls) {
    for (const Wall& wall : walls) {
        Case input = thrown_pipe(integrator(), thrown_at);
        input.contact.normal_stiffness = wall.stiffness;
        input.contact.normal_damping = wall.damping;
        input.contact.tension = true;
        EXPECT_NEAR(restitution(input), wall.adhesive, 1e-3 * wall.adhesive);
    }
}

TEST_P(Impact, OverdampedWallHardlyReturnsThePipe) {
    Case input = thrown_pipe(integrator(), thrown_at);
    input.contact.normal_stiffness = 1e5;
    input.contact.normal_damping = 1e6;
    // to first order in the step over the time in which the dashpot stops the pipe, m/eta = 32 us
    EXPECT_NEAR(restitution(input), 3.1853334220129373e-06, is_leapfrog() ? 0.2e-6 : 0.02e-6);
}

// The paper's wall: stiffness 1e5 Pa and damping 1e6 Pa s stand in its examples.
TEST_P(Impact, OverdampedDashpotThatPullsKeepsThePipe) {
    Case input = thrown_pipe(integrator(), thrown_at);
    input.contact.normal_stiffness = 1e5;
    input.contact.normal_damping = 1e6;
    input.contact.tension = true;
    const test::Run result = run(input);
    EXPECT_NEAR(speed_east(result.end()), 0, 1e-4);
    EXPECT_GT(result.end().eccentricity.front(), clearance);
}

TEST_P(Impact, RestitutionOfTheCaseFileIsTheRestitutionOfThePipe) {
    for (const double wanted : {0.9, 0.5, 0.2}) {
        Case input = thrown_pipe(integrator(), thrown_at);
        input.contact.normal_stiffness = 1e6;
        input.contact.restitution = wanted;
        EXPECT_NEAR(restitution(input), wanted, 1e-3 * wanted);
    }
}

// With steps of its own choice, about 1 ms for this pipe: from a wall that swings once in 35 steps
// to one that swings three times in a step, whenever within the step the pipe comes to it.
TEST(Impact, OfALeapfrogHasTheRestitutionOfTheCaseWhateverTheWallAndTheStep) {
    for (const double stiffness : {1e5, 1e6, 1e7, 1e8, 1e9}) {
        for (const double wanted : {0.1, 0.3, 0.5, 0.8, 0.95}) {
            for (int phase = 0; phase < 10; ++phase) {
                Case input = thrown_pipe(IntegratorKind::leapfrog, thrown_at);
                // 40 steps from the axis to the wall
                input.run.cfl = RunCase().cfl * (1 - 0.0025 * phase);
                input.contact.normal_stiffness = stiffness;
                input.contact.restitution = wanted;
                EXPECT_NEAR(restitution(input), wanted, 1e-6)
                    << stiffness << " Pa, phase " << phase;
            }
        }
    }
}

// What the impact leaves to the wall: a heavy pipe bounces lower and lower and comes to rest on it.
TEST(Impact, LeavesAHeavyPipeAtRestOnTheLowSideInTheEnd) {
    const double level = std::numbers::pi / 2;
    for (const double stiffness : {1e5, 1e7, 1e9}) {
        Case input = short_pipe(IntegratorKind::leapfrog, level);
        input.contact.normal_stiffness = stiffness;
        input.contact.restitution = 0.5;
        input.run.duration = 3;
        const test::Run result = run(input);
        const double press = pipe_mass * input.gravity / stiffness;
        EXPECT_NEAR(result.end().eccentricity.front(), clearance + press, 1e-6 + 0.02 * press);
        EXPECT_NEAR(result.end().normal_force.front(), pipe_mass * input.gravity,
                    0.02 * pipe_mass * input.gravity);
    }
}

}  // namespace
}  // namespace drillstrand::test
