/// Reading files of which nothing is believed before it is checked: a result may come from anybody,
/// or from a disk that lost half of it. What is refused, and why: README.md, "What the reader
/// refuses".
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "results/hdf5.hpp"

namespace drillstrand::hdf5 {

/// What is wrong with a file, without its name: read_file() puts that before it.
class UnsoundFile : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A file that is open for reading: a regular one, HDF5 as drillstrand writes it.
class UntrustedFile {
  public:
    /// Throws ResultError where there is no file to read, or one that is not HDF5, UnsoundFile
    /// where drillstrand cannot have written its first bytes.
    explicit UntrustedFile(const std::filesystem::path& path);

    [[nodiscard]] const H5::H5File& hdf5() const { return file_; }
    /// On the disk, when it was opened.
    [[nodiscard]] hsize_t bytes() const { return bytes_; }
    /// Counts what is read, before memory is taken for it. Throws UnsoundFile past what a file of
    /// this size can sensibly hold.
    void count(hsize_t bytes);

  private:
    hsize_t bytes_ = 0;
    hsize_t bytes_read_ = 0;
    H5::H5File file_;
};

/// Calls `action` with the file; whatever is wrong becomes ResultError "PATH: cannot read: why".
/// Every reader of files goes through it.
template <class Action>
auto read_file(const std::filesystem::path& path, Action&& action) {
    const QuietErrors quiet;
    const std::string cannot_read = path.string() + ": cannot read: ";
    try {
        UntrustedFile file(path);
        return action(file);
    } catch (const UnsoundFile& problem) {
        throw ResultError(cannot_read + problem.what());
    } catch (const H5::Exception& problem) {
        throw ResultError(cannot_read + "damaged (" + reason(problem) + ")");
    } catch (const std::bad_alloc&) {
        throw ResultError(cannot_read + "not enough memory for it");
    }
}

/// Whether a file holds a group of that name. Throws ResultError where there is no file to read.
bool holds_group(const std::filesystem::path& path, const std::string& group);

/// Whether the file has an object of that path. Throws UnsoundFile where a link on the way is not
/// the file's own: links to other files or by name, and those of other programs.
bool holds(const UntrustedFile& file, const std::string& path);

/// Throws UnsoundFile where there is no object of that path, or the way to it leaves the file.
void refuse_foreign_links(const UntrustedFile& file, const std::string& path);

/// An extent that may be anything.
inline constexpr hsize_t any_extent = std::numeric_limits<hsize_t>::max();

/// A dataset that is sound as far as its description goes.
struct CheckedDataset {
    H5::DataSet dataset;
    std::vector<hsize_t> extents;
    /// Entries along the first extent of which the values can be in the file: those behind may be
    /// missing where a run was killed.
    hsize_t stored = 0;
};

/// Opens a dataset of 64-bit numbers (`integer`, or doubles) whose extents are those expected, each
/// of which may be any_extent. Throws UnsoundFile where it is another one, where its values are not
/// in this file, where a filter is not of drillstrand, or where it claims more values than a file
/// of this size can hold.
CheckedDataset checked_dataset(const UntrustedFile& file, const std::string& path, bool integer,
                               const std::vector<hsize_t>& expected);

/// The values of the first `count` entries along the first extent, in the order of the file.
std::vector<double> read_entries(UntrustedFile& file, const CheckedDataset& dataset, bool integer,
                                 hsize_t count);

/// All values of a dataset, each of which must be there. Integers beyond 2^53, which a double does
/// not hold, are refused.
std::vector<double> read_checked_values(UntrustedFile& file, const std::string& path, bool integer,
                                        const std::vector<hsize_t>& expected);

/// A dataset of `count` texts (any_extent: of any number that is sensible).
std::vector<std::string> read_texts(const UntrustedFile& file, const std::string& path,
                                    hsize_t count);

/// Attributes: one value each, or a list of texts, of the type that write_attribute() gives it;
/// text may also be of fixed length. Throws UnsoundFile where there is none, or another one.
void read_attribute(const H5::H5Object& object, const char* name, std::string& value);
void read_attribute(const H5::H5Object& object, const char* name, std::vector<std::string>& value);
void read_attribute(const H5::H5Object& object, const char* name, double& value);
void read_attribute(const H5::H5Object& object, const char* name, std::int64_t& value);

/// Reads what write_origin() wrote.
void read_origin(const H5::Group& root, ResultHeader& header, std::string& version,
                 std::string& commit);

/// Reads what write_mesh() wrote below the group `parent`: at least one segment, arc lengths that
/// ascend.
void read_mesh(UntrustedFile& file, const std::string& parent, ResultHeader& header);

/// Throws UnsoundFile, naming `path`, unless all values are finite and each exceeds the one before.
void require_ascending(const std::string& path, const std::vector<double>& values);

/// Records for which every dataset has its values. (A run that is being written, or was killed,
/// may hold values whose time is not written yet.)
template <class Record>
std::vector<Record> read_records(UntrustedFile& file,
                                 const std::vector<RecordDataset<Record>>& layout,
                                 std::size_t segments) {
    std::vector<CheckedDataset> datasets;
    hsize_t count = any_extent;
    for (const auto& entry : layout) {
        datasets.push_back(
            checked_dataset(file, entry.path, entry.integer, shape(entry, segments, any_extent)));
        count = std::min(count, datasets.back().stored);
    }
    std::vector<Record> records;
    for (std::size_t k = 0; k < layout.size(); ++k) {
        const auto& entry = layout[k];
        const std::vector<double> values = read_entries(file, datasets[k], entry.integer, count);
        records.resize(count);
        const std::size_t rows = entry.rows == Rows::one        ? 1
                                 : entry.rows == Rows::segments ? segments
                                                                : segments + 1;
        for (std::size_t record = 0; record < records.size(); ++record)
            entry.assign(records[record], values.data() + record * rows * entry.components, rows);
    }
    return records;
}

}  // namespace drillstrand::hdf5
