// Meshes that follow the string: where nodes stand, and what they carry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "drillstrand/drill_string.hpp"

namespace drillstrand {
namespace {

using std::numbers::pi;

Component pipe(double length, double outer, double inner) {
    Component component;
    component.length = length;
    component.outer_diameter = outer;
    component.inner_diameter = inner;
    component.linear_density = 7850 * pi / 4 * (outer * outer - inner * inner);
    component.youngs_modulus = 2.06e11;
    return component;
}

/// 5 in pipe with tool joints of 6 5/8 in every 9.5 m.
Component jointed_pipe(double length) {
    Component component = pipe(length, 0.127, 0.1086);
    component.linear_density = 31.9;
    component.joints = ToolJoints{9.5, 0.168275, 0.0889, 0.45};
    return component;
}

MeshCase following(double element_length) {
    MeshCase mesh;
    mesh.element_length = element_length;
    return mesh;
}

bool has_node_at(const StringMesh& mesh, double s) {
    return std::any_of(mesh.node_s.begin(), mesh.node_s.end(),
                       [&](double node) { return std::abs(node - s) < 1e-9; });
}

std::size_t node_at(const StringMesh& mesh, double s) {
    const auto nearest = std::min_element(
        mesh.node_s.begin(), mesh.node_s.end(),
        [&](double one, double other) { return std::abs(one - s) < std::abs(other - s); });
    return static_cast<std::size_t>(nearest - mesh.node_s.begin());
}

TEST(FollowingMesh, HasNodesAtComponentsJointsContactPointsAndBends) {
    StringCase string;
    string.components = {jointed_pipe(95), pipe(0.31, 0.17, 0.07), pipe(7.3, 0.17, 0.07)};
    string.components[2].contact = ContactPoint{1.1, 0.21, 0.3, {}};
    string.components[2].bend = BentPlace{5.2, 0.03, 0};
    const StringMesh mesh = mesh_string(string, following(5), Lumping::cubic_clamped_head);
    for (const double s : {0.0, 9.5, 19.0, 85.5, 95.0, 95.31, 96.41, 100.51, 102.61})
        EXPECT_TRUE(has_node_at(mesh, s)) << s;
    EXPECT_EQ(mesh.node.size(), mesh.node_s.size());
    EXPECT_EQ(mesh.cell.size(), mesh.node_s.size());
    EXPECT_DOUBLE_EQ(mesh.node_s.back(), 102.61);

    EXPECT_DOUBLE_EQ(mesh.node[node_at(mesh, 19)].outer_radius, 0.168275 / 2);
    EXPECT_DOUBLE_EQ(mesh.node[node_at(mesh, 19)].flow_radius, 0.127 / 2);
    EXPECT_DOUBLE_EQ(mesh.node[node_at(mesh, 4.75)].outer_radius, 0.127 / 2);
    ASSERT_EQ(mesh.contact.size(), 1U);
    EXPECT_EQ(mesh.contact[0].node, node_at(mesh, 96.41));
    EXPECT_DOUBLE_EQ(mesh.node[mesh.contact[0].node].outer_radius, 0.105);
    EXPECT_DOUBLE_EQ(mesh.node[mesh.contact[0].node].flow_radius, 0.085);
    EXPECT_TRUE(mesh.lost.empty());

    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < mesh.length.size(); ++k)
        turn += mesh.length[k] * mesh.segment[k].curvature;
    EXPECT_LT((turn - Eigen::Vector3d(0, 0, 0.03)).norm(), 1e-15);
}

TEST(FollowingMesh, IsEvenWhereTheStringHasNoPlacesOfItsOwn) {
    StringCase string;
    string.components = {pipe(60, 0.127, 0.1086), pipe(40, 0.127, 0.1086)};
    const StringMesh mesh = mesh_string(string, following(7), Lumping::cubic_clamped_head);
    ASSERT_EQ(mesh.length.size(), 15U);
    EXPECT_NEAR(mesh.length.front(), 60.0 / 9, 1e-12);
    EXPECT_NEAR(mesh.length.back(), 40.0 / 6, 1e-12);
}

TEST(FollowingMesh, PutsTheSegmentsAskedForBetweenToolJoints) {
    for (const int pieces : {1, 2, 3, 5}) {
        StringCase string;
        string.components = {jointed_pipe(95)};
        MeshCase mesh_case = following(100);
        mesh_case.segments_per_joint = pieces;
        const StringMesh mesh = mesh_string(string, mesh_case, Lumping::cubic_clamped_head);
        EXPECT_EQ(mesh.length.size(), 10U * static_cast<std::size_t>(pieces));
    }
}

/// Pipe, collars, subs, stabilisers.
StringCase random_string(std::mt19937& random) {
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    StringCase string;
    const int parts = std::uniform_int_distribution(1, 12)(random);
    for (int i = 0; i < parts; ++i) {
        if (between(0, 1) < 0.3) {
            string.components.push_back(jointed_pipe(between(5, 300)));
            continue;
        }
        string.components.push_back(pipe(std::pow(10, between(-0.7, 2)), between(0.12, 0.2), 0.07));
        Component& part = string.components.back();
        if (between(0, 1) < 0.4)
            part.contact = ContactPoint{between(0, part.length), 0.21, 0.2, {}};
        if (between(0, 1) < 0.3) part.element_length = between(0.2, 3);
    }
    return string;
}

TEST(FollowingMesh, HasNoSegmentLongerThanAllowedNorMuchUnlikeItsNeighbour) {
    std::mt19937 random(3);
    for (int n = 0; n < 200; ++n) {
        const StringCase string = random_string(random);
        const double largest = std::uniform_real_distribution(0.5, 12.0)(random);
        MeshCase mesh_case = following(largest);
        mesh_case.refine = {{0, 20, n % 2 == 0, 0.5}};
        const StringMesh mesh = mesh_string(string, mesh_case, Lumping::cubic_free_head);
        double start = 0;
        for (const Component& part : string.components) {
            EXPECT_TRUE(has_node_at(mesh, start)) << start;
            start += part.length;
        }
        for (std::size_t k = 0; k < mesh.length.size(); ++k) {
            EXPECT_GT(mesh.length[k], 0);
            EXPECT_LE(mesh.length[k], largest * (1 + 1e-9));
            const double from_end =
                mesh_case.refine[0].from_the_bit ? start - mesh.node_s[k] : mesh.node_s[k + 1];
            if (from_end < 20) {
                EXPECT_LE(mesh.length[k], 0.5 * (1 + 1e-9));
            }
            if (k == 0) continue;
            const double ratio = mesh.length[k] / mesh.length[k - 1];
            EXPECT_LT(std::max(ratio, 1 / ratio), 3) << "at " << mesh.node_s[k];
            EXPECT_GT(mesh.cell[k], 0);
        }
    }
}

TEST(FollowingMesh, KeepsMassCentreOfMassAndDisplacedVolume) {
    std::mt19937 random(4);
    for (int n = 0; n < 100; ++n) {
        const StringCase string = random_string(random);
        const StringMesh mesh = mesh_string(string, following(4), Lumping::cubic_free_head);
        double mass = 0;
        double moment = 0;
        double volume = 0;
        double start = 0;
        for (const Component& part : string.components) {
            mass += part.linear_density * part.length;
            moment += part.linear_density * part.length * (start + part.length / 2);
            volume += part.linear_density * part.length / 7850;
            start += part.length;
        }
        const auto sum = [&](auto of) {
            double all = 0;
            for (std::size_t k = 0; k < mesh.node.size(); ++k)
                all += mesh.cell[k] * of(k);
            return all;
        };
        EXPECT_NEAR(sum([&](std::size_t k) { return mesh.node[k].mass; }) / mass, 1, 1e-12);
        EXPECT_NEAR(sum([&](std::size_t k) { return mesh.node[k].metal_area; }) / volume, 1, 1e-12);
        // beside tool joints the limit of couples takes some
        EXPECT_NEAR(sum([&](std::size_t k) { return mesh.node[k].mass * mesh.node_s[k]; }) / moment,
                    1, 1e-4);
    }
}

TEST(FollowingMesh, LumpsALoadAtFourthOrderWhereSegmentsGrowAndShrink) {
    // work of an even load on sin(2 pi s/L) + s/L over lengths that differ fivefold
    const double length = 40;
    StringCase string;
    string.components = {pipe(length, 0.127, 0.1086)};
    const double exact = length / 2;
    const auto error = [&](double h) {
        MeshCase mesh_case = following(h);
        mesh_case.refine = {{10, 13, false, h / 5}};
        const StringMesh mesh = mesh_string(string, mesh_case, Lumping::cubic_free_head);
        double work = 0;
        for (std::size_t k = 0; k < mesh.cell.size(); ++k) {
            const double x = mesh.node_s[k] / length;
            work += mesh.cell[k] * (std::sin(2 * pi * x) + x);
        }
        return std::abs(work - exact);
    };
    EXPECT_LT(error(1), error(2) / 8);
    EXPECT_LT(error(0.5), error(1) / 8);
}

TEST(FollowingMesh, RefusesMoreSegmentsThanMemoryHolds) {
    StringCase string;
    string.components = {pipe(1e5, 0.127, 0.1086)};
    EXPECT_THROW(mesh_string(string, following(1e-3), Lumping::cells), std::invalid_argument);
}

TEST(ToolJoints, WeighTheirSteelAndLeaveThePipeBetweenTheRest) {
    StringCase string;
    string.components = {jointed_pipe(95)};
    MeshCase mesh_case = following(0.1);
    const StringMesh mesh = mesh_string(string, mesh_case, Lumping::cells);
    const double joint = 7850 * pi / 4 * (0.168275 * 0.168275 - 0.0889 * 0.0889);
    EXPECT_NEAR(mesh.node[node_at(mesh, 47.5)].mass, joint, 1e-9 * joint);
    const double between = (31.9 * 9.5 - joint * 0.45) / (9.5 - 0.45);
    EXPECT_NEAR(mesh.node[node_at(mesh, 52.25)].mass, between, 1e-9 * between);
}

TEST(ToolJoints, HeavierThanTheirPipeAreRefused) {
    StringCase string;
    string.components = {jointed_pipe(95)};
    string.components[0].linear_density = 15;
    EXPECT_THROW(mesh_string(string, following(5), Lumping::cells), std::invalid_argument);
}

TEST(EvenMesh, TouchesWithToolJointsWhereverThePipeHasAnyAndSaysWhichContactPointsItLost) {
    StringCase string;
    string.components = {jointed_pipe(95), pipe(5, 0.17, 0.07)};
    string.components[1].contact = ContactPoint{1.1, 0.21, 0.3, {}};
    MeshCase mesh_case;
    mesh_case.segments = 10;
    const StringMesh mesh = mesh_string(string, mesh_case, Lumping::cubic_clamped_head);
    EXPECT_DOUBLE_EQ(mesh.node[4].outer_radius, 0.168275 / 2);
    EXPECT_DOUBLE_EQ(mesh.node[4].flow_radius, 0.127 / 2);
    EXPECT_TRUE(mesh.contact.empty());
    ASSERT_EQ(mesh.lost.size(), 1U);
    EXPECT_DOUBLE_EQ(mesh.lost[0], 96.1);
}

}  // namespace
}  // namespace drillstrand
