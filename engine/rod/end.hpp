/// An end of the rod, and what the outside does to it.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace drillstrand {

/// Of the outside on an end of the rod, space frame.
struct EndLoad {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
    Eigen::Vector3d couple = Eigen::Vector3d::Zero();  ///< N m
};

/// The step of the leapfrog that an end takes part in: velocities from t - dt/2 to t + dt/2, poses
/// from t to t + dt.
struct DirectorStep {
    double time = 0;            ///< t (s)
    double last_drift = 0;      ///< length of the step before (s)
    double drift = 0;           ///< dt (s)
    double kick = 0;            ///< time over which forces act: the mean of both (s)
    std::int64_t number = 0;    ///< of the step, from the start of the run
    double motor_pressure = 0;  ///< of the step before, as the head reads it (Pa)
};

}  // namespace drillstrand
