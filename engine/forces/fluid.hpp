/// Drag of the annular fluid on a pipe that moves and spins in an eccentric well: creeping flow,
/// and what inertia adds to it. Equations, assumptions and validity: engine/forces/README.md,
/// "Fluid".
#pragma once

#include <cmath>

#include "forces/annulus.hpp"
#include "numerics/kernel.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// Drag per unit length, of creeping flow per unit viscosity, as coefficients of the node's
/// velocity (v_r, v_l, v_t) and spin w_l. The matrix of (v_t, w_l) is symmetric (Onsager).
struct DragCoefficients {
    double radial;  ///< B: force against v_r
    double axial;   ///< force against v_l
    double around;  ///< A / v_t: force against v_t
    double cross;   ///< A / w_l = M / v_t: never positive
    double spin;    ///< M / w_l: couple against w_l (m2)
};

/// Finn and Cox (2001) in a form that is regular in the concentric limit, and the exact axial
/// Couette flow between eccentric cylinders.
DRILLSTRAND_INLINE DragCoefficients drag_coefficients(const Annulus& annulus) {
    constexpr double pi = 3.14159265358979323846;
    const double e2 = annulus.eccentricity * annulus.eccentricity;
    const double pipe2 = annulus.pipe * annulus.pipe;
    const double hole2 = annulus.hole * annulus.hole;
    const double d = annulus.distance;
    const double d2 = d * d;

    // Phi = D cosh D - sinh D; its difference form loses digits for small D.
    const double series =
        d * d2 * (1.0 / 3.0) *
        (1.0 + d2 * (1.0 / 10.0) *
                   (1.0 + d2 * (1.0 / 28.0) *
                              (1.0 + d2 * (1.0 / 54.0) *
                                         (1.0 + d2 * (1.0 / 88.0) * (1.0 + d2 * (1.0 / 130.0))))));
    const double phi = d < 0.5 ? series : d * annulus.cosh - annulus.sinh;
    const FourInverses inverse(phi, d, 2.0 * annulus.pipe * annulus.hole * phi + e2 * d,
                               annulus.sinh);
    const double scale = 4.0 * pi * inverse.c;
    return {4.0 * pi * annulus.cosh * inverse.a, 2.0 * pi * inverse.b, scale * (pipe2 + hole2),
            -scale * pipe2 * annulus.eccentricity, scale * pipe2 * (hole2 * phi * inverse.d + e2)};
}

/// Axial drag coefficient of concentric cylinders, the paper's choice.
DRILLSTRAND_INLINE double concentric_axial_drag(double pipe, double hole) {
    constexpr double pi = 3.14159265358979323846;
    // 2 pi / ln(hole / pipe)
    return 2.0 * pi / log1p_nonnegative((hole - pipe) / pipe);
}

/// All coefficients times a number: the viscosity, or 0 where there is no drag.
DRILLSTRAND_INLINE DragCoefficients scaled(const DragCoefficients& drag, double factor) {
    return {factor * drag.radial, factor * drag.axial, factor * drag.around, factor * drag.cross,
            factor * drag.spin};
}

/// The inertia of the flow around one pipe in one hole, from flow_inertia().
struct FlowInertia {
    double cross;           ///< cross flow: force over speed^2 (N s2/m3)
    double swirl;           ///< rotation: rho pi R^4 (t/R)^0.3 / 2 (kg m)
    double swirl_reynolds;  ///< R t / nu: Reynolds number over the spin (s)
    double stream;          ///< axial flow: force over speed^1.75
};

/// Cross flow: drag coefficient C_d of a cylinder, with the speed in the gap that the pipe leaves,
/// v Rw / (Rw - R) (blockage). Rotation: Bilgen and Boulos (1973). Axial: Blasius' friction factor,
/// hydraulic diameter of the annulus. SI units; without viscosity cross flow alone is left.
inline FlowInertia flow_inertia(double density, double viscosity, double drag_coefficient,
                                double pipe, double hole) {
    constexpr double pi = 3.14159265358979323846;
    const double gap = hole - pipe;
    const double blockage = hole / gap;
    FlowInertia flow{density * drag_coefficient * pipe * blockage * blockage, 0.0, 0.0, 0.0};
    if (viscosity > 0) {
        const double kinematic = viscosity / density;
        flow.swirl = 0.5 * density * pi * std::pow(pipe, 4) * std::pow(gap / pipe, 0.3);
        flow.swirl_reynolds = pipe * gap / kinematic;
        flow.stream = 0.079 * density * pi * pipe * std::pow(2.0 * gap / kinematic, -0.25);
    }
    return flow;
}

/// Torque coefficient of a cylinder that turns in another, over (t/R)^0.3, past laminar flow: 1.03
/// Re^-1/2 up to Re = 1e4 and 0.065 Re^-1/5 from there on, Re = R w t / nu. Finite at Re = 0.
DRILLSTRAND_INLINE double swirl_coefficient(double reynolds) {
    const double vortices = 1.03 / std::sqrt(1.0 + reynolds);
    const double turbulence = 0.065 * exp_of_minus(0.2 * log1p_nonnegative(reynolds));
    return vortices > turbulence ? vortices : turbulence;
}

/// The drag of creeping flow (N s/m2, N s) and of the flow's inertia at these speeds. Cross flow
/// adds up; rotation and axial flow go over from the one law to the other as the root of the sum of
/// squares. Only the diagonal grows: what was symmetric and positive definite stays so.
DRILLSTRAND_INLINE DragCoefficients with_inertia(const DragCoefficients& creeping,
                                                 const FlowInertia& flow, double radius,
                                                 double across, double along, double spin) {
    const double form = flow.cross * across;
    const double turn = std::abs(spin);
    const double swirl = flow.swirl * turn * swirl_coefficient(flow.swirl_reynolds * turn);
    // the wall of the pipe slides past the fluid with both its motions
    const double surface = std::sqrt(along * along + radius * radius * spin * spin);
    const double root = std::sqrt(surface);
    const double stream = flow.stream * root * std::sqrt(root);
    return {creeping.radial + form, std::sqrt(creeping.axial * creeping.axial + stream * stream),
            creeping.around + form, creeping.cross,
            std::sqrt(creeping.spin * creeping.spin + swirl * swirl)};
}

/// What is left of a drag where the pipe comes to the wall. Coefficients of friction are measured
/// in mud: from touch-down on they hold the shear of the film too, which fades out over the last
/// `film` of the clearance, so that no force jumps. The film goes on to resist being squeezed and
/// pushed aside. Where `wet_in_contact` is 0 rather than 1, a pipe that touches gets no drag and
/// nothing fades (paper).
DRILLSTRAND_INLINE DragCoefficients around_wall(const DragCoefficients& drag, double eccentricity,
                                                double pipe, double hole, double film,
                                                double wet_in_contact) {
    const double clearance = hole - pipe;
    const double left = (clearance - eccentricity) / (film * clearance);
    const double below = left < 1.0 ? left : 1.0;
    const double fading = below > 0.0 ? below : 0.0;
    const double shear = wet_in_contact > 0.0 ? fading : 1.0;
    const double wet = eccentricity > clearance ? wet_in_contact : 1.0;
    return {wet * drag.radial, wet * shear * drag.axial, wet * drag.around,
            wet * shear * drag.cross, wet * shear * drag.spin};
}

}  // namespace drillstrand
