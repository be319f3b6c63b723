/// Added mass of a pipe that moves sideways in an eccentric annulus: potential flow of the fluid
/// between two cylinders. Derivation and validity: engine/forces/README.md, "Added mass".
#pragma once

#include <cmath>

#include "forces/fluid.hpp"
#include "numerics/kernel.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// The mass in units of that of the fluid which the pipe displaces, rho pi R^2, and its slope over
/// the eccentricity (1/m). Isotropic: the same in every direction across the axis.
struct AddedMass {
    double coefficient;
    double slope;
};

/// Cm = 1 + 2 sum_m g(m), g(m) = 1 / (cosh m D + K sinh m D)^2, K = (Rw^2 - R^2 - e^2) / T, with D
/// and T as in drag_coefficients(): the images of the pipe in the wall, the wall in the pipe, and
/// so on. The first terms are added up, the others follow from their integral (Euler and Maclaurin)
/// to 1e-10. Lengths in m; eccentricity below hole - pipe.
DRILLSTRAND_INLINE AddedMass added_mass(double eccentricity, double pipe, double hole) {
    constexpr int terms = 8;
    const double e2 = eccentricity * eccentricity;
    const double pipe2 = pipe * pipe;
    const double hole2 = hole * hole;
    const double q = 2.0 * pipe * hole;
    const double between = hole2 - pipe2 - e2;
    const double t2 = (hole - pipe - eccentricity) * (hole + pipe - eccentricity) *
                      (hole - pipe + eccentricity) * (hole + pipe + eccentricity);
    const double inverse_t = 1.0 / std::sqrt(t2);
    const double k = between * inverse_t;
    const double sinh_d = t2 * inverse_t / q;
    const double cosh_d = std::sqrt(1.0 + sinh_d * sinh_d);
    const double d = log1p_nonnegative(sinh_d + (cosh_d - 1.0));

    // what the sum changes by per unit of K and of D; each term: h = coth of its place
    double sum = 0.0;
    double by_k = 0.0;
    double by_d = 0.0;
    double cosh_m = cosh_d;
    double sinh_m = sinh_d;
    for (int m = 1; m < terms; ++m) {
        const double w = 1.0 / (cosh_m + k * sinh_m);
        const double g = w * w;
        sum += g;
        by_k -= 2.0 * sinh_m * w * g;
        by_d -= 2.0 * m * (sinh_m + k * cosh_m) * w * g;
        const double next = cosh_m * cosh_d + sinh_m * sinh_d;
        sinh_m = sinh_m * cosh_d + cosh_m * sinh_d;
        cosh_m = next;
    }

    // from the eighth term on: integral, half the first, its odd derivatives
    constexpr double first = terms;
    const double w = 1.0 / (cosh_m + k * sinh_m);
    const double g = w * w;
    const double h = (sinh_m + k * cosh_m) * w;
    const double h2 = h * h;
    const double d2 = d * d;
    const double integral = (cosh_m - sinh_m) * w / ((k + 1.0) * d);
    const double odd = d * (1.0 / 6.0) - d * d2 * (3.0 * h2 - 2.0) * (1.0 / 90.0) +
                       d * d2 * d2 * (45.0 * h2 * h2 - 60.0 * h2 + 17.0) * (1.0 / 1890.0);
    const double odd_by_h =
        -d * d2 * h * (1.0 / 15.0) + d * d2 * d2 * h * (180.0 * h2 - 120.0) * (1.0 / 1890.0);
    const double odd_by_d = 1.0 / 6.0 - d2 * (3.0 * h2 - 2.0) * (1.0 / 30.0) +
                            d2 * d2 * (45.0 * h2 * h2 - 60.0 * h2 + 17.0) * (1.0 / 378.0);
    const double tail = 0.5 + h * odd;  // times g
    const double tail_by_h = odd + h * odd_by_h;
    sum += integral + g * tail;
    by_k += -integral * (sinh_m * w + 1.0 / (k + 1.0)) - 2.0 * sinh_m * w * g * tail +
            g * tail_by_h * g;
    by_d += -integral * (first + first * h + 1.0 / d) - 2.0 * first * h * g * tail +
            g * (h * odd_by_d - tail_by_h * first * (h2 - 1.0));

    // dT/de = -2 e (Rw^2 + R^2 - e^2) / T, dD/de = -2 e / T
    const double d_by_e = -2.0 * eccentricity * inverse_t;
    const double k_by_e =
        2.0 * eccentricity * inverse_t * (k * (hole2 + pipe2 - e2) * inverse_t - 1.0);
    return {1.0 + 2.0 * sum, 2.0 * (by_k * k_by_e + by_d * d_by_e)};
}

/// The same at any eccentricity: in the last `film` of the clearance and in the wall it stays what
/// it is there, as the drag does, and has no slope.
DRILLSTRAND_INLINE AddedMass added_mass_up_to_film(double eccentricity, double pipe, double hole,
                                                   double film) {
    const double at = drag_eccentricity(eccentricity, pipe, hole, film);
    const AddedMass added = added_mass(at, pipe, hole);
    return {added.coefficient, at < eccentricity ? 0.0 : added.slope};
}

}  // namespace drillstrand
