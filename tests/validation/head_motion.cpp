// Heads that move, and pinned ones: exact motions, frequencies of beams, energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "drillstrand/equilibrium.hpp"
#include "validation/rod_cases.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using namespace test;

using HeadInMotion = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, HeadInMotion, both_integrators, integrator_name);
using PinnedHead = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, PinnedHead, both_integrators, integrator_name);

double residual(const EnergyAccount& energy) {
    return energy.stored() + energy.dissipation - energy.work;
}

TEST_P(HeadInMotion, InASteadyScrewLeavesAFreeStringWithoutStress) {
    const test::Run result =
        run("gravity = 0\n" + table_2_pipe() + mesh_and_run(integrator(), 8, true, 3) + R"(
[head]
direction = [0.6, 0, 0.8]
velocity = [[0, [0, 0, 0]], [0.5, [0.4, 0, 0]]]
rotation = [[0, 0], [0.5, 5]]
[damping]
kelvin_voigt = 2e-3
[output]
interval = 0.5
)");
    EXPECT_LT(largest_stress(result.end()), 1e-6 * table_2_axial_stiffness * 1e-3);
    for (const SeriesRecord& record : result.series) {
        if (record.time < 1) continue;
        const Vector3d way = 0.4 * (record.time - 0.25) * Vector3d(0.6, 0, 0.8);
        EXPECT_LT((record.head_position - way).norm(), 1e-9);
        EXPECT_LT((record.bit_position - way - 24 * Vector3d(0.6, 0, 0.8)).norm(), 1e-5);
    }
    const SeriesRecord& last = result.last();
    EXPECT_NEAR(last.bit_rotation_rate, 5, 1e-6);
    EXPECT_NEAR(residual(last.energy), 0, 1e-3 * last.energy.work);
}

/// Where constant velocities take the head in a time: x = R(t) integral, by the exponential map.
Vector3d screwed(const Vector3d& w, const Vector3d& v, double time) {
    const double rate = w.norm();
    const Vector3d axis = w / rate;
    const double angle = rate * time;
    const Vector3d along = axis.dot(v) * axis;
    const Vector3d across = v - along;
    return time * along + std::sin(angle) / rate * across +
           (1 - std::cos(angle)) / rate * axis.cross(across);
}

TEST_P(HeadInMotion, InAllComponentsFollowsItsOwnFrame) {
    // components about and along d3, d1, d2; d3 is down, d1 east, d2 = d3 x d1 south
    const Vector3d w(0.5, 0.3, -0.4);
    const Vector3d v(0.2, 0.1, 0.3);
    Eigen::Matrix3d frame;
    frame << Vector3d::UnitZ(), Vector3d::UnitY(), -Vector3d::UnitX();
    const test::Run result =
        run("gravity = 0\n" + table_2_pipe() + mesh_and_run(integrator(), 8, true, 1.5) +
            fmt::format("[head]\nangular_velocity = {}\nvelocity = {}\n"
                        "[output]\ninterval = 0.1\n",
                        list(w), list(v)));
    for (const SeriesRecord& record : result.series)
        EXPECT_LT((record.head_position - frame * screwed(w, v, record.time)).norm(), 1e-9);
    const Vector3d turned =
        frame * (Eigen::AngleAxisd(1.5 * w.norm(), w.normalized()) * Vector3d::UnitX());
    EXPECT_LT((result.end().director.front() - turned).norm(), 1e-9);
    EXPECT_NEAR(residual(result.last().energy), 0, 5e-3 * result.last().energy.work);
}

TEST(MovedHead, GivesBothIntegratorsOneMotionOfTheBit) {
    const auto bit = [](IntegratorKind integrator, int segments) {
        const test::Run result =
            run(table_2_pipe() + mesh_and_run(integrator, segments, true, 1.5) + R"(
[head]
angular_velocity = [[0, [0, 0, 0]], [0.5, [1, 0.2, -0.1]], [1, [0, -0.2, 0]]]
velocity = [[0, [0, 0, 0]], [0.5, [0.5, 1, 0]], [1, [-0.5, 0, 1]]]
)");
        return result.last().bit_position;
    };
    const Vector3d leapfrog = bit(IntegratorKind::leapfrog, 32);
    const double coarse = (bit(IntegratorKind::dormand_prince, 8) - leapfrog).norm();
    const double fine = (bit(IntegratorKind::dormand_prince, 16) - leapfrog).norm();
    EXPECT_LT(fine, 0.02);
    EXPECT_LT(fine, 0.35 * coarse);
}

TEST_P(HeadInMotion, DoesTheWorkThatLiftsAString) {
    // up by 2 m in 4 s, and at rest again
    const test::Run result = run(table_3_pipe(200) + mesh_and_run(integrator(), 10, true, 8) + R"(
[head]
velocity = [[0, [0, 0, 0]], [1, [-0.6666666666666666, 0, 0]], [3, [-0.6666666666666666, 0, 0]], [4, [0, 0, 0]]]
rotation = [[0, 0], [1, 3]]
[damping]
kelvin_voigt = 5e-3
[initial]
state = "coaxial"
[output]
interval = 1
)");
    const SeriesRecord& last = result.last();
    const double weight = 31.8557 * 9.80665 * 200;
    EXPECT_NEAR(last.head_position.z(), -2, 1e-9);
    // the string was let go unstretched
    const double sag = weight * 100 / (200e9 * pi / 4 * (0.14 * 0.14 - 0.12 * 0.12));
    EXPECT_NEAR(last.energy.potential, weight * (2 - sag * 2 / 3), 0.01 * weight * 2);
    EXPECT_NEAR(last.hook_load, weight, 1e-3 * weight);
    EXPECT_NEAR(residual(last.energy), 0, 2e-3 * last.energy.work);
}

TEST(MovedHead, TripsAStringAgainstTheFrictionThatStaticsHave) {
    // a real string in a well that lies for most of its length, mud that does not drag
    Case input =
        read_case(std::filesystem::path(DRILLSTRAND_SOURCE_DIR) / "cases" / "connection.toml");
    input.fluid->drag = false;
    input.bit = {};
    input.bit.direction = BitDirection::well;
    input.run.duration = 25;
    for (const double speed : {-0.2, 0.2}) {
        input.head = HeadCase{};
        input.head.velocity = {{0, 2}, {{0, 0, 0}, {speed, 0, 0}}};
        double load = 0;
        int count = 0;
        for (const SeriesRecord& record : run(input).series) {
            if (record.time <= 15) continue;
            load += record.hook_load;
            ++count;
        }
        EquilibriumOptions tripping;
        tripping.motion = {speed, 0};
        tripping.bit_loads = false;
        const Scene scene = build_static_scene(input);
        const double statics = find_equilibrium(scene, tripping).hook_load;
        tripping.motion = {};
        const double friction = statics - find_equilibrium(scene, tripping).hook_load;
        EXPECT_NEAR(load / count, statics, 0.015 * std::abs(friction)) << speed;
    }
}

/// Frequency (rad/s) of a signal about zero, from its first to its last crossing upward.
double frequency_of(const std::vector<double>& signal, double step) {
    double first = -1;
    double last = 0;
    int periods = -1;
    for (std::size_t i = 1; i < signal.size(); ++i) {
        if (!(signal[i - 1] < 0 && signal[i] >= 0)) continue;
        const double part = signal[i - 1] / (signal[i - 1] - signal[i]);
        last = (static_cast<double>(i - 1) + part) * step;
        if (first < 0) first = last;
        ++periods;
    }
    return 2 * pi * periods / (last - first);
}

/// Rate (rad/s) at which 3 m of pipe swing, and the energy that gets lost on the way.
double pendulum_rate(IntegratorKind integrator, int segments) {
    const test::Run result = run(table_2_pipe(3) + mesh_and_run(integrator, segments, true, 12) +
                                 R"(
[head]
motion = "pinned"
direction = [0.01, 0, 1]
[output]
interval = 0.01
)");
    std::vector<double> swing;
    double kinetic = 0;
    for (const SeriesRecord& record : result.series) {
        swing.push_back(record.bit_position.x());
        kinetic = std::max(kinetic, record.energy.kinetic);
    }
    EXPECT_NEAR(*std::max_element(swing.begin(), swing.end()), 0.03, 1e-5);
    EXPECT_NEAR(residual(result.last().energy), 0, 1e-3 * kinetic);
    EXPECT_LT(result.last().head_position.norm(), 1e-12);
    return frequency_of(swing, 0.01);
}

TEST_P(PinnedHead, LetsAStiffPipeSwingAsAPendulum) {
    // m g L/2 over m (L^2/3 + I/A); it bends by less than 1e-4 under its own weight
    const double gyration2 = (0.1397 * 0.1397 + 0.1155 * 0.1155) / 16;
    const double exact = std::sqrt(9.80665 * 1.5 / (3 + gyration2));
    const double coarse = pendulum_rate(integrator(), 4) / exact - 1;
    const double fine = pendulum_rate(integrator(), 8) / exact - 1;
    EXPECT_LT(std::abs(fine), is_leapfrog() ? 2e-3 : 8e-3);
    EXPECT_NEAR(fine + (fine - coarse) / 3, 0, 5e-4);
}

/// A head that tilts under a torque is an end that flutters: one as light as its section gave
/// energy until, after 70 s, it had turned past 90 degrees.
TEST(PinnedHeadThatTurns, GivesNoEnergyWithoutDamping) {
    Case input = case_from(R"(
[[string.component]]
length = 300
outer_diameter = 0.1397
inner_diameter = 0.1214
linear_density = 29.5
youngs_modulus = "206 GPa"
[fluid]
density = 1733
viscosity = 0.02
[mesh]
segments = 60
[head]
motion = "pinned"
rotation = [[1, 0], [5, 2.85]]
[bit]
weight = [[5, 0], [7.5, "200 kN"]]
torque = "10 kN m"
[contact]
static_friction = 0.28
dynamic_friction = 0.22
normal_stiffness = 1e8
tangential_stiffness = 1e8
restitution = 0.5
[run]
duration = 80
)");
    WellCase well;
    const double degree = pi / 180;
    well.survey = {{0, 0, 267 * degree},
                   {90, 0, 267 * degree},
                   {200, 7 * degree, 261 * degree},
                   {400, 22 * degree, 253 * degree}};
    well.sections = {{400, 0.1757}};
    input.well = well;
    input.bit.direction = BitDirection::well;
    input.initial.state = InitialState::coaxial;
    const test::Run result = run(input);
    const EnergyAccount& energy = result.last().energy;
    const double gained = energy.stored() - result.series.front().energy.stored();
    EXPECT_NEAR(gained + energy.dissipation - energy.work, 0, 1e-3 * energy.dissipation);
}

TEST(PinnedHeadAtRest, HangsInEquilibriumAlongTheForceOnItsBit) {
    // a heavy pipe pulled aside at its lower end by H: a catenary's slope H/(w L) at the bit end,
    // moments about the pin: H z = integral of the weight's arms
    const Case input = case_from(table_2_pipe(100) + "[mesh]\nsegments = 50\n" + R"(
[head]
motion = "pinned"
[bit]
force = [3000, 0, 0]
[run]
duration = 1
)");
    const Scene scene = build_static_scene(input);
    const Equilibrium found = find_equilibrium(scene);
    const std::vector<Vector3d>& x = found.nodes.position;
    double about_pin = 3000 * x.back().z();
    for (std::size_t k = 0; k < x.size(); ++k)
        about_pin -= scene.mesh.cell[k] * scene.weight[k] * x[k].x();
    EXPECT_NEAR(about_pin, 0, 1e-6 * 3000 * 100);
    EXPECT_GT(x.back().x(), 5);
    EXPECT_TRUE(found.stable);
    // no couple at the pin
    EXPECT_LT(found.series.head_stress.segment<2>(1).norm(),
              0.1 * found.profile.stress[10].segment<2>(1).norm());
}

TEST(PinnedHeadAtRest, StaysWhereStaticsLeaveIt) {
    Case input = case_from(table_2_pipe(60) + "[mesh]\nsegments = 30\n" + R"(
[head]
motion = "pinned"
[run]
duration = 2
)");
    WellCase well;
    well.survey = {{0, 0, 0}, {40, 0.2, 0.5}, {100, 0.6, 1}};
    well.sections = {{100, 0.25}};
    input.well = well;
    input.initial.state = InitialState::equilibrium;
    const test::Run result = run(input);
    EXPECT_LT((result.last().bit_position - result.series.front().bit_position).norm(), 1e-7);
    EXPECT_LT(result.last().energy.kinetic, 1e-9);
}

}  // namespace
}  // namespace drillstrand
