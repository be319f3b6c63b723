#include "drillstrand/buckling_file.hpp"

#include "drillstrand/new_file.hpp"
#include "results/hdf5.hpp"
#include "results/held_file.hpp"
#include "results/reading.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

constexpr const char* group_name = "/buckling";

/// All modes of one dataset, in the order of the file.
std::vector<double> values_of(const std::vector<BucklingMode>& modes,
                              const RecordDataset<BucklingMode>& entry) {
    std::vector<double> values;
    for (const BucklingMode& mode : modes)
        entry.append(mode, values);
    return values;
}

/// One mode to a compressed chunk; loads, one number each, as they are.
H5::DSetCreatPropList storage_of(const RecordDataset<BucklingMode>& entry, hsize_t segments) {
    H5::DSetCreatPropList properties;
    if (entry.rows == Rows::one) return properties;
    const auto chunk = hdf5::shape(entry, segments, 1);
    properties.setChunk(static_cast<int>(chunk.size()), chunk.data());
    properties.setShuffle();
    properties.setDeflate(hdf5::deflate_level);
    return properties;
}

void write_modes(H5::H5File& file, const BucklingResult& result) {
    const hsize_t segments = result.header.segment_s.size();
    for (const auto& entry : buckling_datasets()) {
        const auto dimensions = hdf5::shape(entry, segments, result.modes.size());
        const H5::DataSpace space(static_cast<int>(dimensions.size()), dimensions.data());
        hdf5::create_dataset(file, entry.path, entry.integer, space, storage_of(entry, segments),
                             entry.units, entry.description)
            .write(values_of(result.modes, entry).data(), H5::PredType::NATIVE_DOUBLE);
    }
}

void write_file(const fs::path& path, const BucklingResult& result) {
    H5::H5File file(path, H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, hdf5::file_access());
    H5::Group root = file.openGroup("/");
    hdf5::write_origin(root, result.header);
    hdf5::write_attribute(root, "tip_weight",
                          std::string(result.tip_weight == TipWeight::half ? "half" : "full"));
    file.createGroup(group_name);
    file.createGroup(std::string(group_name) + "/mesh");
    hdf5::write_mesh(file, group_name, result.header);
    write_modes(file, result);
    hdf5::write_attribute(root, "status", std::string("complete"));
    root.close();
    file.close();
}

/// Bytes of the arrays, uncompressed.
std::size_t array_bytes(const BucklingResult& result) {
    std::size_t values = result.header.node_s.size() + result.header.segment_s.size();
    for (const auto& entry : buckling_datasets())
        values += values_of(result.modes, entry).size();
    return values * sizeof(double);
}

}  // namespace

void write_buckling(const fs::path& path, const BucklingResult& result, Existing existing) {
    NewFile fresh(path, existing);
    fresh.held().require_space(array_bytes(result) + result.header.case_text.size() +
                               metadata_bytes);
    hdf5::attempt<WriteError>(path, "write", [&] { write_file(fresh.path(), result); });
    fresh.take_name();
}

bool holds_buckling(const fs::path& path) {
    return hdf5::holds_group(path, group_name);
}

BucklingResult read_buckling(const fs::path& path) {
    return hdf5::read_file(path, [](hdf5::UntrustedFile& file) {
        BucklingResult result;
        const H5::Group root = file.hdf5().openGroup("/");
        hdf5::read_origin(root, result.header, result.version, result.commit);
        std::string tip_weight;
        hdf5::read_attribute(root, "tip_weight", tip_weight);
        result.tip_weight = tip_weight == "full" ? TipWeight::full : TipWeight::half;
        hdf5::read_mesh(file, group_name, result.header);
        result.modes =
            hdf5::read_records(file, buckling_datasets(), result.header.segment_s.size());
        return result;
    });
}

}  // namespace drillstrand
