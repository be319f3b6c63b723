/// The rounds of substeps: places from forces, from the forces of what has moved, and so on:
/// engine/rod/README.md, "Substeps".
#pragma once

#include <cstddef>
#include <vector>

#include "drillstrand/isa.hpp"
#include "numerics/block_table.hpp"
#include "rod/substep_polynomial.hpp"

namespace drillstrand {

/// What rounds read and write of a node and of the segment behind it. Vectors take three lines.
struct RoundLine {
    enum : std::size_t {
        // of the string
        deviating = 0,
        stretching,
        bending,
        twisting,
        inverse_mass,
        inverse_turn,
        inverse_polar,
        // of the step
        axis,
        down_well = axis + 3,
        director = down_well + 3,
        to_axis = director + 3,
        inverse_lateral = to_axis + 3,
        wall_normal,
        wall_around,
        wall_spin,
        force,
        couple = force + 3,
        // of the round
        place = couple + 3,
        turn = place + 3,
        place_change = turn + 3,
        turn_change = place_change + 3,
        place_share = turn_change + 3,
        turn_share = place_share + 3,
        count = turn_share + 3
    };
};

template <class Real>
struct RoundBlock {
    alignas(block_alignment) Real line[RoundLine::count][block_size] = {};
};

/// What the nodes of a stretch go through in a step, in numbers of type Real.
///
/// The stretch is cut into pieces, one for each entry of a block. A block holds the first nodes of
/// all pieces, the next their second ones, and so on: neighbours along the string are entries of
/// neighbouring blocks, nothing is read from between two vectors, and all numbers of a round lie
/// behind each other.
template <class Real>
class SubstepRounds {
  public:
    SubstepRounds() = default;
    /// Of a stretch with these constants (SubstepConstant).
    explicit SubstepRounds(const BlockTable& constants);

    /// Takes over what stays the same in a step: axes, directions, masses, walls (SubstepLine).
    void begin_step(const BlockTable& lines);

    /// The places and turns of the rounds under the forces of `lines` from rest, by the shares of
    /// the polynomial, into `lines`; `touches`: whether a node is held by the wall.
    void take(Level level, const SubstepPolynomial& polynomial, double step, bool touches,
              BlockTable& lines);

  private:
    using Block = RoundBlock<Real>;
    /// Without the ones before and behind, which hold what neighbouring pieces lend each other.
    [[nodiscard]] std::size_t count() const { return blocks_.size() - 2; }

    std::vector<Block> blocks_;
};

}  // namespace drillstrand
