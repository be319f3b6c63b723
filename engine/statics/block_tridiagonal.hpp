/// A block-tridiagonal system of 6 x 6 blocks, solved by block elimination in O(N).
#pragma once

#include <Eigen/LU>
#include <cstddef>
#include <vector>

#include "statics/rod_segment.hpp"
#include "statics/rod_state.hpp"

namespace drillstrand {

/// Row k couples to k-1 by lower[k], to itself by diagonal[k], to k+1 by upper[k].
struct BlockTridiagonal {
    explicit BlockTridiagonal(std::size_t rows)
        : lower(rows, Matrix6::Zero()),
          diagonal(rows, Matrix6::Zero()),
          upper(rows, Matrix6::Zero()) {}

    std::vector<Matrix6> lower, diagonal, upper;

    [[nodiscard]] std::size_t rows() const { return diagonal.size(); }
    void set_zero();
};

/// Factors of a block-tridiagonal matrix, each pivot block with partial pivoting.
class BlockFactors {
  public:
    explicit BlockFactors(const BlockTridiagonal& matrix);

    [[nodiscard]] NodeMotion solve(const NodeMotion& right_hand_side) const;

    /// Whether the symmetric parts of all pivot blocks are positive definite: for a symmetric
    /// matrix, whether it is.
    [[nodiscard]] bool is_positive_definite() const;
    /// Negative eigenvalues of the symmetric parts of the pivot blocks: for a symmetric matrix, the
    /// number of its own.
    [[nodiscard]] int negative_eigenvalues() const;
    /// +1 or -1, the sign of the determinant.
    [[nodiscard]] int determinant_sign() const;

  private:
    std::vector<Matrix6> lower_;
    std::vector<Matrix6> pivot_;
    std::vector<Eigen::PartialPivLU<Matrix6>> factor_;
    std::vector<Matrix6> above_;  ///< pivot^-1 upper
};

}  // namespace drillstrand
