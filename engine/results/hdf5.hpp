/// What the result files need of HDF5, on top of its official C++ interface.
#pragma once

#include <H5Cpp.h>

#include <cstdint>
#include <filesystem>
#include <ios>
#include <string>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/result_layout.hpp"

namespace drillstrand::hdf5 {

/// Keeps HDF5 from printing its errors while it lives, and its C++ destructors from writing to
/// std::cerr; the caller's settings come back after it.
class QuietErrors {
  public:
    QuietErrors();
    ~QuietErrors();
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;

  private:
    H5E_auto2_t function_ = nullptr;
    void* client_data_ = nullptr;
    std::ios::iostate error_stream_;
};

/// The reason of the last failure in one line: that of the operating system where there is one.
std::string reason(const H5::Exception& exception);

/// Calls `action`; a failure of HDF5 becomes an Error "PATH: cannot VERB: reason".
template <class Error = ResultError, class Action>
auto attempt(const std::filesystem::path& path, const char* verb, Action&& action) {
    const QuietErrors quiet;
    try {
        return action();
    } catch (const H5::Exception& exception) {
        throw Error(path.string() + ": cannot " + verb + ": " + reason(exception));
    }
}

/// Access as result files need it: all objects close with the file, and no lock on it, so that
/// others can read while a run writes.
H5::FileAccPropList file_access();

/// Shape of `records` records of a dataset on a mesh of that many segments; the leading dimension
/// is left out where records = 0 (datasets written once).
template <class Record>
std::vector<hsize_t> shape(const RecordDataset<Record>& dataset, hsize_t segments,
                           hsize_t records) {
    std::vector<hsize_t> dimensions;
    if (records > 0) dimensions.push_back(records);
    if (dataset.rows == Rows::nodes) dimensions.push_back(segments + 1);
    if (dataset.rows == Rows::segments) dimensions.push_back(segments);
    if (dataset.components > 1) dimensions.push_back(dataset.components);
    return dimensions;
}

/// Compression of frames: datasets of which a chunk is written once.
inline constexpr unsigned deflate_level = 4;

H5::DataSet create_dataset(H5::H5File& file, const std::string& path, bool integer,
                           const H5::DataSpace& space, const H5::DSetCreatPropList& properties,
                           const std::string& units, const std::string& description,
                           const H5::DSetAccPropList& access = H5::DSetAccPropList::DEFAULT);

/// Creates a dataset of that shape, uncompressed, and writes all its values.
void write_values(H5::H5File& file, const std::string& path, bool integer,
                  const std::vector<hsize_t>& shape, const std::string& units,
                  const std::string& description, const std::vector<double>& values);

/// Creates a dataset of texts, one a row.
void write_texts(H5::H5File& file, const std::string& path, const std::string& description,
                 const std::vector<std::string>& texts);

/// Writes the datasets of mesh_datasets() below the group `parent` ("" for the root), where the
/// group mesh exists.
void write_mesh(H5::H5File& file, const std::string& parent, const ResultHeader& header);

/// What every file says of itself: title, case, version, commit.
void write_origin(H5::Group& root, const ResultHeader& header);

/// Attributes: created where they are missing, overwritten where they exist.
void write_attribute(H5::H5Object& object, const char* name, const std::string& value);
/// A list of texts, which may be empty.
void write_attribute(H5::H5Object& object, const char* name, const std::vector<std::string>& texts);
void write_attribute(H5::H5Object& object, const char* name, double value);
void write_attribute(H5::H5Object& object, const char* name, std::int64_t value);

}  // namespace drillstrand::hdf5
