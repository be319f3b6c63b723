#include "integrators/leapfrog.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "drillstrand/error.hpp"
#include "drillstrand/step_bound.hpp"
#include "forces/bit.hpp"
#include "forces/well_frame.hpp"
#include "rod/strand.hpp"

namespace drillstrand {

namespace {

Eigen::Vector3d read(const BlockTable& table, std::size_t row, std::size_t k) {
    return {table.row(row)[k], table.row(row + 1)[k], table.row(row + 2)[k]};
}

void write(BlockTable& table, std::size_t row, std::ptrdiff_t k, const Eigen::Vector3d& v) {
    for (std::size_t i = 0; i < 3; ++i)
        table.row(row + i)[k] = v[static_cast<Eigen::Index>(i)];
}

constexpr std::int64_t steps_between_guards = 16;
constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();

double wall_time() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Force and couple of the outside on an end of the rod, as the segment beyond it would exert them.
void write_end_load(BlockTable& segments, std::ptrdiff_t ghost, const Eigen::Vector3d& pull,
                    const Eigen::Vector3d& couple, const Eigen::Vector3d& director) {
    write(segments, SegmentRow::pull, ghost, pull);
    write(segments, SegmentRow::couple, ghost, couple);
    segments.row(SegmentRow::torque)[ghost] = couple.dot(director);
    segments.row(SegmentRow::viscous_torque)[ghost] = 0.0;
    for (const std::size_t row :
         {SegmentRow::lean, SegmentRow::first_couple, SegmentRow::last_couple,
          SegmentRow::viscous_pull, SegmentRow::viscous_couple, SegmentRow::viscous_lean,
          SegmentRow::drag_force, SegmentRow::drag_couple})
        write(segments, row, ghost, Eigen::Vector3d::Zero());
}

}  // namespace

Leapfrog::Leapfrog(const Scene& scene, double cfl, double tolerance, double stress_limit,
                   int threads)
    : scene_(scene),
      model_(scene),
      guards_(scene, model_, stress_limit),
      surroundings_(scene, scene.initial_nodes.position),
      bound_(cfl * step_bound(scene, IntegratorKind::leapfrog).step),
      time_error_(tolerance, negligible_energy(scene)),
      blocks_(blocks_for(model_.segments + 1)),
      spans_(equal_spans(blocks_)),
      span_outflow_(spans_.size(), 0.0),
      team_(std::min(threads, static_cast<int>(spans_.size()))) {
    const std::size_t nodes = model_.segments + 1;
    for (BlockTable& state : states_) {
        state = BlockTable(director_rows, nodes);
        // padding: directors that differ from none
        state.fill(director, 1.0);
        state.fill(last_director, 1.0);
    }
    BlockTable& state = states_[0];
    const InitialNodes& initial = scene.initial_nodes;
    for (std::size_t k = 0; k < nodes; ++k) {
        const auto entry = static_cast<std::ptrdiff_t>(k);
        write(state, position, entry, initial.position[k]);
        write(state, director, entry, initial.director[k]);
        write(state, last_director, entry, initial.director[k]);
    }
    head_frame_.d1 = scene.head_frame.col(1);
    state.row(spin)[0] = scene.head.motion == HeadMotion::driven ? scene.head.rotation(0.0) : 0.0;

    workers_.resize(static_cast<std::size_t>(team_.members()));
    for (Worker& worker : workers_) {
        worker.segments = BlockTable(SegmentRow::rows, nodes);
        std::copy(initial.twist.begin(), initial.twist.end(),
                  worker.segments.row(SegmentRow::twist));
    }
    const std::vector<Eigen::Matrix3d> frame = material_frames(state, workers_[0].segments);
    for (std::size_t k = 0; k < nodes; ++k)
        write(state, material, static_cast<std::ptrdiff_t>(k), frame[k].col(1));
    bit_frame_.d1 = frame.back().col(1);
    finish_bit(workers_[0].segments, state, state, {});

    statistics_.smallest_step = std::numeric_limits<double>::infinity();
    if (scene.head.motion == HeadMotion::driven)
        initial_head_energy_ = node_kinetic_energy(state, 0);
    initial_potential_ = potential_energy(state);
    for (std::size_t k = 0; k < nodes; ++k) {
        initial_spring_energy_ +=
            scene.mesh.cell[k] * surroundings_.contact(k, initial.position[k]).spring_energy;
    }
}

void Leapfrog::advance(double end, std::int64_t max_steps) {
    const std::int64_t last =
        max_steps < no_limit - statistics_.steps ? statistics_.steps + max_steps : no_limit;
    while (time_ < end && statistics_.steps < last) {
        while (statistics_.steps == time_error_.due())
            sample_time_error();
        if (end != course_.end) {
            const double longest = bound_ * time_error_.step_factor();
            const double wanted = std::ceil((end - time_) / longest * (1 - 1e-12));
            course_ = {time_, end, static_cast<std::int64_t>(std::max(wanted, 1.0)), 0};
        }
        take(std::min({course_.steps - course_.done, last - statistics_.steps,
                       time_error_.due() - statistics_.steps, team_.longest_piece(wall_time())}));
    }
}

/// Advances by steps of the present course; by fewer where the team parts before.
void Leapfrog::take(std::int64_t steps) {
    const double dt = course_.step();
    const double start = wall_time();
    const double waited_before = meeting_.barrier.waited();
    meeting_.last_step = steps - 1;
    int threads = team_.size(start);
#pragma omp parallel num_threads(threads)
    {
        // the team may be smaller than asked for
#pragma omp single
        {
            threads = omp_get_num_threads();
            meeting_.barrier.set_threads(threads);
            meeting_.start = start;
            meeting_.waited_before = waited_before;
        }
        run(static_cast<std::size_t>(omp_get_thread_num()), static_cast<std::size_t>(threads), dt);
    }
    if (threads > 1) team_.worked(start, wall_time(), meeting_.barrier.waited() - waited_before);
    share_twist(static_cast<std::size_t>(threads));
    if (meeting_.fault_step != Meeting::no_fault) fail();
    const std::int64_t done = meeting_.last_step + 1;
    current_ = (current_ + static_cast<std::size_t>(done)) % 2;
    course_.done += done;
    time_ = course_.time(course_.done);
    last_drift_ = dt;
    statistics_.steps += done;
    statistics_.evaluations += done;
    statistics_.smallest_step = std::min(statistics_.smallest_step, dt);
    statistics_.largest_step = std::max(statistics_.largest_step, dt);
}

/// Twist is state: every worker gets all of it from those that have worked.
void Leapfrog::share_twist(std::size_t threads) {
    double* whole = workers_.front().segments.row(SegmentRow::twist);
    for (std::size_t i = 1; i < threads; ++i) {
        const Worker& worker = workers_[i];
        const double* own = worker.segments.row(SegmentRow::twist);
        std::copy(own + worker.begin * block_size, own + worker.end * block_size,
                  whole + worker.begin * block_size);
    }
    for (std::size_t i = 1; i < workers_.size(); ++i) {
        std::copy(whole, whole + blocks_ * block_size, workers_[i].segments.row(SegmentRow::twist));
    }
}

/// Repeats the steps to come from here, in the steps of the run and in halves of them. A window in
/// which a guard stops the run is no sample: the run itself will tell.
void Leapfrog::sample_time_error() {
    const double factor = time_error_.step_factor();
    const double step = bound_ * factor;
    Leapfrog coarse(*this);
    coarse.start_again();
    Leapfrog fine(coarse);
    coarse.bound_ = step;
    fine.bound_ = 0.5 * step;
    const double end = time_ + static_cast<double>(TimeErrorControl::window) * step;
    try {
        for (Leapfrog* twin : {&coarse, &fine})
            twin->advance(end, 2 * TimeErrorControl::window);
    } catch (const SimulationError&) {
        time_error_.skip(statistics_.steps);
        return;
    }
    const Profile after = fine.profile();
    time_error_.add(statistics_.steps, time_, rod_energy(scene_, after),
                    rod_energy_between(scene_, coarse.profile(), after));
    // a new step is taken at once
    if (time_error_.step_factor() != factor) course_ = {};
}

/// As if the run began here: velocities of the whole step, no samples.
void Leapfrog::start_again() {
    Snapshot at = snapshot();
    finish_bit(at.segments, states_[current_], at.state, {});
    states_[current_] = std::move(at.state);
    surroundings_ = std::move(at.surroundings);
    for (Worker& worker : workers_)
        worker.segments = at.segments;
    last_drift_ = 0;
    course_ = {};
    time_error_.stop();
}

/// The time loop: one barrier a step.
void Leapfrog::run(std::size_t thread, std::size_t threads, double dt) {
    Worker& worker = workers_[thread];
    worker.first_span = spans_.size() * thread / threads;
    worker.end_span = spans_.size() * (thread + 1) / threads;
    worker.begin = spans_[worker.first_span].begin;
    worker.end = spans_[worker.end_span - 1].end;
    meeting_.barrier.wait();
    std::size_t current = current_;
    Step step{time_, last_drift_, dt, 0.5 * (last_drift_ + dt)};
    for (std::int64_t i = 0;; ++i) {
        bool sound =
            step_spans(worker, surroundings_, states_[current], states_[1 - current], step);
        if ((statistics_.steps + i) % steps_between_guards == 0)
            sound = keep_guard(worker, states_[current], step.time) && sound;
        if (!sound) meeting_.fault_step.store(i, std::memory_order_relaxed);
        if (thread == 0 && team_should_part() && i < meeting_.last_step) meeting_.last_step = i;
        meeting_.barrier.wait();
        if (meeting_.fault_step.load(std::memory_order_relaxed) <= i) break;
        if (meeting_.last_step.load(std::memory_order_relaxed) <= i) break;
        current = 1 - current;
        step.time = course_.time(course_.done + i + 1);
        step.last_drift = dt;
        step.kick = dt;
    }
    meeting_.barrier.wait();
}

/// Whether the members of the team wait for each other longer than their help is worth.
bool Leapfrog::team_should_part() const {
    const double waited = meeting_.barrier.waited() - meeting_.waited_before;
    return waited > 0 && team_.waits_too_long(meeting_.start, wall_time(), waited);
}

/// One step of a worker's spans: forces at the whole step, velocities and poses to the next.
/// Whether all velocities are numbers.
bool Leapfrog::step_spans(Worker& worker, Surroundings& surroundings, const BlockTable& state,
                          BlockTable& next, const Step& step) {
    BlockTable& segments = worker.segments;
    bool sound = true;
    if (worker.begin > 0)
        director_segments(model_, state, segments, {worker.begin - 1, worker.begin},
                          step.last_drift);
    if (worker.begin == 0) load_head(segments, state, step.time);
    for (std::size_t i = worker.first_span; i < worker.end_span; ++i) {
        const BlockSpan span = spans_[i];
        director_segments(model_, state, segments, span, step.last_drift);
        if (span.end == blocks_) load_bit(segments, state, step.time);
        const NodeStep done = director_nodes(model_, state, next, segments, surroundings, span,
                                             step.kick, step.drift);
        span_outflow_[i] += done.outflow;
        worker.impacts += done.impacts;
        worker.slips += done.slips;
        if (done.leavers > 0) {
            surroundings.refresh_arcs(
                span, [&](std::size_t node) { return read(state, position, node); });
        }
        if (done.faults > 0) sound = false;
    }
    if (worker.begin == 0) finish_head(segments, state, next, step);
    if (worker.end == blocks_) finish_bit(segments, state, next, step);
    return sound;
}

/// Reads the guards of a worker's segments, whose stresses are those of `state`; false where the
/// run has to stop.
bool Leapfrog::keep_guard(Worker& worker, const BlockTable& state, double time) const {
    bool passes = true;
    for (std::size_t block = worker.begin; block < worker.end; ++block) {
        const GuardReading reading = guards_.read(state, worker.segments, block);
        guards_.follow(worker.coarsest, reading, state, worker.segments, block, time);
        if (guards_.stops(reading)) passes = false;
    }
    return passes;
}

StepStatistics Leapfrog::statistics() const {
    StepStatistics statistics = statistics_;
    statistics.time_error = time_error_.largest();
    return statistics;
}

std::vector<std::string> Leapfrog::warnings() const {
    CoarsestSegment coarsest;
    for (const Worker& worker : workers_) {
        if (worker.coarsest.coarseness > coarsest.coarseness) coarsest = worker.coarsest;
    }
    std::vector<std::string> result;
    if (const auto sentence = guards_.warn(coarsest)) result.push_back(*sentence);
    if (const auto sentence = time_error_.warning()) result.push_back(*sentence);
    return result;
}

/// What acts on a free head.
void Leapfrog::load_head(BlockTable& segments, const BlockTable& state, double time) const {
    if (scene_.head.motion == HeadMotion::driven) return;
    write_end_load(segments, -1, -scene_.head.force(time), -scene_.head.moment(time),
                   read(state, director, 0));
}

/// What acts on the bit: its stress in body axes, turned into space.
void Leapfrog::load_bit(BlockTable& segments, const BlockTable& state, double time) const {
    const std::size_t node = model_.segments;
    const Eigen::Vector3d t = read(state, director, node);
    BitMotion motion;
    motion.frame << t, bit_frame_.d1, t.cross(bit_frame_.d1);
    motion.well_direction = surroundings_.empty()
                                ? t
                                : vector(well_frame(triple(read(state, position, node)),
                                                    surroundings_.arc_numbers(node))
                                             .l);
    motion.rotation_rate = scene_.head.motion == HeadMotion::driven ? scene_.head.rotation(time)
                                                                    : state.row(spin)[node];
    motion.radius = scene_.mesh.node.back().outer_radius;
    const Vector6 stress = bit_stress(scene_.bit, motion, time);
    write_end_load(segments, static_cast<std::ptrdiff_t>(node), motion.frame * stress.tail<3>(),
                   motion.frame * stress.head<3>(), t);
}

/// A driven head keeps its place and turns as scheduled; the work of what turns it.
void Leapfrog::finish_head(const BlockTable& segments, const BlockTable& state, BlockTable& next,
                           const Step& step) {
    const Eigen::Vector3d t = read(state, director, 0);
    const auto mean = [&](std::size_t row) {
        return Eigen::Vector3d(0.5 * (read(state, row, 0) + read(next, row, 0)));
    };
    if (scene_.head.motion == HeadMotion::free) {
        const Eigen::Vector3d turning = mean(angular_velocity);
        head_work_ += step.kick * (scene_.head.force(step.time).dot(mean(velocity)) +
                                   scene_.head.moment(step.time).dot(turning) +
                                   scene_.head.moment(step.time).dot(t) * 0.5 *
                                       (state.row(spin)[0] + next.row(spin)[0]));
        head_frame_.follow(t, read(next, director, 0), step.drift * next.row(spin)[0]);
        return;
    }
    const double rate = step.drift > 0 ? (scene_.head.rotation.integral(step.time + step.drift) -
                                          scene_.head.rotation.integral(step.time)) /
                                             step.drift
                                       : scene_.head.rotation(step.time);
    write(next, position, 0, read(state, position, 0));
    write(next, velocity, 0, Eigen::Vector3d::Zero());
    write(next, director, 0, t);
    write(next, angular_velocity, 0, Eigen::Vector3d::Zero());
    write(next, material, 0, head_d1(step.time + step.drift));
    next.row(spin)[0] = rate;
    head_work_ -=
        step.kick * segments.row(SegmentRow::torque)[0] * 0.5 * (state.row(spin)[0] + rate);
}

/// The work at the bit, its frame, and the padding node beyond it, which goes along so that the
/// ghost segment stays without strain.
void Leapfrog::finish_bit(const BlockTable& segments, const BlockTable& state, BlockTable& next,
                          const Step& step) {
    const std::size_t node = model_.segments;
    const auto mean = [&](std::size_t row) {
        return Eigen::Vector3d(0.5 * (read(state, row, node) + read(next, row, node)));
    };
    bit_work_ += step.kick * (read(segments, SegmentRow::pull, node).dot(mean(velocity)) +
                              read(segments, SegmentRow::couple, node).dot(mean(angular_velocity)) +
                              segments.row(SegmentRow::torque)[node] * 0.5 *
                                  (state.row(spin)[node] + next.row(spin)[node]));
    const Eigen::Vector3d t = read(next, director, node);
    bit_frame_.follow(read(state, director, node), t, step.drift * next.row(spin)[node]);
    const auto beyond = static_cast<std::ptrdiff_t>(node) + 1;
    write(next, position, beyond, read(next, position, node));
    write(next, director, beyond, t);
    write(next, last_director, beyond, t);
}

void Leapfrog::EndFrame::follow(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                double angle) {
    const Eigen::Vector3d along = carried(d1, from, to);
    d1 = (std::cos(angle) * along + std::sin(angle) * to.cross(along)).normalized();
}

Eigen::Vector3d Leapfrog::head_d1(double time) const {
    if (scene_.head.motion == HeadMotion::free) return head_frame_.d1;
    const double angle = scene_.head.rotation.integral(time);
    return std::cos(angle) * scene_.head_frame.col(1) + std::sin(angle) * scene_.head_frame.col(2);
}

// ------------------------------------------------------------------ what the run reports

/// Frames of the nodes: from the head's d1 by the shortest turn from director to director, and by
/// the twist of the segment.
std::vector<Eigen::Matrix3d> Leapfrog::material_frames(const BlockTable& state,
                                                       const BlockTable& segments) const {
    std::vector<Eigen::Matrix3d> frames;
    EndFrame along{head_d1(time_)};
    Eigen::Vector3d t = read(state, director, 0);
    for (std::size_t k = 0; k <= model_.segments; ++k) {
        if (k > 0) {
            const Eigen::Vector3d to = read(state, director, k);
            along.follow(t, to, scene_.mesh.length[k - 1] * segments.row(SegmentRow::twist)[k - 1]);
            t = to;
        }
        Eigen::Matrix3d frame;
        frame << t, along.d1, t.cross(along.d1);
        frames.push_back(frame);
    }
    return frames;
}

/// Stress of a segment in the axes of its middle: strains of chord, directors and twist, times
/// stiffness.
Vector6 Leapfrog::stress(std::size_t k, const BlockTable& state, const BlockTable& segments,
                         const Eigen::Matrix3d& first, const Eigen::Matrix3d& last) const {
    const double h = scene_.mesh.length[k];
    const Eigen::Vector3d chord = (read(state, position, k + 1) - read(state, position, k)) / h;
    const Eigen::Vector3d ta = read(state, director, k);
    const Eigen::Vector3d tb = read(state, director, k + 1);
    const Eigen::Vector3d mean = (ta + tb).normalized();
    const Eigen::Vector3d axis = ta.cross(tb);
    const double sine = axis.norm();
    const double angle = std::atan2(sine, ta.dot(tb));
    const Eigen::Vector3d bend = sine > 0 ? Eigen::Vector3d(axis * (angle / sine / h))
                                          : Eigen::Vector3d(Eigen::Vector3d::Zero());
    const Eigen::Vector3d d1 = 0.5 * (first.col(1) + last.col(1));
    const Eigen::Vector3d d2 = 0.5 * (first.col(2) + last.col(2));
    Vector6 strain;
    strain << segments.row(SegmentRow::twist)[k], bend.dot(d1), bend.dot(d2), chord.dot(mean),
        chord.dot(d1 - d1.dot(mean) * mean), chord.dot(d2 - d2.dot(mean) * mean);
    const SectionProperties& section = scene_.mesh.segment[k];
    return stiffness_of(section).cwiseProduct(strain - stress_free_strain(section));
}

/// The state at the whole step: half a kick on copies, and no drift.
Leapfrog::Snapshot Leapfrog::snapshot() const {
    const BlockTable& state = states_[current_];
    Snapshot at{state, workers_.front().segments, surroundings_, {}, {}, 0, 0};
    for (const BlockSpan span : spans_)
        director_segments(model_, state, at.segments, span, last_drift_);
    load_head(at.segments, state, time_);
    load_bit(at.segments, state, time_);
    for (const BlockSpan span : spans_) {
        const NodeStep done = director_nodes(model_, state, at.state, at.segments, at.surroundings,
                                             span, 0.5 * last_drift_, 0.0);
        at.impacts += done.impacts;
        at.slips += done.slips;
    }
    if (scene_.head.motion == HeadMotion::driven) {
        write(at.state, velocity, 0, Eigen::Vector3d::Zero());
        write(at.state, angular_velocity, 0, Eigen::Vector3d::Zero());
        at.state.row(spin)[0] = scene_.head.rotation(time_);
    }
    at.frame = material_frames(at.state, at.segments);
    for (std::size_t k = 0; k < model_.segments; ++k)
        at.stress.push_back(stress(k, at.state, at.segments, at.frame[k], at.frame[k + 1]));
    return at;
}

double Leapfrog::node_kinetic_energy(const BlockTable& state, std::size_t node) const {
    const double s = state.row(spin)[node];
    return 0.5 * scene_.mesh.cell[node] *
           (scene_.mesh.node[node].mass * read(state, velocity, node).squaredNorm() +
            scene_.inertia[node] * read(state, angular_velocity, node).squaredNorm() +
            scene_.mesh.node[node].polar_inertia * s * s);
}

double Leapfrog::potential_energy(const BlockTable& state) const {
    double sum = 0;
    for (std::size_t k = 0; k <= model_.segments; ++k)
        sum -= scene_.mesh.cell[k] * scene_.weight[k] * scene_.down.dot(read(state, position, k));
    return sum;
}

double Leapfrog::elastic_energy(const std::vector<Vector6>& stress) const {
    double sum = 0;
    for (std::size_t k = 0; k < stress.size(); ++k) {
        sum += 0.5 * scene_.mesh.length[k] *
               stress[k].dot(stress[k].cwiseQuotient(stiffness_of(scene_.mesh.segment[k])));
    }
    return sum;
}

SeriesRecord Leapfrog::series() const {
    const Snapshot at = snapshot();
    const std::size_t last = model_.segments;
    SeriesRecord record;
    EnergyAccount& energy = record.energy;
    double spring_energy = 0;
    for (std::size_t k = 0; k <= last; ++k) {
        energy.kinetic += node_kinetic_energy(at.state, k);
        const NodeContact c = at.surroundings.contact(k, read(at.state, position, k));
        if (c.penetration <= 0) continue;
        ++record.contact_nodes;
        record.max_penetration = std::max(record.max_penetration, c.penetration);
        spring_energy += scene_.mesh.cell[k] * c.spring_energy;
    }
    energy.elastic = elastic_energy(at.stress) + spring_energy;
    energy.potential = potential_energy(at.state) - initial_potential_;
    energy.work = head_work_ + bit_work_;
    if (scene_.head.motion == HeadMotion::driven)
        energy.work += node_kinetic_energy(at.state, 0) - initial_head_energy_;
    energy.dissipation = initial_spring_energy_ - spring_energy;
    double impacts = at.impacts;
    double slips = at.slips;
    for (const double outflow : span_outflow_)
        energy.dissipation += outflow;
    for (const Worker& worker : workers_) {
        impacts += worker.impacts;
        slips += worker.slips;
    }
    record.impacts = std::llround(impacts);
    record.slips = std::llround(slips);
    // who came and is not there has left
    record.contact_changes = 2 * record.impacts - record.contact_nodes;
    record.time = time_;
    record.head_stress = at.stress.front();
    record.bit_stress = at.stress.back();
    record.head_position = read(at.state, position, 0);
    record.bit_position = read(at.state, position, last);
    record.head_rotation_rate = at.state.row(spin)[0];
    record.bit_rotation_rate = at.state.row(spin)[last];
    record.step_size = last_drift_;
    record.time_error = time_error_.latest();
    return record;
}

Profile Leapfrog::profile() const {
    const Snapshot at = snapshot();
    Profile profile;
    profile.time = time_;
    profile.stress = at.stress;
    for (std::size_t k = 0; k <= model_.segments; ++k) {
        const Eigen::Vector3d x = read(at.state, position, k);
        const Eigen::Matrix3d to_body = at.frame[k].transpose();
        const SectionProperties& section = scene_.mesh.node[k];
        Vector6 momentum;
        momentum << scene_.inertia[k] * (to_body * read(at.state, angular_velocity, k)),
            section.mass * (to_body * read(at.state, velocity, k));
        momentum[0] = section.polar_inertia * at.state.row(spin)[k];
        const NodeContact c = at.surroundings.contact(k, x);
        profile.position.push_back(x);
        profile.director.emplace_back(at.frame[k].col(0));
        profile.momentum.push_back(momentum);
        profile.eccentricity.push_back(c.eccentricity);
        profile.well_depth.push_back(c.well_depth);
        profile.contact_force.push_back(c.force);
        profile.normal_force.push_back(std::max(c.normal_force, 0.0));
    }
    return profile;
}

/// Throws for the step at which a worker found that the run cannot go on: a physical guard where
/// one applies to the state before that step.
void Leapfrog::fail() const {
    const std::int64_t step = meeting_.fault_step;
    const double time = course_.time(course_.done + step);
    const BlockTable& state = states_[(current_ + static_cast<std::size_t>(step)) % 2];
    if (const auto guard = guards_.describe(state, workers_.front().segments, time))
        throw GuardError(*guard);
    throw SimulationError(describe_divergence(time));
}

std::string Leapfrog::describe_divergence(double time) const {
    for (const BlockTable& state : states_) {
        for (std::size_t k = 0; k <= model_.segments; ++k) {
            const Eigen::Vector3d v = read(state, velocity, k);
            if (v.allFinite() && v.squaredNorm() < 1e20) continue;
            return fmt::format(
                "the solution diverged near node {}, {:.1f} m along the string, at t = {:.6f} s", k,
                scene_.mesh.node_s[k], time);
        }
    }
    return fmt::format("the solution diverged at t = {:.6f} s", time);
}

}  // namespace drillstrand
