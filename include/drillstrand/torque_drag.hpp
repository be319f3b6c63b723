/// Torque and drag: hook load and surface torque against the depth of the bit, by the equilibrium
/// of the stiff string at the wall and, beside it, of a soft string on the well's axis. Theory:
/// engine/statics/README.md.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"

namespace drillstrand {

/// How far compression has gone in a string that lies in a well.
enum class BucklingState { unknown = -1, none, sinusoidal, helical };

/// The string at one depth of the bit: one value per segment, at its middle, head to bit.
struct TorqueDragProfile {
    std::vector<double> tension;           ///< axial force, buoyed; compression negative (N)
    std::vector<double> torque;            ///< that the part above exerts on the part below (N m)
    std::vector<double> side_force;        ///< of the wall, normal (N/m)
    std::vector<double> bending_stress;    ///< at the outer fibre (Pa)
    std::vector<double> von_mises_stress;  ///< at the outer fibre (Pa)
    std::vector<double> sinusoidal_limit;  ///< compression at which the string snakes (N)
    std::vector<double> helical_limit;     ///< compression at which it winds up (N)
    std::vector<BucklingState> buckling;   ///< tension against these limits
    std::vector<double> inside_pressure;   ///< of the mud, above that of the atmosphere (Pa)
    std::vector<double> outside_pressure;  ///< likewise (Pa)
    std::vector<double> true_tension;      ///< axial force in the metal (N)
    std::vector<double> soft_tension;      ///< N
    std::vector<double> soft_torque;       ///< N m
    std::vector<double> soft_side_force;   ///< N/m
};

/// An equilibrium that was not found.
struct TorqueDragFailure {
    double bit_depth = 0;  ///< m
    std::string reason;
};

/// One motion: one value per depth of the bit. Where no equilibrium of the stiff string was found
/// its values are NaN, and its buckling is unknown.
struct TorqueDragCurve {
    TorqueDragMotion motion = TorqueDragMotion::rotating;
    std::vector<double> hook_load;       ///< N
    std::vector<double> surface_torque;  ///< N m
    /// Measured depth above which the whole string is in tension (m): where tension ends, going
    /// down, or the bit.
    std::vector<double> neutral_point;
    std::vector<BucklingState> buckling;     ///< the worst along the string
    std::vector<double> standpipe_pressure;  ///< Pa
    std::vector<double> bit_pressure;        ///< of the mud in the annulus, at the bit (Pa)
    /// Of a fluid at rest with that pressure (kg/m3); 0 without a fluid.
    std::vector<double> equivalent_density;
    std::vector<double> mud_force;            ///< of mud in motion on the string, downward (N)
    std::vector<double> soft_hook_load;       ///< N
    std::vector<double> soft_surface_torque;  ///< N m
    /// Measured depth of the bit at which the string comes to a stop on its way down by its own
    /// weight (m); NaN where it does not, and of other motions.
    double lock_up_depth = std::numeric_limits<double>::quiet_NaN();
    /// The most that reaches the bit at the last depth while the string slides (N); NaN of other
    /// motions.
    double largest_weight = std::numeric_limits<double>::quiet_NaN();
    TorqueDragProfile profile;  ///< at the last depth
    std::vector<TorqueDragFailure> failures;
};

struct TorqueDrag {
    std::vector<double> bit_depth;  ///< measured, ascending (m)
    std::vector<double> node_s;     ///< N+1, mesh of the last depth: arc length from the head (m)
    std::vector<double> segment_s;  ///< N, middles of its segments (m)
    std::vector<double> measured_depth;   ///< N, of these middles (m)
    std::vector<TorqueDragCurve> curves;  ///< in the order of the case's motions
};

/// Whether the weight of the string alone takes it down: it trips in or slides.
bool goes_by_its_weight(TorqueDragMotion motion);

/// The study that a case asks for in its table [torque_drag]; without one, at 20 even depths down
/// to that of the bit. The head is at the start of the well, and the string is cut or lengthened at
/// its top. Equilibria of different depths are found in parallel by `threads` threads (0: all
/// cores), and do not depend on their number. Throws InputError where the case has no well or a
/// head that is free or elsewhere.
TorqueDrag compute_torque_drag(const Case& input, int threads = 0);

}  // namespace drillstrand
