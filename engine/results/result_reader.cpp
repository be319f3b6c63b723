#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "drillstrand/result_file.hpp"
#include "results/hdf5.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

void require_result_file(const fs::path& path) {
    errno = 0;
    if (fs::is_directory(path)) throw ResultError(path.string() + ": cannot read: Is a directory");
    if (!std::ifstream(path))
        throw ResultError(path.string() +
                          ": cannot read: " + std::generic_category().message(errno));
    const hdf5::QuietErrors quiet;
    if (H5Fis_hdf5(path.c_str()) <= 0)
        throw ResultError(path.string() +
                          ": not a result file; 'drillstrand run CASE.toml' writes one");
}

/// All values of a dataset, in the order of the file.
template <class Record>
std::vector<double> read_values(const H5::H5File& file, const RecordDataset<Record>& entry) {
    const H5::DataSet dataset = file.openDataSet(entry.path);
    std::vector<double> values(
        static_cast<std::size_t>(dataset.getSpace().getSimpleExtentNpoints()));
    dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE);
    return values;
}

void read_mesh(const H5::H5File& file, ResultHeader& header) {
    for (const auto& entry : mesh_datasets()) {
        const std::vector<double> values = read_values(file, entry);
        entry.assign(header, values.data(), values.size());
    }
}

/// Number of records in front whose times ascend. (Where a kill hits the flush of the times, the
/// last of them may be missing and read as 0.)
template <class Record>
std::size_t ascending(const std::vector<Record>& records) {
    const auto later = [](const Record& left, const Record& right) {
        return left.time >= right.time;
    };
    const auto last = std::adjacent_find(records.begin(), records.end(), later);
    if (last == records.end()) return records.size();
    return static_cast<std::size_t>(last - records.begin()) + 1;
}

/// Records for which every dataset has its values. (A run that is being written, or was killed,
/// may hold values whose time is not written yet.)
template <class Record>
std::vector<Record> read_records(const H5::H5File& file,
                                 const std::vector<RecordDataset<Record>>& layout,
                                 std::size_t segments) {
    std::vector<Record> records;
    for (const auto& entry : layout) {
        const std::vector<double> values = read_values(file, entry);
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
    records.resize(ascending(records));
    return records;
}

void read_attributes(const H5::Group& root, Result& result) {
    std::int64_t threads = 0;
    ResultFooter& footer = result.footer;
    hdf5::read_attribute(root, "title", result.header.title);
    hdf5::read_attribute(root, "case", result.header.case_text);
    hdf5::read_attribute(root, "version", result.version);
    hdf5::read_attribute(root, "commit", result.commit);
    hdf5::read_attribute(root, "integrator", result.header.integrator);
    hdf5::read_attribute(root, "threads", threads);
    result.header.threads = static_cast<int>(threads);
    hdf5::read_attribute(root, "status", footer.status);
    hdf5::read_attribute(root, "wall_seconds", footer.wall_seconds);
    hdf5::read_attribute(root, "steps", footer.statistics.steps);
    hdf5::read_attribute(root, "steps_rejected", footer.statistics.rejected);
    hdf5::read_attribute(root, "evaluations", footer.statistics.evaluations);
    hdf5::read_attribute(root, "smallest_step", footer.statistics.smallest_step);
    hdf5::read_attribute(root, "largest_step", footer.statistics.largest_step);
    hdf5::read_attribute(root, "time_error", footer.statistics.time_error);
    hdf5::read_attribute(root, "energy_residual", footer.energy_residual);
}

}  // namespace

Result read_result(const std::filesystem::path& path) {
    require_result_file(path);
    return hdf5::attempt(path, "read", [&] {
        const H5::H5File file(path, H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT,
                              hdf5::file_access());
        Result result;
        read_attributes(file.openGroup("/"), result);
        read_mesh(file, result.header);
        const std::size_t segments = result.header.segment_s.size();
        result.series = read_records(file, series_datasets(), segments);
        result.profiles = read_records(file, profile_datasets(), segments);
        return result;
    });
}

}  // namespace drillstrand
