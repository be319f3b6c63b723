#include "report_series.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "drillstrand/energy_audit.hpp"
#include "report_string.hpp"

namespace drillstrand::program {

namespace {

using Records = std::vector<SeriesRecord>;
using Indices = std::vector<std::size_t>;

constexpr std::size_t most_records = 16000;
constexpr std::size_t most_uniform = 100000;

/// An array of `value(record)` of the picked records.
template <class Value>
void add(const char* name, const Records& series, const Indices& picks, ArrayBlock& arrays,
         Value&& value) {
    std::vector<double> values;
    for (const std::size_t k : picks)
        values.push_back(static_cast<double>(value(series[k])));
    arrays.add(name, values);
}

/// An array of the six components of a stress, each over all picked records.
void add_stress(const char* name, const Records& series, const Indices& picks,
                Vector6 SeriesRecord::*stress, ArrayBlock& arrays) {
    std::vector<double> values;
    for (int component = 0; component < 6; ++component)
        for (const std::size_t k : picks)
            values.push_back((series[k].*stress)[component]);
    arrays.add(name, values, {6, picks.size()});
}

void add_energy(const Records& series, const Indices& picks, ArrayBlock& arrays) {
    using E = EnergyAccount;
    std::vector<double> values;
    for (const auto part :
         {&E::kinetic, &E::elastic, &E::potential, &E::work, &E::dissipation, &E::rotation})
        for (const std::size_t k : picks)
            values.push_back(series[k].energy.*part);
    arrays.add("series/energy", values, {6, picks.size()});
    EnergyAudit audit;
    std::vector<double> residuals;
    for (const SeriesRecord& record : series) {
        audit.add(record.energy);
        residuals.push_back(audit.residual());
    }
    std::vector<double> picked;
    for (const std::size_t k : picks)
        picked.push_back(residuals[k]);
    arrays.add("series/energy_residual", picked);
}

/// Torque of the motor, where a drive stands between it and the string: else it is the surface's.
void add_drive_torque(const Records& series, const Indices& picks, ArrayBlock& arrays) {
    const bool driven = std::any_of(series.begin(), series.end(), [](const SeriesRecord& record) {
        return record.drive_torque != record.surface_torque;
    });
    if (driven)
        add("series/drive_torque", series, picks, arrays,
            [](const SeriesRecord& record) { return record.drive_torque; });
}

/// How far the bit went along the direction that it had in the first profile.
void add_travel(const Result& result, const Indices& picks, ArrayBlock& arrays) {
    const Eigen::Vector3d along = result.profiles.empty() ? Eigen::Vector3d(0, 0, 1)
                                                          : result.profiles.front().director.back();
    const Eigen::Vector3d start = result.series.front().bit_position;
    add("series/bit_travel", result.series, picks, arrays,
        [&](const SeriesRecord& record) { return along.dot(record.bit_position - start); });
}

void add_uniform(const Records& series, ArrayBlock& arrays) {
    const UniformSeries part = uniform_part(series);
    if (part.count < 2) return;
    Indices picks;
    for (std::size_t k = 0; k < part.count; ++k)
        picks.push_back(k * part.stride);
    add("dense/head_torque", series, picks, arrays,
        [](const SeriesRecord& record) { return record.surface_torque; });
    add("dense/bit_torque", series, picks, arrays,
        [](const SeriesRecord& record) { return record.bit_torque; });
    add("dense/head_rate", series, picks, arrays,
        [](const SeriesRecord& record) { return record.head_rotation_rate; });
    add("dense/bit_rate", series, picks, arrays,
        [](const SeriesRecord& record) { return record.bit_rotation_rate; });
}

}  // namespace

UniformSeries uniform_part(const Records& series) {
    UniformSeries part;
    if (series.size() < 2) return part;
    part.start = series.front().time;
    part.interval = series[1].time - part.start;
    const auto is_on_grid = [&](std::size_t k) {
        const double expected = part.start + static_cast<double>(k) * part.interval;
        return std::abs(series[k].time - expected) < 1e-3 * part.interval;
    };
    std::size_t count = 1;
    while (count < series.size() && is_on_grid(count))
        ++count;
    part.stride = (count + most_uniform - 1) / most_uniform;
    part.count = (count + part.stride - 1) / part.stride;
    part.interval *= static_cast<double>(part.stride);
    return part;
}

void add_series(const Result& result, ArrayBlock& arrays, std::vector<std::string>& notes) {
    using R = SeriesRecord;
    const Records& series = result.series;
    if (series.empty()) return;
    const Indices picks = pick_evenly(series.size(), most_records);
    std::vector<double> times;
    for (const std::size_t k : picks)
        times.push_back(series[k].time);
    arrays.add_exact("series/time", times);
    add_stress("series/head_stress", series, picks, &R::head_stress, arrays);
    add_stress("series/bit_stress", series, picks, &R::bit_stress, arrays);
    const auto one = [&](const char* name, auto member) {
        add(name, series, picks, arrays, [&](const R& record) { return record.*member; });
    };
    one("series/hook_load", &R::hook_load);
    one("series/surface_torque", &R::surface_torque);
    add_drive_torque(series, picks, arrays);
    one("series/weight_on_bit", &R::weight_on_bit);
    one("series/bit_torque", &R::bit_torque);
    one("series/head_rate", &R::head_rotation_rate);
    one("series/bit_rate", &R::bit_rotation_rate);
    one("series/step_size", &R::step_size);
    one("series/time_error", &R::time_error);
    one("series/max_penetration", &R::max_penetration);
    one("series/helix_penetration", &R::helix_penetration);
    one("series/wall_drag", &R::wall_drag);
    one("series/contact_nodes", &R::contact_nodes);
    one("series/impacts", &R::impacts);
    one("series/contact_changes", &R::contact_changes);
    one("series/slips", &R::slips);
    const auto of_whirl = [&](const char* name, auto member) {
        add(name, series, picks, arrays, [&](const R& record) { return record.whirl.*member; });
    };
    of_whirl("series/whirl_forward", &Whirl::forward);
    of_whirl("series/whirl_backward", &Whirl::backward);
    of_whirl("series/whirl_rate", &Whirl::rate);
    of_whirl("series/rolling_rate", &Whirl::rolling_rate);
    add_travel(result, picks, arrays);
    add_energy(series, picks, arrays);
    add_uniform(series, arrays);
    if (picks.size() < series.size())
        notes.push_back(fmt::format(
            "{} of {} records are drawn over time, evenly picked, to keep this page small.",
            picks.size(), series.size()));
}

}  // namespace drillstrand::program
