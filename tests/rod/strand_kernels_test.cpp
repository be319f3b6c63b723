#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "rod/plain_strand.hpp"
#include "rod/report.hpp"
#include "rod/strand.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using test::EndStress;
using test::PlainRates;
using test::PlainState;

Vector6 random_vector(std::mt19937& random) {
    std::normal_distribution<double> gauss;
    Vector6 v;
    for (double& x : v)
        x = gauss(random);
    return v;
}

/// A string of three unlike components, curved when unstressed; two joints lie inside segments.
std::string three_components(int segments, double gravity, const std::string& more) {
    return "gravity = " + std::to_string(gravity) + R"(
        [[string.component]]
        length = 9.0
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        youngs_modulus = "200 GPa"
        curvature = [0.01, 0.02, -0.03]
        [[string.component]]
        length = 4.3
        linear_density = 150.0
        outer_diameter = 0.2
        inner_diameter = 0.07
        youngs_modulus = "190 GPa"
        poisson_ratio = 0.2
        [[string.component]]
        length = 6.1
        linear_density = 20.0
        outer_diameter = 0.09
        inner_diameter = 0.07
        youngs_modulus = "110 GPa"
        curvature = [-0.02, 0.0, 0.01]
        [head]
        motion = "free"
        position = [1, -2, 3]
        direction = [0.3, -0.5, 0.8]
        [run]
        duration = 1
        [mesh]
        segments = )" +
           std::to_string(segments) + "\n" + more;
}

/// A state far from rest: turns of a tenth of a radian and stretches of a few per cent a segment.
PlainState random_state(const Scene& scene, std::mt19937& random) {
    PlainState state;
    for (std::size_t k = 0; k < scene.mesh.node.size(); ++k) {
        const SectionProperties& s = scene.mesh.node[k];
        Vector6 inertia;
        inertia << s.polar_inertia, scene.inertia[k], scene.inertia[k], s.mass, s.mass, s.mass;
        state.momentum.emplace_back(inertia.cwiseProduct(random_vector(random)));
    }
    for (std::size_t k = 0; k < scene.mesh.segment.size(); ++k) {
        Vector6 strain = random_vector(random);
        strain.head<3>() *= 0.1 / scene.mesh.length[k];
        strain.tail<3>() *= 0.03;
        state.stress.emplace_back(stiffness_of(scene.mesh.segment[k]).cwiseProduct(strain));
    }
    return state;
}

Table<StrandRow> table_of(const PlainState& state) {
    Table<StrandRow> table(state.momentum.size());
    for (std::size_t k = 0; k < state.momentum.size(); ++k)
        set_momentum(table, k, state.momentum[k]);
    for (std::size_t k = 0; k < state.stress.size(); ++k)
        set_stress(table, k, state.stress[k]);
    return table;
}

struct KernelResult {
    PlainState rate;
    std::vector<Pose> pose;
    double power = 0;
};

/// One evaluation by the vector kernels.
KernelResult kernel_rates(const Scene& scene, const Pose& head, const PlainState& state,
                          const EndStress& ends) {
    const std::size_t nodes = state.momentum.size();
    const std::size_t blocks = blocks_for(nodes);
    const StrandModel model(scene);
    const Table<StrandRow> table = table_of(state);
    Table<StrandRow> rate(nodes);
    StrandWorkspace work(nodes);
    Table<WallRow> nothing_around;
    std::vector<Pose> block_start(blocks);
    segment_pass(model, table, rate, work, nothing_around, 0, blocks);
    set_head_wrench(work, ends.head);
    set_bit_wrench(work, nodes - 1, ends.bit);
    chain_blocks(head, work, block_start, blocks);
    node_pass(model, table, rate, work, block_start, nothing_around, 0, blocks);

    KernelResult result;
    for (std::size_t k = 0; k < nodes; ++k) {
        result.rate.momentum.push_back(momentum_of(rate, k));
        result.pose.push_back(node_pose(work, block_start, k));
    }
    for (std::size_t k = 0; k + 1 < nodes; ++k)
        result.rate.stress.push_back(stress_of(rate, k));
    for (const double power : work.power)
        result.power += power;
    return result;
}

/// Largest difference of two lists, component by component, relative to the component's largest
/// value in the list.
double relative_difference(const std::vector<Vector6>& a, const std::vector<Vector6>& b) {
    Vector6 largest = Vector6::Zero();
    Vector6 difference = Vector6::Zero();
    for (std::size_t k = 0; k < a.size(); ++k) {
        largest = largest.cwiseMax(b[k].cwiseAbs());
        difference = difference.cwiseMax((a[k] - b[k]).cwiseAbs());
    }
    return difference.cwiseQuotient(largest).maxCoeff();
}

struct Variant {
    std::string name;
    int segments;  ///< nodes fill one block, several blocks and a part, or leave the last one alone
    std::string more;
};

class StrandKernelsOn : public testing::TestWithParam<Variant> {};

// A few hundred operations on numbers whose parts cancel by a factor of ten at most.
constexpr double kernel_rounding = 1e-12;

TEST_P(StrandKernelsOn, GiveTheRatesOfTheEquationsWrittenNodeByNode) {
    const Scene scene =
        build_scene(test::case_from(three_components(GetParam().segments, 9.81, GetParam().more)));
    const Pose head{scene.head_frame, scene.head_position};
    std::mt19937 random(20240601);
    for (int trial = 0; trial < 10; ++trial) {
        const PlainState state = random_state(scene, random);
        const EndStress ends{1e5 * random_vector(random), 1e5 * random_vector(random)};
        const PlainRates expected = test::plain_rates(scene, head, state, ends);
        const KernelResult found = kernel_rates(scene, head, state, ends);
        EXPECT_LT(relative_difference(found.rate.stress, expected.rate.stress), kernel_rounding);
        EXPECT_LT(relative_difference(found.rate.momentum, expected.rate.momentum),
                  kernel_rounding);
        EXPECT_NEAR(found.power, expected.damping_power,
                    kernel_rounding * (1 + std::abs(expected.damping_power)));

        const std::vector<Pose> poses = test::plain_poses(scene, head, state.stress);
        for (std::size_t k = 0; k < poses.size(); ++k) {
            EXPECT_LT((found.pose[k].frame - poses[k].frame).norm(), kernel_rounding);
            EXPECT_LT((found.pose[k].position - poses[k].position).norm(), 20 * kernel_rounding);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Rods, StrandKernelsOn,
    testing::Values(Variant{"OneSegment", 1, ""}, Variant{"OneBlock", 15, ""},
                    Variant{"LastNodeAlone", 32, ""},
                    Variant{"SeveralBlocksDamped", 37, "[damping]\ninternal = 3\nexternal = 20\n"},
                    Variant{"DampingInPairs", 37,
                            "[damping]\ninternal_translation = 3\ninternal_rotation = 0.2\n"
                            "external_translation = 20\nexternal_rotation = 5\n"},
                    Variant{"InternalDampingOnly", 20, "[damping]\ninternal = 5\n"},
                    Variant{"SegmentInertia", 50, "segment_inertia = true\n"}),
    [](const auto& variant) { return variant.param.name; });

TEST(StrandKernels, AnUndampedRodNeitherMakesNorLosesEnergy) {
    // Over one evaluation, the power of the momentum rates and of the stress rates must add up to
    // the power of the end stresses: the reason why an end node takes its one segment's whole
    // product.
    const Scene scene = build_scene(test::case_from(three_components(37, 0, "")));
    const Pose head{scene.head_frame, scene.head_position};
    std::mt19937 random(7);
    for (int trial = 0; trial < 20; ++trial) {
        const PlainState state = random_state(scene, random);
        const EndStress ends{1e5 * random_vector(random), 1e5 * random_vector(random)};
        const PlainState rate = kernel_rates(scene, head, state, ends).rate;
        double power = 0;
        double magnitude = 0;
        const auto add = [&](double part) {
            power += part;
            magnitude += std::abs(part);
        };
        for (std::size_t k = 0; k < rate.momentum.size(); ++k) {
            add(scene.mesh.cell[k] *
                rate.momentum[k].dot(test::plain_velocity(scene, k, state.momentum[k])));
        }
        for (std::size_t k = 0; k < rate.stress.size(); ++k) {
            add(scene.mesh.length[k] *
                rate.stress[k].dot(test::plain_strain_change(scene, k, state.stress[k])));
        }
        const std::size_t last = scene.mesh.node.size() - 1;
        add(ends.head.dot(test::plain_velocity(scene, 0, state.momentum[0])));
        add(-ends.bit.dot(test::plain_velocity(scene, last, state.momentum[last])));
        EXPECT_LT(std::abs(power), 1e-14 * magnitude);
    }
}

TEST(StrandKernels, RigidMotionOfAStraightRodBuildsUpNoStress) {
    const Scene scene = build_scene(test::case_from(R"(
        gravity = 0
        [[string.component]]
        length = 24.0
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        youngs_modulus = "200 GPa"
        [mesh]
        segments = 24
        [head]
        motion = "free"
        [run]
        duration = 1
    )"));
    const Pose head{scene.head_frame, scene.head_position};
    std::mt19937 random(3);
    for (int trial = 0; trial < 10; ++trial) {
        const Vector6 at_head = random_vector(random);
        const Vector3d w = at_head.head<3>();
        PlainState state;
        for (std::size_t k = 0; k < scene.mesh.node.size(); ++k) {
            const SectionProperties& s = scene.mesh.node[k];
            Vector6 momentum;
            momentum << Vector3d(s.polar_inertia * w[0], scene.inertia[k] * w[1],
                                 scene.inertia[k] * w[2]),
                s.mass * (at_head.tail<3>() + w.cross(Vector3d(scene.mesh.node_s[k], 0, 0)));
            state.momentum.push_back(momentum);
        }
        state.stress.assign(scene.mesh.segment.size(), Vector6::Zero());
        const PlainState rate = kernel_rates(scene, head, state, {}).rate;
        // stiffness times the rounding of strain rates of order 1
        for (std::size_t k = 0; k < rate.stress.size(); ++k) {
            const Vector6 strain_rate = test::plain_strain_change(scene, k, rate.stress[k]);
            EXPECT_LT(strain_rate.cwiseAbs().maxCoeff(), 1e-13);
        }
        // and the momenta turn with the body: p' = p x w, Pi' = Pi x w
        for (std::size_t k = 0; k < rate.momentum.size(); ++k) {
            const Vector3d p = state.momentum[k].tail<3>();
            const Vector3d pi = state.momentum[k].head<3>();
            EXPECT_LT((Vector3d(rate.momentum[k].tail<3>()) - p.cross(w)).norm(),
                      1e-13 * p.norm() * w.norm());
            EXPECT_LT((Vector3d(rate.momentum[k].head<3>()) - pi.cross(w)).norm(),
                      1e-13 * pi.norm() * w.norm());
        }
    }
}

}  // namespace
}  // namespace drillstrand
