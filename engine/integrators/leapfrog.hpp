/// The production integrator: position Verlet on the director rod, with contact, friction and fluid
/// implicit node by node. Scheme and stability bound: engine/integrators/README.md.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "drillstrand/simulation.hpp"
#include "forces/surroundings.hpp"
#include "integrators/guards.hpp"
#include "integrators/time_error.hpp"
#include "numerics/barrier.hpp"
#include "numerics/block_table.hpp"
#include "numerics/team.hpp"
#include "rod/director.hpp"
#include "rod/pose.hpp"

namespace drillstrand {

class Leapfrog final : public Integrator {
  public:
    /// `tolerance`, `stress_limit`: as in IntegratorOptions.
    Leapfrog(const Scene& scene, double cfl, double tolerance, double stress_limit, int threads);

    void advance(double end, std::int64_t max_steps) override;
    [[nodiscard]] double time() const override { return time_; }
    [[nodiscard]] SeriesRecord series() const override;
    [[nodiscard]] Profile profile() const override;
    [[nodiscard]] StepStatistics statistics() const override;
    [[nodiscard]] int threads() const override { return team_.members(); }
    [[nodiscard]] std::vector<std::string> warnings() const override;

  private:
    /// A thread's share of the work. Each thread keeps its own segments, the block before its first
    /// one included: computed twice rather than waited for.
    struct Worker {
        std::size_t first_span = 0;
        std::size_t end_span = 0;  ///< one past the last
        std::size_t begin = 0;     ///< first block
        std::size_t end = 0;       ///< one past the last block
        BlockTable segments;
        double impacts = 0;
        double slips = 0;
        CoarsestSegment coarsest;
    };

    /// Where the threads of one object meet; a copy of the object has a place of its own.
    struct Meeting {
        static constexpr std::int64_t no_fault = std::numeric_limits<std::int64_t>::max();
        Barrier barrier{1};
        /// The last step to take before all meet again outside; brought forward where the members
        /// of the team wait for each other too long.
        std::atomic<std::int64_t> last_step{0};
        double start = 0;          ///< wall time at which the team began (s)
        double waited_before = 0;  ///< of the barrier (s)
        /// The step of this advance() that failed. Workers compare it with their own: one that is
        /// a step ahead must not stop those who still finish the step before.
        std::atomic<std::int64_t> fault_step{no_fault};
        Meeting() = default;
        Meeting(const Meeting&) : Meeting() {}
    };

    /// One step: velocities from t - dt/2 to t + dt/2, poses from t to t + dt.
    struct Step {
        double time = 0;        ///< t (s)
        double last_drift = 0;  ///< length of the step before (s)
        double drift = 0;       ///< dt (s)
        double kick = 0;        ///< time over which forces act: the mean of both (s)
    };

    /// Equal steps that meet an end exactly, also where they are taken in several pieces.
    struct Course {
        double start = 0;  ///< s
        double end = 0;    ///< s
        std::int64_t steps = 0;
        std::int64_t done = 0;
        [[nodiscard]] double step() const { return (end - start) / static_cast<double>(steps); }
        [[nodiscard]] double time(std::int64_t taken) const {
            return taken == steps ? end : start + static_cast<double>(taken) * step();
        }
    };

    /// A direction that goes along with an end of the rod: d1 of its section.
    struct EndFrame {
        Eigen::Vector3d d1;
        void follow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double angle);
    };

    void take(std::int64_t steps);
    void sample_time_error();
    void start_again();
    void run(std::size_t thread, std::size_t threads, double dt);
    [[nodiscard]] bool team_should_part() const;
    void share_twist(std::size_t threads);
    bool step_spans(Worker& worker, Surroundings& surroundings, const BlockTable& state,
                    BlockTable& next, const Step& step);
    [[nodiscard]] bool keep_guard(Worker& worker, const BlockTable& state, double time) const;
    [[noreturn]] void fail() const;
    void load_head(BlockTable& segments, const BlockTable& state, double time) const;
    void load_bit(BlockTable& segments, const BlockTable& state, double time) const;
    void finish_head(const BlockTable& segments, const BlockTable& state, BlockTable& next,
                     const Step& step);
    void finish_bit(const BlockTable& segments, const BlockTable& state, BlockTable& next,
                    const Step& step);

    [[nodiscard]] Eigen::Vector3d head_d1(double time) const;

    /// Everything at the whole step that is reached: velocities after half a kick.
    struct Snapshot {
        BlockTable state;
        BlockTable segments;
        Surroundings surroundings;
        std::vector<Eigen::Matrix3d> frame;  ///< N+1, d3, d1, d2 in the columns
        std::vector<Vector6> stress;         ///< N
        double impacts;                      ///< in the step that begins here
        double slips;
    };
    [[nodiscard]] Snapshot snapshot() const;
    [[nodiscard]] std::vector<Eigen::Matrix3d> material_frames(const BlockTable& state,
                                                               const BlockTable& segments) const;
    [[nodiscard]] Vector6 stress(std::size_t segment, const BlockTable& state,
                                 const BlockTable& segments, const Eigen::Matrix3d& first,
                                 const Eigen::Matrix3d& last) const;
    [[nodiscard]] double node_kinetic_energy(const BlockTable& state, std::size_t node) const;
    [[nodiscard]] double potential_energy(const BlockTable& state) const;
    [[nodiscard]] double elastic_energy(const std::vector<Vector6>& stress) const;
    [[nodiscard]] std::string describe_divergence(double time) const;

    const Scene& scene_;
    DirectorModel model_;
    Guards guards_;
    Surroundings surroundings_;
    double bound_;  ///< cfl times the stability bound (s)
    TimeErrorControl time_error_;
    std::size_t blocks_;
    std::vector<BlockSpan> spans_;
    std::vector<double> span_outflow_;  ///< per span, energy given to its surroundings (J)
    BlockTable states_[2];
    std::size_t current_ = 0;  ///< which of the two states is that of the last whole step
    Team team_;
    std::vector<Worker> workers_;
    EndFrame head_frame_;
    EndFrame bit_frame_;
    Meeting meeting_;

    double time_ = 0;
    double last_drift_ = 0;
    Course course_;
    double head_work_ = 0;  ///< J
    double bit_work_ = 0;   ///< J
    double initial_head_energy_ = 0;
    double initial_potential_ = 0;
    double initial_spring_energy_ = 0;
    StepStatistics statistics_;
};

}  // namespace drillstrand
