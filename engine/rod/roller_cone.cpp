#include "rod/roller_cone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drillstrand {

using std::numbers::pi;

RollerCone::RollerCone(const RollerConeCase& given, double friction, double radius)
    : lobes_(given.lobes),
      half_height_(0.5 * given.lobe_height),
      stiffness_(given.stiffness),
      arm_(friction * pi * radius / 4),
      work_(given.specific_energy * pi * radius * radius) {}

RockState RollerCone::start(double off_bottom) const {
    RockState rock;
    rock.depth = -off_bottom - half_height_;
    rock.way = 1;
    return rock;
}

double RollerCone::weight(const RockState& rock) const {
    const double lobe = half_height_ * std::cos(lobes_ * rock.turn);
    return stiffness_ * std::max(rock.depth - rock.bottom + lobe, 0.0);
}

double RollerCone::friction(const RockState& rock) const {
    return arm_ * weight(rock);
}

double RollerCone::depth_of_cut(const RockState& rock) const {
    return 2 * pi * friction(rock) / work_;
}

RockTorque RollerCone::torque(const RockState& rock) const {
    // climbing a lobe: - W d(lobe)/d(turn)
    const double climb = -weight(rock) * half_height_ * lobes_ * std::sin(lobes_ * rock.turn);
    return {climb, friction(rock), friction(rock)};
}

void RollerCone::advance(RockState& rock, double turn, double sink) const {
    rock.bottom += friction(rock) * std::abs(turn) / work_;
    rock.depth += sink;
    rock.turn = std::remainder(rock.turn + turn, 2 * pi / lobes_);
}

}  // namespace drillstrand
