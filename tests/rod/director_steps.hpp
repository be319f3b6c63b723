/// Steps of a whole director rod by the vector kernels of the engine, on plain states.
#pragma once

#include "drillstrand/scene.hpp"
#include "rod/director_plain.hpp"

namespace drillstrand::test {

/// The same as plain_director_step().
StepAccount kernel_director_step(const Scene& scene, PlainRod& rod, const EndLoad& head,
                                 const EndLoad& bit, double drift_before, double kick,
                                 double drift);

}  // namespace drillstrand::test
