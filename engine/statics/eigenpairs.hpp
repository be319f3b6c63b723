/// The largest eigenvalues of a large operator, by the Lanczos method of the library Spectra.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace drillstrand {

/// y = T x, where T is self-adjoint in the inner product x . (metric y).
struct SelfAdjointOperator {
    using Map = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

    Eigen::Index size = 0;
    Map apply;
    Map metric;
    /// Where every eigenvalue is double, since a motion and the same a quarter of a period later
    /// are two vectors: the other one of an eigenvector (of a given eigenvalue), as long and normal
    /// to it. Such a pair counts once. Empty: none.
    std::function<Eigen::VectorXd(const Eigen::VectorXd&, double)> partner;
    /// The number of eigenvalues above a positive one.
    std::function<std::size_t(double)> count_above;
};

struct Eigenpair {
    double value;
    Eigen::VectorXd vector;  ///< of length 1 in the metric
};

/// The `wanted` largest eigenvalues, which are positive, in descending order. The Lanczos method
/// alone may miss one of several that are equal, as those of both bending planes are: it runs again
/// beside what it has found until count_above() says that none is missing. Throws SimulationError
/// where it cannot find them.
std::vector<Eigenpair> largest_eigenpairs(const SelfAdjointOperator& problem, std::size_t wanted);

}  // namespace drillstrand
