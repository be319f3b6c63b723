#include "rod/whirl.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace drillstrand {

namespace {

constexpr double least_eccentricity = 0.5;  // of the clearance: nearer the axis it bends, no more
constexpr double least_rate = 0.1;          // of the spin: slower is drift
constexpr double least_spin = 0.1;          // rad/s, about 1 rpm: below it is no rotation

/// Rate around the well's axis, positive with the spin; 0 for a node that does not whirl (rad/s).
double whirl_rate(const NodeContact& contact, const NodeVelocity& velocity) {
    if (contact.clearance <= 0) return 0;
    if (contact.eccentricity < least_eccentricity * contact.clearance) return 0;
    if (std::abs(velocity.spin) < least_spin) return 0;
    // t is the direction of a positive turn about l, as d3 is of spin
    const double rate = contact.around.dot(velocity.linear) / contact.eccentricity;
    if (std::abs(rate) < least_rate * std::abs(velocity.spin)) return 0;
    return std::copysign(1.0, velocity.spin) * rate;
}

}  // namespace

Whirl whirl_of(const Scene& scene, const std::vector<NodeContact>& contacts,
               const std::vector<NodeVelocity>& velocities) {
    double forward = 0;  // lengths, and sums over them
    double backward = 0;
    Whirl sum;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const double rate = whirl_rate(contacts[k], velocities[k]);
        if (rate == 0) continue;
        const double cell = scene.mesh.cell[k];
        const double radius = scene.mesh.node[k].outer_radius;
        (rate > 0 ? forward : backward) += cell;
        sum.rate += cell * rate;
        const double circle = std::max(contacts[k].clearance, contacts[k].eccentricity);
        sum.rolling_rate -= cell * std::abs(velocities[k].spin) * radius / circle;
        sum.depth += cell * contacts[k].well_depth;
    }
    const double whirling = forward + backward;
    if (whirling == 0) return {};
    const double length = std::accumulate(scene.mesh.cell.begin(), scene.mesh.cell.end(), 0.0);
    return {forward / length, backward / length, sum.rate / whirling, sum.rolling_rate / whirling,
            sum.depth / whirling};
}

std::vector<double> whirl_rates(const std::vector<NodeContact>& contacts,
                                const std::vector<NodeVelocity>& velocities) {
    std::vector<double> rates;
    rates.reserve(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k)
        rates.push_back(whirl_rate(contacts[k], velocities[k]));
    return rates;
}

double rotation_energy(const Scene& scene, const std::vector<NodeVelocity>& velocities) {
    double sum = 0;
    for (std::size_t k = 0; k < velocities.size(); ++k)
        sum += 0.5 * scene.mesh.cell[k] * scene.mesh.node[k].polar_inertia * velocities[k].spin *
               velocities[k].spin;
    return sum;
}

}  // namespace drillstrand
