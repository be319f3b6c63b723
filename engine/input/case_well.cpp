#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"
#include "input/survey.hpp"
#include "input/tortuosity.hpp"
#include "input/wording.hpp"
#include "input/written.hpp"

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
    from.fail(fmt::format("is {}; expected {}{}, where the {}", length_text(stated),
                          is_first ? "at most " : "", length_text(start),
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
        to.fail(fmt::format("is {}; expected more than {}, where the section starts",
                            length_text(section.to), length_text(start)));
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

/// The stations of the survey, and what the case says of the well above them.
std::vector<SurveyStation> read_stations(const Table& table, const std::filesystem::path& folder) {
    const Value file = table.require("survey", "the name of a CSV file, or of WITSML in .xml");
    Survey survey = read_survey(folder / file.text(), file.where());
    const std::optional<Value> above = table.find("tie_in");
    const bool starts_below = survey.stations.front().measured_depth > 0;
    if (above) {
        const TieIn meaning =
            above->choice<TieIn>({{"vertical", TieIn::vertical}, {"start", TieIn::start}});
        if (!starts_below)
            above->fail(
                "has no effect; expected it with a survey that starts "
                "below 0");
        tie_in(survey, meaning);
    } else if (starts_below) {
        throw InputError(survey.start,
                         fmt::format("the survey starts at md {}; expected a station at 0, or in "
                                     "[well] tie_in = \"vertical\" (a vertical station at 0 is "
                                     "added) or \"start\" (the well starts there)",
                                     survey.start_depth));
    }
    return survey.stations;
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

/// The widest part of a component and what it is called.
struct Widest {
    const char* what;
    double diameter;
};

Widest widest_of(const Component& component) {
    Widest widest{"an outer diameter", component.outer_diameter};
    if (component.joints && component.joints->outer_diameter > widest.diameter)
        widest = {"tool joints", component.joints->outer_diameter};
    if (component.contact && component.contact->diameter > widest.diameter)
        widest = {"a contact diameter", component.contact->diameter};
    return widest;
}

/// Throws InputError where a component between two measured depths meets a section of the well
/// that it does not fit into, but for an interference (m).
void check_diameter(const WellCase& well, double top, double bottom, const std::string& name,
                    const Widest& widest, double interference, const SourceLocation& where) {
    double from = well.survey.front().measured_depth;
    for (std::size_t k = 0; k < well.sections.size(); ++k) {
        const WellSectionCase& section = well.sections[k];
        const bool last = k + 1 == well.sections.size();
        const double to = last ? std::numeric_limits<double>::infinity() : section.to;
        const double rounding = length_rounding * bottom;
        const double diameter = least_diameter(section, from, top, bottom);
        if (top < to - rounding && bottom > from + rounding &&
            widest.diameter > diameter + interference) {
            throw InputError(
                where,
                fmt::format("{} has {} of {}; expected at most {}, the diameter of the well from "
                            "{} to {}{}",
                            name, widest.what, length_text(widest.diameter),
                            length_text(diameter + interference), length_text(std::max(top, from)),
                            length_text(std::min(bottom, to)),
                            interference > 0 ? " and contact.interference" : ""));
        }
        from = to;
    }
}

}  // namespace

std::optional<WellCase> read_well(const Table& root, const std::filesystem::path& folder) {
    const std::optional<Value> value = root.find("well");
    if (!value) return std::nullopt;
    const Table table(*value, {"survey", "tie_in", "diameter", "section", "tortuosity"});
    table.refuse_both("diameter", "section");

    WellCase well;
    well.survey = read_stations(table, folder);
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

void check_fit(const WellCase& well, const StringInput& input, const HeadCase& head,
               double interference) {
    const double start = well.survey.front().measured_depth;
    const double well_length = well.survey.back().measured_depth - start;
    const double string_length = total_length(input.string);
    if (string_length > well_length * (1 + length_rounding)) {
        throw InputError(input.where,
                         fmt::format("the string is {} long; expected at most {}, "
                                     "the length of the surveyed well",
                                     length_text(string_length), length_text(well_length)));
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
            check_diameter(well, top, bottom, name, widest_of(component), interference, where);
        }
        top = bottom;
    }
}

void check_fit_at(const WellCase& well, const StringInput& input, double interference,
                  double bit_depth, const SourceLocation& where) {
    const double start = well.survey.front().measured_depth;
    double bottom = bit_depth;
    for (std::size_t k = input.string.components.size(); k-- > 0 && bottom > start;) {
        const Component& component = input.string.components[k];
        const double top = k == 0 ? start : std::max(start, bottom - component.length);
        const std::string name =
            fmt::format("with the bit at {}, {}", length_text(bit_depth), describe(k, component));
        check_diameter(well, top, bottom, name, widest_of(component), interference, where);
        bottom = top;
    }
}

}  // namespace drillstrand
