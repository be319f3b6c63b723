/// A kernel whose entries depend on each other, so that no compiler can vectorise it: what the
/// object code looks like when vectorisation is lost.
#include <cstddef>

#include "numerics/block_table.hpp"
#include "numerics/kernel.hpp"

namespace drillstrand {

DRILLSTRAND_KERNEL void sequential_kernel(double* x, double a) {
    for (std::size_t k = 1; k < block_size; ++k)
        x[k] = x[k] / (x[k - 1] + a) - a * x[k - 1];
}

template struct Versions<sequential_kernel>;

}  // namespace drillstrand
