/// The shapes in which strings start.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "drillstrand/scene.hpp"
#include "model/pose.hpp"
#include "model/segment_strain.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

std::vector<Pose> initial_poses(const Scene& scene) {
    return poses_from_strains({scene.head_frame, scene.head_position}, scene.mesh.length,
                              scene.initial_strain);
}

/// The beam-columns between the initial nodes.
std::vector<BeamColumn> initial_beams(const Scene& scene) {
    const InitialNodes& nodes = scene.initial_nodes;
    std::vector<BeamColumn> beams;
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k) {
        const double h = scene.mesh.length[k];
        const Triple first = triple(nodes.director[k]);
        const Triple last = triple(nodes.director[k + 1]);
        const SegmentBend bend(first, last);
        const SegmentChord chord(triple(nodes.position[k]), triple(nodes.position[k + 1]), 1 / h,
                                 first, last, bend.inverse_both());
        const double sine2 = dot(bend.turn, bend.turn);
        beams.emplace_back(SegmentStiffness(scene.mesh.segment[k], h), chord,
                           bend.factor() * bend.factor() * sine2);
    }
    return beams;
}

class InitialShapeInWell : public testing::TestWithParam<std::string> {};

TEST_P(InitialShapeInWell, LiesOnTheAxisWithoutStretchOrTwist) {
    const Case input =
        read_case(std::filesystem::path(DRILLSTRAND_SOURCE_DIR) / "cases" / (GetParam() + ".toml"));
    const Scene scene = build_scene(input);
    const Well& well = *scene.well;
    std::size_t arc = well.arc_at(well.measured_depth_start());
    const std::vector<Pose> poses = initial_poses(scene);
    for (std::size_t k = 0; k < poses.size(); ++k) {
        arc = well.find_arc(poses[k].position, arc);
        const WellCrossSection section = well.project(poses[k].position, arc);
        // kilometres of chained rotations keep micrometres
        EXPECT_LT((section.axis - poses[k].position).norm(), 1e-6) << "node " << k;
        EXPECT_NEAR(section.measured_depth - well.measured_depth_start(), scene.mesh.node_s[k],
                    0.05);
    }
    for (const Vector6& strain : scene.initial_strain) {
        EXPECT_EQ(strain[3], 1.0);
        EXPECT_EQ(strain[0], 0.0);
        EXPECT_LT(strain.tail<2>().norm(), 1e-3);
    }
}

TEST_P(InitialShapeInWell, NodesLieAtTheirMeasuredDepthsWithoutStretch) {
    Case input =
        read_case(std::filesystem::path(DRILLSTRAND_SOURCE_DIR) / "cases" / (GetParam() + ".toml"));
    input.mesh.segments = 200;
    const Scene scene = build_scene(input);
    for (std::size_t k = 0; k < scene.mesh.node_s.size(); ++k) {
        const double depth = scene.well->measured_depth_start() + scene.mesh.node_s[k];
        const WellCrossSection section = scene.well->at(depth);
        EXPECT_LT((scene.initial_nodes.position[k] - section.axis).norm(), 0.001) << "node " << k;
        EXPECT_LT((scene.initial_nodes.director[k] - section.direction).norm(), 0.01);
    }
    for (const BeamColumn& beam : initial_beams(scene)) {
        EXPECT_LT(std::abs(beam.strain), 1e-12);
        EXPECT_LT(beam.angle2, 1e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, InitialShapeInWell, testing::Values("well1", "well2", "well3"),
                         [](const auto& instance) { return instance.param; });

constexpr const char* hoop = R"(
[[string.component]]
length = 2
outer_diameter = 0.02
density = 7850
youngs_modulus = "200 GPa"
curvature = [0, 3.14159265358979, 0]
[mesh]
segments = 16
[head]
direction = [1, 0, 0]
[run]
duration = 1
)";

TEST(InitialShape, IsStraightWithoutAWell) {
    const Scene scene = build_scene(test::case_from(hoop));
    EXPECT_NEAR((initial_poses(scene).back().position - Eigen::Vector3d(2, 0, 0)).norm(), 0, 1e-14);
}

TEST(InitialShape, IsTheStringsOwnOnRequest) {
    const Scene scene =
        build_scene(test::case_from(std::string(hoop) + "[initial]\nstate = \"stress-free\"\n"));
    EXPECT_NEAR((initial_poses(scene).back().position).norm(), 0, 1e-12) << "a closed circle";
}

TEST(InitialShape, OfItsOwnLeavesTheBeamColumnsNeitherStretchedNorDeviated) {
    const Scene scene =
        build_scene(test::case_from(std::string(hoop) + "[initial]\nstate = \"stress-free\"\n"));
    for (const BeamColumn& beam : initial_beams(scene)) {
        EXPECT_NEAR(beam.strain, 0, 1e-14);
        EXPECT_NEAR(beam.angle2, 0, 1e-14);
    }
    // the arc of a beam-column is that of a circle to b^4/823 of its length, b = 2 pi/16
    const std::vector<Eigen::Vector3d>& position = scene.initial_nodes.position;
    EXPECT_NEAR((position[8] - position[0]).norm(), 2 / std::numbers::pi, 2e-5);
}

TEST(InitialShape, TakesAUniformBendAndAShift) {
    const Case input = test::case_from(R"(
[[string.component]]
length = 10
outer_diameter = 0.1
density = 7850
youngs_modulus = "200 GPa"
[mesh]
segments = 5
[initial]
curvature = [0, 0.1, 0]
offset = [0, 0, 3]
[run]
duration = 1
)");
    const std::vector<Pose> poses = initial_poses(build_scene(input));
    // one radian over 10 m: the chord of an arc of radius 10 m
    EXPECT_NEAR((poses.back().position - poses.front().position).norm(), 20 * std::sin(0.5), 1e-12);
    EXPECT_NEAR((poses.front().position - Eigen::Vector3d(0, 0, 3)).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace drillstrand
