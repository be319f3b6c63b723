// Substeps of fine stretches against their definition: the polynomial of a dense matrix.
#include "rod/substeps.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "model/segment_strain.hpp"
#include "rod/director_state.hpp"
#include "support/dice.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using test::Dice;

/// phi(kappa), by the angles of Chebyshev's polynomials.
double phi(double kappa, int p) {
    constexpr double nu = 0.25;
    const double w = 1 + nu / (p * p);
    const double angle = std::acosh(w);
    const double value = std::cosh(p * angle);
    const double beta = 2 * value * std::sinh(angle) / (p * std::sinh(p * angle));
    if (kappa < 1e-9) return 1;
    const double x = w - beta * kappa;
    const double at =
        x >= 1 ? std::cosh(p * std::acosh(x)) : std::cos(p * std::acos(std::max(x, -1.0)));
    return (1 - at / value) / (2 * kappa);
}

TEST(SubstepPolynomial, KeepsEveryMotionWithinItsReachStable) {
    for (int p = 2; p < 60; ++p) {
        const SubstepPolynomial polynomial(p);
        EXPECT_GT(polynomial.reach(), 0.8 * p * p);
        for (int i = 1; i <= 1000; ++i) {
            const double kappa = polynomial.reach() * i / 1000;
            EXPECT_LT(kappa * phi(kappa, p), 0.95) << p << ", " << kappa;
            EXPECT_GT(phi(kappa, p), 0);
            EXPECT_GT(kappa * phi(kappa, p), std::min(0.05, 0.5 * kappa)) << p << ", " << kappa;
        }
        EXPECT_NEAR((1 - phi(1e-4, p)) / 1e-4, polynomial.slope(), 1e-3 * polynomial.slope());
    }
}

TEST(SubstepPolynomial, GivesTheAnswerToAMotionByTheSharesOfItsPlaces) {
    // of one motion with M = 1, T = 1: the places of the rounds, and f - L g by their shares
    for (int p = 2; p < 60; ++p) {
        const SubstepPolynomial polynomial(p);
        for (int i = 0; i <= 100; ++i) {
            const double stiffness = 4 * polynomial.reach() * i / 100;
            double place = polynomial.first_factor();
            double change = place;
            double by_shares = 0;
            for (std::size_t m = 0; m < polynomial.weights().size(); ++m) {
                const double weight = polynomial.weights()[m];
                by_shares += polynomial.shares()[m] * place;
                change = (weight - 1) * change +
                         weight * polynomial.first_factor() * (1 - stiffness * place);
                place += change;
            }
            EXPECT_NEAR(2 * place, phi(stiffness / 4, p), 1e-11) << p << ", " << stiffness;
            EXPECT_NEAR(1 - stiffness * by_shares, 2 * place, 1e-11) << p << ", " << stiffness;
        }
    }
}

TEST(SubstepPolynomial, TakesTheFewestThatReach) {
    EXPECT_EQ(SubstepPolynomial::substeps_for(1.0), 1);
    for (double ratio = 1.01; ratio < 100; ratio *= 1.1) {
        const int p = SubstepPolynomial::substeps_for(ratio * ratio);
        EXPECT_GE(SubstepPolynomial(p).reach(), ratio * ratio);
        if (p == 2) continue;
        EXPECT_LT(SubstepPolynomial(p - 1).reach(), ratio * ratio);
    }
}

/// Pipe whose last 12 m are finely divided.
Scene graded_scene(const std::string& more) {
    return build_scene(test::case_from(R"(
        gravity = 0
        [[string.component]]
        length = 70
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        youngs_modulus = "200 GPa"
        [mesh]
        element_length = 5
        [[mesh.refine]]
        from = 30
        to = 42
        measured_from = "head"
        element_length = 0.6
        [run]
        duration = 1
        )" + more));
}

/// A string that is bent, twisted, stretched and in motion.
struct ShakenString {
    explicit ShakenString(const Scene& scene, unsigned seed)
        : string(scene), state(initial_state(string)), segments(nodes()) {
        Dice dice(seed);
        for (std::size_t k = 0; k < nodes(); ++k) {
            const auto set = [&](DirectorRow row, const Vector3d& value) {
                state.rod.set(row, k, value);
            };
            const double s = scene.mesh.node_s[k];
            set(DirectorRow::position, state.rod.vector(DirectorRow::position, k) +
                                           0.05 * Vector3d(std::sin(s / 3), std::cos(s / 4), 0) +
                                           dice.vector(1e-3));
            const Vector3d t =
                (state.rod.vector(DirectorRow::director, k) + dice.vector(1e-2)).normalized();
            set(DirectorRow::director, t);
            set(DirectorRow::last_director, t);
            set(DirectorRow::velocity, dice.vector(1));
            const Vector3d w = dice.vector(1);
            set(DirectorRow::angular_velocity, w - w.dot(t) * t);
            state.rod.row(DirectorRow::spin)[k] = dice.between(-1, 1);
            if (k + 1 < nodes())
                state.rod.row(DirectorRow::last_twist)[k] = dice.between(-1e-3, 1e-3);
        }
        for (const BlockSpan span : string.spans)
            director_segments(string.model, state.rod, segments, span, 0);
        // the ends are as if nothing were beyond them
        write_end_load(segments, -1, {Vector3d::Zero(), Vector3d::Zero()}, director(0));
        write_end_load(segments, static_cast<std::ptrdiff_t>(nodes()) - 1,
                       {Vector3d::Zero(), Vector3d::Zero()}, director(nodes() - 1));
    }

    [[nodiscard]] std::size_t nodes() const { return string.model.segments + 1; }
    [[nodiscard]] Vector3d director(std::size_t k) const {
        return state.rod.vector(DirectorRow::director, k);
    }
    [[nodiscard]] Vector3d position(std::size_t k) const {
        return state.rod.vector(DirectorRow::position, k);
    }

    /// Forces and couples of segments on all nodes, six numbers each.
    [[nodiscard]] VectorXd forces(const Table<SegmentRow>& of) const {
        VectorXd all(6 * static_cast<Index>(nodes()));
        for (std::size_t k = 0; k < nodes(); ++k) {
            const auto after = static_cast<std::ptrdiff_t>(k);
            const Vector3d t = director(k);
            const Vector3d force =
                of.vector(SegmentRow::pull, after) - of.vector(SegmentRow::last_pull, after - 1);
            const Vector3d couple = t.cross(of.vector(SegmentRow::first_lean, after) +
                                            of.vector(SegmentRow::last_lean, after - 1));
            const double torque =
                of.row(SegmentRow::torque)[after] - of.row(SegmentRow::last_torque)[after - 1];
            all.segment<3>(6 * after) = force;
            all.segment<3>(6 * after + 3) = couple + torque * t;
        }
        return all;
    }

    /// Inertias of all nodes; none where motion is prescribed is what `mobility` then says.
    [[nodiscard]] MatrixXd root_mobility() const {
        const Scene& scene = string.scene;
        MatrixXd root =
            MatrixXd::Zero(6 * static_cast<Index>(nodes()), 6 * static_cast<Index>(nodes()));
        for (std::size_t k = 0; k < nodes(); ++k) {
            if (k == 0 && scene.head.motion == HeadMotion::driven) continue;
            const auto at = 6 * static_cast<Index>(k);
            const double cell = scene.mesh.cell[k];
            const Matrix3d about = director(k) * director(k).transpose();
            root.block<3, 3>(at, at) =
                Matrix3d::Identity() / std::sqrt(cell * scene.mesh.node[k].mass);
            root.block<3, 3>(at + 3, at + 3) =
                (Matrix3d::Identity() - about) / std::sqrt(cell * scene.inertia[k]) +
                about / std::sqrt(cell * scene.mesh.node[k].polar_inertia);
        }
        return root;
    }

    /// Of the straight, slack segments of the stretch along the chords.
    [[nodiscard]] MatrixXd stiffness_of(const FineStretch& stretch) const {
        MatrixXd all =
            MatrixXd::Zero(6 * static_cast<Index>(nodes()), 6 * static_cast<Index>(nodes()));
        for (std::size_t k = stretch.first; k < stretch.end; ++k) {
            const SectionProperties& section = string.scene.mesh.segment[k];
            const double h = string.scene.mesh.length[k];
            const Vector3d chord = position(k + 1) - position(k);
            const double shear = section.shear_stiffness;
            const double ei = section.bending_stiffness / h;
            const double deviating = 12 * ei / (h * h) / (1 + 12 * ei / (shear * h));
            const auto at = 6 * static_cast<Index>(k);
            Matrix3d cross;  // chord x
            cross << 0, -chord.z(), chord.y(), chord.z(), 0, -chord.x(), -chord.y(), chord.x(), 0;
            const Matrix3d along = chord * chord.transpose() / (h * h);
            Eigen::Matrix<double, 3, 12> apart = Eigen::Matrix<double, 3, 12>::Zero();
            apart.block<3, 3>(0, 0) = -Matrix3d::Identity();
            apart.block<3, 3>(0, 6) = Matrix3d::Identity();
            Eigen::Matrix<double, 3, 12> turned = Eigen::Matrix<double, 3, 12>::Zero();
            turned.block<3, 3>(0, 3) = -Matrix3d::Identity();
            turned.block<3, 3>(0, 9) = Matrix3d::Identity();
            Eigen::Matrix<double, 3, 12> mean = Eigen::Matrix<double, 3, 12>::Zero();
            mean.block<3, 3>(0, 3) = mean.block<3, 3>(0, 9) = 0.5 * Matrix3d::Identity();
            const Eigen::Matrix<double, 3, 12> strain = apart + cross * mean;
            all.block<12, 12>(at, at) +=
                deviating * strain.transpose() * strain +
                (section.axial_stiffness / h - deviating) * apart.transpose() * along * apart +
                ei * turned.transpose() * turned +
                (section.torsional_stiffness / h - ei) * turned.transpose() * along * turned;
        }
        return all;
    }

    /// What `force` becomes in the substeps of the stretch: M^1/2 phi(M^-1/2 L M^-1/2) M^-1/2 f.
    [[nodiscard]] VectorXd averaged(const VectorXd& force, const FineStretch& stretch, double step,
                                    int substeps) const {
        const MatrixXd root = root_mobility();
        const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(root * stiffness_of(stretch) * root);
        VectorXd part = solver.eigenvectors().transpose() * (root * force);
        for (Index i = 0; i < part.size(); ++i)
            part[i] *= phi(std::max(0.0, solver.eigenvalues()[i]) * step * step / 4, substeps);
        return root.completeOrthogonalDecomposition().pseudoInverse() *
               (solver.eigenvectors() * part);
    }

    DirectorString string;
    DirectorState state;
    Table<SegmentRow> segments;
};

class SubstepsWith : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Heads, SubstepsWith,
                         testing::Values("[head]\nmotion = \"free\"\n",
                                         "[head]\ndirection = [0, 0, 1]\n"),
                         [](const auto& instance) {
                             return std::string(instance.index == 0 ? "Free" : "Driven");
                         });

/// Substeps in rounds of a precision against the polynomial, to a part of the forces.
template <class Real>
void expect_the_polynomial(const Scene& scene, double tolerance) {
    const SubstepsOf<Real> substeps(scene);
    for (const unsigned seed : {1U, 2U, 3U}) {
        ShakenString shaken(scene, seed);
        ASSERT_EQ(substeps.count(), 1U);
        const FineStretch& stretch = substeps.plan().stretches[0];
        EXPECT_GE(stretch.first, 3U);
        EXPECT_LT(stretch.end + 3, shaken.nodes());
        const double step = 0.9 * substeps.plan().bound.step;
        const int taken = substeps.substeps(0, step);
        EXPECT_GT(taken, 5);
        const VectorXd force = shaken.forces(shaken.segments);
        Table<SegmentRow> handed = shaken.segments;
        typename SubstepsOf<Real>::Work work = substeps.work_for(0);
        substeps.average(shaken.string.model, shaken.state.rod, shaken.state.wall, 0, step, work,
                         handed);
        const VectorXd found = shaken.forces(handed);
        const VectorXd expected = shaken.averaged(force, stretch, step, taken);
        const Index first = shaken.string.head.is_held() ? 6 : 0;
        const Index rest = force.size() - first;
        EXPECT_GT((force - found).norm(), 0.1 * force.norm());
        EXPECT_LT((found - expected).tail(rest).norm(), tolerance * force.norm());
    }
}

TEST_P(SubstepsWith, AreThePolynomialOfTheStiffnessOfTheStretch) {
    const Scene scene = graded_scene(GetParam());
    expect_the_polynomial<double>(scene, 1e-11);
    expect_the_polynomial<float>(scene, 1e-6);
}

/// The largest (omega dt)^2/4 of the whole string in substeps; a step keeps below 1.
double largest_kappa(const ShakenString& shaken, double step) {
    const Substeps& substeps = shaken.string.substeps;
    const MatrixXd root = shaken.root_mobility();
    const MatrixXd whole =
        root * shaken.stiffness_of({0, shaken.nodes() - 1, 0, 1}) * root * (step * step / 4);
    MatrixXd fine = MatrixXd::Zero(whole.rows(), whole.cols());
    for (std::size_t i = 0; i < substeps.count(); ++i)
        fine += root * shaken.stiffness_of(substeps.plan().stretches[i]) * root;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(fine);
    VectorXd part = solver.eigenvalues();
    const double period = substeps.plan().undamped(step);
    const int taken = substeps.substeps(0, step);
    for (double& value : part)
        value = std::sqrt(phi(std::max(0.0, value) * period * period / 4, taken));
    const MatrixXd half = solver.eigenvectors() * part.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> all(half.transpose() * whole * half,
                                                      Eigen::EigenvaluesOnly);
    return all.eigenvalues().maxCoeff();
}

TEST(Substeps, AreStableAtEveryStepUpToTheBound) {
    const Scene scene = graded_scene("[head]\nmotion = \"free\"\n");
    const ShakenString shaken(scene, 7);
    const double bound = shaken.string.substeps.plan().bound.step;
    for (double cfl = 0.1; cfl <= 1; cfl += 0.01) {
        EXPECT_LT(largest_kappa(shaken, cfl * bound), 0.95) << cfl;
    }
}

TEST(Substeps, KeepLinearAndAngularMomentumToRounding) {
    const Scene scene = graded_scene("[head]\nmotion = \"free\"\n");
    ShakenString shaken(scene, 4);
    const Substeps& substeps = shaken.string.substeps;
    Table<SegmentRow> handed = shaken.segments;
    Substeps::Work work = substeps.work_for(0);
    substeps.average(shaken.string.model, shaken.state.rod, shaken.state.wall, 0,
                     0.9 * substeps.plan().bound.step, work, handed);
    const VectorXd change = shaken.forces(handed) - shaken.forces(shaken.segments);
    Vector3d force = Vector3d::Zero();
    Vector3d moment = Vector3d::Zero();
    double parts = 0;
    for (std::size_t k = 0; k < shaken.nodes(); ++k) {
        const auto at = 6 * static_cast<Index>(k);
        const Vector3d on_node = change.segment<3>(at);
        const Vector3d lever = shaken.position(k) - shaken.position(0);
        force += on_node;
        moment += lever.cross(on_node) + change.segment<3>(at + 3);
        parts += on_node.norm();
    }
    EXPECT_GT(parts, 1e4);
    EXPECT_LT(force.norm(), 1e-13 * parts);
    EXPECT_LT(moment.norm(), 1e-12 * parts);
}

/// What a stretch makes of hits on single nodes, in rounds of a precision that errs by so much of
/// what would be rounding in double precision.
template <class Real>
void expect_shared_impulses(double rounding) {
    const Scene scene = graded_scene("[head]\nmotion = \"free\"\n");
    ShakenString shaken(scene, 5);
    const SubstepsOf<Real> substeps(scene);
    const FineStretch& stretch = substeps.plan().stretches[0];
    const double step = 0.9 * substeps.plan().bound.step;
    Table<SegmentRow> handed = shaken.segments;
    typename SubstepsOf<Real>::Work work = substeps.work_for(0);
    substeps.average(shaken.string.model, shaken.state.rod, shaken.state.wall, 0, step, work,
                     handed);
    Table<DirectorRow> next = shaken.state.rod;
    for (const BlockSpan span : shaken.string.spans)
        director_nodes(shaken.string.model, shaken.state.rod, next, handed, shaken.state.wall, span,
                       step, step);
    Dice dice(6);
    VectorXd impulse = VectorXd::Zero(6 * static_cast<Index>(shaken.nodes()));
    for (std::size_t k = stretch.first; k <= stretch.end; ++k) {
        const Vector3d hit = dice.vector(10);
        const double cell = scene.mesh.cell[k];
        impulse.segment<3>(6 * static_cast<Index>(k)) = hit;
        const Vector3d faster = hit / (cell * scene.mesh.node[k].mass);
        next.set(DirectorRow::velocity, k, next.vector(DirectorRow::velocity, k) + faster);
        next.set(DirectorRow::position, k, next.vector(DirectorRow::position, k) + step * faster);
    }
    Table<DirectorRow> shared = next;
    const double outflow =
        substeps.share(shaken.string.model, shaken.state.rod, shared, 0, step, step, work);
    const VectorXd change =
        shaken.averaged(impulse, stretch, step, substeps.substeps(0, step)) - impulse;
    double work_of_change = 0;
    for (std::size_t k = 0; k < shaken.nodes(); ++k) {
        const auto at = 6 * static_cast<Index>(k);
        const double cell = scene.mesh.cell[k];
        const Vector3d faster = change.segment<3>(at) / (cell * scene.mesh.node[k].mass);
        const Vector3d v =
            shared.vector(DirectorRow::velocity, k) - next.vector(DirectorRow::velocity, k);
        const Vector3d x =
            shared.vector(DirectorRow::position, k) - next.vector(DirectorRow::position, k);
        EXPECT_LT((v - faster).norm(), 1e-9 * rounding) << k;
        EXPECT_LT((x - step * faster).norm(), 1e-11 * rounding) << k;
        work_of_change += 0.5 * impulse.segment<3>(at).dot(faster);
        const Vector3d t = shared.vector(DirectorRow::director, k);
        const Vector3d w = shared.vector(DirectorRow::angular_velocity, k);
        const double q = step * w.norm() / 2;
        const Vector3d turned =
            Eigen::AngleAxisd(2 * std::atan(q), w.normalized()) * shaken.director(k);
        EXPECT_LT((t - turned).norm(), 1e-10 * rounding) << k;
    }
    EXPECT_NEAR(outflow, -work_of_change, 1e-9 * rounding * std::abs(work_of_change));
}

TEST(Substeps, GiveImpulsesOfSurroundingsToTheWholeStretch) {
    // damping hits single nodes; what the stretch makes of that is the same polynomial
    expect_shared_impulses<double>(1);
    expect_shared_impulses<float>(1e3);
}

}  // namespace
}  // namespace drillstrand
