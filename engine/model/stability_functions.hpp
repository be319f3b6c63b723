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
/// From q_n = 2n + 1 + y/q_(n+1), X = q_0, Y = q_1/3. The fraction of q_2 ends at 17: to 1e-11 down
/// to a half wave per segment, z = -pi^2, and up to z = 10, to 1e-6 up to 58, to 1e-5 up to 100;
/// derivatives are those of what it is, for forces to have an energy at any z.
struct StabilityFunctions {
    double symmetric;            ///< r_s - 1: free of cancellation
    double symmetric_slope;      ///< r_s'
    double antisymmetric;        ///< r_a
    double antisymmetric_slope;  ///< r_a'

    DRILLSTRAND_INLINE explicit StabilityFunctions(double z) {
        const double y = 0.25 * z;
        const double above = 11486475.0 + y * (810810.0 + y * (12870.0 + y * 44.0));
        const double below = 2297295.0 + y * (96525.0 + y * (858.0 + y));
        const double above_slope = 810810.0 + y * (25740.0 + y * 132.0);
        const double below_slope = 96525.0 + y * (1716.0 + y * 3.0);
        const double three = 3.0 * above + y * below;  // q_1 = three / above
        const double inverse = 1.0 / (above * three);
        const double inverse_above = three * inverse;
        const double inverse_q1 = above * above * inverse;
        const double inverse_q2 = below * inverse_above;
        const double q1_slope =
            inverse_q2 + y * (below_slope - inverse_q2 * above_slope) * inverse_above;
        symmetric = y * y * inverse_q1 * inverse_q2 * (-1.0 / 3.0);
        symmetric_slope = 0.25 * (inverse_q1 * (1.0 - y * q1_slope * inverse_q1) - 1.0 / 3.0);
        antisymmetric = 1.0 + y * (inverse_q2 - 0.2) * (1.0 / 3.0);
        antisymmetric_slope = (q1_slope - 0.2) * (1.0 / 12.0);
    }
};

/// Second derivatives of the stability functions by z, of the same fraction, for tangents.
struct StabilityCurvatures {
    double symmetric;      ///< r_s''
    double antisymmetric;  ///< r_a''

    explicit StabilityCurvatures(double z) {
        const double y = 0.25 * z;
        Fraction q{17, 0, 0};
        for (int term = 15; term >= 3; term -= 2)
            q = q.below(term, y);
        antisymmetric = q.curvature / 48;
        symmetric = q.below(1, y).curvature / 16;
    }

  private:
    /// q_n and its derivatives by y.
    struct Fraction {
        double value, slope, curvature;
        [[nodiscard]] Fraction below(double term, double y) const {
            const double below_slope = (1 - y * slope / value) / value;
            return {term + y / value, below_slope,
                    -(2 * slope * below_slope + y * curvature / value) / value};
        }
    };
};

}  // namespace drillstrand
