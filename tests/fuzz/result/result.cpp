/// Any bytes as a result file: read, then looked at as report, export and info do. HDF5's library
/// itself fails on some inputs, which is why the program reads in a process of its own; a finding
/// is what fails in drillstrand's code.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "drillstrand/buckling_file.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/torque_drag_file.hpp"
#include "export_fields.hpp"
#include "printable.hpp"
#include "report_data.hpp"
#include "report_series.hpp"
#include "report_string.hpp"
#include "report_summary.hpp"

namespace drillstrand::program {
namespace {

/// A file with these bytes. Each is another one for HDF5, which knows files by their numbers.
class ScratchFile {
  public:
    ScratchFile(const std::uint8_t* data, std::size_t size) {
        path_ = std::filesystem::exists("/dev/shm") ? "/dev/shm/result-XXXXXX" : "result-XXXXXX";
        const int number = ::mkstemp(path_.data());
        const ssize_t written = number < 0 ? -1 : ::write(number, data, size);
        if (written != static_cast<ssize_t>(size)) std::abort();
        ::close(number);
    }
    ~ScratchFile() { ::unlink(path_.c_str()); }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

std::uint64_t little_endian(const std::uint8_t* bytes) {
    std::uint64_t value = 0;
    for (int k = 7; k >= 0; --k)
        value = value << 8 | bytes[k];
    return value;
}

/// Whether the objects of a heap of texts follow each other up to its end.
bool is_sound_heap(const std::uint8_t* heap, std::uint64_t bytes) {
    constexpr std::uint64_t head = 16;
    for (std::uint64_t place = head; place + head <= bytes;) {
        const bool is_free = heap[place] == 0 && heap[place + 1] == 0;
        const std::uint64_t size = little_endian(heap + place + 8);
        const std::uint64_t rest = bytes - place - (is_free ? 0 : head);
        if (size > rest) return false;
        if (is_free) return size == rest;
        place += head + (size + 7) / 8 * 8;
    }
    return true;
}

/// HDF5's library loops or crashes on other heaps, so that next to nothing else would be tried.
bool are_heaps_sound(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view mark = "GCOL";
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    for (std::size_t place = text.find(mark); place != std::string_view::npos;
         place = text.find(mark, place + 1)) {
        if (size - place < 16) return false;
        const std::uint64_t bytes = little_endian(data + place + 8);
        if (bytes > size - place || !is_sound_heap(data + place, bytes)) return false;
    }
    return true;
}

/// Ends the program where a field has not one value for each place: what writes them relies on it.
void require_rows(const std::vector<ExportField>& fields, std::size_t rows) {
    for (const ExportField& field : fields)
        if (field.values.size() != rows * field.width()) std::abort();
}

void look_at(const Result& result) {
    ArrayBlock arrays;
    std::vector<std::string> notes;
    add_series(result, arrays, notes);
    add_string(result, arrays, notes);
    static_cast<void>(tiles_json(result) + facts_json(result) + status_json(result.footer.status));
    static_cast<void>(warnings_of(result));
    static_cast<void>(well_stretches(result));
    static_cast<void>(json_text(result.header.title) + printable(result.header.title));
    ProfileFields fields(result);
    for (const Profile& profile : result.profiles) {
        require_rows(fields.of_nodes(profile), result.header.node_s.size());
        require_rows(fields.of_segments(profile), result.header.segment_s.size());
    }
}

void look_at(const BucklingResult& result) {
    for (const BucklingMode& mode : result.modes)
        if (mode.strain.size() != result.header.segment_s.size()) std::abort();
}

void look_at(const TorqueDragResult& result) {
    for (const TorqueDragCurve& curve : result.study.curves)
        if (curve.hook_load.size() != result.study.bit_depth.size()) std::abort();
}

/// Ends the program where a sound file cannot be read this way, so that nothing would be tried.
bool require_that_sound_files_are_read() {
    BucklingResult made;
    made.header.node_s = {0, 1};
    made.header.segment_s = {0.5};
    made.modes = {{1, {Vector6::Ones()}}};
    const ScratchFile file(nullptr, 0);
    write_buckling(file.path(), made);
    std::ifstream stream(file.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    const ScratchFile copy(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    if (read_buckling(copy.path()).modes.size() != 1) std::abort();
    return true;
}

template <class Reading>
void try_to(Reading&& reading) {
    try {
        look_at(reading());
    } catch (const ResultError&) {
        // the one way to say that a file is not usable
    }
}

}  // namespace
}  // namespace drillstrand::program

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    static const bool works = program::require_that_sound_files_are_read();
    if (!works || !program::are_heaps_sound(data, size)) return 0;
    const program::ScratchFile file(data, size);
    program::try_to([&] { return read_result(file.path()); });
    program::try_to([&] { return read_buckling(file.path()); });
    program::try_to([&] { return read_torque_drag(file.path()); });
    return 0;
}
