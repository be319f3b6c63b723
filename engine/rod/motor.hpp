/// A mud motor between the string's end and the bit: engine/rod/README.md, "Mud motor".
#pragma once

#include "drillstrand/case.hpp"
#include "numerics/bracketed_root.hpp"

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
        const double most = motor_.stall_torque;
        const Trial none{0, excess(0)};
        const Trial all{most, excess(most)};
        if (none.value >= 0) return 0;
        return all.value <= 0 ? most : bracketed_root(excess, none, all, 1e-13 * most);
    }

  private:
    MotorCase motor_;
};

}  // namespace drillstrand
