#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/simulation.hpp"

namespace drillstrand {

namespace {

/// Times that differ by less than this part are one.
constexpr double rounding = 1e-12;

/// Times 0, interval, 2 interval, ... before the end, and the end. Counted, not summed, so that
/// times stay exact.
class RecordTimes {
  public:
    /// An interval of 0 leaves only the first and the last time.
    RecordTimes(double interval, double end, std::size_t taken) : interval_(interval), end_(end) {
        while (count_ < taken)
            advance();
    }

    [[nodiscard]] double next() const { return next_; }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool is_due(double time) const { return time >= next_ * (1 - rounding); }

    void advance() {
        ++count_;
        const double time = static_cast<double>(count_) * interval_;
        // a last interval shorter than rounding is none
        const bool inside = interval_ > 0 && time < end_ * (1 - rounding);
        next_ = next_ >= end_ ? std::numeric_limits<double>::infinity() : inside ? time : end_;
    }

  private:
    double interval_;
    double end_;
    double next_ = 0;
    std::size_t count_ = 0;
};

/// When each kind of record is due.
struct RunTimes {
    RecordTimes series;
    RecordTimes profiles;
    std::vector<RecordTimes> bending;  ///< none or one
    std::vector<RecordTimes> sensors;

    /// `time` that the run has come to (s).
    RunTimes(const RunSchedule& schedule, const RecordCounts& taken, double time)
        : series(schedule.interval, schedule.duration, taken.series),
          profiles(schedule.profile_interval, schedule.duration, taken.profiles) {
        const auto since = [&](double interval) {
            const std::size_t before =
                taken.series > 0 ? records_until(time, interval, schedule.duration) : 0;
            return RecordTimes(interval, schedule.duration, before);
        };
        if (schedule.bending_interval > 0) bending.push_back(since(schedule.bending_interval));
        for (const SensorCase& sensor : schedule.sensors)
            sensors.push_back(since(sensor.interval));
    }

    /// The next time of any; of times that are one that of the first kind.
    [[nodiscard]] double next() const {
        double first = std::min(series.next(), profiles.next());
        for (const auto* kind : {&bending, &sensors})
            for (const RecordTimes& times : *kind)
                first = std::min(first, times.next());
        if (series.is_due(first)) return series.next();
        return profiles.is_due(first) ? profiles.next() : first;
    }
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

void require_finite(const SensorRecord& record, const SensorCase& sensor) {
    if (record.acceleration.allFinite() && record.bending_moment.allFinite() &&
        std::isfinite(record.rotation_rate + record.torque + record.tension))
        return;
    throw SimulationError(fmt::format("the solution is not finite at sensor {} at t = {:.6f} s",
                                      sensor.name, record.time));
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

/// Takes records when they are due and hands them on.
class Recording {
  public:
    Recording(const Integrator& integrator, const RunSchedule& schedule, Observer& observer,
              const RecordCounts& taken)
        : integrator_(integrator),
          sensors_(schedule.sensors),
          observer_(observer),
          times_(schedule, taken, integrator.time()) {}

    [[nodiscard]] double next() const { return times_.next(); }

    void take_due() {
        const double time = integrator_.time();
        if (times_.profiles.is_due(time)) {
            const Profile profile = integrator_.profile();
            require_finite(profile);
            observer_.on_profile(profile);
            times_.profiles.advance();
        }
        for (RecordTimes& bending : times_.bending) {
            if (!bending.is_due(time)) continue;
            observer_.on_bending(integrator_.bending());
            bending.advance();
        }
        take_sensors(time);
        if (times_.series.is_due(time)) {
            const SeriesRecord series = integrator_.series();
            require_finite(series);
            observer_.on_series(series);
            require_in_well(series);
            times_.series.advance();
        }
    }

  private:
    void take_sensors(double time) {
        std::vector<SensorRecord> records;
        for (std::size_t i = 0; i < sensors_.size(); ++i) {
            if (!times_.sensors[i].is_due(time)) continue;
            if (records.empty()) records = integrator_.sense(sensors_);
            require_finite(records[i], sensors_[i]);
            observer_.on_sensor(i, records[i]);
            times_.sensors[i].advance();
        }
    }

    const Integrator& integrator_;
    const std::vector<SensorCase>& sensors_;
    Observer& observer_;
    RunTimes times_;
};

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

std::size_t records_until(double time, double interval, double end) {
    RecordTimes times(interval, end, 0);
    while (times.is_due(time))
        times.advance();
    return times.count();
}

RunSchedule run_schedule(const Case& input) {
    RunSchedule schedule;
    schedule.duration = input.run.duration;
    schedule.interval = input.output.interval;
    schedule.profile_interval = input.output.profile_interval;
    if (input.output.cycles) schedule.bending_interval = input.output.cycles->interval;
    schedule.sensors = input.output.sensors;
    return schedule;
}

RunOutcome simulate(Integrator& integrator, const RunSchedule& schedule, Observer& observer,
                    const RecordCounts& taken) {
    Pieces pieces;
    Recording recording(integrator, schedule, observer, taken);
    recording.take_due();
    while (integrator.time() < schedule.duration) {
        const auto start = std::chrono::steady_clock::now();
        const std::int64_t steps = integrator.statistics().steps;
        integrator.advance(recording.next(), pieces.steps());
        pieces.took(integrator.statistics().steps - steps, seconds_since(start));
        recording.take_due();
        if (!observer.on_progress(integrator.time(), integrator.statistics())) {
            return RunOutcome::stopped;
        }
    }
    return RunOutcome::complete;
}

}  // namespace drillstrand
