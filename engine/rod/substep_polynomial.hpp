/// The polynomial of substeps: engine/rod/README.md, "Substeps".
#pragma once

#include <vector>

namespace drillstrand {

/// The stabilised polynomial phi of so many substeps: of a motion whose rate omega and the step T
/// make kappa = (omega T)^2/4, a step sees the part phi(kappa) of its force,
///
///     2 kappa phi(kappa) = 1 - T_p(w - beta kappa) / T_p(w),   w = 1 + nu/p^2,   phi(0) = 1,
///
/// T_p Chebyshev's polynomial; kappa phi is between 0.1 and 0.9 from its first maximum to its
/// reach, about 0.85 p^2.
class SubstepPolynomial {
  public:
    explicit SubstepPolynomial(int substeps);

    /// The fewest substeps that reach kappa.
    static int substeps_for(double kappa);

    [[nodiscard]] int substeps() const { return substeps_; }
    /// Largest kappa.
    [[nodiscard]] double reach() const { return (1 + w_) / beta_; }
    /// - phi'(0)
    [[nodiscard]] double slope() const;
    /// Of the first substep: y = first_factor T^2 M^-1 f.
    [[nodiscard]] double first_factor() const { return beta_ / (4 * w_); }
    /// omega_m = 2 w T_m(w)/T_m+1(w) of the substeps m = 1 ... p - 1: y += (omega - 1) times the
    /// last change + omega first_factor T^2 times the residual.
    [[nodiscard]] const std::vector<double>& weights() const { return weights_; }
    /// b_m of the places y_m before these substeps: what the nodes would need to get there from
    /// rest in a step is (2/T^2) M y = f - L (sum b_m y_m).
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

  private:
    int substeps_;
    double w_;
    double beta_;
    double value_;  ///< T_p(w)
    std::vector<double> weights_;
    std::vector<double> shares_;
};

}  // namespace drillstrand
