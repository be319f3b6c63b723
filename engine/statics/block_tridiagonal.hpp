/// A block-tridiagonal system of 6 x 6 blocks, solved by block elimination in O(N).
#pragma once

#include <Eigen/LU>
#include <complex>
#include <concepts>
#include <cstddef>
#include <vector>

#include "statics/rod_segment.hpp"
#include "statics/rod_state.hpp"

namespace drillstrand {

/// Real, or complex where a motion has a phase.
template <class Scalar>
using Block = Eigen::Matrix<Scalar, 6, 6>;
template <class Scalar>
using NodeVectors = std::vector<Eigen::Matrix<Scalar, 6, 1>>;

/// Row k couples to k-1 by lower[k], to itself by diagonal[k], to k+1 by upper[k].
template <class Scalar>
struct BlockTridiagonalOf {
    explicit BlockTridiagonalOf(std::size_t rows)
        : lower(rows, Block<Scalar>::Zero()),
          diagonal(rows, Block<Scalar>::Zero()),
          upper(rows, Block<Scalar>::Zero()) {}

    std::vector<Block<Scalar>> lower, diagonal, upper;

    [[nodiscard]] std::size_t rows() const { return diagonal.size(); }
    void set_zero();
    /// The product with a vector.
    [[nodiscard]] NodeVectors<Scalar> times(const NodeVectors<Scalar>& x) const;
};

/// Factors of a block-tridiagonal matrix, each pivot block with partial pivoting.
template <class Scalar>
class BlockFactorsOf {
  public:
    explicit BlockFactorsOf(const BlockTridiagonalOf<Scalar>& matrix);

    [[nodiscard]] NodeVectors<Scalar> solve(const NodeVectors<Scalar>& right_hand_side) const;

    /// Whether the Hermitian parts of all pivot blocks are positive definite: for a Hermitian
    /// matrix, whether it is.
    [[nodiscard]] bool is_positive_definite() const;
    /// Negative eigenvalues of the Hermitian parts of the pivot blocks: for a Hermitian matrix, the
    /// number of its own.
    [[nodiscard]] int negative_eigenvalues() const;
    /// +1 or -1, the sign of the determinant.
    [[nodiscard]] int determinant_sign() const requires std::floating_point<Scalar>;

  private:
    std::vector<Block<Scalar>> lower_;
    std::vector<Block<Scalar>> pivot_;
    std::vector<Eigen::PartialPivLU<Block<Scalar>>> factor_;
    std::vector<Block<Scalar>> above_;  ///< pivot^-1 upper
};

using BlockTridiagonal = BlockTridiagonalOf<double>;
using BlockFactors = BlockFactorsOf<double>;
using ComplexBlockTridiagonal = BlockTridiagonalOf<std::complex<double>>;
using ComplexBlockFactors = BlockFactorsOf<std::complex<double>>;

}  // namespace drillstrand
