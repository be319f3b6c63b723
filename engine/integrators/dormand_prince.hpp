/// The paper's integrator: the strand equations in time by Dormand-Prince 5(4) with adaptive step.
/// Scheme, step control and friction: engine/integrators/README.md.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "drillstrand/simulation.hpp"
#include "integrators/step_control.hpp"
#include "numerics/barrier.hpp"
#include "rod/strand_state.hpp"

namespace drillstrand {

class DormandPrince final : public Integrator {
  public:
    DormandPrince(const Scene& scene, const Tolerances& tolerances, int threads, Level level = {});

    void advance(double end, std::int64_t max_steps) override;
    [[nodiscard]] double time() const override { return state_.clock.time; }
    [[nodiscard]] SeriesRecord series() const override;
    [[nodiscard]] Profile profile() const override;
    [[nodiscard]] BendingRecord bending() const override;
    [[nodiscard]] std::vector<SensorRecord> sense(
        const std::vector<SensorCase>& sensors) const override;
    [[nodiscard]] StepStatistics statistics() const override { return state_.statistics; }
    [[nodiscard]] int threads() const override { return static_cast<int>(workers_.size()); }
    [[nodiscard]] SavedState save() const override;
    void restore(const SavedState& saved) override;

  private:
    static constexpr std::size_t stages = DormandPrinceTableau::stages;

    /// A thread's share of the work, and its own copies of the loop variables. All threads reach
    /// the same decisions from the same numbers, so that none has to wait for an answer.
    struct Worker {
        std::size_t begin = 0;  ///< first block
        std::size_t end = 0;    ///< one past the last block
        Table<StrandRow>* rod = nullptr;
        Table<StrandRow>* trial = nullptr;
        std::array<Table<StrandRow>*, stages> rate{};  ///< K_1 .. K_7
        HeadState head;
        HeadState trial_head;
        std::array<HeadState, stages> head_rate;
        std::vector<Pose> block_start;
        Clock clock;
        StepStatistics statistics;
        bool underflow = false;
    };

    // The step, in the order of its stages.
    void run(Worker& worker, double end, std::int64_t max_steps);
    void combine(Worker& worker, std::size_t stage, double step);
    void evaluate(Worker& worker, std::size_t stage, double time, const Table<StrandRow>& rod,
                  const HeadState& head);
    [[nodiscard]] double error_estimate(const Worker& worker, double step);
    void accept(Worker& worker, double step);
    void follow_surroundings(Worker& worker, std::size_t block, double step);

    void begin(Worker& worker, std::size_t thread, std::size_t threads);
    void load_ends(const Worker& worker, std::size_t stage, double time,
                   const Table<StrandRow>& rod);
    [[nodiscard]] bool owns_head(const Worker& worker) const { return worker.begin == 0; }
    [[nodiscard]] bool owns_bit(const Worker& worker) const;
    [[nodiscard]] std::string describe_failure() const;

    // constants
    StrandString string_;
    Tolerances tolerances_;

    StrandState state_;

    // workspace
    StrandWorkspace work_;
    Table<StrandRow> trial_;                          ///< the stage at hand
    std::array<Table<StrandRow>, stages - 1> rates_;  ///< K_2 .. K_7; K_1 is state
    std::array<StagePower, stages> power_;            ///< of each stage
    std::vector<double> block_error_;  ///< per block, sum of squares of scaled errors
    Barrier barrier_;
    std::vector<Worker> workers_;
};

}  // namespace drillstrand
