#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>

#include "drillstrand/error.hpp"
#include "drillstrand/simulation.hpp"

namespace drillstrand {

namespace {

/// Times 0, interval, 2 interval, ... before the end, and the end. Counted, not summed, so that
/// times stay exact.
class RecordTimes {
  public:
    /// An interval of 0 leaves only the first and the last time.
    RecordTimes(double interval, double end, std::size_t taken) : interval_(interval), end_(end) {
        while (static_cast<std::size_t>(count_) < taken)
            advance();
    }

    [[nodiscard]] double next() const { return next_; }

    void advance() {
        ++count_;
        const double time = static_cast<double>(count_) * interval_;
        // a last interval shorter than rounding is none
        const bool inside = interval_ > 0 && time < end_ * (1 - 1e-12);
        next_ = next_ >= end_ ? std::numeric_limits<double>::infinity() : inside ? time : end_;
    }

  private:
    double interval_;
    double end_;
    double next_ = 0;
    long long count_ = 0;
};

/// Sums over the string are finite where all of it is.
void require_finite(const SeriesRecord& record) {
    const EnergyAccount& energy = record.energy;
    if (std::isfinite(energy.stored() + energy.work + energy.dissipation) &&
        (record.head_stress + record.bit_stress).allFinite() &&
        (record.head_position + record.bit_position).allFinite()) {
        return;
    }
    throw SimulationError(fmt::format("the solution is not finite at t = {:.6f} s", record.time));
}

void require_finite(const Profile& profile) {
    for (std::size_t k = 0; k < profile.position.size(); ++k) {
        if (profile.position[k].allFinite() && profile.momentum[k].allFinite() &&
            profile.contact_force[k].allFinite() &&
            profile.stress[std::min(k, profile.stress.size() - 1)].allFinite()) {
            continue;
        }
        throw SimulationError(
            fmt::format("the solution is not finite at node {} at t = {:.6f} s", k, profile.time));
    }
}

/// A penalty wall stands for rock as long as the pipe goes into it by less than the pipe could move
/// freely; ten times that is another well.
void require_in_well(const SeriesRecord& record) {
    constexpr double most = 10;
    if (record.relative_penetration <= most) return;
    throw GuardError(
        fmt::format("the pipe left the well at t = {:.6g} s: it lies {:.3g} m deep in the wall, "
                    "{:.3g} times its "
                    "clearance; raise contact.normal_stiffness, or lower the loads",
                    record.time, record.max_penetration, record.relative_penetration));
}

/// How many steps to take before the observer is asked again: as many as fill a tenth of a second
/// of wall time, whatever a step costs. Integrators give the same bits in pieces of any size.
class Pieces {
  public:
    [[nodiscard]] std::int64_t steps() const { return steps_; }

    /// The last piece came to that many steps, fewer where a record was due.
    void took(std::int64_t steps, double seconds) {
        const double filling = seconds > 0 ? aim * static_cast<double>(steps) / seconds : INFINITY;
        // only a piece that was used up shows that a longer one would do
        const std::int64_t most = steps < steps_ ? steps_ : std::min(2 * steps_, longest);
        steps_ = filling < static_cast<double>(most)
                     ? std::max(static_cast<std::int64_t>(filling), std::int64_t{1})
                     : most;
    }

  private:
    static constexpr double aim = 0.1;  // s
    static constexpr std::int64_t longest = std::int64_t{1} << 40;
    std::int64_t steps_ = 1;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

RunOutcome simulate(Integrator& integrator, const RunSchedule& schedule, Observer& observer,
                    const RecordCounts& taken) {
    Pieces pieces;
    RecordTimes series_times(schedule.interval, schedule.duration, taken.series);
    RecordTimes profile_times(schedule.profile_interval, schedule.duration, taken.profiles);
    const auto record = [&] {
        if (integrator.time() >= profile_times.next()) {
            const Profile profile = integrator.profile();
            require_finite(profile);
            observer.on_profile(profile);
            profile_times.advance();
        }
        if (integrator.time() >= series_times.next()) {
            const SeriesRecord series = integrator.series();
            require_finite(series);
            observer.on_series(series);
            require_in_well(series);
            series_times.advance();
        }
    };

    record();
    while (integrator.time() < schedule.duration) {
        const double next = std::min(series_times.next(), profile_times.next());
        const auto start = std::chrono::steady_clock::now();
        const std::int64_t steps = integrator.statistics().steps;
        integrator.advance(next, pieces.steps());
        pieces.took(integrator.statistics().steps - steps, seconds_since(start));
        record();
        if (!observer.on_progress(integrator.time(), integrator.statistics())) {
            return RunOutcome::stopped;
        }
    }
    return RunOutcome::complete;
}

}  // namespace drillstrand
