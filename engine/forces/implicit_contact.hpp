/// Contact, friction and drag of one node over a step, implicit and in closed form: stable for any
/// stiffness, damping and viscosity. Derivation: engine/forces/README.md, "Implicit step".
///
/// Everything is per unit length and in the node's well frame. `dt` is the time over which forces
/// act on velocities. A star marks velocities after all other forces have acted.
#pragma once

#include <cmath>

#include "forces/contact.hpp"
#include "forces/fluid.hpp"
#include "numerics/kernel.hpp"

namespace drillstrand {

/// Velocity of a node along (r, l, t), and its spin about l.
struct WellVelocity {
    double r, l, t;  ///< m/s
    double spin;     ///< rad/s
};

/// What a force does to a velocity over the step. Fluid goes along sideways.
struct Mobility {
    double across;    ///< dt / (m + mass of the fluid that moves along)
    double along;     ///< dt / m
    double rotation;  ///< dt / (rho Ip)
};

/// The normal force stiffness * dr - resistance * v_r with v_r = v_r* + dt f / m.
DRILLSTRAND_INLINE double resisting_force(double penetration, double velocity_r, double stiffness,
                                          double resistance, double least,
                                          const Mobility& mobility) {
    const double force =
        (stiffness * penetration - resistance * velocity_r) / (1.0 + mobility.across * resistance);
    const double bounded = force > least ? force : least;
    return penetration > 0.0 ? bounded : 0.0;
}

/// Normal force at the end of the step: k (dr - dt v_r) - eta v_r.
DRILLSTRAND_INLINE double implicit_normal_force(double penetration, double velocity_r,
                                                double stiffness, double damping, double least,
                                                double dt, const Mobility& mobility) {
    return resisting_force(penetration, velocity_r, stiffness, damping + dt * stiffness, least,
                           mobility);
}

/// Normal force of Hertz's spring with Hunt and Crossley's damping, K dr^1.5 (1 - chi v_r). Of the
/// way within the step the spring counts the share g = a / (2 + a), a = k dt^2 / m with the tangent
/// k = 1.5 K dr^0.5: little where steps tell the contact, so that it keeps its energy, all of it
/// where they do not, so that it never gains.
DRILLSTRAND_INLINE double implicit_hertz_force(double penetration, double velocity_r,
                                               double stiffness, double hunt_crossley, double least,
                                               double dt, const Mobility& mobility) {
    const double secant = secant_stiffness(NormalLaw::hertz, stiffness, penetration);
    const double stiffening = dt * tangent_stiffness(NormalLaw::hertz, stiffness, penetration);
    const double swing = mobility.across * stiffening;
    const double resistance =
        hunt_crossley * secant * penetration + stiffening * (swing / (2.0 + swing));
    return resisting_force(penetration, velocity_r, secant, resistance, least, mobility);
}

/// Speed v_r (m/s) that keeps a node which moves around the well with v_t at its distance from the
/// axis: within a step it moves straight on, and comes to (e - dt v_r)^2 + (dt v_t)^2 = e^2. It is
/// v_r less this speed that springs and dashpots see: at v_r itself they would miss dt v_t^2 / 2 e,
/// and a stiff dashpot let a whirling node creep into the wall. A way longer than e counts as e.
DRILLSTRAND_INLINE double circling_speed(double eccentricity, double velocity_t, double dt) {
    constexpr double tiny = 1e-30;
    const double e = eccentricity;
    const double speed = std::abs(velocity_t);
    const double way = dt * speed < e ? dt * speed : e;
    return speed * way / (e + std::sqrt(e * e - way * way) + tiny);
}

/// A friction spring and the force with which it acts on the pipe, at the end of the step.
struct FrictionStep {
    FrictionSpring spring;
    Tangential force;
};

/// Force of the spring on Coulomb's cone while the point slides: the F on the ellipse
/// |F / mu| = f_n with F_i (a_i + lambda) = b_i, where b is the elongation that no force would
/// leave and a_i = dt M_i + 1 / k what a unit of force takes from it; lambda F is the slip.
///
/// With w = b / mu, P = a_l + lambda and Q = a_t + lambda, |F / mu| = n / (P Q) with
/// n^2 = w_l^2 Q^2 + w_t^2 P^2. Newton's method on its inverse P Q / n, which is almost linear in
/// lambda: the step is n^2 (n / f_n - P Q) / (w_l^2 Q^3 + w_t^2 P^3). Last, exactly onto the cone.
DRILLSTRAND_INLINE Tangential return_to_cone(const Tangential& b, const Tangential& a,
                                             const FrictionParameters& p, double normal) {
    constexpr double tiny = 1e-30;
    constexpr int rounds = 3;
    const double w_l = b.axial * p.slide_inverse.axial;
    const double w_t = b.azimuthal * p.slide_inverse.azimuthal;
    const double w_l2 = w_l * w_l;
    const double w_t2 = w_t * w_t;
    const double inverse_limit = 1.0 / (normal > tiny ? normal : tiny);
    const double most = a.axial > a.azimuthal ? a.axial : a.azimuthal;
    const double start = std::sqrt(w_l2 + w_t2) * inverse_limit - most;
    double lambda = start > 0.0 ? start : 0.0;
#pragma GCC unroll 3
    for (int i = 0; i < rounds; ++i) {
        const double l = a.axial + lambda;
        const double t = a.azimuthal + lambda;
        const double n2 = w_l2 * t * t + w_t2 * l * l;
        const double slope = w_l2 * t * t * t + w_t2 * l * l * l;
        const double miss = std::sqrt(n2) * inverse_limit - l * t;
        // the quotient does not wait for the root
        const double corrected = lambda + n2 / (slope > 0.0 ? slope : 1.0) * miss;
        lambda = corrected > 0.0 ? corrected : 0.0;
    }
    const double f_l = w_l * (a.azimuthal + lambda);
    const double f_t = w_t * (a.axial + lambda);
    const double reached2 = f_l * f_l + f_t * f_t;
    const double onto = pressing_force(normal) / std::sqrt(reached2 > 0.0 ? reached2 : 1.0);
    return {f_l * p.slide.axial * onto, f_t * p.slide.azimuthal * onto};
}

/// Coulomb's law: trial with a sticking spring, then return to the cone. The mobility around the
/// well joins translation and spin, since both move the surface point. `rolled` is the way of the
/// contact along the wall (m).
DRILLSTRAND_INLINE FrictionStep coulomb_step(const FrictionSpring& spring, const WellVelocity& v,
                                             double normal, double penetration, double rolled,
                                             double radius, double dt, const Mobility& mobility,
                                             const FrictionParameters& p) {
    const double pressing = pressing_force(normal);
    const Tangential rolling = rolling_compliance(rolled, pressing, p);
    const Tangential a = {dt * mobility.along + p.compliance + rolling.axial,
                          dt * (mobility.across + radius * radius * mobility.rotation) +
                              p.compliance + rolling.azimuthal};
    const Tangential b = {spring.elongation.axial + dt * v.l,
                          spring.elongation.azimuthal + dt * (v.t + radius * v.spin)};
    const Tangential limit = limiting(spring.sliding, p.slide_inverse, p.fixed_inverse);
    const double inverse = 1.0 / (a.axial * a.azimuthal);
    const Tangential stick = scaled_where_rough({b.axial * a.azimuthal, b.azimuthal * a.axial},
                                                p.slide_inverse, inverse);
    const bool slides = friction_demand2(stick, limit) > pressing * pressing;
    const Tangential slip = return_to_cone(b, a, p, pressing);
    const bool touches = penetration > 0.0;
    const double f_l = touches ? (slides ? slip.axial : stick.axial) : 0.0;
    const double f_t = touches ? (slides ? slip.azimuthal : stick.azimuthal) : 0.0;
    return {{{p.compliance * f_l, p.compliance * f_t}, touches && slides ? 1.0 : 0.0},
            {-f_l, -f_t}};
}

/// The paper's two springs, implicit: the axial one sees v_l, the azimuthal one R times the spin
/// alone; past mu_s k_el dr a spring holds mu_d k_el dr.
DRILLSTRAND_INLINE FrictionStep paper_step(const FrictionSpring& spring, const WellVelocity& v,
                                           double elastic_normal, double penetration, double rolled,
                                           double radius, double dt, const Mobility& mobility,
                                           const FrictionParameters& p) {
    const Tangential rolling = rolling_compliance(rolled, elastic_normal, p);
    const double stick_l =
        (spring.elongation.axial + dt * v.l) / (dt * mobility.along + p.compliance + rolling.axial);
    const double stick_t =
        (spring.elongation.azimuthal + dt * radius * v.spin) /
        (dt * radius * radius * mobility.rotation + p.compliance + rolling.azimuthal);
    const double slip_l = std::copysign(p.slide.axial * elastic_normal, stick_l);
    const double slip_t = std::copysign(p.slide.azimuthal * elastic_normal, stick_t);
    const bool touches = penetration > 0.0;
    const bool slides_l = std::abs(stick_l) > p.fixed.axial * elastic_normal;
    const bool slides_t = std::abs(stick_t) > p.fixed.azimuthal * elastic_normal;
    const double f_l = touches ? (slides_l ? slip_l : stick_l) : 0.0;
    const double f_t = touches ? (slides_t ? slip_t : stick_t) : 0.0;
    return {{{p.compliance * f_l, p.compliance * f_t}, 0.0}, {-f_l, -f_t}};
}

/// Velocities after the drag of the annular fluid (N s/m2, N s) has acted for the whole step at its
/// end value: scalar divisions for v_r and v_l, a symmetric positive definite 2 x 2 solve for (v_t,
/// spin).
DRILLSTRAND_INLINE WellVelocity implicit_drag(const WellVelocity& v, const DragCoefficients& drag,
                                              const Mobility& mobility) {
    const double m11 = 1.0 + mobility.across * drag.around;
    const double m12 = mobility.across * drag.cross;
    const double m21 = mobility.rotation * drag.cross;
    const double m22 = 1.0 + mobility.rotation * drag.spin;
    const double det = m11 * m22 - m12 * m21;
    const double across = 1.0 + mobility.across * drag.radial;
    const double along = 1.0 + mobility.along * drag.axial;
    // one division for the three
    const double inverse = 1.0 / (det * across * along);
    const double inverse_det = inverse * across * along;
    return {v.r * (inverse * det * along), v.l * (inverse * det * across),
            inverse_det * (m22 * v.t - m12 * v.spin), inverse_det * (m11 * v.spin - m21 * v.t)};
}

}  // namespace drillstrand
