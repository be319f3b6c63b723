#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"
#include "input/survey.hpp"
#include "input/tortuosity.hpp"
#include "input/wording.hpp"

namespace drillstrand {

namespace {

// Sums of component lengths in feet differ from depths in feet by rounding.
constexpr double length_rounding = 1e-9;

constexpr std::size_t most_sections = 1000;

/// A section may say where it starts, which is where the one before ends.
void check_start(const Value& from, double start, bool is_first) {
    const double stated = from.quantity(dimension::length, plausible::coordinate);
    const double rounding = length_rounding * std::max(std::abs(stated), 1.0);
    if (is_first ? stated <= start + rounding : std::abs(stated - start) <= rounding) return;
    from.fail(fmt::format("is {:.9g} m; expected {}{:.9g} m, where the {}", stated,
                          is_first ? "at most " : "", start,
                          is_first ? "survey starts" : "section before ends"));
}

/// One diameter, or [at the start, at the end].
void read_diameter(const Value& value, WellSectionCase& section) {
    if (!value.is_list()) {
        section.diameter = value.quantity(dimension::length, plausible::diameter);
        return;
    }
    const std::vector<Value> ends = value.elements("a length or [from, to]");
    if (ends.size() != 2)
        value.fail(fmt::format("has {} entries; expected a length or [from, to]", ends.size()));
    section.diameter = ends[0].quantity(dimension::length, plausible::diameter);
    section.end_diameter = ends[1].quantity(dimension::length, plausible::diameter);
}

/// What the wall of a section has of its own; the rest is as [contact] has it.
void read_wall(const Table& table, const ContactCase& contact, WellSectionCase& section) {
    const std::optional<Value> sticking = table.find("static_friction");
    const std::optional<Value> sliding = table.find("dynamic_friction");
    if (sticking || sliding) {
        section.static_friction = sticking ? read_friction(*sticking) : contact.static_friction;
        section.dynamic_friction =
            read_dynamic_friction(sliding, *section.static_friction, contact.dynamic_friction);
    }
    if (const std::optional<Value> stiffness = table.find("normal_stiffness"))
        section.normal_stiffness =
            stiffness->quantity(dimension::pressure, plausible::wall_stiffness);
}

WellSectionCase read_section(const Value& value, const ContactCase& contact, double start,
                             bool is_first) {
    const Table table(value, {"name", "from", "to", "diameter", "static_friction",
                              "dynamic_friction", "normal_stiffness"});
    WellSectionCase section;
    if (const std::optional<Value> name = table.find("name")) section.name = name->text();
    if (const std::optional<Value> from = table.find("from")) check_start(*from, start, is_first);
    const Value to = table.require("to", "the measured depth of the section's end");
    section.to = to.quantity(dimension::length, plausible::coordinate);
    if (section.to <= start) {
        to.fail(fmt::format("is {:.9g} m; expected more than {:.9g} m, where the section starts",
                            section.to, start));
    }
    read_diameter(table.require("diameter", "the diameter of the hole"), section);
    read_wall(table, contact, section);
    return section;
}

std::vector<WellSectionCase> read_sections(const Value& list, const ContactCase& contact,
                                           double start) {
    std::vector<WellSectionCase> sections;
    const std::vector<Value> values = list.elements("a list of tables [[well.section]]");
    if (values.size() > most_sections)
        list.fail(
            fmt::format("has {} sections; expected at most {}", values.size(), most_sections));
    for (const Value& value : values) {
        const bool is_first = sections.empty();
        sections.push_back(
            read_section(value, contact, is_first ? start : sections.back().to, is_first));
    }
    if (sections.empty()) list.fail("is empty; expected at least one section");
    return sections;
}

/// The least diameter of a section that starts at `from`, between two measured depths.
double least_diameter(const WellSectionCase& section, double from, double top, double bottom) {
    if (!section.end_diameter) return section.diameter;
    const auto at = [&](double depth) {
        const double share = std::clamp((depth - from) / (section.to - from), 0.0, 1.0);
        return section.diameter + share * (*section.end_diameter - section.diameter);
    };
    return std::min(at(top), at(bottom));
}

std::string describe(std::size_t index, const Component& component) {
    if (component.name.empty()) return fmt::format("component {}", index + 1);
    return fmt::format("component {} ({})", index + 1, in_quotes(component.name));
}

/// Throws InputError where a component between two measured depths meets a section of the well
/// that it does not fit into.
void check_diameter(const WellCase& well, double top, double bottom, const std::string& name,
                    double outer_diameter, const SourceLocation& where) {
    double from = well.survey.front().measured_depth;
    for (std::size_t k = 0; k < well.sections.size(); ++k) {
        const WellSectionCase& section = well.sections[k];
        const bool last = k + 1 == well.sections.size();
        const double to = last ? std::numeric_limits<double>::infinity() : section.to;
        const double rounding = length_rounding * bottom;
        const double diameter = least_diameter(section, from, top, bottom);
        if (top < to - rounding && bottom > from + rounding && outer_diameter >= diameter) {
            throw InputError(
                where,
                fmt::format(
                    "{} has an outer diameter of {:.9g} m; expected less than {:.9g} m, the "
                    "diameter of the well from {:.9g} m to {:.9g} m",
                    name, outer_diameter, diameter, std::max(top, from), std::min(bottom, to)));
        }
        from = to;
    }
}

}  // namespace

std::optional<WellCase> read_well(const Table& root, const std::filesystem::path& folder) {
    const std::optional<Value> value = root.find("well");
    if (!value) return std::nullopt;
    const Table table(*value, {"survey", "diameter", "section", "tortuosity"});
    table.refuse_both("diameter", "section");

    WellCase well;
    const Value survey = table.require("survey", "the name of a CSV file");
    well.survey = read_survey(folder / survey.text(), survey.where());
    if (const std::optional<Value> tortuosity = table.find("tortuosity"))
        well.survey = with_tortuosity(well.survey, read_tortuosity(*tortuosity, well.survey));
    if (const std::optional<Value> sections = table.find("section")) {
        well.sections =
            read_sections(*sections, read_contact(root), well.survey.front().measured_depth);
    } else {
        const Value diameter =
            table.require("diameter", "a length such as \"12.25 in\", or [[well.section]]");
        well.sections = {{well.survey.back().measured_depth,
                          diameter.quantity(dimension::length, plausible::diameter)}};
    }
    return well;
}

std::optional<FluidCase> read_fluid(const Table& root) {
    const std::optional<Value> value = root.find("fluid");
    if (!value) return std::nullopt;
    const Table table(*value,
                      {"density", "viscosity", "inside", "drag", "regime", "drag_coefficient",
                       "contact_drag", "axial_drag", "film", "added_mass"});
    FluidCase fluid;
    fluid.density = table.require("density", "a density such as \"10 ppg\"")
                        .quantity(dimension::density, plausible::density);
    fluid.drag = table.boolean("drag", fluid.drag);
    // without a well the fluid is still: it buoys the string and does not drag it
    const bool drags = fluid.drag && root.find("well");
    if (drags || table.find("viscosity")) {
        fluid.viscosity =
            table.require("viscosity", "a viscosity such as \"1 cP\", or drag = false")
                .quantity(dimension::viscosity, plausible::viscosity);
    }
    fluid.inside = table.choice<InsideOfPipe>(
        "inside", fluid.inside, {{"fluid", InsideOfPipe::fluid}, {"empty", InsideOfPipe::empty}});
    fluid.regime = table.choice<FlowRegime>(
        "regime", fluid.regime,
        {{"inertial", FlowRegime::inertial}, {"laminar", FlowRegime::laminar}});
    fluid.drag_coefficient =
        table.number("drag_coefficient", fluid.drag_coefficient, plausible::drag_coefficient);
    if (fluid.regime == FlowRegime::laminar)
        if (const std::optional<Value> unused = table.find("drag_coefficient"))
            unused->fail("has no effect; expected it with regime = \"inertial\"");
    fluid.contact_drag = table.boolean("contact_drag", fluid.contact_drag);
    fluid.axial_drag = table.choice<AxialDrag>(
        "axial_drag", fluid.axial_drag,
        {{"eccentric", AxialDrag::eccentric}, {"concentric", AxialDrag::concentric}});
    fluid.film = table.number("film", fluid.film, {.low = 1e-6, .high = 1, .high_open = true});
    fluid.added_mass = table.boolean("added_mass", fluid.added_mass);
    return fluid;
}

void check_fit(const WellCase& well, const StringInput& input, const HeadCase& head) {
    const double start = well.survey.front().measured_depth;
    const double well_length = well.survey.back().measured_depth - start;
    const double string_length = total_length(input.string);
    if (string_length > well_length * (1 + length_rounding)) {
        throw InputError(input.where,
                         fmt::format("the string is {:.9g} m long; expected at most {:.9g} m, "
                                     "the length of the surveyed well",
                                     string_length, well_length));
    }
    const bool head_at_start = !head.position || head.position->isZero(0);
    double top = start;
    for (std::size_t k = 0; k < input.string.components.size(); ++k) {
        const Component& component = input.string.components[k];
        const SourceLocation& where = input.component_places[k];
        const std::string name = describe(k, component);
        if (component.outer_diameter == 0) {
            throw InputError(where,
                             fmt::format("{} has no outer_diameter; expected one in a well", name));
        }
        const double bottom = top + component.length;
        if (head_at_start) {
            check_diameter(well, top, bottom, name, component.outer_diameter, where);
        }
        top = bottom;
    }
}

void check_fit_at(const WellCase& well, const StringInput& input, double bit_depth,
                  const SourceLocation& where) {
    const double start = well.survey.front().measured_depth;
    double bottom = bit_depth;
    for (std::size_t k = input.string.components.size(); k-- > 0 && bottom > start;) {
        const Component& component = input.string.components[k];
        const double top = k == 0 ? start : std::max(start, bottom - component.length);
        const std::string name =
            fmt::format("with the bit at {:.9g} m, {}", bit_depth, describe(k, component));
        check_diameter(well, top, bottom, name, component.outer_diameter, where);
        bottom = top;
    }
}

}  // namespace drillstrand
