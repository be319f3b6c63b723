/// The production integrator: position Verlet on the director rod, with contact, friction and fluid
/// implicit node by node. Scheme and stability bound: engine/integrators/README.md.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "drillstrand/simulation.hpp"
#include "integrators/guards.hpp"
#include "integrators/time_error.hpp"
#include "integrators/work_share.hpp"
#include "numerics/barrier.hpp"
#include "numerics/team.hpp"
#include "rod/director_state.hpp"

namespace drillstrand {

class Leapfrog final : public Integrator {
  public:
    /// `tolerance`, `stress_limit`: as in IntegratorOptions.
    Leapfrog(const Scene& scene, double cfl, double tolerance, double stress_limit, int threads,
             Level level = {});

    void advance(double end, std::int64_t max_steps) override;
    [[nodiscard]] double time() const override { return state_.clock.time; }
    [[nodiscard]] SeriesRecord series() const override;
    [[nodiscard]] Profile profile() const override;
    [[nodiscard]] BendingRecord bending() const override;
    [[nodiscard]] std::vector<SensorRecord> sense(
        const std::vector<SensorCase>& sensors) const override;
    [[nodiscard]] StepStatistics statistics() const override;
    [[nodiscard]] int threads() const override { return team_.members(); }
    [[nodiscard]] std::vector<std::string> warnings() const override;
    [[nodiscard]] SavedState save() const override;
    void restore(const SavedState& saved) override;

  private:
    /// A thread's share of the work. Each thread keeps its own segments, the block before its first
    /// one included: computed twice rather than waited for. What it writes in a step shares no
    /// cache line with what others write.
    struct alignas(block_alignment) Worker {
        const WorkShare* share = nullptr;
        Table<SegmentRow> segments;
        std::vector<Substeps::Work> substeps;  ///< of each stretch of the string
        CoarsestSegment coarsest;
        Accounts accounts;  ///< of its spans, while it runs
        JarState jar;       ///< at the whole step, where it has the jar's segment
    };

    /// Where the threads meet.
    struct Meeting {
        static constexpr std::int64_t no_fault = std::numeric_limits<std::int64_t>::max();
        Barrier barrier{1};
        /// The last step to take before all meet again outside; brought forward where the members
        /// of the team wait for each other too long.
        std::atomic<std::int64_t> last_step{0};
        double start = 0;          ///< wall time at which the team began (s)
        double waited_before = 0;  ///< of the barrier (s)
        /// The step of this take() that failed. Workers compare it with their own: one that is a
        /// step ahead must not stop those who still finish the step before.
        std::atomic<std::int64_t> fault_step{no_fault};
    };

    [[nodiscard]] Course course_to(double end, double longest_step) const;
    void take(std::int64_t steps);
    void run(std::size_t thread, std::size_t threads);
    void fill_segments(Worker& worker, std::size_t span, const Table<DirectorRow>& rod,
                       const DirectorStep& step);
    bool step_spans(Worker& worker, const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                    const DirectorStep& step);
    [[nodiscard]] bool keep_guard(Worker& worker, const Table<DirectorRow>& rod,
                                  const DirectorStep& step) const;
    [[nodiscard]] bool team_should_part() const;
    [[noreturn]] void fail();

    void sample_time_error();
    [[nodiscard]] Profile profile_after(double end, double step);

    // constants
    DirectorString string_;
    Guards guards_;
    TimeErrorControl time_error_;
    double bound_;  ///< cfl times the stability bound (s)

    DirectorState state_;

    // workspace
    Table<DirectorRow> next_;
    Team team_;
    std::vector<std::vector<WorkShare>> shares_;  ///< of teams of 1, 2, ... threads
    std::vector<Worker> workers_;
    Meeting meeting_;
};

}  // namespace drillstrand
