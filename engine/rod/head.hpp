/// The head of the string: clamped in place and turned by a schedule or by a top drive, or free and
/// loaded by dead forces. Its own constants, what it does to the rod, and its state (HeadState,
/// state/rows.hpp).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "model/pose.hpp"
#include "rod/director.hpp"
#include "rod/drive.hpp"
#include "rod/end.hpp"
#include "state/rows.hpp"

namespace drillstrand {

class Head {
  public:
    explicit Head(const Scene& scene);

    [[nodiscard]] bool is_driven() const { return motion_ == HeadMotion::driven; }
    /// Rate about d3 that drives the head (rad/s); a free head is not driven.
    [[nodiscard]] double driven_rate(double time) const;
    /// Rate about d3 whose sense the prescribed torque at the bit opposes (rad/s): that of the
    /// drive (paper eq. 13), or the bit's own where nothing drives the head.
    [[nodiscard]] double opposed_rate(double time, double bit_rate) const;
    [[nodiscard]] HeadState start() const;

    /// Force along -d3 that holds the head (N) against the pull of the first segment on it (N,
    /// space frame) and the weight of its own half cell; a free head is held by its load.
    [[nodiscard]] double hook_load(const Eigen::Vector3d& pull, double time) const;
    /// Couple about d3 that the drive exerts on the head (N m), from that of the first segment on
    /// it; positive where it drives a positive rotation.
    [[nodiscard]] double surface_torque(double torque, double time) const;

    // ---- on directors

    /// What acts on a free head, as a ghost segment before the first.
    void load(Table<SegmentRow>& segments, const Table<DirectorRow>& rod, double time) const;
    /// The end of a step: a driven head keeps its place and turns as scheduled or as its drive
    /// makes it, a free head's d1 goes along; the work of what moves it.
    void finish(HeadState& head, const Table<SegmentRow>& segments, const Table<DirectorRow>& rod,
                Table<DirectorRow>& next, const DirectorStep& step) const;
    /// Velocities of a driven head at a whole step, half a kick (s) after it had a rate (rad/s).
    void settle(const HeadState& head, const Table<SegmentRow>& segments, double rate,
                Table<DirectorRow>& rod, double time, double half_kick) const;
    [[nodiscard]] Eigen::Vector3d d1(const HeadState& head, double time) const;

    // ---- on the strand, in body axes

    [[nodiscard]] Pose pose(const HeadState& head, double time) const;
    /// Rate of a free head's position and quaternion at a velocity (w, v).
    [[nodiscard]] HeadState rate(const HeadState& head, const Vector6& velocity) const;
    /// Stress that a free head's load imposes on a rod with that frame at its head.
    [[nodiscard]] Vector6 stress(const Eigen::Matrix3d& frame, double time) const;
    /// Momentum of a driven head: it turns about d3 at the scheduled rate and does not move.
    void prescribe(Table<StrandRow>& rod, double time) const;
    /// A driven head has no rate of its own.
    void hold(Table<StrandRow>& rate) const;

  private:
    /// The rate of a driven head after a step.
    double next_rate(HeadState& head, const Table<SegmentRow>& segments, double rate,
                     const DirectorStep& step) const;

    HeadMotion motion_;
    ScalarSchedule rotation_;
    VectorSchedule force_;
    VectorSchedule moment_;
    std::optional<Drive> drive_;
    Pose start_;
    double polar_inertia_;    ///< of the head's node, per length (kg m)
    double cell_;             ///< length of its cell (m)
    Eigen::Vector3d weight_;  ///< of its cell, buoyed (N)
};

/// A direction that goes along with a section: by the shortest turn from one director to the next,
/// and then by an angle about it (rad).
Eigen::Vector3d followed(const Eigen::Vector3d& d1, const Eigen::Vector3d& from,
                         const Eigen::Vector3d& to, double angle);

}  // namespace drillstrand
