#include "drillstrand/buckling_file.hpp"

#include "drillstrand/new_file.hpp"
#include "results/hdf5.hpp"
#include "results/held_file.hpp"
#include "results/reading.hpp"
#include "results/record_lists.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

constexpr const char* group_name = "/buckling";
constexpr const char* instability_name = "/buckling/instability";

/// A stable string has no shapes, and the group no datasets.
void write_instability(H5::H5File& file, hsize_t segments, const Instability& instability) {
    H5::Group group = file.createGroup(instability_name);
    hdf5::write_attribute(group, "load", instability.load);
    if (!instability.modes.empty())
        hdf5::write_records(file, instability_datasets(), segments, instability.modes);
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
    hdf5::write_records(file, buckling_datasets(), segments, result.modes);
    if (result.instability) write_instability(file, segments, *result.instability);
    hdf5::write_attribute(root, "status", std::string("complete"));
    root.close();
    file.close();
}

/// Bytes of the arrays, uncompressed.
std::size_t array_bytes(const BucklingResult& result) {
    const std::size_t places = result.header.node_s.size() + result.header.segment_s.size();
    std::size_t bytes = places * sizeof(double) + hdf5::bytes_of(result.modes, buckling_datasets());
    if (result.instability)
        bytes += hdf5::bytes_of(result.instability->modes, instability_datasets());
    return bytes;
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
