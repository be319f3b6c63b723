/// The head of the string: clamped in place or moved by schedules, turned by a schedule or by a top
/// drive; pinned; or free and loaded by dead forces. Its own constants, what it does to the rod,
/// and its state (HeadState, state/rows.hpp).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "model/pose.hpp"
#include "rod/director.hpp"
#include "rod/drive.hpp"
#include "rod/end.hpp"
#include "rod/head_course.hpp"
#include "rod/hoist.hpp"
#include "state/rows.hpp"

namespace drillstrand {

class Head {
  public:
    explicit Head(const Scene& scene);

    /// Its place and its turn about d3 are prescribed.
    [[nodiscard]] bool is_held() const { return motion_ != HeadMotion::free; }
    /// It is held and free to tilt.
    [[nodiscard]] bool is_pinned() const { return motion_ == HeadMotion::pinned; }
    /// Rate about d3 whose sense the prescribed torque at the bit opposes (rad/s): that of the
    /// drive (paper eq. 13), or the bit's own where nothing drives the head.
    [[nodiscard]] double opposed_rate(double time, double bit_rate) const;
    /// At rest with that director.
    [[nodiscard]] HeadState start(const Eigen::Vector3d& director) const;

    /// Force along -d3 that holds the head (N) against the pull of the first segment on it (N,
    /// space frame) and the weight of its own half cell; a free head is held by its load.
    [[nodiscard]] double hook_load(const Eigen::Vector3d& pull, const Eigen::Vector3d& d3,
                                   double time) const;
    /// Couple about d3 that the drive exerts on the head (N m), from that of the first segment on
    /// it; positive where it drives a positive rotation.
    [[nodiscard]] double surface_torque(double torque, double time) const;
    /// Tension of a line of the hoist (N); 0 without one.
    [[nodiscard]] double dead_line_tension(const HeadState& head, double time) const;
    /// Of the kinetic energy of the head's cell (J), which turns at a rate about d3 (rad/s), what
    /// prescribed motion gives it: all, where it is pinned that of its turn, none where it is free.
    [[nodiscard]] double prescribed_energy(double whole, double rate) const;

    // ---- on directors

    /// The start: the lines of a hoist carry what hangs on them.
    void hang(HeadState& head, const Table<SegmentRow>& segments) const;
    /// What acts on a free head, as a ghost segment before the first.
    void load(Table<SegmentRow>& segments, const Table<DirectorRow>& rod, double time) const;
    /// The end of a step: a held head moves as scheduled and turns so or as its drive makes it, the
    /// d1 of one that tilts by itself goes along; the work of what moves it.
    void finish(HeadState& head, const Table<SegmentRow>& segments, const Table<DirectorRow>& rod,
                Table<DirectorRow>& next, const DirectorStep& step) const;
    /// Velocities of a held head at a whole step, half a kick (s) after those of `rod`.
    void settle(const HeadState& head, const Table<SegmentRow>& segments,
                const Table<DirectorRow>& rod, Table<DirectorRow>& at, double time,
                double half_kick) const;
    [[nodiscard]] Eigen::Vector3d d1(const HeadState& head, double time) const;

    // ---- on the strand, in body axes

    /// Its pose is a state that follows its velocity; else a function of time.
    [[nodiscard]] bool keeps_pose() const {
        return motion_ != HeadMotion::driven || course_.moves();
    }
    [[nodiscard]] Pose pose(const HeadState& head, double time) const;
    /// Rate of its position and quaternion at a velocity (w, v).
    [[nodiscard]] HeadState rate(const HeadState& head, const Vector6& velocity) const;
    /// Stress that a free head's load imposes on a rod with that frame at its head.
    [[nodiscard]] Vector6 stress(const Eigen::Matrix3d& frame, double time) const;
    /// Wrench with which what holds the head answers that of the first segment on it, of the given
    /// frame (N m, N); its weight included where the head moves.
    [[nodiscard]] Vector6 holding(const Vector6& wrench, const Eigen::Matrix3d& frame) const;
    /// Momentum of a held head as scheduled, with its inertia (kg m, kg/m).
    void prescribe(Table<StrandRow>& rod, const Vector6& inertia, double time) const;
    /// A held head has no rate of its own; a pinned one that of its tilt.
    void hold(Table<StrandRow>& rate) const;

  private:
    void follow(HeadState& head, const Table<DirectorRow>& rod, const Table<DirectorRow>& next,
                const DirectorStep& step) const;
    void move_along(HeadState& head, const Table<SegmentRow>& segments,
                    const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                    const DirectorStep& step) const;
    /// Its speed along d3 at a whole step, half a kick (s) after that of `rod`.
    [[nodiscard]] double settled_speed(const HeadState& head, const Table<SegmentRow>& segments,
                                       const Table<DirectorRow>& rod, double time,
                                       double half_kick) const;
    [[nodiscard]] HoistLoad hoist_load(const Table<SegmentRow>& segments) const;
    void move_freely(HeadState& head, const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                     const DirectorStep& step) const;
    /// The rate of a held head after a step.
    double next_rate(HeadState& head, const Table<SegmentRow>& segments, double rate,
                     const DirectorStep& step) const;
    /// Power of the rod's first segment and of the head's weight against a velocity and a turning
    /// across d3 of the head (W).
    [[nodiscard]] double power_taken(const Table<SegmentRow>& segments,
                                     const Eigen::Vector3d& director,
                                     const Eigen::Vector3d& velocity,
                                     const Eigen::Vector3d& turning) const;

    HeadMotion motion_;
    HeadCourse course_;
    VectorSchedule force_;
    VectorSchedule moment_;
    std::optional<Drive> drive_;
    std::optional<Hoist> hoist_;
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
