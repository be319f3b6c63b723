#include "rod/motor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drillstrand {

double Motor::speed(double torque) const {
    const double share = std::clamp(torque / motor_.stall_torque, 0.0, 1.0);
    return motor_.no_load_speed * (1 - std::pow(share, motor_.exponent));
}

double Motor::pressure(double torque) const {
    return 2 * std::numbers::pi * torque / motor_.displacement;
}

}  // namespace drillstrand
