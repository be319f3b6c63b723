/// What a run on the director rod reports: functions of its constants and its state.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "drillstrand/records.hpp"
#include "rod/director_state.hpp"

namespace drillstrand {

/// Everything at the whole step that is reached: velocities after half a kick, and what the
/// segments and ends exert there.
struct DirectorSnapshot {
    Table<DirectorRow> rod;
    Table<SegmentRow> segments;
    /// What segments hand to nodes in a step, where that is their mean over substeps.
    std::optional<Table<SegmentRow>> averaged;
    Table<WallRow> wall;
    std::vector<Eigen::Matrix3d> frame;  ///< N+1, d3, d1, d2 in the columns
    double impacts = 0;                  ///< in the step that begins here
    double slips = 0;
    JarState jar{};  ///< at this step

    [[nodiscard]] const Table<SegmentRow>& handed_over() const {
        return averaged ? *averaged : segments;
    }
};
DirectorSnapshot snapshot(const DirectorString& string, const DirectorState& state);

SeriesRecord series_record(const DirectorString& string, const DirectorState& state);
Profile profile_record(const DirectorString& string, const DirectorState& state);
/// Places and directors belong to whole steps, so that this takes no half kick.
BendingRecord bending_record(const DirectorString& string, const DirectorState& state);
std::vector<SensorRecord> sensor_records(const DirectorString& string, const DirectorState& state,
                                         const std::vector<SensorCase>& sensors);

/// Frames of the nodes: from the head's d1 by the shortest turn from director to director, and by
/// the twist of the segment.
std::vector<Eigen::Matrix3d> material_frames(const DirectorString& string,
                                             const Table<DirectorRow>& rod, const double* twist,
                                             const Eigen::Vector3d& head_d1);

/// A sentence on the first node of these rods whose numbers have left the finite.
std::string describe_divergence(const DirectorString& string,
                                std::initializer_list<const Table<DirectorRow>*> rods, double time);

/// What the rod's forces do to the velocities of its nodes in half a step, as an energy (J): by
/// this the energy that the leapfrog keeps, 1/2 m v- . v+ of the half steps before and after a
/// record, is less than that of their mean. Records count from that of the first step.
double half_kick_energy(const DirectorString& string, const DirectorState& state, double half_step);

/// The energies from which records of a run that begins with this state count.
EnergyOrigin energy_origin(const DirectorString& string, const DirectorState& state);

}  // namespace drillstrand
