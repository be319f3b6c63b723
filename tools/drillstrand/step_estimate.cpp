#include "step_estimate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "drillstrand/simulation.hpp"
#include "integrator_choice.hpp"

namespace drillstrand::program {

namespace {

/// Dormand-Prince 5(4) is stable for oscillations and for decay up to about 3.3 / step.
constexpr double dormand_prince_stability = 3.3;
constexpr double leapfrog_stability = 2;

void offer(StepEstimate& estimate, double rate, const char* process) {
    if (rate <= estimate.rate) return;
    estimate.rate = rate;
    estimate.process = process;
}

void offer_rod(StepEstimate& estimate, const Scene& scene, std::size_t k) {
    const StringMesh& mesh = scene.mesh;
    const SectionProperties& segment = mesh.segment[k];
    const double h = mesh.length[k];
    const double mass = std::min(mesh.node[k].mass, mesh.node[k + 1].mass);
    const double inertia = std::min(scene.inertia[k], scene.inertia[k + 1]);
    const double polar = std::min(mesh.node[k].polar_inertia, mesh.node[k + 1].polar_inertia);
    offer(estimate, std::sqrt(segment.shear_stiffness / inertia),
          "rotation of the cross sections against shear");
    offer(estimate, 2 / h * std::sqrt(segment.axial_stiffness / mass), "axial waves");
    offer(estimate, 2 / h * std::sqrt(segment.torsional_stiffness / polar), "torsional waves");
    offer(estimate, 2 / h * std::sqrt(segment.shear_stiffness / mass), "shear waves");
    offer(estimate, 2 / h * std::sqrt(segment.bending_stiffness / inertia), "bending waves");
}

void offer_contact(StepEstimate& estimate, const Scene& scene, std::size_t k) {
    const double mass = scene.mesh.node[k].mass;
    offer(estimate, std::sqrt(scene.contact.normal_stiffness / mass), "contact springs");
    offer(estimate, scene.normal_damping[k] / mass, "contact dashpots");
}

}  // namespace

StepEstimate estimate_step(const Case& input, const Scene& scene) {
    StepEstimate estimate;
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k)
        offer_rod(estimate, scene, k);
    const bool leapfrog = input.run.integrator == IntegratorKind::leapfrog;
    // The leapfrog solves contact implicitly.
    if (scene.features.well && !leapfrog)
        for (std::size_t k = 0; k < scene.mesh.node.size(); ++k)
            offer_contact(estimate, scene, k);
    estimate.step = leapfrog ? input.run.cfl * leapfrog_stability / estimate.rate
                             : dormand_prince_stability / estimate.rate;
    estimate.steps = std::ceil(input.run.duration / estimate.step);
    return estimate;
}

FirstSteps time_first_steps(const Case& input, const Scene& scene) {
    using Clock = std::chrono::steady_clock;
    constexpr auto enough = std::chrono::milliseconds(300);
    constexpr int steps_at_once = 20;
    const auto integrator = make_integrator(scene, integrator_options(input.run));
    const Clock::time_point start = Clock::now();
    while (Clock::now() - start < enough && integrator->time() < input.run.duration)
        integrator->advance(input.run.duration, steps_at_once);
    const double spent = std::chrono::duration<double>(Clock::now() - start).count();
    const auto count = static_cast<double>(integrator->statistics().steps);
    return {count, integrator->time() / count, spent / count};
}

}  // namespace drillstrand::program
