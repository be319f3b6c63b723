#include "statics/rod_segment.hpp"

#include <Eigen/Geometry>

#include "model/segment_strain.hpp"
#include "statics/bend_factor.hpp"
#include "statics/own_shape.hpp"
#include "statics/skew.hpp"

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36 = Eigen::Matrix<double, 3, 6>;  // by the rotations of both nodes
using Row6 = Eigen::Matrix<double, 1, 6>;

Matrix36 beside(const Matrix3d& left, const Matrix3d& right) {
    Matrix36 both;
    both << left, right;
    return both;
}

/// How far the directors bend: a = t_a x t_b, cos b, f.
struct Bend {
    explicit Bend(const RodSegment& s)
        : ta(s.a.director),
          tb(s.b.director),
          arc(triple(ta), triple(tb)),
          turn(vector(arc.turn)),
          cosine(arc.cosine),
          factor(bend_factor(cosine, turn.squaredNorm())),
          length(s.length) {}

    Vector3d ta, tb;
    SegmentBend arc;
    Vector3d turn;
    double cosine;
    BendFactor<double> factor;
    double length;
};

/// The beam-column of a straight rod, less torsion: README.md, "Segment".
struct Column {
    Column(const RodSegment& s, const Bend& bend)
        : length(s.length),
          stiffness(*s.section, s.length),
          chord(triple(s.a.position), triple(s.b.position), 1 / s.length, triple(bend.ta),
                triple(bend.tb), bend.arc.inverse_both()),
          beam(stiffness, chord, bend.factor.f * bend.factor.f * bend.turn.squaredNorm()),
          along(vector(chord.along)),
          mean(vector(chord.mean)),
          size(1 / bend.arc.inverse_both()),
          moment(stiffness.bending + beam.moment) {}

    double length;
    SegmentStiffness stiffness;
    SegmentChord chord;
    BeamColumn beam;
    Vector3d along, mean;  // e, m
    double size;           // |p|
    double moment;         // B

    [[nodiscard]] Vector3d off_chord() const { return mean - chord.cosine * along; }
    [[nodiscard]] Vector3d off_mean() const { return vector(chord.deviation); }
    [[nodiscard]] double energy() const { return length * beam.whole_energy(stiffness); }
};

/// Torsion: torque T = X/Q of what the segment is twisted, hX = h (tau_f - tau0) + k chi + own.
struct Torsion {
    Torsion(const RodSegment& s, const Bend& bend, const Column& column, double own_twist)
        : length(s.length),
          share(column.stiffness.bending_share),
          deviation(twist_of_deviation(column.chord, bend.arc.turn)),
          softening(column.stiffness.bent_twisting),
          compliance(column.stiffness.torsion_compliance(bend.turn.squaredNorm())),
          torque((s.twist - s.section->curvature[0] + (share * deviation + own_twist) / length) /
                 compliance),
          by_cosine(length * softening * bend.cosine * torque * torque),
          inverse_one(bend.arc.inverse_one),
          axis(inverse_one * (bend.ta + bend.tb)) {}

    double length;
    double share;       // k
    double deviation;   // chi
    double softening;   // s
    double compliance;  // Q
    double torque;
    double by_cosine;  // derivative of the energy by cos b
    double inverse_one;
    Vector3d axis;  // (t_a + t_b) / (1 + cos b)

    [[nodiscard]] double energy() const { return 0.5 * length * torque * torque * compliance; }
};

// In the following, vectors of nine are by chord D = (x_b - x_a)/h and directors: (D, t_a, t_b).

/// Derivatives of chi = e . (t_a x t_b).
Vector9 gradient_of_chi(const Bend& bend, const Column& column, const Torsion& torsion) {
    const Vector3d& e = column.along;
    Vector9 gradient;
    gradient << column.chord.inverse_ratio * (bend.turn - torsion.deviation * e), bend.tb.cross(e),
        e.cross(bend.ta);
    return gradient;
}

/// Derivatives of the energy (J) by chord and directors, the frames' own twist held.
Vector9 gradient_of_energy(const Bend& bend, const Column& column, const Torsion& torsion) {
    const BeamColumn& beam = column.beam;
    const double bending = column.moment * bend.factor.f - torsion.by_cosine / column.length;
    const Vector3d shearing = beam.shearing / column.size * column.off_mean();
    Vector9 gradient;
    gradient << vector(beam.forces().pull(column.chord)), -bending * bend.tb - shearing,
        -bending * bend.ta - shearing;
    return column.length * gradient +
           torsion.torque * torsion.share * gradient_of_chi(bend, column, torsion);
}

Matrix3d normal_to(const Vector3d& unit) {
    return Matrix3d::Identity() - unit * unit.transpose();
}

/// Second derivatives of u . v/|v| by v, with v = size n.
Matrix3d hessian_of_direction(const Vector3d& u, const Vector3d& n, double size) {
    const double along = u.dot(n);
    const Matrix3d turned = (u - along * n) * n.transpose();
    return -(turned + turned.transpose() + along * normal_to(n)) / (size * size);
}

/// Second derivatives of mu = e . m.
Matrix9 hessian_of_mu(const Column& column) {
    const Vector3d& e = column.along;
    const Vector3d& m = column.mean;
    const Matrix3d by_chord = hessian_of_direction(m, e, column.chord.ratio);
    const Matrix3d by_mean = hessian_of_direction(e, m, column.size);
    const Matrix3d mixed = column.chord.inverse_ratio / column.size * (normal_to(e) * normal_to(m));
    Matrix9 hessian;
    hessian << by_chord, mixed, mixed,        //
        mixed.transpose(), by_mean, by_mean,  //
        mixed.transpose(), by_mean, by_mean;
    return hessian;
}

/// Second derivatives of chi.
Matrix9 hessian_of_chi(const Bend& bend, const Column& column) {
    const Vector3d& e = column.along;
    const Matrix3d none = Matrix3d::Zero();
    const Matrix3d normal = column.chord.inverse_ratio * normal_to(e);
    const Matrix3d chord_a = -normal * skew(bend.tb);
    const Matrix3d chord_b = normal * skew(bend.ta);
    Matrix9 hessian;
    hessian << hessian_of_direction(bend.turn, e, column.chord.ratio), chord_a, chord_b,  //
        chord_a.transpose(), none, -skew(e),                                              //
        chord_b.transpose(), skew(e), none;
    return hessian;
}

/// Second derivatives of the load z by (z_s, g).
Eigen::Matrix2d hessian_of_load(const BowedLoad& z) {
    Eigen::Matrix2d hessian;
    hessian << 60 * z.bow, -30 * (z.free + 30 + z.bow), -30 * (z.free + 30 + z.bow), 60 * z.free;
    return hessian / (z.root * z.root * z.root);
}

/// Second derivatives of V/h of the column by (eps, b^2/2, 6 k phi^2), through its load z and
/// directly.
Matrix3d hessian_by_strains(const Column& column) {
    const BeamColumn& beam = column.beam;
    const SegmentStiffness& k = column.stiffness;
    const StabilityCurvatures curve(beam.load.value);
    Eigen::Matrix<double, 2, 3> by_strains;  // z_s and g
    by_strains << 1, 0, 0, 0, 1.0 / 12, 1.0 / 140;
    by_strains *= k.slenderness;
    const Vector3d load =
        by_strains.transpose() * Eigen::Vector2d(beam.load.by_free, beam.load.by_bow);
    const Vector3d slope(1, beam.stability.symmetric_slope, beam.stability.antisymmetric_slope);
    const double by_load2 = 0.5 * curve.symmetric * beam.bend2 +
                            6 * k.bending_share * curve.antisymmetric * beam.angle2 -
                            1 / k.slenderness;
    return k.bending * (by_load2 * load * load.transpose() + slope * load.transpose() +
                        load * slope.transpose() +
                        beam.lack / k.slenderness *
                            (by_strains.transpose() * hessian_of_load(beam.load) * by_strains));
}

/// The same by (c, cos b, mu).
Matrix3d hessian_by_scalars(const Bend& bend, const Column& column) {
    const BeamColumn& beam = column.beam;
    const double c = column.chord.ratio;
    const double f = bend.factor.f;
    Matrix3d strains;
    strains << beam.stretching, -c * f / 12, -c / 5,  //
        0, -f, 0,                                     //
        0, 0, -12 * column.stiffness.bending_share;
    Matrix3d hessian = strains.transpose() * hessian_by_strains(column) * strains;
    hessian(0, 1) -= beam.tension * f / 12;
    hessian(1, 0) -= beam.tension * f / 12;
    hessian(0, 2) -= beam.tension / 5;
    hessian(2, 0) -= beam.tension / 5;
    hessian(1, 1) -= column.moment * bend.factor.slope;
    return hessian;
}

/// Second derivatives of the energy (J), with torsion at a given torque.
Matrix9 hessian_of_energy(const Bend& bend, const Column& column, const Torsion& torsion) {
    const BeamColumn& beam = column.beam;
    const Vector3d none = Vector3d::Zero();
    const Vector3d by_mean = column.off_mean() / column.size;
    Eigen::Matrix<double, 9, 3> scalars;  // gradients of c, cos b, mu
    scalars.col(0) << column.along, none, none;
    scalars.col(1) << none, bend.tb, bend.ta;
    scalars.col(2) << column.chord.inverse_ratio * column.off_chord(), by_mean, by_mean;

    Matrix9 hessian =
        (scalars * hessian_by_scalars(bend, column)).lazyProduct(scalars.transpose()) -
        beam.shearing * hessian_of_mu(column);
    hessian.topLeftCorner<3, 3>() +=
        beam.tension * beam.stretching * column.chord.inverse_ratio * normal_to(column.along);
    const Matrix3d turning =
        (torsion.by_cosine / column.length - column.moment * bend.factor.f) * Matrix3d::Identity();
    hessian.block<3, 3>(3, 6) += turning;
    hessian.block<3, 3>(6, 3) += turning;
    return column.length * hessian + torsion.torque * torsion.share * hessian_of_chi(bend, column);
}

/// Derivatives by chord and directors turned into those by the motion of the nodes: (u_b - u_a,
/// w_a, w_b), dD = (u_b - u_a)/h, dt = w x t.
template <int columns>
void turn_to_motion(Eigen::Matrix<double, 9, columns>& rows, const Bend& bend) {
    rows.template topRows<3>() /= bend.length;
    rows.template middleRows<3>(3) = (skew(bend.ta) * rows.template middleRows<3>(3)).eval();
    rows.template bottomRows<3>() = (skew(bend.tb) * rows.template bottomRows<3>()).eval();
}

Vector9 by_motion(Vector9 gradient, const Bend& bend) {
    turn_to_motion(gradient, bend);
    return gradient;
}

/// Of a symmetric matrix of second derivatives.
Matrix9 by_motion(Matrix9 hessian, const Bend& bend) {
    turn_to_motion(hessian, bend);
    hessian.transposeInPlace();
    turn_to_motion(hessian, bend);
    return hessian;
}

/// Second derivatives of the energy of torsion (J) through twist and cos b, of given gradients.
Matrix9 hessian_of_torsion(const Bend& bend, const Torsion& torsion, const Vector9& twist,
                           const Vector9& cosine) {
    // dT = (d(hX)/h + softer dcos b) / Q
    const double softer = 2 * torsion.softening * bend.cosine * torsion.torque;
    const Vector9 torque = (twist / torsion.length + softer * cosine) / torsion.compliance;
    return twist * torque.transpose() + torsion.length * softer * cosine * torque.transpose() +
           torsion.length * torsion.softening * torsion.torque * torsion.torque * cosine *
               cosine.transpose();
}

/// How the axis of torsion turns with the rotations of the nodes.
Matrix36 axis_tangent(const Bend& bend, const Torsion& torsion) {
    Row6 dcosine;
    dcosine << bend.turn.transpose(), -bend.turn.transpose();
    return torsion.inverse_one * (beside(-skew(bend.ta), -skew(bend.tb)) - torsion.axis * dcosine);
}

/// The tangent by the motion of each node, from that of (force on b, couples) by (u_b - u_a, w_a,
/// w_b).
SegmentTangent by_nodes(const Matrix9& k) {
    const Matrix3d pull = k.block<3, 3>(0, 0);
    SegmentTangent d;
    d.aa << pull, -k.block<3, 3>(0, 3), -k.block<3, 3>(3, 0), k.block<3, 3>(3, 3);
    d.ab << -pull, -k.block<3, 3>(0, 6), k.block<3, 3>(3, 0), k.block<3, 3>(3, 6);
    d.ba << -pull, k.block<3, 3>(0, 3), -k.block<3, 3>(6, 0), k.block<3, 3>(6, 3);
    d.bb << pull, k.block<3, 3>(0, 6), k.block<3, 3>(6, 0), k.block<3, 3>(6, 6);
    return d;
}

}  // namespace

double segment_load(const RodSegment& s) {
    return Column(s, Bend(s)).beam.load.value;
}

SegmentForces segment_forces(const RodSegment& s) {
    const Bend bend(s);
    const Column column(s, bend);
    const OwnShape own(s);
    const Torsion torsion(s, bend, column, own.twist());
    const Vector9 gradient = gradient_of_energy(bend, column, torsion);
    const Vector3d pull = gradient.head<3>() / s.length;
    const Vector3d twisting = torsion.torque * torsion.axis;
    SegmentForces forces;
    forces.on_a << pull, gradient.segment<3>(3).cross(bend.ta) + twisting;
    forces.on_b << -pull, gradient.tail<3>().cross(bend.tb) - twisting;
    forces.energy = column.energy() + torsion.energy();
    own.add_to(forces, torsion.torque);
    return forces;
}

SegmentTangent segment_tangent(const RodSegment& s) {
    const Bend bend(s);
    const Column column(s, bend);
    const OwnShape own(s);
    const Torsion torsion(s, bend, column, own.twist());
    const Vector9 gradient = gradient_of_energy(bend, column, torsion);
    Vector9 cosine;  // cos b by the motion of the nodes
    cosine << Vector3d::Zero(), bend.turn, -bend.turn;
    Vector9 twist =  // hX, likewise
        torsion.share * by_motion(gradient_of_chi(bend, column, torsion), bend) +
        own.gradient_of_twist();
    twist.segment<3>(3) -= torsion.axis;
    twist.tail<3>() += torsion.axis;

    Matrix9 tangent = -by_motion(hessian_of_energy(bend, column, torsion), bend) -
                      hessian_of_torsion(bend, torsion, twist, cosine);
    // forces on directors act where these have turned to
    tangent.block<3, 3>(3, 3) -= skew(gradient.segment<3>(3)) * skew(bend.ta);
    tangent.block<3, 3>(6, 6) -= skew(gradient.tail<3>()) * skew(bend.tb);

    const Matrix36 turning = torsion.torque * axis_tangent(bend, torsion);
    tangent.block<3, 6>(3, 3) += turning;
    tangent.block<3, 6>(6, 3) -= turning;
    own.add_to(tangent, torsion.torque);
    return by_nodes(tangent);
}

}  // namespace drillstrand
