#include "results/scene_datasets.hpp"

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <stdexcept>

#include "drillstrand/well.hpp"
#include "results/reading.hpp"

namespace drillstrand::hdf5 {

namespace {

void write_string(H5::H5File& file, const ResultHeader& header) {
    file.createGroup("/string");
    for (const auto& entry : string_datasets()) {
        std::vector<double> values;
        entry.append(header, values);
        write_values(file, entry.path, entry.integer, shape(entry, header.segment_s.size(), 0),
                     entry.units, entry.description, values);
    }
}

constexpr const char* names_path = "/string/component_name";
constexpr const char* starts_path = "/string/component_start";
constexpr const char* ends_path = "/string/component_end";

void write_components(H5::H5File& file, const ResultHeader& header) {
    const hsize_t count = header.component_name.size();
    write_texts(file, names_path, "names of the components, head to bit", header.component_name);
    write_values(file, starts_path, false, {count}, "m", "where a component begins, from the head",
                 header.component_start);
    write_values(file, ends_path, false, {count}, "m", "where it ends, from the head",
                 header.component_end);
}

void read_components(UntrustedFile& file, ResultHeader& header) {
    header.component_name = read_texts(file, names_path, any_extent);
    const hsize_t count = header.component_name.size();
    header.component_start = read_checked_values(file, starts_path, false, {count});
    header.component_end = read_checked_values(file, ends_path, false, {count});
}

void read_string(UntrustedFile& file, ResultHeader& header) {
    for (const auto& entry : string_datasets()) {
        const std::vector<double> values = read_checked_values(
            file, entry.path, entry.integer, shape(entry, header.segment_s.size(), 0));
        entry.assign(header, values.data(), values.size());
    }
}

constexpr const char* section_names_path = "/well/section_name";
constexpr const char* section_end_diameters_path = "/well/section_end_diameter";
constexpr const char* section_statics_path = "/well/section_static_friction";
constexpr const char* section_dynamics_path = "/well/section_dynamic_friction";
constexpr const char* section_stiffnesses_path = "/well/section_normal_stiffness";

/// Coefficients of every section: along the well, around it.
std::vector<double> coefficients(const WellCase& well,
                                 std::optional<FrictionCoefficients> WellSectionCase::*friction) {
    std::vector<double> values;
    for (const WellSectionCase& section : well.sections) {
        values.push_back((section.*friction)->axial);
        values.push_back((section.*friction)->azimuthal);
    }
    return values;
}

/// What the walls of the sections are. A header knows it of every section, or of none.
void write_walls(H5::H5File& file, const WellCase& well) {
    const hsize_t count = well.sections.size();
    std::vector<std::string> names;
    std::vector<double> end_diameters;
    std::vector<double> stiffnesses;
    for (const WellSectionCase& section : well.sections) {
        names.push_back(section.name);
        end_diameters.push_back(section.end_diameter.value_or(section.diameter));
        stiffnesses.push_back(*section.normal_stiffness);
    }
    write_texts(file, section_names_path, "names of the sections", names);
    write_values(file, section_end_diameters_path, false, {count}, "m",
                 "diameter of the hole at the section's end", end_diameters);
    write_values(file, section_statics_path, false, {count, 2}, "1",
                 "static friction of the section, along the well and around it",
                 coefficients(well, &WellSectionCase::static_friction));
    write_values(file, section_dynamics_path, false, {count, 2}, "1",
                 "dynamic friction of the section, along the well and around it",
                 coefficients(well, &WellSectionCase::dynamic_friction));
    write_values(file, section_stiffnesses_path, false, {count}, "Pa",
                 "normal stiffness of the section's wall", stiffnesses);
}

void read_walls(UntrustedFile& file, WellCase& well) {
    const hsize_t count = well.sections.size();
    const std::vector<std::string> names = read_texts(file, section_names_path, count);
    const auto values = [&](const char* path) {
        return read_checked_values(file, path, false, {count});
    };
    const auto pairs = [&](const char* path) {
        return read_checked_values(file, path, false, {count, 2});
    };
    const std::vector<double> end_diameters = values(section_end_diameters_path);
    const std::vector<double> stiffnesses = values(section_stiffnesses_path);
    const std::vector<double> statics = pairs(section_statics_path);
    const std::vector<double> dynamics = pairs(section_dynamics_path);
    for (std::size_t k = 0; k < well.sections.size(); ++k) {
        WellSectionCase& section = well.sections[k];
        section.name = names[k];
        if (end_diameters[k] != section.diameter) section.end_diameter = end_diameters[k];
        section.normal_stiffness = stiffnesses[k];
        section.static_friction = {statics[2 * k], statics[2 * k + 1]};
        section.dynamic_friction = {dynamics[2 * k], dynamics[2 * k + 1]};
    }
}

void write_well(H5::H5File& file, const WellCase& well) {
    file.createGroup("/well");
    for (const auto& entry : well_datasets()) {
        const std::vector<double> values = entry.values(well);
        std::vector<hsize_t> extents{values.size() / entry.components};
        if (entry.components > 1) extents.push_back(entry.components);
        write_values(file, entry.path, false, extents, entry.units, entry.description, values);
    }
    if (well.sections.front().normal_stiffness) write_walls(file, well);
}

/// Throws UnsoundFile unless a Well can be made of what was read.
void check_well(const WellCase& well) {
    const auto refuse = [](const std::string& problem) { throw UnsoundFile("/well: " + problem); };
    if (well.survey.size() < 2) refuse("fewer than two stations");
    if (well.sections.empty()) refuse("no section");
    for (const SurveyStation& station : well.survey)
        if (!std::isfinite(station.inclination) || !std::isfinite(station.azimuth))
            refuse("a direction that is none");
    for (const WellSectionCase& section : well.sections)
        for (const double diameter :
             {section.diameter, section.end_diameter.value_or(section.diameter)})
            if (!std::isfinite(diameter) || diameter <= 0)
                refuse("a diameter that is not positive");
    for (const WellSectionCase& section : well.sections)
        if (section.normal_stiffness &&
            !(std::isfinite(*section.normal_stiffness) && *section.normal_stiffness > 0))
            refuse("a stiffness that is not positive");
    try {
        static_cast<void>(Well(well));
    } catch (const std::invalid_argument& error) {
        refuse(error.what());
    }
}

WellCase read_well(UntrustedFile& file) {
    WellCase well;
    std::map<std::string, hsize_t> rows;  // of stations and of sections
    for (const auto& entry : well_datasets()) {
        const auto known = rows.find(entry.extent);
        std::vector<hsize_t> expected{known == rows.end() ? any_extent : known->second};
        if (entry.components > 1) expected.push_back(entry.components);
        const std::vector<double> values = read_checked_values(file, entry.path, false, expected);
        // measured depths come first
        if (known == rows.end()) {
            require_ascending(entry.path, values);
            rows[entry.extent] = values.size();
        }
        entry.assign(well, values);
    }
    if (holds(file, section_names_path)) read_walls(file, well);
    check_well(well);
    return well;
}

}  // namespace

void write_scene(H5::H5File& file, const ResultHeader& header) {
    if (!header.outer_radius.empty()) {
        write_string(file, header);
        write_components(file, header);
    }
    if (header.well) write_well(file, *header.well);
}

void read_scene(UntrustedFile& file, ResultHeader& header) {
    if (holds(file, "/string")) {
        read_string(file, header);
        if (holds(file, names_path)) read_components(file, header);
    }
    if (holds(file, "/well")) header.well = read_well(file);
}

}  // namespace drillstrand::hdf5
