/// Branch-free elementary functions that the compiler can vectorise, to a few units in the last
/// place. (g++ 12 vectorises calls of the C library only under -ffast-math.)
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "numerics/kernel.hpp"

namespace drillstrand {

/// The trigonometric factors of the exponential map of a rotation by the angle t.
struct RotationFactors {
    double sine;        ///< sin t / t
    double cosine;      ///< (1 - cos t) / t^2
    double difference;  ///< (t - sin t) / t^3
};

/// Taylor series in t^2, to rounding for t up to pi. Argument: t^2.
DRILLSTRAND_INLINE RotationFactors rotation_factors(double t2) {
    // 1 / (2n + 2)! and 1 / (2n + 3)! by Horner's rule from n = 14 down: each factor divides the
    // rest of the series by the two integers that its factorial gains.
    double cosine = 1.0;
    double difference = 1.0;
#pragma GCC unroll 14
    for (int n = 14; n > 0; --n) {
        cosine = 1.0 - t2 * cosine * (1.0 / ((2.0 * n + 1.0) * (2.0 * n + 2.0)));
        difference = 1.0 - t2 * difference * (1.0 / ((2.0 * n + 2.0) * (2.0 * n + 3.0)));
    }
    cosine *= 0.5;
    difference *= 1.0 / 6.0;
    return {1.0 - t2 * difference, cosine, difference};
}

/// Inverses of four numbers, by one division: it takes as long as a dozen products.
struct FourInverses {
    double a, b, c, d;
    DRILLSTRAND_INLINE FourInverses(double of_a, double of_b, double of_c, double of_d) {
        const double ab = of_a * of_b;
        const double cd = of_c * of_d;
        const double all = 1.0 / (ab * cd);
        const double inverse_ab = all * cd;
        const double inverse_cd = all * ab;
        a = inverse_ab * of_b;
        b = inverse_ab * of_a;
        c = inverse_cd * of_d;
        d = inverse_cd * of_c;
    }
};

/// log(1 + y) for y >= 0.
DRILLSTRAND_INLINE double log1p_nonnegative(double y) {
    constexpr std::uint64_t sqrt_half_bits = 0x3fe6a09e667f3bcdULL;
    constexpr std::uint64_t two_to_52_bits = 0x4330000000000000ULL;
    constexpr double two_to_52 = 0x1p52;
    constexpr double ln2_high = 0x1.62e42fefa38p-1;
    constexpr double ln2_low = 0x1.ef35793c7673p-45;

    // 1 + y = 2^e m with m between sqrt(1/2) and sqrt(2); what rounding loses is added at the end.
    const double u = 1.0 + y;
    const double lost = (y - (u - 1.0)) / u;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(u);
    const std::uint64_t exponent = (bits - sqrt_half_bits) >> 52U;
    const double e = std::bit_cast<double>(exponent | two_to_52_bits) - two_to_52;
    const double m = std::bit_cast<double>(bits - (exponent << 52U));

    // log m = 2 artanh(s), s = (m - 1) / (m + 1), |s| < 0.172.
    const double s = (m - 1.0) / (m + 1.0);
    const double z = s * s;
    double series = 1.0 / 23.0;
#pragma GCC unroll 11
    for (int n = 10; n >= 0; --n)
        series = series * z + 1.0 / (2.0 * n + 1.0);
    return e * ln2_high + (2.0 * s * series + (lost + e * ln2_low));
}

/// exp(-x) for 0 <= x < 10, to 1e-11: Taylor's series of exp(-x / 256), squared eight times.
DRILLSTRAND_INLINE double exp_of_minus(double x) {
    const double y = x * (-1.0 / 256.0);
    double power = 1.0 + y * (1.0 / 6.0);
#pragma GCC unroll 5
    for (int n = 5; n > 0; --n)
        power = 1.0 + y * power * (1.0 / n);
#pragma GCC unroll 8
    for (int i = 0; i < 8; ++i)
        power *= power;
    return power;
}

/// atan(u) / u for 0 <= u <= 1, from u^2, to 4e-14: the Chebyshev series in u^2 of degree 15.
DRILLSTRAND_INLINE double arctangent_ratio(double u2) {
    constexpr double coefficient[] = {
        0.9999999999999597,     -0.3333333333121758,   0.19999999814897454,
        -0.1428570785262614,    0.11110992975824877,   -0.09089586783080124,
        0.07682489346522672,    -0.06615566641488574,  0.05688664321892274,
        -0.047130745595821213,  0.03563652077133338,   -0.022994749256908153,
        0.011746429010568394,   -0.004344643015423943, 0.0010182697360652825,
        -0.00011243675960279107};
    // Horner's rule for even and odd powers side by side: half as long to wait
    const double u4 = u2 * u2;
    double even = coefficient[14];
    double odd = coefficient[15];
#pragma GCC unroll 7
    for (int n = 12; n >= 0; n -= 2) {
        even = even * u4 + coefficient[n];
        odd = odd * u4 + coefficient[n + 1];
    }
    return even + u2 * odd;
}

}  // namespace drillstrand
