/// Force and couple on the last node, as the leapfrog applies them, and their derivatives.
#pragma once

#include <Eigen/Core>

#include "drillstrand/well.hpp"
#include "rod/bit.hpp"
#include "statics/rod_segment.hpp"

namespace drillstrand {

/// The loads of a case at one time, on a bit that turns at a steady rate.
struct BitLoadCase {
    double time = 0;           ///< at which the schedules are read (s)
    double rotation_rate = 0;  ///< rad/s
    double factor = 1;         ///< of all loads
};

struct BitLoad {
    Vector6 load = Vector6::Zero();                        ///< force (N), couple (N m)
    Eigen::Vector3d dead_force = Eigen::Vector3d::Zero();  ///< the part with a potential (N)
    Matrix6 tangent = Matrix6::Zero();  ///< by displacement and rotation of the node
};

/// `arc`: the arc of well that the bit is in; null without a well.
BitLoad bit_load(const Bit& bit, const BitLoadCase& loads, const SegmentEnd& node,
                 const WellArc* arc);

/// Whether all loads of the bit have a potential: dead forces only.
bool bit_is_conservative(const Bit& bit, const BitLoadCase& loads);

}  // namespace drillstrand
