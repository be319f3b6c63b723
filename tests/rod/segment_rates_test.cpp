/// Rates of the segments of the leapfrog's rod against the exact rates of the whole rod, from its
/// energy by finite differences.
#include "rod/segment_rates.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/pose.hpp"
#include "model/segment_strain.hpp"

namespace drillstrand {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Motion = Eigen::Matrix<double, 6, 1>;  // displacement (m), turn

struct Node {
    Vector3d position;
    Vector3d director;
    Vector3d material;

    [[nodiscard]] Node moved(const Motion& by) const {
        const double angle = by.tail<3>().norm();
        if (angle == 0) return {position + by.head<3>(), director, material};
        const Eigen::AngleAxisd turn(angle, by.tail<3>() / angle);
        return {position + by.head<3>(), turn * director, turn * material};
    }
};

double energy(const SectionProperties& section, double h, const Node& a, const Node& b) {
    const SegmentStiffness stiffness(section, h);
    const SegmentBend bend(triple(a.director), triple(b.director));
    const SegmentChord chord(triple(a.position), triple(b.position), 1 / h, triple(a.director),
                             triple(b.director), bend.inverse_both());
    const double factor = bend.factor();
    const double bend2 = factor * factor * dot(bend.turn, bend.turn);
    const Vector3d across = carried(a.material, a.director, b.director);
    const double twist =
        std::atan2(b.director.dot(across.cross(b.material)), across.dot(b.material)) +
        stiffness.bending_share * twist_of_deviation(chord, bend.turn);
    return h * (BeamColumn(stiffness, chord, bend2).energy(stiffness) +
                0.5 * stiffness.bending * bend2) +
           0.5 * section.torsional_stiffness * twist * twist / h;
}

/// The initial nodes, stretched by a tension (N).
std::vector<Node> nodes_of(const Scene& scene, double tension) {
    const InitialNodes& initial = scene.initial_nodes;
    std::vector<Node> nodes{{initial.position[0], initial.director[0], scene.head_frame.col(1)}};
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k) {
        const double stretch = 1 + tension / scene.mesh.segment[k].axial_stiffness;
        const Vector3d chord = initial.position[k + 1] - initial.position[k];
        nodes.push_back({nodes[k].position + stretch * chord, initial.director[k + 1],
                         carried(nodes[k].material, initial.director[k], initial.director[k + 1])});
    }
    return nodes;
}

/// Stiffness of a segment against motions of its nodes, by central differences.
MatrixXd stiffness_of(const SectionProperties& section, double h, const Node& a, const Node& b) {
    constexpr double turn = 1e-4;  // rad
    // of h: a segment buckles at z = -30
    const double part = std::min(1e-4, 4 / SegmentStiffness(section, h).slenderness);
    const auto unit = [&](Index i) { return i % 6 < 3 ? h * part : turn; };
    const auto at = [&](Index i, double u, Index j, double v) {
        Eigen::Matrix<double, 12, 1> by = Eigen::Matrix<double, 12, 1>::Zero();
        by[i] += u * unit(i);
        by[j] += v * unit(j);
        return energy(section, h, a.moved(by.head<6>()), b.moved(by.tail<6>()));
    };
    MatrixXd result(12, 12);
    for (Index i = 0; i < 12; ++i)
        for (Index j = 0; j < 12; ++j)
            result(i, j) = (at(i, 1, j, 1) - at(i, 1, j, -1) - at(i, -1, j, 1) + at(i, -1, j, -1)) /
                           (4 * unit(i) * unit(j));
    return result;
}

/// Rate of the fastest motion of the whole rod (1/s).
double exact_rate(const Scene& scene, double tension) {
    const std::vector<Node> nodes = nodes_of(scene, tension);
    const auto size = static_cast<Index>(6 * nodes.size());
    MatrixXd stiffness = MatrixXd::Zero(size, size);
    MatrixXd root_mobility = MatrixXd::Zero(size, size);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const auto at = static_cast<Index>(6 * k);
        if (k + 1 < nodes.size())
            stiffness.block<12, 12>(at, at) +=
                stiffness_of(scene.mesh.segment[k], scene.mesh.length[k], nodes[k], nodes[k + 1]);
        if (k == 0 && scene.head.motion == HeadMotion::driven) continue;
        const Eigen::Matrix3d along = nodes[k].director * nodes[k].director.transpose();
        const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
        const double cell = scene.mesh.cell[k];
        root_mobility.block<3, 3>(at, at) = along / std::sqrt(cell * scene.mesh.node[k].mass) +
                                            across / std::sqrt(cell * scene.lateral_mass[k]);
        root_mobility.block<3, 3>(at + 3, at + 3) =
            along / std::sqrt(cell * scene.mesh.node[k].polar_inertia) +
            across / std::sqrt(cell * scene.inertia[k]);
    }
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(root_mobility * stiffness * root_mobility,
                                                         Eigen::EigenvaluesOnly);
    return std::sqrt(solver.eigenvalues().maxCoeff());
}

double rate_bound(const Scene& scene) {
    const std::vector<ExpectedLoad> loads = expected_loads(scene);
    double most = 0;
    for (std::size_t k = 0; k < loads.size(); ++k)
        most = std::max(most, segment_rates(scene, k, loads[k]).any);
    return most;
}

Component steel_pipe(double length, double outer, double inner) {
    Component pipe;
    pipe.length = length;
    pipe.outer_diameter = outer;
    pipe.inner_diameter = inner;
    pipe.linear_density = 6165 * (outer * outer - inner * inner);
    pipe.youngs_modulus = 2.06e11;
    return pipe;
}

/// A pipe that hangs without weight.
Case pipe(double length, int segments) {
    Case input;
    input.gravity = 0;
    input.string.components = {steel_pipe(length, 0.127, 0.1086)};
    input.mesh.segments = segments;
    return input;
}

void expect_bound(const Case& input, double tension, double sharpness) {
    const Scene scene = build_scene(input);
    const double exact = exact_rate(scene, tension);
    const double bound = rate_bound(scene);
    EXPECT_LT(exact, 1.001 * bound);
    EXPECT_GT(exact, sharpness * bound);
}

TEST(SegmentRates, BoundThoseOfUniformPipes) {
    for (const int segments : {1, 2, 12}) {
        // the heavy node between two segments serves both in the bound
        const double sharpness = segments == 2 ? 0.92 : 0.94;
        for (const double length : {2.0, 80.0}) {
            Case input = pipe(length, segments);
            expect_bound(input, 0, sharpness);
            input.head.motion = HeadMotion::free;
            expect_bound(input, 0, sharpness);
        }
    }
}

TEST(SegmentRates, BoundThoseOfPipesOfSeveralSections) {
    Case input = pipe(40, 12);
    input.string.components.push_back(steel_pipe(23, 0.127, 0.0762));
    input.string.components.push_back(steel_pipe(21, 0.2032, 0.0714));
    expect_bound(input, 0, 0.9);
    input.mesh.segments = 7;
    expect_bound(input, 0, 0.9);
}

TEST(SegmentRates, CountTension) {
    const double tension = 1e6;
    Case input = pipe(84, 12);
    const Vector3d pull(0, 0, tension);
    input.bit.force = VectorSchedule({0, 1}, {pull, pull});
    expect_bound(input, tension, 0.95);
}

TEST(SegmentRates, CountBends) {
    for (const double bend : {0.02, 0.05}) {
        Case input = pipe(84, 12);
        input.initial.curvature = {0, bend / 7, 0};
        expect_bound(input, 0, 0.95);
    }
}

}  // namespace
}  // namespace drillstrand
