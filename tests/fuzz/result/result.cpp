/// Any bytes as a result file: read, then looked at as report, export and info do. HDF5's library
/// itself fails on some inputs, which is why the program reads in a process of its own; a finding
/// is what fails in drillstrand's code.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "drillstrand/buckling_file.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/modes_file.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/torque_drag_file.hpp"
#include "export_fields.hpp"
#include "fuzz/result/untrusted_bytes.hpp"
#include "printable.hpp"
#include "report_data.hpp"
#include "report_series.hpp"
#include "report_string.hpp"
#include "report_summary.hpp"

namespace drillstrand::program {
namespace {

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
    if (!result.instability) return;
    for (const UnstableMode& mode : result.instability->modes)
        if (mode.strain.size() != result.header.segment_s.size()) std::abort();
}

void look_at(const TorqueDragResult& result) {
    for (const TorqueDragCurve& curve : result.study.curves)
        if (curve.hook_load.size() != result.study.bit_depth.size()) std::abort();
}

void look_at(const ModesResult& result) {
    for (const VibrationMode& mode : result.modes)
        if (mode.turn.size() != result.header.node_s.size()) std::abort();
    for (const ForcedResponse& response : result.response)
        if (response.torque.size() != result.header.segment_s.size()) std::abort();
}

/// Ends the program where a sound file cannot be read this way, so that nothing would be tried.
bool require_that_sound_files_are_read() {
    BucklingResult made;
    made.header.node_s = {0, 1};
    made.header.segment_s = {0.5};
    made.modes = {{1, {Vector6::Ones()}}};
    const fuzz::ScratchFile file(nullptr, 0);
    write_buckling(file.path(), made);
    std::ifstream stream(file.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    const fuzz::ScratchFile copy(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
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
    if (!works || !fuzz::are_heaps_sound(data, size)) return 0;
    const fuzz::ScratchFile file(data, size);
    program::try_to([&] { return read_result(file.path()); });
    program::try_to([&] { return read_buckling(file.path()); });
    program::try_to([&] { return read_torque_drag(file.path()); });
    program::try_to([&] { return read_modes(file.path()); });
    return 0;
}
