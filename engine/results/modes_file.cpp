#include "drillstrand/modes_file.hpp"

#include "drillstrand/new_file.hpp"
#include "results/hdf5.hpp"
#include "results/held_file.hpp"
#include "results/reading.hpp"
#include "results/record_lists.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

const std::string group_name = "/modes";
const std::string response_name = "/modes/response";

void write_shape(H5::H5File& file, const StaticShape& shape, hsize_t segments) {
    file.createGroup(group_name + "/static");
    for (const auto& entry : static_shape_datasets())
        hdf5::write_values(file, entry.path, entry.integer, hdf5::shape(entry, segments, 0),
                           entry.units, entry.description,
                           hdf5::values_of(std::vector<StaticShape>{shape}, entry));
}

/// A group of its own, where there is anything.
template <class Record>
void write_group(H5::H5File& file, const std::string& name,
                 const std::vector<RecordDataset<Record>>& layout, hsize_t segments,
                 const std::vector<Record>& records) {
    if (records.empty()) return;
    file.createGroup(group_name + "/" + name);
    hdf5::write_records(file, layout, segments, records);
}

void write_excitation(H5::H5File& file, const Excitation& excitation) {
    H5::Group group = file.openGroup(response_name);
    hdf5::write_attribute(group, "order", excitation.order);
    hdf5::write_attribute(group, "unbalance", std::int64_t{excitation.unbalance});
    hdf5::write_attribute(group, "bit_force", excitation.bit_force);
    hdf5::write_attribute(group, "bit_torque", excitation.bit_torque);
}

void write_file(const fs::path& path, const ModesResult& result) {
    H5::H5File file(path, H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, hdf5::file_access());
    H5::Group root = file.openGroup("/");
    const hsize_t segments = result.header.segment_s.size();
    hdf5::write_origin(root, result.header);
    H5::Group group = file.createGroup(group_name);
    hdf5::write_attribute(group, "rotation_rate", result.rotation_rate);
    hdf5::write_attribute(group, "sticks", std::int64_t{result.grip == WallGrip::sticks});
    file.createGroup(group_name + "/mesh");
    hdf5::write_mesh(file, group_name, result.header);
    write_shape(file, result.shape, segments);
    hdf5::write_records(file, mode_datasets(), segments, result.modes);
    write_group(file, "campbell", campbell_datasets(), segments, result.campbell);
    write_group(file, "critical", critical_speed_datasets(), segments, result.critical_speeds);
    write_group(file, "response", response_datasets(), segments, result.response);
    if (result.excitation && !result.response.empty()) write_excitation(file, *result.excitation);
    hdf5::write_attribute(root, "status", std::string("complete"));
    group.close();
    root.close();
    file.close();
}

/// Bytes of the arrays, uncompressed.
std::size_t array_bytes(const ModesResult& result) {
    const std::size_t places = result.header.node_s.size() + result.header.segment_s.size();
    return places * sizeof(double) +
           hdf5::bytes_of(std::vector<StaticShape>{result.shape}, static_shape_datasets()) +
           hdf5::bytes_of(result.modes, mode_datasets()) +
           hdf5::bytes_of(result.campbell, campbell_datasets()) +
           hdf5::bytes_of(result.critical_speeds, critical_speed_datasets()) +
           hdf5::bytes_of(result.response, response_datasets());
}

StaticShape read_shape(hdf5::UntrustedFile& file, std::size_t segments) {
    StaticShape shape;
    for (const auto& entry : static_shape_datasets())
        entry.assign(shape,
                     hdf5::read_checked_values(file, entry.path, entry.integer,
                                               hdf5::shape(entry, segments, 0))
                         .data(),
                     segments + 1);
    return shape;
}

/// Nothing where there is no such group.
template <class Record>
std::vector<Record> read_group(hdf5::UntrustedFile& file, const std::string& name,
                               const std::vector<RecordDataset<Record>>& layout,
                               std::size_t segments) {
    if (!hdf5::holds(file, group_name + "/" + name)) return {};
    return hdf5::read_records(file, layout, segments);
}

template <class Record>
void require_kinds(const std::vector<Record>& records) {
    for (const Record& record : records)
        if (record.kind < ModeKind::lateral || record.kind > ModeKind::axial)
            throw hdf5::UnsoundFile(group_name + ": a kind of mode that there is not");
}

bool read_flag(const H5::Group& group, const char* name) {
    std::int64_t flag = 0;
    hdf5::read_attribute(group, name, flag);
    return flag != 0;
}

std::optional<Excitation> read_excitation(hdf5::UntrustedFile& file) {
    if (!hdf5::holds(file, response_name)) return std::nullopt;
    const H5::Group group = file.hdf5().openGroup(response_name);
    Excitation excitation;
    hdf5::read_attribute(group, "order", excitation.order);
    excitation.unbalance = read_flag(group, "unbalance");
    hdf5::read_attribute(group, "bit_force", excitation.bit_force);
    hdf5::read_attribute(group, "bit_torque", excitation.bit_torque);
    return excitation;
}

}  // namespace

void write_modes(const fs::path& path, const ModesResult& result, Existing existing) {
    NewFile fresh(path, existing);
    fresh.held().require_space(array_bytes(result) + result.header.case_text.size() +
                               metadata_bytes);
    hdf5::attempt<WriteError>(path, "write", [&] { write_file(fresh.path(), result); });
    fresh.take_name();
}

bool holds_modes(const fs::path& path) {
    return hdf5::holds_group(path, group_name);
}

ModesResult read_modes(const fs::path& path) {
    return hdf5::read_file(path, [](hdf5::UntrustedFile& file) {
        ModesResult result;
        const H5::Group root = file.hdf5().openGroup("/");
        hdf5::read_origin(root, result.header, result.version, result.commit);
        hdf5::read_mesh(file, group_name, result.header);
        const H5::Group group = file.hdf5().openGroup(group_name);
        hdf5::read_attribute(group, "rotation_rate", result.rotation_rate);
        result.grip = read_flag(group, "sticks") ? WallGrip::sticks : WallGrip::slides;
        const std::size_t segments = result.header.segment_s.size();
        result.shape = read_shape(file, segments);
        result.modes = hdf5::read_records(file, mode_datasets(), segments);
        result.campbell = read_group(file, "campbell", campbell_datasets(), segments);
        result.critical_speeds = read_group(file, "critical", critical_speed_datasets(), segments);
        result.excitation = read_excitation(file);
        result.response = read_group(file, "response", response_datasets(), segments);
        require_kinds(result.modes);
        require_kinds(result.campbell);
        require_kinds(result.critical_speeds);
        return result;
    });
}

}  // namespace drillstrand
