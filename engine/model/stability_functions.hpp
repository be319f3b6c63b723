/// What axial force does to the bending of a segment between its nodes: the stability functions of
/// frame analysis (engine/rod/README.md, "Segment").
#pragma once

#include "numerics/kernel.hpp"

namespace drillstrand {

/// Stability functions of z = (axial strain) EA h^2 / EI, tension positive, and their derivatives
/// by z. With X(y) = sqrt(y) coth sqrt(y), y = z/4, the stiffness of a segment against the angle
/// between its ends is EI/h (r_s + z/12), r_s = X - z/12; that against its chord leaving their mean
/// direction 12 EI/h (r_a + z/60), r_a = Y - z/60, X = 1 + y/(3 Y). Both are 1 without axial force,
/// and one formula holds for tension and compression.
///
/// From q_n = 2n + 1 + y/q_(n+1), X = q_0, Y = q_1/3, and q_n' = (1 - q_n/q_(n+1))/2. The fraction
/// of q_2 ends at 17: to 1e-12 down to a half wave per segment, to 1e-6 up to z = 100.
struct StabilityFunctions {
    double symmetric;            ///< r_s - 1: free of cancellation
    double symmetric_slope;      ///< r_s'
    double antisymmetric;        ///< r_a
    double antisymmetric_slope;  ///< r_a'

    DRILLSTRAND_INLINE explicit StabilityFunctions(double z) {
        const double y = 0.25 * z;
        const double above = 11486475.0 + y * (810810.0 + y * (12870.0 + y * 44.0));
        const double below = 2297295.0 + y * (96525.0 + y * (858.0 + y));
        const double three = 3.0 * above + y * below;  // q_1 = three / above
        const double inverse = 1.0 / (above * three);
        const double inverse_q1 = above * above * inverse;
        const double inverse_q2 = below * three * inverse;
        symmetric = y * y * inverse_q1 * inverse_q2 * (-1.0 / 3.0);
        symmetric_slope = 0.25 * (1.0 / 6.0 - 0.5 * inverse_q1 * (1.0 + y * inverse_q1));
        antisymmetric = 1.0 + y * (inverse_q2 - 0.2) * (1.0 / 3.0);
        antisymmetric_slope =
            0.25 * (0.1 - 0.5 * inverse_q2 * (1.0 + y * inverse_q2 * (1.0 / 3.0)));
    }
};

/// X(y) = sqrt(y) coth sqrt(y).
[[nodiscard]] inline double hyperbolic_cotangent_ratio(double y) {
    const StabilityFunctions f(4.0 * y);
    return 1.0 + f.symmetric + y * (1.0 / 3.0);
}

}  // namespace drillstrand
