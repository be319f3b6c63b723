/// Symmetric tridiagonal systems that may be singular to the last digit, as inverse iteration
/// needs.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace drillstrand {

struct SymmetricTridiagonal {
    Eigen::VectorXd diagonal;      ///< n
    Eigen::VectorXd off_diagonal;  ///< n - 1
};

/// Gaussian elimination with row exchanges. Pivots below rounding count as rounding, so that a
/// singular matrix gives large but finite solutions along its null vector.
class TridiagonalFactors {
  public:
    explicit TridiagonalFactors(const SymmetricTridiagonal& matrix);

    [[nodiscard]] Eigen::VectorXd solve(Eigen::VectorXd right_side) const;

  private:
    struct Row {
        std::array<double, 3> upper{};  ///< diagonal and the two entries right of it
        double multiplier = 0;          ///< of this row, taken from the next
        bool exchanged = false;         ///< with the next row, before that
    };
    std::vector<Row> rows_;
};

}  // namespace drillstrand
