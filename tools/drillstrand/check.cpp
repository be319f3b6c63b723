/// drillstrand check: prints the scene of a case in plain words, with the cost of its run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_of.hpp"
#include "commands.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/hydraulics.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/simulation.hpp"
#include "drillstrand/units.hpp"
#include "drillstrand/well.hpp"
#include "step_estimate.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

double in_feet(double metres) {
    return metres / unit_factor("ft", dimension::length);
}

double in_degrees(double angle) {
    return angle / unit_factor("deg", dimension::angle);
}

std::string length_text(double metres) {
    return fmt::format("{:.6g} m ({:.5g} ft)", metres, in_feet(metres));
}

std::string diameter_text(double metres) {
    return fmt::format("{:.5g} m ({:.4g} in)", metres,
                       metres / unit_factor("in", dimension::length));
}

std::string force_text(double newtons) {
    return fmt::format("{:.4g} kN ({:.4g} klbf)", newtons / unit_factor("kN", dimension::force),
                       newtons / unit_factor("klbf", dimension::force));
}

/// One line of the report: a name and what there is to say.
void line(const std::string& name, const std::string& text) {
    fmt::print("  {:<16} {}\n", name, text);
}

/// The larger of |value| over a schedule (piecewise linear, so at one of its points).
double largest(const ScalarSchedule& schedule) {
    double most = 0;
    for (const double value : schedule.values())
        most = std::max(most, std::abs(value));
    return most;
}

double largest(const VectorSchedule& schedule) {
    double most = 0;
    for (const Eigen::Vector3d& value : schedule.values())
        most = std::max(most, value.norm());
    return most;
}

std::string range_text(const std::vector<SectionProperties>& sections,
                       double SectionProperties::*property, const char* unit) {
    double least = sections.front().*property;
    double most = least;
    for (const SectionProperties& section : sections) {
        least = std::min(least, section.*property);
        most = std::max(most, section.*property);
    }
    // Means over segments differ in the last digit.
    if (most - least <= 1e-9 * most) return fmt::format("{:.4g} {}", least, unit);
    return fmt::format("{:.4g} to {:.4g} {}", least, most, unit);
}

void print_component(const Component& component) {
    std::string text = length_text(component.length);
    if (component.outer_diameter > 0)
        text += fmt::format(", {} outside, {} inside", diameter_text(component.outer_diameter),
                            diameter_text(component.inner_diameter));
    text += fmt::format(", {:.5g} kg/m ({:.4g} lb/ft)", component.linear_density,
                        component.linear_density / unit_factor("lb/ft", dimension::linear_density));
    line("  " + component.name, text);
}

void print_string(const Case& input, const Scene& scene) {
    const StringMesh& mesh = scene.mesh;
    double mass = 0;
    double buoyed = 0;
    for (std::size_t k = 0; k < mesh.cell.size(); ++k) {
        mass += mesh.node[k].mass * mesh.cell[k];
        buoyed += scene.weight[k] * mesh.cell[k];
    }
    fmt::print("String\n");
    line("length", fmt::format("{}, {} component{}, head to bit:", length_text(mesh.node_s.back()),
                               input.string.components.size(),
                               input.string.components.size() == 1 ? "" : "s"));
    for (const Component& component : input.string.components)
        print_component(component);
    line("weight",
         fmt::format("{} in air, {} buoyed", force_text(mass * input.gravity), force_text(buoyed)));
    line("axial", range_text(mesh.segment, &SectionProperties::axial_stiffness, "N"));
    line("shear", range_text(mesh.segment, &SectionProperties::shear_stiffness, "N"));
    line("bending", range_text(mesh.segment, &SectionProperties::bending_stiffness, "N m2"));
    line("torsion", range_text(mesh.segment, &SectionProperties::torsional_stiffness, "N m2"));
}

double largest_curvature(const WellCase& well) {
    const std::vector<double> doglegs = dogleg_severities(well.survey);
    return doglegs.empty() ? 0 : *std::max_element(doglegs.begin(), doglegs.end());
}

/// Radius of the well less that of the pipe at each node, with the string lying in the well (m).
std::vector<double> clearances(const Scene& scene, double SectionProperties::*radius) {
    const Well& well = *scene.well;
    const std::size_t arc = well.find_arc(scene.head_position, well.arc_at(0));
    const double head_depth = well.project(scene.head_position, arc).measured_depth;
    std::vector<double> clearances;
    for (std::size_t k = 0; k < scene.mesh.node_s.size(); ++k)
        clearances.push_back(well.at(head_depth + scene.mesh.node_s[k]).radius -
                             scene.mesh.node[k].*radius);
    return clearances;
}

std::string friction_text(const FrictionCoefficients& fixed, const FrictionCoefficients& slide) {
    return fmt::format("static {:.3g} axial {:.3g} azimuthal, dynamic {:.3g} and {:.3g}",
                       fixed.axial, fixed.azimuthal, slide.axial, slide.azimuthal);
}

/// A section of the well, with what it has of its own.
void print_section(const WellSectionCase& section) {
    std::string text = diameter_text(section.diameter);
    if (section.end_diameter) text += " going over to " + diameter_text(*section.end_diameter);
    if (std::isfinite(section.to))
        text += (section.end_diameter ? " at " : " to ") + length_text(section.to);
    if (!section.name.empty()) text += fmt::format(", {}", section.name);
    if (section.static_friction)
        text += ", friction " + friction_text(*section.static_friction, *section.dynamic_friction);
    if (section.normal_stiffness) text += fmt::format(", {:.4g} Pa", *section.normal_stiffness);
    line("diameter", text);
}

void print_well(const Case& input, const Scene& scene) {
    fmt::print("Well\n");
    if (!input.well) {
        line("none", "no contact, no fluid");
        return;
    }
    const std::vector<SurveyStation>& survey = input.well->survey;
    const auto steepest = std::max_element(
        survey.begin(), survey.end(),
        [](const auto& left, const auto& right) { return left.inclination < right.inclination; });
    const std::vector<double> gaps = clearances(scene, &SectionProperties::outer_radius);
    const auto tightest = std::min_element(gaps.begin(), gaps.end());
    line("survey", fmt::format("{} stations, {} to {}", survey.size(),
                               length_text(survey.front().measured_depth),
                               length_text(survey.back().measured_depth)));
    line("vertical depth",
         length_text(station_positions(survey).back().z()) + " between its first and last station");
    line("inclination", fmt::format("up to {:.4g} deg, at {}", in_degrees(steepest->inclination),
                                    length_text(steepest->measured_depth)));
    const double sharpest = largest_curvature(*input.well);
    line("dogleg", fmt::format("up to {:.3g} deg/30 m ({:.3g} deg/100 ft)",
                               sharpest / unit_factor("deg/30m", dimension::curvature),
                               sharpest / unit_factor("deg/100ft", dimension::curvature)));
    for (const WellSectionCase& section : input.well->sections)
        print_section(section);
    line("clearance",
         fmt::format("at least {:.4g} m, {:.5g} m from the head", *tightest,
                     scene.mesh.node_s[static_cast<std::size_t>(tightest - gaps.begin())]));
}

std::string rheology_text(const FluidCase& fluid) {
    if (fluid.is_newtonian())
        return fmt::format("{:.4g} Pa s ({:.4g} cP)", fluid.viscosity,
                           fluid.viscosity / unit_factor("cP", dimension::viscosity));
    return fmt::format("{:.4g} Pa + {:.4g} Pa s^n rate^{:.4g}", fluid.yield_stress, fluid.viscosity,
                       fluid.flow_index);
}

/// Pressures of the pumped mud, with the string where it lies.
void print_hydraulics(const Scene& scene) {
    const MudMotion motion = mud_motion(scene);
    if (motion.is_rest()) return;
    const Hydraulics flow = hydraulics_of(scene, motion);
    line("pump", fmt::format("{:.4g} L/min ({:.4g} gpm), {:.4g} MPa at the standpipe",
                             motion.flow_rate / unit_factor("L/min", dimension::flow_rate),
                             motion.flow_rate / unit_factor("gpm", dimension::flow_rate),
                             flow.standpipe_pressure / megapascal()));
    line("pressure losses",
         fmt::format("{:.4g} MPa inside ({:.0f} % turbulent), {:.4g} at the bit, {:.4g} in the "
                     "annulus ({:.0f} % turbulent)",
                     flow.inside_loss / megapascal(), 100 * flow.turbulent_inside,
                     flow.bit_loss / megapascal(), flow.annulus_loss / megapascal(),
                     100 * flow.turbulent_annulus));
    line("mud at the bit", fmt::format("{:.4g} MPa, equivalent to {:.5g} kg/m3; the flow lifts the "
                                       "string by {}",
                                       flow.bit_pressure / megapascal(), flow.equivalent_density,
                                       force_text(-flow.axial_force)));
}

void print_fluid(const Scene& scene) {
    if (!scene.fluid) return;
    line("fluid",
         fmt::format("{:.5g} kg/m3 ({:.4g} ppg), {}, {} the pipe, {}", scene.fluid->density,
                     scene.fluid->density / unit_factor("ppg", dimension::density),
                     rheology_text(*scene.fluid),
                     scene.fluid->inside == InsideOfPipe::fluid ? "also inside" : "not inside",
                     scene.features.drag ? "with drag" : "buoyancy only"));
    if (scene.features.drag)
        line("mud", fmt::format("{} drag{}",
                                scene.features.inertial_flow
                                    ? fmt::format("creeping and inertial, drag coefficient {:.3g}",
                                                  scene.fluid->drag_coefficient)
                                    : "creeping",
                                scene.fluid->contact_drag ? ", also in contact" : ""));
    print_hydraulics(scene);
    if (scene.features.fluid_mass) {
        double pipe = 0;
        double sideways = 0;
        for (std::size_t k = 0; k < scene.mesh.node.size(); ++k) {
            pipe += scene.mesh.node[k].mass * scene.mesh.cell[k];
            sideways += scene.lateral_mass[k] * scene.mesh.cell[k];
        }
        line("moving mud",
             fmt::format("sideways {:.3g} times the mass of the pipe moves", sideways / pipe));
    }
}

std::string wall_text(const ContactCase& contact) {
    const std::string stiffness = fmt::format("{:.4g} Pa", contact.normal_stiffness);
    if (contact.normal_law == NormalLaw::hertz)
        return fmt::format("Hertz's law, {}/m^0.5, damping {:.3g} s/m", stiffness,
                           contact.hunt_crossley);
    return contact.restitution
               ? fmt::format("{}, restitution {:.3g}", stiffness, *contact.restitution)
               : fmt::format("{}, damping {:.4g} Pa s", stiffness, contact.normal_damping);
}

/// Whether a section of the well has friction of its own.
bool friction_varies(const Scene& scene) {
    const auto same = [](const FrictionCoefficients& a, const FrictionCoefficients& b) {
        return a.axial == b.axial && a.azimuthal == b.azimuthal;
    };
    return std::any_of(scene.section_friction.begin(), scene.section_friction.end(),
                       [&](const SectionFriction& section) {
                           return !same(section.fixed, scene.contact.static_friction) ||
                                  !same(section.slide, scene.contact.dynamic_friction);
                       });
}

void print_contact(const Scene& scene) {
    if (!scene.features.well) return;
    const ContactCase& contact = scene.contact;
    line("contact", wall_text(contact));
    if (scene.bit.contact_length > 0) {
        line("wall at the bit",
             fmt::format("{:.4g} m more than the cell of its node", scene.bit.contact_length));
    }
    line("friction",
         fmt::format("law {}, {}{}", contact.law == FrictionLaw::paper ? "paper" : "coulomb",
                     friction_text(contact.static_friction, contact.dynamic_friction),
                     friction_varies(scene) ? ", where a section has none of its own" : "") +
             (contact.stribeck_speed > 0
                  ? fmt::format(", falling over {:.3g} m/s", contact.stribeck_speed)
                  : ""));
    line("rolling",
         contact.rolling_creep > 0
             ? fmt::format("friction saturates at a creep of {:.3g}", contact.rolling_creep)
             : "springs stay in the contact");
}

std::string drive_text(const DriveCase& drive) {
    const char* control = drive.control == DriveControl::pi        ? "PI control"
                          : drive.control == DriveControl::tuned   ? "tuned control"
                          : drive.control == DriveControl::matched ? "matched to the pipe"
                                                                   : "stiff";
    std::string text = fmt::format("{}, {:.4g} kg m2", control, drive.inertia);
    if (std::isfinite(drive.torque_limit))
        text += fmt::format(", at most {:.4g} kN m",
                            drive.torque_limit / unit_factor("kN m", dimension::moment));
    if (std::isfinite(drive.power_limit))
        text += fmt::format(", at most {:.4g} kW", 1e-3 * drive.power_limit);
    return text;
}

std::string hoist_text(const HoistCase& hoist) {
    const std::string drum =
        hoist.autodriller ? "autodriller"
        : hoist.hook_load
            ? fmt::format("brake slips at up to {}", force_text(largest(*hoist.hook_load)))
            : fmt::format("block speed up to {:.4g} m/s", largest(hoist.block_speed));
    return fmt::format("{:.4g} kg on {} lines of {:.4g} N/m each, {}", hoist.mass, hoist.lines,
                       hoist.line_stiffness, drum);
}

std::string drilling_text(const BitCase& bit) {
    if (bit.law == BitLaw::cutting)
        return fmt::format("cuts rock of {:.4g} MPa with {} blades",
                           bit.cutting.specific_energy / unit_factor("MPa", dimension::pressure),
                           bit.cutting.blades);
    return fmt::format("cones on {} lobes of {:.4g} mm, rock of {:.4g} MPa", bit.roller_cone.lobes,
                       bit.roller_cone.lobe_height / unit_factor("mm", dimension::length),
                       bit.roller_cone.specific_energy / unit_factor("MPa", dimension::pressure));
}

std::string motor_text(const MotorCase& motor) {
    return fmt::format("{:.4g} kN m stalled, {:.4g} rad/s ({:.4g} rpm) without load",
                       motor.stall_torque / unit_factor("kN m", dimension::moment),
                       motor.no_load_speed,
                       motor.no_load_speed / unit_factor("rpm", dimension::frequency));
}

std::string head_text(const HeadCase& head) {
    if (head.motion == HeadMotion::free)
        return fmt::format("free, force up to {:.4g} N, moment up to {:.4g} N m",
                           largest(head.force), largest(head.moment));
    const double rate = largest(head.rotation);
    std::string text =
        fmt::format("{}, rotation up to {:.4g} rad/s ({:.4g} rpm)",
                    head.motion == HeadMotion::pinned                    ? "pinned in its place"
                    : head.hoist                                         ? "on its hoist"
                    : largest(head.velocity) + largest(head.tilting) > 0 ? "moved"
                                                                         : "held in place",
                    rate, rate / unit_factor("rpm", dimension::frequency));
    if (largest(head.velocity) > 0)
        text += fmt::format(", velocity up to {:.4g} m/s", largest(head.velocity));
    if (largest(head.tilting) > 0)
        text += fmt::format(", tilting at up to {:.4g} rad/s", largest(head.tilting));
    return text;
}

void print_loads(const Scene& scene) {
    fmt::print("Loads and motion\n");
    line("head", head_text(scene.head));
    if (scene.head.drive) line("drive", drive_text(*scene.head.drive));
    if (scene.head.hoist) line("hoist", hoist_text(*scene.head.hoist));
    const BitCase& bit = scene.bit;
    if (largest(bit.weight) > 0)
        line("bit weight", fmt::format("up to {}, along the {}", force_text(largest(bit.weight)),
                                       bit.direction == BitDirection::well ? "well" : "string"));
    if (bit.drills()) line("bit", drilling_text(bit));
    if (bit.motor) line("mud motor", motor_text(*bit.motor));
    if (bit.law == BitLaw::stribeck)
        line("bit torque",
             fmt::format("friction, {:.4g} kN m at rest, {:.4g} kN m at speed",
                         bit.static_torque / unit_factor("kN m", dimension::moment),
                         bit.dynamic_torque / unit_factor("kN m", dimension::moment)));
    else if (bit.friction)
        line("bit torque",
             fmt::format("friction {:.3g} times pi R/4 times the weight", *bit.friction));
    else if (largest(bit.torque) > 0)
        line("bit torque",
             fmt::format("up to {:.4g} kN m ({:.4g} klbf ft)",
                         largest(bit.torque) / unit_factor("kN m", dimension::moment),
                         largest(bit.torque) / unit_factor("klbf ft", dimension::moment)));
    if (largest(bit.force) > 0) line("dead force", fmt::format("{:.4g} N", largest(bit.force)));
    if (largest(bit.dead_moment) > 0)
        line("dead couple", fmt::format("{:.4g} N m", largest(bit.dead_moment)));
    if (largest(bit.moment) > 0)
        line("follower couple", fmt::format("{:.4g} N m", largest(bit.moment)));
    const DampingCase& damping = scene.damping;
    if (damping.internal.any())
        line("internal damping",
             fmt::format("{:.3g} N s/m of stretch, {:.3g} N m s of bending",
                         damping.internal.translation, damping.internal.rotation));
    if (damping.external.any())
        line("external damping",
             fmt::format("{:.3g} N s/m2 of translation, {:.3g} N s of rotation",
                         damping.external.translation, damping.external.rotation));
    if (scene.damping.kelvin_voigt > 0)
        line("material", fmt::format("Kelvin-Voigt damping, {:.4g} s times the rate of strain",
                                     scene.damping.kelvin_voigt));
}

std::string rotary_inertia(const Case& input) {
    if (input.run.integrator == IntegratorKind::leapfrog)
        return "of the sections, at least what is stable and costs no steps";
    return input.mesh.segment_inertia ? "of the sections and of the segments as rigid pieces"
                                      : "of the sections alone";
}

std::string length_range(double least, double most) {
    const bool alike = most - least <= 1e-9 * most;
    return alike ? fmt::format("{:.4g} m", most) : fmt::format("{:.4g} to {:.4g} m", least, most);
}

/// The segments of each component, the step that they would take alone, and what touches there.
/// Only where the mesh follows the string: elsewhere components say nothing about it.
void print_meshes_of_components(const Case& input, const Scene& scene) {
    const std::vector<double> steps = segment_steps(scene);
    const StringMesh& mesh = scene.mesh;
    double end = 0;
    std::size_t k = 0;
    for (const Component& component : input.string.components) {
        end += component.length;
        const std::size_t first = k;
        while (k < mesh.length.size() && mesh.segment_s[k] < end)
            ++k;
        if (k == first) continue;
        const auto part = [&](const std::vector<double>& row) {
            return std::minmax_element(row.begin() + static_cast<std::ptrdiff_t>(first),
                                       row.begin() + static_cast<std::ptrdiff_t>(k));
        };
        const auto [shortest, longest] = part(mesh.length);
        std::string text =
            fmt::format("{} segment{} of {}, step {:.2g} s", k - first, k - first == 1 ? "" : "s",
                        length_range(*shortest, *longest), *part(steps).first);
        if (component.joints)
            text +=
                fmt::format(", tool joints of {}", diameter_text(component.joints->outer_diameter));
        if (component.contact)
            text +=
                fmt::format(", touches with {} on {:.3g} m",
                            diameter_text(component.contact->diameter), component.contact->length);
        if (component.bend)
            text += fmt::format(", bent by {:.3g} deg",
                                component.bend->angle / unit_factor("deg", dimension::angle));
        line("  " + component.name, text);
    }
}

/// Components of which no node tells anything: their mass and stiffness count, their radius does
/// not.
void warn_of_components_without_node(const Case& input, const Scene& scene) {
    double start = 0;
    for (const Component& component : input.string.components) {
        const double end = start + component.length;
        const std::vector<double>& s = scene.mesh.node_s;
        const auto node = std::lower_bound(s.begin(), s.end(), start);
        if (node == s.end() || *node > end)
            fmt::print(
                "Warning: component {} at {:.5g} m along the string lies between nodes: its "
                "diameter touches nothing; a mesh that follows the string (mesh.element_length) "
                "has nodes at its ends\n",
                component.name, start);
        start = end;
    }
}

void print_mesh(const Case& input, const Scene& scene) {
    const auto [least, most] =
        std::minmax_element(scene.mesh.length.begin(), scene.mesh.length.end());
    const bool uniform = *most - *least <= 1e-9 * *most;
    fmt::print("Mesh\n");
    line("segments", uniform
                         ? fmt::format("{} of {:.5g} m", scene.segments, *most)
                         : fmt::format("{} of {:.5g} to {:.5g} m", scene.segments, *least, *most));
    line("rotary inertia", rotary_inertia(input));
    if (input.mesh.segments == 0) print_meshes_of_components(input, scene);
}

void print_cost(const Case& input, const Scene& scene) {
    const StepEstimate estimate = estimate_step(input, scene);
    fmt::print("Run\n");
    if (input.run.duration == 0) {
        line("duration",
             "none given: the case is for commands that do not simulate; for run, "
             "give run.duration");
        line("time step",
             fmt::format("at most about {:.2g} s, for {} ({:.2g} rad/s)", estimate.bound.step,
                         estimate.bound.process, estimate.bound.rate));
        return;
    }
    const FirstSteps first = time_first_steps(input, scene);
    const double more_steps = std::max(estimate.steps, input.run.duration / first.mean_step);
    line("duration",
         fmt::format(
             "{:.6g} s, {}, {} thread{}", input.run.duration,
             input.run.integrator == IntegratorKind::leapfrog ? "leapfrog" : "dormand-prince",
             first.threads, first.threads == 1 ? "" : "s"));
    line(
        "time step",
        fmt::format("at most about {:.2g} s, for {} ({:.2g} rad/s); {:.2g} s in the first {} steps",
                    estimate.bound.step, estimate.bound.process, estimate.bound.rate,
                    first.mean_step, count_text(first.count)));
    for (const std::string& sentence : estimate.substeps)
        line("substeps", sentence);
    line("cost", fmt::format("about {} to {} steps, {} to {} at the speed of the first steps on "
                             "this machine",
                             count_text(estimate.steps), count_text(more_steps),
                             duration_text(estimate.steps * first.seconds_a_step),
                             duration_text(more_steps * first.seconds_a_step)));
}

void warn(const std::string& text) {
    fmt::print("Warning: {}\n", text);
}

/// A helix under compression F has a pitch of sqrt(8 pi^2 EI / F); eight segments draw one turn.
void warn_of_coarse_mesh(const Scene& scene) {
    const double force = largest(scene.bit.weight);
    if (force == 0) return;
    double worst = 0;
    double pitch_there = 0;
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k) {
        const double stiffness = scene.mesh.segment[k].bending_stiffness;
        const double pitch = std::sqrt(8 * std::pow(std::numbers::pi, 2) * stiffness / force);
        if (scene.mesh.length[k] / pitch < worst) continue;
        worst = scene.mesh.length[k] / pitch;
        pitch_there = pitch;
    }
    if (worst > 1.0 / 8)
        warn(
            fmt::format("a segment is {:.3g} m long where a helix under the largest bit weight has "
                        "a pitch of {:.3g} m; segments of at most {:.3g} m would draw it",
                        worst * pitch_there, pitch_there, pitch_there / 8));
}

/// Contact acts at nodes: between them a pipe in a bend cuts the corner by h^2 curvature / 8.
void warn_of_cut_corners(const Case& input, const Scene& scene) {
    if (!input.well) return;
    const double length = *std::max_element(scene.mesh.length.begin(), scene.mesh.length.end());
    const double sagitta = length * length * largest_curvature(*input.well) / 8;
    const std::vector<double> gaps = clearances(scene, &SectionProperties::flow_radius);
    const double clearance = *std::min_element(gaps.begin(), gaps.end());
    constexpr double noticeable = 0.25;
    if (sagitta > noticeable * clearance)
        warn(fmt::format(
            "between nodes the pipe may cut the corner of the sharpest bend by {:.2g} "
            "m, with a clearance of {:.2g} m at the tightest place; more segments would cure it",
            sagitta, clearance));
}

void warn_of_notes(const Scene& scene) {
    for (const std::string& note : scene.notes)
        warn(note);
}

void warn_of_paper_friction(const Scene& scene) {
    if (!scene.features.well || scene.contact.law != FrictionLaw::paper) return;
    warn(
        "contact.law = \"paper\" does not see how the pipe rolls, so that a whirling string can "
        "gain "
        "energy without bound; it is for comparison only, \"coulomb\" has no such fault");
}

/// Whether the string starts on the axis of a well and could start at rest instead.
bool falls_at_the_start(const Case& input, const Scene& scene) {
    const bool is_heavy = std::any_of(scene.weight.begin(), scene.weight.end(),
                                      [](double weight) { return weight != 0; });
    return scene.features.well && is_heavy && input.initial.state == InitialState::coaxial &&
           input.head.motion != HeadMotion::free &&
           input.run.integrator == IntegratorKind::leapfrog;
}

std::size_t segments_of(const Case& input) {
    if (input.mesh.segments > 0) return static_cast<std::size_t>(input.mesh.segments);
    return mesh_string(input.string, input.mesh, Lumping::cells).length.size();
}

/// Whether the equilibrium to start from takes longer to find (0.3 ms a segment) than who checks a
/// case waits.
bool is_long_to_find(const Case& input) {
    constexpr int most_segments = 10'000;
    return input.initial.state == InitialState::equilibrium && segments_of(input) > most_segments;
}

/// The case, coaxial where its equilibrium is long to find.
Case without_long_search(Case input) {
    if (is_long_to_find(input)) input.initial.state = InitialState::coaxial;
    return input;
}

void tell_of_long_search(const Case& input) {
    if (is_long_to_find(input))
        fmt::print(
            "Not checked: whether there is an equilibrium to start from; with {} segments the "
            "search "
            "would take longer than all else\n",
            segments_of(input));
}

/// Weights of drill pipe in tables are often those with tool joints, whose steel displaces more mud
/// and touches the wall elsewhere than the pipe's own section says.
void advise_tool_joints(const Case& input) {
    constexpr double heavier = 1.1;  // than the steel of its section
    constexpr double stiff = 150e9;  // Pa: steel
    constexpr double longer = 30;    // m: more than one piece
    for (const Component& component : input.string.components) {
        if (component.joints || component.material_density || component.outer_diameter == 0 ||
            component.youngs_modulus < stiff || component.length < longer)
            continue;
        const double density =
            component.linear_density / section_properties(component, 1).metal_area;
        if (density > heavier * steel_density)
            fmt::print(
                "Advice: {} weighs {:.0f} kg/m3 over its section; if that is with tool joints, "
                "joint_length and tool_joint_outer_diameter let them touch and displace mud\n",
                component.name.empty() ? "a component" : component.name, density);
    }
}

void advise_equilibrium(const Case& input, const Scene& scene) {
    if (falls_at_the_start(input, scene))
        fmt::print(
            "Advice: the string starts on the axis of the well and falls under its weight at the "
            "start; initial.state = \"equilibrium\" starts it at rest\n");
}

}  // namespace

int check(const CheckOptions& options) {
    const Case input = case_of(options.case_path, options.overrides);
    const Scene scene = starting_scene(without_long_search(input));
    fmt::print("{}: {}\n", options.case_path.string(), input.title);
    print_string(input, scene);
    print_well(input, scene);
    print_fluid(scene);
    print_contact(scene);
    print_loads(scene);
    print_mesh(input, scene);
    print_cost(input, scene);
    warn_of_notes(scene);
    warn_of_coarse_mesh(scene);
    warn_of_components_without_node(input, scene);
    warn_of_cut_corners(input, scene);
    warn_of_paper_friction(scene);
    advise_equilibrium(input, scene);
    advise_tool_joints(input);
    tell_of_long_search(input);
    return done;
}

}  // namespace drillstrand::program
