// When a run records, and that it stops when it is asked to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

using testing::ElementsAre;

/// Counts steps of 1 ms and knows nothing else: a time loop without physics.
class Clock final : public Integrator {
  public:
    std::chrono::milliseconds pause{0};  ///< of wall time, in each step

    void advance(double end, std::int64_t max_steps) override {
        for (std::int64_t step = 0; step < max_steps && time_ < end; ++step) {
            time_ = end - time_ <= 1e-3 ? end : time_ + 1e-3;
            ++statistics_.steps;
            std::this_thread::sleep_for(pause);
        }
    }
    [[nodiscard]] double time() const override { return time_; }
    [[nodiscard]] SeriesRecord series() const override {
        SeriesRecord record;
        record.time = time_;
        return record;
    }
    [[nodiscard]] Profile profile() const override {
        Profile profile;
        profile.time = time_;
        return profile;
    }
    [[nodiscard]] BendingRecord bending() const override { return {time_, {}}; }
    [[nodiscard]] std::vector<SensorRecord> sense(
        const std::vector<SensorCase>& sensors) const override {
        std::vector<SensorRecord> records(sensors.size());
        for (SensorRecord& record : records)
            record.time = time_;
        return records;
    }
    [[nodiscard]] SavedState save() const override { return {}; }
    void restore(const SavedState&) override {}
    [[nodiscard]] StepStatistics statistics() const override { return statistics_; }

  private:
    double time_ = 0;
    StepStatistics statistics_;
};

struct Times : Observer {
    std::vector<double> series;
    std::vector<double> profiles;
    std::vector<double> progress;
    std::vector<double> bending;
    std::vector<std::vector<double>> sensors = std::vector<std::vector<double>>(2);
    double stop_at = 1e300;

    void on_series(const SeriesRecord& record) override { series.push_back(record.time); }
    void on_profile(const Profile& profile) override { profiles.push_back(profile.time); }
    void on_bending(const BendingRecord& record) override { bending.push_back(record.time); }
    void on_sensor(std::size_t sensor, const SensorRecord& record) override {
        sensors[sensor].push_back(record.time);
    }
    bool on_progress(double time, const StepStatistics& /*statistics*/) override {
        progress.push_back(time);
        return time < stop_at;
    }
};

RunSchedule every(double duration, double interval, double profile_interval) {
    return {duration, interval, profile_interval, 0, {}};
}

Times times_of(const RunSchedule& schedule) {
    Clock clock;
    Times times;
    EXPECT_EQ(simulate(clock, schedule, times), RunOutcome::complete);
    EXPECT_EQ(clock.time(), schedule.duration);
    return times;
}

TEST(RecordTimes, AreMultiplesOfTheIntervalAndTheEnd) {
    const Times times = times_of(every(1.0, 0.25, 0.5));
    EXPECT_THAT(times.series, ElementsAre(0, 0.25, 0.5, 0.75, 1.0));
    EXPECT_THAT(times.profiles, ElementsAre(0, 0.5, 1.0));
}

TEST(RecordTimes, EndIsRecordedWhereTheIntervalDoesNotDivideTheDuration) {
    const Times times = times_of(every(1.0, 0.3, 0.7));
    EXPECT_THAT(times.series, ElementsAre(0, 0.3, 2 * 0.3, 3 * 0.3, 1.0));
    EXPECT_THAT(times.profiles, ElementsAre(0, 0.7, 1.0));
}

TEST(RecordTimes, AreCountedNotSummedSoThatTheyStayExact) {
    const Times times = times_of(every(10.0, 0.1, 0));
    ASSERT_EQ(times.series.size(), 101U);
    for (std::size_t i = 0; i < times.series.size(); ++i) {
        EXPECT_EQ(times.series[i], i == 100 ? 10.0 : 0.1 * static_cast<double>(i));
    }
}

// 3 * 0.1 is a little more than 0.3
TEST(RecordTimes, EndIsNotRecordedTwiceWhereTheIntervalDividesTheDurationButForRounding) {
    EXPECT_THAT(times_of(every(0.3, 0.1, 0)).series, ElementsAre(0, 0.1, 0.2, 0.3));
    EXPECT_EQ(times_of(every(0.7, 0.1, 0)).series.size(), 8U);
    EXPECT_EQ(times_of(every(4.9, 0.7, 0)).series.size(), 8U);
}

// 0.1 k and 0.01 (10 k) differ in the last digit for many k
TEST(RecordTimes, OfSensorsAndBendingThatMeetOthersButForRoundingAreTheSame) {
    RunSchedule schedule{1.0, 0.1, 0.5, 0.02, {{"a", 0, 0, 0.01}, {"b", 0, 0, 0.3}}};
    const Times times = times_of(schedule);
    EXPECT_EQ(times.sensors.at(0).size(), 101U);
    EXPECT_EQ(times.bending.size(), 51U);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(times.series[i], 0.1 * static_cast<double>(i));
        EXPECT_EQ(times.sensors[0][10 * i], times.series[i]);
        EXPECT_EQ(times.bending[5 * i], times.series[i]);
    }
    EXPECT_THAT(times.sensors.at(1), ElementsAre(0, 3 * 0.1, 6 * 0.1, 9 * 0.1, 1.0));
    EXPECT_EQ(times.progress.size(), times_of(every(1.0, 0.01, 0)).progress.size());
}

TEST(RecordTimes, ThatARunHasTakenFollowFromItsTime) {
    EXPECT_EQ(records_until(0, 0.1, 1), 1U);
    EXPECT_EQ(records_until(0.29, 0.1, 1), 3U);
    EXPECT_EQ(records_until(0.3, 0.1, 1), 4U);
    EXPECT_EQ(records_until(1, 0.1, 1), 11U);
    EXPECT_EQ(records_until(1, 0.3, 1), 5U);
}

TEST(RecordTimes, ProfileIntervalOfZeroLeavesTheFirstAndTheLast) {
    EXPECT_THAT(times_of(every(1.0, 0.1, 0)).profiles, ElementsAre(0, 1.0));
}

TEST(RecordTimes, IntervalLongerThanTheRunLeavesTheFirstAndTheLast) {
    const Times times = times_of(every(1.0, 5.0, 7.0));
    EXPECT_THAT(times.series, ElementsAre(0, 1.0));
    EXPECT_THAT(times.profiles, ElementsAre(0, 1.0));
}

TEST(RecordTimes, ProgressIsReportedBetweenDistantRecords) {
    const Times times = times_of(every(10.0, 10.0, 0));
    EXPECT_GE(times.progress.size(), 10U);
}

TEST(RecordTimes, ProgressIsReportedAfterEveryStepThatTakesLong) {
    Clock clock;
    clock.pause = std::chrono::milliseconds(150);
    Times times;
    EXPECT_EQ(simulate(clock, every(0.004, 1.0, 0), times), RunOutcome::complete);
    EXPECT_EQ(times.progress.size(), 4U);
}

TEST(RecordTimes, RunEndsSoonAfterTheObserverAsksForItAndKeepsItsRecords) {
    Clock clock;
    Times times;
    times.stop_at = 2.5;
    EXPECT_EQ(simulate(clock, every(100.0, 1.0, 0), times), RunOutcome::stopped);
    EXPECT_LT(clock.time(), 4.0);
    EXPECT_THAT(times.series, testing::Contains(2.0));
    EXPECT_THAT(times.series, testing::Each(testing::Le(clock.time())));
    EXPECT_THAT(times.profiles, ElementsAre(0));
}

TEST(RecordTimes, OfARealIntegratorAreExactToo) {
    const test::Run result = run(R"(
        [string]
        [[string.component]]
        length = 20
        outer_diameter = 0.14
        inner_diameter = 0.12
        linear_density = 31.8557
        youngs_modulus = "200 GPa"
        [mesh]
        segments = 2
        segment_inertia = true
        [run]
        duration = 0.1
        integrator = "dormand-prince"
        [output]
        interval = 0.03
        profile_interval = 0.04)");
    std::vector<double> series;
    for (const SeriesRecord& record : result.series)
        series.push_back(record.time);
    std::vector<double> profiles;
    for (const Profile& profile : result.profiles)
        profiles.push_back(profile.time);
    EXPECT_THAT(series, ElementsAre(0, 0.03, 2 * 0.03, 3 * 0.03, 0.1));
    EXPECT_THAT(profiles, ElementsAre(0, 0.04, 2 * 0.04, 0.1));
}

}  // namespace
}  // namespace drillstrand::test
