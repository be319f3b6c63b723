#include "statics/eigenpairs.hpp"

#include <Spectra/SymEigsBase.h>

#include <algorithm>
#include <cmath>

#include "drillstrand/error.hpp"

namespace drillstrand {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Eigenvectors that have been found, with their partners.
class Found {
  public:
    explicit Found(const SelfAdjointOperator& problem) : problem_(problem) {}

    /// x less its components along all of them.
    [[nodiscard]] VectorXd rest_of(const VectorXd& x) const {
        VectorXd rest = x;
        for (std::size_t k = 0; k < basis_.size(); ++k)
            rest -= image_[k].dot(x) * basis_[k];
        return rest;
    }

    /// Takes an eigenvector of length 1, unless it is a mixture of those that are there.
    void take(double value, const VectorXd& vector) {
        constexpr double new_part = 0.5;
        VectorXd rest = rest_of(vector);
        const double length = std::sqrt(rest.dot(problem_.metric(rest)));
        if (length < new_part) return;
        rest /= length;
        pairs_.push_back({value, rest});
        keep(rest);
        if (problem_.partner) keep(problem_.partner(rest, value));
    }

    /// In descending order.
    [[nodiscard]] std::vector<Eigenpair> sorted() const {
        std::vector<Eigenpair> pairs = pairs_;
        std::sort(pairs.begin(), pairs.end(),
                  [](const Eigenpair& a, const Eigenpair& b) { return a.value > b.value; });
        return pairs;
    }

    [[nodiscard]] Index dimensions() const { return static_cast<Index>(basis_.size()); }

  private:
    void keep(const VectorXd& vector) {
        basis_.push_back(vector);
        image_.push_back(problem_.metric(vector));
    }

    const SelfAdjointOperator& problem_;
    std::vector<Eigenpair> pairs_;
    std::vector<VectorXd> basis_;
    std::vector<VectorXd> image_;  ///< metric times basis
};

/// The operator beside what has been found, in the form that Spectra asks for; scaled, since
/// Spectra holds some residuals against absolute bounds.
struct RemainingOperator {
    using Scalar = double;

    const SelfAdjointOperator& problem;
    const Found& found;
    double scale;

    [[nodiscard]] Index rows() const { return problem.size; }
    void perform_op(const double* x, double* y) const {
        const Eigen::Map<const VectorXd> given(x, problem.size);
        Eigen::Map<VectorXd>(y, problem.size) =
            found.rest_of(scale * problem.apply(found.rest_of(given)));
    }
};

struct Metric {
    const SelfAdjointOperator& problem;

    void perform_op(const double* x, double* y) const {
        const Eigen::Map<const VectorXd> given(x, problem.size);
        Eigen::Map<VectorXd>(y, problem.size) = problem.metric(given);
    }
};

using Lanczos = Spectra::SymEigsBase<RemainingOperator, Metric>;

/// The size of the largest eigenvalue, roughly.
double size_of(const SelfAdjointOperator& problem) {
    Spectra::SimpleRandom<double> dice(1);
    VectorXd x = dice.random_vec(problem.size);
    double size = 1;
    constexpr int rounds = 3;
    for (int i = 0; i < rounds; ++i) {
        const VectorXd y = problem.apply(x);
        const double length = std::sqrt(y.dot(problem.metric(y)));
        size = length / std::sqrt(x.dot(problem.metric(x)));
        x = y / length;
    }
    return size;
}

void run_lanczos(const SelfAdjointOperator& problem, std::size_t wanted, double size,
                 Found& found) {
    constexpr Index extra = 10;
    constexpr Index most_restarts = 300;
    constexpr double tolerance = 1e-10;
    RemainingOperator remaining{problem, found, 1 / size};
    const Metric metric{problem};
    const Index left = problem.size - found.dimensions();
    const Index count = std::min(static_cast<Index>(wanted), left - 1);
    if (count < 1) return;
    Lanczos lanczos(remaining, metric, count, std::min(2 * count + extra, left));
    lanczos.init();
    lanczos.compute(Spectra::SortRule::LargestAlge, most_restarts, tolerance,
                    Spectra::SortRule::LargestAlge);
    const VectorXd values = lanczos.eigenvalues();
    const Eigen::MatrixXd vectors = lanczos.eigenvectors();
    for (Index k = 0; k < values.size(); ++k)
        if (values[k] > 0) found.take(values[k] * size, vectors.col(k));
}

}  // namespace

std::vector<Eigenpair> largest_eigenpairs(const SelfAdjointOperator& problem, std::size_t wanted) {
    constexpr int most_runs = 12;
    constexpr double beside = 1e-6;  // a count is not certain closer to an eigenvalue
    const double size = size_of(problem);
    Found found(problem);
    for (int run = 0; run < most_runs && wanted > 0; ++run) {
        run_lanczos(problem, wanted, size, found);
        std::vector<Eigenpair> pairs = found.sorted();
        if (pairs.size() < wanted) continue;
        const double bound = pairs[wanted - 1].value * (1 - beside);
        const auto above = static_cast<std::size_t>(std::count_if(
            pairs.begin(), pairs.end(), [&](const Eigenpair& pair) { return pair.value > bound; }));
        if (above < problem.count_above(bound)) continue;
        pairs.resize(wanted);
        return pairs;
    }
    if (wanted == 0) return {};
    throw SimulationError("the modes of vibration cannot be told apart; ask for fewer");
}

}  // namespace drillstrand
