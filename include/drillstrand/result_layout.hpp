/// The datasets of a result file, one line each: path, shape, units, meaning, and the part of a
/// record that they hold. Writer, reader, `drillstrand info` and the table in
/// engine/results/README.md follow these tables.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drillstrand/buckling.hpp"
#include "drillstrand/records.hpp"
#include "drillstrand/result_file.hpp"

namespace drillstrand {

/// How many rows of values one record has.
enum class Rows { one, nodes, segments };

/// A dataset that holds one member of Record.
template <class Record>
struct RecordDataset {
    std::string path;
    Rows rows = Rows::one;
    std::size_t components = 1;  ///< values per row
    bool integer = false;        ///< stored as 64-bit integers rather than doubles
    std::string units;
    std::string description;
    /// Appends the values of a record, row by row.
    void (*append)(const Record& record, std::vector<double>& values);
    /// Sets the values of a record from `rows` rows.
    void (*assign)(Record& record, const double* values, std::size_t rows);
};

/// Written once.
const std::vector<RecordDataset<ResultHeader>>& mesh_datasets();

/// Written once, where the header has them.
const std::vector<RecordDataset<ResultHeader>>& string_datasets();

/// A dataset of the well, written once where there is one.
struct WellDataset {
    std::string path;
    std::string extent;          ///< number of rows as README.md writes it
    std::size_t components = 1;  ///< values per row
    std::string units;
    std::string description;
    std::vector<double> (*values)(const WellCase& well);  ///< row by row
    /// Sets what `values` came from; does nothing for what follows from other datasets.
    void (*assign)(WellCase& well, const std::vector<double>& values);
};

/// The survey, then the sections.
const std::vector<WellDataset>& well_datasets();

/// One entry per record; the first one is the time.
const std::vector<RecordDataset<SeriesRecord>>& series_datasets();
const std::vector<RecordDataset<Profile>>& profile_datasets();

/// One entry per record of the sensor of that name; the first one is the time.
std::vector<RecordDataset<SensorRecord>> sensor_datasets(const std::string& name);

/// Brought up to date while the run goes on, where cycles are counted.
const std::vector<RecordDataset<SegmentCycles>>& cycle_datasets();

/// One entry per mode, in a file of buckling modes.
const std::vector<RecordDataset<BucklingMode>>& buckling_datasets();
/// One entry per unstable shape, where the file has any.
const std::vector<RecordDataset<UnstableMode>>& instability_datasets();

}  // namespace drillstrand
