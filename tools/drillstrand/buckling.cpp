/// drillstrand buckling: critical loads of the straight string.
#include "drillstrand/buckling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "case_of.hpp"
#include "commands.hpp"
#include "drillstrand/buckling_file.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/units.hpp"
#include "messages.hpp"
#include "output.hpp"

namespace drillstrand::program {

namespace {

StraightRod rod_of(const Case& input, const Scene& scene, Discretisation discretisation) {
    if (scene.head.motion != HeadMotion::driven)
        throw InputError({input.path.string()},
                         "head.motion is not \"driven\": buckling needs a clamped head");
    return straight_rod(scene, discretisation);
}

std::vector<BucklingMode> modes_of(const StraightRod& rod, std::optional<std::size_t> asked) {
    constexpr std::size_t usual = 6;
    const std::size_t available = count_buckling_modes(rod);
    if (asked && *asked > available)
        throw UsageError(
            fmt::format("--modes {}: a rod of {} segments has {} modes here; ask for "
                        "at most {}",
                        *asked, rod.length.size(), available, available));
    if (available == 0)
        throw std::invalid_argument(
            "the string's segments are too long to tell a mode of buckling; take more of them");
    return buckling_modes(rod, asked.value_or(std::min(usual, available)));
}

/// None where --at-load is not given.
std::optional<double> load_of(const std::string& text) {
    if (text.empty()) return std::nullopt;
    try {
        return parse_quantity(text, dimension::force);
    } catch (const std::invalid_argument& error) {
        throw UsageError(fmt::format("--at-load {}: {}", text, error.what()));
    }
}

Instability instability_of(const StraightRod& rod, double load) {
    const double highest = highest_buckling_load(rod);
    if (load >= highest)
        throw UsageError(fmt::format(
            "--at-load: {:.6g} N is more than {} segments can follow; ask for less than {:.6g} N, "
            "or for more segments",
            load, rod.length.size(), highest));
    return find_instability(rod, load);
}

/// Bending stiffness of a weightless rod that is the same all along, for which Euler's loads hold.
std::optional<double> euler_stiffness(const StraightRod& rod) {
    const auto [least, most] =
        std::minmax_element(rod.bending_stiffness.begin(), rod.bending_stiffness.end());
    const bool is_weightless = std::all_of(rod.weight_below.begin(), rod.weight_below.end(),
                                           [](double weight) { return weight == 0; });
    // Means over segments differ in the last digit.
    if (!is_weightless || *most - *least > 1e-9 * *most) return std::nullopt;
    return *most;
}

/// Load of the continuous column in mode `index`, counted from 0 in pairs (N).
double euler_load(double stiffness, double length, std::size_t index) {
    const double waves = static_cast<double>(index / 2) + 0.5;
    return stiffness * std::pow(waves * std::numbers::pi / length, 2);
}

void print_rod(const Case& input, const Scene& scene, const StraightRod& rod) {
    const Eigen::Vector3d along = scene.head_frame.col(0);
    fmt::print("{}: {}\n", input.path.string(), input.title);
    fmt::print(
        "  {:<8} {:.6g} m in {} segments, straight along ({:.4g}, {:.4g}, {:.4g}), clamped "
        "at the head\n",
        "rod", scene.mesh.node_s.back(), rod.length.size(), along.x(), along.y(), along.z());
    fmt::print("  {:<8} {}\n", "segments",
               rod.discretisation == Discretisation::paper
                   ? "the paper's: constant strain, a whole one's weight at the tip"
                   : "exact beam-columns");
    fmt::print("  {:<8} {:.6g} N along the rod below the first segment\n", "weight",
               rod.weight_below.front());
    fmt::print("  {:<8} dead, along the rod, above weight; no wall, no torque\n\n", "load");
}

void print_modes(const std::vector<BucklingMode>& modes, const StraightRod& rod, double length) {
    const std::optional<double> stiffness = euler_stiffness(rod);
    fmt::print("  {:>5}  {:<11}  {:>18}{}\n", "mode", "bends about", "critical load (N)",
               stiffness ? fmt::format("  {:>12}", "over Euler's") : "");
    for (std::size_t k = 0; k < modes.size(); ++k) {
        const double load = modes[k].load;
        fmt::print(
            "  {:>5}  {:<11}  {:>18.10g}{}\n", k + 1, k % 2 == 0 ? "d1" : "d2", load,
            stiffness ? fmt::format("  {:>12.6f}", load / euler_load(*stiffness, length, k)) : "");
    }
}

void print_instability(const Instability& instability) {
    fmt::print("\n  under {:.10g} N: {} unstable shapes\n", instability.load,
               instability.modes.size());
    if (instability.modes.empty()) return;
    fmt::print("  {:>5}  {:<11}  {:>18}\n", "shape", "bends about", "eigenvalue (N m2)");
    for (std::size_t k = 0; k < instability.modes.size(); ++k)
        fmt::print("  {:>5}  {:<11}  {:>18.10g}\n", k + 1, k % 2 == 0 ? "d1" : "d2",
                   instability.modes[k].eigenvalue);
}

void print_notes(const Scene& scene) {
    const double tilt = std::abs(scene.down.dot(scene.head_frame.col(0)));
    const bool has_weight = std::any_of(scene.weight.begin(), scene.weight.end(),
                                        [](double weight) { return weight != 0; });
    if (has_weight && tilt < 1 - 1e-12)
        say("drillstrand: note: the rod is not vertical; its weight counts with the "
            "component along it, the one across it is left out\n");
    const std::vector<double>& weights = scene.bit.weight.values();
    const bool has_load =
        std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 0; });
    if (has_load && scene.bit.direction == BitDirection::follower)
        say("drillstrand: note: bit.direction = \"follower\": a load that turns with the bit "
            "has no critical load of this kind, the string flutters (drillstrand run shows "
            "it); the loads above are those of a dead load\n");
}

void write_result(const Case& input, const Scene& scene, const BucklingOptions& options,
                  BucklingResult result) {
    result.header.title = input.title;
    result.header.case_text = input.text;
    result.header.node_s = scene.mesh.node_s;
    result.header.segment_s = scene.mesh.segment_s;
    result.discretisation = options.discretisation;
    write_buckling(options.output, result, options.overwrite ? Existing::replace : Existing::keep);
}

}  // namespace

int buckling(const BucklingOptions& options) {
    const std::optional<double> load = load_of(options.at_load);
    const Case input = case_of(options.case_path, options.overrides);
    require_output("-o", options.output, {options.overwrite, inputs_of(input)});
    const Scene scene = build_static_scene(input);
    StraightRod rod;
    BucklingResult result;
    try {
        rod = rod_of(input, scene, options.discretisation);
        result.modes = modes_of(rod, options.modes);
        if (load) result.instability = instability_of(rod, *load);
    } catch (const std::invalid_argument& error) {
        throw InputError({input.path.string()}, error.what());
    }
    if (!options.output.empty()) write_result(input, scene, options, result);
    print_rod(input, scene, rod);
    print_modes(result.modes, rod, scene.mesh.node_s.back());
    if (result.instability) print_instability(*result.instability);
    print_notes(scene);
    return done;
}

}  // namespace drillstrand::program
