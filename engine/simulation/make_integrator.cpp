#include <omp.h>

#include <algorithm>
#include <stdexcept>

#include "drillstrand/simulation.hpp"
#include "integrators/dormand_prince.hpp"
#include "integrators/leapfrog.hpp"
#include "numerics/block_table.hpp"

namespace drillstrand {

std::unique_ptr<Integrator> make_integrator(const Scene& scene, const IntegratorOptions& options) {
    const int wanted = options.threads > 0 ? options.threads : omp_get_num_procs();
    // a thread without a block would only wait
    const auto blocks = static_cast<int>(blocks_for(static_cast<std::size_t>(scene.segments) + 1));
    const int threads = std::clamp(wanted, 1, blocks);
    switch (options.kind) {
        case IntegratorKind::dormand_prince:
            return std::make_unique<DormandPrince>(
                scene, Tolerances{options.absolute_tolerance, options.relative_tolerance}, threads);
        case IntegratorKind::leapfrog:
            return std::make_unique<Leapfrog>(scene, options.cfl, options.stress_limit, threads);
    }
    throw std::invalid_argument("make_integrator: no such integrator");
}

}  // namespace drillstrand
