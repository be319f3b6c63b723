#include "statics/block_tridiagonal.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace drillstrand {

namespace {

Matrix6 symmetric_part(const Matrix6& m) {
    return 0.5 * (m + m.transpose());
}

}  // namespace

void BlockTridiagonal::set_zero() {
    for (std::vector<Matrix6>* band : {&lower, &diagonal, &upper})
        std::fill(band->begin(), band->end(), Matrix6::Zero());
}

BlockFactors::BlockFactors(const BlockTridiagonal& matrix)
    : lower_(matrix.lower), pivot_(matrix.diagonal) {
    const std::size_t rows = matrix.rows();
    factor_.reserve(rows);
    above_.reserve(rows);
    for (std::size_t k = 0; k < rows; ++k) {
        if (k > 0) pivot_[k].noalias() -= lower_[k] * above_[k - 1];
        factor_.emplace_back(pivot_[k]);
        above_.emplace_back(factor_.back().solve(matrix.upper[k]));
    }
}

NodeMotion BlockFactors::solve(const NodeMotion& right_hand_side) const {
    NodeMotion x = right_hand_side;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (k > 0) x[k] -= lower_[k] * x[k - 1];
        x[k] = factor_[k].solve(x[k]).eval();
    }
    for (std::size_t k = x.size() - 1; k-- > 0;)
        x[k] -= above_[k] * x[k + 1];
    return x;
}

bool BlockFactors::is_positive_definite() const {
    return std::all_of(pivot_.begin(), pivot_.end(), [](const Matrix6& pivot) {
        return Eigen::LLT<Matrix6>(symmetric_part(pivot)).info() == Eigen::Success;
    });
}

int BlockFactors::negative_eigenvalues() const {
    int negative = 0;
    for (const Matrix6& pivot : pivot_) {
        const Eigen::SelfAdjointEigenSolver<Matrix6> solver(symmetric_part(pivot),
                                                            Eigen::EigenvaluesOnly);
        negative += static_cast<int>((solver.eigenvalues().array() < 0).count());
    }
    return negative;
}

int BlockFactors::determinant_sign() const {
    int sign = 1;
    for (const auto& factor : factor_)
        sign *= factor.determinant() < 0 ? -1 : 1;
    return sign;
}

}  // namespace drillstrand
