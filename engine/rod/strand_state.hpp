/// The state of a run on the strand, as a value: copying it copies the run.
#pragma once

#include <vector>

#include "drillstrand/scene.hpp"
#include "model/pose.hpp"
#include "rod/bit.hpp"
#include "rod/head.hpp"
#include "rod/strand.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// The strand, its surroundings and its ends: all that never changes in a run. The scene must
/// outlive it.
struct StrandString {
    explicit StrandString(const Scene& scene, Level level = {});

    const Scene& scene;
    StrandModel model;
    Head head;
    Bit bit;
};

/// Power of the outside on the rod at a stage.
struct StagePower {
    std::vector<double> surroundings;
    double head = 0;
    double bit = 0;
};
// clang-format off
template <>
inline constexpr auto field_list<StagePower> = std::to_array<Field<StagePower>>({
    {&StagePower::surroundings, "surroundings", "W", "evaluate: per block, of damping and surroundings"},
    {&StagePower::head,         "head",         "W", "evaluate: of the head"},
    {&StagePower::bit,          "bit",          "W", "evaluate: of the bit"},
});
// clang-format on

struct StrandState {
    Table<StrandRow> rod;
    Table<StrandRow> rate;  ///< of `rod`: the first stage of the next step
    Table<WallRow> wall;
    HeadState head;
    HeadState head_rate;
    BitState bit;
    StagePower power;   ///< of the first stage of the next step
    Accounts accounts;  ///< per block
    EnergyOrigin origin;
    Clock clock;
    StepStatistics statistics;

    template <class Self, class Visit>
    static void parts(Self& self, Visit&& visit) {
        visit("rod", self.rod);
        visit("rate", self.rate);
        visit("wall", self.wall);
        visit("head", self.head);
        visit("head_rate", self.head_rate);
        visit("bit", self.bit);
        visit("power", self.power);
        visit("accounts", self.accounts);
        visit("origin", self.origin);
        visit("clock", self.clock);
        visit("statistics", self.statistics);
    }
};

/// The string at rest at time 0 in the scene's initial strains, but for a head that is driven; its
/// rates are yet to be evaluated.
StrandState initial_state(const StrandString& string);

/// Velocity of a node in body axes. Of the wall it is the fluid that moves along.
Vector6 velocity_of(const Scene& scene, const Table<StrandRow>& rod, const Table<WallRow>& wall,
                    std::size_t node);

/// What the load at a bit in this pose depends on.
BitMotion bit_motion(const StrandString& string, const Table<WallRow>& wall, const Pose& pose,
                     double rotation_rate, double time);

/// Counts the nodes of a block that came into contact or began to slide since the last call.
void count_events(const StrandString& string, StrandState& state, std::size_t block);

/// Completes a restored state by what follows from it. Throws std::invalid_argument where it does
/// not fit the string.
void derive(const StrandString& string, StrandState& state);

/// Moments at the nodes (N m, body axes) of stresses of the segments, which bear one moment all
/// along: the mean of both.
std::vector<Eigen::Vector3d> moments_at_nodes(const std::vector<Vector6>& stress);

SeriesRecord series_record(const StrandString& string, const StrandState& state);
Profile profile_record(const StrandString& string, const StrandState& state);
BendingRecord bending_record(const StrandString& string, const StrandState& state);
std::vector<SensorRecord> sensor_records(const StrandString& string, const StrandState& state,
                                         const std::vector<SensorCase>& sensors);
/// The energies from which records of a run that begins with this state count.
EnergyOrigin energy_origin(const StrandString& string, const StrandState& state);

}  // namespace drillstrand
