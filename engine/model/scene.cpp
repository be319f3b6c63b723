#include "drillstrand/scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "drillstrand/error.hpp"
#include "model/initial_shape.hpp"
#include "model/pose.hpp"
#include "model/segment_strain.hpp"

namespace drillstrand {

namespace {

/// Restitution of a mass on a spring and dashpot that can only push, for a damping ratio: the
/// contact ends where the force, not the compression, vanishes.
double restitution_of(double damping_ratio) {
    const double z = damping_ratio;
    if (z < 1) {
        const double rest = std::sqrt(1 - z * z);
        return std::exp(-z / rest * (std::numbers::pi - 2 * std::asin(z)));
    }
    if (z == 1) return std::exp(-2.0);
    return std::exp(-2 * z * std::acosh(z) / std::sqrt(z * z - 1));
}

/// The damping ratio that gives a restitution between 0 and 1, by bisection.
double damping_ratio_for(double restitution) {
    double low = 0;
    double high = 1e6;
    if (restitution_of(high) >= restitution) return high;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (restitution_of(middle) > restitution ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// The leapfrog's rod and that of statics bend as cubics; what holds the head takes its couple.
Lumping lumping_of(const Case& input) {
    if (input.run.integrator == IntegratorKind::dormand_prince) return Lumping::cells;
    return input.head.motion == HeadMotion::driven ? Lumping::cubic_clamped_head
                                                   : Lumping::cubic_free_head;
}

/// The wall at a contact point, per length of its node's cell (Pa): whatever the mesh, the point
/// presses on its own length.
double wall_at_contact_point(const ContactPoint& point, const ContactCase& contact, double cell) {
    return point.stiffness.value_or(contact.point_stiffness) * point.length / cell;
}

/// The dashpot at a node of a wall of this stiffness (Pa s). Hertz's wall damps without one.
double normal_damping(const ContactCase& contact, double stiffness, double mass) {
    if (contact.normal_law == NormalLaw::hertz) return 0;
    return contact.restitution
               ? 2 * damping_ratio_for(*contact.restitution) * std::sqrt(stiffness * mass)
               : stiffness / contact.normal_stiffness * contact.normal_damping;
}

/// Springs and dashpots of the wall at each node. The bit's node carries those of the wall that the
/// bit touches on the length of its own cell, as it carries every load.
void set_wall(Scene& scene) {
    const ContactCase& contact = scene.contact;
    const StringMesh& mesh = scene.mesh;
    scene.normal_stiffness.assign(mesh.node.size(), contact.normal_stiffness);
    scene.normal_stiffness.back() *= 1 + scene.bit.contact_length / mesh.cell.back();
    for (const StringMesh::Contact& at : mesh.contact)
        scene.normal_stiffness[at.node] =
            wall_at_contact_point(at.point, contact, mesh.cell[at.node]);
    for (std::size_t k = 0; k < mesh.node.size(); ++k)
        scene.normal_damping.push_back(
            normal_damping(contact, scene.normal_stiffness[k], scene.lateral_mass[k]));
}

/// The angle from d1 to the side of the hole that toolfaces are counted from, at a place of a
/// string that lies in its well untwisted.
double reference_toolface(const Well& well, const Eigen::Matrix3d& head_frame, double s) {
    const double depth = well.measured_depth_start() + s;
    Eigen::Vector3d t = head_frame.col(0);
    Eigen::Vector3d d1 = head_frame.col(1);
    const auto follow = [&](const Eigen::Vector3d& to) {
        d1 = carried(d1, t, to);
        t = to;
    };
    for (const WellArc& arc : well.arcs())
        if (arc.measured_depth_start < depth) follow(arc.tangent);
    follow(well.at(depth).direction);
    constexpr double least_sine = 0.05;
    const Eigen::Vector3d up(0, 0, -1);
    const Eigen::Vector3d north(1, 0, 0);
    const Eigen::Vector3d& reference = t.cross(up).norm() > least_sine ? up : north;
    return std::atan2(reference.dot(t.cross(d1)), reference.dot(d1));
}

/// Toolfaces as angles from d1 of a string that lies in its well untwisted: the case counts them
/// from the high side of the hole, to the right for one who looks down it, or, where the hole is
/// within 3 degrees of vertical, from north.
StringCase with_toolfaces_from_d1(StringCase string, const Well& well,
                                  const Eigen::Matrix3d& head_frame) {
    double s = 0;
    for (Component& component : string.components) {
        if (component.bend)
            component.bend->toolface +=
                reference_toolface(well, head_frame, s + component.bend->position);
        s += component.length;
    }
    return string;
}

/// The friction of each section: its own, or that of [contact].
std::vector<SectionFriction> section_friction(const WellCase& well, const ContactCase& contact) {
    std::vector<SectionFriction> result;
    for (const WellSectionCase& section : well.sections)
        result.push_back({section.static_friction.value_or(contact.static_friction),
                          section.dynamic_friction.value_or(contact.dynamic_friction)});
    return result;
}

bool has_own_friction(const WellSectionCase& section) {
    return section.static_friction || section.dynamic_friction;
}

/// Puts the string's well around it.
void set_well(Scene& scene, const WellCase& well) {
    scene.well.emplace(well, scene.contact.normal_stiffness);
    scene.section_friction = section_friction(well, scene.contact);
}

SceneFeatures features_of(const Case& input, const std::optional<Well>& well,
                          const StringMesh& mesh) {
    SceneFeatures features;
    features.well = input.well.has_value();
    // friction that falls with speed and Hertz's wall are in these kernels alone: each version
    // takes long to compile
    features.varied_wall = well && (well->varies_along() || input.contact.stribeck_speed > 0 ||
                                    input.contact.normal_law == NormalLaw::hertz ||
                                    std::any_of(input.well->sections.begin(),
                                                input.well->sections.end(), has_own_friction));
    if (features.well && input.fluid) {
        const FluidCase& fluid = *input.fluid;
        features.inertial_flow = fluid.drag && fluid.regime == FlowRegime::inertial;
        features.drag = fluid.drag && (fluid.viscosity > 0 || features.inertial_flow);
        features.flowing_mud = features.drag && (fluid.flow_rate > 0 || !fluid.is_newtonian());
        features.fluid_mass = fluid.added_mass;
    }
    if (input.damping.internal.any() || input.damping.external.any())
        features.damping = Damping::paper;
    if (input.damping.kelvin_voigt > 0) features.damping = Damping::kelvin_voigt;
    // an eccentric mass needs the material frames, too
    features.curved =
        !mesh.unbalance.empty() ||
        std::any_of(mesh.segment.begin(), mesh.segment.end(),
                    [](const SectionProperties& segment) { return !segment.curvature.isZero(0); });
    return features;
}

/// Added mass of a pipe in the middle of a hole, over the fluid that it displaces (Stokes 1843).
double concentric_added_mass(double pipe, double hole) {
    return (hole * hole + pipe * pipe) / (hole * hole - pipe * pipe);
}

/// The mass of each node that moves sideways, as in the middle of the hole.
std::vector<double> lateral_masses(const Scene& scene) {
    std::vector<double> masses;
    std::size_t arc = 0;
    for (std::size_t k = 0; k < scene.mesh.node.size(); ++k) {
        const SectionProperties& node = scene.mesh.node[k];
        masses.push_back(node.mass);
        if (!scene.features.fluid_mass) continue;
        const Eigen::Vector3d& position = scene.initial_nodes.position[k];
        arc = scene.well->find_arc(position, arc);
        const double hole = scene.well->project(position, arc).radius;
        masses.back() +=
            fluid_inside(node, *scene.fluid) +
            fluid_displaced(node, *scene.fluid) * concentric_added_mass(node.flow_radius, hole);
    }
    return masses;
}

std::vector<double> section_inertias(const StringMesh& mesh) {
    std::vector<double> inertias;
    for (const SectionProperties& node : mesh.node)
        inertias.push_back(node.inertia);
    return inertias;
}

/// Rotary inertias of nodes (kg m) with those of the segments' mass as rigid pieces.
std::vector<double> rigid_piece_inertias(const Scene& scene) {
    const std::vector<double>& length = scene.mesh.length;
    std::vector<double> inertias;
    for (std::size_t k = 0; k < scene.mesh.node.size(); ++k) {
        const double h = 0.5 * (length[k > 0 ? k - 1 : 0] + length[std::min(k, length.size() - 1)]);
        inertias.push_back(scene.mesh.node[k].inertia + scene.lateral_mass[k] * h * h / 12);
    }
    return inertias;
}

/// Rotary inertias of nodes (kg m), at least 4 k EI m/EA: then nodes turn against each other, at
/// the rate sqrt(12 k EI/J)/h, at 0.87 of that of axial waves, 2 sqrt(EA/m)/h, and cost no steps.
/// (At 3 k EI m/EA, as fast as these, pipes that were let go from strong bends gathered energy at
/// 0.9 of the bound.)
std::vector<double> slow_inertias(const StringMesh& mesh) {
    std::vector<double> inertias = section_inertias(mesh);
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const double h = mesh.length[k];
        const SegmentStiffness stiffness(mesh.segment[k], h);
        const double gyration2 = stiffness.deviation * h * h / (3 * stiffness.axial);
        for (const std::size_t node : {k, k + 1})
            inertias[node] = std::max(inertias[node], gyration2 * mesh.node[node].mass);
    }
    return inertias;
}

/// Whether a couple about the bit's axis may act on it.
bool is_twisted(const BitCase& bit) {
    const auto is_any = [](double torque) { return torque != 0; };
    const auto has_couple = [](const Eigen::Vector3d& couple) { return !couple.isZero(0); };
    const auto any_of = [](const auto& schedule, const auto& is) {
        return std::any_of(schedule.values().begin(), schedule.values().end(), is);
    };
    return bit.law != BitLaw::prescribed || bit.friction.value_or(0) > 0 ||
           any_of(bit.torque, is_any) || any_of(bit.moment, has_couple) ||
           any_of(bit.dead_moment, has_couple);
}

/// Whether a couple about the axis of a head that tilts may act on it.
bool is_twisted(const HeadCase& head, const BitCase& bit) {
    const auto& rates = head.rotation.values();
    const bool turns =
        std::any_of(rates.begin(), rates.end(), [](double rate) { return rate != 0; });
    return head.motion == HeadMotion::pinned && (head.drive || turns || is_twisted(bit));
}

/// A torque that follows an end which tilts drives it to flutter, as slowly as its motion is heavy.
/// The turn of the end's node alone is a motion of the mesh, light, and by nothing damped: where a
/// torque acts, the node is as heavy as a rigid segment of the length h about its end, whose
/// inertia vanishes with h^2.
void weigh_down_twisted_end(const SectionProperties& node, double h, double& inertia) {
    inertia = std::max(inertia, node.mass * h * h / 3);
}

/// D_in carries turns along the string with the speed D_in/J, half a step late: where that is no
/// longer slow beside axial waves, it feeds bends that turn light nodes in little more than a step.
void weigh_down_damped_nodes(const Scene& scene, std::vector<double>& inertias) {
    constexpr double slow = 1e-3;
    const std::vector<double> rigid = rigid_piece_inertias(scene);
    for (std::size_t k = 0; k < inertias.size(); ++k) {
        const SectionProperties& segment = scene.mesh.segment[std::min(k, inertias.size() - 2)];
        const double wave_speed = std::sqrt(segment.axial_stiffness / segment.mass);
        if (scene.damping.internal.rotation > slow * inertias[k] * wave_speed)
            inertias[k] = rigid[k];
    }
}

std::vector<double> rotary_inertias(const Scene& scene, const Case& input) {
    if (input.run.integrator == IntegratorKind::leapfrog) {
        std::vector<double> inertias = slow_inertias(scene.mesh);
        const StringMesh& mesh = scene.mesh;
        if (is_twisted(input.bit))
            weigh_down_twisted_end(mesh.node.back(), mesh.length.back(), inertias.back());
        if (is_twisted(input.head, input.bit))
            weigh_down_twisted_end(mesh.node.front(), mesh.length.front(), inertias.front());
        weigh_down_damped_nodes(scene, inertias);
        return inertias;
    }
    return input.mesh.segment_inertia ? rigid_piece_inertias(scene) : section_inertias(scene.mesh);
}

/// The paper's one number damps rotation as much as translation, though the units differ.
std::optional<std::string> note_on_braked_spin(const Scene& scene) {
    const DampingPair& damping = scene.damping.external;
    if (!damping.shared || damping.rotation == 0) return std::nullopt;
    double rate = 0;
    for (const double value : scene.head.rotation.values())
        rate = std::max(rate, std::abs(value));
    if (rate == 0) return std::nullopt;
    const double length = scene.mesh.node_s.back();
    return fmt::format(
        "damping.external = {:.4g} brakes the rotation too, by up to {:.3g} N m of torque at the "
        "head; damping.external_translation damps translation alone",
        damping.rotation, damping.rotation * rate * length);
}

std::string note_on_lost_contact(double s) {
    return fmt::format(
        "the contact point {:.5g} m along the string lies between nodes and touches nothing: a "
        "mesh "
        "that follows the string (mesh.element_length) has a node there",
        s);
}

}  // namespace

Eigen::Matrix3d frame_along(const Eigen::Vector3d& d3) {
    const Eigen::Vector3d east = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d north = Eigen::Vector3d::UnitX();
    const bool along_east = std::abs(d3.dot(east)) > std::cos(25 * std::numbers::pi / 180);
    const Eigen::Vector3d& reference = along_east ? north : east;
    const Eigen::Vector3d d1 = (reference - reference.dot(d3) * d3).normalized();
    Eigen::Matrix3d frame;
    frame << d3, d1, d3.cross(d1);
    return frame;
}

double fluid_inside(const SectionProperties& section, const FluidCase& fluid) {
    return fluid.inside == InsideOfPipe::fluid
               ? fluid.density * (section.outer_area - section.metal_area)
               : 0.0;
}

double fluid_displaced(const SectionProperties& section, const FluidCase& fluid) {
    return fluid.density * std::numbers::pi * section.flow_radius * section.flow_radius;
}

double buoyed_weight(const SectionProperties& section, const std::optional<FluidCase>& fluid,
                     double gravity) {
    if (!fluid) return section.mass * gravity;
    const double displaced =
        fluid->inside == InsideOfPipe::fluid ? section.metal_area : section.outer_area;
    return (section.mass - fluid->density * displaced) * gravity;
}

namespace {

/// The bit itself moves and turns with the last node, of whose metal it is; below a motor its rotor
/// turns it.
void add_bit(Scene& scene) {
    SectionProperties& node = scene.mesh.node.back();
    const double per_length = 1 / scene.mesh.cell.back();
    if (!scene.bit.motor) node.polar_inertia += scene.bit.inertia * per_length;
    const double mass = scene.bit.mass * per_length;
    const double area = node.metal_area * mass / node.mass;
    node.mass += mass;
    node.metal_area += area;
    node.outer_area += area;
    scene.lateral_mass.back() += mass;
}

Scene scene_of(const Case& input) {
    Scene scene;
    scene.fluid = input.fluid;
    scene.contact = input.contact;
    scene.side_force_window = input.output.side_force_window;
    scene.damping = input.damping;
    scene.head = input.head;
    scene.bit = input.bit;
    scene.local_steps = input.run.local_steps;
    scene.gravity = input.gravity;
    if (input.well) set_well(scene, *input.well);

    const WellCrossSection mouth =
        scene.well ? scene.well->at(scene.well->measured_depth_start())
                   : WellCrossSection{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 0, 0};
    scene.head_position = input.head.position.value_or(mouth.axis);
    scene.head_frame = frame_along(input.head.direction.value_or(mouth.direction).normalized());
    scene.mesh =
        mesh_string(scene.well ? with_toolfaces_from_d1(input.string, *scene.well, scene.head_frame)
                               : input.string,
                    input.mesh, lumping_of(input));
    scene.segments = static_cast<int>(scene.mesh.length.size());
    scene.features = features_of(input, scene.well, scene.mesh);
    scene.initial_strain = initial_strains(scene, input.initial);
    scene.initial_nodes = initial_nodes(scene, input.initial);
    scene.head_position += input.initial.offset;
    for (Eigen::Vector3d& position : scene.initial_nodes.position)
        position += input.initial.offset;

    scene.lateral_mass = lateral_masses(scene);
    if (scene.well) set_wall(scene);
    scene.inertia = rotary_inertias(scene, input);
    add_bit(scene);
    for (const SectionProperties& node : scene.mesh.node)
        scene.weight.push_back(buoyed_weight(node, input.fluid, input.gravity));
    if (const auto note = note_on_braked_spin(scene)) scene.notes.push_back(*note);
    for (const double s : scene.mesh.lost)
        scene.notes.push_back(note_on_lost_contact(s));
    return scene;
}

}  // namespace

Scene build_scene(const Case& input) {
    try {
        return scene_of(input);
    } catch (const std::invalid_argument& error) {
        throw InputError({input.path.string()}, error.what());
    }
}

Scene build_static_scene(Case input) {
    input.run.integrator = IntegratorKind::leapfrog;
    return build_scene(input);
}

}  // namespace drillstrand
