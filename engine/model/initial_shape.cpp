#include "model/initial_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "model/pose.hpp"
#include "model/segment_strain.hpp"

namespace drillstrand {

namespace {

/// Solves a symmetric tridiagonal system for vectors, in place: diagonal d (n), off-diagonal e
/// (n - 1), right-hand sides x (n). Thomas' algorithm; the matrix is positive definite.
void solve_tridiagonal(std::vector<double> d, const std::vector<double>& e,
                       std::vector<Eigen::Vector3d>& x) {
    const std::size_t n = d.size();
    for (std::size_t k = 1; k < n; ++k) {
        const double factor = e[k - 1] / d[k - 1];
        d[k] -= factor * e[k - 1];
        x[k] -= factor * x[k - 1];
    }
    x[n - 1] /= d[n - 1];
    for (std::size_t k = n - 1; k-- > 0;)
        x[k] = (x[k] - e[k] * x[k + 1]) / d[k];
}

/// Energies of a segment (N m): half of `bend` times the square of the difference of its directors,
/// and twice `deviation` times that of its chord's from their mean.
struct HeldSegment {
    double bend;
    double deviation;
};

HeldSegment strand_segment(const SectionProperties& section, double h) {
    return {section.bending_stiffness / h, section.shear_stiffness * h / 4};
}

HeldSegment beam_segment(const SectionProperties& section, double h) {
    return {section.bending_stiffness / h, SegmentStiffness(section, h).deviation * h / 4};
}

using Held = HeldSegment (*)(const SectionProperties&, double);

/// Directors of a rod whose nodes are held at given points, the first one at `head`: those of least
/// energy, linear in the small turns between neighbours.
std::vector<Eigen::Vector3d> relaxed_directors(const StringMesh& mesh,
                                               const std::vector<Eigen::Vector3d>& position,
                                               const Eigen::Vector3d& head, Held held) {
    const std::size_t segments = mesh.length.size();
    std::vector<double> diagonal(segments, 0.0);  // unknowns: nodes 1..N
    std::vector<double> off_diagonal(segments - 1, 0.0);
    std::vector<Eigen::Vector3d> director(segments, Eigen::Vector3d::Zero());
    for (std::size_t k = 0; k < segments; ++k) {
        const auto [bend, deviation] = held(mesh.segment[k], mesh.length[k]);
        const Eigen::Vector3d chord = (position[k + 1] - position[k]).normalized();
        diagonal[k] += bend + deviation;
        director[k] += 2 * deviation * chord;
        if (k == 0) {
            director[0] += (bend - deviation) * head;
        } else {
            diagonal[k - 1] += bend + deviation;
            off_diagonal[k - 1] = deviation - bend;
            director[k - 1] += 2 * deviation * chord;
        }
    }
    solve_tridiagonal(diagonal, off_diagonal, director);
    director.insert(director.begin(), head);
    for (Eigen::Vector3d& t : director)
        t.normalize();
    return director;
}

/// Strain of a segment that takes a pose to the next node: the section turns by the shortest way
/// until d3 is `director`, and the segment ends at `position`.
Vector6 strain_between(const Pose& pose, const Eigen::Vector3d& director,
                       const Eigen::Vector3d& position, double h) {
    const Eigen::Matrix3d to_body = pose.frame.transpose();
    const Eigen::Vector3d turned = to_body * director;  // (along d3, d1, d2)
    const Eigen::Vector3d axis = Eigen::Vector3d::UnitX().cross(turned);
    const double sine = axis.norm();
    const double angle = std::atan2(sine, turned.x());
    Vector6 strain = Vector6::Zero();
    if (sine > 0) strain.head<3>() = axis * (angle / sine / h);
    // The displacement is linear in the three components of g: its matrix is T.
    Eigen::Matrix3d displacement;
    for (Eigen::Index i = 0; i < 3; ++i) {
        const Eigen::Vector3d g = Eigen::Vector3d::Unit(i);
        const SegmentPose step = segment_pose(h, strain[0], strain[1], strain[2], g[0], g[1], g[2]);
        displacement.col(i) = Eigen::Map<const Eigen::Vector3d>(step.position);
    }
    strain.tail<3>() = displacement.inverse() * (to_body * (position - pose.position));
    return strain;
}

/// The pose at the end of a segment.
Pose pose_after(const Pose& pose, double h, const Vector6& u) {
    const SegmentPose step = segment_pose(h, u[0], u[1], u[2], u[3], u[4], u[5]);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(
        &step.rotation[0][0]);
    return {pose.frame * rotation,
            pose.position + pose.frame * Eigen::Map<const Eigen::Vector3d>(step.position)};
}

/// Positions and directors of nodes on the axis of the well, `spacing` (m) apart along it.
InitialNodes nodes_on_axis(const Well& well, const StringMesh& mesh, const Pose& head,
                           const std::vector<double>& spacing, Held held) {
    InitialNodes nodes;
    nodes.position.reserve(spacing.size() + 1);
    nodes.position.push_back(head.position);
    double depth = well.measured_depth_start();
    for (const double step : spacing) {
        depth += step;
        nodes.position.push_back(well.at(depth).axis);
    }
    nodes.director = relaxed_directors(mesh, nodes.position, head.frame.col(0), held);
    nodes.twist.assign(spacing.size(), 0.0);
    return nodes;
}

/// Stretch g3 of the arcs through given nodes: strains of the segments, from the head on.
std::vector<Vector6> strains_between(const InitialNodes& nodes, const StringMesh& mesh,
                                     const Pose& head) {
    std::vector<Vector6> strains;
    strains.reserve(mesh.length.size());
    Pose pose = head;
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const double h = mesh.length[k];
        strains.push_back(strain_between(pose, nodes.director[k + 1], nodes.position[k + 1], h));
        pose = pose_after(pose, h, strains.back());
    }
    return strains;
}

/// Arc length of a beam-column over that of its chord: S of engine/rod/README.md, "Segment".
double arc_over_chord(const Eigen::Vector3d& chord, const Eigen::Vector3d& first,
                      const Eigen::Vector3d& last) {
    const double bend = 2 * std::asin((last - first).norm() / 2);
    const double deviation2 = (chord.normalized() - (first + last).normalized()).squaredNorm();
    return 1 + bend * bend / 24 + deviation2 / 10;
}

/// Stretch of the beam-columns between nodes.
std::vector<double> beam_stretches(const InitialNodes& nodes, const StringMesh& mesh) {
    std::vector<double> stretch;
    stretch.reserve(mesh.length.size());
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const Eigen::Vector3d chord = nodes.position[k + 1] - nodes.position[k];
        stretch.push_back(chord.norm() / mesh.length[k] *
                          arc_over_chord(chord, nodes.director[k], nodes.director[k + 1]));
    }
    return stretch;
}

/// Adjusts the spacing of nodes along a well until `stretches` are all 1: a string that is neither
/// stretched nor twisted with its nodes on the axis, as a rod that is held there bends.
template <class Stretches>
InitialNodes unstretched_nodes(const Well& well, const StringMesh& mesh, const Pose& head,
                               Held held, const Stretches& stretches) {
    constexpr int rounds = 20;
    constexpr double negligible = 1e-13;
    constexpr double small = 1e-7;
    std::vector<double> spacing = mesh.length;
    InitialNodes nodes = nodes_on_axis(well, mesh, head, spacing, held);
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) {
        const std::vector<double> stretch = stretches(nodes);
        double worst = 0;
        for (std::size_t k = 0; k < spacing.size(); ++k) {
            worst = std::max(worst, std::abs(stretch[k] - 1));
            spacing[k] *= 2 - stretch[k];
        }
        // where segments are short, rounding of positions is all that is left before that
        if (worst < negligible || (worst < small && worst >= least)) break;
        least = worst;
        nodes = nodes_on_axis(well, mesh, head, spacing, held);
    }
    return nodes;
}

std::vector<Vector6> strains_along(const Well& well, const StringMesh& mesh, const Pose& head) {
    const InitialNodes nodes =
        unstretched_nodes(well, mesh, head, strand_segment, [&](const InitialNodes& trial) {
            std::vector<double> stretch;
            stretch.reserve(mesh.length.size());
            for (const Vector6& strain : strains_between(trial, mesh, head))
                stretch.push_back(strain[3]);
            return stretch;
        });
    std::vector<Vector6> strains = strains_between(nodes, mesh, head);
    for (Vector6& strain : strains)
        strain[3] = 1;
    return strains;
}

/// Straight, or bent to the string's own shape.
std::vector<Vector6> strains_without_well(const Scene& scene, InitialState state) {
    std::vector<Vector6> strains;
    for (const SectionProperties& segment : scene.mesh.segment) {
        Vector6 strain;
        strain << Eigen::Vector3d::Zero(), 1, 0, 0;
        if (state == InitialState::stress_free) strain.head<3>() = segment.curvature;
        strains.push_back(strain);
    }
    return strains;
}

/// Curvature of a strain, in the section whose axes are the columns of `frame` (1/m).
Eigen::Vector3d curvature_in(const Eigen::Matrix3d& frame, const Vector6& strain) {
    return strain[1] * frame.col(1) + strain[2] * frame.col(2);
}

/// Directors of the arcs of given strains, joined by beam-columns of their length, deviation and
/// twist (engine/rod/README.md, "Own shape"): nothing is stressed in a rod of that shape.
InitialNodes free_nodes(const Scene& scene, const Pose& head) {
    InitialNodes nodes;
    nodes.position = {head.position};
    nodes.director = {head.frame.col(0)};
    const std::vector<Pose> pose =
        poses_from_strains(head, scene.mesh.length, scene.initial_strain);
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k) {
        const double h = scene.mesh.length[k];
        const Vector6& strain = scene.initial_strain[k];
        const Eigen::Matrix3d& a = pose[k].frame;
        const Eigen::Matrix3d& b = pose[k + 1].frame;
        const Eigen::Vector3d mean = (a.col(0) + b.col(0)).normalized();
        const Eigen::Vector3d change = curvature_in(b, strain) - curvature_in(a, strain);
        const Eigen::Vector3d along = (mean + h / 12 * mean.cross(change)).normalized();
        const double chord = h / arc_over_chord(along, a.col(0), b.col(0));
        nodes.position.emplace_back(nodes.position[k] + chord * along);
        nodes.director.emplace_back(b.col(0));
        nodes.twist.push_back(strain[0] - along.dot(a.col(0).cross(b.col(0))) / h);
    }
    return nodes;
}

bool lies_along_well(const Scene& scene, const InitialCase& initial) {
    // the search for equilibrium starts from there too
    return scene.well && initial.state != InitialState::stress_free;
}

}  // namespace

std::vector<Vector6> initial_strains(const Scene& scene, const InitialCase& initial) {
    std::vector<Vector6> strains =
        lies_along_well(scene, initial)
            ? strains_along(*scene.well, scene.mesh, {scene.head_frame, scene.head_position})
            : strains_without_well(scene, initial.state);
    for (Vector6& strain : strains)
        strain.head<3>() += initial.curvature;
    return strains;
}

InitialNodes initial_nodes(const Scene& scene, const InitialCase& initial) {
    const Pose head = {scene.head_frame, scene.head_position};
    if (lies_along_well(scene, initial) && initial.curvature.isZero(0)) {
        return unstretched_nodes(
            *scene.well, scene.mesh, head, beam_segment,
            [&](const InitialNodes& trial) { return beam_stretches(trial, scene.mesh); });
    }
    return free_nodes(scene, head);
}

}  // namespace drillstrand
