// Rainflow counts against the example of the standard, and against another method.
#include "drillstrand/rainflow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace drillstrand::test {
namespace {

RainflowCounter counted(const std::vector<double>& values, double slope, double resolution = 0) {
    RainflowCounter counter(slope, resolution);
    for (const double value : values)
        counter.add(value);
    return counter;
}

using Histogram = std::map<double, double>;  // range, count

double moment(const Histogram& histogram, double slope) {
    double sum = 0;
    for (const auto& [range, count] : histogram)
        sum += count * std::pow(range, slope);
    return sum;
}

// ASTM E1049-85 (2017), figure 6 and its table. Moments of five orders leave no other counts of its
// five ranges.
TEST(Rainflow, CountsTheExampleOfTheStandardAsItsTable) {
    const Histogram table = {{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1}, {9, 0.5}};
    const std::vector<double> history = {-2, 1, -3, 5, -1, 3, -4, 4, -2};
    for (const double slope : {1, 2, 3, 4, 5})
        EXPECT_NEAR(counted(history, slope).damage(), moment(table, slope),
                    1e-12 * moment(table, slope));
    const CycleCount count = counted(history, 3).count();
    EXPECT_EQ(count.cycles, 4);
    EXPECT_EQ(count.largest_range, 9);
    EXPECT_NEAR(count.equivalent_range, std::cbrt(moment(table, 3) / 4), 1e-12);
}

TEST(Rainflow, ValuesBetweenTurnsChangeNothing) {
    const std::vector<double> fine = {-2, -1, 0.5, 1, -2.9, -3, 0, 5, 4, -1, 1, 1, 3, -4, 3, 4, -2};
    EXPECT_EQ(counted(fine, 3).damage(), counted({-2, 1, -3, 5, -1, 3, -4, 4, -2}, 3).damage());
}

/// The turns of a signal, its first and last value among them.
std::vector<double> turns_of(const std::vector<double>& values) {
    std::vector<double> turns{values.front()};
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
        if ((values[i] - values[i - 1]) * (values[i + 1] - values[i]) < 0)
            turns.push_back(values[i]);
    turns.push_back(values.back());
    return turns;
}

/// The four-point method: of four turns in a row the inner two are a cycle where the range between
/// them is within both neighbours; what is left are halves.
Histogram by_four_points(std::vector<double> turns) {
    Histogram histogram;
    for (std::size_t i = 0; i + 3 < turns.size();) {
        const auto range = [&](std::size_t k) { return std::abs(turns[i + k + 1] - turns[i + k]); };
        if (range(1) <= range(0) && range(1) <= range(2)) {
            histogram[range(1)] += 1;
            turns.erase(turns.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                        turns.begin() + static_cast<std::ptrdiff_t>(i) + 3);
            i = i > 2 ? i - 2 : 0;
        } else {
            ++i;
        }
    }
    for (std::size_t i = 0; i + 1 < turns.size(); ++i)
        histogram[std::abs(turns[i + 1] - turns[i])] += 0.5;
    return histogram;
}

std::vector<double> random_signal(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-100, 100);
    std::vector<double> values;
    for (int i = 0; i < 500; ++i)
        values.push_back(value(random));
    return values;
}

TEST(Rainflow, AgreesWithTheFourPointMethodOnRandomSignals) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        const std::vector<double> values = random_signal(seed);
        const Histogram other = by_four_points(turns_of(values));
        for (const double slope : {1.0, 4.0}) {
            const double expected = moment(other, slope);
            EXPECT_NEAR(counted(values, slope).damage(), expected, 1e-10 * expected) << seed;
        }
        EXPECT_EQ(counted(values, 1).count().cycles, moment(other, 0)) << seed;
    }
}

TEST(Rainflow, ASineHasAsManyCyclesAsPeriodsAndTwiceItsAmplitudeAsRange) {
    std::vector<double> values;
    for (int i = 0; i <= 1000; ++i)
        values.push_back(50 * std::cos(2 * std::numbers::pi * i / 40));
    const CycleCount count = counted(values, 4, 1).count();
    EXPECT_EQ(count.cycles, 25);
    EXPECT_NEAR(count.largest_range, 100, 1e-10);
    EXPECT_NEAR(count.equivalent_range, 100, 1e-10);
}

TEST(Rainflow, TurnsBelowTheResolutionAreNone) {
    const auto noisy = [](double noise) {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> disturbance(-noise, noise);
        std::vector<double> values;
        for (int i = 0; i <= 10000; ++i)
            values.push_back(50 * std::cos(2 * std::numbers::pi * i / 400) + disturbance(random));
        return values;
    };
    const CycleCount count = counted(noisy(0.4), 4, 1).count();
    EXPECT_EQ(count.cycles, 25);
    EXPECT_NEAR(count.largest_range, 100, 1);
    EXPECT_GT(counted(noisy(0.4), 4, 0).count().cycles, 100);
}

// without a resolution it would remember a turn for each half period
TEST(Rainflow, AVibrationThatCalmsDownIsNotRememberedForEver) {
    RainflowCounter counter(4, 1);
    double exact = 0;
    double before = 100;
    constexpr int halves = 20000;
    for (int i = 0; i <= halves; ++i) {
        const double value = (i % 2 == 0 ? 1 : -1) * 100 * std::exp(-i / 10000.0);
        counter.add(value);
        if (i > 0) exact += 0.5 * std::pow(std::abs(value - before), 4);
        before = value;
    }
    EXPECT_LT(counter.save().size(), 250U);
    EXPECT_NEAR(counter.count().cycles, halves / 2, 100);
    EXPECT_NEAR(counter.damage(), exact, 0.02 * exact);
}

TEST(Rainflow, GoesOnFromWhatWasSavedToTheSameBits) {
    const std::vector<double> values = random_signal(7);
    for (const std::size_t stop : {0U, 1U, 2U, 3U, 100U, 499U}) {
        RainflowCounter first(4, 1);
        for (std::size_t i = 0; i < stop; ++i)
            first.add(values[i]);
        RainflowCounter second(4, 1);
        second.restore(first.save());
        for (std::size_t i = stop; i < values.size(); ++i)
            second.add(values[i]);
        EXPECT_EQ(second.save(), counted(values, 4, 1).save()) << stop;
    }
    RainflowCounter counter(4, 1);
    EXPECT_THROW(counter.restore({1, 2}), std::invalid_argument);
}

TEST(Rainflow, ASignalThatStandsStillHasNoCycles) {
    EXPECT_EQ(RainflowCounter(4, 1).count().cycles, 0);
    EXPECT_EQ(counted({5, 5.5, 5.2, 5.9}, 4, 1).count().cycles, 0);
}

}  // namespace
}  // namespace drillstrand::test
