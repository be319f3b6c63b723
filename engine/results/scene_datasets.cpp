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

void write_well(H5::H5File& file, const WellCase& well) {
    file.createGroup("/well");
    for (const auto& entry : well_datasets()) {
        const std::vector<double> values = entry.values(well);
        std::vector<hsize_t> extents{values.size() / entry.components};
        if (entry.components > 1) extents.push_back(entry.components);
        write_values(file, entry.path, false, extents, entry.units, entry.description, values);
    }
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
        if (!std::isfinite(section.diameter) || section.diameter <= 0)
            refuse("a diameter that is not positive");
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
