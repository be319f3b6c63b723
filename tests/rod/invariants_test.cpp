// What holds for every motion of the rod, whatever the mesh.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "drillstrand/energy_audit.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const std::string pipe = R"(
[[string.component]]
length = 24.0
linear_density = 34.2277
outer_diameter = 0.1397
inner_diameter = 0.1155
youngs_modulus = "200 GPa"
)";

/// What holds for both integrators is asked of both.
class Integrators : public testing::TestWithParam<std::string> {
  protected:
    [[nodiscard]] static std::string choice() { return "integrator = \"" + GetParam() + "\"\n"; }
};
using RigidMotion = Integrators;
using Objectivity = Integrators;
using Symmetry = Integrators;

std::string name_of(const testing::TestParamInfo<std::string>& integrator) {
    return integrator.param == "leapfrog" ? "Leapfrog" : "DormandPrince";
}
const auto both = testing::Values("dormand-prince", "leapfrog");
INSTANTIATE_TEST_SUITE_P(By, RigidMotion, both, name_of);
INSTANTIATE_TEST_SUITE_P(By, Objectivity, both, name_of);
INSTANTIATE_TEST_SUITE_P(By, Symmetry, both, name_of);

TEST_P(RigidMotion, StraightRodFallsFreelyWithoutStress) {
    const test::Run run = test::run("gravity = 9.81\n" + pipe + R"(
        [head]
        motion = "free"
        position = [5, -3, 2]
        direction = [0.4, 0.5, -0.7]
        [mesh]
        segments = 20
        segment_inertia = true
        [output]
        profile_interval = 0
        [run]
        duration = 1
        threads = 1
        )" + choice());
    const Profile& start = run.profiles.front();
    const Profile& end = run.end();
    // rounding of strains, or of positions, times a stiffness of 1e9 N; the weight is 8 kN
    EXPECT_LT(test::largest_stress(end), GetParam() == "leapfrog" ? 1e-3 : 1e-5);
    for (std::size_t k = 0; k < end.position.size(); ++k) {
        const Vector3d fall = end.position[k] - start.position[k];
        EXPECT_LT((fall - Vector3d(0, 0, 9.81 / 2)).norm(), 1e-9);
        EXPECT_LT((end.director[k] - start.director[k]).norm(), 1e-12);
    }
}

/// Momentum along and about the axis of a rod that stays straight.
Eigen::Vector2d axial_momentum(const test::Run& run, std::size_t record) {
    Eigen::Vector2d total = Eigen::Vector2d::Zero();
    const std::vector<Vector6>& momentum = run.profiles[record].momentum;
    for (std::size_t k = 0; k < momentum.size(); ++k)
        total += run.cell[k] * Eigen::Vector2d(momentum[k][3], momentum[k][0]);
    return total;
}

TEST_P(RigidMotion, RodStruckAlongItsAxisKeepsTheMomentumOfTheBlow) {
    // a blow of 10 N s and 4 N m s within 2 ms; waves then run to and fro
    const test::Run run = test::run("gravity = 0\n" + pipe + R"(
        [head]
        motion = "free"
        direction = [0, 0, 1]
        force = [[0, [0, 0, 0]], [0.001, [0, 0, 10e3]], [0.002, [0, 0, 0]]]
        moment = [[0, [0, 0, 0]], [0.001, [0, 0, 4e3]], [0.002, [0, 0, 0]]]
        [mesh]
        segments = 50
        [output]
        profile_interval = 0.01
        [run]
        duration = 0.1
        threads = 1
        )" + choice());
    const Eigen::Vector2d after_blow = axial_momentum(run, 1);
    // a fixed step sees the peak of the blow to the square of its length, 1e-4 s
    const double within = GetParam() == "leapfrog" ? 2e-3 : 1e-4;
    EXPECT_NEAR(after_blow[0], 10, 10 * within);
    EXPECT_NEAR(after_blow[1], 4, 4 * within);
    EXPECT_GT(test::largest_stress(run.end()), 100);  // the waves are still there
    for (std::size_t i = 1; i < run.profiles.size(); ++i) {
        const Eigen::Vector2d change = axial_momentum(run, i) - after_blow;
        EXPECT_LT(change.cwiseAbs().maxCoeff(), 1e-12 * after_blow.norm());
    }
}

/// A curved, twisted rod of two components under weight and dead and follower loads, with all
/// vectors of space as schedules of the scene.
Case loaded_rod(int segments, const std::string& integrator) {
    return test::case_from("gravity = 9.81\n" + pipe + R"(
        curvature = [0.02, 0.03, -0.01]
        [[string.component]]
        length = 6.0
        linear_density = 60.0
        outer_diameter = 0.16
        inner_diameter = 0.08
        youngs_modulus = "200 GPa"
        [head]
        direction = [0.8, 0.1, 0.6]
        rotation = [[0, 0], [1, 3]]
        [bit]
        weight = 300
        force = [[0, [0, 0, 0]], [0.5, [900, -700, 200]]]
        dead_moment = [500, 900, -1500]
        moment = [300, -400, 200]
        [damping]
        internal = 0.1
        external = 5
        [initial]
        state = "stress-free"
        [mesh]
        segment_inertia = true
        segments = )" + std::to_string(segments) +
                           "\n[run]\nduration = 0.5\nthreads = 1\n" + integrator +
                           "[output]\nprofile_interval = 0.1\ninterval = 0.1\n");
}

VectorSchedule turned(const VectorSchedule& schedule, const Matrix3d& turn) {
    std::vector<Vector3d> values;
    for (const Vector3d& value : schedule.values())
        values.emplace_back(turn * value);
    return {schedule.times(), values};
}

TEST_P(Objectivity, SceneTurnedInSpaceGivesTheTurnedMotion) {
    const Case input = loaded_rod(20, choice());
    const Scene scene = build_scene(input);
    const test::Run straight = test::run(scene, input.run, input.output);
    double stress = 0;  // the rod starts with none but rounding of its stiffness
    for (const Profile& profile : straight.profiles)
        stress = std::max(stress, test::largest_stress(profile));
    std::mt19937 random(5);
    std::normal_distribution<double> gauss;
    for (int trial = 0; trial < 3; ++trial) {
        const Matrix3d turn =
            Eigen::Quaterniond(gauss(random), gauss(random), gauss(random), gauss(random))
                .normalized()
                .toRotationMatrix();
        const Vector3d shift(30, -20, 10);
        Scene other = scene;
        other.down = turn * scene.down;
        other.head_frame = turn * scene.head_frame;
        other.head_position = turn * scene.head_position + shift;
        for (Vector3d& position : other.initial_nodes.position)
            position = turn * position + shift;
        for (Vector3d& director : other.initial_nodes.director)
            director = turn * director;
        other.bit.force = turned(scene.bit.force, turn);
        other.bit.dead_moment = turned(scene.bit.dead_moment, turn);
        const test::Run found = test::run(other, input.run, input.output);
        ASSERT_EQ(found.profiles.size(), straight.profiles.size());
        for (std::size_t i = 0; i < found.profiles.size(); ++i) {
            const Profile& a = straight.profiles[i];
            const Profile& b = found.profiles[i];
            for (std::size_t k = 0; k < a.position.size(); ++k) {
                EXPECT_LT((b.position[k] - turn * a.position[k] - shift).norm(), 1e-9);
                EXPECT_LT((b.director[k] - turn * a.director[k]).norm(), 1e-9);
            }
            // the fastest modes ride at the limit of stability, where rounding grows up to the
            // tolerance of a step (1e-5)
            for (std::size_t k = 0; k < a.stress.size(); ++k) {
                EXPECT_LE((b.stress[k] - a.stress[k]).norm(), 1e-5 * stress);
            }
        }
    }
}

TEST_P(Symmetry, MirroredLoadsGiveTheMirroredMotion) {
    // Mirrored in the vertical plane through the rod: East changes sign, and with it couples in the
    // plane and spin, which are axial vectors.
    const auto run_with = [](double side) {
        const auto number = [&](double value) { return std::to_string(side * value); };
        return test::run("gravity = 9.81\n" + pipe + R"(
            [head]
            direction = [1, 0, 0]
            rotation = )" +
                         number(2) +
                         R"(
            [bit]
            force = [-200, )" +
                         number(500) + R"(, 100]
            dead_moment = [)" +
                         number(800) + ", -600, " + number(400) + R"(]
            [mesh]
            segments = 20
            segment_inertia = true
            [output]
            profile_interval = 0.1
            [run]
            duration = 0.5
            threads = 1
            )" + choice());
    };
    const test::Run right = run_with(1);
    const test::Run left = run_with(-1);
    for (std::size_t i = 0; i < right.profiles.size(); ++i) {
        for (std::size_t k = 0; k < right.profiles[i].position.size(); ++k) {
            const Vector3d a = right.profiles[i].position[k];
            const Vector3d b = left.profiles[i].position[k];
            EXPECT_LT((b - Vector3d(a.x(), -a.y(), a.z())).norm(), 1e-10);
        }
    }
    EXPECT_GT(std::abs(right.end().position.back().y()), 0.1);
}

/// Share of the energy that moved that is not accounted for at the end.
double unaccounted_energy(const test::Run& run) {
    EnergyAudit audit;
    for (const SeriesRecord& record : run.series)
        audit.add(record.energy);
    return std::abs(audit.residual());
}

/// A cantilever that springs back from an arc of a fifth of a turn, or falls.
test::Run swinging_cantilever(const std::string& gravity, int segments, double tolerance,
                              const std::string& more) {
    return test::run("gravity = " + gravity + "\n" + pipe + more + R"(
        [head]
        direction = [1, 0, 0]
        [initial]
        curvature = [0, 0.03, 0.04]
        [mesh]
        segment_inertia = true
        segments = )" +
                     std::to_string(segments) +
                     "\n[run]\nintegrator = \"dormand-prince\"\nduration = 1\nthreads = 1\n" +
                     "absolute_tolerance = " + std::to_string(tolerance * 1e6) + "e-6\n" +
                     "relative_tolerance = " + std::to_string(tolerance * 1e6) + "e-6\n");
}

TEST(EnergyAudit, WithoutWeightTheRodsEnergyIsLostToTheToleranceOnly) {
    for (const std::string damping : {"", "[damping]\ninternal = 0.1\nexternal = 30\n"}) {
        const double loose = unaccounted_energy(swinging_cantilever("0", 15, 1e-3, damping));
        const double tight = unaccounted_energy(swinging_cantilever("0", 15, 1e-6, damping));
        EXPECT_LT(loose, 1e-2) << damping;
        EXPECT_LT(tight, 1e-6) << damping;
        EXPECT_LT(tight, loose / 30) << damping;
    }
}

TEST(EnergyAudit, WorkOfWeightIsAccountedForToSecondOrderInTheMesh) {
    // weight works along the momenta, its potential follows the poses, which are rebuilt from
    // strains: on a finite mesh the two differ
    const double coarse = unaccounted_energy(swinging_cantilever("9.81", 8, 1e-6, ""));
    const double fine = unaccounted_energy(swinging_cantilever("9.81", 32, 1e-6, ""));
    EXPECT_LT(coarse, 2e-2);
    EXPECT_LT(fine, coarse / 8);
}

}  // namespace
}  // namespace drillstrand
