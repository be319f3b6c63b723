/// The rows of the director rod as its kernels see them: named views from an entry on, and lines
/// that one loop hands to the next.
#pragma once

#include <cstddef>
#include <type_traits>

#include "model/pose.hpp"
#include "numerics/kernel.hpp"
#include "numerics/triple.hpp"
#include "rod/director.hpp"

namespace drillstrand {

/// The nodes of the rod: `Vectors` and `Numbers` to write or to read.
template <class Vectors, class Numbers>
struct NodeRows {
    template <class Rod>
    NodeRows(Rod& rod, std::ptrdiff_t first)
        : x(rod.triples(DirectorRow::position, first)),
          v(rod.triples(DirectorRow::velocity, first)),
          t(rod.triples(DirectorRow::director, first)),
          w(rod.triples(DirectorRow::angular_velocity, first)),
          last_t(rod.triples(DirectorRow::last_director, first)),
          d1(rod.triples(DirectorRow::material, first)),
          s(rod.row(DirectorRow::spin) + first),
          last_twist(rod.row(DirectorRow::last_twist) + first) {}
    Vectors x, v, t, w, last_t, d1;
    Numbers s, last_twist;
};
using NodesIn = NodeRows<ConstTriples, const double*>;
using NodesOut = NodeRows<Triples, double*>;

/// What segments hand to nodes: `Vectors` and `Numbers` to write or to read.
template <class Vectors, class Numbers>
struct SegmentRows {
    template <class Segments>
    SegmentRows(Segments& segments, std::ptrdiff_t first)
        : pull(segments.triples(SegmentRow::pull, first)),
          last_pull(segments.triples(SegmentRow::last_pull, first)),
          first_lean(segments.triples(SegmentRow::first_lean, first)),
          last_lean(segments.triples(SegmentRow::last_lean, first)),
          first_couple(segments.triples(SegmentRow::first_couple, first)),
          last_couple(segments.triples(SegmentRow::last_couple, first)),
          viscous_pull(segments.triples(SegmentRow::viscous_pull, first)),
          viscous_couple(segments.triples(SegmentRow::viscous_couple, first)),
          viscous_lean(segments.triples(SegmentRow::viscous_lean, first)),
          drag_force(segments.triples(SegmentRow::drag_force, first)),
          drag_couple(segments.triples(SegmentRow::drag_couple, first)),
          twist(segments.row(SegmentRow::twist) + first),
          torque(segments.row(SegmentRow::torque) + first),
          last_torque(segments.row(SegmentRow::last_torque) + first),
          viscous_torque(segments.row(SegmentRow::viscous_torque) + first) {}
    Vectors pull, last_pull, first_lean, last_lean, first_couple, last_couple, viscous_pull,
        viscous_couple, viscous_lean, drag_force, drag_couple;
    Numbers twist, torque, last_torque, viscous_torque;
};
using SegmentsOut = SegmentRows<Triples, double*>;
using SegmentsIn = SegmentRows<ConstTriples, const double*>;

struct SegmentConstants {
    SegmentConstants(const DirectorConstants& c, std::ptrdiff_t first)
        : stiffness(c, first),
          length(c.row(DirectorConstants::length) + first),
          inverse_length(c.row(DirectorConstants::inverse_length) + first),
          twist0(c.row(DirectorConstants::twist0) + first),
          bend10(c.row(DirectorConstants::bend10) + first),
          bend20(c.row(DirectorConstants::bend20) + first) {}
    StiffnessRows stiffness;
    const double *length, *inverse_length, *twist0, *bend10, *bend20;
};

struct NodeConstants {
    NodeConstants(const DirectorConstants& c, std::ptrdiff_t first)
        : inverse_cell(c.row(DirectorConstants::inverse_cell) + first),
          mobile_cell(c.row(DirectorConstants::mobile_cell) + first),
          tilting_cell(c.row(DirectorConstants::tilting_cell) + first),
          mass(c.row(DirectorConstants::mass) + first),
          inverse_mass(c.row(DirectorConstants::inverse_mass) + first),
          polar(c.row(DirectorConstants::polar) + first),
          inverse_polar(c.row(DirectorConstants::inverse_polar) + first),
          transverse(c.row(DirectorConstants::transverse) + first),
          inverse_transverse(c.row(DirectorConstants::inverse_transverse) + first),
          weight(c.row(DirectorConstants::weight) + first),
          unbalance(c.row(DirectorConstants::unbalance) + first) {}
    const double *inverse_cell, *mobile_cell, *tilting_cell, *mass, *inverse_mass, *polar,
        *inverse_polar, *transverse, *inverse_transverse, *weight, *unbalance;
};

DRILLSTRAND_INLINE Triple without(const Triple& v, const Triple& unit) {
    return combine(1.0, v, -dot(v, unit), unit);
}

/// Directors follow angular velocities: t turned by dt Om. Rounding has a bias: where q is less
/// than that of 1 - q, each step would add q to the length.
DRILLSTRAND_INLINE Triple turned_director(const Triple& t, const Triple& w, double dt) {
    const double q = 0.25 * dt * dt * dot(w, w);
    const double inverse_q = 1.0 / (1.0 + q);
    return of_unit_length(combine((1.0 - q) * inverse_q, t, dt * inverse_q, cross(w, t)));
}

/// d1 goes along with t by the shortest way, then turns about it by an angle.
DRILLSTRAND_INLINE Triple turned_material(const Triple& d1, const Triple& t, const Triple& moved,
                                          double angle) {
    const Triple along = carried(d1, t, moved);
    // Cayley's rotation, by the tangent of half the angle to its fifth power
    const double a2 = angle * angle;
    const double tangent = 0.5 * angle * (1.0 + a2 * (1.0 / 12.0) * (1.0 + a2 * 0.1));
    const double unit = 1.0 / (1.0 + tangent * tangent);
    const Triple turned =
        combine((1.0 - tangent * tangent) * unit, along, 2.0 * tangent * unit, cross(moved, along));
    return of_unit_length(without(turned, moved));
}

/// What the segments around a node do to it, times `scale` (1 over its cell for forces per length).
struct RodLoad {
    Triple force, couple;  ///< the couple is normal to the director
    double torque;         ///< about the director
};
template <bool curved>
DRILLSTRAND_INLINE RodLoad rod_load(const SegmentsIn& after, const SegmentsIn& before,
                                    const Triple& t, double scale, std::size_t k) {
    RodLoad load;
    load.force = combine(scale, after.pull[k], -scale, before.last_pull[k]);
    load.couple = cross(t, combine(scale, after.first_lean[k], scale, before.last_lean[k]));
    load.torque = scale * (after.torque[k] - before.last_torque[k]);
    if constexpr (curved) {
        const Triple own = combine(scale, after.first_couple[k], scale, before.last_couple[k]);
        load.couple = combine(1.0, load.couple, 1.0, own);
        load.torque += dot(own, t);
        load.couple = without(load.couple, t);
    }
    return load;
}

/// Likewise of Kelvin-Voigt damping; here the couple may have a part along the director.
DRILLSTRAND_INLINE RodLoad viscous_load(const SegmentsIn& after, const SegmentsIn& before,
                                        double scale, std::size_t k) {
    const Triple bending =
        combine(scale, after.viscous_couple[k], -scale, before.viscous_couple[k]);
    const Triple shearing = combine(scale, after.viscous_lean[k], scale, before.viscous_lean[k]);
    return {combine(scale, after.viscous_pull[k], -scale, before.viscous_pull[k]),
            combine(1.0, bending, 1.0, shearing),
            scale * (after.viscous_torque[k] - before.viscous_torque[k])};
}

/// Lines of numbers of a span's segments or nodes that one of its loops hands to the next, in the
/// first-level cache. Several short loops take less time than one long one: the processor works at
/// two rounds of a loop at once where both fit into what it looks ahead.
template <std::size_t count>
struct HeldLines {
    static constexpr std::size_t entries = most_blocks_at_once * block_size;
    alignas(block_alignment) double line[count][entries];

    DRILLSTRAND_INLINE Triples triples(std::size_t i) {
        return {line[i], line[i + 1], line[i + 2]};
    }
};

/// Calls `use` with the damping and the own shape of a scene as constants.
template <class Use>
auto with_features(const SceneFeatures& features, const Use& use) {
    const auto with_shape = [&](auto damping) {
        return features.curved ? use(damping, std::true_type()) : use(damping, std::false_type());
    };
    switch (features.damping) {
        case Damping::none:
            return with_shape(std::integral_constant<Damping, Damping::none>());
        case Damping::paper:
            return with_shape(std::integral_constant<Damping, Damping::paper>());
        default:
            return with_shape(std::integral_constant<Damping, Damping::kelvin_voigt>());
    }
}

}  // namespace drillstrand
