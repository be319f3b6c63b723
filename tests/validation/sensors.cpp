// Sensors in the string: what accelerometers, gyroscopes and strain gauges of a tool would show.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>

#include "support/both_integrators.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;

constexpr double gravity = 9.80665;  // m/s2

// A pipe of 10 m that is held at its head. Axial and torsional vibrations calm down within 0.1 s.
std::string held_pipe(const std::string& more, double external = 0) {
    return fmt::format("[damping]\nkelvin_voigt = 1e-4\nexternal_translation = {}\n", external) +
           R"(
        [[string.component]]
        length = 10
        outer_diameter = 0.14
        inner_diameter = 0.11
        linear_density = 34
        youngs_modulus = "200 GPa"
        poisson_ratio = 0.3
        [mesh]
        segments = 10
        )" +
           more;
}

class Sensors : public BothIntegrators {
  protected:
    static test::Run run_of(const std::string& text) {
        Case input = case_from(text);
        input.run.integrator = integrator();
        return run(input);
    }
};
INSTANTIATE_TEST_SUITE_P(By, Sensors, both_integrators, integrator_name);

/// A hanging pipe whose head speeds up to 15 rad/s until 1.5 s, and a sensor with that radius.
std::string spinning_pipe(double radius) {
    return held_pipe(fmt::format(R"(
        [head]
        direction = [0, 0, 1]
        rotation = [[0, 0], [1.5, 15]]
        [run]
        duration = 2
        [output]
        interval = 1
        sensor = [{{name = "axis", depth = 6.3}}, {{name = "arm", depth = "6.3 m", radius = {}, interval = 0.05}}]
        )",
                                 radius));
}

TEST_P(Sensors, OnTheAxisOfAVerticalStringFeelItsWeightAndItsRotation) {
    const test::Run result = run_of(spinning_pipe(0.06));
    ASSERT_EQ(result.sensors.at(0).size(), 201U);
    EXPECT_EQ(result.sensors[0][63].time, 63 * 0.01);
    const SensorRecord& end = result.sensors[0].back();
    EXPECT_NEAR(end.acceleration[0], -gravity, 1e-3);
    EXPECT_NEAR(end.acceleration[1], 0, 1e-6);
    EXPECT_NEAR(end.acceleration[2], 0, 1e-6);
    EXPECT_NEAR(end.rotation_rate, 15, 1e-3);
    EXPECT_NEAR(end.bending_moment.norm(), 0, 1e-3);
    EXPECT_NEAR(end.torque, 0, 1);
    // what hangs below the middle of the segment that holds it, at 6.5 m
    EXPECT_NEAR(end.tension, 34 * gravity * 3.5, 0.02 * 34 * gravity);
}

TEST_P(Sensors, OffTheAxisFeelWhatHoldsThemInTheirCircleAndWhatTurnsThemFaster) {
    constexpr double radius = 0.06;
    const test::Run result = run_of(spinning_pipe(radius));
    const auto& arm = result.sensors.at(1);
    ASSERT_EQ(arm.size(), 41U);
    const SensorRecord& faster = arm[20];  // 1 s: 10 rad/s, and 10 rad/s2
    EXPECT_NEAR(faster.acceleration[1], -radius * 10 * 10, 0.02 * radius * 100);
    EXPECT_NEAR(faster.acceleration[2], radius * 10, 0.02 * radius * 10);
    EXPECT_NEAR(arm.back().acceleration[1], -radius * 15 * 15, 1e-3 * radius * 225);
    EXPECT_NEAR(arm.back().acceleration[2], 0, 1e-3);
    EXPECT_NEAR(arm.back().acceleration[0], -gravity, 1e-3);
}

TEST_P(Sensors, AtRestFeelGravityAlongAndAcrossAStringThatLeans) {
    const test::Run result = run_of(held_pipe(R"(
        [head]
        direction = [0.6427876096865394, 0, 0.766044443118978]
        [run]
        duration = 4
        [output]
        interval = 1
        sensor = [{name = "s", depth = 4, measured_from = "bit", interval = 1}]
        )",
                                              200));
    const SensorRecord& end = result.sensors.at(0).back();
    EXPECT_NEAR(end.acceleration.norm(), gravity, 1e-3);
    // nodes 6 and 7 are on either side; the sensor is at node 6
    const Vector3d& d3 = result.end().director[6];
    EXPECT_NEAR(end.acceleration[0], -gravity * d3.z(), 2e-3);
    EXPECT_NEAR(std::hypot(end.acceleration[1], end.acceleration[2]),
                gravity * std::hypot(d3.x(), d3.y()), 2e-3);
    EXPECT_GT(d3.x(), 0.5);
    EXPECT_NEAR(end.rotation_rate, 0, 1e-6);
}

TEST_P(Sensors, FeelTheSecondDifferenceOfWhereTheyWere) {
    // A pipe that falls from level and swings; its bit's place is recorded, too.
    const test::Run result = run_of(held_pipe(R"(
        [head]
        direction = [1, 0, 0]
        [run]
        duration = 0.3
        [output]
        interval = 0.002
        profile_interval = 0.002
        sensor = [{name = "bit", depth = 0, measured_from = "bit", interval = 0.002}]
        )"));
    const auto& sensor = result.sensors.at(0);
    ASSERT_EQ(sensor.size(), result.series.size());
    double error = 0;
    double size = 0;
    for (std::size_t i = 50; i + 1 < sensor.size(); ++i) {
        const auto place = [&](std::size_t k) -> const Vector3d& {
            return result.series[k].bit_position;
        };
        const Vector3d second = (place(i + 1) - 2 * place(i) + place(i - 1)) / (0.002 * 0.002);
        const Vector3d felt = second - gravity * Vector3d::UnitZ();
        const Vector3d& d3 = result.profiles[i].director.back();
        const double along = felt.dot(d3);
        const Vector3d& shown = sensor[i].acceleration;
        error = std::max({error, std::abs(shown[0] - along),
                          std::abs(std::hypot(shown[1], shown[2]) - (felt - along * d3).norm())});
        size = std::max(size, felt.norm());
    }
    EXPECT_GT(size, 5);
    EXPECT_LT(error, 0.03 * size);
}

TEST_P(Sensors, BearWhatTheProfileSaysOfTheirSegment) {
    const test::Run result = run_of(held_pipe(R"(
        [head]
        direction = [1, 0, 0]
        rotation = 3
        [bit]
        torque = [[0, 0], [0.1, 2000]]
        weight = [[0, 0], [0.1, 30e3]]
        [run]
        duration = 0.3
        [output]
        profile_interval = 0.1
        sensor = [{name = "s", depth = 7.2, interval = 0.1}]
        )"));
    const auto& sensor = result.sensors.at(0);
    ASSERT_EQ(sensor.size(), 4U);
    for (std::size_t i = 0; i < sensor.size(); ++i) {
        const Vector6& stress = result.profiles[i].stress[7];
        EXPECT_NEAR(sensor[i].torque, -stress[0], 1e-9 * 2000);
        EXPECT_NEAR(sensor[i].tension, stress[3], 1e-9 * 30e3);
        EXPECT_NEAR((sensor[i].bending_moment - stress.segment<2>(1)).norm(), 0, 1e-9 * 2000);
    }
    EXPECT_GT(sensor.back().torque, 500);
}

}  // namespace
}  // namespace drillstrand::test
