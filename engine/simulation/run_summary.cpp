#include "drillstrand/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace drillstrand {

namespace {

constexpr double large_energy_residual = 0.01;

/// Time in which an axial wave runs along the string (s).
double axial_travel_time(const StringMesh& mesh) {
    double time = 0;
    for (std::size_t k = 0; k < mesh.length.size(); ++k)
        time += mesh.length[k] * std::sqrt(mesh.segment[k].mass / mesh.segment[k].axial_stiffness);
    return time;
}

}  // namespace

RunSummary::RunSummary(const Scene& scene)
    : notes_(scene.notes),
      settled_after_(std::max(1.0, 4 * axial_travel_time(scene.mesh))),
      last_part_(scene, settled_after_) {}

RunSummary::RunSummary(const Scene& scene, const Case& input) : RunSummary(scene) {
    if (input.output.cycles) cycles_.emplace(scene.mesh, input.string, *input.output.cycles);
}

void RunSummary::add(const BendingRecord& record) {
    if (cycles_) cycles_->add(record);
}

SegmentCycles RunSummary::cycles() const {
    return cycles_ ? cycles_->segments() : SegmentCycles();
}

void RunSummary::add(const SeriesRecord& record) {
    audit_.add(record.energy);
    last_part_.add(record);
    if (record.relative_penetration > relative_penetration_) deepest_time_ = record.time;
    if (record.max_penetration > penetration_) {
        penetration_ = record.max_penetration;
        penetration_time_ = record.time;
        penetration_depth_ = record.penetration_depth;
    }
    helix_penetration_ = std::max(helix_penetration_, record.helix_penetration);
    relative_penetration_ = std::max(relative_penetration_, record.relative_penetration);
    if (record.time_error == latest_time_error_) return;
    latest_time_error_ = record.time_error;
    if (record.time <= settled_after_)
        time_error_at_start_ = std::max(time_error_at_start_, record.time_error);
    else
        time_errors_.push_back(record.time_error);
}

double RunSummary::time_error_largest() const {
    return time_errors_.empty() ? time_error_at_start_
                                : *std::max_element(time_errors_.begin(), time_errors_.end());
}

double RunSummary::time_error_median() const {
    if (time_errors_.empty()) return time_error_at_start_;
    std::vector<double> sorted = time_errors_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

std::vector<std::string> RunSummary::findings() const {
    std::vector<std::string> lines = last_part_.findings();
    if (penetration_ > 0)
        lines.push_back(
            fmt::format("penetration: {:.3g} mm at most, at {:.4g} m of measured depth at t = "
                        "{:.4g} s; {:.2g} of the "
                        "clearance at most; a helix of the string's compression {:.3g} mm at most",
                        1e3 * penetration_, penetration_depth_, penetration_time_,
                        relative_penetration_, 1e3 * helix_penetration_));
    if (cycles_)
        for (std::string& line : cycles_->findings())
            lines.push_back(std::move(line));
    return lines;
}

std::vector<std::string> RunSummary::warnings() const {
    std::vector<std::string> sentences = notes_;
    for (std::string& sentence : last_part_.warnings())
        sentences.push_back(std::move(sentence));
    if (relative_penetration_ > 1)
        sentences.push_back(fmt::format(
            "the pipe lay up to {:.3g} m deep in the wall, {:.2g} times its clearance, at t = "
            "{:.6g} "
            "s: the wall is too soft for what presses on it; raise contact.normal_stiffness",
            penetration_, relative_penetration_, deepest_time_));
    const double residual = energy_residual();
    if (std::abs(residual) > large_energy_residual)
        sentences.push_back(
            fmt::format("{:.2g} % of the energy that moved {}; the time steps are too long, or the "
                        "scene gains energy",
                        100 * std::abs(residual),
                        residual > 0 ? "appeared from nowhere" : "vanished unaccounted for"));
    return sentences;
}

SavedState RunSummary::save() const {
    SavedState saved = audit_.save();
    for (SavedRow& row : last_part_.save())
        saved.push_back(std::move(row));
    saved.push_back({"penetration",
                     "m, s, m, m, 1, s",
                     {penetration_, penetration_time_, penetration_depth_, helix_penetration_,
                      relative_penetration_, deepest_time_}});
    saved.push_back({"time_error", "1", {time_error_at_start_, latest_time_error_}});
    if (cycles_)
        for (SavedRow& row : cycles_->save())
            saved.push_back(std::move(row));
    if (!time_errors_.empty()) saved.push_back({"time_errors", "1", time_errors_});
    return saved;
}

void RunSummary::restore(const SavedState& saved) {
    EnergyAudit audit;
    audit.restore(saved);
    LastPart last_part = last_part_;
    last_part.restore(saved);
    std::optional<BendingCycles> cycles = cycles_;
    if (cycles) cycles->restore(saved);
    const auto values_of = [&](const char* name, std::size_t size) -> const std::vector<double>& {
        for (const SavedRow& row : saved) {
            if (row.name == name && row.values.size() == size) return row.values;
        }
        throw std::invalid_argument(fmt::format("the saved summary has no row {}", name));
    };
    const std::vector<double>& depth = values_of("penetration", 6);
    const std::vector<double>& error = values_of("time_error", 2);
    audit_ = audit;
    last_part_ = last_part;
    cycles_ = cycles;
    penetration_ = depth[0];
    penetration_time_ = depth[1];
    penetration_depth_ = depth[2];
    helix_penetration_ = depth[3];
    relative_penetration_ = depth[4];
    deepest_time_ = depth[5];
    time_error_at_start_ = error[0];
    latest_time_error_ = error[1];
    time_errors_.clear();
    for (const SavedRow& row : saved) {
        if (row.name == "time_errors") time_errors_ = row.values;
    }
}

}  // namespace drillstrand
