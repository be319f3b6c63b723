/// The string of a study of torque and drag at one depth of its bit, in its motions.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "drillstrand/equilibrium.hpp"
#include "drillstrand/torque_drag.hpp"
#include "statics/buckling_limits.hpp"
#include "statics/tripped_string.hpp"

namespace drillstrand {

/// What the cross section of a segment makes of its loads, and how it lies.
struct Site {
    double area = 0;             ///< of metal (m2)
    double inner_area = 0;       ///< of the bore (m2)
    double outer_area = 0;       ///< of the outer circle (m2)
    double section_modulus = 0;  ///< I / R (m3)
    BucklingLimits limits;
};

/// The string with its bit at one depth.
struct TrippedString {
    Case input;
    Scene scene;
    std::vector<double> measured_depth;  ///< middles of the segments (m)
    std::vector<Site> sites;             ///< there
};

/// Throws InputError where a component is wider than the hole there.
TrippedString string_at(const Case& input, double bit_depth);

/// One motion at one depth.
struct TrippingAnswer {
    double hook_load = std::numeric_limits<double>::quiet_NaN();
    double surface_torque = std::numeric_limits<double>::quiet_NaN();
    double neutral_point = std::numeric_limits<double>::quiet_NaN();
    double standpipe_pressure = 0;
    double bit_pressure = 0;
    double equivalent_density = 0;
    double mud_force = 0;
    BucklingState buckling = BucklingState::unknown;
    SoftLoad soft;
    TorqueDragProfile profile;
    std::optional<std::string> failure;
};

/// Equilibria of one string in motion, which start from equilibria of the string at rest.
class Tripping {
  public:
    explicit Tripping(const TrippedString& string) : string_(string) {}

    TrippingAnswer answer(TorqueDragMotion motion);
    /// Loads of the soft string alone, at its head.
    [[nodiscard]] SoftLoad soft_at_head(TorqueDragMotion motion) const;

  private:
    Equilibrium moving(EquilibriumOptions options);
    const InitialNodes& off_bottom(EquilibriumOptions options);
    const InitialNodes& on_bottom(EquilibriumOptions options);

    const TrippedString& string_;
    std::optional<InitialNodes> off_bottom_;
    std::optional<InitialNodes> on_bottom_;
};

}  // namespace drillstrand
