#include "statics/block_tridiagonal.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace drillstrand {

namespace {

template <class Scalar>
Block<Scalar> hermitian_part(const Block<Scalar>& m) {
    return 0.5 * (m + m.adjoint());
}

}  // namespace

template <class Scalar>
void BlockTridiagonalOf<Scalar>::set_zero() {
    for (std::vector<Block<Scalar>>* band : {&lower, &diagonal, &upper})
        std::fill(band->begin(), band->end(), Block<Scalar>::Zero());
}

template <class Scalar>
NodeVectors<Scalar> BlockTridiagonalOf<Scalar>::times(const NodeVectors<Scalar>& x) const {
    NodeVectors<Scalar> y(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
        y[k].noalias() = diagonal[k] * x[k];
        if (k > 0) y[k].noalias() += lower[k] * x[k - 1];
        if (k + 1 < x.size()) y[k].noalias() += upper[k] * x[k + 1];
    }
    return y;
}

template <class Scalar>
BlockFactorsOf<Scalar>::BlockFactorsOf(const BlockTridiagonalOf<Scalar>& matrix)
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

template <class Scalar>
NodeVectors<Scalar> BlockFactorsOf<Scalar>::solve(
    const NodeVectors<Scalar>& right_hand_side) const {
    NodeVectors<Scalar> x = right_hand_side;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (k > 0) x[k] -= lower_[k] * x[k - 1];
        x[k] = factor_[k].solve(x[k]).eval();
    }
    for (std::size_t k = x.size() - 1; k-- > 0;)
        x[k] -= above_[k] * x[k + 1];
    return x;
}

template <class Scalar>
bool BlockFactorsOf<Scalar>::is_positive_definite() const {
    return std::all_of(pivot_.begin(), pivot_.end(), [](const Block<Scalar>& pivot) {
        return Eigen::LLT<Block<Scalar>>(hermitian_part<Scalar>(pivot)).info() == Eigen::Success;
    });
}

template <class Scalar>
int BlockFactorsOf<Scalar>::negative_eigenvalues() const {
    int negative = 0;
    for (const Block<Scalar>& pivot : pivot_) {
        const Eigen::SelfAdjointEigenSolver<Block<Scalar>> solver(hermitian_part<Scalar>(pivot),
                                                                  Eigen::EigenvaluesOnly);
        negative += static_cast<int>((solver.eigenvalues().array() < 0).count());
    }
    return negative;
}

template <class Scalar>
int BlockFactorsOf<Scalar>::determinant_sign() const requires std::floating_point<Scalar> {
    int sign = 1;
    for (const auto& factor : factor_)
        sign *= factor.determinant() < 0 ? -1 : 1;
    return sign;
}

template struct BlockTridiagonalOf<double>;
template struct BlockTridiagonalOf<std::complex<double>>;
template class BlockFactorsOf<double>;
template class BlockFactorsOf<std::complex<double>>;

}  // namespace drillstrand
