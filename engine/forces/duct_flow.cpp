#include "forces/duct_flow.hpp"

#include <cmath>

namespace drillstrand {

namespace {

/// Rate at the wall over that of a Newtonian fluid of the same speed (Rabinowitsch), from which the
/// local exponent of stress over rate follows.
double local_index(Duct duct, double ratio) {
    return duct == Duct::pipe ? 1 / (4 * ratio - 3) : 1 / (3 * ratio - 2);
}

/// Reynolds number up to which flow of a local exponent is laminar.
double critical_reynolds(double index) {
    return 3470 - 1370 * index;
}

/// Fanning's friction factor, laminar 16/Re, in one formula for all regimes.
double friction_factor(double reynolds, double index) {
    const double laminar = 16 / reynolds;
    const double transition = 16 * reynolds / std::pow(critical_reynolds(index), 2);
    const double a = (std::log10(index) + 3.93) / 50;
    const double b = (1.75 - std::log10(index)) / 7;
    const double turbulent = a / std::pow(reynolds, b);
    const double between = std::pow(std::pow(transition, -8) + std::pow(turbulent, -8), -1.0 / 8);
    return laminar * std::pow(1 + std::pow(between / laminar, 12), 1.0 / 12);
}

}  // namespace

double Rheology::rate(double stress) const {
    return stress > yield ? std::pow((stress - yield) / consistency, 1 / index) : 0.0;
}

Rheology rheology_of(const FluidCase& fluid) {
    return {fluid.yield_stress, fluid.viscosity, fluid.flow_index};
}

double newtonian_rate(const Rheology& mud, Duct duct, double wall_stress) {
    const double n = mud.index;
    const double beyond = wall_stress - mud.yield;
    if (beyond <= 0) return 0;
    const double x = beyond / wall_stress;
    const double y = mud.yield / wall_stress;
    const double flow = n * x * mud.rate(wall_stress);
    if (duct == Duct::pipe)
        return 4 * flow * (x * x / (3 * n + 1) + 2 * x * y / (2 * n + 1) + y * y / (n + 1));
    return 3 * flow * (x / (2 * n + 1) + y / (n + 1));
}

double laminar_stress(const Rheology& mud, Duct duct, double newtonian_rate_wanted) {
    if (newtonian_rate_wanted <= 0) return 0;
    const auto flows = [&](double beyond) { return newtonian_rate(mud, duct, mud.yield + beyond); };
    // the stress beyond yield: the profile of a fluid that thins is steeper at the wall
    double low = mud.consistency * std::pow(newtonian_rate_wanted, mud.index);
    double high = 2 * low;
    while (flows(high) < newtonian_rate_wanted)
        high *= 2;
    while (flows(low) > newtonian_rate_wanted)
        low /= 2;
    for (double middle = 0.5 * (low + high); middle > low && middle < high;
         middle = 0.5 * (low + high))
        (flows(middle) < newtonian_rate_wanted ? low : high) = middle;
    return mud.yield + high;
}

WallFlow wall_flow(const Rheology& mud, double density, Duct duct, double width, double speed) {
    WallFlow flow;
    if (speed == 0) return flow;
    const double newtonian = (duct == Duct::pipe ? 8 : 6) * std::abs(speed) / width;
    const double laminar = laminar_stress(mud, duct, newtonian);
    const double index = local_index(duct, mud.rate(laminar) / newtonian);
    flow.reynolds = 8 * density * speed * speed / laminar;
    flow.laminar = flow.reynolds < critical_reynolds(index);
    const double stress = friction_factor(flow.reynolds, index) * density * speed * speed / 2;
    flow.stress = std::copysign(stress, speed);
    flow.rate = std::copysign(mud.rate(stress), speed);
    return flow;
}

double pressure_gradient(Duct duct, double width, double wall_stress) {
    return (duct == Duct::pipe ? 4 : 2) * wall_stress / width;
}

}  // namespace drillstrand
