#include "integrators/dormand_prince.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "drillstrand/error.hpp"
#include "numerics/kernel.hpp"
#include "numerics/ordered_sum.hpp"
#include "rod/report.hpp"
#include "state/save.hpp"

namespace drillstrand {

using Tableau = DormandPrinceTableau;

namespace {

constexpr double least_step = 1e-13;  // s; below it the step control has lost

/// result = base + step (w_0 K_0 + ... ) over `count` entries of one row.
template <std::size_t terms>
DRILLSTRAND_INLINE void weighted_sum(double* result, const double* base,
                                     const std::array<const double*, 7>& k,
                                     const std::array<double, 7>& weight, double step,
                                     std::size_t count) {
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
        double sum = weight[0] * k[0][i];
        if constexpr (terms > 1) sum += weight[1] * k[1][i];
        if constexpr (terms > 2) sum += weight[2] * k[2][i];
        if constexpr (terms > 3) sum += weight[3] * k[3][i];
        if constexpr (terms > 4) sum += weight[4] * k[4][i];
        if constexpr (terms > 5) sum += weight[5] * k[5][i];
        result[i] = base[i] + step * sum;
    }
}

/// The state at a stage from the rates of the stages before it.
DRILLSTRAND_KERNEL void stage_state(std::size_t stage, double* result, const double* base,
                                    const std::array<const double*, 7>& k, double step,
                                    std::size_t count) {
    const std::array<double, 7>& a = Tableau::a[stage];
    switch (stage) {
        case 1:
            return weighted_sum<1>(result, base, k, a, step, count);
        case 2:
            return weighted_sum<2>(result, base, k, a, step, count);
        case 3:
            return weighted_sum<3>(result, base, k, a, step, count);
        case 4:
            return weighted_sum<4>(result, base, k, a, step, count);
        case 5:
            return weighted_sum<5>(result, base, k, a, step, count);
        default:
            return weighted_sum<6>(result, base, k, a, step, count);
    }
}

/// Sum of squares of the scaled errors of one row of one block.
DRILLSTRAND_KERNEL double block_error(const std::array<const double*, 7>& k, const double* value,
                                      double step, const Tolerances& tolerances) {
    constexpr std::array<double, 7> e = Tableau::error_weights();
    const Tolerances tol = tolerances;
    alignas(block_alignment) double square[block_size];
#pragma omp simd
    for (std::size_t i = 0; i < block_size; ++i) {
        const double error = step * (e[0] * k[0][i] + e[2] * k[2][i] + e[3] * k[3][i] +
                                     e[4] * k[4][i] + e[5] * k[5][i] + e[6] * k[6][i]);
        square[i] = scaled_error_squared(error, value[i], tol);
    }
    return ordered_sum(square, block_size);
}

/// Mean over the stages of a power, as the step's rates are weighted.
template <class Power>
double mean_over_stages(const Power& power) {
    double mean = 0.0;
    for (std::size_t i = 0; i < Tableau::stages; ++i)
        mean += Tableau::b[i] * power(i);
    return mean;
}

}  // namespace

DormandPrince::DormandPrince(const Scene& scene, const Tolerances& tolerances, int threads,
                             Level level)
    : string_(scene, level),
      tolerances_(tolerances),
      state_(initial_state(string_)),
      work_(string_.model.segments + 1),
      trial_(state_.rod),
      block_error_(state_.rod.blocks(), 0.0),
      barrier_(1),
      workers_(static_cast<std::size_t>(threads)) {
    const std::size_t blocks = state_.rod.blocks();
    for (Table<StrandRow>& rate : rates_)
        rate = state_.rate;
    for (StagePower& power : power_)
        power = state_.power;
    for (Worker& worker : workers_)
        worker.block_start.resize(blocks);

    // the first rates, by one worker for all: contact at time 0 is then known
    Worker& first = workers_.front();
    begin(first, 0, 1);
    evaluate(first, 0, 0.0, state_.rod, state_.head);
    state_.head_rate = first.head_rate[0];
    state_.power = power_[0];
    state_.statistics = first.statistics;
    for (std::size_t block = 0; block < blocks; ++block)
        count_events(string_, state_, block);
    state_.origin = energy_origin(string_, state_);
}

void DormandPrince::advance(double end, std::int64_t max_steps) {
    power_[0] = state_.power;
#pragma omp parallel num_threads(static_cast <int>(workers_.size()))
    {
        // the team may be smaller than asked for
        const auto threads = static_cast<std::size_t>(omp_get_num_threads());
#pragma omp single
        barrier_.set_threads(static_cast<int>(threads));
        const auto thread = static_cast<std::size_t>(omp_get_thread_num());
        begin(workers_[thread], thread, threads);
        run(workers_[thread], end, max_steps);
    }
    const Worker& first = workers_.front();
    if (first.rod != &state_.rod) std::swap(state_.rod, trial_);
    if (first.rate[0] != &state_.rate) std::swap(state_.rate, rates_.back());
    state_.head_rate = first.head_rate[0];
    state_.power = power_[0];
    const double work = state_.head.work;
    state_.head = first.head;
    state_.head.work = work;
    state_.clock = first.clock;
    state_.statistics = first.statistics;
    if (first.underflow) throw SimulationError(describe_failure());
}

/// A worker's share, and its own copies of the state's loop variables.
void DormandPrince::begin(Worker& worker, std::size_t thread, std::size_t threads) {
    const std::size_t blocks = block_error_.size();
    worker.begin = blocks * thread / threads;
    worker.end = blocks * (thread + 1) / threads;
    worker.rod = &state_.rod;
    worker.trial = &trial_;
    worker.rate[0] = &state_.rate;
    for (std::size_t i = 1; i < stages; ++i)
        worker.rate[i] = &rates_[i - 1];
    worker.head = state_.head;
    worker.head_rate[0] = state_.head_rate;
    worker.clock = state_.clock;
    worker.statistics = state_.statistics;
}

/// The time loop.
void DormandPrince::run(Worker& worker, double end, std::int64_t max_steps) {
    const std::size_t entries = 12 * string_.model.segments;
    const std::int64_t last =
        max_steps < std::numeric_limits<std::int64_t>::max() - worker.statistics.steps
            ? worker.statistics.steps + max_steps
            : std::numeric_limits<std::int64_t>::max();
    Clock& clock = worker.clock;
    barrier_.wait();
    while (clock.time < end && worker.statistics.steps < last) {
        // the step, cut to meet the end exactly, in two equal parts rather than in a long and a
        // short one
        const double left = end - clock.time;
        const double step = left <= clock.proposed_step      ? left
                            : left < 2 * clock.proposed_step ? left / 2
                                                             : clock.proposed_step;
        for (std::size_t stage = 1; stage < stages; ++stage) {
            combine(worker, stage, step);
            barrier_.wait();
            evaluate(worker, stage, clock.time + Tableau::c[stage] * step, *worker.trial,
                     worker.trial_head);
        }
        const double error = error_norm(error_estimate(worker, step), entries);
        const double next = step * step_factor(error);
        const bool cut = step < clock.proposed_step;
        if (error < 1.0) {
            accept(worker, step);
            clock.time = step == left ? end : clock.time + step;
            clock.last_step = step;
            clock.proposed_step = cut ? std::max(clock.proposed_step, next) : next;
            ++worker.statistics.steps;
            if (!cut) {
                worker.statistics.smallest_step = std::min(worker.statistics.smallest_step, step);
                worker.statistics.largest_step = std::max(worker.statistics.largest_step, step);
            }
        } else {
            clock.proposed_step = next;
            ++worker.statistics.rejected;
            if (next < least_step) {
                worker.underflow = true;
                break;
            }
        }
    }
    barrier_.wait();
}

/// State of the stage on this worker's blocks, the head's motion included.
void DormandPrince::combine(Worker& worker, std::size_t stage, double step) {
    const std::size_t first = worker.begin * block_size;
    const std::size_t count = (worker.end - worker.begin) * block_size;
    const auto sum = at_level<stage_state>(string_.model.level);
    for (std::size_t line = 0; line < Table<StrandRow>::lines; ++line) {
        std::array<const double*, 7> k{};
        for (std::size_t i = 0; i < stages; ++i)
            k[i] = worker.rate[i]->line(line) + first;
        sum(stage, worker.trial->line(line) + first, worker.rod->line(line) + first, k, step,
            count);
    }
    if (owns_head(worker))
        string_.head.prescribe(*worker.trial,
                               inertia_of(string_.scene, 0, fluid_mass_at(state_.wall, 0)),
                               worker.clock.time + Tableau::c[stage] * step);
    if (!string_.head.keeps_pose()) return;
    worker.trial_head = worker.head;
    for (std::size_t i = 0; i < stage; ++i) {
        const double weight = step * Tableau::a[stage][i];
        worker.trial_head.position += weight * worker.head_rate[i].position;
        worker.trial_head.quaternion += weight * worker.head_rate[i].quaternion;
    }
}

/// Rates of this worker's blocks. Every worker's part of `rod` must be complete.
void DormandPrince::evaluate(Worker& worker, std::size_t stage, double time,
                             const Table<StrandRow>& rod, const HeadState& head) {
    Table<StrandRow>& rate = *worker.rate[stage];
    segment_pass(string_.model, rod, rate, work_, state_.wall, worker.begin, worker.end);
    if (string_.head.keeps_pose())
        worker.head_rate[stage] =
            string_.head.rate(head, velocity_of(string_.scene, rod, state_.wall, 0));
    barrier_.wait();
    chain_blocks(string_.head.pose(head, time), work_, worker.block_start, worker.end);
    load_ends(worker, stage, time, rod);
    node_pass(string_.model, rod, rate, work_, worker.block_start, state_.wall, worker.begin,
              worker.end);
    std::copy_n(work_.power.begin() + static_cast<std::ptrdiff_t>(worker.begin),
                worker.end - worker.begin,
                power_[stage].surroundings.begin() + static_cast<std::ptrdiff_t>(worker.begin));
    if (owns_head(worker)) string_.head.hold(rate);
    ++worker.statistics.evaluations;
}

/// Wrenches of head and bit on the rod, and their power.
void DormandPrince::load_ends(const Worker& worker, std::size_t stage, double time,
                              const Table<StrandRow>& rod) {
    if (owns_head(worker)) {
        Vector6 on_rod;
        if (string_.head.is_held()) {
            // what keeps the head on its course is what the first segment pulls it with
            on_rod = string_.head.holding(wrench_on_head(work_), worker.block_start[0].frame);
        } else {
            on_rod = string_.head.stress(worker.block_start[0].frame, time);
            set_head_wrench(work_, -on_rod);
        }
        power_[stage].head = on_rod.dot(velocity_of(string_.scene, rod, state_.wall, 0));
    }
    if (owns_bit(worker)) {
        const std::size_t node = string_.model.segments;
        const Vector6 v = velocity_of(string_.scene, rod, state_.wall, node);
        const Pose pose = node_pose(work_, worker.block_start, node);
        const Vector6 stress =
            string_.bit.stress(bit_motion(string_, state_.wall, pose, v[0], time), time);
        set_bit_wrench(work_, node, stress);
        power_[stage].bit = stress.dot(v);
    }
}

/// Sum over all entries of the squares of the scaled errors.
double DormandPrince::error_estimate(const Worker& worker, double step) {
    const auto error_of = at_level<block_error>(string_.model.level);
    for (std::size_t block = worker.begin; block < worker.end; ++block) {
        const std::size_t first = block * block_size;
        double sum = 0.0;
        for (std::size_t line = 0; line < Table<StrandRow>::lines; ++line) {
            std::array<const double*, 7> k{};
            for (std::size_t i = 0; i < stages; ++i)
                k[i] = worker.rate[i]->line(line) + first;
            sum += error_of(k, worker.rod->line(line) + first, step, tolerances_);
        }
        block_error_[block] = sum;
    }
    barrier_.wait();
    double sum = 0.0;
    for (const double part : block_error_)
        sum += part;
    return sum;
}

/// The stage at hand becomes the state; springs and arcs follow; energy is accounted for.
void DormandPrince::accept(Worker& worker, double step) {
    for (std::size_t block = worker.begin; block < worker.end; ++block) {
        state_.accounts.outflow[block] -=
            step * mean_over_stages([&](std::size_t i) { return power_[i].surroundings[block]; });
    }
    // Only the owner of an end reads its powers: it also overwrites the first for the next step.
    if (owns_head(worker)) {
        state_.head.work += step * mean_over_stages([&](std::size_t i) { return power_[i].head; });
        power_[0].head = power_.back().head;
    }
    if (owns_bit(worker)) {
        state_.bit.work += step * mean_over_stages([&](std::size_t i) { return power_[i].bit; });
        power_[0].bit = power_.back().bit;
    }

    for (std::size_t block = worker.begin; block < worker.end; ++block) {
        if (string_.model.features.fluid_mass ||
            string_.model.surroundings.changes(state_.wall, block))
            follow_surroundings(worker, block, step);
        count_events(string_, state_, block);
        power_[0].surroundings[block] = work_.power[block];
    }
    if (string_.head.keeps_pose()) {
        worker.head = worker.trial_head;
        worker.head.quaternion.normalize();
    }
    std::swap(worker.rod, worker.trial);
    std::swap(worker.rate.front(), worker.rate.back());
    std::swap(worker.head_rate.front(), worker.head_rate.back());
}

/// Springs, arcs and the fluid that moves along follow the nodes of one block. They act on their
/// own node only: the last stage is brought up to date in place and serves as the first one of the
/// next step. (The velocities in its segments' rates are those before the fluid followed, by a ten
/// thousandth of its mass.)
void DormandPrince::follow_surroundings(Worker& worker, std::size_t block, double step) {
    const Surroundings& surroundings = string_.model.surroundings;
    surroundings.advance_springs(state_.wall, step, block);
    const auto position = [&](std::size_t node) {
        return node_pose(work_, worker.block_start, node).position;
    };
    surroundings.refresh_arcs(state_.wall, {block, block + 1}, position);
    if (string_.model.features.fluid_mass)
        surroundings.refresh_fluid_mass(state_.wall, {block, block + 1}, position);
    Table<StrandRow>& rate = *worker.rate.back();
    node_pass(string_.model, *worker.trial, rate, work_, worker.block_start, state_.wall, block,
              block + 1);
    if (block == 0) string_.head.hold(rate);
}

bool DormandPrince::owns_bit(const Worker& worker) const {
    return worker.end == block_error_.size() && worker.begin < worker.end;
}

// ------------------------------------------------------------------ what others may know

SeriesRecord DormandPrince::series() const {
    return series_record(string_, state_);
}

Profile DormandPrince::profile() const {
    return profile_record(string_, state_);
}

BendingRecord DormandPrince::bending() const {
    return bending_record(string_, state_);
}

std::vector<SensorRecord> DormandPrince::sense(const std::vector<SensorCase>& sensors) const {
    return sensor_records(string_, state_, sensors);
}

SavedState DormandPrince::save() const {
    return drillstrand::save(state_);
}

void DormandPrince::restore(const SavedState& saved) {
    StrandState restored = state_;
    drillstrand::restore(restored, saved);
    derive(string_, restored);
    state_ = std::move(restored);
}

std::string DormandPrince::describe_failure() const {
    // the block whose error is largest, or not a number
    std::size_t worst = 0;
    for (std::size_t block = 0; block < block_error_.size(); ++block) {
        if (!(block_error_[block] <= block_error_[worst])) worst = block;
        if (!std::isfinite(block_error_[worst])) break;
    }
    const std::vector<double>& s = string_.scene.mesh.node_s;
    const std::size_t node = std::min(worst * block_size, string_.model.segments);
    const std::size_t last = std::min(node + block_size - 1, string_.model.segments);
    return fmt::format(
        "the step fell below {:g} s at t = {:.6f} s; the error is largest between nodes {} and {}, "
        "{:.1f} to {:.1f} m along the string",
        least_step, state_.clock.time, node, last, s[node], s[last]);
}

}  // namespace drillstrand
