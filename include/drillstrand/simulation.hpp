/// Running a scene over time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/isa.hpp"
#include "drillstrand/records.hpp"
#include "drillstrand/saved_state.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

/// The scene from which a run of a case starts: build_scene(), in the equilibrium of the director
/// rod under the loads of time 0, at rest and without friction, where the case asks for it (its
/// initial nodes alone: initial strains stay). Throws as build_scene(), SimulationError where there
/// is no equilibrium, and InputError where a node starts deeper in the wall than its clearance, or
/// than initial.penetration_limit.
Scene starting_scene(const Case& input);

/// A time loop over one scene. Create one with make_integrator().
class Integrator {
  public:
    virtual ~Integrator() = default;

    /// Advances until `end` is reached exactly, or until `max_steps` more steps were accepted.
    /// Throws SimulationError where the solution stops being finite, the step underflows or a
    /// physical guard stops the run (GuardError). Nothing more can be asked of it then but its
    /// statistics.
    virtual void advance(double end, std::int64_t max_steps) = 0;

    [[nodiscard]] virtual double time() const = 0;
    [[nodiscard]] virtual SeriesRecord series() const = 0;
    [[nodiscard]] virtual Profile profile() const = 0;
    [[nodiscard]] virtual BendingRecord bending() const = 0;
    /// A record of each sensor, in their order.
    [[nodiscard]] virtual std::vector<SensorRecord> sense(
        const std::vector<SensorCase>& sensors) const = 0;
    [[nodiscard]] virtual StepStatistics statistics() const = 0;
    /// Threads that share the string.
    [[nodiscard]] virtual int threads() const { return 1; }
    /// What a user should know of the run so far, a sentence each.
    [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }

    /// All that a run needs to go on from here, between two calls of advance().
    [[nodiscard]] virtual SavedState save() const = 0;
    /// Takes up a saved run of the same scene and options: what follows is the same, bit for bit,
    /// as if it had never been left, whatever the number of threads. Throws std::invalid_argument
    /// where the rows are not those of this scene and integrator; the integrator then is as before.
    virtual void restore(const SavedState& saved) = 0;
};

struct IntegratorOptions {
    IntegratorKind kind = IntegratorKind::leapfrog;
    double absolute_tolerance = 1e-7;
    double relative_tolerance = 1e-5;
    double cfl = 0.9;
    double tolerance = 0;       ///< time error for which the leapfrog shortens its steps; 0: none
    int threads = 1;            ///< 0: as many as the string gives work, up to all cores
    double stress_limit = 5;    ///< multiple of yield at which the leapfrog stops; 0: none
    Isa isa = best_isa();       ///< of the kernels, at most best_isa()
    bool reproducible = false;  ///< the same bits with every instruction set
};

IntegratorOptions integrator_options(const RunCase& run);

/// The integrator starts from the scene's initial state at time 0. The scene must outlive it.
std::unique_ptr<Integrator> make_integrator(const Scene& scene, const IntegratorOptions& options);

/// When to record, and until when to run.
struct RunSchedule {
    double duration = 0;          ///< s
    double interval = 0.1;        ///< s, of series records
    double profile_interval = 5;  ///< s; 0: first and last only
    double bending_interval = 0;  ///< s; 0: none
    std::vector<SensorCase> sensors{};
};

RunSchedule run_schedule(const Case& input);

/// Records at 0, interval, 2 interval, ... and at `end` that a run has taken which has come to
/// `time` (s).
std::size_t records_until(double time, double interval, double end);

/// Records that a run has taken before it was left. Those of bending and sensors follow from its
/// time.
struct RecordCounts {
    std::size_t series = 0;
    std::size_t profiles = 0;
};

/// Receives what a run reports. All calls come from the thread that called simulate().
class Observer {
  public:
    virtual ~Observer() = default;
    virtual void on_series(const SeriesRecord& record) = 0;
    virtual void on_profile(const Profile& profile) = 0;
    virtual void on_bending(const BendingRecord& /*record*/) {}
    /// `sensor`: its number in the schedule.
    virtual void on_sensor(std::size_t /*sensor*/, const SensorRecord& /*record*/) {}
    /// Called about ten times a second of wall time, and after every step that takes longer than
    /// that, with the simulated time reached; false asks the run to stop.
    virtual bool on_progress(double time, const StepStatistics& statistics) = 0;
};

enum class RunOutcome { complete, stopped };

/// Records at 0, interval, 2 interval, ... and at the end, profiles, bending and sensors likewise,
/// and advances the integrator in between: steps are cut so that each record is at its time.
/// SimulationError passes through after what was recorded so far; a record with a number that is
/// not finite is one, and is not handed on. `taken`: what a restored run has recorded already. A
/// record of a pipe that left the well is handed on before the run ends with a GuardError.
RunOutcome simulate(Integrator& integrator, const RunSchedule& schedule, Observer& observer,
                    const RecordCounts& taken = {});

}  // namespace drillstrand
