/// Strains of a segment of the director rod, from the positions and directors of its two nodes:
/// engine/rod/README.md, "Director rod".
#pragma once

#include <cmath>

#include "drillstrand/drill_string.hpp"
#include "model/stability_functions.hpp"
#include "numerics/kernel.hpp"
#include "numerics/triple.hpp"
#include "numerics/vector_math.hpp"

namespace drillstrand {

/// How a segment's directors bend from t_a to t_b by the angle b. The curvature is
/// kb = f (t_a x t_b) / h with f = b / sin b.
struct SegmentBend {
    Triple turn;         ///< t_a x t_b
    double cosine;       ///< cos b
    double inverse_one;  ///< 1 / (1 + cos b)

    DRILLSTRAND_INLINE SegmentBend(const Triple& ta, const Triple& tb)
        : turn(cross(ta, tb)), cosine(dot(ta, tb)), inverse_one(1.0 / (1.0 + cosine)) {}
    /// What was computed before.
    DRILLSTRAND_INLINE SegmentBend(const Triple& a, double cos_b, double inverse)
        : turn(a), cosine(cos_b), inverse_one(inverse) {}

    /// f of b up to 90 degrees, from tan(b/2) = |t_a x t_b| / (1 + cos b).
    [[nodiscard]] DRILLSTRAND_INLINE double factor() const {
        return 2.0 * arctangent_ratio(dot(turn, turn) * inverse_one * inverse_one) * inverse_one;
    }
    /// df/d(cos b) of a factor f; |t_a x t_b|^2 = sin^2 b.
    [[nodiscard]] DRILLSTRAND_INLINE double slope(double f) const {
        const double sine2 = dot(turn, turn);
        return sine2 > 1e-8 ? (f * cosine - 1.0) / sine2 : -1.0 / 3.0;
    }
    /// 1 / |t_a + t_b|
    [[nodiscard]] DRILLSTRAND_INLINE double inverse_both() const {
        return std::sqrt(0.5 * inverse_one);
    }
};

/// How a segment's chord lies between its directors: D = dx/h, c = |D|, e = D/c, mean director m.
struct SegmentChord {
    double ratio;          ///< c
    double inverse_ratio;  ///< 1 / c
    Triple along;          ///< e
    Triple mean;           ///< m
    double cosine;         ///< e . m
    Triple deviation;      ///< e - (e . m) m: the chord's turn off the mean director

    DRILLSTRAND_INLINE SegmentChord(const Triple& xa, const Triple& xb, double inverse_length,
                                    const Triple& ta, const Triple& tb, double inverse_both) {
        const Triple d = combine(inverse_length, xb, -inverse_length, xa);
        constexpr double nothing = 1e-300;  // the padding behind the last node has no chord
        const double square = dot(d, d);
        const double d2 = square > nothing ? square : nothing;
        inverse_ratio = 1.0 / std::sqrt(d2);
        ratio = d2 * inverse_ratio;
        along = scaled(inverse_ratio, d);
        mean = combine(inverse_both, ta, inverse_both, tb);
        cosine = dot(along, mean);
        deviation = combine(1.0, along, -cosine, mean);
    }
    /// What was computed before.
    DRILLSTRAND_INLINE SegmentChord(double c, double inverse_c, const Triple& e, const Triple& m,
                                    double cos_phi, const Triple& turned)
        : ratio(c),
          inverse_ratio(inverse_c),
          along(e),
          mean(m),
          cosine(cos_phi),
          deviation(turned) {}
    /// phi^2
    [[nodiscard]] DRILLSTRAND_INLINE double angle2() const { return 2.0 * (1.0 - cosine); }
};

/// Stiffnesses of a segment of the length h.
struct SegmentStiffness {
    double axial;      ///< EA (N)
    double bending;    ///< EI / h^2 (N)
    double deviation;  ///< 12 k EI / h^2 (N), k = 1 / (1 + 12 EI / (kappa GA h^2)): shear in series
    double bending_share;  ///< k
    double slenderness;    ///< EA h^2 / EI
    double twisting;       ///< 1 / GJ (1/(N m2))
    /// 1 / (h^2 (kappa GA + 12 EI/h^2)) (1/(N m2)): see torsion_compliance()
    double bent_twisting;

    SegmentStiffness(const SectionProperties& section, double length)
        : axial(section.axial_stiffness),
          bending(section.bending_stiffness / (length * length)),
          deviation(12.0 / (1.0 / bending + 12.0 / section.shear_stiffness)),
          bending_share(deviation / (12.0 * bending)),
          slenderness(axial / bending),
          twisting(1.0 / section.torsional_stiffness),
          bent_twisting(1.0 / (length * length * (section.shear_stiffness + 12.0 * bending))) {}
    DRILLSTRAND_INLINE SegmentStiffness(double ea, double ei, double dev, double share, double z,
                                        double torsion, double bent_torsion)
        : axial(ea),
          bending(ei),
          deviation(dev),
          bending_share(share),
          slenderness(z),
          twisting(torsion),
          bent_twisting(bent_torsion) {}

    /// Twist per torque (1/(N m2)) of a segment that is bent by |t_a x t_b|: a torque shears it
    /// too, since its chord and the mean director then have different axes.
    [[nodiscard]] DRILLSTRAND_INLINE double torsion_compliance(double sine2) const {
        return twisting + sine2 * bent_twisting;
    }
};

/// The load z of a segment (its tension over EI/h^2) at a strain z_s EI/(EA h^2) of its arc. Under
/// tension the arc flattens, which makes a bent segment softer along its chord:
///
///     z_s = z - (EA h^2/EI) (r_s' b^2/2 + 6 k r_a' phi^2) = z + g z/(30 + z)
///     g = (EA h^2/EI) (b^2/24 + 3 k phi^2/70)
///
/// with - r_s'/z = 1/(360 + 12 z), exact at 0 and for high tension, and - r_a'/z in the same form.
/// No segment carries more compression than z = -30; an exact one buckles at -4 pi^2 or before.
struct BowedLoad {
    double free;     ///< z_s
    double bow;      ///< g
    double root;     ///< of the equation's discriminant
    double value;    ///< z
    double by_free;  ///< dz/dz_s
    double by_bow;   ///< dz/dg

    DRILLSTRAND_INLINE BowedLoad(double free_load, double bow_of_arc)
        : free(free_load),
          bow(bow_of_arc),
          root(std::sqrt((free + 30.0 - bow) * (free + 30.0 - bow) + 120.0 * bow)),
          value(0.5 * (free - 30.0 - bow + root)) {
        const double inverse = 1.0 / root;
        by_free = 0.5 * (1.0 + (free + 30.0 - bow) * inverse);
        by_bow = 0.5 * ((30.0 + bow - free) * inverse - 1.0);
    }
};

/// Forces of a beam-column.
struct ColumnForces {
    double stretching;  ///< S, below
    double tension;     ///< n = dV/deps / h (N)
    double moment;      ///< couple of axial force over b h: what it adds to EI/h^2 (N)
    double shearing;    ///< P: force across over phi (N)

    /// The force on the first node along and across the chord; its reaction acts on the last (N).
    [[nodiscard]] DRILLSTRAND_INLINE Triple pull(const SegmentChord& chord) const {
        const double across = shearing * chord.inverse_ratio;
        return combine(tension * stretching + across * chord.cosine, chord.along, -across,
                       chord.mean);
    }
};

/// The exact beam-column between two nodes, from the angle b between its directors and the angle
/// phi of its chord. Its strain is that of an arc of the length c S, S = 1 + b^2/24 + phi^2/10, eps
/// = c S - 1, at which it carries the load z:
///
///     V/h = EI/h^2 ((z z_s - z^2/2) EI/(EA h^2) + (r_s b^2 + 12 k r_a phi^2)/2)
///
/// less the part b^2/2 of bending without axial force, which may have a shape of its own. (The
/// largest value over z is that of the beam-column; z is near enough to it for an error of second
/// order, and forces are the gradient of what it is.) `slid`: by how much the halves of a jar are
/// apart, over h, which eps does not have.
struct BeamColumn {
    double bend2;       ///< b^2
    double angle2;      ///< phi^2
    double stretching;  ///< S
    double strain;      ///< eps
    BowedLoad load;
    StabilityFunctions stability;
    double lack;      ///< of load, for the largest energy: d(V/h)/dz EA h^2/EI over EI/h^2
    double tension;   ///< as in ColumnForces
    double moment;    ///< as in ColumnForces
    double shearing;  ///< as in ColumnForces

    DRILLSTRAND_INLINE BeamColumn(const SegmentStiffness& k, const SegmentChord& chord,
                                  double bend_squared, double slid = 0.0)
        : bend2(bend_squared),
          angle2(chord.angle2()),
          stretching(1.0 + bend2 * (1.0 / 24.0) + angle2 * 0.1),
          strain(chord.ratio * stretching - 1.0 - slid),
          load(strain * k.slenderness,
               k.slenderness * (bend2 * (1.0 / 24.0) + k.bending_share * angle2 * (3.0 / 70.0))),
          stability(load.value),
          lack(load.free - load.value +
               k.slenderness * (0.5 * stability.symmetric_slope * bend2 +
                                6.0 * k.bending_share * stability.antisymmetric_slope * angle2)),
          tension(k.bending * (load.value + lack * load.by_free)),
          moment(k.bending * (stability.symmetric + lack * load.by_bow * (1.0 / 12.0)) +
                 tension * chord.ratio * (1.0 / 12.0)),
          shearing(k.deviation * (stability.antisymmetric + lack * load.by_bow * (1.0 / 140.0)) +
                   tension * chord.ratio * 0.2) {}

    [[nodiscard]] DRILLSTRAND_INLINE ColumnForces forces() const {
        return {stretching, tension, moment, shearing};
    }
    /// V/h, as above (N).
    [[nodiscard]] DRILLSTRAND_INLINE double energy(const SegmentStiffness& k) const {
        return 0.5 * (k.bending * ((2 * load.free - load.value) * load.value / k.slenderness +
                                   stability.symmetric * bend2) +
                      k.deviation * stability.antisymmetric * angle2);
    }
    /// V/h, and that of bending without a load (N).
    [[nodiscard]] DRILLSTRAND_INLINE double whole_energy(const SegmentStiffness& k) const {
        return energy(k) + 0.5 * k.bending * bend2;
    }
};

/// How the strain of a beam-column grows, eps' = S c' + c (b b'/12 + phi phi'/5): by_chord . g' +
/// by_bend h a . k', g' and k' the rates of stretch with shear and of bending with twist.
struct StrainGrowth {
    Triple by_chord;
    double by_bend;

    DRILLSTRAND_INLINE StrainGrowth(const SegmentChord& chord, double stretching, double factor)
        : by_chord(combine(
              stretching, chord.along, 0.2,
              combine(1.0, chord.deviation, -dot(chord.deviation, chord.along), chord.along))),
          by_bend(chord.ratio * factor * (1.0 / 12.0)) {}
};

/// The twist h tau of a segment is the angle between its frames, carried along by the shortest
/// turns, and k chi: chi = e . (t_a x t_b) is the area between the tangents of the segment and the
/// great circle between its ends.
DRILLSTRAND_INLINE double twist_of_deviation(const SegmentChord& chord, const Triple& turn) {
    return dot(chord.deviation, turn);
}

/// Curvature that a cross section with its own shape would have in the frame of a node (1/m).
DRILLSTRAND_INLINE Triple own_curvature(double bend1, double bend2, const Triple& t,
                                        const Triple& d1) {
    return combine(bend1, d1, bend2, cross(t, d1));
}

/// What an own curvature kappa, that turns with the sections from kappa_a to kappa_b, adds to the
/// energy of a segment (engine/rod/README.md, "Own shape"): gradients, in J and N m. With
/// Delta = kappa_b - kappa_a, v = m x Delta and eta = (kappa_a . t_b - kappa_b . t_a)/2,
///
///     - EI (1 + theta^2/12) f a . (kappa_a + kappa_b)/2 - k EI e . v - (EI^2 h/(12 GJ)) eta^2/2
///     - (1 - k) (h theta^2/24) EI kappa^2
///
/// where theta = h tau_f is the angle between the sections at its ends.
struct OwnCurvature {
    Triple by_first, by_last;          ///< by t_a, t_b
    Triple by_mean;                    ///< by m
    Triple by_chord;                   ///< by e
    Triple by_own_first, by_own_last;  ///< by kappa_a, kappa_b (N m2)
    double by_twist;                   ///< by theta
    double energy;                     ///< J, from that of the unstressed segment on

    /// What h tau gains by the segment's own deviation, (1 - k) (h/12) v . a, where shear takes
    /// part of the chord's (rad).
    DRILLSTRAND_INLINE static double twist(const SegmentStiffness& k, double h,
                                           const SegmentChord& chord, const Triple& turn,
                                           const Triple& own_a, const Triple& own_b) {
        const Triple change = combine(1.0, own_b, -1.0, own_a);
        return (1.0 - k.bending_share) * h * (1.0 / 12.0) * dot(cross(chord.mean, change), turn);
    }

    /// `torque`: GJ times the elastic twist (N m).
    DRILLSTRAND_INLINE OwnCurvature(const SegmentStiffness& k, double h, const Triple& ta,
                                    const Triple& tb, const SegmentBend& arc, double factor,
                                    const SegmentChord& chord, double theta, double torque,
                                    const Triple& own_a, const Triple& own_b) {
        const double ei = k.bending * h * h;
        const double held = k.bending_share * ei;
        const double sheared = (1.0 - k.bending_share) * h * (1.0 / 12.0);
        const double weight = ei * (1.0 + theta * theta * (1.0 / 12.0));
        const Triple& a = arc.turn;
        const Triple own = combine(0.5, own_a, 0.5, own_b);
        const Triple change = combine(1.0, own_b, -1.0, own_a);
        const Triple aside = cross(chord.mean, change);
        const double along = dot(a, own);

        const Triple by_aside = combine(sheared * torque, a, -held, chord.along);
        const Triple by_turn = combine(sheared * torque, aside, -weight * factor, own);
        const double by_cosine = -weight * arc.slope(factor) * along;
        const double eta = 0.5 * (dot(own_a, tb) - dot(own_b, ta));
        const double by_eta = ei * ei * h * (-1.0 / 24.0) * k.twisting * eta;
        const double own2 = dot(own_a, own_a);
        const Triple by_change = cross(by_aside, chord.mean);
        const Triple by_own = scaled(-0.5 * weight * factor, a);

        by_first = combine(1.0, combine(by_cosine, tb, -by_eta, own_b), 1.0, cross(tb, by_turn));
        by_last = combine(1.0, combine(by_cosine, ta, by_eta, own_a), 1.0, cross(by_turn, ta));
        by_mean = cross(change, by_aside);
        by_chord = scaled(-held, aside);
        by_own_first = combine(1.0, combine(1.0, by_own, by_eta, tb), -1.0, by_change);
        by_own_last = combine(1.0, combine(1.0, by_own, -by_eta, ta), 1.0, by_change);
        by_twist = ei * (-1.0 / 6.0) * theta * (factor * along + 6.0 * sheared * own2);
        energy = 0.5 * ei * own2 * (h - sheared * theta * theta) - weight * factor * along -
                 held * dot(chord.along, aside) + by_eta * eta;
    }
};

}  // namespace drillstrand
