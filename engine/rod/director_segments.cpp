#include <cmath>

#include "model/segment_strain.hpp"
#include "rod/director.hpp"
#include "rod/director_rows.hpp"

namespace drillstrand {

namespace {

/// The change of twist that moving directors cause: area of the quadrilateral of the two directors
/// before and after, cut into the triangles a0 b0 b1 and a0 b1 a1. The tangent of half the area of
/// a, b, c is a . (b x c) / (1 + a . b + b . c + c . a); arctan x = x - x^3/3: steps turn directors
/// by milliradians.
DRILLSTRAND_INLINE double swept_area(const Triple& a0, const Triple& b0, const Triple& b1,
                                     const Triple& a1) {
    const Triple normal = cross(b1, a0);
    const double one = 1.0 + dot(b1, a0);
    const double first = one + dot(a0, b0) + dot(b0, b1);
    const double last = one + dot(b1, a1) + dot(a1, a0);
    const double inverse = 1.0 / (first * last);
    const double x = dot(b0, normal) * last * inverse;
    const double y = -dot(a1, normal) * first * inverse;
    return 2.0 * (x + y - (x * x * x + y * y * y) * (1.0 / 3.0));
}

/// Shapes of segments and the forces of their beam-columns.
using HeldSegments = HeldLines<23>;
struct HeldSegmentRows {
    explicit HeldSegmentRows(HeldSegments& held)
        : turn(held.triples(0)),
          along(held.triples(3)),
          mean(held.triples(6)),
          deviation(held.triples(9)),
          bend_cosine(held.line[12]),
          inverse_one(held.line[13]),
          factor(held.line[14]),
          inverse_both(held.line[15]),
          ratio(held.line[16]),
          inverse_ratio(held.line[17]),
          chord_cosine(held.line[18]),
          stretching(held.line[19]),
          tension(held.line[20]),
          moment(held.line[21]),
          shearing(held.line[22]) {}
    Triples turn, along, mean, deviation;
    double *bend_cosine, *inverse_one, *factor, *inverse_both, *ratio, *inverse_ratio,
        *chord_cosine, *stretching, *tension, *moment, *shearing;

    DRILLSTRAND_INLINE void set(std::size_t k, const SegmentBend& arc) const {
        turn.set(k, arc.turn);
        bend_cosine[k] = arc.cosine;
        inverse_one[k] = arc.inverse_one;
    }
    [[nodiscard]] DRILLSTRAND_INLINE SegmentBend arc(std::size_t k) const {
        return {at(turn, k), bend_cosine[k], inverse_one[k]};
    }
    DRILLSTRAND_INLINE void set(std::size_t k, const SegmentChord& chord) const {
        ratio[k] = chord.ratio;
        inverse_ratio[k] = chord.inverse_ratio;
        along.set(k, chord.along);
        mean.set(k, chord.mean);
        chord_cosine[k] = chord.cosine;
        deviation.set(k, chord.deviation);
    }
    [[nodiscard]] DRILLSTRAND_INLINE SegmentChord chord(std::size_t k) const {
        return {ratio[k],    inverse_ratio[k], at(along, k),
                at(mean, k), chord_cosine[k],  at(deviation, k)};
    }
    DRILLSTRAND_INLINE void set(std::size_t k, const ColumnForces& column) const {
        stretching[k] = column.stretching;
        tension[k] = column.tension;
        moment[k] = column.moment;
        shearing[k] = column.shearing;
    }
    [[nodiscard]] DRILLSTRAND_INLINE ColumnForces column(std::size_t k) const {
        return {stretching[k], tension[k], moment[k], shearing[k]};
    }
};

template <Damping damping, bool curved>
DRILLSTRAND_KERNEL void segments_of_span(const DirectorModel& model, const Table<DirectorRow>& rod,
                                         Table<SegmentRow>& segments, BlockSpan span,
                                         double drift) {
    const auto first = static_cast<std::ptrdiff_t>(span.begin * block_size);
    const std::size_t count = span.entries();
    if (count == 0) return;  // or the compiler would keep scalar loops for it
    HeldSegments scratch;
    const HeldSegmentRows held(scratch);
    const SegmentConstants c(model.constants, first);
    const NodesIn a_node(rod, first);
    const NodesIn b_node(rod, first + 1);
    const SegmentsOut out(segments, first);
    const double kelvin_voigt = model.kelvin_voigt;
    const DampingPair internal_damping = model.internal_damping;

    const auto shape = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const SegmentBend arc(a_node.t[k], b_node.t[k]);
        const double inverse_both = arc.inverse_both();
        held.set(k, arc);
        held.factor[k] = arc.factor();
        held.inverse_both[k] = inverse_both;
        held.set(k, SegmentChord(a_node.x[k], b_node.x[k], c.inverse_length[k], a_node.t[k],
                                 b_node.t[k], inverse_both));
    };
    const auto column = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple a = at(held.turn, k);
        const double factor = held.factor[k];
        held.set(k,
                 BeamColumn(c.stiffness[k], held.chord(k), factor * factor * dot(a, a)).forces());
    };
    const auto forces = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const double h = c.length[k];
        const double ih = c.inverse_length[k];
        const Triple ta = a_node.t[k];
        const Triple tb = b_node.t[k];
        const SegmentStiffness stiffness = c.stiffness[k];
        const SegmentBend arc = held.arc(k);
        const Triple& a = arc.turn;
        const double factor = held.factor[k];
        const double inverse_both = held.inverse_both[k];
        const SegmentChord chord = held.chord(k);
        const ColumnForces beam = held.column(k);
        const double sine2 = dot(a, a);

        // the twist of the frames: h tau += dt (s_k+1 - s_k) + swept area
        const double twist =
            a_node.last_twist[k] + ih * (drift * (b_node.s[k] - a_node.s[k]) +
                                         swept_area(a_node.last_t[k], b_node.last_t[k], tb, ta));
        const double share = stiffness.bending_share;
        const double deviation = twist_of_deviation(chord, a);
        double strain = twist + share * ih * deviation;
        Triple own_a{};
        Triple own_b{};
        if constexpr (curved) {
            own_a = own_curvature(c.bend10[k], c.bend20[k], ta, a_node.d1[k]);
            own_b = own_curvature(c.bend10[k], c.bend20[k], tb, b_node.d1[k]);
            strain += ih * OwnCurvature::twist(stiffness, h, chord, a, own_a, own_b) - c.twist0[k];
        }
        const double strain_torque = strain / stiffness.torsion_compliance(sine2);

        // gradients of the energy by D and by both directors
        const Triple& e = chord.along;
        const double twisting = strain_torque * share;
        const double bending =
            h * ((beam.moment + stiffness.bending) * factor -
                 strain_torque * strain_torque * stiffness.bent_twisting * arc.cosine);
        // (t_a x t_b stands across the mean director: its part along the chord is `deviation`)
        const double by_length = ih * chord.inverse_ratio;
        Triple pull =
            combine(1.0, beam.pull(chord), by_length * twisting, combine(1.0, a, -deviation, e));
        Triple first_lean = combine(bending, tb, twisting, cross(e, tb));
        Triple last_lean = combine(bending, ta, twisting, cross(ta, e));
        Triple both = scaled(h * beam.shearing * inverse_both, chord.deviation);
        double torque = strain_torque;
        if constexpr (curved) {
            const OwnCurvature own(stiffness, h, ta, tb, arc, factor, chord, h * twist,
                                   strain_torque, own_a, own_b);
            first_lean = combine(1.0, first_lean, -1.0, own.by_first);
            last_lean = combine(1.0, last_lean, -1.0, own.by_last);
            pull = combine(1.0, pull, by_length, without(own.by_chord, e));
            both = combine(1.0, both, -inverse_both, without(own.by_mean, chord.mean));
            torque += own.by_twist;
            out.first_couple.set(k, cross(own.by_own_first, own_a));
            out.last_couple.set(k, cross(own.by_own_last, own_b));
        }
        both = combine(1.0, both, -torque * arc.inverse_one, a);
        first_lean = combine(1.0, first_lean, 1.0, both);
        last_lean = combine(1.0, last_lean, 1.0, both);
        if constexpr (damping != Damping::none) {
            // rates of strain from velocities: g' = dv/h - w x D, k' = dw/h
            const Triple wa = combine(1.0, a_node.w[k], a_node.s[k], ta);
            const Triple wb = combine(1.0, b_node.w[k], b_node.s[k], tb);
            const Triple mean = combine(0.5, wa, 0.5, wb);
            const Triple g_rate = combine(1.0, combine(ih, b_node.v[k], -ih, a_node.v[k]),
                                          -chord.ratio, cross(mean, e));
            const Triple k_rate = combine(ih, wb, -ih, wa);
            out.drag_force.set(k, scaled(internal_damping.translation, g_rate));
            out.drag_couple.set(k, scaled(internal_damping.rotation, k_rate));
            if constexpr (damping == Damping::kelvin_voigt) {
                // power of n eps' on g' and k'
                const StrainGrowth growth(chord, beam.stretching, factor);
                const double strain_rate =
                    dot(growth.by_chord, g_rate) + growth.by_bend * h * dot(a, k_rate);
                const double stretching = kelvin_voigt * stiffness.axial * strain_rate;
                const Triple n_rate =
                    combine(stretching, growth.by_chord, kelvin_voigt * stiffness.deviation,
                            without(g_rate, e));
                const Triple& m = chord.mean;
                const double torsion = kelvin_voigt / stiffness.twisting * dot(k_rate, m);
                const double ei = kelvin_voigt * stiffness.bending * h * h;
                Triple couple = combine(ei, without(k_rate, m), h * stretching * growth.by_bend, a);
                couple = combine(1.0, couple, torsion * arc.inverse_one, combine(1.0, ta, 1.0, tb));
                out.viscous_pull.set(k, n_rate);
                out.viscous_lean.set(k, scaled(0.5 * h * chord.ratio, cross(e, n_rate)));
                out.viscous_couple.set(k, couple);
                out.viscous_torque[k] = torsion;
            }
        }
        out.pull.set(k, pull);
        out.last_pull.set(k, pull);
        out.first_lean.set(k, first_lean);
        out.last_lean.set(k, last_lean);
        out.torque[k] = torque;
        out.last_torque[k] = torque;
        out.twist[k] = twist;
    };
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        shape(k);
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        column(k);
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        forces(k);
}

using SegmentKernel = void (*)(const DirectorModel&, const Table<DirectorRow>&, Table<SegmentRow>&,
                               BlockSpan, double);
SegmentKernel segment_kernel(const DirectorModel& model) {
    return with_features(model.features,
                         [level = model.level](auto damping, auto curved) -> SegmentKernel {
                             return at_level<segments_of_span<damping(), curved()>>(level);
                         });
}

}  // namespace

void director_segments(const DirectorModel& model, const Table<DirectorRow>& rod,
                       Table<SegmentRow>& segments, BlockSpan span, double drift) {
    segment_kernel(model)(model, rod, segments, span, drift);
}

}  // namespace drillstrand
