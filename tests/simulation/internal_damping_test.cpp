// The paper's internal damping carries momentum along the string: its power has no sign, but a
// string that is let go must not gain energy by it.
#include <gtest/gtest.h>

#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

class InternalDamping : public testing::TestWithParam<double> {};

TEST_P(InternalDamping, NeverMakesATwistedPipeGainEnergy) {
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
    input.initial.curvature = {0.01, 0, 0};
    input.damping.internal = {GetParam(), GetParam()};
    input.run.integrator = IntegratorKind::leapfrog;
    input.run.duration = 10;
    input.run.threads = 1;
    const test::Run result = run(input);
    const double given = result.series.front().energy.stored();
    for (const SeriesRecord& record : result.series)
        ASSERT_LT(record.energy.stored(), 1.02 * given) << "at " << record.time << " s";
}

INSTANTIATE_TEST_SUITE_P(OfTenToTenThousandTimesThePapers, InternalDamping,
                         testing::Values(0.1, 1, 10, 100));

}  // namespace
}  // namespace drillstrand::test
