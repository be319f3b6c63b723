/// Added mass of a pipe that moves sideways in an eccentric annulus: potential flow of the fluid
/// between two cylinders. Derivation and validity: engine/forces/README.md, "Added mass".
#pragma once

#include <cmath>

#include "forces/annulus.hpp"
#include "numerics/kernel.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// The mass in units of that of the fluid which the pipe displaces, rho pi R^2, and its slope over
/// the eccentricity (1/m). Isotropic: the same in every direction across the axis.
struct AddedMass {
    double coefficient;
    double slope;
};

/// Hyperbolic functions of m D, and w = 1 / (cosh m D + K sinh m D).
struct Harmonic {
    double cosh, sinh;

    [[nodiscard]] DRILLSTRAND_INLINE Harmonic next(const Harmonic& first) const {
        return {cosh * first.cosh + sinh * first.sinh, sinh * first.cosh + cosh * first.sinh};
    }
    [[nodiscard]] DRILLSTRAND_INLINE double denominator(double k) const { return cosh + k * sinh; }
};

/// Cm = 1 + 2 sum_m g(m), g(m) = w^2, K = (Rw^2 - R^2 - e^2) / T: the images of the pipe in the
/// wall, the wall in the pipe, and so on. The first terms are added up, the others follow from
/// their integral (Euler and Maclaurin) to 1e-10.
DRILLSTRAND_INLINE AddedMass added_mass(const Annulus& annulus) {
    const double e = annulus.eccentricity;
    const double e2 = e * e;
    const double pipe2 = annulus.pipe * annulus.pipe;
    const double hole2 = annulus.hole * annulus.hole;
    const double inverse_t = 1.0 / annulus.spread;
    const double k = (hole2 - pipe2 - e2) * inverse_t;
    const double d = annulus.distance;

    const Harmonic h1 = {annulus.cosh, annulus.sinh};
    const Harmonic h2 = h1.next(h1);
    const Harmonic h3 = h2.next(h1);
    const Harmonic h4 = h3.next(h1);
    const Harmonic h5 = h4.next(h1);
    const Harmonic h6 = h5.next(h1);
    const Harmonic h7 = h6.next(h1);
    const Harmonic h8 = h7.next(h1);
    const FourInverses w1(h1.denominator(k), h2.denominator(k), h3.denominator(k),
                          h4.denominator(k));
    const FourInverses w5(h5.denominator(k), h6.denominator(k), h7.denominator(k),
                          h8.denominator(k));

    // what the sum changes by per unit of K and of D
    double sum = 0.0;
    double by_k = 0.0;
    double by_d = 0.0;
    const auto add = [&](double m, const Harmonic& term, double w) DRILLSTRAND_LAMBDA {
        const double g = w * w;
        sum += g;
        by_k -= 2.0 * term.sinh * w * g;
        by_d -= 2.0 * m * (term.sinh + k * term.cosh) * w * g;
    };
    add(1.0, h1, w1.a);
    add(2.0, h2, w1.b);
    add(3.0, h3, w1.c);
    add(4.0, h4, w1.d);
    add(5.0, h5, w5.a);
    add(6.0, h6, w5.b);
    add(7.0, h7, w5.c);

    // from the eighth term on: integral, half the first, its odd derivatives; h = coth of its place
    constexpr double first = 8.0;
    const double w = w5.d;
    const double g = w * w;
    const double h = (h8.sinh + k * h8.cosh) * w;
    const double coth2 = h * h;
    const double d2 = d * d;
    const double inverse = 1.0 / ((k + 1.0) * d);
    const double inverse_k = inverse * d;
    const double inverse_d = inverse * (k + 1.0);
    const double integral = (h8.cosh - h8.sinh) * w * inverse;
    const double odd = d * (1.0 / 6.0) - d * d2 * (3.0 * coth2 - 2.0) * (1.0 / 90.0) +
                       d * d2 * d2 * (45.0 * coth2 * coth2 - 60.0 * coth2 + 17.0) * (1.0 / 1890.0);
    const double odd_by_h =
        -d * d2 * h * (1.0 / 15.0) + d * d2 * d2 * h * (180.0 * coth2 - 120.0) * (1.0 / 1890.0);
    const double odd_by_d = 1.0 / 6.0 - d2 * (3.0 * coth2 - 2.0) * (1.0 / 30.0) +
                            d2 * d2 * (45.0 * coth2 * coth2 - 60.0 * coth2 + 17.0) * (1.0 / 378.0);
    const double tail = 0.5 + h * odd;  // times g
    const double tail_by_h = odd + h * odd_by_h;
    sum += integral + g * tail;
    by_k +=
        -integral * (h8.sinh * w + inverse_k) - 2.0 * h8.sinh * w * g * tail + g * tail_by_h * g;
    by_d += -integral * (first + first * h + inverse_d) - 2.0 * first * h * g * tail +
            g * (h * odd_by_d - tail_by_h * first * (coth2 - 1.0));

    // dT/de = -2 e (Rw^2 + R^2 - e^2) / T, dD/de = -2 e / T
    const double d_by_e = -2.0 * e * inverse_t;
    const double k_by_e = 2.0 * e * inverse_t * (k * (hole2 + pipe2 - e2) * inverse_t - 1.0);
    return {1.0 + 2.0 * sum, 2.0 * (by_k * k_by_e + by_d * d_by_e)};
}

/// The same at any eccentricity, of the annulus with a film: in the last `film` of the clearance
/// and in the wall it stays what it is there, as the drag does, and has no slope.
DRILLSTRAND_INLINE AddedMass added_mass(const Annulus& annulus, double eccentricity) {
    const AddedMass added = added_mass(annulus);
    return {added.coefficient, annulus.eccentricity < eccentricity ? 0.0 : added.slope};
}

}  // namespace drillstrand
