// Coulomb friction of a pipe on the wall of a straight well.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;
constexpr double degree = std::numbers::pi / 180;

using Friction = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Friction, both_integrators, integrator_name);

Vector3d none(double /*time*/) {
    return Vector3d::Zero();
}

/// Way of the pipe down the well since the start (m).
double way(const Run& result, const Profile& profile, double inclination) {
    return (profile.position.front() - result.profiles.front().position.front())
        .dot(down_the_well(inclination));
}

/// A pipe that lies on the wall, its weight along the well carried for it at first and left to
/// friction within 1 s.
double way_of_a_pipe_left_to_friction(IntegratorKind integrator, double inclination,
                                      FrictionCoefficients fixed, FrictionCoefficients slide,
                                      double stribeck_speed = 0) {
    Case input = short_pipe(integrator, inclination);
    input.contact.static_friction = fixed;
    input.contact.dynamic_friction = slide;
    input.contact.stribeck_speed = stribeck_speed;
    input.contact.tangential_stiffness = 1e7;
    lay_down(input, inclination);
    const Vector3d carried =
        -pipe_mass * input.gravity * std::cos(inclination) * down_the_well(inclination);
    load(
        input, 1, 0.01,
        [carried](double t) { return Vector3d((1 - smooth_step(t, 0, 1)) * carried); }, none);
    input.run.duration = 2;
    const test::Run result = run(input);
    return way(result, result.end(), inclination);
}

// F4: a pipe slides where the inclination is below atan(1/mu).
TEST_P(Friction, PipeSlidesWhereTheInclinationIsBelow67point22DegreesForFrictionOf042) {
    const FrictionCoefficients mu = {0.42, 0.42};
    EXPECT_GT(way_of_a_pipe_left_to_friction(integrator(), (67.2176 - 0.15) * degree, mu, mu),
              5e-3);
    EXPECT_LT(way_of_a_pipe_left_to_friction(integrator(), (67.2176 + 0.15) * degree, mu, mu),
              1e-4);
}

TEST_P(Friction, StaticFrictionDecidesWhetherAPipeStartsToSlide) {
    const FrictionCoefficients fixed = {0.6, 0.6};
    const FrictionCoefficients slide = {0.42, 0.42};
    EXPECT_GT(way_of_a_pipe_left_to_friction(integrator(), (59.0362 - 0.15) * degree, fixed, slide),
              0.1);
    EXPECT_LT(way_of_a_pipe_left_to_friction(integrator(), (59.0362 + 0.15) * degree, fixed, slide),
              1e-4);
}

/// Mean acceleration down the well of a pipe that lies on the wall and is let go.
double sliding_acceleration(IntegratorKind integrator, double inclination,
                            const ContactCase& contact) {
    Case input = short_pipe(integrator, inclination);
    input.contact = contact;
    lay_down(input, inclination);
    input.run.duration = 1;
    input.output.profile_interval = 0.5;
    const test::Run result = run(input);
    const auto speed = [&](std::size_t i) {
        return result.profiles.at(i).momentum.front()[3] / pipe_mass;
    };
    return (speed(2) - speed(1)) / 0.5;
}

// The first slip is at 0.6; the spring must not climb back there while the pipe slides.
TEST_P(Friction, SlidingPipeIsHeldByDynamicFrictionAlone) {
    const ContactCase contact;  // 0.6 static, 0.42 dynamic
    // g (cos - 0.42 sin) with g = 9.81
    EXPECT_NEAR(sliding_acceleration(integrator(), 30 * degree, contact), 6.435609211,
                0.001 * 6.4356);
    EXPECT_NEAR(sliding_acceleration(integrator(), 45 * degree, contact), 4.023296164,
                0.001 * 4.0233);
}

/// Friction of a surface that slips at a speed, by Hess and Soom.
double falling_friction(const ContactCase& contact, double speed) {
    const double part = 1 / (1 + std::pow(speed / contact.stribeck_speed, 2));
    return contact.dynamic_friction.axial +
           part * (contact.static_friction.axial - contact.dynamic_friction.axial);
}

TEST(FallingFriction, PipeGathersSpeedAsFrictionFallsWithIt) {
    ContactCase contact;
    contact.static_friction = {0.9, 0.9};
    contact.dynamic_friction = {0.2, 0.2};
    contact.stribeck_speed = 0.5;
    const double inclination = 45 * degree;
    Case input = short_pipe(IntegratorKind::leapfrog, inclination);
    input.contact = contact;
    lay_down(input, inclination);
    input.run.duration = 2;
    input.output.profile_interval = 0.1;
    const test::Run result = run(input);
    // dv/dt = g (cos - mu(v) sin), from a speed that it has on its way by Runge and Kutta's
    // midpoint
    const auto speed_at = [&](std::size_t i) {
        return result.profiles.at(i).momentum.front()[3] / pipe_mass;
    };
    const auto gain = [&](double v) {
        return 9.81 * std::sqrt(0.5) * (1 - falling_friction(contact, v));
    };
    double speed = speed_at(1);
    constexpr double dt = 1e-4;
    for (int i = 0; i < 19'000; ++i)
        speed += dt * gain(speed + 0.5 * dt * gain(speed));
    EXPECT_GT(speed, 5);
    EXPECT_NEAR(speed_at(20), speed, 1e-3 * speed);
}

TEST(FallingFriction, IsStaticForAPipeAtRest) {
    const auto way_at = [](double degrees) {
        return way_of_a_pipe_left_to_friction(IntegratorKind::leapfrog, degrees * degree,
                                              {0.6, 0.6}, {0.2, 0.2}, 0.1);
    };
    EXPECT_GT(way_at(59.0362 - 0.15), 1e-3);
    EXPECT_LT(way_at(59.0362 + 0.15), 1e-4);
}

TEST_P(Friction, RecordsSayWhatTheWallTakesOfAPipeThatSlidesDown) {
    const double inclination = 45 * degree;
    Case input = short_pipe(integrator(), inclination);
    lay_down(input, inclination);
    const SeriesRecord end = run(input).last();
    const double rub = 0.42 * pipe_length * pipe_mass * 9.81 * std::sin(inclination);
    EXPECT_NEAR(end.wall_drag, -rub, 0.002 * rub);  // up the well
    // the pipe's middle, as far down as it slid
    const double slid = 0.5 * 9.81 * (std::cos(inclination) - 0.42 * std::sin(inclination));
    EXPECT_NEAR(end.drag_depth, pipe_length / 2 + slid, 0.05);
    EXPECT_EQ(end.whirl.forward + end.whirl.backward, 0);
}

TEST_P(Friction, AxialAndAzimuthalCoefficientsAreTheirOwn) {
    ContactCase contact;
    contact.static_friction = {0.2, 0.9};
    contact.dynamic_friction = {0.1, 0.9};
    const double inclination = 45 * degree;
    EXPECT_NEAR(sliding_acceleration(integrator(), inclination, contact),
                9.81 * 0.9 * std::sqrt(0.5), 0.007);
    contact.static_friction.axial = contact.dynamic_friction.axial = 0;
    EXPECT_NEAR(sliding_acceleration(integrator(), inclination, contact), 9.81 * std::sqrt(0.5),
                0.007);
}

// F4: a block of 1 m/s stops after v / (mu g) = 0.2427067 s and v^2 / (2 mu g) = 0.1213533 m.
TEST_P(Friction, PipePushedToOneMetrePerSecondStopsAfterTwelveCentimetres) {
    const double inclination = 90 * degree;
    Case input = short_pipe(integrator(), inclination);
    lay_down(input, inclination);
    const double friction = 0.42 * pipe_mass * input.gravity;
    const Vector3d push = (pipe_mass * 1.0 / 0.1 + friction) * down_the_well(inclination);
    load(
        input, 0.11, 0.01,
        [push](double t) { return t < 0.105 ? push : Vector3d(Vector3d::Zero()); }, none);
    input.run.duration = 0.5;
    input.output.profile_interval = 0.001;
    const test::Run result = run(input);
    const auto speed = [&](std::size_t i) {
        return result.profiles.at(i).momentum.front()[3] / pipe_mass;
    };
    constexpr std::size_t begin = 115;  // the push has ended
    const double v = speed(begin);
    EXPECT_NEAR(v, 1, 0.1);
    std::size_t end = begin;
    while (end < result.profiles.size() && speed(end) > 0)
        ++end;
    ASSERT_LT(end, result.profiles.size());
    const double time = result.profiles[end].time - result.profiles[begin].time;
    const double distance = way(result, result.profiles[end], inclination) -
                            way(result, result.profiles[begin], inclination);
    EXPECT_NEAR(time / v, 0.24270666472501337, 0.0012);
    EXPECT_NEAR(distance / (v * v), 0.12135333236250669, 0.0006);
    // and it stays where it is, but for the stretch of the spring
    EXPECT_NEAR(way(result, result.end(), inclination),
                way(result, result.profiles[end], inclination), 5e-4);
}

// F3: torque of a pipe that lies in a horizontal well and is turned, w R sin(atan mu) (N m/m).
constexpr double climb = 22.782405730481685 * degree;
const double slipping_torque = pipe_mass * 9.81 * pipe_radius * std::sin(climb);

/// A pipe in a horizontal well under a torque (N m/m) that comes within 4 s and stays for 3.
Run turned_pipe(IntegratorKind integrator, double torque) {
    const double inclination = 90 * degree;
    Case input = short_pipe(integrator, inclination);
    input.contact.static_friction = input.contact.dynamic_friction = {0.42, 0.42};
    input.contact.normal_stiffness = 1e6;
    lay_down(input, inclination);
    load(input, 4, 0.05, none, [torque](double t) {
        return Vector3d(torque * smooth_step(t, 0, 4) * Vector3d::UnitX());
    });
    input.run.duration = 7;
    input.output.profile_interval = 0.01;
    return run(input);
}

/// Angle of the pipe around the well's axis, from the low side.
double climbed(const Profile& profile) {
    const Vector3d& x = profile.position.front();
    return std::atan2(std::abs(x.y()), x.z());
}

TEST_P(Friction, PipeUnderLessTorqueRollsUpTheWallAndRests) {
    const test::Run result = turned_pipe(integrator(), 0.98 * slipping_torque);
    // balance of couples about the point of contact
    EXPECT_NEAR(climbed(result.end()), std::asin(0.98 * std::sin(climb)), 0.2 * degree);
    EXPECT_NEAR(spin(result.end()), 0, 0.1);
}

TEST_P(Friction, RotatingPipeClimbsToTheAngleOfFrictionAndTheWallTakesItsTorque) {
    const double torque = 1.05 * slipping_torque;
    const test::Run result = turned_pipe(integrator(), torque);
    double angle = 0;
    double normal = 0;
    double samples = 0;
    for (std::size_t i = 500; i < result.profiles.size(); ++i) {
        angle += climbed(result.profiles[i]);
        normal += result.profiles[i].normal_force.front();
        ++samples;
    }
    // slow swings about the mean stay: nothing damps them while the pipe slides
    EXPECT_NEAR(angle / samples, climb, 0.01 * climb);
    EXPECT_NEAR(normal / samples, pipe_mass * 9.81 * std::cos(climb), 0.01 * normal / samples);
    // what does not spin the pipe up is taken by the wall
    const double acceleration = (spin(result.end()) - spin(result.profiles.at(500))) / 2;
    EXPECT_GT(acceleration, 1);
    EXPECT_NEAR(torque - spin_inertia * acceleration, slipping_torque, 0.005 * slipping_torque);
}

TEST_P(Friction, PipeThatRollsAroundTheWellWhirlsAgainstItsSpin) {
    const ContactCase contact;
    const Rolling rolling = rolled_around(run(pipe_carried_around(integrator(), contact)));
    EXPECT_NEAR(rolling.whirled, 2 * std::numbers::pi, 0.02);
    EXPECT_NEAR(rolling.whirled / rolling.spun, pure_rolling(contact), 0.005 * 1.75);  // -1.75
}

TEST_P(Friction, RecordsSayThatAPipeCarriedAroundRollsInBackwardWhirl) {
    Case input = pipe_carried_around(integrator(), ContactCase());
    input.output.interval = 0.1;
    const test::Run result = run(input);
    double rate = 0;
    double rolling = 0;
    for (std::size_t i = 31; i < result.series.size(); ++i) {  // a turn
        const SeriesRecord& record = result.series[i];
        EXPECT_NEAR(record.whirl.backward, 1, 1e-12);
        EXPECT_EQ(record.whirl.forward, 0);
        rate += 0.1 * record.whirl.rate;
        rolling += 0.1 * record.whirl.rolling_rate;
        const double turn = record.head_rotation_rate;  // one pipe, one rate
        EXPECT_NEAR(record.energy.rotation, 0.5 * pipe_length * spin_inertia * turn * turn,
                    1e-6 * record.energy.kinetic);
        EXPECT_LT(record.energy.rotation, record.energy.kinetic);
    }
    EXPECT_NEAR(rate, -2 * std::numbers::pi, 0.02);
    for (const double at_node : result.end().whirl_rate)
        EXPECT_NEAR(at_node, result.last().whirl.rate, 1e-9);
    EXPECT_NEAR(rolling, rate, 0.005 * 2 * std::numbers::pi);
}

// --- F1: the pull of a string around a bend falls by exp(mu times the angle)

/// Straight 2 m, a bend of 90 degrees on 20 m, straight 3 m; a limp string clamped at the head.
double capstan_ratio(IntegratorKind integrator, double friction) {
    constexpr double bend = 20 * std::numbers::pi / 2;
    Case input;
    input.gravity = 0;
    WellCase well;
    well.survey = {{0, 0, 0}, {2, 0, 0}, {2 + bend, 90 * degree, 0}, {5 + bend, 90 * degree, 0}};
    well.sections = {{5 + bend, 0.142}};
    input.well = well;
    Component string;
    string.length = 36;
    string.outer_diameter = 0.14;
    string.linear_density = 1;
    string.bending_stiffness = 10;
    string.torsional_stiffness = 1e4;
    string.axial_stiffness = 1e6;
    string.shear_stiffness = 1e6;
    string.inertia = 0.01;
    input.string.components = {string};
    input.mesh.segments = 72;
    input.mesh.segment_inertia = true;
    input.contact.normal_stiffness = 1e6;
    input.contact.normal_damping = 1e3;
    input.contact.static_friction = input.contact.dynamic_friction = {friction, friction};
    input.bit.direction = BitDirection::well;
    input.bit.weight = ScalarSchedule({0, 1.5}, {0, -2e3});  // a pull
    input.run.duration = 1.5;
    input.run.integrator = integrator;
    input.run.threads = 1;
    input.output.interval = 0.01;
    const test::Run result = run(input);
    // the mean of the last half second, over the waves that run along the string
    double bottom = 0;
    double top = 0;
    for (std::size_t i = 100; i < result.series.size(); ++i) {
        bottom += result.series[i].bit_stress[3];
        top += result.series[i].head_stress[3];
    }
    return bottom / top;
}

TEST_P(Friction, PullAroundABendFollowsTheCapstan) {
    EXPECT_NEAR(capstan_ratio(integrator(), 0), 1, 0.002);
    EXPECT_NEAR(capstan_ratio(integrator(), 0.2), 1.369107770624847, 0.01 * 1.369);
    EXPECT_NEAR(capstan_ratio(integrator(), 0.6), 2.566332395208135, 0.02 * 2.566);
}

}  // namespace
}  // namespace drillstrand::test
