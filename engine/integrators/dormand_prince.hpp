/// The paper's integrator: the strand equations in time by Dormand-Prince 5(4) with adaptive step.
/// Scheme, step control and friction: engine/integrators/README.md.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "drillstrand/simulation.hpp"
#include "forces/surroundings.hpp"
#include "integrators/step_control.hpp"
#include "numerics/barrier.hpp"
#include "numerics/block_table.hpp"
#include "rod/strand.hpp"

namespace drillstrand {

class DormandPrince final : public Integrator {
  public:
    DormandPrince(const Scene& scene, const Tolerances& tolerances, int threads);

    void advance(double end, std::int64_t max_steps) override;
    [[nodiscard]] double time() const override { return time_; }
    [[nodiscard]] SeriesRecord series() const override;
    [[nodiscard]] Profile profile() const override;
    [[nodiscard]] StepStatistics statistics() const override { return statistics_; }
    [[nodiscard]] int threads() const override { return static_cast<int>(workers_.size()); }

  private:
    static constexpr std::size_t stages = DormandPrinceTableau::stages;

    /// Pose of a head that moves freely, or its rate.
    struct HeadPose {
        Eigen::Vector3d position = Eigen::Vector3d::Zero();
        Eigen::Vector4d quaternion = Eigen::Vector4d::Zero();  ///< x, y, z, w
        [[nodiscard]] Pose pose() const;
    };

    /// A thread's share of the work, and its own copies of the loop variables. All threads reach
    /// the same decisions from the same numbers, so that none has to wait for an answer.
    struct Worker {
        std::size_t begin = 0;  ///< first block
        std::size_t end = 0;    ///< one past the last block
        BlockTable* state = nullptr;
        BlockTable* trial = nullptr;
        std::array<BlockTable*, stages> rate{};
        HeadPose head;
        HeadPose trial_head;
        std::array<HeadPose, stages> head_rate;
        std::vector<Pose> block_start;
        double time = 0;
        double step = 0;  ///< proposed for the next step (s)
        bool underflow = false;
        StepStatistics statistics;
    };

    // The step, in the order of its stages.
    void run(Worker& worker, double end, std::int64_t max_steps);
    void combine(Worker& worker, std::size_t stage, double step);
    void evaluate(Worker& worker, std::size_t stage, double time, const BlockTable& state,
                  const HeadPose& head);
    [[nodiscard]] double error_estimate(const Worker& worker, double step);
    void accept(Worker& worker, double step);
    void follow_surroundings(Worker& worker, std::size_t block, double step);
    void count_events(std::size_t block);

    void share_blocks(Worker& worker, std::size_t thread, std::size_t threads) const;
    void prescribe_head(BlockTable& state, double time) const;
    void hold_head(BlockTable& rate) const;
    void load_ends(const Worker& worker, std::size_t stage, double time, const BlockTable& state);
    [[nodiscard]] Pose head_pose(const HeadPose& head, double time) const;
    [[nodiscard]] Vector6 velocity(const BlockTable& state, std::size_t node) const;
    [[nodiscard]] bool owns_head(const Worker& worker) const { return worker.begin == 0; }
    [[nodiscard]] bool owns_bit(const Worker& worker) const;

    // What the run reports.
    [[nodiscard]] std::vector<Pose> poses() const;
    [[nodiscard]] EnergyAccount energy(const std::vector<Pose>& poses, double spring_energy) const;
    [[nodiscard]] double node_kinetic_energy(std::size_t node) const;
    [[nodiscard]] double potential_energy(const std::vector<Pose>& poses) const;
    [[nodiscard]] std::string describe_failure() const;

    const Scene& scene_;
    Tolerances tolerances_;
    StrandModel model_;
    Surroundings surroundings_;
    StrandWorkspace work_;
    std::array<BlockTable, 2> states_;      ///< of the last step and of the stage at hand
    std::array<BlockTable, stages> rates_;  ///< K_1 .. K_7
    std::vector<double> block_error_;       ///< per block, sum of squares of scaled errors
    std::array<std::vector<double>, stages> block_power_;  ///< of the surroundings on the rod (W)
    std::array<double, stages> head_power_{};              ///< of the head on the rod (W)
    std::array<double, stages> bit_power_{};               ///< of the bit on the rod (W)
    /// What happened at the nodes of a block since the start, and how they were after the last
    /// step.
    struct ContactEvents {
        std::int64_t impacts = 0;
        std::int64_t slips = 0;
        std::array<bool, block_size> touches{};
        std::array<bool, block_size> slides{};
    };
    std::vector<ContactEvents> block_events_;
    std::vector<double> block_outflow_;  ///< per block, energy given to the surroundings (J)
    double head_work_ = 0;               ///< J
    double bit_work_ = 0;                ///< J
    double initial_head_energy_ = 0;     ///< kinetic energy of the head's node at time 0 (J)
    double initial_potential_ = 0;       ///< J
    double initial_spring_energy_ = 0;   ///< of contact springs (J)
    Barrier barrier_;
    std::vector<Worker> workers_;

    // Copied from the first worker whenever the threads part.
    const BlockTable* state_ = nullptr;
    HeadPose head_;
    double time_ = 0;
    double last_step_ = 0;
    StepStatistics statistics_;
};

}  // namespace drillstrand
