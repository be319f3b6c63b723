#include "export_csv.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <vector>

#include "drillstrand/result_layout.hpp"
#include "export_fields.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;

void add_number(std::string& line, double value) {
    if (!line.empty()) line += ',';
    fmt::format_to(std::back_inserter(line), "{}", value);
}

void add_name(std::string& line, const std::string& name) {
    if (!line.empty()) line += ',';
    line += name;
}

using Names = std::vector<std::string>;

/// Names of the components of a dataset: of a series, or of a sensor.
const Names& components_of(const RecordDataset<SeriesRecord>& entry) {
    static const Names none{""};
    if (entry.components == 1) return none;
    return entry.components == 3 ? space_components() : stress_components();
}
const Names& components_of(const RecordDataset<SensorRecord>& entry) {
    static const Names none{""};
    static const Names across{"d1", "d2"};
    static const Names body{"d3", "d1", "d2"};
    if (entry.components == 1) return none;
    return entry.components == 3 ? body : across;
}

template <class Record>
std::string header_of(const std::vector<RecordDataset<Record>>& datasets) {
    std::string header;
    for (const auto& entry : datasets) {
        const std::string name = entry.path.substr(entry.path.rfind('/') + 1);
        const Names& components = components_of(entry);
        for (std::size_t k = 0; k < components.size(); ++k)
            add_name(header, with_units(components[k].empty() ? name : name + '_' + components[k],
                                        unit_of(entry.units, k)));
    }
    return header + '\n';
}

/// A row for each record, a column for each value.
template <class Record>
void write_records(const fs::path& path, const std::vector<RecordDataset<Record>>& datasets,
                   const std::vector<Record>& records, Existing existing) {
    NewFile file(path, existing);
    file.write(header_of(datasets));
    for (const Record& record : records) {
        std::vector<double> values;
        for (const auto& entry : datasets)
            entry.append(record, values);
        std::string line;
        for (const double value : values)
            add_number(line, value);
        file.write(line + '\n');
    }
    file.take_name();
}

std::string header_of(const std::vector<ExportField>& fields) {
    std::string header = "time[s]";
    for (const ExportField& field : fields) {
        if (field.components.empty()) add_name(header, with_units(field.name, field.units));
        for (const std::string& component : field.components)
            add_name(header, with_units(field.name + '_' + component, field.units));
    }
    return header + '\n';
}

/// The rows of one profile.
std::string rows_of(double time, const std::vector<ExportField>& fields) {
    std::string text;
    const std::size_t rows = fields.front().values.size() / fields.front().width();
    for (std::size_t row = 0; row < rows; ++row) {
        std::string line;
        add_number(line, time);
        for (const ExportField& field : fields)
            for (std::size_t k = 0; k < field.width(); ++k)
                add_number(line, field.values[row * field.width() + k]);
        text += line + '\n';
    }
    return text;
}

/// A long table: the header, then the rows of one profile after the other. Without any there is
/// still the header, of the columns that the profile `none` gives.
template <class FieldsOf>
void write_profiles(const fs::path& path, const std::vector<Profile>& profiles, const Profile& none,
                    FieldsOf&& fields_of, Existing existing) {
    NewFile file(path, existing);
    // without a profile there is still a header
    file.write(header_of(fields_of(profiles.empty() ? none : profiles.front())));
    for (const Profile& profile : profiles)
        file.write(rows_of(profile.time, fields_of(profile)));
    file.take_name();
}

std::vector<ExportField> with_position(const Profile& profile, std::vector<ExportField> fields) {
    ExportField position{"position", "m", space_components(), {}};
    for (const Eigen::Vector3d& point : profile.position)
        position.values.insert(position.values.end(), point.begin(), point.end());
    fields.insert(fields.begin() + 1, std::move(position));
    return fields;
}

/// A profile of zeros, with a value for every node and segment.
Profile profile_at_rest(const ResultHeader& header) {
    Profile profile;
    const std::size_t segments = header.segment_s.size();
    for (const auto& entry : profile_datasets()) {
        const std::size_t rows = entry.rows == Rows::one        ? 1
                                 : entry.rows == Rows::segments ? segments
                                                                : segments + 1;
        entry.assign(profile, std::vector<double>(rows * entry.components).data(), rows);
    }
    return profile;
}

void write_well(const fs::path& path, const std::vector<WellStretch>& stretches,
                Existing existing) {
    NewFile file(path, existing);
    file.write("measured_depth[m],north[m],east[m],down[m],radius[m]\n");
    for (const WellStretch& stretch : stretches)
        for (std::size_t k = 0; k < stretch.axis.size(); ++k) {
            std::string line;
            add_number(line, stretch.measured_depth[k]);
            for (const double coordinate : stretch.axis[k])
                add_number(line, coordinate);
            add_number(line, stretch.radius);
            file.write(line + '\n');
        }
    file.take_name();
}

constexpr const char* series_name = "series.csv";
constexpr const char* nodes_name = "nodes.csv";
constexpr const char* segments_name = "segments.csv";
constexpr const char* well_name = "well.csv";

std::string sensor_file(const SensorCase& sensor) {
    return "sensor_" + sensor.name + ".csv";
}

}  // namespace

std::vector<fs::path> csv_files(const fs::path& folder, const Result& result) {
    std::vector<fs::path> files{folder / series_name, folder / nodes_name, folder / segments_name};
    if (result.header.well) files.push_back(folder / well_name);
    for (const SensorCase& sensor : result.header.sensors)
        files.push_back(folder / sensor_file(sensor));
    return files;
}

void write_csv(const fs::path& folder, const Result& result, Existing existing) {
    write_records(folder / series_name, series_datasets(), result.series, existing);
    for (std::size_t i = 0; i < result.sensors.size(); ++i) {
        const SensorCase& sensor = result.header.sensors[i];
        write_records(folder / sensor_file(sensor), sensor_datasets(sensor.name), result.sensors[i],
                      existing);
    }
    ProfileFields fields(result);
    const Profile none = profile_at_rest(result.header);
    write_profiles(
        folder / nodes_name, result.profiles, none,
        [&](const Profile& profile) { return with_position(profile, fields.of_nodes(profile)); },
        existing);
    write_profiles(
        folder / segments_name, result.profiles, none,
        [&](const Profile& profile) { return fields.of_segments(profile); }, existing);
    if (result.header.well) write_well(folder / well_name, well_stretches(result), existing);
}

}  // namespace drillstrand::program
