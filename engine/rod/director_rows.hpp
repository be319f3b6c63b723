/// The rows of the director rod as its kernels see them: named views from an entry on, and lines
/// that one loop hands to the next.
#pragma once

#include <cstddef>
#include <type_traits>

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
          viscous_torque(segments.row(SegmentRow::viscous_torque) + first) {}
    Vectors pull, first_lean, last_lean, first_couple, last_couple, viscous_pull, viscous_couple,
        viscous_lean, drag_force, drag_couple;
    Numbers twist, torque, viscous_torque;
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
          mass(c.row(DirectorConstants::mass) + first),
          inverse_mass(c.row(DirectorConstants::inverse_mass) + first),
          polar(c.row(DirectorConstants::polar) + first),
          inverse_polar(c.row(DirectorConstants::inverse_polar) + first),
          transverse(c.row(DirectorConstants::transverse) + first),
          inverse_transverse(c.row(DirectorConstants::inverse_transverse) + first),
          weight(c.row(DirectorConstants::weight) + first),
          unbalance(c.row(DirectorConstants::unbalance) + first) {}
    const double *inverse_cell, *mobile_cell, *mass, *inverse_mass, *polar, *inverse_polar,
        *transverse, *inverse_transverse, *weight, *unbalance;
};

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

DRILLSTRAND_INLINE Triple at(const Triples& rows, std::size_t k) {
    return {rows.x[k], rows.y[k], rows.z[k]};
}

DRILLSTRAND_INLINE Triple without(const Triple& v, const Triple& unit) {
    return combine(1.0, v, -dot(v, unit), unit);
}

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
