#include "rod/cutting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drillstrand {

namespace {

/// Places between two blades at which the surface is kept.
constexpr std::size_t places = 512;

}  // namespace

double Cutting::stiffness(const CuttingCase& given, double radius) {
    return radius * given.inclination * given.specific_energy * given.blades;
}

Cutting::Cutting(const CuttingCase& given, double radius)
    : piece_(2 * std::numbers::pi / given.blades / static_cast<double>(places)),
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

std::size_t Cutting::index_of(double place) const {
    constexpr auto all = static_cast<double>(places);
    return static_cast<std::size_t>(place - all * std::floor(place / all));
}

double Cutting::next_place(const RockState& rock) const {
    const double at = rock.last_angle / piece_;
    return rock.way > 0 ? std::floor(at) + 1 : std::ceil(at) - 1;
}

double Cutting::surface_at(const RockState& rock) const {
    const double next = next_place(rock);
    const double ahead = rock.surface[index_of(next)];
    const double part = (rock.angle - rock.last_angle) / (next * piece_ - rock.last_angle);
    return rock.last_surface + part * (ahead - rock.last_surface);
}

double Cutting::depth_of_cut(const RockState& rock) const {
    return std::max(rock.depth - surface_at(rock), 0.0);
}

double Cutting::weight(const RockState& rock) const {
    return stiffness_ * depth_of_cut(rock);
}

double Cutting::torque(const RockState& rock) const {
    return torque_arm_ * weight(rock);
}

double Cutting::largest_flat_weight(const RockState& rock) const {
    return rock.depth >= surface_at(rock) ? largest_flat_ : 0.0;
}

double Cutting::flat_torque(double flat_weight) const {
    return flat_arm_ * flat_weight;
}

void Cutting::advance(RockState& rock, double turn, double sink) const {
    const double start = rock.angle;
    const double from = rock.depth;
    if (turn * rock.way < 0) {
        // back over what it has just cut
        rock.last_surface = std::max(surface_at(rock), from);
        rock.last_angle = start;
        rock.way = -rock.way;
    }
    const double end = start + turn;
    // blades that turn by more than their distance meet what they have cut in this very step
    for (std::size_t i = 0; i < places; ++i) {
        const double next = next_place(rock);
        const double angle = next * piece_;
        if ((end - angle) * rock.way < 0 || turn == 0) break;
        double& surface = rock.surface[index_of(next)];
        rock.last_angle = angle;
        rock.last_surface = surface;
        surface = std::max(surface, from + sink * (angle - start) / turn);
    }
    rock.angle = end;
    rock.depth = from + sink;
}

}  // namespace drillstrand
