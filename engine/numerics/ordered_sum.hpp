/// Sums in kernels.
#pragma once

#include <cstddef>

#include "numerics/kernel.hpp"

namespace drillstrand {

/// Sum of `count` numbers, a multiple of 8, in an order that does not depend on the width of
/// vectors: eight sums over every eighth number, then these by halves.
DRILLSTRAND_INLINE double ordered_sum(const double* values, std::size_t count) {
    constexpr std::size_t strands = 8;
    double sum[strands] = {};
    for (std::size_t first = 0; first < count; first += strands) {
#pragma omp simd
        for (std::size_t i = 0; i < strands; ++i)
            sum[i] += values[first + i];
    }
    for (std::size_t half = strands / 2; half > 0; half /= 2) {
        for (std::size_t i = 0; i < half; ++i)
            sum[i] += sum[i + half];
    }
    return sum[0];
}

}  // namespace drillstrand
