#include "integrators/leapfrog.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "drillstrand/error.hpp"
#include "rod/director_report.hpp"
#include "state/save.hpp"

namespace drillstrand {

namespace {

constexpr std::int64_t steps_between_guards = 16;
constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();

double wall_time() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

Leapfrog::Leapfrog(const Scene& scene, double cfl, double tolerance, double stress_limit,
                   int threads, Level level)
    : string_(scene, level),
      guards_(scene, string_.model, stress_limit),
      time_error_(tolerance, negligible_energy(scene)),
      bound_(cfl * string_.substeps.plan().bound.step),
      state_(initial_state(string_)),
      next_(state_.rod),
      team_(std::min(threads, static_cast<int>(most_shares(string_)))),
      workers_(static_cast<std::size_t>(team_.members())) {
    for (std::size_t team = 1; team <= workers_.size(); ++team)
        shares_.push_back(shares_of(string_, team));
    for (Worker& worker : workers_) {
        worker.segments = Table<SegmentRow>(string_.model.segments + 1);
        for (std::size_t i = 0; i < string_.substeps.count(); ++i)
            worker.substeps.push_back(string_.substeps.work_for(i));
    }
}

void Leapfrog::advance(double end, std::int64_t max_steps) {
    const std::int64_t& steps = state_.statistics.steps;
    const std::int64_t last = max_steps < no_limit - steps ? steps + max_steps : no_limit;
    while (state_.clock.time < end && steps < last) {
        while (steps == state_.time_error.due)
            sample_time_error();
        if (end != state_.course.end)
            state_.course = course_to(end, bound_ * state_.time_error.factor);
        if (steps == 0)
            state_.origin.half_steps =
                half_kick_energy(string_, state_, 0.5 * state_.course.step());
        take(std::min({state_.course.steps - state_.course.done, last - steps,
                       state_.time_error.due - steps, team_.longest_piece(wall_time())}));
    }
}

Course Leapfrog::course_to(double end, double longest_step) const {
    const double time = state_.clock.time;
    const double steps = std::max(std::ceil((end - time) / longest_step * (1 - 1e-12)), 1.0);
    if (time + longest_step == time)
        throw SimulationError(fmt::format(
            "the step fell to {:g} s at t = {:.6f} s: too short to move on", longest_step, time));
    return {time, end, static_cast<std::int64_t>(steps), 0};
}

/// Advances by steps of the present course; by fewer where the team parts before.
void Leapfrog::take(std::int64_t steps) {
    const double start = wall_time();
    const double waited_before = meeting_.barrier.waited();
    meeting_.last_step = steps - 1;
    meeting_.fault_step = Meeting::no_fault;
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
        run(static_cast<std::size_t>(omp_get_thread_num()), static_cast<std::size_t>(threads));
    }
    if (threads > 1) team_.worked(start, wall_time(), meeting_.barrier.waited() - waited_before);
    if (meeting_.fault_step != Meeting::no_fault) fail();

    const std::int64_t done = meeting_.last_step + 1;
    const double dt = state_.course.step();
    if (done % 2 != 0) std::swap(state_.rod, next_);
    state_.course.done += done;
    state_.clock.time = state_.course.time(state_.course.done);
    state_.clock.last_step = dt;
    state_.statistics.steps += done;
    state_.statistics.evaluations += done;
    state_.statistics.smallest_step = std::min(state_.statistics.smallest_step, dt);
    state_.statistics.largest_step = std::max(state_.statistics.largest_step, dt);
    for (std::size_t i = 0; i < static_cast<std::size_t>(threads); ++i)
        state_.coarsest = coarser_of(state_.coarsest, workers_[i].coarsest);
}

/// The time loop: one barrier a step.
void Leapfrog::run(std::size_t thread, std::size_t threads) {
    Worker& worker = workers_[thread];
    worker.share = &shares_[threads - 1][thread];
    worker.coarsest = state_.coarsest;
    worker.accounts = state_.accounts;
    worker.jar = state_.jar;
    const Course course = state_.course;
    const std::int64_t steps_before = state_.statistics.steps;
    const double last_step = state_.clock.last_step;
    const double dt = course.step();
    Table<DirectorRow>* rod = &state_.rod;
    Table<DirectorRow>* next = &next_;
    DirectorStep step{state_.clock.time, last_step, dt, 0.5 * (last_step + dt)};
    meeting_.barrier.wait();
    for (std::int64_t i = 0;; ++i) {
        bool sound = step_spans(worker, *rod, *next, step);
        if ((steps_before + i) % steps_between_guards == 0)
            sound = keep_guard(worker, *rod, step) && sound;
        if (!sound) meeting_.fault_step.store(i, std::memory_order_relaxed);
        if (thread == 0 && team_should_part() && i < meeting_.last_step) meeting_.last_step = i;
        meeting_.barrier.wait();
        if (meeting_.fault_step.load(std::memory_order_relaxed) <= i) break;
        if (meeting_.last_step.load(std::memory_order_relaxed) <= i) break;
        std::swap(rod, next);
        step = {course.time(course.done + i + 1), dt, dt, dt};
    }
    meeting_.barrier.wait();
    state_.accounts.take(worker.accounts, worker.share->first_span, worker.share->end_span);
    if (string_.jar.is_in({worker.share->begin, worker.share->end})) state_.jar = worker.jar;
}

/// The forces of a span's segments at the whole step, with the load at the bit behind the last.
void Leapfrog::fill_segments(Worker& worker, std::size_t span, const Table<DirectorRow>& rod,
                             const DirectorStep& step) {
    string_segments(string_, worker.jar, rod, worker.segments, string_.spans[span],
                    step.last_drift);
    if (span + 1 == string_.spans.size())
        load_bit(string_, state_, rod, step.time, worker.segments);
}

/// One step of a worker's spans: forces at the whole step, velocities and poses to the next.
/// Whether all velocities are numbers.
bool Leapfrog::step_spans(Worker& worker, const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                          const DirectorStep& step) {
    const DirectorModel& model = string_.model;
    Table<SegmentRow>& segments = worker.segments;
    const bool owns_head = worker.share->begin == 0;
    const bool owns_bit = worker.share->end == string_.spans.back().end;
    // its own blocks, and the one before: each who needs the jar finds the same by itself
    const std::size_t first_block = owns_head ? 0 : worker.share->begin - 1;
    bool sound = true;
    if (string_.jar.is_in({first_block, worker.share->end}))
        worker.jar = string_.jar.follow(worker.jar, model, rod, step.last_drift);
    if (owns_head)
        string_.head.load(segments, rod, step.time);
    else
        string_segments(string_, worker.jar, rod, segments, {first_block, worker.share->begin},
                        step.last_drift);
    for (const std::size_t span : worker.share->early)
        fill_segments(worker, span, rod, step);
    for (const std::size_t stretch : worker.share->stretches)
        string_.substeps.average(model, rod, state_.wall, stretch, step.drift,
                                 worker.substeps[stretch], segments);
    auto early = worker.share->early.begin();
    for (std::size_t i = worker.share->first_span; i < worker.share->end_span; ++i) {
        const BlockSpan span = string_.spans[i];
        if (early != worker.share->early.end() && *early == i)
            ++early;
        else
            fill_segments(worker, i, rod, step);
        const NodeStep done =
            director_nodes(model, rod, next, segments, state_.wall, span, step.kick, step.drift);
        worker.accounts.outflow[i] += done.outflow;
        worker.accounts.impacts[i] += done.impacts;
        worker.accounts.slips[i] += done.slips;
        if (done.leavers > 0) {
            model.surroundings.refresh_arcs(state_.wall, span, [&](std::size_t node) {
                return rod.vector(DirectorRow::position, node);
            });
        }
        if (done.faults > 0) sound = false;
    }
    // of no use to a bit that does not cut
    const Eigen::Vector3d well = owns_bit && string_.bit.law() == BitLaw::cutting
                                     ? well_at_bit(string_, state_.wall, rod)
                                     : Eigen::Vector3d::Zero();
    if (owns_bit) string_.bit.resist(state_.bit, state_.rock, rod, next, well, step);
    for (const std::size_t stretch : worker.share->stretches)
        worker.accounts.outflow[worker.share->early.front()] += string_.substeps.share(
            model, rod, next, stretch, step.kick, step.drift, worker.substeps[stretch]);
    if (owns_head) string_.head.finish(state_.head, segments, rod, next, step);
    if (owns_bit) string_.bit.finish(state_.bit, state_.rock, segments, rod, next, well, step);
    return sound;
}

/// Reads the guards of a worker's segments, whose stresses are those of `rod`; false where the run
/// has to stop.
bool Leapfrog::keep_guard(Worker& worker, const Table<DirectorRow>& rod,
                          const DirectorStep& step) const {
    bool passes = true;
    // what the segments bear, not what their nodes feel in the mean
    for (const std::size_t span : worker.share->early)
        string_segments(string_, worker.jar, rod, worker.segments, string_.spans[span],
                        step.last_drift);
    for (std::size_t block = worker.share->begin; block < worker.share->end; ++block) {
        const GuardReading reading = guards_.read(rod, worker.segments, worker.jar, block);
        guards_.follow(worker.coarsest, reading, rod, worker.segments, worker.jar, block,
                       step.time);
        if (guards_.stops(reading)) passes = false;
    }
    return passes;
}

/// Whether the members of the team wait for each other longer than their help is worth.
bool Leapfrog::team_should_part() const {
    const double waited = meeting_.barrier.waited() - meeting_.waited_before;
    return waited > 0 && team_.waits_too_long(meeting_.start, wall_time(), waited);
}

/// Throws for the step at which a worker found that the run cannot go on: a physical guard where
/// one applies to the rod before that step.
void Leapfrog::fail() {
    const std::int64_t step = meeting_.fault_step;
    const double time = state_.course.time(state_.course.done + step);
    const double last_drift = step > 0 ? state_.course.step() : state_.clock.last_step;
    const Table<DirectorRow>& rod = step % 2 == 0 ? state_.rod : next_;
    const Table<DirectorRow>& after = step % 2 == 0 ? next_ : state_.rod;
    Table<SegmentRow>& segments = workers_.front().segments;
    for (const BlockSpan span : string_.spans)
        string_segments(string_, state_.jar, rod, segments, span, last_drift);
    if (const auto guard = guards_.describe(rod, segments, state_.jar, time))
        throw GuardError(*guard);
    throw SimulationError(describe_divergence(string_, {&rod, &after}, time));
}

// ------------------------------------------------------------------ time error

/// Repeats the steps to come from here, in the steps of the run and in halves of them. A window in
/// which a guard stops the run is no sample: the run itself will tell.
void Leapfrog::sample_time_error() {
    const DirectorState kept = state_;
    const double step = bound_ * kept.time_error.factor;
    const double end = kept.clock.time + static_cast<double>(TimeErrorControl::window) * step;
    TimeError found = kept.time_error;
    try {
        const Profile coarse = profile_after(end, step);
        state_ = kept;
        const Profile fine = profile_after(end, 0.5 * step);
        time_error_.add(found, kept.statistics.steps, kept.clock.time,
                        rod_energy(string_.scene, fine),
                        rod_energy_between(string_.scene, coarse, fine));
    } catch (const SimulationError&) {
        time_error_.skip(found, kept.statistics.steps);
    }
    state_ = kept;
    state_.time_error = found;
    // a new step is taken at once
    if (found.factor != kept.time_error.factor) state_.course = {};
}

/// What comes of the present state, as if a run began here, after steps of a length up to `end`.
Profile Leapfrog::profile_after(double end, double step) {
    start_again(string_, state_);
    state_.course = course_to(end, step);
    while (state_.course.done < state_.course.steps)
        take(std::min(state_.course.steps - state_.course.done, team_.longest_piece(wall_time())));
    return profile_record(string_, state_);
}

// ------------------------------------------------------------------ what others may know

SeriesRecord Leapfrog::series() const {
    return series_record(string_, state_);
}

Profile Leapfrog::profile() const {
    return profile_record(string_, state_);
}

BendingRecord Leapfrog::bending() const {
    return bending_record(string_, state_);
}

std::vector<SensorRecord> Leapfrog::sense(const std::vector<SensorCase>& sensors) const {
    return sensor_records(string_, state_, sensors);
}

StepStatistics Leapfrog::statistics() const {
    StepStatistics statistics = state_.statistics;
    statistics.time_error = state_.time_error.largest;
    return statistics;
}

std::vector<std::string> Leapfrog::warnings() const {
    std::vector<std::string> result;
    if (const auto sentence = guards_.warn(state_.coarsest)) result.push_back(*sentence);
    if (const auto sentence = time_error_.warning(state_.time_error)) result.push_back(*sentence);
    return result;
}

SavedState Leapfrog::save() const {
    return drillstrand::save(state_);
}

void Leapfrog::restore(const SavedState& saved) {
    DirectorState restored = state_;
    drillstrand::restore(restored, saved);
    derive(string_, restored);
    state_ = std::move(restored);
    next_ = state_.rod;
}

}  // namespace drillstrand
