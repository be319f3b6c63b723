/// How vector kernels are compiled.
///
/// A kernel is a plain function whose loops carry `#pragma omp simd`. DRILLSTRAND_KERNEL makes the
/// compiler emit it for x86-64, AVX2 and AVX-512 machines and choose when the program starts.
/// Functions called inside such a loop are DRILLSTRAND_INLINE and free of branches and of calls
/// other than sqrt: they are written once, and tests and cold code call them for single nodes.
#pragma once

#if defined(DRILLSTRAND_DISPATCH) && defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRILLSTRAND_KERNEL \
    [[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), gnu::flatten]]
#else
#define DRILLSTRAND_KERNEL
#endif

#define DRILLSTRAND_INLINE [[gnu::always_inline]] inline

/// Mark of the body of a vector loop, written as a lambda: variables declared in an `omp simd` loop
/// itself are laid out in memory per lane, which keeps g++ 12 from vectorising larger bodies.
#define DRILLSTRAND_LAMBDA __attribute__((always_inline))
