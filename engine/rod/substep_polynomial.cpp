#include "rod/substep_polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace drillstrand {

namespace {

/// Damping of the polynomial: keeps kappa phi away from 0 and 1.
constexpr double nu = 0.25;

struct Chebyshev {
    double w, value, slope;  ///< w, T_p(w), T_p'(w)

    explicit Chebyshev(int p)
        : w(1 + nu / (static_cast<double>(p) * p)), value(std::cosh(p * std::acosh(w))) {
        const double angle = std::acosh(w);
        slope = p * std::sinh(p * angle) / std::sinh(angle);
    }
    [[nodiscard]] double beta() const { return 2 * value / slope; }
    [[nodiscard]] double reach() const { return (1 + w) / beta(); }
};

}  // namespace

SubstepPolynomial::SubstepPolynomial(int substeps) : substeps_(substeps) {
    const Chebyshev at(substeps);
    w_ = at.w;
    beta_ = at.beta();
    value_ = at.value;
    double before = 1;
    double here = w_;
    for (int m = 1; m < substeps; ++m) {
        const double next = 2 * w_ * here - before;
        weights_.push_back(2 * w_ * here / next);
        before = here;
        here = next;
    }
    // y_p = y_1 + sum of the changes, each of them omega first_factor T^2 M^-1 (f - L y_m) and
    // omega - 1 of the one before
    shares_.resize(weights_.size());
    double answer = 0;  // of all later places to a change
    for (std::size_t m = weights_.size(); m-- > 0;) {
        shares_[m] = 2 * first_factor() * weights_[m] * (1 + answer);
        answer = (weights_[m] - 1) * (1 + answer);
    }
}

int SubstepPolynomial::substeps_for(double kappa) {
    if (kappa <= 1) return 1;
    int p = std::max(2, static_cast<int>(std::sqrt(kappa)));
    while (Chebyshev(p).reach() < kappa)
        ++p;
    return p;
}

double SubstepPolynomial::slope() const {
    const double p2 = static_cast<double>(substeps_) * substeps_;
    const double first = 2 * value_ / beta_;
    const double second = (w_ * first - p2 * value_) / (1 - w_ * w_);
    return beta_ * beta_ * second / (4 * value_);
}

}  // namespace drillstrand
