#include "report_summary.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "drillstrand/units.hpp"
#include "drillstrand/well.hpp"
#include "report_data.hpp"
#include "report_series.hpp"
#include "report_string.hpp"
#include "report_units.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

constexpr double large_energy_residual = 0.01;
const double degree = unit_factor("deg", dimension::angle);  // rad

/// A number in words, in SI and in the field's units.
struct Item {
    std::string id;
    std::string label;
    std::string si;
    std::string field;  ///< empty: as in SI
};

using Items = std::vector<Item>;

Item quantity(const char* id, const char* label, double value, const UnitPair& units,
              const std::string& addition = "") {
    return {id, label, fmt::format("{:.4g} {}{}", value / units.si, units.si_name, addition),
            fmt::format("{:.4g} {}{}", value / units.field, units.field_name, addition)};
}

Item range(const char* id, const char* label, double least, double most, const UnitPair& units) {
    if (most - least <= 1e-9 * std::abs(most)) return quantity(id, label, most, units);
    return {id, label,
            fmt::format("{:.4g} to {:.4g} {}", least / units.si, most / units.si, units.si_name),
            fmt::format("{:.4g} to {:.4g} {}", least / units.field, most / units.field,
                        units.field_name)};
}

Item plain(const char* id, const char* label, const std::string& text) {
    return {id, label, text, ""};
}

std::string json_of(const Items& items) {
    std::vector<std::string> list;
    for (const Item& item : items)
        list.push_back(json_object({{"id", json_text(item.id)},
                                    {"label", json_text(item.label)},
                                    {"si", json_text(item.si)},
                                    {"field", json_text(item.field)}}));
    return json_list(list);
}

/// Where and when a quantity along the string was greatest.
struct Peak {
    double value = 0;
    double s = 0;     ///< m
    double time = 0;  ///< s
};

/// The greatest `value(profile, k)` over all profiles and places; numbers that are none count not.
template <class Value>
Peak peak_of(const std::vector<Profile>& profiles, const std::vector<double>& places,
             Value&& value) {
    Peak peak;
    for (const Profile& profile : profiles)
        for (std::size_t k = 0; k < places.size(); ++k)
            if (const double found = value(profile, k); found > peak.value)
                peak = {found, places[k], profile.time};
    return peak;
}

Peak peak_of_yield(const Result& result) {
    return peak_of(result.profiles, result.header.segment_s,
                   [&](const Profile& profile, std::size_t k) {
                       return yield_share(result.header, k, profile.stress[k]);
                   });
}

std::string place_text(const Peak& peak, const UnitPair& units, bool field) {
    return fmt::format(" at {:.4g} {}, {:.4g} s", peak.s / (field ? units.field : units.si),
                       field ? units.field_name : units.si_name, peak.time);
}

Item peak_item(const char* id, const char* label, const Peak& peak, const UnitPair& units) {
    Item item = quantity(id, label, peak.value, units);
    item.si += place_text(peak, page_unit::length, false);
    item.field += place_text(peak, page_unit::length, true);
    return item;
}

Item yield_item(const Peak& peak) {
    const std::string text = fmt::format("{:.3g} % of yield", 100 * peak.value);
    return {"mises", "Von Mises stress, greatest",
            text + place_text(peak, page_unit::length, false),
            text + place_text(peak, page_unit::length, true)};
}

double simulated_seconds(const Result& result) {
    return result.series.empty() ? 0 : result.series.back().time - result.series.front().time;
}

Items run_items(const Result& result) {
    const ResultFooter& footer = result.footer;
    const StepStatistics& steps = footer.statistics;
    Items items = {
        plain("simulated", "Simulated", fmt::format("{:.6g} s", simulated_seconds(result))),
        plain("wall", "Wall time", duration_text(footer.wall_seconds))};
    if (footer.wall_seconds > 0)
        items.push_back(plain(
            "speed", "Speed",
            fmt::format("{:.3g} × real time", simulated_seconds(result) / footer.wall_seconds)));
    items.push_back(
        plain("steps", "Steps", fmt::format("{} ({} rejected)", steps.steps, steps.rejected)));
    if (steps.largest_step > 0)
        items.push_back(
            plain("step", "Step",
                  fmt::format("{:.3g} to {:.3g} ms", steps.smallest_step / page_unit::step.si,
                              steps.largest_step / page_unit::step.si)));
    if (steps.time_error > 0)
        items.push_back(plain("time-error", "Time error of 16 steps, greatest",
                              fmt::format("{:.2g} %", 100 * steps.time_error)));
    if (result.header.well)
        items.push_back(quantity("penetration", "In the wall, greatest", footer.largest_penetration,
                                 page_unit::small_length));
    items.push_back(plain("residual", "Energy residual",
                          fmt::format("{:.2g} %", 100 * footer.energy_residual)));
    items.push_back(
        plain("integrator", "Integrator",
              fmt::format("{}, {} thread{}", result.header.integrator, result.header.threads,
                          result.header.threads == 1 ? "" : "s")));
    return items;
}

Items string_items(const ResultHeader& header) {
    Items items = {quantity("length", "Length", header.node_s.back(), page_unit::length),
                   plain("segments", "Segments", fmt::format("{}", header.segment_s.size()))};
    if (header.mass.empty()) return items;
    const auto total_of = [&](const std::vector<double>& per_length) {
        return std::inner_product(per_length.begin(), per_length.end(), header.cell.begin(), 0.0);
    };
    const auto [least, most] =
        std::minmax_element(header.outer_radius.begin(), header.outer_radius.end());
    items.push_back(quantity("mass", "Mass", total_of(header.mass), page_unit::mass));
    items.push_back(
        quantity("weight", "Weight in the fluid", total_of(header.weight), page_unit::force));
    if (*most > 0)
        items.push_back(range("outer-diameter", "Outer diameter", 2 * *least, 2 * *most,
                              page_unit::small_length));
    return items;
}

/// Where each component begins and ends, from the head.
Items component_items(const ResultHeader& header) {
    Items items;
    for (std::size_t k = 0; k < header.component_name.size(); ++k)
        items.push_back(
            range(fmt::format("component-{}", k).c_str(),
                  header.component_name[k].empty() ? fmt::format("component {}", k + 1).c_str()
                                                   : header.component_name[k].c_str(),
                  header.component_start[k], header.component_end[k], page_unit::length));
    return items;
}

/// Diameter and friction of each section, where they are not alike.
Items section_items(const WellCase& well, double start) {
    Items items;
    for (std::size_t k = 0; k < well.sections.size() && well.sections.size() > 1; ++k) {
        const WellSectionCase& section = well.sections[k];
        if (!section.dynamic_friction) break;
        items.push_back(range(
            fmt::format("section-{}", k).c_str(),
            fmt::format("{}, dynamic friction {:.3g} axial {:.3g} azimuthal",
                        section.name.empty() ? fmt::format("Section {}", k + 1) : section.name,
                        section.dynamic_friction->axial, section.dynamic_friction->azimuthal)
                .c_str(),
            start, section.to, page_unit::length));
        start = section.to;
    }
    return items;
}

Items well_items(const WellCase& well) {
    double steepest = 0;
    for (const SurveyStation& station : well.survey)
        steepest = std::max(steepest, station.inclination);
    double sharpest = 0;
    for (const double severity : dogleg_severities(well.survey))
        sharpest = std::max(sharpest, severity);
    double least = well.sections.front().diameter;
    double most = least;
    for (const WellSectionCase& section : well.sections) {
        for (const double diameter :
             {section.diameter, section.end_diameter.value_or(section.diameter)}) {
            least = std::min(least, diameter);
            most = std::max(most, diameter);
        }
    }
    Items items = {
        range("measured-depth", "Measured depth of the survey", well.survey.front().measured_depth,
              well.survey.back().measured_depth, page_unit::length),
        quantity("vertical-depth", "Vertical depth of its end below its start",
                 station_positions(well.survey).back().z(), page_unit::length),
        plain("inclination", "Greatest inclination", fmt::format("{:.4g}°", steepest / degree)),
        {"dogleg", "Greatest dogleg severity",
         fmt::format("{:.3g}° per 30 m", sharpest / unit_factor("deg/30m", dimension::curvature)),
         fmt::format("{:.3g}° per 100 ft",
                     sharpest / unit_factor("deg/100ft", dimension::curvature))},
        range("hole", "Diameter of the hole", least, most, page_unit::small_length)};
    for (Item& item : section_items(well, well.survey.front().measured_depth))
        items.push_back(std::move(item));
    return items;
}

/// Range of a series in words.
Item series_range(const char* id, const char* label, const std::vector<SeriesRecord>& series,
                  const UnitPair& units, double SeriesRecord::*value) {
    double least = series.front().*value;
    double most = least;
    for (const SeriesRecord& record : series) {
        least = std::min(least, record.*value);
        most = std::max(most, record.*value);
    }
    // Rounding of what is zero is not worth its digits.
    const double rounding = 1e-9 * std::max(std::abs(least), std::abs(most));
    if (std::abs(least) < rounding) least = 0;
    if (std::abs(most) < rounding) most = 0;
    return range(id, label, least, most, units);
}

Items load_items(const Result& result) {
    Items items = {series_range("hook-load-range", "Hook load", result.series, page_unit::force,
                                &SeriesRecord::hook_load),
                   series_range("torque-range", "Surface torque", result.series, page_unit::moment,
                                &SeriesRecord::surface_torque),
                   series_range("weight-on-bit-range", "Weight on bit", result.series,
                                page_unit::force, &SeriesRecord::weight_on_bit)};
    if (const Peak peak = peak_of_yield(result); peak.value > 0) items.push_back(yield_item(peak));
    const Peak side =
        peak_of(result.profiles, result.header.node_s,
                [](const Profile& profile, std::size_t k) { return profile.side_force[k]; });
    if (side.value > 0)
        items.push_back(
            peak_item("side-force", "Side force, greatest", side, page_unit::side_force));
    return items;
}

/// What the string did, as the run found it.
Items finding_items(const ResultFooter& footer) {
    Items items;
    std::map<std::string, int> seen;
    for (const std::string& finding : footer.findings) {
        FindingText text = finding_text(finding);
        std::string id = "finding-" + text.subject;
        if (const int before = seen[text.subject]++; before > 0)
            id += fmt::format("-{}", before + 1);
        if (!text.subject.empty())
            text.subject[0] =
                static_cast<char>(std::toupper(static_cast<unsigned char>(text.subject[0])));
        items.push_back(plain(id.c_str(), text.subject.c_str(), text.what));
    }
    return items;
}

std::string group(const char* title, const Items& items) {
    return json_object({{"title", json_text(title)}, {"items", json_of(items)}});
}

}  // namespace

std::string status_json(const std::string& status) {
    std::string text = status;
    if (status == "running") text = "running, or killed before its end";
    return json_object(
        {{"text", json_text(text)}, {"good", status == "complete" ? "true" : "false"}});
}

std::string tiles_json(const Result& result) {
    if (result.series.empty()) return "[]";
    const SeriesRecord& last = result.series.back();
    Items items = {
        plain("end-time", "Last record", fmt::format("{:.6g} s", last.time)),
        quantity("hook-load", "Hook load", last.hook_load, page_unit::force),
        quantity("torque", "Surface torque", last.surface_torque, page_unit::moment),
        quantity("weight-on-bit", "Weight on bit", last.weight_on_bit, page_unit::force),
        plain("top-rotation", "Rotation of the top",
              fmt::format("{:.4g} rpm", last.head_rotation_rate / page_unit::rotation.si)),
        plain("bit-rotation", "Rotation of the bit",
              fmt::format("{:.4g} rpm", last.bit_rotation_rate / page_unit::rotation.si))};
    if (const Peak peak = peak_of_yield(result); peak.value > 0)
        items.push_back(plain("greatest-mises", "Von Mises, greatest",
                              fmt::format("{:.3g} % of yield", 100 * peak.value)));
    items.push_back(plain("energy-residual", "Energy residual",
                          fmt::format("{:.2g} %", 100 * result.footer.energy_residual)));
    return json_of(items);
}

std::string facts_json(const Result& result) {
    std::vector<std::string> groups = {group("Run", run_items(result))};
    if (!result.header.node_s.empty())
        groups.push_back(group("String", string_items(result.header)));
    if (const Items components = component_items(result.header); !components.empty())
        groups.push_back(group("Components, from the head", components));
    if (result.header.well) groups.push_back(group("Well", well_items(*result.header.well)));
    if (!result.series.empty()) groups.push_back(group("Loads over the run", load_items(result)));
    if (const Items items = finding_items(result.footer); !items.empty())
        groups.push_back(group("What happened", items));
    return json_list(groups);
}

std::vector<std::string> warnings_of(const Result& result) {
    std::vector<std::string> warnings;
    const ResultFooter& footer = result.footer;
    if (footer.status == "running")
        warnings.push_back("The run goes on, or was killed: the pictures end at its last record.");
    else if (footer.status != "complete")
        warnings.push_back("The run did not come to its end: " + footer.status + ".");
    if (std::abs(footer.energy_residual) > large_energy_residual)
        warnings.push_back(fmt::format(
            "{:.2g} % of the energy that moved {}; the time steps are too long, or the scene gains "
            "energy.",
            100 * std::abs(footer.energy_residual),
            footer.energy_residual > 0 ? "appeared from nowhere" : "vanished unaccounted for"));
    if (const Peak peak = peak_of_yield(result); peak.value > 1)
        warnings.push_back(
            fmt::format("The stress reached {:.3g} times the yield strength.", peak.value));
    return warnings;
}

}  // namespace drillstrand::program
