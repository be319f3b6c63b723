// The leapfrog tells the time error of its steps, and shortens them where a tolerance asks for it.
#include "integrators/time_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "drillstrand/simulation.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

/// A cantilever of 24 m let go from level, or, with a well, a pipe that falls on its low side.
Case falling_string(bool in_a_well) {
    Case input;
    Component pipe;
    pipe.length = 24;
    pipe.outer_diameter = 0.14;
    pipe.inner_diameter = 0.12;
    pipe.linear_density = 31.8557;
    pipe.youngs_modulus = 200e9;
    input.string.components = {pipe};
    input.mesh.segments = 16;
    input.head.direction = Eigen::Vector3d(1, 0, 0);
    if (in_a_well) {
        input.well = WellCase{{{0, 1.2, 0}, {100, 1.2, 0}}, {{100, 0.2}}};
        input.head.direction.reset();
        input.head.rotation = 10.0;
    }
    input.run.duration = 0.2;
    return input;
}

std::unique_ptr<Integrator> leapfrog(const Scene& scene, double cfl, double tolerance = 0) {
    IntegratorOptions options;
    options.cfl = cfl;
    options.tolerance = tolerance;
    return make_integrator(scene, options);
}

TEST(TimeError, IsTheDistanceToARunInTinySteps) {
    const Scene scene = build_scene(falling_string(false));
    // sixteen steps of cfl 0.8, then of a fortieth of that
    const auto run = leapfrog(scene, 0.8);
    run->advance(0.1, TimeErrorControl::window);
    const auto exact = leapfrog(scene, 0.02);
    exact->advance(run->time(), std::numeric_limits<std::int64_t>::max());
    const Profile end = exact->profile();
    const double error =
        std::sqrt(rod_energy_between(scene, run->profile(), end) / rod_energy(scene, end));
    EXPECT_GT(error, 1e-5);
    EXPECT_NEAR(run->series().time_error, error, 0.05 * error);
}

TEST(TimeError, OfAStringAtRestIsNone) {
    Case input = falling_string(false);
    input.gravity = 0;
    const Scene scene = build_scene(input);
    const auto run = leapfrog(scene, 0.9);
    run->advance(0.1, 1000);
    EXPECT_LT(run->statistics().time_error, 1e-3);
}

TEST(TimeError, WatchingItLeavesNoTrace) {
    // the sample after 32 steps comes before, within or after a call
    const Scene scene = build_scene(falling_string(true));
    for (const double tolerance : {0.0, 1e-3}) {
        const auto whole = leapfrog(scene, 0.9, tolerance);
        whole->advance(0.2, std::numeric_limits<std::int64_t>::max());
        const auto pieces = leapfrog(scene, 0.9, tolerance);
        while (pieces->time() < 0.2)
            pieces->advance(0.2, 7);
        EXPECT_EQ(whole->statistics().steps, pieces->statistics().steps);
        EXPECT_EQ(whole->profile().position, pieces->profile().position);
        EXPECT_EQ(whole->profile().stress, pieces->profile().stress);
        EXPECT_EQ(whole->series().energy.dissipation, pieces->series().energy.dissipation);
    }
}

TEST(TimeError, IsKeptBelowAToleranceByShorterSteps) {
    const Scene scene = build_scene(falling_string(true));
    const auto free = leapfrog(scene, 0.9);
    const auto held = leapfrog(scene, 0.9, 1e-3);
    for (const auto& run : {free.get(), held.get()})
        run->advance(0.2, std::numeric_limits<std::int64_t>::max());
    EXPECT_GT(free->statistics().time_error, 2e-3);
    EXPECT_LE(held->statistics().time_error, 1e-3);
    EXPECT_GT(held->statistics().steps, free->statistics().steps);
    EXPECT_THAT(held->warnings(), testing::IsEmpty());
}

TEST(TimeError, ThatCannotBeKeptIsTold) {
    const Scene scene = build_scene(falling_string(true));
    const auto run = leapfrog(scene, 0.9, 1e-12);
    run->advance(0.01, std::numeric_limits<std::int64_t>::max());
    EXPECT_THAT(run->warnings(), testing::Contains(testing::HasSubstr("above run.tolerance")));
}

}  // namespace
}  // namespace drillstrand::test
