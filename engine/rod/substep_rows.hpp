/// The tables of a fine stretch: engine/rod/README.md, "Substeps".
#pragma once

#include <cstddef>

#include "numerics/block_table.hpp"
#include "numerics/triple.hpp"

namespace drillstrand {

/// Constants of segments and nodes of a stretch.
struct SubstepConstant {
    enum : std::size_t {
        deviating,      // segment, P = 12 k EI/h^3 (N/m)
        stretching,     // segment, (EA/h - P) 4/h^2 (N/m^3)
        bending,        // segment, B = EI/h (N m)
        twisting,       // segment, (GJ/h - B) 4/h^2 (N/m)
        mass,           // node, of its cell (kg)
        inverse_mass,   // node, 0 where its motion is prescribed (1/kg)
        transverse,     // node (kg m2)
        inverse_turn,   // node (1/(kg m2))
        polar,          // node (kg m2)
        inverse_polar,  // node (1/(kg m2))
        cell,           // node (m)
        rows
    };
};

/// What a step writes. Vectors take three lines.
struct SubstepLine {
    enum : std::size_t {
        force = 0,      // node, of rod and wall at the whole step (N)
        couple = 3,     // node (N m)
        down_well = 6,  // node, l
        director = 9,   // node, t
        axis = 12,      // segment, half its chord (m)
        place = 15,     // node, displacement in the substeps, by the shares of the polynomial (m)
        turn = 18,      // node, rotation, likewise
        force_change = 21,   // node, what the substeps make of its force, less the force (N)
        couple_change = 24,  // node (N m)
        pull = 27,           // segment, force on its first node, its reaction on the last (N)
        first_couple = 30,   // segment, couple on its first node (N m)
        last_couple = 33,    // segment, on its last
        to_axis = 36,        // node, r
        held = 39,           // node, force of the wall as it holds the node where it is (N)
        lateral = 42,        // node, mass that moves sideways (kg)
        inverse_lateral = 43,
        held_torque = 44,  // node (N m)
        // node, stiffness of the wall where it touches: toward the axis, elsewhere (N/m), and of
        // friction against the spin (N m)
        wall_normal = 45,
        wall_around = 46,
        wall_spin = 47,
        stored_outflow = 48,  // node (J)
        rows = 49
    };
};

inline Triples triples_of(BlockTable& table, std::size_t line) {
    return {table.row(line), table.row(line + 1), table.row(line + 2)};
}

/// The constants from the first node of a stretch on.
struct SubstepConstants {
    explicit SubstepConstants(const BlockTable& table)
        : deviating(table.row(SubstepConstant::deviating)),
          stretching(table.row(SubstepConstant::stretching)),
          bending(table.row(SubstepConstant::bending)),
          twisting(table.row(SubstepConstant::twisting)),
          mass(table.row(SubstepConstant::mass)),
          inverse_mass(table.row(SubstepConstant::inverse_mass)),
          transverse(table.row(SubstepConstant::transverse)),
          inverse_turn(table.row(SubstepConstant::inverse_turn)),
          polar(table.row(SubstepConstant::polar)),
          inverse_polar(table.row(SubstepConstant::inverse_polar)),
          cell(table.row(SubstepConstant::cell)) {}
    const double *deviating, *stretching, *bending, *twisting, *mass, *inverse_mass, *transverse,
        *inverse_turn, *polar, *inverse_polar, *cell;
};

/// What a step writes, from the first node of a stretch on.
struct SubstepLines {
    explicit SubstepLines(BlockTable& table)
        : force(triples_of(table, SubstepLine::force)),
          couple(triples_of(table, SubstepLine::couple)),
          down_well(triples_of(table, SubstepLine::down_well)),
          director(triples_of(table, SubstepLine::director)),
          axis(triples_of(table, SubstepLine::axis)),
          place(triples_of(table, SubstepLine::place)),
          turn(triples_of(table, SubstepLine::turn)),
          force_change(triples_of(table, SubstepLine::force_change)),
          couple_change(triples_of(table, SubstepLine::couple_change)),
          pull(triples_of(table, SubstepLine::pull)),
          first_couple(triples_of(table, SubstepLine::first_couple)),
          last_couple(triples_of(table, SubstepLine::last_couple)),
          to_axis(triples_of(table, SubstepLine::to_axis)),
          held(triples_of(table, SubstepLine::held)),
          lateral(table.row(SubstepLine::lateral)),
          inverse_lateral(table.row(SubstepLine::inverse_lateral)),
          held_torque(table.row(SubstepLine::held_torque)),
          wall_normal(table.row(SubstepLine::wall_normal)),
          wall_around(table.row(SubstepLine::wall_around)),
          wall_spin(table.row(SubstepLine::wall_spin)) {}

    Triples force, couple, down_well, director, axis, place, turn, force_change, couple_change,
        pull, first_couple, last_couple, to_axis, held;
    double *lateral, *inverse_lateral, *held_torque, *wall_normal, *wall_around, *wall_spin;
};

/// A mass that differs along and across a direction, times a vector.
DRILLSTRAND_INLINE Triple times(double across, double along, const Triple& direction,
                                const Triple& v) {
    return combine(across, v, (along - across) * dot(v, direction), direction);
}

// ------------------------------------------------------------------ a segment's answer

/// Of the straight, slack segment: P, (EA/h - P) 4/h^2, B, (GJ/h - B) 4/h^2.
template <class Real>
struct SlackSegment {
    Real deviating, stretching, bending, twisting;
};

/// u + a x b, in six multiplications that each add.
template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> plus_cross(const TripleOf<Real>& u, const TripleOf<Real>& a,
                                             const TripleOf<Real>& b) {
    return {u.x + a.y * b.z - a.z * b.y, u.y + a.z * b.x - a.x * b.z, u.z + a.x * b.y - a.y * b.x};
}

/// Its force on its first node when its nodes have moved apart and turned (the sum of both). `axis`
/// is half its chord: a rigid motion of what is stretched leaves no force, either.
template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> pull_of(const SlackSegment<Real>& segment,
                                          const TripleOf<Real>& axis, const TripleOf<Real>& apart,
                                          const TripleOf<Real>& both_turns) {
    const TripleOf<Real> across = plus_cross(apart, axis, both_turns);
    return combine(segment.deviating, across, segment.stretching * dot(apart, axis), axis);
}

/// Its couple on the first node by bending and twist, where the last turns more than the first.
/// With the lever of the pull, axis x pull on both nodes, it is all.
template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> bend_of(const SlackSegment<Real>& segment,
                                          const TripleOf<Real>& axis,
                                          const TripleOf<Real>& turned) {
    return combine(segment.bending, turned, segment.twisting * dot(turned, axis), axis);
}

/// The wall as it holds a node that touches.
template <class Real>
struct HoldingNode {
    TripleOf<Real> to_axis, director;
    Real normal, around, spin;  ///< N/m, N/m, N m

    [[nodiscard]] DRILLSTRAND_INLINE TripleOf<Real> force(const TripleOf<Real>& place) const {
        return combine(-around, place, (around - normal) * dot(place, to_axis), to_axis);
    }
    [[nodiscard]] DRILLSTRAND_INLINE Real torque(const TripleOf<Real>& turn) const {
        return -spin * dot(turn, director);
    }
};

}  // namespace drillstrand
