/// Rock under the blades of a drag bit: engine/rod/README.md, "Cutting".
#pragma once

#include "drillstrand/case.hpp"
#include "state/rows.hpp"

namespace drillstrand {

class Cutting {
  public:
    /// Of a bit of that radius (m).
    Cutting(const CuttingCase& given, double radius);

    /// Weight over the depth that each blade cuts (N/m).
    [[nodiscard]] static double stiffness(const CuttingCase& given, double radius);

    /// The bottom before anything is cut.
    [[nodiscard]] RockState start(double off_bottom) const;
    /// Depth that each blade cuts (m): 0 where it has left the rock.
    [[nodiscard]] static double depth_of_cut(const RockState& rock);
    /// What cutting asks of the bit: weight (N), and torque against a rotation (N m).
    [[nodiscard]] double weight(const RockState& rock) const;
    [[nodiscard]] double torque(const RockState& rock) const;
    /// The most that the wear flats bear (N): nothing off the rock.
    [[nodiscard]] double largest_flat_weight(const RockState& rock) const;
    /// Friction of wear flats under a weight (N m).
    [[nodiscard]] double flat_torque(double flat_weight) const;

    /// Turns the bit (rad) and sinks it (m), evenly, and cuts what is in the way.
    void advance(RockState& rock, double turn, double sink) const;

  private:
    /// From the last place to the next on the way that the bit turns, in places.
    [[nodiscard]] static double to_next(const RockState& rock);
    /// The rock under the blades, between those places (m).
    [[nodiscard]] static double surface_at(const RockState& rock);

    double piece_;         ///< rad, angle between places at which the surface is kept
    double stiffness_;     ///< N/m
    double torque_arm_;    ///< m, torque of cutting over its weight
    double largest_flat_;  ///< N
    double flat_arm_;      ///< m
};

}  // namespace drillstrand
