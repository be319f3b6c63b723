// Friction and block weight from points that a known friction made.
#include "drillstrand/calibration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/torque_drag.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double block = 90e3;  // N

/// Pipe in a well that builds to 60 degrees in casing and goes on in open hole.
Case cased_and_open() {
    Case input = test::case_from(R"(gravity = 9.81
        [fluid]
        density = 1200
        drag = false
        [[string.component]]
        length = 2500
        outer_diameter = 0.14
        inner_diameter = 0.12
        linear_density = 31.8557
        youngs_modulus = "200 GPa"
        [mesh]
        element_length = 40
        [run]
        duration = 1
        )");
    WellCase well;
    well.survey = {{0, 0, 0}, {500, 0, 0}, {1000, 60 * degree, 0.3}, {2500, 60 * degree, 0.3}};
    well.sections = {{1300, 0.22}, {2500, 0.22}};
    well.sections[0].name = "casing";
    well.sections[1].name = "open hole";
    input.well = well;
    input.bit.direction = BitDirection::well;
    return input;
}

/// What a rig would read with these coefficients, every reading off by a share of itself.
std::vector<MeasuredPoint> points_of(double cased, double open, double noise, int depths) {
    Case input = cased_and_open();
    input.well->sections[0].static_friction =
        input.well->sections[0].dynamic_friction = {cased, cased};
    input.well->sections[1].static_friction =
        input.well->sections[1].dynamic_friction = {open, open};
    for (int i = 1; i <= depths; ++i)
        input.torque_drag.depths.push_back(600 + 1900.0 * i / depths);
    input.torque_drag.motions = {TorqueDragMotion::tripping_out, TorqueDragMotion::tripping_in,
                                 TorqueDragMotion::rotating};
    const TorqueDrag study = compute_torque_drag(input);
    std::mt19937 random(5);
    std::normal_distribution<double> error(0, noise);
    const auto read = [&](double value) { return value * (1 + error(random)); };
    std::vector<MeasuredPoint> points;
    for (std::size_t i = 0; i < study.bit_depth.size(); ++i) {
        const double depth = study.bit_depth[i];
        points.push_back(
            {depth, MeasuredLoad::pick_up, read(study.curves[0].hook_load[i] + block)});
        points.push_back(
            {depth, MeasuredLoad::slack_off, read(study.curves[1].hook_load[i] + block)});
        points.push_back(
            {depth, MeasuredLoad::rotating, read(study.curves[2].hook_load[i] + block)});
        points.push_back({depth, MeasuredLoad::torque, read(study.curves[2].surface_torque[i])});
    }
    return points;
}

TEST(Calibration, FindsTheFrictionThatMadeThePoints) {
    const Calibration found = calibrate(cased_and_open(), points_of(0.18, 0.31, 0, 6));
    ASSERT_EQ(found.friction.size(), 2U);
    EXPECT_EQ(found.friction[0].name, "casing");
    EXPECT_NEAR(found.friction[0].value, 0.18, 1e-4);
    EXPECT_NEAR(found.friction[1].value, 0.31, 1e-4);
    EXPECT_NEAR(found.block_weight.value, block, 20);
    EXPECT_LT(found.rounds, 12);
}

TEST(Calibration, FindsItWithinTwoPerCentAmongNoiseOfTwoPerCent) {
    const Calibration found = calibrate(cased_and_open(), points_of(0.18, 0.31, 0.02, 40));
    EXPECT_NEAR(found.friction[0].value, 0.18, 0.02 * 0.18);
    EXPECT_NEAR(found.friction[1].value, 0.31, 0.02 * 0.31);
    EXPECT_NEAR(found.block_weight.value, block, 0.05 * block);
    // and knows how well
    EXPECT_LT(std::abs(found.friction[0].value - 0.18), 3 * found.friction[0].deviation);
    EXPECT_LT(std::abs(found.friction[1].value - 0.31), 3 * found.friction[1].deviation);
    EXPECT_LT(found.friction[1].deviation, 0.02 * 0.31);
}

TEST(Calibration, SaysWhereThePointsDoNotTell) {
    std::vector<MeasuredPoint> points = points_of(0.2, 0.3, 0, 4);
    std::erase_if(points,
                  [](const MeasuredPoint& point) { return point.load != MeasuredLoad::rotating; });
    EXPECT_THROW(calibrate(cased_and_open(), points), InputError);
    points.resize(2);
    EXPECT_THROW(calibrate(cased_and_open(), points), InputError);
    points.assign(4, {3000, MeasuredLoad::torque, 1e4});
    EXPECT_THROW(calibrate(cased_and_open(), points), InputError);
}

TEST(Calibration, ReadsTablesWithGapsAndUnits) {
    const auto path = std::filesystem::temp_directory_path() / "drillstrand_points.csv";
    std::ofstream(path) << "depth[ft],pick_up[klbf],Torque[kN m]\n1000,100,\n2000,-999.25,5\n";
    const std::vector<MeasuredPoint> points = read_measured_points(path);
    std::filesystem::remove(path);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_NEAR(points[0].bit_depth, 304.8, 1e-9);
    EXPECT_NEAR(points[0].value, 100 * 4448.2216152605, 1e-6);
    EXPECT_EQ(points[1].load, MeasuredLoad::torque);
    EXPECT_NEAR(points[1].value, 5e3, 1e-9);
}

}  // namespace
}  // namespace drillstrand
