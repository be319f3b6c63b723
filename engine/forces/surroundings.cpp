#include "forces/surroundings.hpp"

#include <cmath>
#include <limits>

#include "forces/fluid.hpp"

namespace drillstrand {

namespace {

template <bool paper_law>
DRILLSTRAND_INLINE void advance_springs_of_block(
    double* elongation_axial, double* elongation_azimuthal, double* sliding, const double* depth,
    const double* normal, const double* slip_axial, const double* slip_azimuthal, double dt,
    const double* stiffness, const FrictionParameters& parameters) {
    // a copy, which the stores below cannot change: a reference would be read again, by branches
    const FrictionParameters friction = parameters;
#pragma omp simd
    for (std::size_t k = 0; k < block_size; ++k) {
        const FrictionSpring spring = {{elongation_axial[k], elongation_azimuthal[k]}, sliding[k]};
        const Tangential slip = {dt * slip_axial[k], dt * slip_azimuthal[k]};
        const FrictionSpring next =
            paper_law ? paper_spring(spring, slip, stiffness[k] * depth[k], depth[k], friction)
                      : coulomb_spring(spring, slip, normal[k], depth[k], friction);
        elongation_axial[k] = next.elongation.axial;
        elongation_azimuthal[k] = next.elongation.azimuthal;
        sliding[k] = next.sliding;
    }
}

DRILLSTRAND_KERNEL void advance_coulomb_springs(double* a, double* t, double* s, const double* d,
                                                const double* n, const double* va, const double* vt,
                                                double dt, const double* k,
                                                const FrictionParameters& p) {
    advance_springs_of_block<false>(a, t, s, d, n, va, vt, dt, k, p);
}

DRILLSTRAND_KERNEL void advance_paper_springs(double* a, double* t, double* s, const double* d,
                                              const double* n, const double* va, const double* vt,
                                              double dt, const double* k,
                                              const FrictionParameters& p) {
    advance_springs_of_block<true>(a, t, s, d, n, va, vt, dt, k, p);
}

}  // namespace

SurroundingsParameters surroundings_parameters(const Scene& scene) {
    SurroundingsParameters p;
    const ContactCase& contact = scene.contact;
    p.least_normal = contact.tension ? -std::numeric_limits<double>::infinity() : 0.0;
    p.friction =
        friction_parameters(contact.tangential_stiffness,
                            {contact.static_friction.axial, contact.static_friction.azimuthal},
                            {contact.dynamic_friction.axial, contact.dynamic_friction.azimuthal},
                            contact.law == FrictionLaw::coulomb);
    if (scene.fluid) {
        p.viscosity = scene.fluid->viscosity;
        p.film = scene.fluid->film;
        p.eccentric_axial_drag = scene.fluid->axial_drag == AxialDrag::eccentric;
    }
    return p;
}

Surroundings::Surroundings(const Scene& scene, const std::vector<Eigen::Vector3d>& position)
    : parameters_(surroundings_parameters(scene)) {
    if (!scene.well) return;
    well_ = &*scene.well;
    const std::size_t nodes = position.size();
    table_ = BlockTable(rows, nodes);
    arc_.assign(nodes, 0);
    // Padding lies in a straight hole so wide that nothing touches it: kernels compute plain
    // numbers there.
    table_.fill(tangent_z, 1.0);
    table_.fill(normal_x, 1.0);
    table_.fill(hole, 1e9);
    table_.fill(end_cosine, 1.0);
    table_.fill(reach, 1.0);
    table_.fill(pipe, 1.0);
    std::size_t guess = well_->arc_at(well_->measured_depth_start());
    for (std::size_t k = 0; k < nodes; ++k) {
        table_.row(pipe)[k] = scene.mesh.node[k].outer_radius;
        table_.row(stiffness)[k] = scene.normal_stiffness[k];
        table_.row(damping)[k] = scene.normal_damping[k];
        guess = well_->find_arc(position[k], guess);
        enter_arc(k, guess);
    }
}

void Surroundings::enter_arc(std::size_t node, std::size_t arc) {
    arc_[node] = arc;
    const WellArc& a = well_->arcs()[arc];
    const auto set = [&](Row row, double value) { table_.row(row)[node] = value; };
    set(start_x, a.start.x());
    set(start_y, a.start.y());
    set(start_z, a.start.z());
    set(tangent_x, a.tangent.x());
    set(tangent_y, a.tangent.y());
    set(tangent_z, a.tangent.z());
    set(normal_x, a.normal.x());
    set(normal_y, a.normal.y());
    set(normal_z, a.normal.z());
    set(curvature, a.curvature);
    set(hole, a.radius);
    set(concentric_axial,
        parameters_.eccentric_axial_drag ? 0.0 : concentric_axial_drag(row(pipe)[node], a.radius));
    const double angle = a.curvature * a.length;
    set(end_cosine, std::cos(angle));
    set(reach, angle < 1e-8 ? a.length : std::sin(angle) / a.curvature);
}

ArcNumbers Surroundings::arc_numbers(std::size_t node) const {
    const WellArc& a = well_->arcs()[arc_[node]];
    return {triple(a.start), triple(a.tangent), triple(a.normal), a.curvature, a.radius};
}

NodeContact Surroundings::contact(std::size_t node, const Eigen::Vector3d& position) const {
    NodeContact result;
    if (empty()) return result;
    const WellFrame frame = well_frame(triple(position), arc_numbers(node));
    result.eccentricity = frame.eccentricity;
    result.well_depth = well_->project(position, arc_[node]).measured_depth;
    const double dr = penetration(frame.eccentricity, row(hole)[node], row(pipe)[node]);
    if (dr <= 0) return result;
    const FrictionSpring spring = {{row(elongation_axial)[node], row(elongation_azimuthal)[node]},
                                   row(sliding)[node]};
    const FrictionParameters& p = parameters_.friction;
    result.penetration = dr;
    result.normal_force = row(normal)[node];
    const Tangential rub = friction_force(spring, result.normal_force, p);
    result.force = result.normal_force * vector(frame.r) + rub.axial * vector(frame.l) +
                   rub.azimuthal * vector(frame.t);
    const double stretch2 = spring.elongation.axial * spring.elongation.axial +
                            spring.elongation.azimuthal * spring.elongation.azimuthal;
    result.spring_energy = 0.5 * row(stiffness)[node] * dr * dr + 0.5 * p.stiffness * stretch2;
    return result;
}

bool Surroundings::changes(std::size_t block) const {
    if (empty()) return false;
    const std::size_t first = block * block_size;
    double any = 0.0;
    for (std::size_t k = first; k < first + block_size; ++k) {
        any += row(depth)[k] > 0.0 ? 1.0 : 0.0;
        any += row(elongation_axial)[k] != 0.0 ? 1.0 : 0.0;
        any += row(elongation_azimuthal)[k] != 0.0 ? 1.0 : 0.0;
        any += row(leaves)[k];
    }
    return any > 0.0;
}

void Surroundings::advance_springs(double dt, std::size_t block) {
    const auto advance =
        parameters_.friction.cone > 0 ? advance_coulomb_springs : advance_paper_springs;
    const std::size_t k = block * block_size;
    advance(row(elongation_axial) + k, row(elongation_azimuthal) + k, row(sliding) + k,
            row(depth) + k, row(normal) + k, row(slip_axial) + k, row(slip_azimuthal) + k, dt,
            row(stiffness) + k, parameters_.friction);
}

}  // namespace drillstrand
