#include "statics/tripped_string.hpp"

#include <algorithm>
#include <cmath>

#include "drillstrand/hydraulics.hpp"
#include "rod/bit.hpp"

namespace drillstrand {

namespace {

/// Takes pipe from the upper end of a component, or adds some.
void cut_above(Component& component, double excess) {
    component.length -= excess;
    const auto follow = [&](auto& part) {
        if (!part) return;
        part->position -= excess;
        if (part->position < 0) part.reset();
    };
    follow(component.contact);
    follow(component.bend);
    follow(component.eccentric);
    follow(component.jar);
}

/// The lower part of a string of that length, or the string with a longer top component.
StringCase string_of_length(const StringCase& string, double length) {
    StringCase result = string;
    double excess = total_length(string) - length;
    auto top = result.components.begin();
    while (top + 1 != result.components.end() && excess >= top->length) {
        excess -= top->length;
        ++top;
    }
    result.components.erase(result.components.begin(), top);
    cut_above(result.components.front(), excess);
    return result;
}

StringMotion string_motion(TorqueDragMotion motion) {
    switch (motion) {
        case TorqueDragMotion::tripping_in:
            return StringMotion::tripping_in;
        case TorqueDragMotion::tripping_out:
            return StringMotion::tripping_out;
        case TorqueDragMotion::sliding:
            return StringMotion::sliding;
        case TorqueDragMotion::rotating:
            return StringMotion::rotating;
        case TorqueDragMotion::drilling:
            break;
    }
    return StringMotion::drilling;
}

SoftLoad load_at_bit(const Scene& scene, double bit_depth, const EquilibriumOptions& options) {
    if (!options.bit_loads) return {};
    const Eigen::Vector3d direction = scene.well->at(bit_depth).direction;
    const BitMotion motion{frame_along(direction), direction, options.motion.rotation_rate};
    const Vector6 stress = Bit(scene).stress(motion, options.load_time);
    return {stress[3], -stress[0]};
}

/// Mud in motion along the string; the jets push on its end.
void set_mud(SoftString& string, const Scene& scene, const MudMotion& motion) {
    if (motion.is_rest()) return;
    const Hydraulics mud = hydraulics_of(scene, motion);
    for (const double s : scene.mesh.node_s)
        string.mud.depth.push_back(scene.well->measured_depth_start() + s);
    string.mud.load = mud.axial_load;
    string.mud.load.back() += mud.jet_force / scene.mesh.cell.back();
    string.at_bit.tension -= mud.jet_force;
}

}  // namespace

Case case_at_depth(const Case& input, double bit_depth) {
    const double length = bit_depth - input.well->survey.front().measured_depth;
    Case result = input;
    result.string = string_of_length(input.string, length);
    if (input.mesh.segments > 0) {
        const double segment = total_length(input.string) / input.mesh.segments;
        result.mesh.segments = std::max(1, static_cast<int>(std::lround(length / segment)));
    }
    result.head.position.reset();
    result.head.direction.reset();
    result.initial = {};
    if (const auto& friction = input.torque_drag.friction) {
        result.contact.static_friction = *friction;
        result.contact.dynamic_friction = *friction;
        for (WellSectionCase& section : result.well->sections)
            section.static_friction = section.dynamic_friction = *friction;
    }
    return result;
}

const Component& component_at(const StringCase& string, double s) {
    double end = 0;
    for (const Component& component : string.components) {
        end += component.length;
        if (s < end) return component;
    }
    return string.components.back();
}

EquilibriumOptions tripping_options(const Case& at_depth, TorqueDragMotion motion) {
    Case moving = at_depth;
    moving.equilibrium = {.motion = string_motion(motion), .axial_speed = {}, .rotation = {}};
    return equilibrium_options(moving);
}

SoftString soft_string(const Case& at_depth, const Scene& scene,
                       const EquilibriumOptions& options) {
    SoftString result;
    double depth = scene.well->measured_depth_start();
    for (const Component& component : at_depth.string.components) {
        const SectionProperties section =
            section_properties(component, at_depth.string.shear_coefficient);
        const double weight = buoyed_weight(section, at_depth.fluid, at_depth.gravity);
        result.stretches.push_back(
            {depth, depth + component.length, weight, touching_radius(component)});
        depth += component.length;
    }
    for (const SectionFriction& section : scene.section_friction)
        result.friction.push_back(section.slide);
    result.motion = options.motion;
    result.at_bit = load_at_bit(scene, depth, options);
    result.down = scene.down;
    set_mud(result, scene, mud_motion(scene, options.trip_speed));
    return result;
}

}  // namespace drillstrand
