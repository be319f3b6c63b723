#include "results/scene_datasets.hpp"

#include <Eigen/Core>

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

void read_string(const H5::H5File& file, ResultHeader& header) {
    for (const auto& entry : string_datasets()) {
        const std::vector<double> values = read_values(file, entry.path);
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

WellCase read_well(const H5::H5File& file) {
    WellCase well;
    for (const auto& entry : well_datasets())
        entry.assign(well, read_values(file, entry.path));
    return well;
}

}  // namespace

void write_scene(H5::H5File& file, const ResultHeader& header) {
    if (!header.outer_radius.empty()) write_string(file, header);
    if (header.well) write_well(file, *header.well);
}

void read_scene(const H5::H5File& file, ResultHeader& header) {
    if (file.nameExists("/string")) read_string(file, header);
    if (file.nameExists("/well")) header.well = read_well(file);
}

}  // namespace drillstrand::hdf5
