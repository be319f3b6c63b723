/// The soft string against closed solutions of its equations.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "statics/soft_string.hpp"

namespace drillstrand {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double weight = 272.43968589;  // N/m
constexpr double radius = 0.07;          // m

constexpr SteadyMotion tripping_in{1, 0};
constexpr SteadyMotion tripping_out{-1, 0};
constexpr SteadyMotion rotating{0, 1};

Well well_through(const std::vector<SurveyStation>& survey) {
    return Well({survey, {{survey.back().measured_depth, 0.22}}});
}

/// One kind of pipe from the start of the well to a depth.
SoftString pipe_to(double depth, double friction, const SteadyMotion& motion, SoftLoad at_bit = {},
                   double pipe_weight = weight) {
    SoftString string;
    string.stretches = {{0, depth, pipe_weight, radius}};
    string.friction = {{friction, friction}};
    string.motion = motion;
    string.at_bit = at_bit;
    return string;
}

SoftLoad head_load(const SoftString& string, const Well& well, double step = 1.0) {
    return solve_soft_string(string, well, {}, step).at_head;
}

/// Relative, where an exact solution is known: far above rounding, far below any use.
constexpr double exact = 1e-9;

void expect_equal(double value, double expected, double tolerance = exact) {
    EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

TEST(SoftString, InStraightInclinedWellHasTheLoadsOfABodyOnASlope) {
    const double inclination = 50 * degree;
    const double length = 1000;
    const double mu = 0.3;
    const Well well = well_through({{0, inclination, 1}, {length, inclination, 1}});
    const double along = weight * length * std::cos(inclination);
    const double rub = mu * weight * length * std::sin(inclination);

    expect_equal(head_load(pipe_to(length, mu, tripping_in), well).tension, along - rub);
    expect_equal(head_load(pipe_to(length, mu, tripping_out), well).tension, along + rub);
    const SoftLoad turning = head_load(pipe_to(length, mu, rotating, {-20e3, 4e3}), well);
    expect_equal(turning.tension, along - 20e3);
    expect_equal(turning.torque, 4e3 + rub * radius);
    // friction opposes the velocity of the surface, here 3 down the well to 4 around it
    const SoftLoad reaming = head_load(pipe_to(length, mu, {3, 4 / radius}), well);
    expect_equal(reaming.tension, along - 0.6 * rub);
    expect_equal(reaming.torque, 0.8 * rub * radius);
}

TEST(SoftString, WithoutWeightFollowsTheCapstan) {
    const Well well = well_through({{0, 0, 0}, {500, 90 * degree, 0}});
    const double mu = 0.2;
    const double ratio = std::exp(mu * 90 * degree);
    const SoftLoad pull{10e3, 0};
    expect_equal(head_load(pipe_to(500, mu, tripping_out, pull, 0), well).tension, 10e3 * ratio);
    expect_equal(head_load(pipe_to(500, mu, tripping_in, pull, 0), well).tension, 10e3 / ratio);
    // compression presses the string to the other side with the same force
    const SoftLoad push{-10e3, 0};
    expect_equal(head_load(pipe_to(500, mu, tripping_in, push, 0), well).tension, -10e3 * ratio);
    expect_equal(head_load(pipe_to(500, mu, rotating, pull, 0), well).torque,
                 mu * 10e3 * 90 * degree * radius);
}

/// Tension at the top of a bend from vertical to an inclination, on a radius, with a string that
/// moves up and lies on the upper side all along: dF/da = -(w/c) (cos a - mu sin a) - mu F.
double top_of_bend(double mu, double bend_radius, double inclination, double tension_below) {
    const double scale = weight * bend_radius / (1 + mu * mu);
    const auto particular = [&](double a) {
        return scale * (-2 * mu * std::cos(a) + (mu * mu - 1) * std::sin(a));
    };
    return particular(0) + (tension_below - particular(inclination)) * std::exp(mu * inclination);
}

constexpr double bend_radius = 300;
constexpr double bend_angle = 60 * degree;
constexpr double kick_off = 500;
constexpr double bend_end = kick_off + bend_radius * bend_angle;
constexpr double total_depth = bend_end + 1000;

Well build_and_hold() {
    return well_through(
        {{0, 0, 0}, {kick_off, 0, 0}, {bend_end, bend_angle, 0}, {total_depth, bend_angle, 0}});
}

TEST(SoftString, InBendHasTheClosedSolutionForEveryFriction) {
    for (const double mu : {0.1, 0.2, 0.35, 0.5}) {
        const double slope = weight * 1000 * (std::cos(bend_angle) + mu * std::sin(bend_angle));
        const double expected = weight * kick_off + top_of_bend(mu, bend_radius, bend_angle, slope);
        expect_equal(head_load(pipe_to(total_depth, mu, tripping_out), build_and_hold()).tension,
                     expected);
    }
}

TEST(SoftString, ConvergesAtFourthOrder) {
    const Well bend = well_through({{0, 0, 0}, {bend_radius * bend_angle, bend_angle, 0}});
    const double length = bend_radius * bend_angle;
    const SoftString string = pipe_to(length, 0.4, tripping_out, {200e3, 0});
    const double limit = top_of_bend(0.4, bend_radius, bend_angle, 200e3);
    const auto error = [&](double steps) {
        return head_load(string, bend, length / steps * (1 + 1e-12)).tension - limit;
    };
    // the ratio tends to 2^4
    EXPECT_NEAR(error(8) / error(16), 16, 1);
    EXPECT_NEAR(error(16) / error(32), 16, 0.5);
}

TEST(SoftString, InHorizontalTurnAddsWeightAndTensionAtRightAngles) {
    // dF/ds = mu sqrt((F c)^2 + w^2)
    const double turn = 80 * degree;
    const double length = 400;
    const double curvature = turn / length;
    const double mu = 0.25;
    const Well well = well_through({{0, 90 * degree, 0}, {length, 90 * degree, turn}});
    const auto head = [&](double bit) {
        return weight / curvature *
               std::sinh(std::asinh(bit * curvature / weight) + mu * curvature * length);
    };
    expect_equal(head_load(pipe_to(length, mu, tripping_out, {30e3, 0}), well).tension, head(30e3));
}

TEST(SoftString, InBuildAndHoldWellHasTheReferenceLoads) {
    // Independent integration of the same equations to rounding; rotating hook loads are also the
    // buoyed weight over the vertical depth of 1259.807621 m, less the weight on bit.
    const auto load = [&](const SteadyMotion& motion, double weight_on_bit) {
        return head_load(pipe_to(total_depth, 0.2, motion, {-weight_on_bit, 0}), build_and_hold());
    };
    // the side force of these passes through zero inside a step
    constexpr double with_kink = 1e-7;
    expect_equal(load(rotating, 0).tension, 343221.59258238744);
    expect_equal(load(rotating, 0).torque, 5193.713119369936, with_kink);
    expect_equal(load(tripping_out, 0).tension, 430863.3862284939, with_kink);
    expect_equal(load(tripping_in, 0).tension, 280106.8223898794, with_kink);
    expect_equal(load(rotating, 50e3).tension, 293221.5925823875);
    expect_equal(load(rotating, 50e3).torque, 4460.674833532319, with_kink);
    expect_equal(load(tripping_out, 50e3).tension, 369214.04673953465, with_kink);
    expect_equal(load(tripping_in, 50e3).tension, 237740.1408872847, with_kink);
}

TEST(SoftString, CountsEachStretchWithItsOwnWeightAndRadius) {
    const double inclination = 40 * degree;
    const double mu = 0.3;
    const Well well = well_through({{0, inclination, 2}, {1000, inclination, 2}});
    SoftString string = pipe_to(1000, mu, rotating);
    string.stretches = {{0, 700.3, 250, 0.06}, {700.3, 1000, 1400, 0.09}};
    const SoftProfile profile = solve_soft_string(string, well, {200, 900});
    expect_equal(profile.at_head.torque,
                 mu * std::sin(inclination) * (700.3 * 250 * 0.06 + 299.7 * 1400 * 0.09));
    expect_equal(profile.load[0].tension, std::cos(inclination) * (500.3 * 250 + 299.7 * 1400));
    expect_equal(profile.load[1].tension, std::cos(inclination) * 100 * 1400);
    expect_equal(profile.side_force[0], 250 * std::sin(inclination));
    expect_equal(profile.side_force[1], 1400 * std::sin(inclination));
}

}  // namespace
}  // namespace drillstrand
