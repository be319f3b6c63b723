/// Strings pressed until they buckle in a straight hole, against the classical loads, pitch and
/// wall force; and the wall under the bit.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "drillstrand/scene.hpp"
#include "support/both_integrators.hpp"
#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

// E I of the pipe, 200 GPa and 0.14 m by 0.12 m
const double bending_stiffness = 200e9 * pi / 64 * (std::pow(0.14, 4) - std::pow(0.12, 4));
constexpr double weight = pipe_mass * 9.81;  // N/m

using BitOnTheWall = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, BitOnTheWall, both_integrators, integrator_name);

/// The load that presses the end of a pipe by `press` (m) into the wall.
double end_load(const Case& input, double press, double contact_length) {
    const double half_cell = pipe_length / input.mesh.segments / 2;
    return press * input.contact.normal_stiffness * (half_cell + contact_length);
}

TEST_P(BitOnTheWall, SinksInByItsLoadOverTheStiffnessOfTheWallItTouches) {
    // Each end takes the load of its own wall, so that the pipe sinks in evenly.
    constexpr double press = 1e-3;
    Case input = short_pipe(integrator(), 0);
    input.gravity = 0;
    input.contact.normal_stiffness = 1e6;
    input.contact.normal_damping = 1e4;
    input.bit.contact_length = 2.5;
    input.initial.offset = clearance * Vector3d::UnitX();
    input.head.force = VectorSchedule(Vector3d(end_load(input, press, 0) * Vector3d::UnitX()));
    input.bit.force = VectorSchedule(
        Vector3d(end_load(input, press, input.bit.contact_length) * Vector3d::UnitX()));
    input.run.duration = 0.3;
    const test::Run result = run(input);
    // the spring settles within eta / k = 10 ms
    EXPECT_NEAR(result.end().eccentricity.front() - clearance, press, 1e-3 * press);
    EXPECT_NEAR(result.end().eccentricity.back() - clearance, press, 1e-3 * press);
    // the wall's force per length of the node's cell carries the whole load
    EXPECT_NEAR(result.end().normal_force.back() * pipe_length / 2,
                end_load(input, press, input.bit.contact_length), 1);
}

/// A string of `length` (m) with a node every half metre and no friction in a straight hole. Its
/// weight on bit rises within 4 s and stays; damping brings it to rest.
Case pressed_string(double length, double inclination, double force) {
    Case input = short_pipe(IntegratorKind::leapfrog, inclination);
    input.string.components.front().length = length;
    input.mesh.segments = static_cast<int>(std::lround(2 * length));
    input.head.motion = HeadMotion::driven;
    input.bit.weight = ScalarSchedule({0, 4}, {0, force});
    input.bit.direction = BitDirection::well;
    input.contact.static_friction = input.contact.dynamic_friction = {0, 0};
    input.damping.external = {20, 20};
    return input;
}

/// The same, a little aside on the low side of a level hole. Waves 3 % above the critical load grow
/// slowly, from what rounding and the ends give them.
Case lying_string(double length, double force) {
    constexpr double aside = 1e-4;
    Case input = pressed_string(length, pi / 2, force);
    lay_down(input, pi / 2);
    input.initial.offset += aside * Vector3d::UnitY();
    input.run.duration = 28;
    return input;
}

/// Azimuth of a node from the low side of a level hole.
double azimuth(const Vector3d& position) {
    return std::atan2(position.y(), position.z());
}

double largest_azimuth(const Profile& profile) {
    double largest = 0;
    for (const Vector3d& x : profile.position)
        largest = std::max(largest, std::abs(azimuth(x)));
    return largest;
}

int half_waves(const Profile& profile) {
    int changes = 0;
    const std::vector<Vector3d>& x = profile.position;
    // the ends themselves lie where they were put
    for (std::size_t k = 3; k + 2 < x.size(); ++k)
        changes += azimuth(x[k - 1]) * azimuth(x[k]) < 0 ? 1 : 0;
    return changes + 1;
}

/// A lying string whose ends cannot leave the low side but may turn there: ends so heavy that no
/// load moves them, on a wall as much stiffer. The head is pushed as the bit is.
test::Run pinned_string(double length, double force) {
    Case input = lying_string(length, force);
    input.head.motion = HeadMotion::free;
    input.head.force =
        VectorSchedule({0, 4}, {Vector3d::Zero(), Vector3d(force * Vector3d::UnitX())});
    Scene scene = build_scene(input);
    for (const std::size_t end : {std::size_t{0}, scene.weight.size() - 1}) {
        scene.weight[end] *= 1e4;
        scene.normal_stiffness[end] *= 1e4;
    }
    return run(scene, input.run, input.output);
}

/// Dawson and Paslay's load of a string with pinned ends: the least over the number n of half waves
/// of EI q^2 + (w / r) / q^2, q = n pi / L.
struct SinusoidalBuckling {
    double force = std::numeric_limits<double>::infinity();
    int half_waves = 0;

    explicit SinusoidalBuckling(double length) {
        for (int n = 1; n < 50; ++n) {
            const double q2 = std::pow(n * pi / length, 2);
            const double load = bending_stiffness * q2 + weight / clearance / q2;
            if (load < force) *this = SinusoidalBuckling(load, n);
        }
    }

  private:
    SinusoidalBuckling(double load, int n) : force(load), half_waves(n) {}
};

TEST(LyingString, StaysStraightBelowDawsonAndPaslaysLoad) {
    const test::Run result = pinned_string(50, 0.97 * SinusoidalBuckling(50).force);
    EXPECT_LT(largest_azimuth(result.end()), 1 * pi / 180);
}

TEST(LyingString, SnakesAboveDawsonAndPaslaysLoadInTheirWaves) {
    const SinusoidalBuckling critical(50);
    const test::Run result = pinned_string(50, 1.03 * critical.force);
    EXPECT_GT(largest_azimuth(result.end()), 5 * pi / 180);
    EXPECT_EQ(half_waves(result.end()), critical.half_waves);
}

/// A free end of a string that is clamped L = 30 m away swings at this load: the least root F of
/// the boundary-value problem EI y'''' + F y'' + (w/r) y = 0, y = y' = 0 at one end, y'' = 0 and EI
/// y''' + F y' = 0 at the other; 1.0014844 S, S = sqrt(EI w / r), half of the load of a long string
/// with pinned ends (zero of the determinant of its four exponentials, and 400 Hermite elements).
const double free_end_load = 1.0014844 * std::sqrt(bending_stiffness * weight / clearance);

TEST(LyingString, FreeEndSwingsAtHalfTheLoadOfPinnedEnds) {
    const test::Run below = run(lying_string(30, 0.97 * free_end_load));
    EXPECT_LT(largest_azimuth(below.end()), 1 * pi / 180);
    const test::Run above = run(lying_string(30, 1.03 * free_end_load));
    EXPECT_GT(largest_azimuth(above.end()), 5 * pi / 180);
}

TEST(WeightlessString, WindsToAHelixOfLubinskisPitchAndWallForce) {
    constexpr double force = 500e3;
    Case input = pressed_string(100, 0, force);
    input.gravity = 0;
    input.contact.normal_stiffness = 1e8;
    input.bit.contact_length = 0.3;
    input.initial.curvature = {1e-6, 1e-6, 0};
    input.run.duration = 20;
    const test::Run result = run(input);
    ASSERT_LT(result.last().energy.kinetic, 1e-3);

    // between a pitch from either end, where the string winds evenly
    const double pitch = std::sqrt(8 * pi * pi * bending_stiffness / force);
    const double h = 0.5;
    const auto margin = static_cast<std::size_t>(std::lround(1.2 * pitch / h));
    const Profile& end = result.end();
    double turned = 0;
    double pressed = 0;
    std::size_t samples = 0;
    for (std::size_t k = margin; k + margin < end.position.size(); ++k) {
        const Vector3d& a = end.position[k];
        const Vector3d& b = end.position[k + 1];
        turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
        pressed += end.normal_force[k];
        ++samples;
    }
    const double count = static_cast<double>(samples);
    // a mesh of 33 nodes per turn, whose chords and mean curvatures cost up to a percent
    EXPECT_NEAR(2 * pi * count * h / std::abs(turned), pitch, 0.02 * pitch);
    const double wall_force = clearance * force * force / (4 * bending_stiffness);
    EXPECT_NEAR(pressed / count, wall_force, 0.02 * wall_force);
}

/// The paper's vertical string under a weight on bit, on segments of 5 m, at rest.
test::Run vertical_string(const char* weight_on_bit) {
    return run(read_case(
        std::filesystem::path(DRILLSTRAND_SOURCE_DIR) / "cases" / "vertical_resolved.toml",
        {{"mesh.element_length", "5"},
         {"bit.weight", fmt::format("[[5, 0], [45, \"{}\"]]", weight_on_bit)},
         {"run.threads", "1"}}));
}

/// Turns about the axis of the lowest 200 m.
double turns_above_bit(const Profile& profile, double h) {
    double turned = 0;
    const std::vector<Vector3d>& x = profile.position;
    for (std::size_t k = x.size() - static_cast<std::size_t>(std::lround(200 / h)); k < x.size();
         ++k) {
        const Vector3d& a = x[k - 1];
        const Vector3d& b = x[k];
        turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
    }
    return std::abs(turned) / (2 * pi);
}

/// Mean force of the wall (N/m) from 25 to 125 m above the bit.
double wall_force_above_bit(const Profile& profile, double h) {
    const auto bit = static_cast<std::ptrdiff_t>(profile.normal_force.size()) - 1;
    const auto first = profile.normal_force.begin() + bit - std::lround(125 / h) + 1;
    const auto last = profile.normal_force.begin() + bit - std::lround(25 / h);
    return std::accumulate(first, last, 0.0) / static_cast<double>(last - first);
}

TEST(VerticalString, WindsAndLeansOnTheWallOnLongSegmentsAsOnShortOnes) {
    struct Wound {
        const char* load;
        double turns;       // on segments of 0.7 m
        double wall_force;  // likewise (N/m)
    };
    for (const Wound& fine : {Wound{"50 kN", 2.508, 5.12}, Wound{"100 kN", 4.714, 36.8}}) {
        const Profile end = vertical_string(fine.load).end();
        EXPECT_NEAR(turns_above_bit(end, 5), fine.turns, 0.03 * fine.turns) << fine.load;
        EXPECT_NEAR(wall_force_above_bit(end, 5), fine.wall_force, 0.03 * fine.wall_force)
            << fine.load;
    }
}

}  // namespace
}  // namespace drillstrand::test
