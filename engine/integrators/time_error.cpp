#include "integrators/time_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rod/report.hpp"

namespace drillstrand {

namespace {

constexpr double safety = 0.9;
constexpr double least_change = 0.5;
constexpr double most_change = 1.5;
constexpr double least_factor = 1.0 / 64;
/// A sample repeats three windows of steps. Where it decides the step it pays to take many.
constexpr std::int64_t steps_between_decisions = 256;
constexpr std::int64_t most_steps_between_looks = 8192;

}  // namespace

double rod_energy(const Scene& scene, const Profile& profile) {
    double sum = elastic_energy(scene, profile.stress);
    for (std::size_t k = 0; k < profile.momentum.size(); ++k)
        sum += kinetic_energy(scene, k, profile.fluid_mass[k], profile.momentum[k]);
    return sum;
}

double rod_energy_between(const Scene& scene, const Profile& one, const Profile& other) {
    Profile difference;
    difference.fluid_mass = other.fluid_mass;
    for (std::size_t k = 0; k < one.momentum.size(); ++k)
        difference.momentum.emplace_back(one.momentum[k] - other.momentum[k]);
    for (std::size_t k = 0; k < one.stress.size(); ++k)
        difference.stress.emplace_back(one.stress[k] - other.stress[k]);
    return rod_energy(scene, difference);
}

double negligible_energy(const Scene& scene) {
    constexpr double strain = 1e-10;
    double sum = 0;
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k)
        sum += 0.5 * scene.mesh.length[k] * scene.mesh.segment[k].axial_stiffness * strain * strain;
    return sum;
}

void TimeErrorControl::add(TimeError& found, std::int64_t steps, double time, double energy,
                           double difference) const {
    constexpr double richardson = 4.0 / 3;  // second order: half the step leaves a quarter
    found.scale = std::max({found.scale, negligible_, energy});
    const double error = richardson * std::sqrt(difference / found.scale);
    if (tolerance_ > 0) {
        const double wanted = error > 0 ? safety * std::sqrt(tolerance_ / error) : most_change;
        const double factor = found.factor * std::clamp(wanted, least_change, most_change);
        const bool can_shorten = found.factor > least_factor;
        found.factor = std::clamp(factor, least_factor, 1.0);
        if (error > tolerance_ && can_shorten) return;
        if (error > tolerance_) found.missed = 1;
    }
    found.due = next_due(steps);
    found.latest = error;
    if (error <= found.largest) return;
    found.largest = error;
    found.largest_time = time;
}

std::int64_t TimeErrorControl::next_due(std::int64_t steps) const {
    if (tolerance_ > 0) return steps + steps_between_decisions;
    return steps + std::clamp(steps, window, most_steps_between_looks);
}

std::optional<std::string> TimeErrorControl::warning(const TimeError& found) const {
    if (found.missed == 0) return std::nullopt;
    return fmt::format(
        "the time error was above run.tolerance with the shortest steps, {:.2g} of the "
        "stable one: {:.2g} in 16 steps from t = {:.6g} s on",
        least_factor, found.largest, found.largest_time);
}

}  // namespace drillstrand
