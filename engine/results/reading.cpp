#include "results/reading.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace drillstrand::hdf5 {

void require_result_file(const std::filesystem::path& path) {
    errno = 0;
    if (std::filesystem::is_directory(path))
        throw ResultError(path.string() + ": cannot read: Is a directory");
    if (!std::ifstream(path))
        throw ResultError(path.string() +
                          ": cannot read: " + std::generic_category().message(errno));
    const QuietErrors quiet;
    if (H5Fis_hdf5(path.c_str()) <= 0)
        throw ResultError(path.string() +
                          ": not a result file; 'drillstrand run CASE.toml' writes one");
}

bool holds_group(const std::filesystem::path& path, const std::string& group) {
    require_result_file(path);
    return attempt(path, "read", [&] {
        return H5::H5File(path, H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, file_access())
            .nameExists(group);
    });
}

void read_origin(const H5::Group& root, ResultHeader& header, std::string& version,
                 std::string& commit) {
    read_attribute(root, "title", header.title);
    read_attribute(root, "case", header.case_text);
    read_attribute(root, "version", version);
    read_attribute(root, "commit", commit);
}

std::vector<double> read_values(const H5::H5File& file, const std::string& dataset_path) {
    const H5::DataSet dataset = file.openDataSet(dataset_path);
    std::vector<double> values(
        static_cast<std::size_t>(dataset.getSpace().getSimpleExtentNpoints()));
    dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE);
    return values;
}

void read_mesh(const H5::H5File& file, const std::string& parent, ResultHeader& header) {
    for (const auto& entry : mesh_datasets()) {
        const std::vector<double> values = read_values(file, parent + entry.path);
        entry.assign(header, values.data(), values.size());
    }
}

}  // namespace drillstrand::hdf5
