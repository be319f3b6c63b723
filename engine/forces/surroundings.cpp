#include "forces/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "drillstrand/hydraulics.hpp"
#include "forces/added_mass.hpp"
#include "forces/fluid.hpp"

namespace drillstrand {

namespace {

template <FrictionLaw law, bool varied_wall>
DRILLSTRAND_KERNEL void advance_springs_of_block(const Surroundings& surroundings,
                                                 Table<WallRow>& wall, double dt,
                                                 std::size_t first) {
    double* elongation_axial = wall.row(WallRow::elongation_axial) + first;
    double* elongation_azimuthal = wall.row(WallRow::elongation_azimuthal) + first;
    double* sliding = wall.row(WallRow::sliding) + first;
    const double* depth = wall.row(WallRow::depth) + first;
    const double* normal = wall.row(WallRow::normal) + first;
    const double* slip_axial = wall.row(WallRow::slip_axial) + first;
    const double* slip_azimuthal = wall.row(WallRow::slip_azimuthal) + first;
    const double* rolling = wall.row(WallRow::rolling) + first;
    const double* stiffness = wall.row(WallRow::stiffness) + first;
    const double* static_axial = wall.row(WallRow::static_axial) + first;
    const double* static_azimuthal = wall.row(WallRow::static_azimuthal) + first;
    const double* dynamic_axial = wall.row(WallRow::dynamic_axial) + first;
    const double* dynamic_azimuthal = wall.row(WallRow::dynamic_azimuthal) + first;
    // a copy, which the stores below cannot change: a reference would be read again, by branches
    const FrictionParameters shared = surroundings.parameters().friction;
    const auto advance = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const FrictionSpring spring = {{elongation_axial[k], elongation_azimuthal[k]}, sliding[k]};
        const Tangential slip = {dt * slip_axial[k], dt * slip_azimuthal[k]};
        FrictionParameters friction = shared;
        if constexpr (varied_wall)
            friction = shared.with({static_axial[k], static_azimuthal[k]},
                                   {dynamic_axial[k], dynamic_azimuthal[k]});
        const FrictionSpring next =
            law == FrictionLaw::paper
                ? paper_spring(spring, slip, dt * rolling[k], stiffness[k] * depth[k], depth[k],
                               friction)
                : coulomb_spring(spring, slip, dt * rolling[k], normal[k], depth[k], friction);
        elongation_axial[k] = next.elongation.axial;
        elongation_azimuthal[k] = next.elongation.azimuthal;
        sliding[k] = next.sliding;
    };
#pragma omp simd
    for (std::size_t k = 0; k < block_size; ++k)
        advance(k);
}

template <FrictionLaw law>
auto advance_springs_kernel(Level level, const SurroundingsParameters& parameters) {
    return parameters.varied_wall ? at_level<advance_springs_of_block<law, true>>(level)
                                  : at_level<advance_springs_of_block<law, false>>(level);
}

ArcNumbers numbers_of(const WellArc& arc) {
    return {triple(arc.start), triple(arc.tangent), triple(arc.normal), arc.curvature, arc.radius};
}

}  // namespace

SurroundingsParameters surroundings_parameters(const Scene& scene) {
    SurroundingsParameters p;
    const ContactCase& contact = scene.contact;
    p.least_normal = contact.tension ? -std::numeric_limits<double>::infinity() : 0.0;
    p.restitution = contact.restitution.value_or(-1.0);
    p.normal_law = contact.normal_law;
    p.hunt_crossley = contact.hunt_crossley;
    p.varied_wall = scene.features.varied_wall;
    p.friction =
        friction_parameters(contact.tangential_stiffness,
                            {contact.static_friction.axial, contact.static_friction.azimuthal},
                            {contact.dynamic_friction.axial, contact.dynamic_friction.azimuthal},
                            contact.law, contact.rolling_creep, contact.stribeck_speed);
    if (scene.fluid) {
        p.density = scene.fluid->density;
        p.viscosity = scene.fluid->viscosity;
        p.thinning = {scene.fluid->viscosity, scene.fluid->yield_stress,
                      0.5 * (1 - scene.fluid->flow_index)};
        p.inertial_flow = scene.features.inertial_flow;
        p.contact_drag = scene.fluid->contact_drag;
        p.drag_coefficient = scene.fluid->drag_coefficient;
        p.film = scene.fluid->film;
        p.eccentric_axial_drag = scene.fluid->axial_drag == AxialDrag::eccentric;
    }
    return p;
}

Surroundings::Surroundings(const Scene& scene, Level level)
    : level_(level), parameters_(surroundings_parameters(scene)) {
    if (!scene.well) return;
    well_ = &*scene.well;
    section_friction_ = scene.section_friction;
    nodes_ = scene.mesh.node.size();
    constants_ = BlockTable(rows, nodes_);
    constants_.fill(pipe, 1.0);
    constants_.fill(body, 1.0);
    for (std::size_t k = 0; k < nodes_; ++k) {
        constants_.row(pipe)[k] = scene.mesh.node[k].outer_radius;
        constants_.row(body)[k] = scene.mesh.node[k].flow_radius;
        constants_.row(stiffness)[k] = scene.normal_stiffness[k];
        constants_.row(damping)[k] = scene.normal_damping[k];
        if (!scene.features.fluid_mass) continue;
        constants_.row(inside)[k] = fluid_inside(scene.mesh.node[k], *scene.fluid);
        constants_.row(displaced)[k] = fluid_displaced(scene.mesh.node[k], *scene.fluid);
    }
    if (scene.features.flowing_mud) set_mud_in_motion(scene);
}

void Surroundings::set_mud_in_motion(const Scene& scene) {
    const Hydraulics mud = hydraulics_of(scene, mud_motion(scene));
    const double index = scene.fluid->flow_index;
    for (std::size_t k = 0; k < nodes_; ++k) {
        const double inner = mud.pipe_radius[k];
        const double outer = mud.hole_radius[k];
        const auto set = [&](Row row, double value) { constants_.row(row)[k] = value; };
        set(mud_load, mud.axial_load[k]);
        set(mud_speed, mud.annulus_speed[k]);
        set(mud_shear, mud.annulus_shear[k]);
        set(axial_thinning, drillstrand::axial_thinning(index, inner, outer));
        set(spin_thinning, drillstrand::spin_thinning(index, inner, outer));
    }
}

Table<WallRow> Surroundings::wall_at(const std::vector<Eigen::Vector3d>& position) const {
    if (empty()) return {};
    Table<WallRow> wall(nodes_);
    // Padding lies in a straight hole so wide that nothing touches it: kernels compute plain
    // numbers there.
    wall.fill(WallRow::tangent, Eigen::Vector3d::UnitZ());
    wall.fill(WallRow::normal_to_axis, Eigen::Vector3d::UnitX());
    wall.fill(WallRow::end_cosine, 1.0);
    wall.fill(WallRow::reach, 1.0);
    wall.fill(WallRow::hole, 1e9);
    wall.fill(WallRow::hole_start, 1e9);
    std::size_t guess = well_->arc_at(well_->measured_depth_start());
    for (std::size_t k = 0; k < nodes_; ++k) {
        guess = well_->find_arc(position[k], guess);
        enter_arc(wall, k, guess);
        wall.row(WallRow::fluid_mass)[k] = fluid_mass(wall, k, position[k]);
    }
    return wall;
}

void Surroundings::derive(Table<WallRow>& wall) const {
    for (std::size_t k = 0; k < nodes_; ++k) {
        const double arc = wall.row(WallRow::arc)[k];
        if (!(arc >= 0 && arc < static_cast<double>(well_->arcs().size()) &&
              arc == std::floor(arc)))
            throw std::invalid_argument("a node is in no arc of the well");
        // what varies along an arc is that of the last step, which substeps read
        const double last_hole = wall.row(WallRow::hole)[k];
        const double last_stiffness = wall.row(WallRow::stiffness)[k];
        enter_arc(wall, k, static_cast<std::size_t>(arc));
        wall.row(WallRow::hole)[k] = last_hole;
        wall.row(WallRow::stiffness)[k] = last_stiffness;
    }
}

void Surroundings::enter_arc(Table<WallRow>& wall, std::size_t node, std::size_t arc) const {
    const WellArc& a = well_->arcs()[arc];
    const auto set = [&](WallRow row, double value) { wall.row(row)[node] = value; };
    const auto entry = static_cast<std::ptrdiff_t>(node);
    set(WallRow::arc, static_cast<double>(arc));
    wall.set(WallRow::start, entry, a.start);
    wall.set(WallRow::tangent, entry, a.tangent);
    wall.set(WallRow::normal_to_axis, entry, a.normal);
    set(WallRow::curvature, a.curvature);
    meet_wall(wall, node, a);
    meet_flow(wall, node, a);
    const double angle = a.curvature * a.length;
    set(WallRow::end_cosine, std::cos(angle));
    set(WallRow::reach, angle < 1e-8 ? a.length : std::sin(angle) / a.curvature);
}

/// The wall at the start of an arc, how it varies from there on, and its friction.
void Surroundings::meet_wall(Table<WallRow>& wall, std::size_t node, const WellArc& arc) const {
    const auto set = [&](WallRow row, double value) { wall.row(row)[node] = value; };
    const double firmness = arc.firmness;
    set(WallRow::hole, arc.radius);
    set(WallRow::hole_start, arc.radius);
    set(WallRow::widening, arc.widening);
    set(WallRow::stiffness, firmness * row(stiffness)[node]);
    set(WallRow::stiffness_start, firmness * row(stiffness)[node]);
    set(WallRow::stiffening, arc.firming * row(stiffness)[node]);
    set(WallRow::damping,
        (parameters_.restitution < 0 ? 1.0 : std::sqrt(firmness)) * row(damping)[node]);
    const SectionFriction& friction = section_friction_[arc.section];
    set(WallRow::static_axial, friction.fixed.axial);
    set(WallRow::static_azimuthal, friction.fixed.azimuthal);
    set(WallRow::dynamic_axial, friction.slide.axial);
    set(WallRow::dynamic_azimuthal, friction.slide.azimuthal);
}

/// Coefficients of the flow around a node, with the radius in the middle of the arc.
void Surroundings::meet_flow(Table<WallRow>& wall, std::size_t node, const WellArc& arc) const {
    const auto set = [&](WallRow row, double value) { wall.row(row)[node] = value; };
    const double hole = arc.radius_at(0.5 * arc.length);
    const double pipe_radius = flow_radius(row(body)[node], hole);
    set(WallRow::concentric_axial,
        parameters_.eccentric_axial_drag ? 0.0 : concentric_axial_drag(pipe_radius, hole));
    if (!parameters_.inertial_flow) return;
    const FlowInertia flow = flow_inertia(parameters_.density, parameters_.viscosity,
                                          parameters_.drag_coefficient, pipe_radius, hole);
    set(WallRow::cross_flow, flow.cross);
    set(WallRow::swirl, flow.swirl);
    set(WallRow::swirl_reynolds, flow.swirl_reynolds);
    set(WallRow::stream, flow.stream);
}

Eigen::Vector3d Surroundings::direction(const Table<WallRow>& wall, std::size_t node,
                                        const Eigen::Vector3d& position,
                                        const Eigen::Vector3d& elsewhere) const {
    if (empty()) return elsewhere;
    return vector(well_frame(triple(position), numbers_of(well_->arcs()[arc(wall, node)])).l);
}

double Surroundings::fluid_mass(const Table<WallRow>& wall, std::size_t node,
                                const Eigen::Vector3d& position) const {
    if (empty() || row(displaced)[node] == 0) return 0;
    const WellArc& here = well_->arcs()[arc(wall, node)];
    const WellFrame frame = well_frame(triple(position), numbers_of(here));
    const double hole_radius = along_arc(frame, here.radius, here.widening).value;
    const double pipe_radius = flow_radius(row(body)[node], hole_radius);
    const Annulus annulus(
        film_eccentricity(frame.eccentricity, pipe_radius, hole_radius, parameters_.film),
        pipe_radius, hole_radius);
    return row(inside)[node] + row(displaced)[node] * added_mass(annulus).coefficient;
}

NodeContact Surroundings::contact(const Table<WallRow>& wall, std::size_t node,
                                  const Eigen::Vector3d& position) const {
    NodeContact result;
    if (empty()) return result;
    const std::size_t in = arc(wall, node);
    const WellArc& here = well_->arcs()[in];
    const WellFrame frame = well_frame(triple(position), numbers_of(here));
    const AlongArc hole = along_arc(frame, here.radius, here.widening);
    const AlongArc firmness = along_arc(frame, here.firmness, here.firming);
    result.eccentricity = frame.eccentricity;
    result.clearance = std::max(hole.value - row(pipe)[node], 0.0);
    result.room = hole.value - flow_radius(row(body)[node], hole.value);
    result.firmness = firmness.value;
    result.around = vector(frame.t);
    result.well_depth = well_->project(position, in).measured_depth;
    const double dr = penetration(frame.eccentricity, hole.value, row(pipe)[node]);
    if (dr <= 0) return result;
    const FrictionSpring spring = {
        {wall.row(WallRow::elongation_axial)[node], wall.row(WallRow::elongation_azimuthal)[node]},
        wall.row(WallRow::sliding)[node]};
    const SectionFriction& friction = section_friction_[here.section];
    const FrictionParameters p =
        parameters_.friction.with({friction.fixed.axial, friction.fixed.azimuthal},
                                  {friction.slide.axial, friction.slide.azimuthal});
    const double its_stiffness = firmness.value * row(stiffness)[node];
    result.penetration = dr;
    result.normal_force = wall.row(WallRow::normal)[node];
    const Tangential rub = friction_force(spring, result.normal_force, p);
    result.axial_friction = rub.axial;
    result.force = result.normal_force * vector(frame.r) + rub.axial * vector(frame.l) +
                   rub.azimuthal * vector(frame.t);
    const NormalLaw law = parameters_.normal_law;
    const double stiffening = energy_stiffness(law, firmness.slope * row(stiffness)[node], dr);
    const double by_slopes = result.normal_force * hole.slope - 0.5 * stiffening * dr * dr;
    if (by_slopes != 0) result.force += by_slopes * vector(frame.l);
    const double stretch2 = spring.elongation.axial * spring.elongation.axial +
                            spring.elongation.azimuthal * spring.elongation.azimuthal;
    result.spring_energy =
        0.5 * energy_stiffness(law, its_stiffness, dr) * dr * dr + 0.5 * p.stiffness * stretch2;
    return result;
}

bool Surroundings::changes(const Table<WallRow>& wall, std::size_t block) const {
    if (empty()) return false;
    const std::size_t first = block * block_size;
    double any = 0.0;
    for (std::size_t k = first; k < first + block_size; ++k) {
        any += wall.row(WallRow::depth)[k] > 0.0 ? 1.0 : 0.0;
        any += wall.row(WallRow::elongation_axial)[k] != 0.0 ? 1.0 : 0.0;
        any += wall.row(WallRow::elongation_azimuthal)[k] != 0.0 ? 1.0 : 0.0;
        any += wall.row(WallRow::leaves)[k];
    }
    return any > 0.0;
}

void Surroundings::advance_springs(Table<WallRow>& wall, double dt, std::size_t block) const {
    const bool paper = parameters_.friction.law == FrictionLaw::paper;
    const auto advance = paper ? advance_springs_kernel<FrictionLaw::paper>(level_, parameters_)
                               : advance_springs_kernel<FrictionLaw::coulomb>(level_, parameters_);
    advance(*this, wall, dt, block * block_size);
}

}  // namespace drillstrand
