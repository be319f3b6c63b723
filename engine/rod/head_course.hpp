/// The motion of the head that schedules prescribe: engine/rod/README.md, "Head in motion".
#pragma once

#include "drillstrand/case.hpp"
#include "drillstrand/records.hpp"
#include "model/pose.hpp"

namespace drillstrand {

class HeadCourse {
  public:
    explicit HeadCourse(const HeadCase& head);

    /// It does more than turn about d3.
    [[nodiscard]] bool moves() const { return moves_; }
    /// It stays on the line of d3.
    [[nodiscard]] bool is_axial() const { return is_axial_; }

    /// Rate about d3 (rad/s), and the angle over a step (rad).
    [[nodiscard]] double rate(double time) const { return rotation_(time); }
    [[nodiscard]] double turn(double time, double step) const {
        return rotation_.integral(time + step) - rotation_.integral(time);
    }
    /// Angle about d3 since time 0 (rad).
    [[nodiscard]] double angle(double time) const { return rotation_.integral(time); }
    /// Way along d3 over a step (m).
    [[nodiscard]] double travel(double time, double step) const {
        return along_.integral(time + step) - along_.integral(time);
    }
    /// Angular and linear velocity (rad/s, m/s) about and along d3, d1, d2.
    [[nodiscard]] Vector6 velocity(double time) const;
    /// The pose of the head a step later, were its velocity the mean over the step.
    [[nodiscard]] Pose after(const Pose& pose, double time, double step) const;

  private:
    ScalarSchedule rotation_;
    ScalarSchedule along_;  ///< m/s along d3
    VectorSchedule tilting_;
    VectorSchedule velocity_;
    bool moves_;
    bool is_axial_;
};

}  // namespace drillstrand
