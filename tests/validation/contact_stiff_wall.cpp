// The leapfrog on walls far too stiff for its steps: whatever the user writes, a pipe that drops on
// the wall, slides and rolls stays on the laws that hold whatever the stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "drillstrand/energy_audit.hpp"
#include "validation/contact_pipe.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;
constexpr double level = std::numbers::pi / 2;
constexpr double weight = pipe_mass * 9.81;  // N/m

struct Wall {
    std::string name;
    double normal_stiffness;      // Pa
    double tangential_stiffness;  // Pa
    double normal_damping;        // Pa s
};

// beside 1e6 Pa, 1e5 Pa and 1e4 Pa s, which a step of a millisecond resolves
const Wall walls[] = {
    {"StiffNormally", 1e9, 1e5, 1e4},
    {"StiffTangentially", 1e6, 1e9, 1e4},
    {"Viscous", 1e6, 1e5, 1e8},
    {"StiffBothWays", 1e9, 1e9, 1e4},
    {"StiffBothWaysWithoutDashpot", 1e9, 1e9, 0},
    {"StiffBothWaysAndViscous", 1e9, 1e9, 1e8},
};

class StiffWall : public testing::TestWithParam<Wall> {
  protected:
    static ContactCase contact() {
        ContactCase contact;
        contact.normal_stiffness = GetParam().normal_stiffness;
        contact.tangential_stiffness = GetParam().tangential_stiffness;
        contact.normal_damping = GetParam().normal_damping;
        return contact;
    }
    /// Ten segments of a pipe in a level well.
    static Case level_pipe() {
        Case input = short_pipe(IntegratorKind::leapfrog, level);
        input.mesh.segments = 10;
        input.contact = contact();
        input.output.interval = 0.01;
        input.output.profile_interval = 0.01;
        return input;
    }
};
INSTANTIATE_TEST_SUITE_P(Leapfrog, StiffWall, testing::ValuesIn(walls),
                         [](const auto& instance) { return instance.param.name; });

/// Force of the wall on a node across its normal (N/m).
double friction_of(const Profile& profile, std::size_t node) {
    const double force = profile.contact_force[node].norm();
    const double normal = profile.normal_force[node];
    return std::sqrt(std::max(force * force - normal * normal, 0.0));
}

double energy_residual(const test::Run& run) {
    EnergyAudit audit;
    for (const SeriesRecord& record : run.series)
        audit.add(record.energy);
    return std::abs(audit.residual());
}

/// No wall pulls, and none holds a pipe by more than the cone of friction.
void expect_lawful_forces(const test::Run& run, double friction) {
    for (const Profile& profile : run.profiles) {
        for (std::size_t k = 0; k < profile.normal_force.size(); ++k) {
            EXPECT_GE(profile.normal_force[k], 0);
            EXPECT_LE(friction_of(profile, k),
                      (1 + 1e-6) * friction * profile.normal_force[k] + 1e-6 * weight);
        }
    }
}

TEST_P(StiffWall, BearsAPipeThatDropsOnItByItsWeight) {
    Case input = level_pipe();
    input.run.duration = 3;
    const test::Run result = run(input);
    expect_lawful_forces(result, 0.6);
    EXPECT_LT(energy_residual(result), 0.01);
    double force = 0;
    for (std::size_t i = result.profiles.size() / 2; i < result.profiles.size(); ++i) {
        for (std::size_t k = 0; k < 11; ++k)
            force += (k % 10 == 0 ? 0.05 : 0.1) * result.profiles[i].normal_force[k];
    }
    force /= static_cast<double>(result.profiles.size() - result.profiles.size() / 2);
    EXPECT_NEAR(force, weight, 0.02 * weight);
    // it never comes deeper than a spring without dashpot lets it, or one step's way
    const double drop = std::sqrt(2 * 9.81 * clearance);
    const double spring = weight / GetParam().normal_stiffness +
                          drop * std::sqrt(pipe_mass / GetParam().normal_stiffness);
    const double step = drop * result.last().step_size;
    for (const SeriesRecord& record : result.series)
        EXPECT_LT(record.max_penetration, 1.05 * (spring + step));
}

TEST_P(StiffWall, LetsAPipeGo) {
    Case input = level_pipe();
    input.mesh.segments = 1;  // rigid under loads at its ends
    lay_down(input, level);
    load(
        input, 1, 0.01, [](double t) { return Vector3d(0, 0, t < 0.495 ? 0.0 : -2 * weight); },
        [](double /*time*/) { return Vector3d(Vector3d::Zero()); });
    input.run.duration = 0.55;
    const test::Run result = run(input);
    expect_lawful_forces(result, 0.6);
    EXPECT_EQ(result.end().normal_force.front(), 0);
    // the load rises from 0.49 s and outweighs the pipe from 0.495 s on; the wall springs back
    const double flight = 0.05 + 0.0025;
    const double recoil = weight / std::sqrt(GetParam().normal_stiffness * pipe_mass);
    const double rise = result.profiles.front().position[0].z() - result.end().position[0].z();
    EXPECT_GT(rise, 0.97 * 0.5 * 9.81 * flight * flight);
    EXPECT_LT(rise, 1.03 * 0.5 * 9.81 * flight * flight + recoil * flight);
}

TEST_P(StiffWall, HoldsASlidingPipeByDynamicFriction) {
    Case input = level_pipe();
    lay_down(input, level);
    const double push = 2 * 0.6 * weight;
    load(
        input, 1, 0.01, [push](double t) { return Vector3d(push * smooth_step(t, 0, 0.5), 0, 0); },
        [](double /*time*/) { return Vector3d(Vector3d::Zero()); });
    input.run.duration = 1;
    const test::Run result = run(input);
    expect_lawful_forces(result, 0.6);
    EXPECT_LT(energy_residual(result), 0.01);
    const auto speed = [&](std::size_t i) {
        double sum = 0;
        for (std::size_t k = 0; k < 11; ++k)
            sum += (k % 10 == 0 ? 0.05 : 0.1) * result.profiles.at(i).momentum[k][3] / pipe_mass;
        return sum;
    };
    EXPECT_NEAR((speed(100) - speed(60)) / 0.4, (push - 0.42 * weight) / pipe_mass, 0.02 * 9.81);
    double friction = 0;
    double normal = 0;
    for (std::size_t k = 0; k < 11; ++k) {
        friction += friction_of(result.end(), k);
        normal += result.end().normal_force[k];
    }
    EXPECT_NEAR(friction / normal, 0.42, 1e-6);
}

TEST_P(StiffWall, RollsAPipeAroundAgainstItsSpin) {
    const test::Run result = run(pipe_carried_around(IntegratorKind::leapfrog, contact()));
    const Rolling rolling = rolled_around(result);
    EXPECT_NEAR(rolling.whirled, 2 * std::numbers::pi, 0.02);
    EXPECT_NEAR(rolling.whirled / rolling.spun, pure_rolling(contact()), 0.005 * 1.75);
}

}  // namespace
}  // namespace drillstrand::test
