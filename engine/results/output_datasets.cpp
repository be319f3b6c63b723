#include "results/output_datasets.hpp"

#include <algorithm>

#include "drillstrand/result_layout.hpp"

namespace drillstrand::hdf5 {

namespace {

constexpr const char* sensors_path = "/sensors";
constexpr const char* cycles_path = "/cycles";

std::string path_of(const std::string& sensor) {
    return std::string(sensors_path) + '/' + sensor;
}

}  // namespace

void write_sensors(H5::H5File& file, const ResultHeader& header) {
    if (header.sensors.empty()) return;
    std::vector<std::string> names;
    H5::Group group = file.createGroup(sensors_path);
    for (const SensorCase& sensor : header.sensors) {
        H5::Group own = file.createGroup(path_of(sensor.name));
        write_attribute(own, "depth", sensor.depth);
        write_attribute(own, "radius", sensor.radius);
        write_attribute(own, "interval", sensor.interval);
        names.push_back(sensor.name);
    }
    write_attribute(group, "names", names);
}

void read_sensors(const UntrustedFile& file, ResultHeader& header) {
    if (!holds(file, sensors_path)) return;
    std::vector<std::string> names;
    read_attribute(file.hdf5().openGroup(sensors_path), "names", names);
    for (const std::string& name : names) {
        const auto is_same = [&](const SensorCase& other) { return other.name == name; };
        if (!is_sensor_name(name) ||
            std::any_of(header.sensors.begin(), header.sensors.end(), is_same))
            throw UnsoundFile("/sensors: these are not names of sensors");
        refuse_foreign_links(file, path_of(name));
        const H5::Group own = file.hdf5().openGroup(path_of(name));
        SensorCase& sensor = header.sensors.emplace_back();
        sensor.name = name;
        read_attribute(own, "depth", sensor.depth);
        read_attribute(own, "radius", sensor.radius);
        read_attribute(own, "interval", sensor.interval);
    }
}

void write_cycles(H5::H5File& file, const ResultHeader& header) {
    if (!header.cycles) return;
    H5::Group group = file.createGroup(cycles_path);
    write_attribute(group, "interval", header.cycles->interval);
    write_attribute(group, "slope", header.cycles->slope);
    const std::size_t segments = header.segment_s.size();
    for (const auto& entry : cycle_datasets())
        write_values(file, entry.path, entry.integer, shape(entry, segments, 0), entry.units,
                     entry.description, std::vector<double>(segments));
}

void rewrite_cycles(H5::H5File& file, const SegmentCycles& cycles) {
    if (cycles.cycles.empty()) return;
    for (const auto& entry : cycle_datasets()) {
        std::vector<double> values;
        entry.append(cycles, values);
        file.openDataSet(entry.path).write(values.data(), H5::PredType::NATIVE_DOUBLE);
    }
}

void read_cycles(UntrustedFile& file, ResultHeader& header, SegmentCycles& cycles) {
    if (!holds(file, cycles_path)) return;
    const H5::Group group = file.hdf5().openGroup(cycles_path);
    header.cycles.emplace();
    read_attribute(group, "interval", header.cycles->interval);
    read_attribute(group, "slope", header.cycles->slope);
    for (const auto& entry : cycle_datasets()) {
        const std::vector<double> values = read_checked_values(
            file, entry.path, entry.integer, shape(entry, header.segment_s.size(), 0));
        entry.assign(cycles, values.data(), values.size());
    }
}

}  // namespace drillstrand::hdf5
