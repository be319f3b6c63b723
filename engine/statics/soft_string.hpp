/// Torque and drag of a soft string: one without bending stiffness that lies on the axis of its
/// well (Johancsik, Friesen and Dawson, 1984): engine/statics/README.md, "Torque and drag".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/equilibrium.hpp"
#include "drillstrand/well.hpp"

namespace drillstrand {

/// A stretch of string of one kind, where it lies in the well.
struct SoftStretch {
    double from = 0;    ///< measured depth of its upper end (m)
    double to = 0;      ///< measured depth of its lower end (m)
    double weight = 0;  ///< buoyed (N/m)
    double radius = 0;  ///< at which it touches the wall (m)
};

/// What one section of the string bears.
struct SoftLoad {
    double tension = 0;  ///< N
    double torque = 0;   ///< that the part above exerts on the part below, about the string (N m)
};

/// Force of mud in motion on the string (N/m, down the well) at measured depths (m), linear
/// between; empty: none.
struct SoftMud {
    std::vector<double> depth;  ///< ascending
    std::vector<double> load;

    [[nodiscard]] double at(double measured_depth) const;
};

struct SoftString {
    std::vector<SoftStretch> stretches;  ///< head to bit, without gaps
    SoftMud mud;
    std::vector<FrictionCoefficients> friction;  ///< dynamic, of each section of the well
    SteadyMotion motion;
    SoftLoad at_bit;
    Eigen::Vector3d down{0, 0, 1};  ///< direction of gravity
};

/// Loads at the head and at the depths that were asked for.
struct SoftProfile {
    SoftLoad at_head;
    std::vector<SoftLoad> load;
    std::vector<double> side_force;  ///< N/m
};

/// Integrates the equations from bit to head, by the fourth-order Runge-Kutta method in steps of at
/// most `step` (m) that end at the well's joints, the string's joints and the `depths`: measured
/// depths between head and bit, ascending (m).
SoftProfile solve_soft_string(const SoftString& string, const Well& well,
                              const std::vector<double>& depths, double step = 1.0);

}  // namespace drillstrand
