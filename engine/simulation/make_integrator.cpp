#include <omp.h>

#include <algorithm>
#include <stdexcept>

#include "drillstrand/simulation.hpp"
#include "integrators/dormand_prince.hpp"
#include "integrators/leapfrog.hpp"
#include "numerics/block_table.hpp"

namespace drillstrand {

namespace {

/// Threads for a string of so many blocks where the user leaves the choice. Threads meet at every
/// step: a short string's share is done before the meeting pays. The leapfrog's threads part where
/// other work keeps them waiting for each other; dormand-prince's do not, and must be worth more.
int automatic_threads(IntegratorKind kind, int blocks) {
    const int worthwhile_blocks = kind == IntegratorKind::leapfrog ? 10 : 32;
    return std::clamp(blocks / worthwhile_blocks, 1, omp_get_num_procs());
}

}  // namespace

IntegratorOptions integrator_options(const RunCase& run) {
    IntegratorOptions options;
    options.kind = run.integrator;
    options.absolute_tolerance = run.absolute_tolerance;
    options.relative_tolerance = run.relative_tolerance;
    options.cfl = run.cfl;
    options.tolerance = run.tolerance;
    options.threads = run.threads;
    options.stress_limit = run.stress_limit;
    options.reproducible = run.reproducible;
    return options;
}

std::unique_ptr<Integrator> make_integrator(const Scene& scene, const IntegratorOptions& options) {
    if (options.isa > best_isa())
        throw std::invalid_argument("make_integrator: no kernels for this instruction set");
    const auto blocks = static_cast<int>(blocks_for(static_cast<std::size_t>(scene.segments) + 1));
    const int threads = options.threads > 0 ? std::min(options.threads, blocks)
                                            : automatic_threads(options.kind, blocks);
    switch (options.kind) {
        case IntegratorKind::dormand_prince:
            return std::make_unique<DormandPrince>(
                scene, Tolerances{options.absolute_tolerance, options.relative_tolerance}, threads,
                Level{options.isa, options.reproducible});
        case IntegratorKind::leapfrog:
            return std::make_unique<Leapfrog>(scene, options.cfl, options.tolerance,
                                              options.stress_limit, threads,
                                              Level{options.isa, options.reproducible});
    }
    throw std::invalid_argument("make_integrator: no such integrator");
}

}  // namespace drillstrand
