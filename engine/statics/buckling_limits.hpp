/// Compression at which a string that lies in a well snakes, and at which it winds up to a helix:
/// engine/statics/README.md, "Torque and drag".
#pragma once

#include <Eigen/Core>

namespace drillstrand {

/// A place of the string in its well.
struct LyingString {
    double bending_stiffness = 0;  ///< N m2
    double weight = 0;             ///< buoyed (N/m)
    double clearance = 0;          ///< radius of the hole less the pipe's (m)
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< down the well
    Eigen::Vector3d curvature = Eigen::Vector3d::Zero();   ///< toward the centre of the bend (1/m)
    Eigen::Vector3d down = Eigen::Vector3d::UnitZ();       ///< direction of gravity
};

/// Compressive forces (N).
struct BucklingLimits {
    double sinusoidal = 0;
    double helical = 0;
};

BucklingLimits buckling_limits(const LyingString& string);

}  // namespace drillstrand
