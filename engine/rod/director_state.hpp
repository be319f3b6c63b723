/// The state of a run on the director rod, as a value: copying it copies the run.
#pragma once

#include <string>

#include "drillstrand/scene.hpp"
#include "rod/bit.hpp"
#include "rod/director.hpp"
#include "rod/head.hpp"
#include "rod/jar.hpp"
#include "rod/substeps.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// The director rod, its surroundings and its ends: all that never changes in a run. The scene must
/// outlive it.
struct DirectorString {
    explicit DirectorString(const Scene& scene, Level level = {});

    const Scene& scene;
    DirectorModel model;
    Head head;
    Bit bit;
    Jar jar;
    Substeps substeps;
    std::vector<BlockSpan> spans;  ///< of nodes, one kernel call each
};

struct DirectorState {
    Table<DirectorRow> rod;
    Table<WallRow> wall;
    // written at each step, each by the thread that has the end: in cache lines of their own
    alignas(block_alignment) HeadState head;
    alignas(block_alignment) BitState bit;
    alignas(block_alignment) RockState rock;
    alignas(block_alignment) Accounts accounts;  ///< per span
    JarState jar;  ///< of the whole step before; Jar::follow() leads to that of this one
    EnergyOrigin origin;
    Clock clock;
    Course course;
    StepStatistics statistics;
    TimeError time_error;
    CoarsestSegment coarsest;

    template <class Self, class Visit>
    static void parts(Self& self, Visit&& visit) {
        visit("rod", self.rod);
        visit("wall", self.wall);
        visit("head", self.head);
        visit("bit", self.bit);
        visit("rock", self.rock);
        visit("accounts", self.accounts);
        visit("jar", self.jar);
        visit("origin", self.origin);
        visit("clock", self.clock);
        visit("course", self.course);
        visit("statistics", self.statistics);
        visit("time_error", self.time_error);
        visit("coarsest", self.coarsest);
    }
};

/// The string at rest at time 0 in the scene's initial nodes, but for a head that is driven.
DirectorState initial_state(const DirectorString& string);

/// What the segments of a span bear at a whole step: director_segments(), and the jar's as it
/// slides there.
void string_segments(const DirectorString& string, const JarState& jar,
                     const Table<DirectorRow>& rod, Table<SegmentRow>& segments, BlockSpan span,
                     double drift);

/// Down the well at the bit; its director where there is no well.
Eigen::Vector3d well_at_bit(const DirectorString& string, const Table<WallRow>& wall,
                            const Table<DirectorRow>& rod);

/// The load at the bit as a ghost segment behind the last, at the whole step of the state.
void load_bit(const DirectorString& string, const DirectorState& state,
              const Table<DirectorRow>& rod, double time, Table<SegmentRow>& segments);

/// As if a run began with this state: velocities of the whole step, and no step before.
void start_again(const DirectorString& string, DirectorState& state);

/// Completes a restored state by what follows from it. Throws std::invalid_argument where it does
/// not fit the string.
void derive(const DirectorString& string, DirectorState& state);

}  // namespace drillstrand
