// A jar: when it trips, and how hard its hammer strikes, by the characteristics of axial waves in
// the two bars that it joins.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "drillstrand/step_bound.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double youngs_modulus = 206e9;
constexpr double density = 7850;
const double wave_speed = std::sqrt(youngs_modulus / density);

/// A steel pipe.
struct Pipe {
    double outer, inner;  // m
    double length;        // m

    [[nodiscard]] double area() const { return pi / 4 * (outer * outer - inner * inner); }
    /// Force over the speed of an axial wave (kg/s).
    [[nodiscard]] double impedance() const { return area() * std::sqrt(youngs_modulus * density); }
    [[nodiscard]] std::string text() const {
        return fmt::format(R"(
            [[string.component]]
            length = {}
            outer_diameter = {}
            inner_diameter = {}
            density = {}
            youngs_modulus = {}
            )",
                           length, outer, inner, density, youngs_modulus);
    }
};

const Pipe drill_pipe{0.127, 0.1086, 600};
const Pipe collar{0.165, 0.0714, 600};

Pipe with_length(Pipe pipe, double length) {
    pipe.length = length;
    return pipe;
}

/// Two weightless bars, the upper one held, with a jar between them; `pull`: dead force at the end
/// of the lower one, as a schedule along the string.
std::string jarred(const Pipe& above, const Pipe& below, const std::string& jar,
                   const std::string& pull, double duration, const std::string& rest) {
    return fmt::format(
        "gravity = 0\n{}{}[string.component.jar]\nposition = 0\n{}\n[bit]\nforce = {}"
        "\n[run]\nduration = {}\n{}",
        above.text(), below.text(), jar, pull, duration, rest);
}

std::string steady(double force) {
    return fmt::format("[0, 0, {}]", force);
}

std::string schedule(const std::vector<std::pair<double, double>>& points) {
    std::string text = "[";
    for (const auto& [time, force] : points)
        text += fmt::format("[{}, {}],", time, steady(force));
    return text + "]";
}

/// First record of a kind; the last where there is none.
template <class Condition>
const SeriesRecord& first(const test::Run& run, const Condition& is_it) {
    const auto found = std::find_if(run.series.begin(), run.series.end(), is_it);
    EXPECT_NE(found, run.series.end());
    return found == run.series.end() ? run.last() : *found;
}

const SeriesRecord& release_of(const test::Run& run) {
    return first(run, [](const SeriesRecord& record) { return record.jar_travel != 0; });
}

/// Energy that appeared, over the largest that a part of the account holds.
double residual(const test::Run& run) {
    const EnergyAccount& start = run.series.front().energy;
    const EnergyAccount& end = run.last().energy;
    double moved = 0;
    for (const SeriesRecord& record : run.series)
        moved = std::max({moved, record.energy.elastic, record.energy.kinetic,
                          record.energy.dissipation, std::abs(record.energy.work)});
    return std::abs((end.stored() + end.dissipation - end.work) -
                    (start.stored() + start.dissipation - start.work)) /
           moved;
}

// ------------------------------------------------------------------ the blow

struct Bars {
    const char* name;
    Pipe above, below;
};

class JarBetween : public testing::TestWithParam<Bars> {};

// Both bars under the tension T. Where the jar lets go, its ends fly apart with T/Z1 + T/Z2. In the
// lower bar, which T pulls on, the wave comes back from the end after t1 = 2 L2/c, and that half of
// the jar then moves with 3 T/Z2. Both ends are free of stress when the hammer strikes.
TEST_P(JarBetween, StrikesWithTheForceOfTheImpedances) {
    const double tension = 200e3;
    const auto& [name, above, below] = GetParam();
    const double z1 = above.impedance();
    const double z2 = below.impedance();
    const double trip = 0.02;
    const double round_trip = 2 * below.length / wave_speed;
    const double slow = tension / z1 + tension / z2;
    const double fast = tension / z1 + 3 * tension / z2;
    const double travel = round_trip * (slow + 0.25 * fast);
    const double blow = trip + 1.25 * round_trip;
    const double wave_at_anvil = trip + 2 * round_trip;
    const test::Run run = test::run(jarred(
        above, below,
        fmt::format("up_force = {}\nup_travel = {:.17g}\ndelay = {}", 0.9 * tension, travel, trip),
        steady(tension), wave_at_anvil,
        "[mesh]\nsegments = 400\n[initial]\nstate = \"equilibrium\"\n[damping]\n"
        "kelvin_voigt = 1e-5\n[output]\ninterval = 1e-3\nprofile_interval = 0"));

    EXPECT_NEAR(release_of(run).time, trip, 1.5e-3);
    const SeriesRecord& struck =
        first(run, [](const SeriesRecord& record) { return record.jar_blows > 0; });
    EXPECT_NEAR(struck.time, blow, 2e-3);

    double plateau = 0;
    int records = 0;
    double last_travel = 0;
    double speed = 0;
    for (const SeriesRecord& record : run.series) {
        if (record.time > trip + 1.1 * round_trip && record.time < blow - 2e-3)
            speed = (record.jar_travel - last_travel) / 1e-3;
        last_travel = record.jar_travel;
        if (record.time < blow + 0.2 * round_trip ||
            record.time > wave_at_anvil - 0.05 * round_trip)
            continue;
        plateau += record.jar_force;
        ++records;
    }
    EXPECT_NEAR(speed, fast, 1e-3 * fast);
    const double force = fast * z1 * z2 / (z1 + z2);
    EXPECT_NEAR(plateau / records, force, 5e-3 * force);
    EXPECT_LT(residual(run), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Bars, JarBetween,
    testing::Values(Bars{"EqualPipes", drill_pipe, with_length(drill_pipe, 200)},
                    Bars{"PipeAndCollar", drill_pipe, with_length(collar, 200)},
                    Bars{"CollarAndPipe", collar, with_length(drill_pipe, 200)}),
    [](const auto& of) { return of.param.name; });

// ------------------------------------------------------------------ when it trips

const std::string short_mesh =
    "[mesh]\nsegments = 10\n[damping]\nexternal_translation = 2000\n[output]\n"
    "interval = 0.01\nprofile_interval = 0";

TEST(Jar, TripsWhereTheForceHasLastedForTheDelay) {
    const Pipe half = with_length(drill_pipe, 25);
    const std::string ramp = schedule({{0, 0}, {4, 200e3}});
    for (const double delay : {0.0, 0.75}) {
        const test::Run run = test::run(
            jarred(half, half, fmt::format("up_force = 100e3\nup_travel = 0.2\ndelay = {}", delay),
                   ramp, 3.5, short_mesh));
        EXPECT_NEAR(release_of(run).time, 2 + delay, 0.02);
        for (const SeriesRecord& record : run.series) {
            if (record.time < 2 + delay - 0.02) {
                EXPECT_EQ(record.jar_travel, 0);
                EXPECT_NEAR(record.jar_force, 50e3 * record.time, 1e3);
            }
        }
    }
}

TEST(Jar, MetersAnewAfterABreak) {
    const Pipe half = with_length(drill_pipe, 25);
    const std::string pull =
        schedule({{0, 50e3}, {0.5, 150e3}, {1, 150e3}, {1.5, 50e3}, {2, 150e3}, {5, 150e3}});
    const test::Run run = test::run(
        jarred(half, half, "up_force = 100e3\nup_travel = 0.2\ndelay = 1.2", pull, 4, short_mesh));
    EXPECT_NEAR(release_of(run).time, 1.75 + 1.2, 0.02);
}

TEST(Jar, DownwardIsThatUpwardTurnedOver) {
    const Pipe above = with_length(collar, 60);
    const Pipe below = with_length(collar, 20);
    const std::string rest =
        "[mesh]\nsegments = 40\n[damping]\nkelvin_voigt = 1e-5\n[output]\ninterval = 1e-3\n"
        "profile_interval = 0";
    const test::Run up =
        test::run(jarred(above, below, "up_force = 90e3\nup_travel = 0.02\ndelay = 0.01",
                         schedule({{0, 0}, {0.1, 100e3}}), 0.2, rest));
    const test::Run down =
        test::run(jarred(above, below, "down_force = 90e3\ndown_travel = 0.02\ndelay = 0.01",
                         schedule({{0, 0}, {0.1, -100e3}}), 0.2, rest));
    ASSERT_EQ(up.series.size(), down.series.size());
    EXPECT_GE(up.last().jar_blows, 1);
    for (std::size_t i = 0; i < up.series.size(); ++i) {
        EXPECT_NEAR(up.series[i].jar_force, -down.series[i].jar_force, 1);
        EXPECT_NEAR(up.series[i].jar_travel, -down.series[i].jar_travel, 1e-7);
        EXPECT_EQ(up.series[i].jar_blows, down.series[i].jar_blows);
    }
}

TEST(Jar, LatchesWhereItComesBackAndTripsAgain) {
    const Pipe half = with_length(drill_pipe, 25);
    const std::string pull =
        schedule({{0, 0}, {0.5, 150e3}, {2, 150e3}, {3, -50e3}, {5, -50e3}, {6, 150e3}});
    const test::Run run =
        test::run(jarred(half, half, "up_force = 100e3\nup_travel = 0.1", pull, 8, short_mesh));
    const auto at = [&](double time) {
        return first(run, [&](const SeriesRecord& record) { return record.time > time; });
    };
    EXPECT_NEAR(at(1.99).jar_travel, 0.1, 1e-12);
    EXPECT_NEAR(at(1.99).jar_force, 150e3, 1e3);
    EXPECT_EQ(at(4.99).jar_travel, 0);
    EXPECT_NEAR(at(4.99).jar_force, -50e3, 1e3);
    // latched: a pull below its force does not open it
    EXPECT_EQ(at(5.6).jar_travel, 0);
    EXPECT_NEAR(at(7.98).jar_travel, 0.1, 1e-12);
    EXPECT_GT(at(7.98).jar_blows, at(4.99).jar_blows);
}

// ------------------------------------------------------------------ what it keeps and loses

TEST(Jar, WithTwoStrokesKeepsTheEnergyAccount) {
    const Pipe above = with_length(drill_pipe, 100);
    const Pipe below = with_length(collar, 50);
    const test::Run run = test::run(
        jarred(above, below,
               "up_force = 200e3\nup_travel = 0.15\ndown_force = 80e3\ndown_travel = 0.1\n"
               "delay = 0.1",
               schedule({{0, 0}, {0.5, 220e3}, {1, 220e3}, {1.5, -100e3}, {2.5, -100e3}}), 3,
               "[mesh]\nsegments = 60\n[output]\ninterval = 0.01\nprofile_interval = 0"));
    EXPECT_GE(run.last().jar_blows, 2);
    EXPECT_LT(residual(run), 1e-4);
}

TEST(Jar, ThatIsNeverPulledHardEnoughIsAnOrdinarySegment) {
    const Pipe half = with_length(drill_pipe, 50);
    const std::string rest =
        "[head]\nrotation = 3\n[mesh]\nsegments = 40\n[output]\ninterval = 0.05";
    Case with = test::case_from(jarred(half, half,
                                       "up_force = 400e3\nup_travel = 0.2\ndown_force = 400e3\n"
                                       "down_travel = 0.1",
                                       "[[0, [0, 0, 0]], [0.5, [1e3, 500, 150e3]]]", 1, rest));
    Case without = with;
    without.string.components[1].jar.reset();
    const test::Run one = test::run(with);
    const test::Run other = test::run(without);
    EXPECT_EQ(one.statistics.steps, other.statistics.steps);
    EXPECT_EQ(one.end().position, other.end().position);
    EXPECT_EQ(one.end().momentum, other.end().momentum);
    EXPECT_EQ(one.end().stress, other.end().stress);
    EXPECT_EQ(one.last().energy.elastic, other.last().energy.elastic);
    EXPECT_EQ(one.last().energy.dissipation, other.last().energy.dissipation);
    EXPECT_NEAR(one.last().jar_force, 150e3, 20e3);
    EXPECT_EQ(other.last().jar_force, 0);
}

TEST(Jar, IsInNoStretchWithSubsteps) {
    const Pipe half = with_length(drill_pipe, 200);
    Case input = test::case_from(jarred(
        half, half, "up_force = 400e3\nup_travel = 0.2", steady(0), 1,
        "[mesh]\nelement_length = 5\nrefine = [{from = 190, to = 210, element_length = 0.5}]"));
    const auto stretches = [&] { return step_plan(build_scene(input)).stretches; };
    EXPECT_TRUE(stretches().empty());
    input.string.components[1].jar.reset();
    EXPECT_FALSE(stretches().empty());
}

/// A bent, turning string of 120 segments with a jar in the segment of that number; it trips at
/// 0.05 s.
Case turning_string(std::size_t segment) {
    Case input = test::case_from(
        jarred(with_length(drill_pipe, 60), with_length(drill_pipe, 60),
               "up_force = 50e3\nup_travel = 0.1\ndelay = 0.005", "[2e3, 1e3, 60e3]", 0.2,
               "[head]\nrotation = 5\n[mesh]\nsegments = 120\n[initial]\ncurvature = [0, 1e-3, 0]\n"
               "[damping]\nkelvin_voigt = 1e-6\n[output]\ninterval = 0.01\nprofile_interval = 0"));
    JarCase jar = *input.string.components[1].jar;
    input.string.components[1].jar.reset();
    jar.position = static_cast<double>(segment) + 0.5;
    input.string.components[0].jar = jar;
    input.string.components[0].length = 119;
    input.string.components[1].length = 1;
    return input;
}

TEST(Jar, SlidesTheSameOnAnyNumberOfThreads) {
    // last of its block, whose forces the thread of the next block finds, too; and in a block
    for (const std::size_t segment : {15U, 31U, 47U, 63U, 79U, 50U}) {
        Case input = turning_string(segment);
        input.run.threads = 1;
        const test::Run alone = test::run(input);
        EXPECT_GT(first(alone, [](const SeriesRecord& r) { return r.jar_blows > 0; }).time, 0);
        for (const int threads : {2, 3}) {
            input.run.threads = threads;
            const test::Run together = test::run(input);
            EXPECT_EQ(together.end().position, alone.end().position);
            EXPECT_EQ(together.end().stress, alone.end().stress);
            EXPECT_EQ(together.last().jar_travel, alone.last().jar_travel);
            EXPECT_EQ(together.last().jar_force, alone.last().jar_force);
            EXPECT_EQ(together.last().energy.dissipation, alone.last().energy.dissipation);
        }
    }
}

TEST(Jar, GoesOnBitForBitFromTheMiddleOfItsStroke) {
    const Case input = turning_string(47);
    const Scene scene = starting_scene(input);
    const auto whole = make_integrator(scene, integrator_options(input.run));
    const auto left = make_integrator(scene, integrator_options(input.run));
    const auto resumed = make_integrator(scene, integrator_options(input.run));
    constexpr std::int64_t any = 1'000'000;
    const auto advance = [](Integrator& integrator, double from, double to) {
        for (double time = from; time < to + 1e-9; time += 0.01)
            integrator.advance(time, any);
    };
    advance(*whole, 0.01, 0.2);
    advance(*left, 0.01, 0.06);
    left->advance(0.07, 17);
    EXPECT_GT(left->series().jar_travel, 0.005);
    EXPECT_LT(left->series().jar_travel, 0.095);
    resumed->restore(left->save());
    advance(*resumed, 0.07, 0.2);
    const SavedState one = whole->save();
    const SavedState other = resumed->save();
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_EQ(one[i].values, other[i].values) << one[i].name;
    EXPECT_EQ(whole->series().jar_travel, resumed->series().jar_travel);
}

}  // namespace
}  // namespace drillstrand
