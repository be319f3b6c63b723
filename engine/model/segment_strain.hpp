/// Strains of a segment of the director rod, from the positions and directors of its two nodes:
/// engine/rod/README.md, "Director rod".
#pragma once

#include <cmath>

#include "numerics/kernel.hpp"
#include "numerics/triple.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// How a segment's directors bend from t_a to t_b by the angle b. The curvature is
/// kb = f (t_a x t_b) / h with f = b / sin b.
struct SegmentBend {
    Triple turn;         ///< t_a x t_b
    double cosine;       ///< cos b
    double inverse_one;  ///< 1 / (1 + cos b)

    DRILLSTRAND_INLINE SegmentBend(const Triple& ta, const Triple& tb)
        : turn(cross(ta, tb)), cosine(dot(ta, tb)), inverse_one(1.0 / (1.0 + cosine)) {}

    /// f of b up to 90 degrees, from tan(b/2) = |t_a x t_b| / (1 + cos b).
    [[nodiscard]] DRILLSTRAND_INLINE double factor() const {
        return 2.0 * arctangent_ratio(dot(turn, turn) * inverse_one * inverse_one) * inverse_one;
    }
    /// 1 / |t_a + t_b|
    [[nodiscard]] DRILLSTRAND_INLINE double inverse_both() const {
        return std::sqrt(0.5 * inverse_one);
    }
};

/// How a segment's chord stretches and shears: D = dx / h, mean director m, g = D . m, sh = D - g
/// m.
struct SegmentStretch {
    Triple chord;   ///< D
    Triple mean;    ///< m
    double along;   ///< g
    Triple across;  ///< sh

    DRILLSTRAND_INLINE SegmentStretch(const Triple& xa, const Triple& xb, double inverse_length,
                                      const Triple& ta, const Triple& tb, double inverse_both)
        : chord(combine(inverse_length, xb, -inverse_length, xa)),
          mean(combine(inverse_both, ta, inverse_both, tb)),
          along(dot(chord, mean)),
          across(combine(1.0, chord, -along, mean)) {}
};

/// Curvature that a cross section with its own shape would have in the frame of a node (1/m).
DRILLSTRAND_INLINE Triple own_curvature(double bend1, double bend2, const Triple& t,
                                        const Triple& d1) {
    return combine(bend1, d1, bend2, cross(t, d1));
}

}  // namespace drillstrand
