// The leapfrog stops where a string would have failed or its mesh cannot follow it, and says which
// guard stopped it, where and when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <regex>
#include <string>

#include "drillstrand/error.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double pi = std::numbers::pi;
constexpr double outer = 0.127;
constexpr double inner = 0.1086;
constexpr double modulus = 200e9;
constexpr double second_moment =
    pi / 64 * (outer * outer * outer * outer - inner * inner * inner * inner);
constexpr double area = pi / 4 * (outer * outer - inner * inner);
constexpr double yield = 100e6;
constexpr double full_load = 1.0;  // s

ScalarSchedule slowly(double value) {
    return ScalarSchedule({0, full_load}, {0, value});
}

VectorSchedule slowly(const Eigen::Vector3d& value) {
    return VectorSchedule({0, full_load}, {Eigen::Vector3d::Zero(), value});
}

/// A weightless pipe of 40 m held at its head, loaded at its bit.
Case held_pipe() {
    Case input;
    input.gravity = 0;
    Component pipe;
    pipe.length = 40;
    pipe.outer_diameter = outer;
    pipe.inner_diameter = inner;
    pipe.linear_density = 30;
    pipe.youngs_modulus = modulus;
    pipe.yield_strength = yield;
    input.string.components = {pipe};
    input.mesh.segments = 40;
    input.run.integrator = IntegratorKind::leapfrog;
    input.run.duration = full_load;
    input.run.threads = 1;
    return input;
}

/// What stopped the run; the empty string where it came to its end.
std::string guard_of(const Case& input) {
    try {
        run(input);
    } catch (const GuardError& error) {
        return error.what();
    }
    return "";
}

double number_after(const std::string& text, const std::string& before) {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(before + "([0-9.e+-]+)"))) return NAN;
    return std::stod(match[1]);
}

/// Loads that would bring the fibre to twice the stress limit stop the run half way, but for the
/// vibrations that a ramp of a second excites.
void expect_stop_half_way(const Case& input) {
    const std::string why = guard_of(input);
    EXPECT_THAT(why, AllOf(HasSubstr("the stress in segment"), HasSubstr("m along the string)"),
                           HasSubstr("times the yield strength")));
    EXPECT_NEAR(number_after(why, "t = "), full_load / 2, 0.05 * full_load);
    EXPECT_NEAR(number_after(why, "reached "), input.run.stress_limit,
                0.05 * input.run.stress_limit);
}

TEST(StressGuard, StopsAPullAtTheMultipleOfYield) {
    Case input = held_pipe();
    input.run.stress_limit = 3;
    input.bit.force = slowly(Eigen::Vector3d(0, 0, 2 * 3 * yield * area));
    expect_stop_half_way(input);
}

TEST(StressGuard, StopsATorqueWhereVonMisesSaysThatItYields) {
    Case input = held_pipe();
    input.run.stress_limit = 2;
    const double shear = 2 * 2 * yield / std::sqrt(3);
    input.bit.moment = slowly(Eigen::Vector3d(shear * 2 * second_moment / (outer / 2), 0, 0));
    expect_stop_half_way(input);
}

TEST(StressGuard, StopsABendAtTheOuterFibre) {
    Case input = held_pipe();
    input.string.components[0].length = 10;  // bends slowly enough for the ramp
    input.mesh.segments = 10;
    input.run.stress_limit = 2;
    input.bit.moment = slowly(Eigen::Vector3d(0, 2 * 2 * yield * second_moment / (outer / 2), 0));
    expect_stop_half_way(input);
}

TEST(StressGuard, MeasuresABentPipeFromItsOwnShape) {
    Case input = held_pipe();
    input.string.components[0].curvature = {0, 0.05,
                                            0};  // would be 6 times yield if it were elastic
    input.initial.state = InitialState::stress_free;
    EXPECT_THAT(guard_of(input), IsEmpty());
}

TEST(StressGuard, OfTheWeakestPartOfASegmentCounts) {
    Case input = held_pipe();
    // a short weak piece inside one segment, in the middle of the string
    Component strong = input.string.components[0];
    strong.length = 20.2;
    strong.yield_strength = 100 * yield;
    Component weak = input.string.components[0];
    weak.length = 0.2;
    Component rest = strong;
    rest.length = 40 - strong.length - weak.length;
    input.string.components = {strong, weak, rest};
    input.bit.force = slowly(Eigen::Vector3d(0, 0, 2 * 5 * yield * area));
    EXPECT_THAT(guard_of(input), HasSubstr("the stress in segment 20 (20.5 m along the string)"));
}

TEST(StressGuard, IsOffWhereTheLimitIsZeroOrThePipeHasNoDiameter) {
    Case input = held_pipe();
    input.bit.force = slowly(Eigen::Vector3d(0, 0, 2 * 5 * yield * area));
    EXPECT_THAT(guard_of(input), HasSubstr("the stress in segment"));
    input.run.stress_limit = 0;
    EXPECT_THAT(guard_of(input), IsEmpty());

    input.run.stress_limit = 5;
    Component& pipe = input.string.components[0];
    pipe.axial_stiffness = modulus * area;
    pipe.shear_stiffness = modulus / 2.6 * area;
    pipe.bending_stiffness = modulus * second_moment;
    pipe.torsional_stiffness = modulus / 2.6 * 2 * second_moment;
    pipe.inertia = pipe.linear_density * second_moment / area;
    pipe.outer_diameter = 0;
    pipe.inner_diameter = 0;
    EXPECT_THAT(guard_of(input), IsEmpty());
}

TEST(TurnGuard, StopsASegmentBentPastARightAngle) {
    Case input = held_pipe();
    input.mesh.segments = 4;
    input.run.stress_limit = 0;
    // at rest under this couple a segment of 10 m turns by two right angles
    input.bit.moment = slowly(Eigen::Vector3d(0, pi * modulus * second_moment / 10, 0));
    EXPECT_THAT(guard_of(input),
                testing::MatchesRegex("segment 3 \\(35.0 m along the string\\) turned past 90 "
                                      "degrees at t = 0.[0-9]+ s: the mesh is too coarse for this "
                                      "motion; use more segments"));
}

TEST(BuckleGuard, StopsWhereTheHelixIsShorterThanTwoSegments) {
    Case input = held_pipe();
    input.mesh.segments = 8;
    const double h = 5;
    // half of the load makes the pitch sqrt(8 pi^2 EI / F) two segments long
    const double limit = 8 * pi * pi * modulus * second_moment / (4 * h * h);
    input.string.components[0].yield_strength = 900e6;
    input.bit.weight = slowly(2 * limit);
    const std::string why = guard_of(input);
    EXPECT_THAT(why, AllOf(HasSubstr("the mesh is too coarse for the buckle"),
                           HasSubstr("m along the string) bears a compression of"),
                           HasSubstr("use segments of at most 1.2 m")));
    EXPECT_NEAR(number_after(why, "t = "), full_load / 2, 0.05 * full_load);
    EXPECT_NEAR(number_after(why, "compression of "), limit / 1000, 0.05 * limit / 1000);
}

std::vector<std::string> warnings_of(const Case& input) {
    const Scene scene = build_scene(input);
    IntegratorOptions options;
    options.kind = IntegratorKind::leapfrog;
    const auto integrator = make_integrator(scene, options);
    integrator->advance(input.run.duration, std::numeric_limits<std::int64_t>::max());
    return integrator->warnings();
}

TEST(BuckleGuard, WarnsWhereAHelixHasFewerThanEightSegments) {
    Case input = held_pipe();
    input.mesh.segments = 8;  // 5 m
    const auto load = [](double pitch) {
        return slowly(8 * pi * pi * modulus * second_moment / (pitch * pitch));
    };
    input.bit.weight = load(5 * 8 * 1.1);
    EXPECT_THAT(warnings_of(input), IsEmpty());
    input.bit.weight = load(5 * 8 / 1.1);
    input.run.duration = 1.2 * full_load;  // guards look every few steps only
    EXPECT_THAT(warnings_of(input), testing::ElementsAre(AllOf(
                                        HasSubstr("the mesh resolves the buckle poorly: at t = "),
                                        HasSubstr("m along the string) bore a compression of"),
                                        HasSubstr("use segments of at most 4.5 m"))));
}

TEST(Guards, SayTheSameOnAnyNumberOfThreads) {
    Case input = held_pipe();
    input.mesh.segments = 60;
    input.bit.force = slowly(Eigen::Vector3d(0, 0, 2 * 5 * yield * area));
    const std::string alone = guard_of(input);
    EXPECT_THAT(alone, HasSubstr("the stress in segment"));
    for (const int threads : {2, 3}) {
        input.run.threads = threads;
        EXPECT_EQ(guard_of(input), alone);
    }
}

TEST(Guards, AreNoExcuseForALoadThatRunsAway) {
    Case input = held_pipe();
    input.bit.force = VectorSchedule({0.5, 0.6}, {Eigen::Vector3d::Zero(),  //
                                                  Eigen::Vector3d(1e300, 0, 0)});
    for (const int threads : {1, 3}) {
        input.run.threads = threads;
        try {
            run(input);
            FAIL() << "no failure";
        } catch (const GuardError& error) {
            FAIL() << error.what();
        } catch (const SimulationError& error) {
            EXPECT_THAT(error.what(), HasSubstr("the solution diverged near node 40, 40.0 m along "
                                                "the string, at t = 0.50"));
        }
    }
}

}  // namespace
}  // namespace drillstrand::test
