/// Rock under the blades of a drag bit: engine/rod/README.md, "Cutting".
#pragma once

#include "drillstrand/case.hpp"
#include "rod/rock_torque.hpp"
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
    /// Depth that all blades cut in a turn (m): 0 where they have left the rock.
    [[nodiscard]] double depth_of_cut(const RockState& rock) const;
    /// What presses on cutters and wear flats (N).
    [[nodiscard]] double weight(const RockState& rock) const;
    /// The most that the wear flats bear (N): nothing off the rock.
    [[nodiscard]] double largest_flat_weight(const RockState& rock) const;
    /// What is cut resists on the way on only, wear flats both ways.
    [[nodiscard]] RockTorque torque(const RockState& rock) const;

    /// Turns the bit (rad) and sinks it (m), evenly, and cuts what is in the way.
    void advance(RockState& rock, double turn, double sink) const;

  private:
    /// From the last place to the next on the way that the bit turns, in places.
    [[nodiscard]] static double to_next(const RockState& rock);
    /// The rock under the blades, between those places (m).
    [[nodiscard]] static double surface_at(const RockState& rock);
    /// Depth that each blade cuts (m).
    [[nodiscard]] static double depth_of_blade(const RockState& rock);
    /// Weight on the cutters (N).
    [[nodiscard]] double cutting_weight(const RockState& rock) const;

    double blades_;
    double piece_;         ///< rad, angle between places at which the surface is kept
    double stiffness_;     ///< N/m
    double torque_arm_;    ///< m, torque of cutting over its weight
    double largest_flat_;  ///< N
    double flat_arm_;      ///< m
};

}  // namespace drillstrand
