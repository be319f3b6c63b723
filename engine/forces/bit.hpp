/// The load at the bit: weight, torque and the dead and follower loads of a case.
#pragma once

#include <Eigen/Core>

#include "drillstrand/case.hpp"
#include "drillstrand/records.hpp"

namespace drillstrand {

/// Pose and surroundings of the bit that its load depends on.
struct BitMotion {
    Eigen::Matrix3d frame;           ///< d3, d1, d2 in the columns
    Eigen::Vector3d well_direction;  ///< down the well at the bit
    double rotation_rate;            ///< whose sense the torque opposes (rad/s)
    double radius;                   ///< m
};

/// Torque at the bit that opposes rotation at a steady rate of full speed (N m):
/// the schedule's, or mu_b (pi R / 4) times the weight (paper eq. 15).
double bit_torque(const BitCase& bit, double radius, double time);

/// Stress that the outside imposes at the bit, in body axes (paper eqs. 13-14).
Vector6 bit_stress(const BitCase& bit, const BitMotion& motion, double time);

}  // namespace drillstrand
