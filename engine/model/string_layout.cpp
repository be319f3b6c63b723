#include "model/string_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace drillstrand {

namespace {

double ring(double outer, double inner) {
    return std::numbers::pi / 4 * (outer - inner) * (outer + inner);
}

void refuse_too_many_pieces(const StringCase& string) {
    constexpr double most = 1e6;
    double pieces = 0;
    for (const Component& component : string.components)
        pieces += component.joints ? component.length / component.joints->spacing : 1;
    if (pieces > most)
        throw std::invalid_argument(fmt::format(
            "the string has {:.0f} pieces of pipe between tool joints; expected at most {:.0f}",
            pieces, most));
}

}  // namespace

int pieces_of(const Component& component) {
    return std::max(1, static_cast<int>(std::lround(component.length / component.joints->spacing)));
}

Component tool_joint(const Component& component) {
    Component joint = component;
    joint.outer_diameter = component.joints->outer_diameter;
    joint.inner_diameter = component.joints->inner_diameter;
    joint.material_density = component.material_density.value_or(steel_density);
    joint.linear_density =
        *joint.material_density * ring(joint.outer_diameter, joint.inner_diameter);
    joint.joints.reset();
    return joint;
}

Component pipe_body(const Component& component) {
    Component body = component;
    body.material_density = component.material_density.value_or(steel_density);
    body.joints.reset();
    const double piece = component.length / pieces_of(component);
    const double joint = component.joints->length;
    const double mass =
        component.linear_density * piece - tool_joint(component).linear_density * joint;
    body.linear_density = mass / (piece - joint);
    const double metal = ring(component.outer_diameter, component.inner_diameter);
    if (joint > 0 && body.linear_density < 0.5 * *body.material_density * metal)
        throw std::invalid_argument(fmt::format(
            "linear_density of {:.9g} kg/m leaves {:.3g} kg/m for the pipe between tool joints, "
            "whose steel weighs {:.3g} kg/m; expected the mean with tool joints",
            component.linear_density, body.linear_density, *body.material_density * metal));
    return body;
}

StringLayout::StringLayout(const StringCase& string) : boundary{0.0}, component_boundary{0.0} {
    refuse_too_many_pieces(string);
    for (const Component& component : string.components) {
        const double start = length();
        add_pipe(component, string.shear_coefficient);
        component_boundary.push_back(length());
        if (const auto& contact = component.contact)
            places.push_back({start + contact->position, contact->diameter / 2, contact});
        if (const auto& bend = component.bend)
            kinks.push_back({start + bend->position, bend->angle, bend->toolface});
        if (const auto& mass = component.eccentric)
            eccentric.push_back({start + mass->position, mass->moment});
        if (const auto& law = component.jar) {
            if (jar) throw std::invalid_argument("the string has two jars; expected at most one");
            jar = {start + law->position, *law};
        }
    }
    const auto above = [](const auto& one, const auto& other) { return one.s < other.s; };
    std::stable_sort(places.begin(), places.end(), above);
}

void StringLayout::add(double part, const SectionProperties& section, double radius_of_joints) {
    boundary.push_back(boundary.back() + part);
    property.push_back(section);
    joint_radius.push_back(radius_of_joints);
}

void StringLayout::add_pipe(const Component& component, double shear_coefficient) {
    if (!component.joints) {
        add(component.length, section_properties(component, shear_coefficient), 0);
        return;
    }
    const SectionProperties body = section_properties(pipe_body(component), shear_coefficient);
    SectionProperties joint = section_properties(tool_joint(component), shear_coefficient);
    joint.flow_radius = body.flow_radius;
    const double radius = component.joints->outer_diameter / 2;
    const double half = component.joints->length / 2;
    const int pieces = pieces_of(component);
    const double piece = component.length / pieces;
    const double start = length();
    for (int i = 0; i <= pieces; ++i)
        places.push_back(
            {start + component.length * (static_cast<double>(i) / pieces), radius, {}});
    for (int i = 0; i < pieces; ++i) {
        if (half > 0) add(half, joint, radius);
        add(piece - 2 * half, body, radius);
        if (half > 0) add(half, joint, radius);
    }
    boundary.back() = start + component.length;
}

}  // namespace drillstrand
