// The energy of a string that rubs, rebounds and stirs the mud in a bent well.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drillstrand/energy_audit.hpp"
#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Energy = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, Energy, both_integrators, integrator_name);

/// 60 m of pipe in a well that bends by 30 degrees, let go and turned at the head.
Case rubbing_string(IntegratorKind integrator, int segments) {
    Case input = short_pipe(integrator, 0);
    input.well->survey = {{0, 0.6, 0}, {20, 0.6, 0}, {60, 1.1, 0.3}, {100, 1.1, 0.3}};
    input.well->sections.front().to = 100;
    FluidCase mud;
    mud.density = 1200;
    mud.viscosity = 0.1;
    input.fluid = mud;
    input.string.components.front().length = 60;
    input.mesh.segments = segments;
    input.head.motion = HeadMotion::driven;
    input.head.rotation = ScalarSchedule({0, 0.5}, {0, 10});
    input.contact.normal_stiffness = 1e6;
    input.contact.normal_damping = 1e3;
    input.contact.tangential_stiffness = 1e5;
    input.run.duration = 1.5;
    input.output.interval = 0.01;
    return input;
}

struct Account {
    double residual = 0;
    double dissipation = 0;
    double largest_return = 0;  ///< of dissipated energy from one record to the next (J)
};

Account account_of(const Case& input) {
    EnergyAudit audit;
    Account account;
    const test::Run result = run(input);
    double before = 0;
    for (const SeriesRecord& record : result.series) {
        audit.add(record.energy);
        account.largest_return =
            std::max(account.largest_return, before - record.energy.dissipation);
        before = record.energy.dissipation;
    }
    EXPECT_GT(result.last().contact_nodes, input.mesh.segments / 5);
    account.dissipation = before;
    account.residual = audit.residual();
    return account;
}

TEST_P(Energy, OfARubbingStringIsAccountedForAndDissipationOnlyGrows) {
    const Account account = account_of(rubbing_string(integrator(), 15));
    EXPECT_GT(account.dissipation, 100);
    EXPECT_LT(account.largest_return, 1e-6 * account.dissipation);
    EXPECT_LT(std::abs(account.residual), 2e-3);
}

// Momenta are those of the strains' rate, poses those of the strains: over a bent segment they
// differ by a part that falls with the square of its length.
TEST(Energy, ResidualOfTheRodOfArcsFallsWithTheSquareOfItsSegments) {
    const auto residual = [](int segments) {
        Case input = rubbing_string(IntegratorKind::dormand_prince, segments);
        input.fluid->added_mass = false;  // follows the place once a step, an error of its own
        return std::abs(account_of(input).residual);
    };
    EXPECT_LT(residual(30), 0.35 * residual(15));
}

TEST(Energy, ResidualOfTheLeapfrogIsSmallAndFallsWithItsStep) {
    const auto residual = [](double cfl) {
        Case input = rubbing_string(IntegratorKind::leapfrog, 60);
        // across the well in the steps, across the pipe in the account: hides less than 1e-4
        input.fluid->added_mass = false;
        input.run.cfl = cfl;
        return std::abs(account_of(input).residual);
    };
    EXPECT_LT(residual(0.9), 2e-5);
    EXPECT_LT(residual(0.45), 0.55 * residual(0.9));
}

/// A string that bounces without friction and mud: only the impacts change its energy.
test::Run bouncing_string(double stiffness, double restitution, double cfl) {
    Case input = rubbing_string(IntegratorKind::leapfrog, 30);
    input.fluid.reset();
    input.contact.static_friction = input.contact.dynamic_friction = {0, 0};
    input.contact.normal_stiffness = stiffness;
    input.contact.restitution = restitution;
    input.run.cfl = cfl;
    return run(input);
}

// An impact that displaced the string, or springs that gave what they never took, would drive it.
// (For some steps after the first impacts a record may show more: in the highest modes of the mesh
// the leapfrog's energy swings.)
TEST(Energy, OfAStringThatBouncesOffStiffWallsOnlyFalls) {
    for (const double stiffness : {1e6, 1e8}) {
        for (const double restitution : {0.5, 0.95, 1.0}) {
            const test::Run result = bouncing_string(stiffness, restitution, RunCase().cfl);
            const double given = result.series.front().energy.stored();
            for (const SeriesRecord& record : result.series) {
                if (record.time < 0.5) continue;
                ASSERT_LT(record.energy.stored(), given + record.energy.work)
                    << stiffness << " Pa, " << restitution << ", t = " << record.time;
            }
            EXPECT_GT(result.last().impacts, 100);
        }
    }
}

// The account counts what half steps keep (it would be off by 8 % without), and errs by the loss in
// an impact, within whose step the rod's force jumps.
TEST(Energy, ResidualOfAStringThatBouncesIsSmallAndFallsWithItsStep) {
    const auto residual = [](double cfl) {
        EnergyAudit audit;
        const test::Run result = bouncing_string(1e6, 0.95, cfl);
        for (const SeriesRecord& record : result.series)
            audit.add(record.energy);
        return std::abs(audit.residual());
    };
    EXPECT_LT(residual(0.9), 1e-3);
    EXPECT_LT(residual(0.3), 0.35 * residual(0.9));
}

/// A weightless flywheel of a pipe: a push of 0.1 s spins it to 20 rad/s and sends it along the
/// wall, against the sense of its spin. Half a second later friction has brought it to roll.
test::Run rolling_flywheel(IntegratorKind integrator, FrictionLaw law) {
    Case input = short_pipe(integrator, 0);
    input.gravity = 0;
    input.string.components.front().polar_inertia = 10;
    input.contact.law = law;
    input.contact.tangential_stiffness = 1e4;
    input.initial.offset = clearance * Eigen::Vector3d::UnitX();
    const auto peak = [](double t) { return std::abs(t - 0.05) < 1e-6 ? 1 / 0.05 : 0.0; };
    load(
        input, 0.1, 0.05,
        [peak](double t) { return Eigen::Vector3d(0, -pipe_mass * 0.5 * peak(t), 0); },
        [peak](double t) { return Eigen::Vector3d(0, 0, 10 * 20 * peak(t)); });
    input.run.duration = 0.6;
    input.output.interval = 0.01;
    return run(input);
}

TEST_P(Energy, OfAPipeThatRollsUnderCoulombsLawOnlyFalls) {
    const test::Run result = rolling_flywheel(integrator(), FrictionLaw::coulomb);
    const double given = result.last().energy.work;
    EXPECT_NEAR(given, 20e3, 100);
    EXPECT_GT(result.last().energy.dissipation, 0);
    EXPECT_LT(result.last().energy.stored(), given);
}

// Why contact.law = "paper" is for comparison only: its azimuthal spring does not see that the pipe
// already rolls, and pushes on.
TEST_P(Energy, OfAPipeThatRollsUnderThePapersLawGrowsFromNothing) {
    const test::Run result = rolling_flywheel(integrator(), FrictionLaw::paper);
    const double given = result.last().energy.work;
    EXPECT_NEAR(given, 20e3, 100);
    EXPECT_GT(result.last().energy.stored(), 2 * given);
    EXPECT_LT(result.last().energy.dissipation, -given);
}

}  // namespace
}  // namespace drillstrand::test
