#include "integrators/dormand_prince.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "drillstrand/error.hpp"
#include "forces/bit.hpp"
#include "forces/well_frame.hpp"
#include "numerics/kernel.hpp"

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
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = 0; i < block_size; ++i) {
        const double error = step * (e[0] * k[0][i] + e[2] * k[2][i] + e[3] * k[3][i] +
                                     e[4] * k[4][i] + e[5] * k[5][i] + e[6] * k[6][i]);
        sum += scaled_error_squared(error, value[i], tol);
    }
    return sum;
}

double mean_over_stages(const std::array<double, 7>& power) {
    double mean = 0.0;
    for (std::size_t i = 0; i < power.size(); ++i)
        mean += Tableau::b[i] * power[i];
    return mean;
}

std::vector<Eigen::Vector3d> initial_positions(const Scene& scene) {
    std::vector<Eigen::Vector3d> position;
    for (const Pose& pose : poses_from_strains({scene.head_frame, scene.head_position},
                                               scene.mesh.length, scene.initial_strain)) {
        position.push_back(pose.position);
    }
    return position;
}

}  // namespace

DormandPrince::DormandPrince(const Scene& scene, const Tolerances& tolerances, int threads)
    : scene_(scene),
      tolerances_(tolerances),
      model_(scene),
      surroundings_(scene, initial_positions(scene)),
      work_(static_cast<std::size_t>(scene.segments) + 1),
      barrier_(1) {
    const std::size_t nodes = static_cast<std::size_t>(scene.segments) + 1;
    const std::size_t blocks = blocks_for(nodes);
    for (BlockTable& table : states_)
        table = BlockTable(strand_rows, nodes);
    for (BlockTable& table : rates_)
        table = BlockTable(strand_rows, nodes);
    for (std::vector<double>& power : block_power_)
        power.assign(blocks, 0.0);
    block_error_.assign(blocks, 0.0);
    block_outflow_.assign(blocks, 0.0);
    block_events_.resize(blocks);

    // at rest but for the head, with the stresses of the initial strains
    for (std::size_t k = 0; k + 1 < nodes; ++k) {
        const SectionProperties& s = scene.mesh.segment[k];
        const Vector6 stress =
            stiffness_of(s).cwiseProduct(scene.initial_strain[k] - stress_free_strain(s));
        for (std::size_t i = 0; i < 6; ++i) {
            states_[0].row(moment + i)[k] = stress[static_cast<Eigen::Index>(i)];
        }
    }
    prescribe_head(states_[0], 0.0);
    head_.position = scene.head_position;
    head_.quaternion = Eigen::Quaterniond(scene.head_frame).coeffs();

    double step = 1.0;
    for (std::size_t k = 0; k < nodes; ++k) {
        const std::size_t segment = std::min(k, nodes - 2);
        step = std::min(
            step, 0.01 * std::sqrt(scene.inertia[k] / scene.mesh.segment[segment].shear_stiffness));
    }

    workers_.resize(static_cast<std::size_t>(threads));
    for (Worker& worker : workers_) {
        worker.state = &states_[0];
        worker.trial = &states_[1];
        for (std::size_t i = 0; i < stages; ++i)
            worker.rate[i] = &rates_[i];
        worker.head = head_;
        worker.block_start.resize(blocks);
        worker.step = step;
        worker.statistics.smallest_step = std::numeric_limits<double>::infinity();
    }
    state_ = &states_[0];
    if (scene.head.motion == HeadMotion::driven) initial_head_energy_ = node_kinetic_energy(0);
    // the first rates, by one worker for all: contact at time 0 is then known
    share_blocks(workers_.front(), 0, 1);
    evaluate(workers_.front(), 0, 0.0, states_[0], head_);
    for (Worker& worker : workers_) {
        worker.head_rate = workers_.front().head_rate;
        worker.statistics = workers_.front().statistics;
    }
    for (std::size_t block = 0; block < blocks; ++block)
        count_events(block);
    const std::vector<Pose> pose = poses();
    initial_potential_ = potential_energy(pose);
    for (std::size_t k = 0; k < nodes; ++k) {
        initial_spring_energy_ +=
            scene.mesh.cell[k] * surroundings_.contact(k, pose[k].position).spring_energy;
    }
}

void DormandPrince::advance(double end, std::int64_t max_steps) {
#pragma omp parallel num_threads(static_cast <int>(workers_.size()))
    {
        // the team may be smaller than asked for
        const auto threads = static_cast<std::size_t>(omp_get_num_threads());
#pragma omp single
        barrier_.set_threads(static_cast<int>(threads));
        const auto thread = static_cast<std::size_t>(omp_get_thread_num());
        share_blocks(workers_[thread], thread, threads);
        run(workers_[thread], end, max_steps);
    }
    const Worker& first = workers_.front();
    for (Worker& worker : workers_) {
        const std::vector<Pose> kept = std::move(worker.block_start);
        worker = first;
        worker.block_start = kept;
    }
    state_ = first.state;
    head_ = first.head;
    time_ = first.time;
    statistics_ = first.statistics;
    if (first.underflow) throw SimulationError(describe_failure());
}

void DormandPrince::share_blocks(Worker& worker, std::size_t thread, std::size_t threads) const {
    const std::size_t blocks = block_error_.size();
    worker.begin = blocks * thread / threads;
    worker.end = blocks * (thread + 1) / threads;
}

/// The time loop.
void DormandPrince::run(Worker& worker, double end, std::int64_t max_steps) {
    const std::size_t entries = 12 * model_.segments;
    const std::int64_t last = worker.statistics.steps + max_steps;
    barrier_.wait();
    while (worker.time < end && worker.statistics.steps < last) {
        // the step, cut to meet the end exactly, in two equal parts rather than in a long and a
        // short one
        const double left = end - worker.time;
        const double step = left <= worker.step      ? left
                            : left < 2 * worker.step ? left / 2
                                                     : worker.step;
        for (std::size_t stage = 1; stage < stages; ++stage) {
            combine(worker, stage, step);
            barrier_.wait();
            evaluate(worker, stage, worker.time + Tableau::c[stage] * step, *worker.trial,
                     worker.trial_head);
        }
        const double error = error_norm(error_estimate(worker, step), entries);
        const double next = step * step_factor(error);
        const bool cut = step < worker.step;
        if (error < 1.0) {
            accept(worker, step);
            worker.time = step == left ? end : worker.time + step;
            worker.step = cut ? std::max(worker.step, next) : next;
            ++worker.statistics.steps;
            if (!cut) {
                worker.statistics.smallest_step = std::min(worker.statistics.smallest_step, step);
                worker.statistics.largest_step = std::max(worker.statistics.largest_step, step);
            }
            if (owns_head(worker)) last_step_ = step;
        } else {
            worker.step = next;
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
    for (std::size_t row = 0; row < strand_rows; ++row) {
        std::array<const double*, 7> k{};
        for (std::size_t i = 0; i < stages; ++i)
            k[i] = worker.rate[i]->row(row) + first;
        stage_state(stage, worker.trial->row(row) + first, worker.state->row(row) + first, k, step,
                    count);
    }
    if (scene_.head.motion == HeadMotion::driven) {
        if (owns_head(worker)) {
            prescribe_head(*worker.trial, worker.time + Tableau::c[stage] * step);
        }
        return;
    }
    worker.trial_head = worker.head;
    for (std::size_t i = 0; i < stage; ++i) {
        const double weight = step * Tableau::a[stage][i];
        worker.trial_head.position += weight * worker.head_rate[i].position;
        worker.trial_head.quaternion += weight * worker.head_rate[i].quaternion;
    }
}

/// Rates of this worker's blocks. Every worker's part of `state` must be complete.
void DormandPrince::evaluate(Worker& worker, std::size_t stage, double time,
                             const BlockTable& state, const HeadPose& head) {
    BlockTable& rate = *worker.rate[stage];
    segment_pass(model_, state, rate, work_, worker.begin, worker.end);
    if (scene_.head.motion == HeadMotion::free) {
        const Vector6 v = velocity(state, 0);
        const Eigen::Quaterniond q(head.quaternion);
        const Eigen::Quaterniond spin(0, v[0], v[1], v[2]);
        worker.head_rate[stage] = {head.pose().frame * v.tail<3>(), 0.5 * (q * spin).coeffs()};
    }
    barrier_.wait();
    chain_blocks(head_pose(head, time), work_, worker.block_start, worker.end);
    load_ends(worker, stage, time, state);
    node_pass(model_, state, rate, work_, worker.block_start, surroundings_, worker.begin,
              worker.end);
    std::copy_n(work_.power.begin() + static_cast<std::ptrdiff_t>(worker.begin),
                worker.end - worker.begin,
                block_power_[stage].begin() + static_cast<std::ptrdiff_t>(worker.begin));
    if (owns_head(worker) && scene_.head.motion == HeadMotion::driven) {
        for (std::size_t row = 0; row < 6; ++row)
            rate.row(row)[0] = 0.0;
    }
    ++worker.statistics.evaluations;
}

/// Wrenches of head and bit on the rod, and their power.
void DormandPrince::load_ends(const Worker& worker, std::size_t stage, double time,
                              const BlockTable& state) {
    if (owns_head(worker)) {
        Vector6 on_rod;
        if (scene_.head.motion == HeadMotion::free) {
            const Eigen::Matrix3d to_body = worker.block_start[0].frame.transpose();
            on_rod << to_body * scene_.head.moment(time), to_body * scene_.head.force(time);
            set_head_wrench(work_, -on_rod);
        } else {
            // what keeps the head on its course is what the first segment pulls it with
            for (std::size_t i = 0; i < 6; ++i) {
                on_rod[static_cast<Eigen::Index>(i)] =
                    -work_.table.row(StrandWorkspace::wrench_on_first + i)[0];
            }
        }
        head_power_[stage] = on_rod.dot(velocity(state, 0));
    }
    if (owns_bit(worker)) {
        const std::size_t node = model_.segments;
        const Pose pose = node_pose(work_, worker.block_start, node);
        const Vector6 v = velocity(state, node);
        BitMotion motion;
        motion.frame = pose.frame;
        motion.well_direction =
            surroundings_.empty()
                ? Eigen::Vector3d(pose.frame.col(0))
                : vector(well_frame(triple(pose.position), surroundings_.arc_numbers(node)).l);
        motion.rotation_rate =
            scene_.head.motion == HeadMotion::driven ? scene_.head.rotation(time) : v[0];
        motion.radius = scene_.mesh.node.back().outer_radius;
        const Vector6 stress = bit_stress(scene_.bit, motion, time);
        set_bit_wrench(work_, node, stress);
        bit_power_[stage] = stress.dot(v);
    }
}

/// Sum over all entries of the squares of the scaled errors.
double DormandPrince::error_estimate(const Worker& worker, double step) {
    for (std::size_t block = worker.begin; block < worker.end; ++block) {
        const std::size_t first = block * block_size;
        double sum = 0.0;
        for (std::size_t row = 0; row < strand_rows; ++row) {
            std::array<const double*, 7> k{};
            for (std::size_t i = 0; i < stages; ++i)
                k[i] = worker.rate[i]->row(row) + first;
            sum += block_error(k, worker.state->row(row) + first, step, tolerances_);
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
        double power = 0.0;
        for (std::size_t i = 0; i < stages; ++i)
            power += Tableau::b[i] * block_power_[i][block];
        block_outflow_[block] -= step * power;
    }
    // Only the owner of an end reads its powers: it also overwrites the first for the next step.
    if (owns_head(worker)) {
        head_work_ += step * mean_over_stages(head_power_);
        head_power_[0] = head_power_.back();
    }
    if (owns_bit(worker)) {
        bit_work_ += step * mean_over_stages(bit_power_);
        bit_power_[0] = bit_power_.back();
    }

    for (std::size_t block = worker.begin; block < worker.end; ++block) {
        if (surroundings_.changes(block)) follow_surroundings(worker, block, step);
        count_events(block);
    }
    for (std::size_t block = worker.begin; block < worker.end; ++block) {
        block_power_[0][block] = work_.power[block];
    }
    if (scene_.head.motion == HeadMotion::free) {
        worker.head = worker.trial_head;
        worker.head.quaternion.normalize();
    }
    std::swap(worker.state, worker.trial);
    std::swap(worker.rate.front(), worker.rate.back());
    std::swap(worker.head_rate.front(), worker.head_rate.back());
}

/// Springs and arcs of one block follow its nodes. They act on their own node only: the last stage
/// is brought up to date in place and serves as the first one of the next step.
void DormandPrince::follow_surroundings(Worker& worker, std::size_t block, double step) {
    surroundings_.advance_springs(step, block);
    surroundings_.refresh_arcs({block, block + 1}, [&](std::size_t node) {
        return node_pose(work_, worker.block_start, node).position;
    });
    BlockTable& rate = *worker.rate.back();
    node_pass(model_, *worker.trial, rate, work_, worker.block_start, surroundings_, block,
              block + 1);
    if (block == 0) hold_head(rate);
}

void DormandPrince::count_events(std::size_t block) {
    if (surroundings_.empty()) return;
    ContactEvents& events = block_events_[block];
    const double* depth = surroundings_.row(Surroundings::depth) + block * block_size;
    const double* sliding = surroundings_.row(Surroundings::sliding) + block * block_size;
    for (std::size_t k = 0; k < block_size; ++k) {
        const bool touches = depth[k] > 0;
        const bool slides = sliding[k] > 0;
        events.impacts += touches && !events.touches[k] ? 1 : 0;
        events.slips += slides && !events.slides[k] ? 1 : 0;
        events.touches[k] = touches;
        events.slides[k] = slides;
    }
}

bool DormandPrince::owns_bit(const Worker& worker) const {
    return worker.end == block_error_.size() && worker.begin < worker.end;
}

Pose DormandPrince::HeadPose::pose() const {
    return {Eigen::Quaterniond(quaternion).normalized().toRotationMatrix(), position};
}

Pose DormandPrince::head_pose(const HeadPose& head, double time) const {
    if (scene_.head.motion == HeadMotion::free) return head.pose();
    const double angle = scene_.head.rotation.integral(time);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
    return {scene_.head_frame * turn, scene_.head_position};
}

/// Momentum of a driven head: it turns about d3 at the scheduled rate and does not move.
void DormandPrince::prescribe_head(BlockTable& state, double time) const {
    if (scene_.head.motion == HeadMotion::free) return;
    for (std::size_t row = 0; row < 6; ++row)
        state.row(row)[0] = 0.0;
    state.row(angular_momentum)[0] =
        scene_.mesh.node.front().polar_inertia * scene_.head.rotation(time);
}

/// A driven head has no rate of its own.
void DormandPrince::hold_head(BlockTable& rate) const {
    if (scene_.head.motion == HeadMotion::free) return;
    for (std::size_t row = 0; row < 6; ++row)
        rate.row(row)[0] = 0.0;
}

Vector6 DormandPrince::velocity(const BlockTable& state, std::size_t node) const {
    const double mass = scene_.mesh.node[node].mass;
    const double transverse = scene_.inertia[node];
    Vector6 inertia;
    inertia << scene_.mesh.node[node].polar_inertia, transverse, transverse, mass, mass, mass;
    return momentum_of(state, node).cwiseQuotient(inertia);
}

// ------------------------------------------------------------------ what the run reports

std::vector<Pose> DormandPrince::poses() const {
    std::vector<Vector6> strain(model_.segments);
    for (std::size_t k = 0; k < model_.segments; ++k) {
        const SectionProperties& s = scene_.mesh.segment[k];
        strain[k] = stress_of(*state_, k).cwiseQuotient(stiffness_of(s)) + stress_free_strain(s);
    }
    return poses_from_strains(head_pose(head_, time_), scene_.mesh.length, strain);
}

double DormandPrince::node_kinetic_energy(std::size_t node) const {
    return 0.5 * scene_.mesh.cell[node] * momentum_of(*state_, node).dot(velocity(*state_, node));
}

double DormandPrince::potential_energy(const std::vector<Pose>& poses) const {
    double sum = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
        sum -= scene_.mesh.cell[k] * scene_.weight[k] * scene_.down.dot(poses[k].position);
    }
    return sum;
}

EnergyAccount DormandPrince::energy(const std::vector<Pose>& poses, double spring_energy) const {
    EnergyAccount account;
    for (std::size_t k = 0; k < poses.size(); ++k)
        account.kinetic += node_kinetic_energy(k);
    for (std::size_t k = 0; k < model_.segments; ++k) {
        const Vector6 stress = stress_of(*state_, k);
        account.elastic += 0.5 * scene_.mesh.length[k] *
                           stress.dot(stress.cwiseQuotient(stiffness_of(scene_.mesh.segment[k])));
    }
    account.elastic += spring_energy;
    account.potential = potential_energy(poses) - initial_potential_;
    account.work = head_work_ + bit_work_;
    if (scene_.head.motion == HeadMotion::driven) {
        account.work += node_kinetic_energy(0) - initial_head_energy_;
    }
    // what the surroundings took and the contact springs do not hold is gone
    account.dissipation = initial_spring_energy_ - spring_energy;
    for (const double outflow : block_outflow_)
        account.dissipation += outflow;
    return account;
}

SeriesRecord DormandPrince::series() const {
    SeriesRecord record;
    const std::vector<Pose> pose = poses();
    const std::size_t last = model_.segments;
    double spring_energy = 0;
    for (std::size_t k = 0; k <= last; ++k) {
        const NodeContact c = surroundings_.contact(k, pose[k].position);
        if (c.penetration <= 0) continue;
        ++record.contact_nodes;
        record.max_penetration = std::max(record.max_penetration, c.penetration);
        spring_energy += scene_.mesh.cell[k] * c.spring_energy;
    }
    for (const ContactEvents& events : block_events_) {
        record.impacts += events.impacts;
        record.slips += events.slips;
    }
    // who came and is not there has left
    record.contact_changes = 2 * record.impacts - record.contact_nodes;
    record.time = time_;
    record.head_stress = stress_of(*state_, 0);
    record.bit_stress = stress_of(*state_, last - 1);
    record.head_position = pose.front().position;
    record.bit_position = pose.back().position;
    record.head_rotation_rate = velocity(*state_, 0)[0];
    record.bit_rotation_rate = velocity(*state_, last)[0];
    record.energy = energy(pose, spring_energy);
    record.step_size = last_step_;
    return record;
}

Profile DormandPrince::profile() const {
    Profile profile;
    const std::vector<Pose> pose = poses();
    profile.time = time_;
    for (std::size_t k = 0; k < pose.size(); ++k) {
        profile.position.push_back(pose[k].position);
        profile.director.emplace_back(pose[k].frame.col(0));
        profile.momentum.push_back(momentum_of(*state_, k));
        const NodeContact c = surroundings_.contact(k, pose[k].position);
        profile.eccentricity.push_back(c.eccentricity);
        profile.well_depth.push_back(c.well_depth);
        profile.contact_force.push_back(c.force);
        profile.normal_force.push_back(std::max(c.normal_force, 0.0));
    }
    for (std::size_t k = 0; k < model_.segments; ++k) {
        profile.stress.push_back(stress_of(*state_, k));
    }
    return profile;
}

std::string DormandPrince::describe_failure() const {
    // the block whose error is largest, or not a number
    std::size_t worst = 0;
    for (std::size_t block = 0; block < block_error_.size(); ++block) {
        if (!(block_error_[block] <= block_error_[worst])) worst = block;
        if (!std::isfinite(block_error_[worst])) break;
    }
    const std::size_t node = std::min(worst * block_size, model_.segments);
    const std::size_t last = std::min(node + block_size - 1, model_.segments);
    return fmt::format(
        "the step fell below {:g} s at t = {:.6f} s; the error is largest between nodes {} and {}, "
        "{:.1f} to {:.1f} m along the string",
        least_step, time_, node, last, scene_.mesh.node_s[node], scene_.mesh.node_s[last]);
}

}  // namespace drillstrand
