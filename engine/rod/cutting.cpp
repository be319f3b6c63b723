#include "rod/cutting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drillstrand {

namespace {

/// Places between two blades at which the surface is kept.
constexpr std::size_t places = 512;

/// A place as one of those that are kept: whole turns from blade to blade do not count.
double around(double place) {
    constexpr auto all = static_cast<double>(places);
    return place - all * std::floor(place / all);
}

std::size_t index_of(double place) {
    return static_cast<std::size_t>(around(place)) % places;
}

}  // namespace

double Cutting::stiffness(const CuttingCase& given, double radius) {
    return radius * given.inclination * given.specific_energy * given.blades;
}

Cutting::Cutting(const CuttingCase& given, double radius)
    : blades_(given.blades),
      piece_(2 * std::numbers::pi / given.blades / static_cast<double>(places)),
      stiffness_(stiffness(given, radius)),
      // T_c = a^2 eps d / 2, W_c = a zeta eps d
      torque_arm_(0.5 * radius / given.inclination),
      largest_flat_(radius * given.wear_flat * given.contact_strength),
      flat_arm_(0.5 * radius * given.flat_friction) {}

RockState Cutting::start(double off_bottom) const {
    RockState rock;
    rock.depth = -off_bottom;
    rock.surface.assign(places, 0.0);
    rock.way = 1;
    return rock;
}

double Cutting::to_next(const RockState& rock) {
    return (rock.way > 0 ? std::floor(rock.place) + 1 : std::ceil(rock.place) - 1) - rock.place;
}

double Cutting::surface_at(const RockState& rock) {
    const double to = to_next(rock);
    const double ahead = rock.surface[index_of(rock.place + to)];
    return rock.last_surface + rock.beyond / to * (ahead - rock.last_surface);
}

double Cutting::depth_of_blade(const RockState& rock) {
    return std::max(rock.depth - surface_at(rock), 0.0);
}

double Cutting::depth_of_cut(const RockState& rock) const {
    return blades_ * depth_of_blade(rock);
}

double Cutting::cutting_weight(const RockState& rock) const {
    return stiffness_ * depth_of_blade(rock);
}

double Cutting::weight(const RockState& rock) const {
    return cutting_weight(rock) + rock.flat_weight;
}

double Cutting::largest_flat_weight(const RockState& rock) const {
    return rock.depth >= surface_at(rock) ? largest_flat_ : 0.0;
}

RockTorque Cutting::torque(const RockState& rock) const {
    const double flats = flat_arm_ * rock.flat_weight;
    return {0, flats + torque_arm_ * cutting_weight(rock), flats};
}

void Cutting::advance(RockState& rock, double turn, double sink) const {
    const double from = rock.depth;
    const double turned = turn / piece_;
    if (turn * rock.way < 0) {
        // back over what it has just cut
        rock.last_surface = std::max(surface_at(rock), from);
        rock.place = around(rock.place + rock.beyond);
        rock.beyond = 0;
        rock.way = -rock.way;
    }
    double passed = -rock.beyond;        // from here to the last place
    double left = rock.beyond + turned;  // from there to the end
    // blades that turn by more than their distance meet what they have cut in this very step
    for (std::size_t i = 0; i < places && turn != 0; ++i) {
        const double to = to_next(rock);
        if ((left - to) * rock.way < 0) break;
        passed += to;
        left -= to;
        const std::size_t next = index_of(rock.place + to);
        rock.place = static_cast<double>(next);
        rock.last_surface = rock.surface[next];
        rock.surface[next] = std::max(rock.surface[next], from + sink * passed / turned);
    }
    rock.beyond = left - std::trunc(left);
    rock.depth = from + sink;
}

}  // namespace drillstrand
