#include <cmath>

#include "drillstrand/result_file.hpp"
#include "drillstrand/result_layout.hpp"
#include "results/hdf5.hpp"
#include "results/output_datasets.hpp"
#include "results/reading.hpp"
#include "results/scene_datasets.hpp"

namespace drillstrand {

namespace {

/// The records in front whose times are finite and ascend. (Where a kill hits the flush of the
/// times, the last of them may be missing and read as 0.)
template <class Record>
std::vector<Record> ascending(std::vector<Record> records) {
    std::size_t count = 0;
    while (count < records.size() && std::isfinite(records[count].time) &&
           (count == 0 || records[count - 1].time < records[count].time))
        ++count;
    records.resize(count);
    return records;
}

void read_attributes(const H5::Group& root, Result& result) {
    std::int64_t threads = 0;
    ResultFooter& footer = result.footer;
    hdf5::read_origin(root, result.header, result.version, result.commit);
    hdf5::read_attribute(root, "integrator", result.header.integrator);
    hdf5::read_attribute(root, "threads", threads);
    result.header.threads = static_cast<int>(threads);
    if (root.attrExists("isa")) hdf5::read_attribute(root, "isa", result.header.isa);
    hdf5::read_attribute(root, "status", footer.status);
    hdf5::read_attribute(root, "wall_seconds", footer.wall_seconds);
    hdf5::read_attribute(root, "steps", footer.statistics.steps);
    hdf5::read_attribute(root, "steps_rejected", footer.statistics.rejected);
    hdf5::read_attribute(root, "evaluations", footer.statistics.evaluations);
    hdf5::read_attribute(root, "smallest_step", footer.statistics.smallest_step);
    hdf5::read_attribute(root, "largest_step", footer.statistics.largest_step);
    hdf5::read_attribute(root, "time_error", footer.statistics.time_error);
    hdf5::read_attribute(root, "energy_residual", footer.energy_residual);
    hdf5::read_attribute(root, "largest_penetration", footer.largest_penetration);
    hdf5::read_attribute(root, "time_error_median", footer.time_error_median);
    hdf5::read_attribute(root, "stick_slip_index", footer.stick_slip_index);
    hdf5::read_attribute(root, "stuck_share", footer.stuck_share);
    hdf5::read_attribute(root, "unloaded_share", footer.unloaded_share);
    hdf5::read_attribute(root, "warnings", footer.warnings);
    if (root.attrExists("findings")) hdf5::read_attribute(root, "findings", footer.findings);
}

}  // namespace

Result read_result(const std::filesystem::path& path) {
    return hdf5::read_file(path, [](hdf5::UntrustedFile& file) {
        Result result;
        read_attributes(file.hdf5().openGroup("/"), result);
        hdf5::read_mesh(file, "", result.header);
        hdf5::read_scene(file, result.header);
        const std::size_t segments = result.header.segment_s.size();
        result.series = ascending(hdf5::read_records(file, series_datasets(), segments));
        result.profiles = ascending(hdf5::read_records(file, profile_datasets(), segments));
        hdf5::read_cycles(file, result.header, result.footer.cycles);
        hdf5::read_sensors(file, result.header);
        for (const SensorCase& sensor : result.header.sensors)
            result.sensors.push_back(
                ascending(hdf5::read_records(file, sensor_datasets(sensor.name), segments)));
        return result;
    });
}

}  // namespace drillstrand
