/// Laminar drag of the annular fluid on a pipe that moves and spins in an eccentric well.
/// Equations, assumptions and validity: engine/forces/README.md, "Fluid".
#pragma once

#include <cmath>

#include "numerics/kernel.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// Drag per unit length per unit viscosity, as coefficients of the node's velocity (v_r, v_l, v_t)
/// and spin w_l. The matrix of (v_t, w_l) is symmetric (Onsager).
struct DragCoefficients {
    double radial;  ///< B: force against v_r
    double axial;   ///< force against v_l
    double around;  ///< A / v_t: force against v_t
    double cross;   ///< A / w_l = M / v_t: never positive
    double spin;    ///< M / w_l: couple against w_l (m2)
};

/// Finn and Cox (2001) in a form that is regular in the concentric limit, and the exact axial
/// Couette flow between eccentric cylinders. Lengths in m; eccentricity below hole - pipe.
DRILLSTRAND_INLINE DragCoefficients drag_coefficients(double eccentricity, double pipe,
                                                      double hole) {
    constexpr double pi = 3.14159265358979323846;
    const double e2 = eccentricity * eccentricity;
    const double pipe2 = pipe * pipe;
    const double hole2 = hole * hole;
    const double q = 2.0 * pipe * hole;
    const double t = std::sqrt((hole - pipe - eccentricity) * (hole + pipe - eccentricity) *
                               (hole - pipe + eccentricity) * (hole + pipe + eccentricity));
    const double sinh_d = t / q;
    const double cosh_d = std::sqrt(1.0 + sinh_d * sinh_d);
    // asinh(sinh D), to 1e-16 / D: films are not thin enough for more to matter
    const double d = log1p_nonnegative(sinh_d + (cosh_d - 1.0));
    const double d2 = d * d;

    // Phi = D cosh D - sinh D; its difference form loses digits for small D.
    const double series =
        d * d2 * (1.0 / 3.0) *
        (1.0 + d2 * (1.0 / 10.0) *
                   (1.0 + d2 * (1.0 / 28.0) *
                              (1.0 + d2 * (1.0 / 54.0) *
                                         (1.0 + d2 * (1.0 / 88.0) * (1.0 + d2 * (1.0 / 130.0))))));
    const double phi = d < 0.5 ? series : d * cosh_d - sinh_d;
    const double scale = 4.0 * pi / (q * phi + e2 * d);
    return {4.0 * pi * cosh_d / phi, 2.0 * pi / d, scale * (pipe2 + hole2),
            -scale * pipe2 * eccentricity, scale * pipe2 * (hole2 * phi / sinh_d + e2)};
}

/// Axial drag coefficient of concentric cylinders, the paper's choice.
DRILLSTRAND_INLINE double concentric_axial_drag(double pipe, double hole) {
    constexpr double pi = 3.14159265358979323846;
    // 2 pi / ln(hole / pipe)
    return 2.0 * pi / log1p_nonnegative((hole - pipe) / pipe);
}

/// Eccentricity for the drag: the film counts as no thinner than `film` times the clearance, which
/// keeps the near-touching limit finite and leaves every other position exact.
DRILLSTRAND_INLINE double drag_eccentricity(double eccentricity, double pipe, double hole,
                                            double film) {
    const double most = (1.0 - film) * (hole - pipe);
    return eccentricity < most ? eccentricity : most;
}

}  // namespace drillstrand
