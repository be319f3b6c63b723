/// How vector kernels are compiled.
///
/// A kernel is a plain function whose loops carry `#pragma omp simd`, marked DRILLSTRAND_KERNEL.
/// `at_level<kernel>(level)` is its version for an instruction set: on x86-64, the compiler makes
/// one for every machine, one for AVX2 and one for AVX-512, and the caller chooses. Functions
/// called inside such a loop are DRILLSTRAND_INLINE and free of branches and of calls other than
/// sqrt: they are written once, and tests and cold code call them for single nodes.
#pragma once

#include "drillstrand/isa.hpp"

#if defined(DRILLSTRAND_DISPATCH) && defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRILLSTRAND_LEVELS
#endif

#define DRILLSTRAND_INLINE [[gnu::always_inline]] inline

/// Mark of a kernel: its versions are made of its body, there is no function besides them.
#define DRILLSTRAND_KERNEL DRILLSTRAND_INLINE

/// Mark of the body of a vector loop, written as a lambda: variables declared in an `omp simd` loop
/// itself are laid out in memory per lane, which keeps g++ 12 from vectorising larger bodies.
#define DRILLSTRAND_LAMBDA __attribute__((always_inline))

namespace drillstrand {

/// The versions of a kernel.
template <auto kernel>
struct Versions;

template <class Result, class... Arguments, Result (*kernel)(Arguments...)>
struct Versions<kernel> {
    [[gnu::flatten]] static Result baseline(Arguments... arguments) { return kernel(arguments...); }
#if defined(DRILLSTRAND_LEVELS)
    [[gnu::target("arch=x86-64-v3"), gnu::flatten]] static Result avx2(Arguments... arguments) {
        return kernel(arguments...);
    }
    [[gnu::target("arch=x86-64-v4"), gnu::flatten]] static Result avx512(Arguments... arguments) {
        return kernel(arguments...);
    }
    [[gnu::target("arch=x86-64-v3"), gnu::optimize("fp-contract=off"), gnu::flatten]] static Result
    avx2_unfused(Arguments... arguments) {
        return kernel(arguments...);
    }
    [[gnu::target("arch=x86-64-v4"), gnu::optimize("fp-contract=off"), gnu::flatten]] static Result
    avx512_unfused(Arguments... arguments) {
        return kernel(arguments...);
    }
#endif
    static constexpr auto at([[maybe_unused]] Level level) {
#if defined(DRILLSTRAND_LEVELS)
        if (level.isa == Isa::avx512) return level.reproducible ? avx512_unfused : avx512;
        if (level.isa == Isa::avx2) return level.reproducible ? avx2_unfused : avx2;
#endif
        return baseline;
    }
};

/// The version of a kernel for a level that this machine runs, see best_isa().
template <auto kernel>
constexpr auto at_level(Level level) {
    return Versions<kernel>::at(level);
}

}  // namespace drillstrand
