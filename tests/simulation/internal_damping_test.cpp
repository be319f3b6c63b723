// The paper's internal damping carries momentum along the string: its power has no sign, but a
// string that is let go must not gain energy by it.
#include <gtest/gtest.h>

#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

class InternalDamping : public testing::TestWithParam<double> {};

/// Lets a pipe go from a shape (twist, bends, 1/m); it may gain 2 % of its energy in a swing.
void expect_no_gain(const Eigen::Vector3d& curvature, double damping) {
    Case input;
    input.gravity = 0;
    Component pipe;
    pipe.length = 100;
    pipe.outer_diameter = 0.0603;
    pipe.inner_diameter = 0.0461;
    pipe.linear_density = 9.3;
    pipe.youngs_modulus = 206e9;
    input.string.components = {pipe};
    input.mesh.segments = 70;
    input.initial.curvature = curvature;
    input.damping.internal = {damping, damping};
    input.run.integrator = IntegratorKind::leapfrog;
    input.run.duration = 10;
    input.run.threads = 1;
    const test::Run result = run(input);
    const double given = result.series.front().energy.stored();
    for (const SeriesRecord& record : result.series)
        ASSERT_LT(record.energy.stored(), 1.02 * given) << "at " << record.time << " s";
}

TEST_P(InternalDamping, NeverMakesATwistedPipeGainEnergy) {
    expect_no_gain({0.01, 0, 0}, GetParam());
}

// Nodes that turn as fast as axial waves once took the pipe past its yield strength in 0.1 s.
TEST_P(InternalDamping, NeverMakesABentPipeGainEnergy) {
    expect_no_gain({0, 0.001, 0}, GetParam());
}

INSTANTIATE_TEST_SUITE_P(OfTenToTenThousandTimesThePapers, InternalDamping,
                         testing::Values(0.1, 1, 10, 100));

}  // namespace
}  // namespace drillstrand::test
