/// Rock under the cones of a bit: engine/rod/README.md, "Roller cones".
#pragma once

#include "drillstrand/case.hpp"
#include "rod/rock_torque.hpp"
#include "state/rows.hpp"

namespace drillstrand {

class RollerCone {
  public:
    /// Of a bit of that radius (m), and its coefficient of friction on the bottom.
    RollerCone(const RollerConeCase& given, double friction, double radius);

    /// The bottom before anything is drilled.
    [[nodiscard]] RockState start(double off_bottom) const;
    /// What rock and teeth press with (N).
    [[nodiscard]] double weight(const RockState& rock) const;
    /// Depth that the bit drills in a turn (m).
    [[nodiscard]] double depth_of_cut(const RockState& rock) const;
    [[nodiscard]] RockTorque torque(const RockState& rock) const;

    /// Turns the bit (rad) and sinks it (m), and drills.
    void advance(RockState& rock, double turn, double sink) const;

  private:
    [[nodiscard]] double friction(const RockState& rock) const;

    double lobes_;
    double half_height_;  ///< m
    double stiffness_;    ///< N/m
    double arm_;          ///< m, torque of friction over weight
    double work_;         ///< J, of the torque for a metre of hole
};

}  // namespace drillstrand
