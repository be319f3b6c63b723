/// Contact of a node with the wall of the well: penalty normal force and friction with stick and
/// slip. Equations, assumptions and defaults: engine/forces/README.md, "Contact".
///
/// Forces are per unit length. Functions of a node's own motion and spring only.
#pragma once

#include <cmath>

#include "drillstrand/case.hpp"
#include "numerics/kernel.hpp"

namespace drillstrand {

/// How deep the pipe's surface is in the wall; negative in the open hole. What is as wide as the
/// hole or wider is held on its axis, as by a wall all around.
DRILLSTRAND_INLINE double penetration(double eccentricity, double hole_radius, double pipe_radius) {
    const double clearance = hole_radius - pipe_radius;
    return eccentricity - (clearance > 0.0 ? clearance : 0.0);
}

/// Spring and dashpot toward the axis (paper eq. 9); zero in the open hole. `least` is 0 where the
/// wall cannot pull and minus infinity where its dashpot may (`tension = true`).
DRILLSTRAND_INLINE double normal_force(double penetration, double velocity_r, double stiffness,
                                       double damping, double least) {
    const double force = stiffness * penetration - damping * velocity_r;
    const double bounded = force > least ? force : least;
    return penetration > 0.0 ? bounded : 0.0;
}

/// What the spring of a wall of stiffness k is at a depth, by its law: k dr, or Hertz's k dr^1.5.
/// Force over depth (Pa). A kernel knows its law.
DRILLSTRAND_INLINE double secant_stiffness(NormalLaw law, double stiffness, double penetration) {
    if (law == NormalLaw::linear) return stiffness;
    const double depth = penetration > 0.0 ? penetration : 0.0;
    return stiffness * std::sqrt(depth);
}
/// Growth of the force with the depth (Pa).
DRILLSTRAND_INLINE double tangent_stiffness(NormalLaw law, double stiffness, double penetration) {
    const double growth = law == NormalLaw::hertz ? 1.5 : 1.0;
    return growth * secant_stiffness(law, stiffness, penetration);
}
/// Energy over half the square of the depth (Pa).
DRILLSTRAND_INLINE double energy_stiffness(NormalLaw law, double stiffness, double penetration) {
    const double part = law == NormalLaw::hertz ? 0.8 : 1.0;
    return part * secant_stiffness(law, stiffness, penetration);
}

/// A pair of numbers along the well (l) and around it (t).
struct Tangential {
    double axial, azimuthal;
};

/// Velocity of the point of the pipe's surface that touches the wall.
DRILLSTRAND_INLINE Tangential slip_velocity(double velocity_l, double velocity_t, double spin_l,
                                            double pipe_radius) {
    return {velocity_l, velocity_t + pipe_radius * spin_l};
}

/// Friction of one material pair, from friction_parameters().
struct FrictionParameters {
    double stiffness;          ///< k_tan (Pa)
    double compliance;         ///< 1 / k_tan
    Tangential fixed;          ///< static coefficients
    Tangential slide;          ///< dynamic coefficients
    Tangential fixed_inverse;  ///< 1 / static coefficient; 0 in a direction without friction
    Tangential slide_inverse;  ///< 1 / dynamic coefficient; 0 in a direction without friction
    FrictionLaw law;
    double creep = 0;  ///< creep at which the friction of a rolling pipe saturates; 0: never
    /// 1 / v_S^2 of the fall from static to dynamic (s2/m2); 0: as soon as a point slides
    double inverse_speed2 = 0;

    /// 1 where forces never leave Coulomb's cone, 0 for the paper's springs; no branch.
    [[nodiscard]] double cone() const { return static_cast<double>(law == FrictionLaw::coulomb); }

    /// The same with other coefficients, in a kernel.
    [[nodiscard]] DRILLSTRAND_INLINE FrictionParameters with(const Tangential& its_fixed,
                                                             const Tangential& its_slide) const {
        const auto inverse = [](double coefficient) DRILLSTRAND_LAMBDA {
            const bool rough = coefficient > 0.0;
            return (rough ? 1.0 : 0.0) / (rough ? coefficient : 1.0);
        };
        FrictionParameters result = *this;
        result.fixed = its_fixed;
        result.slide = its_slide;
        result.fixed_inverse = {inverse(its_fixed.axial), inverse(its_fixed.azimuthal)};
        result.slide_inverse = {inverse(its_slide.axial), inverse(its_slide.azimuthal)};
        return result;
    }

    /// The same where the surface slips at a speed whose square is `speed2` (m2/s2): from static
    /// to dynamic as Hess and Soom (1990) have it, one limit for a spring that sticks and for one
    /// that slides.
    [[nodiscard]] DRILLSTRAND_INLINE FrictionParameters at_speed2(double speed2) const {
        const double part = 1.0 / (1.0 + inverse_speed2 * speed2);
        const Tangential limit = {slide.axial + part * (fixed.axial - slide.axial),
                                  slide.azimuthal + part * (fixed.azimuthal - slide.azimuthal)};
        return with(limit, limit);
    }
};

/// Coefficients and their inverses, so that kernels multiply. A coefficient of zero in a direction
/// frees that direction.
inline FrictionParameters friction_parameters(double stiffness, const Tangential& fixed,
                                              const Tangential& slide, FrictionLaw law,
                                              double creep = 0.0, double stribeck_speed = 0.0) {
    const auto inverse = [](double coefficient) {
        return coefficient > 0.0 ? 1.0 / coefficient : 0.0;
    };
    return {stiffness,
            1.0 / stiffness,
            fixed,
            slide,
            {inverse(fixed.axial), inverse(fixed.azimuthal)},
            {inverse(slide.axial), inverse(slide.azimuthal)},
            law,
            creep,
            stribeck_speed > 0.0 ? 1.0 / (stribeck_speed * stribeck_speed) : 0.0};
}

/// Speed of the contact along the wall (m/s): where a pipe that touches goes around the well with
/// velocity_t, the point of contact goes around the wall at the same rate.
DRILLSTRAND_INLINE double rolling_speed(double velocity_t, double eccentricity,
                                        double hole_radius) {
    constexpr double tiny = 1e-30;
    return std::abs(velocity_t) * hole_radius / (eccentricity + tiny);
}

/// What rolling adds to the compliance of a spring (1/Pa) while the contact moves by `rolled` (m)
/// along the wall: xi rolled / (mu_d f_n). The spring belongs to the material in contact, and
/// rolling brings fresh, unstrained material in: an elongation u under the force k_tan u loses u xi
/// rolled k_tan / (mu_d f_n).
DRILLSTRAND_INLINE Tangential rolling_compliance(double rolled, double pressing,
                                                 const FrictionParameters& p) {
    constexpr double tiny = 1e-30;
    const double over_normal = p.creep * rolled / (pressing > tiny ? pressing : tiny);
    return {over_normal * p.slide_inverse.axial, over_normal * p.slide_inverse.azimuthal};
}

/// The spring of a node: elongation (m) and whether the point slides (1) or sticks (0).
struct FrictionSpring {
    Tangential elongation;
    double sliding;
};

/// Square of the length of a tangential force measured in coefficients: the force is on Coulomb's
/// cone (an ellipse where the two coefficients differ) where this is the square of the normal
/// force. A direction without friction does not count.
DRILLSTRAND_INLINE double friction_demand2(const Tangential& force, const Tangential& inverse) {
    const double axial = force.axial * inverse.axial;
    const double azimuthal = force.azimuthal * inverse.azimuthal;
    return axial * axial + azimuthal * azimuthal;
}

/// The coefficients that limit a spring: those of sliding (1) or of sticking (0). A sum rather than
/// a selection, which g++ would turn into two paths.
DRILLSTRAND_INLINE Tangential limiting(double sliding, const Tangential& slide,
                                       const Tangential& fixed) {
    const double sticking = 1.0 - sliding;
    return {sliding * slide.axial + sticking * fixed.axial,
            sliding * slide.azimuthal + sticking * fixed.azimuthal};
}

/// v times `scale`, without the components that have no friction (whose inverse coefficient is 0).
DRILLSTRAND_INLINE Tangential scaled_where_rough(const Tangential& v, const Tangential& inverse,
                                                 double scale) {
    return {inverse.axial > 0.0 ? v.axial * scale : 0.0,
            inverse.azimuthal > 0.0 ? v.azimuthal * scale : 0.0};
}

/// What a normal force can rub with: a wall that pulls does not.
DRILLSTRAND_INLINE double pressing_force(double normal) {
    return 0.5 * (normal + std::abs(normal));  // exact; a selection would become two paths
}

/// What brings a force of this demand onto the cone.
DRILLSTRAND_INLINE double scale_onto_cone(double demand2, double pressing) {
    constexpr double tiny = 1e-300;
    return pressing / std::sqrt(demand2 > tiny ? demand2 : tiny);
}

/// Force of the wall on the pipe. The spring is held during a step; a normal force that falls takes
/// Coulomb's limit with it. The paper's two springs (eqs. 10-12) know no limit within a step.
DRILLSTRAND_INLINE Tangential friction_force(const FrictionSpring& spring, double normal,
                                             const FrictionParameters& p) {
    const double pressing = pressing_force(normal);
    const Tangential inverse = limiting(spring.sliding, p.slide_inverse, p.fixed_inverse);
    const Tangential elastic = {-p.stiffness * spring.elongation.axial,
                                -p.stiffness * spring.elongation.azimuthal};
    const double demand2 = p.cone() * friction_demand2(elastic, inverse);
    const double onto = scale_onto_cone(demand2, pressing);
    return scaled_where_rough(elastic, inverse, demand2 > pressing * pressing ? onto : 1.0);
}

/// Elongation after the surface point moved by `slip` and the contact by `rolled` (m), implicit.
DRILLSTRAND_INLINE Tangential moved_and_rolled(const Tangential& elongation, const Tangential& slip,
                                               double rolled, double pressing,
                                               const FrictionParameters& p) {
    const Tangential more = rolling_compliance(rolled, pressing, p);
    return {(elongation.axial + slip.axial) / (1.0 + p.stiffness * more.axial),
            (elongation.azimuthal + slip.azimuthal) / (1.0 + p.stiffness * more.azimuthal)};
}

/// Coulomb's cone: the spring after the surface point moved by `slip` and the contact by `rolled`
/// (m) under the normal force `normal`. Outside the limit the point slides and the spring returns
/// to mu_d times the normal force; it sticks again, with the static limit, when the elastic
/// predictor falls inside. Forgotten in the open hole.
DRILLSTRAND_INLINE FrictionSpring coulomb_spring(const FrictionSpring& spring,
                                                 const Tangential& slip, double rolled,
                                                 double normal, double penetration,
                                                 const FrictionParameters& p) {
    const double pressing = pressing_force(normal);
    const Tangential limit = limiting(spring.sliding, p.slide_inverse, p.fixed_inverse);
    const Tangential predictor = moved_and_rolled(spring.elongation, slip, rolled, pressing, p);
    const Tangential elastic = {p.stiffness * predictor.axial, p.stiffness * predictor.azimuthal};
    const bool slides = friction_demand2(elastic, limit) > pressing * pressing;
    const double onto = scale_onto_cone(friction_demand2(elastic, p.slide_inverse), pressing);
    const Tangential kept = scaled_where_rough(predictor, p.slide_inverse, slides ? onto : 1.0);
    const bool touches = penetration > 0.0;
    return {{touches ? kept.axial : 0.0, touches ? kept.azimuthal : 0.0},
            touches && slides ? 1.0 : 0.0};
}

/// One of the paper's springs: past mu_s k_el dr it is shortened to mu_d k_el dr.
DRILLSTRAND_INLINE double paper_elongation(double predictor, double elastic_normal, double fixed,
                                           double slide, double stiffness) {
    const bool slides = std::abs(stiffness * predictor) > fixed * elastic_normal;
    const double shortened = std::copysign(slide * elastic_normal / stiffness, predictor);
    return slides ? shortened : predictor;
}

/// The paper's law: the springs after the node moved by velocity_l dt along the well and turned by
/// spin_l dt, and the contact rolled (m). `elastic_normal` is k_el dr. The azimuthal spring does
/// not see the node's own motion around the well, so that a rolling pipe is still pushed: for
/// comparison only.
DRILLSTRAND_INLINE FrictionSpring paper_spring(const FrictionSpring& spring, const Tangential& slip,
                                               double rolled, double elastic_normal,
                                               double penetration, const FrictionParameters& p) {
    const Tangential predictor =
        moved_and_rolled(spring.elongation, slip, rolled, elastic_normal, p);
    const double axial = paper_elongation(predictor.axial, elastic_normal, p.fixed.axial,
                                          p.slide.axial, p.stiffness);
    const double azimuthal = paper_elongation(predictor.azimuthal, elastic_normal,
                                              p.fixed.azimuthal, p.slide.azimuthal, p.stiffness);
    const bool touches = penetration > 0.0;
    return {{touches ? axial : 0.0, touches ? azimuthal : 0.0}, 0.0};
}

}  // namespace drillstrand
