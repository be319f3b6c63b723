#include "rod/substep_rounds.hpp"

#include "numerics/kernel.hpp"
#include "rod/substep_rows.hpp"

namespace drillstrand {

namespace {

constexpr std::size_t pieces = block_size;

/// From the order of the string to that of the rounds.
template <class Real>
void take_over(const double* from, RoundBlock<Real>* to, std::size_t count, std::size_t line) {
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t piece = 0; piece < pieces; ++piece)
            to[i].line[line][piece] = static_cast<Real>(from[piece * count + i]);
}

template <class Real>
void hand_back(const RoundBlock<Real>* from, std::size_t count, std::size_t line, double* to) {
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t piece = 0; piece < pieces; ++piece)
            to[piece * count + i] = from[i].line[line][piece];
}

/// Before the first block the last nodes of the pieces before.
template <class Real>
DRILLSTRAND_INLINE void continue_before(RoundBlock<Real>* first, std::size_t count,
                                        std::size_t line) {
    Real* before = first[-1].line[line];
    const Real* last = first[count - 1].line[line];
    before[0] = 0;
    for (std::size_t piece = 1; piece < pieces; ++piece)
        before[piece] = last[piece - 1];
}

/// Behind the last block the first nodes of the pieces behind.
template <class Real>
DRILLSTRAND_INLINE void continue_behind(RoundBlock<Real>* first, std::size_t count,
                                        std::size_t line) {
    Real* behind = first[count].line[line];
    for (std::size_t piece = 0; piece + 1 < pieces; ++piece)
        behind[piece] = first[0].line[line][piece + 1];
}

// ------------------------------------------------------------------ one node, one segment

template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> at(const Real (*lines)[pieces], std::size_t j) {
    return {lines[0][j], lines[1][j], lines[2][j]};
}

template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> at(const RoundBlock<Real>& block, std::size_t line,
                                     std::size_t j) {
    return at(block.line + line, j);
}

template <class Real>
DRILLSTRAND_INLINE void set(Real (*lines)[pieces], std::size_t j, const TripleOf<Real>& v) {
    lines[0][j] = v.x;
    lines[1][j] = v.y;
    lines[2][j] = v.z;
}

template <class Real>
DRILLSTRAND_INLINE void set(RoundBlock<Real>& block, std::size_t line, std::size_t j,
                            const TripleOf<Real>& v) {
    set(block.line + line, j, v);
}

template <class Real>
DRILLSTRAND_INLINE SlackSegment<Real> segment_of(const RoundBlock<Real>& block, std::size_t j) {
    return {block.line[RoundLine::deviating][j], block.line[RoundLine::stretching][j],
            block.line[RoundLine::bending][j], block.line[RoundLine::twisting][j]};
}

template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> pull_of(const RoundBlock<Real>& here,
                                          const RoundBlock<Real>& next, std::size_t j) {
    return pull_of(segment_of(here, j), at(here, RoundLine::axis, j),
                   combine(1, at(next, RoundLine::place, j), -1, at(here, RoundLine::place, j)),
                   combine(1, at(next, RoundLine::turn, j), 1, at(here, RoundLine::turn, j)));
}

template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> bend_of(const RoundBlock<Real>& here,
                                          const RoundBlock<Real>& next, std::size_t j) {
    return bend_of(segment_of(here, j), at(here, RoundLine::axis, j),
                   combine(1, at(next, RoundLine::turn, j), -1, at(here, RoundLine::turn, j)));
}

/// `factor` times what a force does to a node by its masses.
template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> moved(const RoundBlock<Real>& here, std::size_t j, Real factor,
                                        const TripleOf<Real>& force) {
    const TripleOf<Real> l = at(here, RoundLine::down_well, j);
    const Real across = factor * here.line[RoundLine::inverse_lateral][j];
    const Real along = (factor * here.line[RoundLine::inverse_mass][j] - across) * dot(force, l);
    return combine(across, force, along, l);
}

/// Likewise a couple, and a torque about the director besides.
template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> turned(const RoundBlock<Real>& here, std::size_t j, Real factor,
                                         const TripleOf<Real>& couple, Real torque) {
    const TripleOf<Real> t = at(here, RoundLine::director, j);
    const Real turning = factor * here.line[RoundLine::inverse_turn][j];
    const Real about = dot(couple, t);
    const Real spinning =
        factor * here.line[RoundLine::inverse_polar][j] * (about + torque) - turning * about;
    return combine(turning, couple, spinning, t);
}

/// From rest to where the forces alone bring a node in the first substep.
template <class Real>
DRILLSTRAND_INLINE void start(RoundBlock<Real>& here, std::size_t j, Real factor) {
    const TripleOf<Real> step_on = moved(here, j, factor, at(here, RoundLine::force, j));
    const TripleOf<Real> turn_on = turned(here, j, factor, at(here, RoundLine::couple, j), Real(0));
    set(here, RoundLine::place, j, step_on);
    set(here, RoundLine::turn, j, turn_on);
    set(here, RoundLine::place_change, j, step_on);
    set(here, RoundLine::turn_change, j, turn_on);
    set(here, RoundLine::place_share, j, TripleOf<Real>{0, 0, 0});
    set(here, RoundLine::turn_share, j, TripleOf<Real>{0, 0, 0});
}

template <class Real>
DRILLSTRAND_INLINE void add_share(RoundBlock<Real>& here, std::size_t j, Real share) {
    set(here, RoundLine::place_share, j,
        combine(1, at(here, RoundLine::place_share, j), share, at(here, RoundLine::place, j)));
    set(here, RoundLine::turn_share, j,
        combine(1, at(here, RoundLine::turn_share, j), share, at(here, RoundLine::turn, j)));
}

/// Forces that the segments of a block leave to the last of their nodes, which are in the next.
template <class Real>
struct LeftBehind {
    alignas(block_alignment) Real pull[3][pieces];
    alignas(block_alignment) Real couple[3][pieces];
};

/// What the segments before the first block leave to it.
template <class Real>
DRILLSTRAND_INLINE void leave(const RoundBlock<Real>& before, const RoundBlock<Real>& first,
                              std::size_t j, LeftBehind<Real>& behind) {
    const TripleOf<Real> pull = pull_of(before, first, j);
    const TripleOf<Real> lever = cross(at(before, RoundLine::axis, j), pull);
    set(behind.pull, j, pull);
    set(behind.couple, j, combine(1, lever, -1, bend_of(before, first, j)));
}

/// One round of a node: by `kept` of its last change and by `factor` times the forces that are left
/// where it is.
template <bool touches, class Real>
DRILLSTRAND_INLINE void go_on(RoundBlock<Real>& here, const RoundBlock<Real>& next, std::size_t j,
                              Real share, Real kept, Real factor, LeftBehind<Real>& behind) {
    const TripleOf<Real> y = at(here, RoundLine::place, j);
    const TripleOf<Real> a = at(here, RoundLine::turn, j);
    const TripleOf<Real> pull = pull_of(here, next, j);
    const TripleOf<Real> bend = bend_of(here, next, j);
    const TripleOf<Real> lever = cross(at(here, RoundLine::axis, j), pull);
    TripleOf<Real> force =
        combine(1, at(here, RoundLine::force, j), 1, combine(1, pull, -1, at(behind.pull, j)));
    const TripleOf<Real> couple =
        combine(1, combine(1, at(here, RoundLine::couple, j), 1, at(behind.couple, j)), 1,
                combine(1, lever, 1, bend));
    set(behind.pull, j, pull);
    set(behind.couple, j, combine(1, lever, -1, bend));
    Real torque = 0;
    if constexpr (touches) {
        const HoldingNode<Real> wall = {
            at(here, RoundLine::to_axis, j), at(here, RoundLine::director, j),
            here.line[RoundLine::wall_normal][j], here.line[RoundLine::wall_around][j],
            here.line[RoundLine::wall_spin][j]};
        force = combine(1, force, 1, wall.force(y));
        torque = wall.torque(a);
    }
    const TripleOf<Real> step_on =
        combine(kept, at(here, RoundLine::place_change, j), 1, moved(here, j, factor, force));
    const TripleOf<Real> turn_on = combine(kept, at(here, RoundLine::turn_change, j), 1,
                                           turned(here, j, factor, couple, torque));
    add_share(here, j, share);
    set(here, RoundLine::place_change, j, step_on);
    set(here, RoundLine::turn_change, j, turn_on);
    set(here, RoundLine::place, j, combine(1, y, 1, step_on));
    set(here, RoundLine::turn, j, combine(1, a, 1, turn_on));
}

// ------------------------------------------------------------------ a stretch

template <class Real, bool touches>
DRILLSTRAND_KERNEL void take_rounds(const SubstepPolynomial& polynomial, double step,
                                    RoundBlock<Real>* first, std::size_t count) {
    const double first_factor = polynomial.first_factor() * step * step;
    const std::vector<double>& weights = polynomial.weights();
    const std::vector<double>& shares = polynomial.shares();
    for (std::size_t block = 0; block < count; ++block) {
        const auto factor = static_cast<Real>(first_factor);
#pragma omp simd
        for (std::size_t j = 0; j < pieces; ++j)
            start(first[block], j, factor);
    }
    for (std::size_t m = 0; m + 1 < weights.size(); ++m) {
        for (std::size_t line = RoundLine::place; line < RoundLine::turn + 3; ++line) {
            continue_before(first, count, line);
            continue_behind(first, count, line);
        }
        const auto share = static_cast<Real>(shares[m]);
        const auto kept = static_cast<Real>(weights[m] - 1);
        const auto factor = static_cast<Real>(weights[m] * first_factor);
        LeftBehind<Real> behind;
#pragma omp simd
        for (std::size_t j = 0; j < pieces; ++j)
            leave(first[-1], first[0], j, behind);
        for (std::size_t block = 0; block < count; ++block) {
            RoundBlock<Real>& here = first[block];
#pragma omp simd
            for (std::size_t j = 0; j < pieces; ++j)
                go_on<touches>(here, first[block + 1], j, share, kept, factor, behind);
        }
    }
    for (std::size_t block = 0; block < count; ++block) {
        const auto share = static_cast<Real>(shares.back());
#pragma omp simd
        for (std::size_t j = 0; j < pieces; ++j)
            add_share(first[block], j, share);
    }
}

}  // namespace

template <class Real>
SubstepRounds<Real>::SubstepRounds(const BlockTable& constants) : blocks_(constants.blocks() + 2) {
    const auto take = [&](std::size_t from, std::size_t line) {
        take_over(constants.row(from), &blocks_[1], count(), line);
    };
    take(SubstepConstant::deviating, RoundLine::deviating);
    take(SubstepConstant::stretching, RoundLine::stretching);
    take(SubstepConstant::bending, RoundLine::bending);
    take(SubstepConstant::twisting, RoundLine::twisting);
    for (std::size_t line = RoundLine::deviating; line <= RoundLine::twisting; ++line)
        continue_before(&blocks_[1], count(), line);
    take(SubstepConstant::inverse_mass, RoundLine::inverse_mass);
    take(SubstepConstant::inverse_turn, RoundLine::inverse_turn);
    take(SubstepConstant::inverse_polar, RoundLine::inverse_polar);
}

template <class Real>
void SubstepRounds<Real>::begin_step(const BlockTable& lines) {
    const auto take = [&](std::size_t from, std::size_t line, std::size_t rows) {
        for (std::size_t i = 0; i < rows; ++i)
            take_over(lines.row(from + i), &blocks_[1], count(), line + i);
    };
    take(SubstepLine::axis, RoundLine::axis, 3);
    for (std::size_t i = 0; i < 3; ++i)
        continue_before(&blocks_[1], count(), RoundLine::axis + i);
    take(SubstepLine::down_well, RoundLine::down_well, 3);
    take(SubstepLine::director, RoundLine::director, 3);
    take(SubstepLine::to_axis, RoundLine::to_axis, 3);
    take(SubstepLine::inverse_lateral, RoundLine::inverse_lateral, 1);
    take(SubstepLine::wall_normal, RoundLine::wall_normal, 1);
    take(SubstepLine::wall_around, RoundLine::wall_around, 1);
    take(SubstepLine::wall_spin, RoundLine::wall_spin, 1);
}

template <class Real>
void SubstepRounds<Real>::take(Level level, const SubstepPolynomial& polynomial, double step,
                               bool touches, BlockTable& lines) {
    for (std::size_t i = 0; i < 3; ++i) {
        take_over(lines.row(SubstepLine::force + i), &blocks_[1], count(), RoundLine::force + i);
        take_over(lines.row(SubstepLine::couple + i), &blocks_[1], count(), RoundLine::couple + i);
    }
    const auto kernel = touches ? at_level<take_rounds<Real, true>>(level)
                                : at_level<take_rounds<Real, false>>(level);
    kernel(polynomial, step, &blocks_[1], count());
    for (std::size_t i = 0; i < 3; ++i) {
        hand_back(&blocks_[1], count(), RoundLine::place_share + i,
                  lines.row(SubstepLine::place + i));
        hand_back(&blocks_[1], count(), RoundLine::turn_share + i,
                  lines.row(SubstepLine::turn + i));
    }
}

template class SubstepRounds<float>;
template class SubstepRounds<double>;

}  // namespace drillstrand
