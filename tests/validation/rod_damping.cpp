// External damping of a free pipe: translation and rotation, each by its own coefficient.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/rod_cases.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;

using ExternalDamping = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, ExternalDamping, both_integrators, integrator_name);

constexpr double mass = 34.2277;  // kg/m, table 2
constexpr double spin_inertia =   // rho Ip (kg m)
    mass * (0.1397 * 0.1397 + 0.1155 * 0.1155) / 8;
constexpr double length = 24;  // m

/// Speed along East and spin, each over what it is where nothing damps.
struct Kept {
    double speed, spin;
};

/// Of a pipe in free space that a push across it and a couple about it bring to 1 m/s and 10 rad/s
/// within 0.1 s, a second later.
Kept kept_after_a_second(IntegratorKind integrator, const DampingPair& damping) {
    Case input =
        case_from("gravity = 0\n" + table_2_pipe(length) + mesh_and_run(integrator, 4, true, 1.1) +
                  "[head]\nmotion = \"free\"\n[output]\nprofile_interval = 0.1\n");
    input.damping.external = damping;
    // as on every part of the pipe, so that it moves as one: half a segment at each end
    const auto pulse = [](double peak, const Vector3d& direction) {
        return VectorSchedule({0, 0.05, 0.1},
                              {Vector3d::Zero(), peak * direction, Vector3d::Zero()});
    };
    input.mesh.segments = 1;
    const double push = mass * length * 1 / 0.05 / 2;
    const double turn = spin_inertia * length * 10 / 0.05 / 2;
    input.head.force = input.bit.force = pulse(push, Vector3d::UnitY());
    input.head.moment = input.bit.dead_moment = pulse(turn, Vector3d::UnitZ());
    const Run result = run(input);
    const Profile& start = result.profiles.at(1);
    const Vector6& before = start.momentum.front();
    const Vector6& after = result.end().momentum.front();
    EXPECT_NEAR(result.end().time - start.time, 1, 1e-9);
    return {after.tail<3>().norm() / before.tail<3>().norm(), after[0] / before[0]};
}

TEST_P(ExternalDamping, OfRotationBrakesTheSpinAloneByAnExponential) {
    const double damping = 0.7 * spin_inertia;
    const Kept kept = kept_after_a_second(integrator(), {0, damping});
    EXPECT_NEAR(kept.spin, std::exp(-0.7), 2e-3);
    EXPECT_NEAR(kept.speed, 1, 1e-6);
}

TEST_P(ExternalDamping, OfTranslationBrakesTheSpeedAloneByAnExponential) {
    const Kept kept = kept_after_a_second(integrator(), {0.7 * mass, 0});
    EXPECT_NEAR(kept.speed, std::exp(-0.7), 2e-3);
    EXPECT_NEAR(kept.spin, 1, 1e-6);
}

}  // namespace
}  // namespace drillstrand::test
