/// The viscosity that a fluid which thins and yields shows a node: that at the rate of shear on the
/// wall of the pipe. Equations, assumptions and validity: engine/forces/README.md, "Mud in motion".
#pragma once

#include <cmath>

#include "forces/fluid.hpp"
#include "numerics/kernel.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// Constants of a Herschel-Bulkley fluid that all nodes share.
struct Thinning {
    double consistency = 0;   ///< K (Pa s^n)
    double yield_stress = 0;  ///< Pa
    double exponent = 0;      ///< (1 - n) / 2
};

/// What the mud in motion is to one node.
struct MudAround {
    double load;            ///< of the flow on the node, down the well (N/m)
    double speed;           ///< mean of the pumped flow up the annulus (m/s)
    double shear;           ///< its rate at the wall of the pipe (1/s)
    double axial_thinning;  ///< rate at the wall over that of a Newtonian fluid, sliding
    double spin_thinning;   ///< likewise, turning
};

/// Rate at the wall of a cylinder that slides in another, over that of a Newtonian fluid: the power
/// law between concentric cylinders. At least 1.
inline double axial_thinning(double index, double pipe, double hole) {
    if (index == 1) return 1;
    const double ratio = std::log(hole / pipe);
    const double power = 1 / index - 1;
    return power * ratio / -std::expm1(-power * ratio);
}

/// Likewise of one that turns.
inline double spin_thinning(double index, double pipe, double hole) {
    if (index == 1) return 1;
    const double ratio = std::log(hole / pipe);
    return std::expm1(-2 * ratio) / (index * std::expm1(-2 * ratio / index));
}

/// Square of the rate of shear on the pipe (1/s2): of sliding, with the pumped flow, of turning,
/// and of what is squeezed past a pipe that moves sideways. `drag` is that of a unit viscosity.
DRILLSTRAND_INLINE double shear_on_pipe2(const DragCoefficients& drag, const MudAround& mud,
                                         double pipe, double hole, double v_r, double v_l,
                                         double v_t, double spin) {
    constexpr double pi = 3.14159265358979323846;
    const double per_turn = 1.0 / (2.0 * pi * pipe);
    const double along = mud.axial_thinning * drag.axial * per_turn * v_l + mud.shear;
    const double around = mud.spin_thinning * drag.spin * per_turn / pipe * spin;
    const double squeezed = 3.0 / (pi * (hole - pipe) * (hole + pipe)) *
                            (drag.radial * v_r * v_r + drag.around * v_t * v_t);
    return along * along + around * around + squeezed;
}

/// Stress over rate (Pa s). Below a rate of 1/s, the slowest that viscometers tell, the fluid is as
/// viscous as there: finite at rest.
DRILLSTRAND_INLINE double apparent_viscosity(const Thinning& fluid, double rate2) {
    const double thinned = exp_of_minus(fluid.exponent * log1p_nonnegative(rate2));
    return fluid.consistency * thinned + fluid.yield_stress / std::sqrt(1.0 + rate2);
}

/// Creeping drag of a viscosity, from that of a unit viscosity. What was symmetric and positive
/// definite stays so: only the diagonal gains.
DRILLSTRAND_INLINE DragCoefficients thinned(const DragCoefficients& drag, const MudAround& mud,
                                            double viscosity) {
    return {viscosity * drag.radial, viscosity * drag.axial * mud.axial_thinning,
            viscosity * drag.around, viscosity * drag.cross,
            viscosity * drag.spin * mud.spin_thinning};
}

/// The flow's inertia with a viscosity over that for which it was computed.
DRILLSTRAND_INLINE FlowInertia thinned(const FlowInertia& flow, double ratio) {
    return {flow.cross, flow.swirl, flow.swirl_reynolds / ratio,
            flow.stream * std::sqrt(std::sqrt(ratio))};
}

/// Drag of mud that flows at these velocities, from the creeping drag of a unit viscosity and the
/// inertia of the flow as of its consistency. The pipe's surface meets the pumped flow.
DRILLSTRAND_INLINE DragCoefficients flowing_drag(const DragCoefficients& unit,
                                                 const FlowInertia& flow, const MudAround& mud,
                                                 const Thinning& fluid, double pipe, double hole,
                                                 double v_r, double v_l, double v_t, double spin) {
    const double rate2 = shear_on_pipe2(unit, mud, pipe, hole, v_r, v_l, v_t, spin);
    const double viscosity = apparent_viscosity(fluid, rate2);
    return with_inertia(thinned(unit, mud, viscosity), thinned(flow, viscosity / fluid.consistency),
                        pipe, std::sqrt(v_r * v_r + v_t * v_t), v_l + mud.speed, spin);
}

}  // namespace drillstrand
