// Forces and tangents of the static rod: against the leapfrog's own, against differences, and
// where loads without a potential need them to be right.
#include "statics/balance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drillstrand/simulation.hpp"
#include "statics/statics_cases.hpp"

namespace drillstrand {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using test::Dice;

/// A rod of stiffnesses that are all of order one, so that no term hides behind another, in a
/// curved well into whose wall it is pressed, with every kind of load at its end.
/// Casing that widens, and an open hole with a wall of its own.
std::vector<WellSectionCase> casing_and_open_hole() {
    WellSectionCase casing{.to = 4.1, .diameter = 0.3};
    casing.end_diameter = 0.36;
    casing.dynamic_friction = {0.2, 0.4};
    WellSectionCase open{.to = 1e9, .diameter = 0.34};
    open.normal_stiffness = 5;
    return {casing, open};
}

Scene trial_scene(bool follower, bool well, bool varied_wall, NormalLaw law = NormalLaw::linear) {
    const std::string own = "curvature = [0.1, 0.2, -0.3]";
    Case input = test::case_from(test::rod({6, 1.3, 0.9, 2.1, 1.7}, own) + test::mesh(6) +
                                 "[head]\ndirection = [0.1, 0.2, 1]\n"
                                 "[bit]\nweight = 0.7\nforce = [0.3, -0.2, 0.4]\n"
                                 "dead_moment = [0.2, 0.1, -0.3]\nmoment = [0.3, 0.2, 0.1]\n"
                                 "torque = 0.4\n[contact]\nnormal_stiffness = 3\n"
                                 "normal_damping = 0\nstatic_friction = 1\n"
                                 "dynamic_friction = [0.3, 0.5]\n");
    if (well) {
        input.well = test::well_through({{0, 0.1, 0}, {3, 0.5, 0.4}, {9, 1.4, 1.0}}, 0.3);
        if (varied_wall) input.well->sections = casing_and_open_hole();
        input.contact.normal_law = law;
        input.bit.direction = follower ? BitDirection::follower : BitDirection::well;
    }
    return build_scene(input);
}

RodState bent_state(const Scene& scene, Dice& dice, double size) {
    RodState state(scene.initial_nodes, scene.head_frame.col(1), scene.mesh.length);
    NodeMotion motion(state.twist.size());
    for (Vector6& node : motion)
        node << dice.vector(size), dice.vector(2 * size);
    return moved(state, scene.mesh.length, motion, 1, StepRule::nodes);
}

LoadCase trial_loads() {
    LoadCase loads;
    loads.motion = {0.4, 3};
    loads.bit = {0, 3, 0.8};
    loads.weight = 0.05;
    return loads;
}

double largest(const NodeMotion& forces) {
    double size = 0;
    for (const Vector6& force : forces)
        size = std::max(size, force.cwiseAbs().maxCoeff());
    return size;
}

NodeMotion product(const BlockTridiagonal& matrix, const NodeMotion& x) {
    NodeMotion y(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
        y[k] = matrix.diagonal[k] * x[k];
        if (k > 0) y[k] += matrix.lower[k] * x[k - 1];
        if (k + 1 < x.size()) y[k] += matrix.upper[k] * x[k + 1];
    }
    return y;
}

TEST(StaticTangent, IsTheDerivativeOfTheForcesWithWallFrictionAndFollowingLoads) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Dice dice(seed);
        const bool well = seed % 4 != 0;
        const NormalLaw law = seed % 5 < 2 ? NormalLaw::hertz : NormalLaw::linear;
        const Scene scene = trial_scene(seed % 2 == 0, well, seed % 3 == 1, law);
        const RodState state = bent_state(scene, dice, 0.2);
        Balance balance(scene, trial_loads());
        BlockTridiagonal stiffness(state.twist.size());
        balance.stiffness(state, stiffness);
        NodeMotion direction(state.twist.size());
        for (Vector6& node : direction)
            node << dice.vector(1), dice.vector(1);
        const NodeMotion expected = product(stiffness, direction);
        for (const StepRule rule : {StepRule::nodes, StepRule::strains}) {
            constexpr double step = 1e-5;
            NodeMotion difference =
                balance.imbalance(moved(state, scene.mesh.length, direction, -step, rule)).force;
            const NodeMotion ahead =
                balance.imbalance(moved(state, scene.mesh.length, direction, step, rule)).force;
            for (std::size_t k = 0; k < difference.size(); ++k)
                difference[k] = (difference[k] - ahead[k]) / (2 * step) - expected[k];
            EXPECT_LT(largest(difference), 1e-8 * largest(expected)) << "seed " << seed;
        }
    }
}

TEST(StaticTangent, OfAPinnedHeadIsTheDerivativeByItsTilt) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Dice dice(seed);
        Scene scene = trial_scene(seed % 2 == 0, seed % 3 == 0, false);
        const RodState state = bent_state(scene, dice, 0.2);
        scene.head.motion = HeadMotion::pinned;
        Balance balance(scene, trial_loads());
        const std::size_t nodes = state.twist.size() + 1;
        BlockTridiagonal stiffness(nodes);
        balance.stiffness(state, stiffness);
        NodeMotion direction(nodes);
        for (Vector6& node : direction)
            node << dice.vector(1), dice.vector(1);
        const Vector3d& t = state.director.front();
        const auto tilt = [&t](Vector6& head) {
            head.head<3>().setZero();
            head.tail<3>() -= head.tail<3>().dot(t) * t;
        };
        tilt(direction.front());
        const NodeMotion expected = product(stiffness, direction);
        constexpr double step = 1e-5;
        const auto forces = [&](double scale) {
            return balance
                .imbalance(moved(state, scene.mesh.length, direction, scale, StepRule::nodes))
                .force;
        };
        NodeMotion difference = forces(-step);
        const NodeMotion ahead = forces(step);
        for (std::size_t k = 0; k < nodes; ++k)
            difference[k] = (difference[k] - ahead[k]) / (2 * step) - expected[k];
        tilt(difference.front());
        EXPECT_LT(largest(difference), 1e-8 * largest(expected)) << "seed " << seed;
    }
}

TEST(StaticTangent, IsSymmetricInEquilibriumWhereAllLoadsHaveAPotential) {
    Case input =
        test::case_from("gravity = 0\n" + test::rod({6, 1.3, 0.9, 2.1, 1.7}) + test::mesh(6) +
                        "[head]\ndirection = [1, 0, 0]\n[bit]\nforce = [0, 0.03, 0.05]\n");
    const Scene scene = build_scene(input);
    const Equilibrium found = find_equilibrium(scene);
    const RodState state(found.nodes, scene.head_frame.col(1), scene.mesh.length);
    Balance balance(scene, {});
    BlockTridiagonal stiffness(state.twist.size());
    balance.stiffness(state, stiffness);
    for (std::size_t k = 0; k < stiffness.rows(); ++k) {
        const Matrix6& d = stiffness.diagonal[k];
        EXPECT_LT((d - d.transpose()).cwiseAbs().maxCoeff(), 1e-12 * d.cwiseAbs().maxCoeff());
        if (k == 0) continue;
        const Matrix6 off = stiffness.upper[k - 1] - stiffness.lower[k].transpose();
        EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-12 * d.cwiseAbs().maxCoeff());
    }
}

TEST(StaticForces, AreThoseWithWhichTheLeapfrogSetsOffFromRest) {
    constexpr double instant = 1e-9;  // s; sections of that rod turn with some 1e3 rad/s
    for (unsigned seed = 1; seed <= 12; ++seed) {
        Dice dice(seed);
        const NormalLaw law = seed % 5 < 2 ? NormalLaw::hertz : NormalLaw::linear;
        Scene scene = trial_scene(seed % 2 == 0, seed % 3 != 0, seed % 3 == 1, law);
        scene.contact.tangential_stiffness = 1e-9;
        const RodState state = bent_state(scene, dice, 0.2);
        LoadCase loads;  // at rest, with the loads of time 0
        loads.friction = 0;
        loads.bit.time = 0;
        Balance balance(scene, loads);
        const NodeMotion force = balance.imbalance(state).force;

        scene.initial_nodes = state.nodes();
        IntegratorOptions options;
        options.stress_limit = 0;
        const auto leapfrog = make_integrator(scene, options);
        leapfrog->advance(instant, 1);
        const Profile profile = leapfrog->profile();
        for (std::size_t k = 0; k < force.size(); ++k) {
            const std::size_t node = k + 1;
            Eigen::Matrix3d frame;
            const Vector3d& t = state.director[node];
            frame << t, state.material[node], t.cross(state.material[node]);
            Vector6 expected;
            expected << frame.transpose() * force[k].tail<3>(),
                frame.transpose() * force[k].head<3>();
            const Vector6 found = profile.momentum[node] * scene.mesh.cell[node] / instant;
            EXPECT_LT((found - expected).norm(), 1e-8 * largest(force))
                << "seed " << seed << ", node " << node;
        }
    }
}

/// The largest couple (N m) of a segment on its last node in a rod of the shape that it starts
/// with.
double couple_of_own_shape(const std::string& curvature, int segments) {
    const Scene scene =
        build_scene(test::case_from(test::rod({24, 2e6, 1.5e6, 1e9, 5e8}, curvature) +
                                    test::mesh(segments) + "[initial]\nstate = \"stress-free\"\n"));
    const RodState state(scene.initial_nodes, scene.head_frame.col(1), scene.mesh.length);
    const Balance balance(scene, {});
    double couple = 0;
    for (std::size_t k = 0; k < scene.mesh.length.size(); ++k) {
        const SegmentForces forces = segment_forces(balance.segment(state, k));
        couple = std::max(couple, forces.on_b.tail<3>().norm());
    }
    return couple;
}

TEST(StressFreeShape, IsFreeOfStressToFourthOrderAndExactlyInAPlane) {
    EXPECT_LT(couple_of_own_shape("curvature = [0, 0.02, 0.05]", 20), 1e-6);  // of EI bend = 1e5
    const std::string helix = "curvature = [0.03, 0.02, -0.05]";
    const double coarse = couple_of_own_shape(helix, 20);
    EXPECT_LT(coarse, 0.1);
    EXPECT_NEAR(std::log2(coarse / couple_of_own_shape(helix, 40)), 4, 0.1);
}

TEST(BlockFactors, SolveARandomSystemAndCountItsNegativeEigenvalues) {
    Dice dice(9);
    constexpr std::size_t rows = 7;
    BlockTridiagonal matrix(rows);
    MatrixXd dense = MatrixXd::Zero(6 * rows, 6 * rows);
    for (std::size_t k = 0; k < rows; ++k) {
        for (Eigen::Index i = 0; i < 36; ++i) {
            matrix.diagonal[k](i) = dice.between(-1, 1);
            if (k > 0) matrix.lower[k](i) = dice.between(-1, 1);
        }
        matrix.diagonal[k] = (matrix.diagonal[k] + matrix.diagonal[k].transpose()).eval();
        const auto at = static_cast<Eigen::Index>(6 * k);
        dense.block<6, 6>(at, at) = matrix.diagonal[k];
        if (k == 0) continue;
        matrix.upper[k - 1] = matrix.lower[k].transpose();
        dense.block<6, 6>(at, at - 6) = matrix.lower[k];
        dense.block<6, 6>(at - 6, at) = matrix.upper[k - 1];
    }
    NodeMotion right(rows);
    for (Vector6& r : right)
        r << dice.vector(1), dice.vector(1);
    const BlockFactors factors(matrix);
    const NodeMotion back = product(matrix, factors.solve(right));
    for (std::size_t k = 0; k < rows; ++k)
        EXPECT_LT((back[k] - right[k]).norm(), 1e-11);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(dense).eigenvalues();
    const auto negative = (values.array() < 0).count();
    EXPECT_EQ(factors.negative_eigenvalues(), negative);
    EXPECT_EQ(factors.determinant_sign(), negative % 2 == 0 ? 1 : -1);
    EXPECT_FALSE(factors.is_positive_definite());
}

/// The smallest factor in (low, high) at which `holds` ceases to be true.
template <class Holds>
double limit(double low, double high, const Holds& holds) {
    while (high - low > 1e-9 * high) {
        const double middle = 0.5 * (low + high);
        (holds(middle) ? low : high) = middle;
    }
    return high;
}

/// Torque at which a shaft of EI = L = 1 with both ends clamped buckles.
double clamped_shaft_torque(int segments) {
    const Scene scene = build_scene(
        test::case_from("gravity = 0\n" + test::rod({1, 1, 0.7, 1e8, 1e8}) + test::mesh(segments)));
    Balance balance(scene, {});
    return limit(1, 20, [&](double torque) {
        InitialNodes nodes = scene.initial_nodes;
        std::fill(nodes.twist.begin(), nodes.twist.end(), torque / 0.7);
        const RodState state(nodes, scene.head_frame.col(1), scene.mesh.length);
        BlockTridiagonal stiffness(nodes.twist.size());
        balance.stiffness(state, stiffness);
        // the last node is held too
        for (auto* band : {&stiffness.lower, &stiffness.diagonal, &stiffness.upper})
            band->pop_back();
        stiffness.upper.back().setZero();
        return BlockFactors(stiffness).is_positive_definite();
    });
}

TEST(TorqueBuckling, ClampedShaftBucklesAtGreenhillsTorqueAtFourthOrder) {
    const double exact = 2 * 4.49340945790906;  // 2 x EI/L, tan x = x
    const double coarse = clamped_shaft_torque(16) - exact;
    const double fine = clamped_shaft_torque(32) - exact;
    EXPECT_LT(std::abs(fine), 1e-4);
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.2);
}

/// Whether some small motion of the straight rod of EI = L = m = 1 under a thrust that follows its
/// end grows: whether an eigenvalue of M^-1 K is not real and positive.
bool flutters(int segments, double thrust) {
    Case input =
        test::case_from("gravity = 0\n" + test::rod({1, 1, 1, 1e7, 1e7}) + test::mesh(segments) +
                        fmt::format("[bit]\nweight = {}\n", thrust));
    input.mesh.segment_inertia = false;
    const Scene scene = build_scene(input);
    const Equilibrium straight = find_equilibrium(scene);
    EXPECT_TRUE(straight.warnings.empty());  // no divergence: statics sees nothing
    const RodState state(straight.nodes, scene.head_frame.col(1), scene.mesh.length);
    LoadCase loads;
    loads.bit.time = 0;
    Balance balance(scene, loads);
    BlockTridiagonal stiffness(state.twist.size());
    balance.stiffness(state, stiffness);
    const auto size = static_cast<Eigen::Index>(6 * stiffness.rows());
    MatrixXd dynamic = MatrixXd::Zero(size, size);
    for (std::size_t k = 0; k < stiffness.rows(); ++k) {
        const auto at = static_cast<Eigen::Index>(6 * k);
        const double cell = scene.mesh.cell[k + 1];
        Vector6 inverse_mass = Vector6::Constant(1 / cell);
        inverse_mass.tail<3>() /= scene.inertia[k + 1];
        dynamic.block<6, 6>(at, at) = inverse_mass.asDiagonal() * stiffness.diagonal[k];
        if (k > 0) dynamic.block<6, 6>(at, at - 6) = inverse_mass.asDiagonal() * stiffness.lower[k];
        if (k + 1 < stiffness.rows())
            dynamic.block<6, 6>(at, at + 6) = inverse_mass.asDiagonal() * stiffness.upper[k];
    }
    const Eigen::VectorXcd values = Eigen::EigenSolver<MatrixXd>(dynamic, false).eigenvalues();
    // the lowest bending modes flutter; far above them rounding makes equal pairs complex
    return std::any_of(values.begin(), values.end(), [](const std::complex<double>& value) {
        return std::abs(value) < 1e4 && std::abs(value.imag()) > 1e-2 * std::abs(value);
    });
}

TEST(FollowerLoad, BecksColumnFluttersAtTheExactLoadAndNeverDiverges) {
    const double exact = 20.05095361897376;  // shooting
    const auto load = [](int segments) {
        double low = 15;
        double high = 25;
        while (high - low > 1e-3) {
            const double middle = 0.5 * (low + high);
            (flutters(segments, middle) ? high : low) = middle;
        }
        return high;
    };
    const double coarse = load(8) - exact;
    const double fine = load(16) - exact;
    EXPECT_LT(std::abs(fine), 0.01);
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.5);
}

}  // namespace
}  // namespace drillstrand
