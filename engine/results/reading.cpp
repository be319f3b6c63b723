#include "results/reading.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

#include "drillstrand/saved_state.hpp"

namespace drillstrand::hdf5 {

namespace {

namespace fs = std::filesystem;

/// What deflate can make of a byte at most (its longest match is 258 bytes, in two bits).
constexpr hsize_t most_inflation = 1032;
/// All values together: a sound file holds two to five times its size, and some forty times where a
/// string lies at rest in every profile.
constexpr hsize_t small_file_bytes = hsize_t{1} << 24;
constexpr hsize_t most_bytes_per_byte = 64;
/// A chunk is taken into memory as a whole, however little of it is read.
constexpr hsize_t small_chunk_bytes = hsize_t{1} << 20;

[[noreturn]] void refuse(const std::string& what, const std::string& problem) {
    throw UnsoundFile(what + ": " + problem);
}

[[noreturn]] void cannot_read(const fs::path& path, const std::string& why) {
    throw ResultError(path.string() + ": cannot read: " + why);
}

void require_regular(const fs::path& path, int failure, const struct stat& status) {
    if (failure != 0) cannot_read(path, std::generic_category().message(errno));
    if (S_ISDIR(status.st_mode)) cannot_read(path, std::generic_category().message(EISDIR));
    if (!S_ISREG(status.st_mode)) cannot_read(path, "not a regular file");
}

/// An open regular file. It is looked at before it is opened: opening a pipe waits for a writer,
/// and opening a device may move a tape.
class OpenFile {
  public:
    explicit OpenFile(const fs::path& path) : path_(path) {
        struct stat status = {};
        require_regular(path, ::stat(path.c_str(), &status), status);
        number_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        if (number_ < 0) cannot_read(path, std::generic_category().message(errno));
        try {
            require_regular(path, ::fstat(number_, &status), status);
        } catch (...) {
            ::close(number_);
            throw;
        }
    }
    ~OpenFile() { ::close(number_); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    [[nodiscard]] hsize_t bytes() const {
        struct stat status = {};
        require_regular(path_, ::fstat(number_, &status), status);
        return static_cast<hsize_t>(status.st_size);
    }

    template <std::size_t size>
    [[nodiscard]] std::array<unsigned char, size> first_bytes() const {
        std::array<unsigned char, size> bytes = {};
        if (::pread(number_, bytes.data(), size, 0) < 0)
            cannot_read(path_, std::generic_category().message(errno));
        return bytes;
    }

  private:
    const fs::path& path_;
    int number_ = -1;
};

std::uint64_t little_endian(const unsigned char* bytes) {
    std::uint64_t value = 0;
    for (int k = 7; k >= 0; --k)
        value = value << 8 | bytes[k];
    return value;
}

/// The first bytes of a file, version 0 of HDF5's "superblock": the oldest one, which every file of
/// drillstrand has.
void check_superblock(const OpenFile& file, const fs::path& path) {
    constexpr std::array<unsigned char, 8> signature{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    const auto bytes = file.first_bytes<56>();
    if (!std::equal(signature.begin(), signature.end(), bytes.begin()))
        throw ResultError(path.string() +
                          ": not a result file; 'drillstrand run CASE.toml' writes one");
    const bool known = bytes[8] == 0 && bytes[13] == 8 && bytes[14] == 8;
    const std::uint64_t base = little_endian(&bytes[24]);
    const std::uint64_t end = little_endian(&bytes[40]);
    const std::uint64_t driver = little_endian(&bytes[48]);
    if (!known || base != 0 || driver != ~std::uint64_t{0})
        throw UnsoundFile("HDF5 of another kind than drillstrand writes");
    // asked for after the bytes were read: the file may grow meanwhile
    if (end > file.bytes())
        throw UnsoundFile(fmt::format("cut off: {} of its {} bytes are there", file.bytes(), end));
}

hsize_t product(hsize_t left, hsize_t right) {
    hsize_t result = 0;
    return __builtin_mul_overflow(left, right, &result) ? any_extent : result;
}

/// Bytes of one entry along the first extent.
hsize_t entry_bytes(const std::vector<hsize_t>& extents) {
    hsize_t bytes = sizeof(double);
    for (std::size_t k = 1; k < extents.size(); ++k)
        bytes = product(bytes, extents[k]);
    return bytes;
}

std::string shape_text(const std::vector<hsize_t>& extents) {
    std::string text;
    for (const hsize_t extent : extents)
        text += (text.empty() ? "" : " x ") +
                (extent == any_extent ? std::string("any number") : std::to_string(extent));
    return text.empty() ? "one value" : text;
}

/// Bytes that the file gives to a dataset, and what they can be inflated to.
struct Storage {
    hsize_t bytes = 0;
    hsize_t inflation = 1;
    hsize_t chunk_bytes = 0;
};

/// Throws where values are taken from elsewhere, or come through a filter of somebody else.
Storage checked_storage(const std::string& path, const H5::DataSet& dataset) {
    const H5::DSetCreatPropList properties = dataset.getCreatePlist();
    if (H5Pget_external_count(properties.getId()) != 0)
        refuse(path, "its values are in another file");
    const H5D_layout_t layout = properties.getLayout();
    if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED && layout != H5D_COMPACT)
        refuse(path, "its values are those of other datasets");
    Storage storage;
    for (int k = 0; k < properties.getNfilters(); ++k) {
        unsigned flags = 0;
        unsigned configuration = 0;
        std::size_t parameters = 0;
        const H5Z_filter_t filter =
            properties.getFilter(k, flags, parameters, nullptr, 0, nullptr, configuration);
        if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE)
            refuse(path, fmt::format("filter {}, which drillstrand does not use", filter));
        if (filter == H5Z_FILTER_DEFLATE) {
            if (storage.inflation > 1) refuse(path, "compressed more than once");
            storage.inflation = most_inflation;
        }
    }
    if (layout == H5D_CHUNKED) {
        std::array<hsize_t, H5S_MAX_RANK> chunk = {};
        const int rank = properties.getChunk(static_cast<int>(chunk.size()), chunk.data());
        storage.chunk_bytes = sizeof(double);
        for (int k = 0; k < rank; ++k)
            storage.chunk_bytes = product(storage.chunk_bytes, chunk[static_cast<std::size_t>(k)]);
    }
    storage.bytes = dataset.getStorageSize();
    return storage;
}

void check_type(const std::string& path, const H5::DataSet& dataset, bool integer) {
    const H5::DataType type = dataset.getDataType();
    const H5::PredType& expected = integer ? H5::PredType::STD_I64LE : H5::PredType::IEEE_F64LE;
    if (H5Tequal(type.getId(), expected.getId()) <= 0)
        refuse(path, integer ? "no 64-bit integers" : "no numbers of double precision");
}

std::vector<hsize_t> checked_extents(const std::string& path, const H5::DataSet& dataset,
                                     const std::vector<hsize_t>& expected) {
    const H5::DataSpace space = dataset.getSpace();
    std::vector<hsize_t> extents;
    if (space.isSimple() && space.getSimpleExtentType() != H5S_NULL) {
        extents.resize(static_cast<std::size_t>(space.getSimpleExtentNdims()));
        if (!extents.empty()) space.getSimpleExtentDims(extents.data());
    }
    bool fits = extents.size() == expected.size();
    for (std::size_t k = 0; fits && k < extents.size(); ++k)
        fits = expected[k] == any_extent || expected[k] == extents[k];
    if (!fits)
        refuse(path, fmt::format("its shape is {}; {} would be right", shape_text(extents),
                                 shape_text(expected)));
    return extents;
}

H5::Attribute open_attribute(const H5::H5Object& object, const char* name) {
    if (H5Aexists(object.getId(), name) <= 0)
        throw UnsoundFile(fmt::format("no attribute '{}'; drillstrand writes one", name));
    H5::Attribute attribute = object.openAttribute(name);
    if (attribute.getSpace().getSimpleExtentType() != H5S_SCALAR)
        throw UnsoundFile(fmt::format("attribute '{}' is not one value", name));
    return attribute;
}

template <class Value>
void read_number(const H5::H5Object& object, const char* name, const H5::PredType& stored,
                 const H5::PredType& native, const char* kind, Value& value) {
    const H5::Attribute attribute = open_attribute(object, name);
    const H5::DataType type = attribute.getDataType();
    if (H5Tequal(type.getId(), stored.getId()) <= 0)
        throw UnsoundFile(fmt::format("attribute '{}' is no {}", name, kind));
    attribute.read(native, &value);
}

/// Text of any length. HDF5 gives none at all where it is empty.
std::string long_text(const H5::Attribute& attribute, const H5::DataType& type) {
    char* text = nullptr;
    attribute.read(type, static_cast<void*>(&text));
    std::string value = text == nullptr ? "" : text;
    H5free_memory(text);
    return value;
}

/// Text of fixed length, which ends at its first zero or is filled up with blanks.
std::string short_text(const H5::Attribute& attribute, const H5::DataType& type) {
    std::string value(type.getSize(), '\0');
    attribute.read(type, static_cast<void*>(value.data()));
    value.resize(std::min(value.find('\0'), value.size()));
    value.resize(value.find_last_not_of(' ') + 1);
    return value;
}

/// A list of texts of a dataset or an attribute, which `read` reads.
template <class Object, class Read>
std::vector<std::string> read_list(const std::string& what, const Object& object, hsize_t expected,
                                   Read&& read) {
    constexpr hsize_t most_texts = 100'000;
    const H5::DataSpace space = object.getSpace();
    if (object.getTypeClass() != H5T_STRING || !object.getDataType().isVariableStr() ||
        space.getSimpleExtentType() != H5S_SIMPLE || space.getSimpleExtentNdims() != 1)
        throw UnsoundFile(what + " is no list of texts");
    hsize_t count = 0;
    space.getSimpleExtentDims(&count);
    if (count > most_texts || (expected != any_extent && count != expected))
        throw UnsoundFile(fmt::format("{} has {} texts", what, count));
    std::vector<std::string> list;
    if (count == 0) return list;
    std::vector<char*> texts(count, nullptr);
    read(object.getDataType(), texts.data());
    for (char* text : texts) {
        list.emplace_back(text == nullptr ? "" : text);
        H5free_memory(text);
    }
    return list;
}

}  // namespace

UntrustedFile::UntrustedFile(const fs::path& path) {
    const OpenFile file(path);
    check_superblock(file, path);
    file_ = H5::H5File(path, H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, file_access());
    bytes_ = file.bytes();
}

void UntrustedFile::count(hsize_t bytes) {
    const hsize_t most = small_file_bytes + product(bytes_, most_bytes_per_byte);
    if (bytes > most || bytes_read_ > most - bytes)
        throw UnsoundFile(fmt::format(
            "claims more than {} bytes of values, which a file of {} bytes does not hold", most,
            bytes_));
    bytes_read_ += bytes;
}

bool holds(const UntrustedFile& file, const std::string& path) {
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
        const std::string part = path.substr(0, end);
        const htri_t exists = H5Lexists(file.hdf5().getId(), part.c_str(), H5P_DEFAULT);
        if (exists < 0) refuse(part, "damaged, or not where a group should be");
        if (exists == 0) return false;
        H5L_info_t info = {};
        if (H5Lget_info(file.hdf5().getId(), part.c_str(), &info, H5P_DEFAULT) < 0 ||
            info.type != H5L_TYPE_HARD)
            refuse(part, "a link to elsewhere, which is not followed");
        if (end == std::string::npos) return true;
    }
}

void refuse_foreign_links(const UntrustedFile& file, const std::string& path) {
    if (!holds(file, path)) refuse(path, "not in the file");
}

bool holds_group(const fs::path& path, const std::string& group) {
    return read_file(path, [&](const UntrustedFile& file) { return holds(file, group); });
}

std::vector<std::string> read_texts(const UntrustedFile& file, const std::string& path,
                                    hsize_t count) {
    refuse_foreign_links(file, path);
    if (file.hdf5().childObjType(path) != H5O_TYPE_DATASET) refuse(path, "not a dataset");
    const H5::DataSet dataset = file.hdf5().openDataSet(path);
    static_cast<void>(checked_storage(path, dataset));
    return read_list(path, dataset, count, [&](const H5::DataType& type, char** texts) {
        dataset.read(static_cast<void*>(texts), type);
    });
}

CheckedDataset checked_dataset(const UntrustedFile& file, const std::string& path, bool integer,
                               const std::vector<hsize_t>& expected) {
    refuse_foreign_links(file, path);
    if (file.hdf5().childObjType(path) != H5O_TYPE_DATASET) refuse(path, "not a dataset");
    CheckedDataset checked{file.hdf5().openDataSet(path), {}, 0};
    const Storage storage = checked_storage(path, checked.dataset);
    check_type(path, checked.dataset, integer);
    checked.extents = checked_extents(path, checked.dataset, expected);
    const hsize_t entries = checked.extents.empty() ? 1 : checked.extents.front();
    const hsize_t per_entry = entry_bytes(checked.extents);
    const hsize_t all = product(entries, per_entry);
    if (all > product(file.bytes(), storage.inflation))
        refuse(path, fmt::format("claims {} values, which a file of {} bytes does not hold",
                                 all / sizeof(double), file.bytes()));
    if (storage.chunk_bytes > small_chunk_bytes + std::max(all, per_entry))
        refuse(path,
               fmt::format("chunks of {} bytes, larger than its values", storage.chunk_bytes));
    if (per_entry > 0)
        checked.stored = std::min(
            entries, product(std::min(storage.bytes, file.bytes()), storage.inflation) / per_entry);
    return checked;
}

std::vector<double> read_entries(UntrustedFile& file, const CheckedDataset& dataset, bool integer,
                                 hsize_t count) {
    const hsize_t bytes = product(count, entry_bytes(dataset.extents));
    file.count(bytes);
    std::vector<double> values(bytes / sizeof(double));
    if (values.empty()) return values;
    const int rank = static_cast<int>(dataset.extents.size());
    if (rank == 0 || count == dataset.extents.front()) {
        dataset.dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE);
    } else {
        std::vector<hsize_t> extents = dataset.extents;
        extents.front() = count;
        const std::vector<hsize_t> start(extents.size(), 0);
        const H5::DataSpace memory(rank, extents.data());
        H5::DataSpace source = dataset.dataset.getSpace();
        source.selectHyperslab(H5S_SELECT_SET, extents.data(), start.data());
        dataset.dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE, memory, source);
    }
    if (integer)
        for (const double value : values)
            if (std::abs(value) > largest_whole_number)
                throw UnsoundFile(fmt::format("the count {:g} is none", value));
    return values;
}

std::vector<double> read_checked_values(UntrustedFile& file, const std::string& path, bool integer,
                                        const std::vector<hsize_t>& expected) {
    const CheckedDataset dataset = checked_dataset(file, path, integer, expected);
    const hsize_t entries = dataset.extents.empty() ? 1 : dataset.extents.front();
    if (dataset.stored < entries)
        refuse(path, fmt::format("{} of its {} values are there", dataset.stored, entries));
    return read_entries(file, dataset, integer, entries);
}

void read_attribute(const H5::H5Object& object, const char* name, std::string& value) {
    const H5::Attribute attribute = open_attribute(object, name);
    if (attribute.getTypeClass() != H5T_STRING)
        throw UnsoundFile(fmt::format("attribute '{}' is no text", name));
    const H5::DataType type = attribute.getDataType();
    value = type.isVariableStr() ? long_text(attribute, type) : short_text(attribute, type);
}

void read_attribute(const H5::H5Object& object, const char* name, std::vector<std::string>& value) {
    if (H5Aexists(object.getId(), name) <= 0)
        throw UnsoundFile(fmt::format("no attribute '{}'; drillstrand writes one", name));
    const H5::Attribute attribute = object.openAttribute(name);
    const std::string what = fmt::format("attribute '{}'", name);
    value = read_list(what, attribute, any_extent, [&](const H5::DataType& type, char** texts) {
        attribute.read(type, static_cast<void*>(texts));
    });
}

void read_attribute(const H5::H5Object& object, const char* name, double& value) {
    read_number(object, name, H5::PredType::IEEE_F64LE, H5::PredType::NATIVE_DOUBLE,
                "number of double precision", value);
}

void read_attribute(const H5::H5Object& object, const char* name, std::int64_t& value) {
    read_number(object, name, H5::PredType::STD_I64LE, H5::PredType::NATIVE_INT64, "64-bit integer",
                value);
}

void read_origin(const H5::Group& root, ResultHeader& header, std::string& version,
                 std::string& commit) {
    read_attribute(root, "title", header.title);
    read_attribute(root, "case", header.case_text);
    read_attribute(root, "version", version);
    read_attribute(root, "commit", commit);
}

void require_ascending(const std::string& path, const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k)
        if (!std::isfinite(values[k]) || (k > 0 && values[k] <= values[k - 1]))
            refuse(path, fmt::format("entry {} is {:g}; the numbers must ascend", k, values[k]));
}

void read_mesh(UntrustedFile& file, const std::string& parent, ResultHeader& header) {
    hsize_t segments = 0;
    for (const auto& entry : mesh_datasets()) {
        const std::string path = parent + entry.path;
        std::vector<hsize_t> expected{any_extent};
        if (segments > 0) expected = shape(entry, segments, 0);
        const std::vector<double> values = read_checked_values(file, path, entry.integer, expected);
        require_ascending(path, values);
        if (segments == 0) {
            // the nodes come first
            if (values.size() < 2) refuse(path, "fewer than two nodes");
            segments = values.size() - 1;
        }
        entry.assign(header, values.data(), values.size());
    }
}

}  // namespace drillstrand::hdf5
