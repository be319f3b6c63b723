#include "statics/tridiagonal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace drillstrand {

TridiagonalFactors::TridiagonalFactors(const SymmetricTridiagonal& matrix) {
    const Eigen::VectorXd& off = matrix.off_diagonal;
    const Eigen::Index size = matrix.diagonal.size();
    const double least =
        std::numeric_limits<double>::epsilon() * matrix.diagonal.cwiseAbs().maxCoeff();
    std::array<double, 3> row = {matrix.diagonal[0], size > 1 ? off[0] : 0, 0};
    for (Eigen::Index k = 0; k < size; ++k) {
        std::array<double, 3> next{};
        if (k + 1 < size) next = {off[k], matrix.diagonal[k + 1], k + 2 < size ? off[k + 1] : 0};
        const bool exchanged = std::abs(next[0]) > std::abs(row[0]);
        if (exchanged) std::swap(row, next);
        if (std::abs(row[0]) < least) row[0] = least;
        const double multiplier = next[0] / row[0];
        rows_.push_back({row, multiplier, exchanged});
        row = {next[1] - multiplier * row[1], next[2] - multiplier * row[2], 0};
    }
}

Eigen::VectorXd TridiagonalFactors::solve(Eigen::VectorXd right_side) const {
    Eigen::VectorXd& x = right_side;
    const Eigen::Index size = x.size();
    const auto row = [&](Eigen::Index k) -> const Row& {
        return rows_[static_cast<std::size_t>(k)];
    };
    for (Eigen::Index k = 0; k + 1 < size; ++k) {
        if (row(k).exchanged) std::swap(x[k], x[k + 1]);
        x[k + 1] -= row(k).multiplier * x[k];
    }
    for (Eigen::Index k = size; k-- > 0;) {
        for (Eigen::Index right = 1; right <= 2 && k + right < size; ++right)
            x[k] -= row(k).upper[static_cast<std::size_t>(right)] * x[k + right];
        x[k] /= row(k).upper[0];
    }
    return right_side;
}

}  // namespace drillstrand
