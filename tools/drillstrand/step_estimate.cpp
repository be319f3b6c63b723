#include "step_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "drillstrand/simulation.hpp"

namespace drillstrand::program {

namespace {

std::vector<std::string> describe_substeps(const StepPlan& plan, double step,
                                           const StringMesh& mesh) {
    std::vector<std::string> sentences;
    for (const FineStretch& stretch : plan.stretches) {
        const auto begin = mesh.length.begin();
        const auto [least, most] =
            std::minmax_element(begin + static_cast<std::ptrdiff_t>(stretch.first),
                                begin + static_cast<std::ptrdiff_t>(stretch.end));
        sentences.push_back(fmt::format(
            "{} in each step from {:.5g} to {:.5g} m along the string, on {} segments of {:.3g} to "
            "{:.3g} m",
            substeps_in(stretch, plan.undamped(step)), mesh.node_s[stretch.first],
            mesh.node_s[stretch.end], stretch.end - stretch.first, *least, *most));
    }
    return sentences;
}

}  // namespace

StepEstimate estimate_step(const Case& input, const Scene& scene) {
    StepEstimate estimate;
    if (input.run.integrator == IntegratorKind::leapfrog) {
        const StepPlan plan = step_plan(scene);
        estimate.bound = plan.bound;
        estimate.bound.step *= input.run.cfl;
        estimate.substeps = describe_substeps(plan, estimate.bound.step, scene.mesh);
    } else {
        estimate.bound = step_bound(scene, input.run.integrator);
    }
    estimate.steps = std::ceil(input.run.duration / estimate.bound.step);
    return estimate;
}

FirstSteps time_first_steps(const Case& input, const Scene& scene) {
    using Clock = std::chrono::steady_clock;
    constexpr auto enough = std::chrono::milliseconds(300);
    constexpr int most_steps_at_once = 20;
    int steps_at_once = 1;
    const auto integrator = make_integrator(scene, integrator_options(input.run));
    const Clock::time_point start = Clock::now();
    while (Clock::now() - start < enough && integrator->time() < input.run.duration) {
        integrator->advance(input.run.duration, steps_at_once);
        steps_at_once = std::min(2 * steps_at_once, most_steps_at_once);
    }
    const double spent = std::chrono::duration<double>(Clock::now() - start).count();
    const auto count = static_cast<double>(integrator->statistics().steps);
    return {count, integrator->time() / count, integrator->threads(), spent / count};
}

}  // namespace drillstrand::program
