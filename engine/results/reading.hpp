/// Reading datasets as the layout tables describe them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "results/hdf5.hpp"

namespace drillstrand::hdf5 {

/// Throws ResultError where there is no file to read, or one that is not HDF5.
void require_result_file(const std::filesystem::path& path);

/// Whether a result file holds a group of that name. Throws ResultError where there is none to
/// read.
bool holds_group(const std::filesystem::path& path, const std::string& group);

/// Reads what write_origin() wrote.
void read_origin(const H5::Group& root, ResultHeader& header, std::string& version,
                 std::string& commit);

/// All values of a dataset, in the order of the file.
std::vector<double> read_values(const H5::H5File& file, const std::string& dataset_path);

/// Reads what write_mesh() wrote below the group `parent`.
void read_mesh(const H5::H5File& file, const std::string& parent, ResultHeader& header);

/// Records for which every dataset has its values. (A run that is being written, or was killed,
/// may hold values whose time is not written yet.)
template <class Record>
std::vector<Record> read_records(const H5::H5File& file,
                                 const std::vector<RecordDataset<Record>>& layout,
                                 std::size_t segments) {
    std::vector<Record> records;
    for (const auto& entry : layout) {
        const std::vector<double> values = read_values(file, entry.path);
        const std::size_t rows = entry.rows == Rows::one        ? 1
                                 : entry.rows == Rows::segments ? segments
                                                                : segments + 1;
        const std::size_t per_record = rows * entry.components;
        const std::size_t complete = values.size() / per_record;
        if (&entry == &layout.front()) records.resize(complete);
        records.resize(std::min(records.size(), complete));
        for (std::size_t k = 0; k < records.size(); ++k)
            entry.assign(records[k], values.data() + k * per_record, rows);
    }
    return records;
}

}  // namespace drillstrand::hdf5
