#include "support/annular_flow.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace drillstrand::test {

namespace {

constexpr double pi = std::numbers::pi;

/// The same annulus with a film that is not too thin.
Annulus with_film(const FluidCase& fluid, Annulus annulus) {
    annulus.eccentricity = std::min(annulus.eccentricity, (1 - fluid.film) * annulus.clearance());
    return annulus;
}

/// Of creeping flow, per unit viscosity.
Eigen::Matrix4d creeping_drag(const FluidCase& fluid, const Annulus& annulus) {
    const double e = annulus.eccentricity;
    const double r2 = annulus.pipe * annulus.pipe;
    const double h2 = annulus.hole * annulus.hole;
    const double q = 2 * annulus.pipe * annulus.hole;
    const double big_t = std::sqrt(std::pow(h2 - r2 + e * e, 2) - 4 * e * e * h2);
    const double d = std::asinh(big_t / q);
    const double phi = d * std::cosh(d) - std::sinh(d);
    const double den = q * phi + e * e * d;
    const double gap =
        fluid.axial_drag == AxialDrag::eccentric ? d : std::log(annulus.hole / annulus.pipe);
    Eigen::Matrix4d drag = Eigen::Matrix4d::Zero();
    drag(0, 0) = 4 * pi * std::cosh(d) / phi;
    drag(1, 1) = 2 * pi / gap;
    drag(2, 2) = 4 * pi * (r2 + h2) / den;
    drag(2, 3) = drag(3, 2) = -4 * pi * r2 * e / den;
    drag(3, 3) = 4 * pi * r2 * (h2 * phi / std::sinh(d) + e * e) / den;
    return drag;
}

/// Rates at the wall of cylinders that slide and turn in a power law, over those of a Newtonian
/// fluid.
struct Steeper {
    double sliding = 1, turning = 1;

    Steeper(double n, const Annulus& annulus) {
        if (n == 1) return;
        const double ratio = annulus.pipe / annulus.hole;
        const double power = 1 / n - 1;
        sliding = power * std::log(1 / ratio) / (1 - std::pow(ratio, power));
        turning = (1 - ratio * ratio) / (n * (1 - std::pow(ratio, 2 / n)));
    }
};

/// Stress over rate on the pipe of a Herschel-Bulkley fluid.
double viscosity_at_pipe(const FluidCase& fluid, const Annulus& annulus,
                         const Eigen::Matrix4d& creeping, const Stirring& motion) {
    if (fluid.is_newtonian()) return fluid.viscosity;
    const Steeper steeper(fluid.flow_index, annulus);
    const double circle = 2 * pi * annulus.pipe;
    const double along =
        steeper.sliding * creeping(1, 1) * motion.along / circle + motion.pumped_shear;
    const double around = steeper.turning * creeping(3, 3) * motion.spin / (circle * annulus.pipe);
    const double gap_area = pi * (annulus.hole * annulus.hole - annulus.pipe * annulus.pipe);
    const double radial2 = motion.across * motion.across - motion.around * motion.around;
    const double squeezed =
        3 * (creeping(0, 0) * radial2 + creeping(2, 2) * motion.around * motion.around) / gap_area;
    const double rate = std::sqrt(1 + along * along + around * around + squeezed);
    return fluid.yield_stress / rate + fluid.viscosity * std::pow(rate, fluid.flow_index - 1);
}

void add_inertia(Eigen::Matrix4d& drag, const FluidCase& fluid, const Annulus& annulus,
                 const Stirring& motion) {
    const double pipe = annulus.pipe;
    const double blocked = annulus.hole / annulus.clearance();
    // C_d rho/2 (2 R) (v Rw / (Rw - R))^2
    const double form =
        fluid.drag_coefficient * fluid.density * pipe * blocked * blocked * motion.across;
    drag(0, 0) += form;
    drag(2, 2) += form;
    if (fluid.viscosity == 0) return;
    if (motion.spin != 0) {
        const double torque = turbulent_torque(fluid, annulus, motion.spin, 1);
        drag(3, 3) = std::hypot(drag(3, 3), torque / std::abs(motion.spin));
    }
    // Blasius with the hydraulic diameter 2 (Rw - R): f rho/2 U^2 around the pipe
    const double surface = std::hypot(motion.along + motion.pumped, pipe * motion.spin);
    if (surface == 0) return;
    const double reynolds = surface * 2 * annulus.clearance() * fluid.density / fluid.viscosity;
    const double friction = 0.079 * std::pow(reynolds, -0.25);
    drag(1, 1) = std::hypot(drag(1, 1), friction * fluid.density / 2 * surface * 2 * pi * pipe);
}

template <class Number>
Number potential_flow(Number e, double pipe, double hole) {
    const Number square = hole * hole - pipe * pipe - e * e;
    const Number c = std::sqrt(square * square - 4 * pipe * pipe * e * e) / (2.0 * e);
    const auto asinh = [](const Number& x) { return std::log(x + std::sqrt(x * x + 1.0)); };
    const Number x = asinh(c / pipe);
    const Number d = x - asinh(c / hole);
    const Number once = std::exp(-2.0 * x);
    // 4 sinh^2 x = (1 - exp(-2 x))^2 exp(2 x)
    Number sum = 0;
    Number power = 1;
    for (int n = 1; n < 100000 && n * std::abs(power) > 1e-18 * std::abs(sum); ++n) {
        const Number decay = std::exp(-2.0 * n * d);
        sum += static_cast<double>(n) * power * (1.0 + decay) / (1.0 - decay);
        power *= once;
    }
    return (1.0 - once) * (1.0 - once) * sum;
}

}  // namespace

double turbulent_torque(const FluidCase& fluid, const Annulus& annulus, double spin, double shift) {
    const double pipe = annulus.pipe;
    const double gap = annulus.clearance();
    const double reynolds = pipe * std::abs(spin) * gap * fluid.density / fluid.viscosity + shift;
    const double coefficient =
        std::pow(gap / pipe, 0.3) *
        std::max(1.03 * std::pow(reynolds, -0.5), 0.065 * std::pow(reynolds, -0.2));
    return coefficient * pi * fluid.density * spin * spin * std::pow(pipe, 4) / 2;
}

Eigen::Matrix4d textbook_drag(const FluidCase& fluid, const Annulus& annulus,
                              const Stirring& motion) {
    const double e = annulus.eccentricity;
    const double clearance = annulus.clearance();
    if (!fluid.drag || (e > clearance && !fluid.contact_drag)) return Eigen::Matrix4d::Zero();
    const Eigen::Matrix4d creeping = creeping_drag(fluid, with_film(fluid, annulus));
    FluidCase as_it_flows = fluid;
    as_it_flows.viscosity = viscosity_at_pipe(fluid, annulus, creeping, motion);
    Eigen::Matrix4d drag = as_it_flows.viscosity * creeping;
    const Steeper steeper(fluid.flow_index, annulus);
    drag(1, 1) *= steeper.sliding;
    drag(3, 3) *= steeper.turning;
    if (fluid.regime == FlowRegime::inertial) add_inertia(drag, as_it_flows, annulus, motion);
    if (fluid.contact_drag) {
        // coefficients of friction hold the shear of the film: it fades before the pipe touches
        const double left = std::clamp((clearance - e) / (fluid.film * clearance), 0.0, 1.0);
        drag(1, 1) *= left;
        drag(2, 3) *= left;
        drag(3, 2) *= left;
        drag(3, 3) *= left;
    }
    return drag;
}

double potential_flow_mass(const Annulus& annulus) {
    const double r2 = annulus.pipe * annulus.pipe;
    const double h2 = annulus.hole * annulus.hole;
    if (annulus.eccentricity == 0) return (h2 + r2) / (h2 - r2);
    return potential_flow(annulus.eccentricity, annulus.pipe, annulus.hole);
}

double potential_flow_slope(const Annulus& annulus) {
    // a step along the imaginary axis: no difference, no rounding
    const double step = 1e-20 * annulus.eccentricity;
    return potential_flow(std::complex<double>(annulus.eccentricity, step), annulus.pipe,
                          annulus.hole)
               .imag() /
           step;
}

double lateral_fluid(const FluidCase& fluid, const Annulus& annulus, double bore_area) {
    if (!fluid.added_mass) return 0;
    const double outer = pi * annulus.pipe * annulus.pipe;
    const double inside = fluid.inside == InsideOfPipe::fluid ? bore_area : 0;
    return fluid.density * (inside + outer * potential_flow_mass(with_film(fluid, annulus)));
}

double lateral_fluid_slope(const FluidCase& fluid, const Annulus& annulus) {
    const Annulus filmed = with_film(fluid, annulus);
    if (!fluid.added_mass || filmed.eccentricity < annulus.eccentricity) return 0;
    return fluid.density * pi * annulus.pipe * annulus.pipe * potential_flow_slope(filmed);
}

}  // namespace drillstrand::test
