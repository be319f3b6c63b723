#include "drillstrand/buckling_file.hpp"

#include "drillstrand/new_file.hpp"
#include "results/hdf5.hpp"
#include "results/held_file.hpp"
#include "results/reading.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

constexpr const char* group_name = "/buckling";
constexpr const char* instability_name = "/buckling/instability";

/// All modes of one dataset, in the order of the file.
template <class Mode>
std::vector<double> values_of(const std::vector<Mode>& modes, const RecordDataset<Mode>& entry) {
    std::vector<double> values;
    for (const Mode& mode : modes)
        entry.append(mode, values);
    return values;
}

/// One mode to a compressed chunk; loads and eigenvalues, one number each, as they are.
template <class Mode>
H5::DSetCreatPropList storage_of(const RecordDataset<Mode>& entry, hsize_t segments) {
    H5::DSetCreatPropList properties;
    if (entry.rows == Rows::one) return properties;
    const auto chunk = hdf5::shape(entry, segments, 1);
    properties.setChunk(static_cast<int>(chunk.size()), chunk.data());
    properties.setShuffle();
    properties.setDeflate(hdf5::deflate_level);
    return properties;
}

template <class Mode>
void write_modes(H5::H5File& file, const std::vector<RecordDataset<Mode>>& layout, hsize_t segments,
                 const std::vector<Mode>& modes) {
    for (const auto& entry : layout) {
        const auto dimensions = hdf5::shape(entry, segments, modes.size());
        const H5::DataSpace space(static_cast<int>(dimensions.size()), dimensions.data());
        hdf5::create_dataset(file, entry.path, entry.integer, space, storage_of(entry, segments),
                             entry.units, entry.description)
            .write(values_of(modes, entry).data(), H5::PredType::NATIVE_DOUBLE);
    }
}

/// A stable string has no shapes, and the group no datasets.
void write_instability(H5::H5File& file, hsize_t segments, const Instability& instability) {
    H5::Group group = file.createGroup(instability_name);
    hdf5::write_attribute(group, "load", instability.load);
    if (!instability.modes.empty())
        write_modes(file, instability_datasets(), segments, instability.modes);
}

void write_file(const fs::path& path, const BucklingResult& result) {
    H5::H5File file(path, H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, hdf5::file_access());
    H5::Group root = file.openGroup("/");
    const hsize_t segments = result.header.segment_s.size();
    hdf5::write_origin(root, result.header);
    hdf5::write_attribute(root, "discretisation",
                          std::string(discretisation_name(result.discretisation)));
    file.createGroup(group_name);
    file.createGroup(std::string(group_name) + "/mesh");
    hdf5::write_mesh(file, group_name, result.header);
    write_modes(file, buckling_datasets(), segments, result.modes);
    if (result.instability) write_instability(file, segments, *result.instability);
    hdf5::write_attribute(root, "status", std::string("complete"));
    root.close();
    file.close();
}

/// Bytes of the arrays, uncompressed.
std::size_t array_bytes(const BucklingResult& result) {
    std::size_t values = result.header.node_s.size() + result.header.segment_s.size();
    for (const auto& entry : buckling_datasets())
        values += values_of(result.modes, entry).size();
    if (result.instability)
        for (const auto& entry : instability_datasets())
            values += values_of(result.instability->modes, entry).size();
    return values * sizeof(double);
}

Discretisation read_discretisation(const H5::Group& root) {
    std::string name;
    hdf5::read_attribute(root, "discretisation", name);
    return name == discretisation_name(Discretisation::paper) ? Discretisation::paper
                                                              : Discretisation::beam_column;
}

std::optional<Instability> read_instability(hdf5::UntrustedFile& file, std::size_t segments) {
    if (!hdf5::holds(file, instability_name)) return std::nullopt;
    Instability instability;
    hdf5::read_attribute(file.hdf5().openGroup(instability_name), "load", instability.load);
    if (hdf5::holds(file, instability_datasets().front().path))
        instability.modes = hdf5::read_records(file, instability_datasets(), segments);
    return instability;
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
        result.discretisation = read_discretisation(root);
        hdf5::read_mesh(file, group_name, result.header);
        const std::size_t segments = result.header.segment_s.size();
        result.modes = hdf5::read_records(file, buckling_datasets(), segments);
        result.instability = read_instability(file, segments);
        return result;
    });
}

}  // namespace drillstrand
