#include "integrators/time_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rod/strand.hpp"

namespace drillstrand {

namespace {

constexpr double safety = 0.9;
constexpr double least_change = 0.5;
constexpr double most_change = 1.5;
constexpr double least_factor = 1.0 / 64;
/// A sample repeats three windows of steps. Where it decides the step it pays to take many.
constexpr std::int64_t steps_between_decisions = 256;
constexpr std::int64_t most_steps_between_looks = 8192;

Vector6 inertia_of(const Scene& scene, std::size_t node) {
    const SectionProperties& section = scene.mesh.node[node];
    Vector6 inertia;
    inertia << section.polar_inertia, scene.inertia[node], scene.inertia[node], section.mass,
        section.mass, section.mass;
    return inertia;
}

/// Sum over nodes and segments of the energy of momenta and stresses that two functions give.
template <class Momentum, class Stress>
double energy_of(const Scene& scene, const Momentum& momentum, const Stress& stress) {
    double sum = 0;
    for (std::size_t k = 0; k < scene.mesh.cell.size(); ++k) {
        const Vector6 p = momentum(k);
        sum += 0.5 * scene.mesh.cell[k] * p.dot(p.cwiseQuotient(inertia_of(scene, k)));
    }
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k) {
        const Vector6 s = stress(k);
        sum += 0.5 * scene.mesh.length[k] *
               s.dot(s.cwiseQuotient(stiffness_of(scene.mesh.segment[k])));
    }
    return sum;
}

}  // namespace

double rod_energy(const Scene& scene, const Profile& profile) {
    return energy_of(
        scene, [&](std::size_t k) { return profile.momentum[k]; },
        [&](std::size_t k) { return profile.stress[k]; });
}

double rod_energy_between(const Scene& scene, const Profile& one, const Profile& other) {
    return energy_of(
        scene, [&](std::size_t k) -> Vector6 { return one.momentum[k] - other.momentum[k]; },
        [&](std::size_t k) -> Vector6 { return one.stress[k] - other.stress[k]; });
}

double negligible_energy(const Scene& scene) {
    constexpr double strain = 1e-10;
    double sum = 0;
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k)
        sum += 0.5 * scene.mesh.length[k] * scene.mesh.segment[k].axial_stiffness * strain * strain;
    return sum;
}

void TimeErrorControl::add(std::int64_t steps, double time, double energy, double difference) {
    constexpr double richardson = 4.0 / 3;  // second order: half the step leaves a quarter
    scale_ = std::max(scale_, energy);
    const double error = richardson * std::sqrt(difference / scale_);
    if (tolerance_ > 0) {
        const double wanted = error > 0 ? safety * std::sqrt(tolerance_ / error) : most_change;
        const double factor = factor_ * std::clamp(wanted, least_change, most_change);
        const bool can_shorten = factor_ > least_factor;
        factor_ = std::clamp(factor, least_factor, 1.0);
        if (error > tolerance_ && can_shorten) return;
        if (error > tolerance_) missed_ = true;
    }
    due_ = next_due(steps);
    latest_ = error;
    if (error <= largest_) return;
    largest_ = error;
    largest_time_ = time;
}

std::int64_t TimeErrorControl::next_due(std::int64_t steps) const {
    if (tolerance_ > 0) return steps + steps_between_decisions;
    return steps + std::clamp(steps, window, most_steps_between_looks);
}

std::optional<std::string> TimeErrorControl::warning() const {
    if (!missed_) return std::nullopt;
    return fmt::format(
        "the time error was above run.tolerance with the shortest steps, {:.2g} of the "
        "stable one: {:.2g} in 16 steps from t = {:.6g} s on",
        least_factor, largest_, largest_time_);
}

}  // namespace drillstrand
