/// The top drive: engine/rod/README.md, "Top drive".
#pragma once

#include "drillstrand/case.hpp"
#include "drillstrand/scene.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// The set rate about a time, and the torque of the string on the head then.
struct DriveDemand {
    double rate;           ///< rad/s, set, at the whole step
    double turn;           ///< rad, set, in the step to come
    double string_torque;  ///< N m, of the first segment on the head
    double kick;           ///< s, over which torques act
    double drift;          ///< s, length of the step
};

class Drive {
  public:
    /// Of a drive on the pipe at the head of a scene.
    Drive(const DriveCase& drive, const Scene& scene);

    /// Impedance of a pipe to torsion (N m s): root of inertia times stiffness.
    static double impedance(const SectionProperties& pipe);

    /// Takes the head's rate (rad/s) through a step, and its angle, lag and torque with it.
    double advance(HeadState& head, double rate, const DriveDemand& demand) const;

  private:
    /// The rate after a kick, were the motor without limits.
    [[nodiscard]] double unlimited(const HeadState& head, double rate,
                                   const DriveDemand& demand) const;

    /// A torque (N m) as far as the motor's limits let it drive the head from a rate on.
    [[nodiscard]] double limited(double torque, double rate, const DriveDemand& demand) const;

    bool stiff_;
    double inertia_;       ///< kg m2, that of the head's own cell included
    double proportional_;  ///< N m s
    double integral_;      ///< N m
    double torque_limit_;  ///< N m
    double power_limit_;   ///< W
};

}  // namespace drillstrand
