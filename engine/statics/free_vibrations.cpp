#include "statics/free_vibrations.hpp"

#include <algorithm>
#include <cmath>

#include "drillstrand/error.hpp"
#include "statics/eigenpairs.hpp"

namespace drillstrand {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXd;

/// Part of a long vector as motions of the nodes, and back.
NodeMotion nodes_from(const VectorXd& vector, std::size_t part, std::size_t rows) {
    NodeMotion nodes(rows);
    const double* at = vector.data() + 6 * part * rows;
    for (Vector6& node : nodes) {
        node = Vector6::Map(at);
        at += 6;
    }
    return nodes;
}

VectorXd joined(std::initializer_list<NodeMotion> parts) {
    VectorXd vector(static_cast<Index>(6 * parts.size() * parts.begin()->size()));
    double* at = vector.data();
    for (const NodeMotion& part : parts)
        for (const Vector6& node : part) {
            Vector6::Map(at) = node;
            at += 6;
        }
    return vector;
}

NodeMotion times(const std::vector<Matrix6>& blocks, const NodeMotion& x) {
    NodeMotion y(x.size());
    for (std::size_t k = 0; k < x.size(); ++k)
        y[k].noalias() = blocks[k] * x[k];
    return y;
}

/// x + factor y
NodeMotion sum(NodeMotion x, double factor, const NodeMotion& y) {
    for (std::size_t k = 0; k < x.size(); ++k)
        x[k] += factor * y[k];
    return x;
}

NodeMotion scaled(double factor, NodeMotion x) {
    for (Vector6& node : x)
        node *= factor;
    return x;
}

ComplexMotion complex_motion(const NodeMotion& real, const NodeMotion& imaginary) {
    ComplexMotion motion(real.size());
    for (std::size_t k = 0; k < real.size(); ++k)
        motion[k] = real[k].cast<Complex>() + Complex(0, 1) * imaginary[k];
    return motion;
}

BlockTridiagonal with_inertia(BlockTridiagonal stiffness, double square,
                              const std::vector<Matrix6>& mass) {
    for (std::size_t k = 0; k < mass.size(); ++k)
        stiffness.diagonal[k] += square * mass[k];
    return stiffness;
}

/// The least s for which K + s M is positive definite, of 0 and powers of 4. A state that may move
/// without force, as a helix may in a vertical hole, needs the smallest of them or a little more;
/// what needs more is not stable.
double lift_of(const VibrationMatrices& matrices) {
    constexpr double least = 4e-8;  // (2 pi 3e-5 Hz)^2
    constexpr double most = 4e-3;   // (2 pi 0.01 Hz)^2
    for (double lift = 0; lift <= most; lift = lift == 0 ? least : 4 * lift)
        if (BlockFactors(with_inertia(matrices.stiffness, lift, matrices.mass))
                .is_positive_definite())
            return lift;
    throw SimulationError(
        "the static state is not stable: a small motion lowers its energy, and it has no "
        "frequencies");
}

}  // namespace

FreeVibrations::FreeVibrations(const VibrationMatrices& matrices)
    : matrices_(matrices),
      lift_(lift_of(matrices)),
      stiffness_(with_inertia(matrices.stiffness, lift_, matrices.mass)),
      factors_(stiffness_) {}

std::vector<FreeVibration> FreeVibrations::at(double rotation_rate, std::size_t count) const {
    return rotation_rate == 0 ? at_rest(count) : turning(rotation_rate, count);
}

/// T = K^-1 M, self-adjoint with the metric M; its eigenvalues are 1/w^2.
std::vector<FreeVibration> FreeVibrations::at_rest(std::size_t count) const {
    const std::size_t rows = matrices_.rows();
    const auto inertia = [&](const VectorXd& x) {
        return times(matrices_.mass, nodes_from(x, 0, rows));
    };
    SelfAdjointOperator problem;
    problem.size = static_cast<Index>(6 * rows);
    problem.apply = [&](const VectorXd& x) { return joined({factors_.solve(inertia(x))}); };
    problem.metric = [&](const VectorXd& x) { return joined({inertia(x)}); };
    problem.count_above = [&](double value) {
        const BlockTridiagonal shifted = with_inertia(stiffness_, -1 / value, matrices_.mass);
        return static_cast<std::size_t>(BlockFactors(shifted).negative_eigenvalues());
    };
    std::vector<FreeVibration> found;
    for (const Eigenpair& pair : largest_eigenpairs(problem, count)) {
        const NodeMotion motion = nodes_from(pair.vector, 0, rows);
        found.push_back({std::sqrt(std::max(1 / pair.value - lift_, 0.0)),
                         complex_motion(motion, NodeMotion(rows, Vector6::Zero()))});
    }
    return found;
}

/// z = (u, u') with z' = A z. A is skew in the metric E = (K, M) of the energy, so that T = - A^-2
/// is self-adjoint in it; its eigenvalues are 1/w^2, and with z, J z = w A^-1 z is an eigenvector
/// too: the motion a quarter of a period earlier.
std::vector<FreeVibration> FreeVibrations::turning(double rotation_rate, std::size_t count) const {
    const std::size_t rows = matrices_.rows();
    // A^-1 (a, b) = (- K^-1 (M b + W G a), a)
    const auto inverse = [&](const NodeMotion& a, const NodeMotion& b) {
        return scaled(-1, factors_.solve(sum(times(matrices_.mass, b), rotation_rate,
                                             times(matrices_.gyroscopic, a))));
    };
    SelfAdjointOperator problem;
    problem.size = static_cast<Index>(12 * rows);
    problem.apply = [&](const VectorXd& z) {
        const NodeMotion u = nodes_from(z, 0, rows);
        const NodeMotion earlier = inverse(u, nodes_from(z, 1, rows));
        return joined({scaled(-1, inverse(earlier, u)), scaled(-1, earlier)});
    };
    problem.metric = [&](const VectorXd& z) {
        return joined({stiffness_.times(nodes_from(z, 0, rows)),
                       times(matrices_.mass, nodes_from(z, 1, rows))});
    };
    problem.partner = [&](const VectorXd& z, double value) {
        const double frequency = 1 / std::sqrt(value);
        const NodeMotion u = nodes_from(z, 0, rows);
        return joined(
            {scaled(frequency, inverse(u, nodes_from(z, 1, rows))), scaled(frequency, u)});
    };
    problem.count_above = [&](double value) {
        return count_below(1 / std::sqrt(value), rotation_rate);
    };
    std::vector<FreeVibration> found;
    for (const Eigenpair& pair : largest_eigenpairs(problem, count)) {
        const VectorXd partner = problem.partner(pair.vector, pair.value);
        found.push_back({1 / std::sqrt(pair.value), complex_motion(nodes_from(pair.vector, 0, rows),
                                                                   nodes_from(partner, 0, rows))});
    }
    return found;
}

/// x = (Re q, Im q): T = K^-1 (M - i G/n) is self-adjoint with the metric K; its eigenvalues are
/// 1/w^2, or negative. i q is the partner of q.
std::vector<FreeVibration> FreeVibrations::critical(double order, std::size_t count) const {
    const std::size_t rows = matrices_.rows();
    SelfAdjointOperator problem;
    problem.size = static_cast<Index>(12 * rows);
    problem.apply = [&](const VectorXd& x) {
        const NodeMotion real = nodes_from(x, 0, rows);
        const NodeMotion imaginary = nodes_from(x, 1, rows);
        const NodeMotion real_inertia =
            sum(times(matrices_.mass, real), 1 / order, times(matrices_.gyroscopic, imaginary));
        const NodeMotion imaginary_inertia =
            sum(times(matrices_.mass, imaginary), -1 / order, times(matrices_.gyroscopic, real));
        return joined({factors_.solve(real_inertia), factors_.solve(imaginary_inertia)});
    };
    problem.metric = [&](const VectorXd& x) {
        return joined(
            {stiffness_.times(nodes_from(x, 0, rows)), stiffness_.times(nodes_from(x, 1, rows))});
    };
    problem.partner = [&](const VectorXd& x, double) {
        return joined({scaled(-1, nodes_from(x, 1, rows)), nodes_from(x, 0, rows)});
    };
    problem.count_above = [&](double value) { return count_critical(order, 1 / std::sqrt(value)); };
    std::vector<FreeVibration> found;
    for (const Eigenpair& pair : largest_eigenpairs(problem, count))
        found.push_back(
            {1 / std::sqrt(pair.value),
             complex_motion(nodes_from(pair.vector, 0, rows), nodes_from(pair.vector, 1, rows))});
    return found;
}

std::size_t FreeVibrations::count_critical(double order, double frequency) const {
    return count_below(frequency, frequency / order);
}

/// As K is positive definite, each eigenvalue of this matrix falls through zero once as the
/// frequency rises, at a natural frequency; so too where the rate rises with the frequency.
std::size_t FreeVibrations::count_below(double frequency, double rotation_rate) const {
    const std::size_t rows = matrices_.rows();
    const double square = frequency * frequency;
    const Complex gyroscopic(0, frequency * rotation_rate);
    ComplexBlockTridiagonal matrix(rows);
    for (std::size_t k = 0; k < rows; ++k) {
        matrix.diagonal[k] = (stiffness_.diagonal[k] - square * matrices_.mass[k]).cast<Complex>() +
                             gyroscopic * matrices_.gyroscopic[k];
        matrix.upper[k] = stiffness_.upper[k].cast<Complex>();
        matrix.lower[k] = stiffness_.lower[k].cast<Complex>();
    }
    return static_cast<std::size_t>(ComplexBlockFactors(matrix).negative_eigenvalues());
}

}  // namespace drillstrand
