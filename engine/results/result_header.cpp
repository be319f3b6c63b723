#include "drillstrand/result_file.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

namespace {

/// The well with what [contact] says of the walls of its sections.
WellCase with_walls(WellCase well, const ContactCase& contact) {
    for (WellSectionCase& section : well.sections) {
        section.static_friction = section.static_friction.value_or(contact.static_friction);
        section.dynamic_friction = section.dynamic_friction.value_or(contact.dynamic_friction);
        section.normal_stiffness = section.normal_stiffness.value_or(contact.normal_stiffness);
    }
    return well;
}

}  // namespace

ResultHeader result_header(const Case& input, const Scene& scene) {
    ResultHeader header;
    header.title = input.title;
    header.case_text = input.text;
    header.integrator =
        input.run.integrator == IntegratorKind::leapfrog ? "leapfrog" : "dormand-prince";
    header.node_s = scene.mesh.node_s;
    header.segment_s = scene.mesh.segment_s;
    header.cell = scene.mesh.cell;
    header.weight = scene.weight;
    for (const SectionProperties& section : scene.mesh.node) {
        header.mass.push_back(section.mass);
        header.outer_radius.push_back(section.outer_radius);
        header.polar_inertia.push_back(section.polar_inertia);
    }
    for (const SectionProperties& section : scene.mesh.segment) {
        header.metal_area.push_back(section.metal_area);
        header.yield_tension.push_back(section.yield.axial);
        header.yield_bending.push_back(section.yield.bending);
        header.yield_torque.push_back(section.yield.torsion);
    }
    double from = 0;
    for (const Component& component : input.string.components) {
        header.component_name.push_back(component.name);
        header.component_start.push_back(from);
        header.component_end.push_back(from += component.length);
    }
    if (input.well) header.well = with_walls(*input.well, input.contact);
    return header;
}

}  // namespace drillstrand
