#include "drillstrand/torque_drag_file.hpp"

#include <array>

#include "drillstrand/new_file.hpp"
#include "results/hdf5.hpp"
#include "results/held_file.hpp"
#include "results/reading.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

const std::string group_name = "/torque_drag";

constexpr std::array motions{TorqueDragMotion::tripping_in, TorqueDragMotion::tripping_out,
                             TorqueDragMotion::rotating, TorqueDragMotion::drilling,
                             TorqueDragMotion::sliding};

std::string group_of(TorqueDragMotion motion) {
    return group_name + "/" + motion_name(motion);
}

std::string profile_group_of(TorqueDragMotion motion) {
    return group_of(motion) + "/profile";
}

void write_list(H5::H5File& file, const std::string& path, bool integer, const std::string& units,
                const std::string& description, const std::vector<double>& values) {
    hdf5::write_values(file, path, integer, {values.size()}, units, description, values);
}

void write_table(H5::H5File& file, const std::string& group,
                 const std::vector<TorqueDragDataset>& table, const TorqueDragCurve& curve) {
    H5::Group created = file.createGroup(group);
    for (const TorqueDragDataset& entry : table)
        write_list(file, group + "/" + entry.name, entry.integer, entry.units, entry.description,
                   entry.values(curve));
}

void write_curve(H5::H5File& file, const TorqueDragCurve& curve) {
    write_table(file, group_of(curve.motion), torque_drag_depth_datasets(), curve);
    write_table(file, profile_group_of(curve.motion), torque_drag_profile_datasets(), curve);
    H5::Group group = file.openGroup(group_of(curve.motion));
    hdf5::write_attribute(group, "not_found", static_cast<std::int64_t>(curve.failures.size()));
    hdf5::write_attribute(group, "lock_up_depth", curve.lock_up_depth);
    hdf5::write_attribute(group, "largest_weight", curve.largest_weight);
}

void write_file(const fs::path& path, const TorqueDragResult& result) {
    H5::H5File file(path, H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, hdf5::file_access());
    H5::Group root = file.openGroup("/");
    hdf5::write_origin(root, result.header);
    file.createGroup(group_name);
    file.createGroup(group_name + "/mesh");
    hdf5::write_mesh(file, group_name, result.header);
    write_list(file, group_name + "/bit_depth", false, "m", "measured depth of the bit",
               result.study.bit_depth);
    write_list(file, group_name + "/measured_depth", false, "m",
               "measured depth of the middles of the segments with the bit at its last depth",
               result.study.measured_depth);
    for (const TorqueDragCurve& curve : result.study.curves)
        write_curve(file, curve);
    hdf5::write_attribute(root, "status", std::string("complete"));
    root.close();
    file.close();
}

/// Bytes of the arrays.
std::size_t array_bytes(const TorqueDragResult& result) {
    const std::size_t depths = torque_drag_depth_datasets().size() * result.study.bit_depth.size();
    const std::size_t segments =
        torque_drag_profile_datasets().size() * result.study.measured_depth.size();
    const std::size_t common =
        result.study.bit_depth.size() + 3 * result.study.measured_depth.size();
    return (common + result.study.curves.size() * (depths + segments)) * sizeof(double);
}

/// The values of one dataset, of which the integers are states of buckling.
std::vector<double> read_entry(hdf5::UntrustedFile& file, const std::string& path,
                               const TorqueDragDataset& entry, std::size_t count) {
    std::vector<double> values = hdf5::read_checked_values(file, path, entry.integer, {count});
    constexpr auto least = static_cast<double>(BucklingState::unknown);
    constexpr auto most = static_cast<double>(BucklingState::helical);
    if (entry.integer)
        for (const double value : values)
            if (value < least || value > most)
                throw hdf5::UnsoundFile(path + ": a state of buckling that there is not");
    return values;
}

void read_table(hdf5::UntrustedFile& file, const std::string& group,
                const std::vector<TorqueDragDataset>& table, std::size_t count,
                TorqueDragCurve& curve) {
    for (const TorqueDragDataset& entry : table)
        entry.assign(curve, read_entry(file, group + "/" + entry.name, entry, count));
}

TorqueDragCurve read_curve(hdf5::UntrustedFile& file, TorqueDragMotion motion,
                           const TorqueDrag& study) {
    TorqueDragCurve curve;
    curve.motion = motion;
    read_table(file, group_of(motion), torque_drag_depth_datasets(), study.bit_depth.size(), curve);
    read_table(file, profile_group_of(motion), torque_drag_profile_datasets(),
               study.measured_depth.size(), curve);
    const H5::Group group = file.hdf5().openGroup(group_of(motion));
    hdf5::read_attribute(group, "lock_up_depth", curve.lock_up_depth);
    hdf5::read_attribute(group, "largest_weight", curve.largest_weight);
    return curve;
}

}  // namespace

void write_torque_drag(const fs::path& path, const TorqueDragResult& result, Existing existing) {
    NewFile fresh(path, existing);
    fresh.held().require_space(array_bytes(result) + result.header.case_text.size() +
                               metadata_bytes);
    hdf5::attempt<WriteError>(path, "write", [&] { write_file(fresh.path(), result); });
    fresh.take_name();
}

bool holds_torque_drag(const fs::path& path) {
    return hdf5::holds_group(path, group_name);
}

TorqueDragResult read_torque_drag(const fs::path& path) {
    return hdf5::read_file(path, [](hdf5::UntrustedFile& file) {
        TorqueDragResult result;
        TorqueDrag& study = result.study;
        const H5::Group root = file.hdf5().openGroup("/");
        hdf5::read_origin(root, result.header, result.version, result.commit);
        hdf5::read_mesh(file, group_name, result.header);
        const std::string depths = group_name + "/bit_depth";
        study.bit_depth = hdf5::read_checked_values(file, depths, false, {hdf5::any_extent});
        if (study.bit_depth.empty()) throw hdf5::UnsoundFile(depths + ": no depth");
        study.measured_depth = hdf5::read_checked_values(file, group_name + "/measured_depth",
                                                         false, {result.header.segment_s.size()});
        for (const TorqueDragMotion motion : motions)
            if (hdf5::holds(file, group_of(motion)))
                study.curves.push_back(read_curve(file, motion, study));
        return result;
    });
}

}  // namespace drillstrand
