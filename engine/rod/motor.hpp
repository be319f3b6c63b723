/// A mud motor between the string's end and the bit: engine/rod/README.md, "Mud motor".
#pragma once

#include "drillstrand/case.hpp"

namespace drillstrand {

class Motor {
  public:
    explicit Motor(const MotorCase& motor) : motor_(motor) {}

    /// Speed of the rotor in the stator (rad/s) at which the mud drives it with a torque (N m) from
    /// 0 to the largest.
    [[nodiscard]] double speed(double torque) const;
    [[nodiscard]] double stall_torque() const { return motor_.stall_torque; }
    /// Difference of pressure over the motor (Pa) at a torque on its rotor (N m).
    [[nodiscard]] double pressure(double torque) const;

    /// The torque (N m) at which the motor has the speed that it leaves the rotor in the stator:
    /// `rotor_speed(torque)` (rad/s), which grows with it. None where that is faster than the mud
    /// lets the rotor turn, the largest where it does not turn on.
    template <class Speed>
    [[nodiscard]] double torque(const Speed& rotor_speed) const {
        const auto excess = [&](double torque) { return rotor_speed(torque) - speed(torque); };
        return root(excess, 0, motor_.stall_torque);
    }

  private:
    /// Where a function that grows passes 0, or the end of the range that is nearer to it: by
    /// regula falsi (Illinois), whatever jumps it has.
    template <class Function>
    static double root(const Function& function, double low, double high);

    MotorCase motor_;
};

template <class Function>
double Motor::root(const Function& function, double low, double high) {
    double below = function(low);
    double above = function(high);
    if (below >= 0) return low;
    if (above <= 0) return high;
    const double close = 1e-13 * high;
    constexpr int most_rounds = 200;
    int side = 0;
    for (int i = 0; i < most_rounds && high - low > close; ++i) {
        // every third round halves: jumps and flat parts then cost no more than that
        const bool halves = i % 3 == 2;
        const double at =
            halves ? 0.5 * (low + high) : low - below * (high - low) / (above - below);
        const double value = function(at);
        if (value == 0) return at;
        if (value < 0) {
            low = at;
            below = value;
            if (side < 0) above *= 0.5;
            side = -1;
        } else {
            high = at;
            above = value;
            if (side > 0) below *= 0.5;
            side = 1;
        }
    }
    return 0.5 * (low + high);
}

}  // namespace drillstrand
