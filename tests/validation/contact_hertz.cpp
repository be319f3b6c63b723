// Hertz's wall with Hunt and Crossley's damping (contact.normal_law = "hertz"): impacts, rest,
// friction and energy against what the law says exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drillstrand/energy_audit.hpp"
#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;
constexpr double degree = std::numbers::pi / 180;
constexpr double g = 9.81;

ContactCase hertz_wall(double stiffness, double hunt_crossley) {
    ContactCase contact;
    contact.normal_law = NormalLaw::hertz;
    contact.normal_stiffness = stiffness;
    contact.hunt_crossley = hunt_crossley;
    contact.static_friction = contact.dynamic_friction = {0, 0};
    return contact;
}

// ------------------------------------------------------------------ impact

/// A thrown pipe that ends its flight well after the impact.
Case pipe_thrown_at(const ContactCase& contact, double speed, double cfl) {
    Case input = thrown_pipe(IntegratorKind::leapfrog, speed);
    constexpr double start = -0.03;  // m east of the axis: all of the push before the wall
    input.contact = contact;
    input.initial.offset = start * Vector3d::UnitY();
    input.run.cfl = cfl;
    const double contact_begins = 0.05 + (clearance - start) / speed;
    input.run.duration = contact_begins + 0.05;
    input.output.interval = 0.01;
    input.output.profile_interval = input.run.duration;
    return input;
}

/// Speed after the impact over speed before.
double restitution(const ContactCase& contact, double speed, double cfl) {
    const test::Run result = run(pipe_thrown_at(contact, speed, cfl));
    EXPECT_EQ(result.last().contact_nodes, 0);
    return -speed_east(result.end()) / speed;
}

/// Greatest depth of a mass m with the speed v at a wall without damping: m v^2/2 = 2/5 K d^2.5.
double greatest_depth(double stiffness, double speed) {
    return std::pow(1.25 * pipe_mass * speed * speed / stiffness, 0.4);
}

/// Duration of that contact: 2 d/v times the integral of (1 - x^2.5)^-0.5 from 0 to 1.
double contact_time(double stiffness, double speed) {
    return 0.8 * std::beta(0.4, 0.5) * greatest_depth(stiffness, speed) / speed;
}

TEST(HertzsWall, HoldsAThrownPipeForHertzsTimeAndLetsItInToHertzsDepth) {
    EXPECT_NEAR(contact_time(1, 1) / greatest_depth(1, 1), 2.9432, 1e-4);
    for (const double stiffness : {1e7, 1e9}) {
        constexpr double speed = 0.5;
        Case input = pipe_thrown_at(hertz_wall(stiffness, 0), speed, 0.01);
        const double time = contact_time(stiffness, speed);
        input.output.interval = 1e-3 * time;
        const test::Run result = run(input);
        double deepest = 0;
        double touching = 0;
        for (const SeriesRecord& record : result.series) {
            deepest = std::max(deepest, record.max_penetration);
            touching += record.contact_nodes > 0 ? input.output.interval : 0;
        }
        const double depth = greatest_depth(stiffness, speed);
        EXPECT_NEAR(deepest, depth, 1e-3 * depth) << stiffness;
        EXPECT_NEAR(touching, time, 3e-3 * time) << stiffness;
        EXPECT_NEAR(-speed_east(result.end()), speed, 1e-4 * speed) << stiffness;
    }
}

TEST(HertzsWall, KeepsTheEnergyOfAnImpactToTheThirdPowerOfTheStep) {
    // from a quarter of a millisecond on, 15 to 60 steps in contact
    const ContactCase contact = hertz_wall(1e9, 0);
    const auto loss = [&](double cfl) { return 1 - std::pow(restitution(contact, 0.5, cfl), 2); };
    const double coarse = loss(0.2);
    const double fine = loss(0.05);
    EXPECT_LT(coarse, 0.1);
    EXPECT_NEAR(std::log(coarse / fine) / std::log(4), 3, 0.3) << coarse << ", " << fine;
}

// With steps of the run's own choice, about 1 ms for this pipe, whenever within the step it comes.
TEST(HertzsWall, OfAnyStiffnessGivesNoEnergyInAStepOfAnyLength) {
    constexpr double speed = 0.5;
    for (const double stiffness : {1e4, 1e6, 1e8, 1e9, 1e10, 1e12}) {
        const ContactCase contact = hertz_wall(stiffness, 0);
        for (int phase = 0; phase < 10; ++phase) {
            Case input = pipe_thrown_at(contact, speed, RunCase().cfl * (1 - 0.0025 * phase));
            input.run.duration += contact_time(stiffness, speed);
            const test::Run result = run(input);
            const double kept = std::pow(speed_east(result.end()) / speed, 2);
            EXPECT_LT(kept, 1 + 1e-9) << stiffness << " Pa/m^0.5, phase " << phase;
            const double steps = contact_time(stiffness, speed) / result.statistics.largest_step;
            if (steps < 16) continue;
            EXPECT_GT(kept, 0.97) << stiffness << " Pa/m^0.5, phase " << phase;
        }
    }
}

/// Speed w with which Hunt and Crossley's wall returns a mass that came with v, whatever its mass
/// and stiffness: m u du = - K d^1.5 (1 + chi u) dd over the whole contact gives
/// chi v - ln(1 + chi v) = - chi w - ln(1 - chi w).
double hunt_crossley_restitution(double chi, double speed) {
    const double v = chi * speed;
    const double taken = v - std::log1p(v);
    double low = 0;
    double high = 1;
    for (int i = 0; i < 100; ++i) {
        const double w = 0.5 * (low + high);
        (-w - std::log1p(-w) < taken ? low : high) = w;
    }
    return low / v;
}

TEST(HertzsWall, ReturnsAPipeWithHuntAndCrossleysRestitution) {
    // 1 - 2/3 chi v for small speeds
    EXPECT_NEAR(hunt_crossley_restitution(1, 1e-3), 1 - 2e-3 / 3, 1e-6);
    for (const double chi : {0.3, 1.0, 5.0}) {
        for (const double speed : {0.05, 0.3, 1.2}) {
            const double exact = hunt_crossley_restitution(chi, speed);
            EXPECT_NEAR(restitution(hertz_wall(1e8, chi), speed, 2e-3), exact, 2e-3 * exact)
                << chi << " s/m, " << speed << " m/s";
        }
    }
}

TEST(HertzsWall, PullsOnlyWhereTheCaseLetsIt) {
    // what is pushed out of the wall faster than 1/chi would be held back
    const auto pulled = [](bool tension) {
        ContactCase contact = hertz_wall(1e6, 10);
        contact.tension = tension;
        Case input = short_pipe(IntegratorKind::leapfrog, 0);
        input.gravity = 0;
        input.contact = contact;
        input.initial.offset = (clearance + 0.01) * Vector3d::UnitY();
        push_east(input, -pipe_mass * 0.3);
        input.output.interval = 1e-3;
        const test::Run result = run(input);
        double least = 0;
        for (const SeriesRecord& record : result.series)
            least = std::min(least, record.energy.dissipation);
        EXPECT_GE(least, -1e-6);
        return result;
    };
    EXPECT_GT(std::abs(speed_east(pulled(false).end())), std::abs(speed_east(pulled(true).end())));
}

// ------------------------------------------------------------------ rest and friction

TEST(HertzsWall, CarriesAPipeAtTheDepthOfItsWeight) {
    const double level = 90 * degree;
    for (const double stiffness : {1e7, 1e9}) {
        Case input = short_pipe(IntegratorKind::leapfrog, level);
        input.contact = hertz_wall(stiffness, 1);
        const double depth = std::pow(pipe_mass * g / stiffness, 2.0 / 3);
        // it falls the last millimetre, and a damper of its own brings it to rest
        input.initial.offset = (clearance - 1e-3) * low_side(level);
        input.damping.external = {300, 300};
        input.run.duration = 5;
        const test::Run result = run(input);
        EXPECT_NEAR(result.last().max_penetration, depth, 1e-6 * depth);
        EXPECT_NEAR(result.end().normal_force.front(), pipe_mass * g, 1e-6 * pipe_mass * g);
        // and one that lies there stays
        lay_down(input, level);
        input.damping.external = {};
        const test::Run lying = run(input);
        EXPECT_NEAR(lying.last().max_penetration, depth, 1e-9 * depth);
        EXPECT_LT(lying.last().energy.kinetic, 1e-12);
    }
}

TEST(HertzsWall, RubsWithTheNormalForceTimesTheFriction) {
    constexpr double friction = 0.3;
    Case input = short_pipe(IntegratorKind::leapfrog, 45 * degree);
    input.contact = hertz_wall(1e9, 1);
    input.contact.static_friction = input.contact.dynamic_friction = {friction, friction};
    lay_down(input, 45 * degree);
    input.run.duration = 2;
    const double speed = 2 * g * std::sqrt(0.5) * (1 - friction);
    EXPECT_NEAR(run(input).end().momentum.front()[3] / pipe_mass, speed, 1e-3 * speed);
    // let go with slack springs it comes to twice the force that would hold it, at most
    input.contact.static_friction = {2.02, 2.02};
    const test::Run stuck = run(input);
    EXPECT_LT((stuck.end().position.front() - stuck.profiles.front().position.front()).norm(),
              1e-3);
}

TEST(HertzsWall, LetsAPipeRollAroundTheWellWithoutSlip) {
    ContactCase contact = hertz_wall(1e9, 1);
    contact.static_friction = {0.6, 0.6};
    contact.dynamic_friction = {0.42, 0.42};
    const Rolling rolling =
        rolled_around(run(pipe_carried_around(IntegratorKind::leapfrog, contact)));
    EXPECT_NEAR(rolling.whirled, 2 * std::numbers::pi, 0.02);
    EXPECT_NEAR(rolling.whirled / rolling.spun, pure_rolling(contact), 0.005 * 1.75);
}

// ------------------------------------------------------------------ energy

/// 60 m of pipe in a well that bends by 30 degrees, let go and turned at the head.
Case rubbing_string(const ContactCase& contact) {
    Case input = short_pipe(IntegratorKind::leapfrog, 0);
    input.well->survey = {{0, 0.6, 0}, {20, 0.6, 0}, {60, 1.1, 0.3}, {100, 1.1, 0.3}};
    input.well->sections.front().to = 100;
    input.string.components.front().length = 60;
    input.mesh.segments = 30;
    input.head.motion = HeadMotion::driven;
    input.head.rotation = ScalarSchedule({0, 0.5}, {0, 10});
    input.contact = contact;
    input.run.duration = 1.5;
    input.output.interval = 0.01;
    return input;
}

TEST(HertzsWall, OfARubbingStringAccountsForAllEnergy) {
    ContactCase contact = hertz_wall(1e9, 1);
    contact.static_friction = contact.dynamic_friction = {0.4, 0.4};
    Case input = rubbing_string(contact);
    FluidCase mud;
    mud.density = 1200;
    mud.viscosity = 0.1;
    input.fluid = mud;
    const test::Run result = run(input);
    EnergyAudit audit;
    for (const SeriesRecord& record : result.series)
        audit.add(record.energy);
    EXPECT_GT(result.last().contact_nodes, 5);
    EXPECT_GT(result.last().energy.dissipation, 100);
    EXPECT_LT(std::abs(audit.residual()), 1e-3);
}

TEST(HertzsWall, LetsABouncingStringOnlyLoseEnergy) {
    for (const double stiffness : {1e7, 1e9, 1e11}) {
        for (const double chi : {0.0, 1.0}) {
            const test::Run result = run(rubbing_string(hertz_wall(stiffness, chi)));
            const double given = result.series.front().energy.stored();
            EnergyAudit audit;
            for (const SeriesRecord& record : result.series) {
                audit.add(record.energy);
                if (record.time < 0.5) continue;
                ASSERT_LT(record.energy.stored(), given + record.energy.work)
                    << stiffness << " Pa/m^0.5, " << chi << " s/m, t = " << record.time;
            }
            EXPECT_LT(std::abs(audit.residual()), 5e-3) << stiffness << ", " << chi;
            EXPECT_GT(result.last().impacts, 30);
        }
    }
}

TEST(HertzsWall, ThatIsFirmerFurtherDownGivesNoEnergy) {
    for (const auto& [above, below] : {std::pair(1e7, 1e9), std::pair(1e9, 1e7)}) {
        Case input = short_pipe(IntegratorKind::leapfrog, 45 * degree);
        input.contact = hertz_wall(1e7, 0);
        lay_down(input, 45 * degree);
        WellSectionCase first{.to = 12, .diameter = 2 * hole_radius};
        first.normal_stiffness = above;
        WellSectionCase second{.to = 1000, .diameter = 2 * hole_radius};
        second.normal_stiffness = below;
        input.well->sections = {first, second};
        input.run.duration = 2.5;
        input.output.interval = 0.005;
        const test::Run result = run(input);
        EnergyAudit audit;
        double gained = 0;
        double least = result.series.front().energy.stored();
        for (const SeriesRecord& record : result.series) {
            audit.add(record.energy);
            gained = std::max(gained, record.energy.stored() - least);
            least = std::min(least, record.energy.stored());
        }
        const double fallen = pipe_mass * pipe_length * g * std::sqrt(0.5) * 14;
        EXPECT_GT(result.end().position.front().x(), 9);
        EXPECT_LT(gained, 1e-3 * fallen);
        EXPECT_LT(std::abs(audit.appeared()), 1e-4 * fallen);
    }
}

}  // namespace
}  // namespace drillstrand::test
