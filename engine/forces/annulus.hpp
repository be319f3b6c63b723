/// The eccentric annulus between a pipe and its hole in bipolar coordinates, in which its flows are
/// known in closed form: what drag and added mass share (engine/forces/README.md, "Fluid").
#pragma once

#include <cmath>

#include "numerics/kernel.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// Lengths in m; eccentricity below hole - pipe. The circles lie at coordinates that are D apart,
/// sinh D = T / (2 R Rw).
struct Annulus {
    double eccentricity, pipe, hole;
    double spread;    ///< T (m2)
    double sinh;      ///< of D
    double cosh;      ///< of D
    double distance;  ///< D

    DRILLSTRAND_INLINE Annulus(double e, double pipe_radius, double hole_radius)
        : eccentricity(e),
          pipe(pipe_radius),
          hole(hole_radius),
          spread(std::sqrt((hole - pipe - e) * (hole + pipe - e) * (hole - pipe + e) *
                           (hole + pipe + e))),
          sinh(spread / (2.0 * pipe * hole)),
          cosh(std::sqrt(1.0 + sinh * sinh)),
          // asinh(sinh D), to 1e-16 / D: films are not thin enough for more to matter
          distance(log1p_nonnegative(sinh + (cosh - 1.0))) {}
    /// What was computed before.
    DRILLSTRAND_INLINE Annulus(double e, double pipe_radius, double hole_radius, double t,
                               double sinh_d, double cosh_d, double d)
        : eccentricity(e),
          pipe(pipe_radius),
          hole(hole_radius),
          spread(t),
          sinh(sinh_d),
          cosh(cosh_d),
          distance(d) {}
};

/// The pipe around which mud flows: formulas of the annulus need a gap, of a hundredth of the hole.
DRILLSTRAND_INLINE double flow_radius(double pipe, double hole) {
    const double most = 0.99 * hole;
    return pipe < most ? pipe : most;
}

/// Eccentricity for drag and added mass: the film counts as no thinner than `film` times the
/// clearance, which keeps the near-touching limit finite and leaves every other position exact.
DRILLSTRAND_INLINE double film_eccentricity(double eccentricity, double pipe, double hole,
                                            double film) {
    const double most = (1.0 - film) * (hole - pipe);
    return eccentricity < most ? eccentricity : most;
}

}  // namespace drillstrand
