/// Lists of records that are written at once.
#pragma once

#include <vector>

#include "results/hdf5.hpp"

namespace drillstrand::hdf5 {

/// The values of one dataset of all records, in the order of the file.
template <class Record>
std::vector<double> values_of(const std::vector<Record>& records,
                              const RecordDataset<Record>& entry) {
    std::vector<double> values;
    for (const Record& record : records)
        entry.append(record, values);
    return values;
}

/// One record to a compressed chunk; those of one row as they are.
template <class Record>
H5::DSetCreatPropList storage_of(const RecordDataset<Record>& entry, hsize_t segments) {
    H5::DSetCreatPropList properties;
    if (entry.rows == Rows::one) return properties;
    const auto chunk = shape(entry, segments, 1);
    properties.setChunk(static_cast<int>(chunk.size()), chunk.data());
    properties.setShuffle();
    properties.setDeflate(deflate_level);
    return properties;
}

/// Creates the datasets of a list of records, in groups that exist, and writes them.
template <class Record>
void write_records(H5::H5File& file, const std::vector<RecordDataset<Record>>& layout,
                   hsize_t segments, const std::vector<Record>& records) {
    for (const auto& entry : layout) {
        const auto dimensions = shape(entry, segments, records.size());
        const H5::DataSpace space(static_cast<int>(dimensions.size()), dimensions.data());
        create_dataset(file, entry.path, entry.integer, space, storage_of(entry, segments),
                       entry.units, entry.description)
            .write(values_of(records, entry).data(), H5::PredType::NATIVE_DOUBLE);
    }
}

/// Bytes of the datasets of a list of records, uncompressed.
template <class Record>
std::size_t bytes_of(const std::vector<Record>& records,
                     const std::vector<RecordDataset<Record>>& layout) {
    std::size_t values = 0;
    for (const auto& entry : layout)
        values += values_of(records, entry).size();
    return values * sizeof(double);
}

}  // namespace drillstrand::hdf5
