/// drillstrand info: what a result file holds, and how it was made.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands.hpp"
#include "drillstrand/result_layout.hpp"
#include "printable.hpp"
#include "read_apart.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

template <class Record>
std::string times_text(const std::vector<Record>& records) {
    if (records.empty()) return "none";
    return fmt::format("{}, from {:.6g} to {:.6g} s", records.size(), records.front().time,
                       records.back().time);
}

std::string status_text(const std::string& status) {
    return status == "running" ? "running, or killed before its end" : printable(status);
}

void print_title(const std::filesystem::path& path, const ResultHeader& header) {
    fmt::print("{}\n", printable(path.string()));
    fmt::print("  title            {}\n", printable(header.title));
}

void print_maker(const std::string& version, const std::string& commit) {
    fmt::print("  made by          drillstrand {}, commit {}\n", printable(version),
               printable(commit));
}

void print_run(const Result& result) {
    const ResultFooter& footer = result.footer;
    const StepStatistics& statistics = footer.statistics;
    fmt::print("  status           {}\n", status_text(footer.status));
    print_maker(result.version, result.commit);
    fmt::print("  integrator       {}, {} thread{}\n", printable(result.header.integrator),
               result.header.threads, result.header.threads == 1 ? "" : "s");
    if (!result.header.isa.empty()) fmt::print("  instruction set  {}\n", result.header.isa);
    fmt::print("  wall time        {}\n", duration_text(footer.wall_seconds));
    fmt::print("  steps            {} accepted, {} rejected, of {:.3g} to {:.3g} s\n",
               statistics.steps, statistics.rejected, statistics.smallest_step,
               statistics.largest_step);
    if (result.header.integrator == "leapfrog")
        fmt::print(
            "  time error       {:.2g} % in 16 steps (median after the start), {:.2g} % at most\n",
            100 * footer.time_error_median, 100 * statistics.time_error);
    fmt::print("  energy residual  {:.2g} %\n", 100 * footer.energy_residual);
    fmt::print("  in the wall      {:.4g} m at most\n", footer.largest_penetration);
    for (const std::string& finding : footer.findings) {
        const FindingText text = finding_text(finding);
        fmt::print("  {:<15}  {}\n", printable(text.subject), printable(text.what));
    }
    for (const std::string& warning : footer.warnings)
        fmt::print("  warning          {}\n", printable(warning));
}

void print_extent(const Result& result) {
    fmt::print("  segments         {}, string of {:.6g} m\n", result.header.segment_s.size(),
               result.header.node_s.empty() ? 0.0 : result.header.node_s.back());
    const ResultHeader& header = result.header;
    for (std::size_t k = 0; k < header.component_name.size(); ++k)
        fmt::print("  {:<15}  {:.6g} to {:.6g} m  {}\n", k == 0 ? "components" : "",
                   header.component_start[k], header.component_end[k],
                   printable(header.component_name[k]));
    fmt::print("  series times     {}\n", times_text(result.series));
    fmt::print("  profile times    {}\n", times_text(result.profiles));
    for (std::size_t k = 0; k < header.sensors.size(); ++k)
        fmt::print("  {:<15}  {}, {:.6g} m from the head: {}\n", k == 0 ? "sensors" : "",
                   header.sensors[k].name, header.sensors[k].depth, times_text(result.sensors[k]));
}

void print_ranges(const RecordDataset<SeriesRecord>& entry,
                  const std::vector<SeriesRecord>& records) {
    std::vector<double> values;
    for (const SeriesRecord& record : records)
        entry.append(record, values);
    for (std::size_t component = 0; component < entry.components; ++component) {
        double least = INFINITY;
        double most = -INFINITY;
        for (std::size_t k = component; k < values.size(); k += entry.components) {
            least = std::min(least, values[k]);
            most = std::max(most, values[k]);
        }
        const double last = values[values.size() - entry.components + component];
        const std::string name =
            entry.components == 1 ? entry.path : fmt::format("{}[{}]", entry.path, component);
        fmt::print("  {:<28} {:>13.6g} {:>13.6g} {:>13.6g}  {}\n", name, least, most, last,
                   unit_of(entry.units, component));
    }
}

void print_series(const std::vector<SeriesRecord>& records) {
    if (records.empty()) return;
    fmt::print("\n  {:<28} {:>13} {:>13} {:>13}  {}\n", "series", "least", "most", "last", "unit");
    for (const auto& entry : series_datasets())
        print_ranges(entry, records);
}

void print_profiles(std::size_t segments) {
    fmt::print("\n  profiles\n");
    for (const auto& entry : profile_datasets()) {
        const std::size_t rows = entry.rows == Rows::nodes      ? segments + 1
                                 : entry.rows == Rows::segments ? segments
                                                                : 1;
        fmt::print("  {:<28} {:>5} x {}  {} ({})\n", entry.path, rows, entry.components,
                   entry.description, entry.units);
    }
}

void print_contents(const Result& result) {
    print_run(result);
    print_extent(result);
    print_series(result.series);
    print_profiles(result.header.segment_s.size());
}

template <class Record>
void print_datasets(const std::vector<RecordDataset<Record>>& layout) {
    for (const auto& entry : layout)
        fmt::print("  {:<24} {} ({})\n", entry.path, entry.description, entry.units);
}

void print_instability(const Instability& instability) {
    fmt::print("  under {:.10g} N  {} unstable shapes\n", instability.load,
               instability.modes.size());
    for (std::size_t k = 0; k < instability.modes.size(); ++k)
        fmt::print("  shape {:<10} {:.10g} N m2\n", k + 1, instability.modes[k].eigenvalue);
    if (!instability.modes.empty()) print_datasets(instability_datasets());
}

void print_contents(const BucklingResult& result) {
    fmt::print("  holds            buckling modes of the straight string\n");
    print_maker(result.version, result.commit);
    fmt::print("  segments         {}, string of {:.6g} m\n", result.header.segment_s.size(),
               result.header.node_s.empty() ? 0.0 : result.header.node_s.back());
    fmt::print("  discretisation   {}\n", discretisation_name(result.discretisation));
    for (std::size_t k = 0; k < result.modes.size(); ++k)
        fmt::print("  mode {:<11} {:.10g} N\n", k + 1, result.modes[k].load);
    print_datasets(buckling_datasets());
    if (result.instability) print_instability(*result.instability);
}

void print_contents(const TorqueDragResult& result) {
    const std::vector<double>& depths = result.study.bit_depth;
    fmt::print("  holds            torque and drag against the depth of the bit\n");
    print_maker(result.version, result.commit);
    fmt::print("  bit depths       {}, from {:.6g} to {:.6g} m\n", depths.size(), depths.front(),
               depths.back());
    fmt::print("  segments         {} at the last depth\n", result.header.segment_s.size());
    for (const TorqueDragCurve& curve : result.study.curves) {
        fmt::print(
            "  /torque_drag/{:<14} hook load at the last depth {:.9g} N, torque {:.6g} N m\n",
            motion_name(curve.motion), curve.hook_load.back(), curve.surface_torque.back());
        if (std::isfinite(curve.lock_up_depth))
            fmt::print("  {:<27} locks up with the bit at {:.6g} m\n", "", curve.lock_up_depth);
        if (std::isfinite(curve.largest_weight))
            fmt::print("  {:<27} largest weight that reaches the bit {:.6g} N\n", "",
                       curve.largest_weight);
    }
    for (const auto* table : {&torque_drag_depth_datasets(), &torque_drag_profile_datasets()})
        for (const TorqueDragDataset& entry : *table)
            fmt::print("  {:<24} {} ({})\n", entry.name, entry.description, entry.units);
}

void print_contents(const ModesResult& result) {
    fmt::print("  holds            modes of vibration about the static state\n");
    print_maker(result.version, result.commit);
    fmt::print("  segments         {}, string of {:.6g} m\n", result.header.segment_s.size(),
               result.header.node_s.back());
    fmt::print("  turning          {:.6g} rad/s\n", result.rotation_rate);
    for (std::size_t k = 0; k < result.modes.size(); ++k)
        fmt::print("  mode {:<11} {:.10g} Hz, {}\n", k + 1, result.modes[k].frequency / hertz(),
                   mode_kind_name(result.modes[k].kind));
    fmt::print("  Campbell         {} points, {} critical speeds\n", result.campbell.size(),
               result.critical_speeds.size());
    fmt::print("  response         {} rates\n", result.response.size());
    print_datasets(static_shape_datasets());
    print_datasets(mode_datasets());
    if (!result.campbell.empty()) print_datasets(campbell_datasets());
    if (!result.critical_speeds.empty()) print_datasets(critical_speed_datasets());
    if (!result.response.empty()) print_datasets(response_datasets());
}

}  // namespace

int info(const std::filesystem::path& result_path) {
    const Contents contents = read_apart(result_path);
    std::visit(
        [&](const auto& result) {
            print_title(result_path, result.header);
            print_contents(result);
        },
        contents);
    return done;
}

}  // namespace drillstrand::program
