#include "rod/segment_rates.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "model/segment_strain.hpp"

namespace drillstrand {

namespace {

using Eigen::Vector3d;

// ------------------------------------------------------------------ loads

double largest(const ScalarSchedule& schedule) {
    double most = 0;
    for (const double value : schedule.values())
        most = std::max(most, std::abs(value));
    return most;
}

/// Of any part of vectors that `part` measures.
template <class Part>
double largest(const VectorSchedule& schedule, const Part& part) {
    double most = 0;
    for (const Vector3d& value : schedule.values())
        most = std::max(most, part(value));
    return most;
}

/// The largest of the loads on both ends (N, N m), as the string lies at the start.
struct EndLoads {
    double pull = 0;    ///< along the string, either way, but for the weight on the bit
    double across = 0;  ///< across it
    double moment = 0;
    double pressing;  ///< weight on the bit

    explicit EndLoads(const Scene& scene) : pressing(largest(scene.bit.weight)) {
        const std::vector<Vector3d>& director = scene.initial_nodes.director;
        const auto length = [](const Vector3d& value) { return value.norm(); };
        add_force(scene.bit.force, director.back());
        moment += largest(scene.bit.moment, length) + largest(scene.bit.dead_moment, length);
        if (scene.head.motion != HeadMotion::free) return;
        add_force(scene.head.force, director.front());
        moment += largest(scene.head.moment, length);
    }

  private:
    void add_force(const VectorSchedule& force, const Vector3d& t) {
        pull += largest(force, [&](const Vector3d& value) { return std::abs(value.dot(t)); });
        across += largest(force, [&](const Vector3d& value) { return value.cross(t).norm(); });
    }
};

double angle_between(const Vector3d& first, const Vector3d& last) {
    return 2 * std::asin(std::min(1.0, (last - first).norm() / 2));
}

/// Curvature (1/m) of a helix on the wall under the compression F: c F/(2 EI).
double helix_curvature(const SectionProperties& section, double clearance, double compression) {
    return std::max(clearance, 0.0) * compression / (2 * section.bending_stiffness);
}

void add_bends_in_well(std::vector<ExpectedLoad>& loads, const Scene& scene, const EndLoads& ends) {
    const StringMesh& mesh = scene.mesh;
    const auto section_at = [&](std::size_t node) {
        return scene.well->at(scene.well->measured_depth_start() + mesh.node_s[node]);
    };
    WellCrossSection above = section_at(0);
    for (std::size_t k = 0; k < loads.size(); ++k) {
        const WellCrossSection below = section_at(k + 1);
        const double clearance =
            std::max(above.radius, below.radius) - mesh.segment[k].outer_radius;
        const double curvature =
            helix_curvature(mesh.segment[k], clearance, ends.pull + ends.pressing);
        loads[k].bend = std::max(loads[k].bend, angle_between(above.direction, below.direction)) +
                        curvature * mesh.length[k];
        above = below;
    }
}

/// Bends of a rod clamped at its head by weight and loads on its ends. A force F on an elastica
/// bends it by 2 sqrt(F/EI) at most, whatever its length.
void add_bends_by_loads(std::vector<ExpectedLoad>& loads, const Scene& scene,
                        const EndLoads& ends) {
    const StringMesh& mesh = scene.mesh;
    double across = ends.across;
    double moment = 0;
    for (std::size_t k = loads.size(); k-- > 0;) {
        const Vector3d& director = scene.initial_nodes.director[k + 1];
        across +=
            std::abs(scene.weight[k + 1]) * mesh.cell[k + 1] * scene.down.cross(director).norm();
        moment += across * mesh.length[k];
        const double stiffness = mesh.segment[k].bending_stiffness;
        const double curvature = ends.moment / stiffness +
                                 std::min(moment / stiffness, 2 * std::sqrt(across / stiffness));
        loads[k].bend += curvature * mesh.length[k];
    }
}

// ------------------------------------------------------------------ rates

/// Motions of the two nodes of a segment in one plane: along it (or about it), across it, and
/// turns.
using Motions = Eigen::Matrix<double, 6, 1>;

/// A strain of a segment that is linear in the motions of its nodes.
struct Strain {
    double stiffness;  ///< of energy stiffness strain^2/2 (N m)
    Motions gradient;
};

/// Rate of the fastest motion of nodes, whose inverse inertias are given, against such strains:
/// motions number more than strains, so the eigenvalues are sought among the strains.
double fastest(const std::array<Strain, 4>& strains, const Motions& mobility) {
    Eigen::Matrix<double, 4, 6> rows;
    for (Eigen::Index i = 0; const Strain& strain : strains)
        rows.row(i++) = std::sqrt(strain.stiffness) * strain.gradient.transpose();
    const Eigen::Matrix4d rate2 = rows * mobility.asDiagonal() * rows.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(rate2, Eigen::EigenvaluesOnly);
    return std::sqrt(solver.eigenvalues().maxCoeff());
}

double stiffness_along(const SectionProperties& section, double h) {
    return section.axial_stiffness / h;
}
double stiffness_about(const SectionProperties& section, double h) {
    return section.torsional_stiffness / h;
}
double stiffness_across(const SectionProperties& section, double h) {
    return SegmentStiffness(section, h).deviation / h;
}

/// A segment's share of what is lumped at one of its nodes, by a stiffness. Any split gives a
/// bound; this one lets two unequal segments be equally fast.
template <class Stiffness>
double share(const StringMesh& mesh, std::size_t node, std::size_t segment,
             const Stiffness& stiffness) {
    double all = 0;
    for (std::size_t k = node > 0 ? node - 1 : 0; k <= std::min(node, mesh.length.size() - 1); ++k)
        all += stiffness(mesh.segment[k], mesh.length[k]);
    return stiffness(mesh.segment[segment], mesh.length[segment]) / all;
}

/// Inverse inertias of a node (1/kg, 1/(kg m2)); none where motion is prescribed.
struct Mobility {
    double along = 0;
    double about = 0;
    double across = 0;
    double turn = 0;

    Mobility(const Scene& scene, std::size_t node, std::size_t segment) {
        const bool is_head = node == 0;
        const HeadCase& head = scene.head;
        if (is_head && head.motion == HeadMotion::driven && !head.hoist) return;
        const SectionProperties& section = scene.mesh.node[node];
        const auto cell_by = [&](const auto& stiffness) {
            return scene.mesh.cell[node] * share(scene.mesh, node, segment, stiffness);
        };
        // the block only slows what its own cell of pipe would do
        if (is_head && head.hoist) along = 1 / (section.mass * cell_by(stiffness_along));
        if (is_head && head.hoist) return;
        turn = 1 / (scene.inertia[node] * cell_by(stiffness_across));
        if (is_head && head.motion == HeadMotion::pinned) return;
        along = 1 / (section.mass * cell_by(stiffness_along));
        about = 1 / (section.polar_inertia * cell_by(stiffness_about));
        across = 1 / (scene.lateral_mass[node] * cell_by(stiffness_across));
    }
};

}  // namespace

std::vector<ExpectedLoad> expected_loads(const Scene& scene) {
    const StringMesh& mesh = scene.mesh;
    const std::vector<Vector3d>& director = scene.initial_nodes.director;
    const EndLoads ends(scene);
    std::vector<ExpectedLoad> loads(mesh.length.size());
    double weight_below = 0;
    for (std::size_t k = loads.size(); k-- > 0;) {
        weight_below += scene.weight[k + 1] * mesh.cell[k + 1] * scene.down.dot(director[k + 1]);
        loads[k].tension = std::max(0.0, ends.pull + weight_below);
        loads[k].bend = std::max(angle_between(director[k], director[k + 1]),
                                 mesh.segment[k].curvature.tail<2>().norm() * mesh.length[k]);
    }
    if (scene.well)
        add_bends_in_well(loads, scene, ends);
    else
        add_bends_by_loads(loads, scene, ends);
    return loads;
}

SegmentRates segment_rates(const Scene& scene, std::size_t segment, const ExpectedLoad& load) {
    const double h = scene.mesh.length[segment];
    const SectionProperties& section = scene.mesh.segment[segment];
    const Mobility a(scene, segment, segment);
    const Mobility b(scene, segment + 1, segment);

    const SegmentStiffness stiffness(section, h);
    const double z = load.tension / stiffness.bending;
    const StabilityFunctions stability(z);
    const double bending = stiffness.bending * (1 + stability.symmetric + z / 12);
    const double deviation = stiffness.deviation * stability.antisymmetric + load.tension / 5;
    const double k = stiffness.bending_share;
    const double bend = load.bend;
    // axial force straightens a bent segment: it is softer by 1 - (EA h^2/EI) r_s'' b^2/2
    const double slope_change =
        StabilityFunctions(z + 1).symmetric_slope - stability.symmetric_slope;
    const double axial =
        stiffness.axial / (1 - stiffness.slenderness * slope_change * bend * bend / 2);
    const Strain bent{h * bending, {0, 0, 0, 0, -1, 1}};
    const Strain deviated{h * deviation, {0, 0, -1 / h, 1 / h, -0.5, -0.5}};
    const Strain swung{h * load.tension, {0, 0, -1 / h, 1 / h, 0, 0}};
    // bends stretch as they grow, and twist as the segment leaves their plane
    const Strain stretched{h * axial, {-1 / h, 1 / h, 0, 0, -bend / 12, bend / 12}};
    const Strain twisted{
        section.torsional_stiffness / h,
        {-1, 1, -k * bend / h, k * bend / h, (1 - k) * bend / 2, (1 - k) * bend / 2}};
    const Motions in_plane{a.along, b.along, a.across, b.across, a.turn, b.turn};
    const Motions out_of_plane{a.about, b.about, a.across, b.across, a.turn, b.turn};
    return {std::sqrt(stiffness.axial / h * (a.along + b.along)),
            std::sqrt(section.torsional_stiffness / h * (a.about + b.about)),
            std::max(fastest({stretched, bent, deviated, swung}, in_plane),
                     fastest({twisted, bent, deviated, swung}, out_of_plane))};
}

}  // namespace drillstrand
