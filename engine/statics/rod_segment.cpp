#include "statics/rod_segment.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "model/segment_strain.hpp"
#include "statics/skew.hpp"

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36 = Eigen::Matrix<double, 3, 6>;  // by the rotations of both nodes
using Row6 = Eigen::Matrix<double, 1, 6>;
// chord D = (x_b - x_a)/h and directors: (D, t_a, t_b)
using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

Matrix36 beside(const Matrix3d& left, const Matrix3d& right) {
    Matrix36 both;
    both << left, right;
    return both;
}

/// f = b / sin b of the cosine of b, and its derivatives by that cosine; unlike the rod's own, for
/// any angle, since iterates may bend by more than they will.
struct BendFactor {
    double f, slope, curve;
};

BendFactor bend_factor(double cosine, double sine2) {
    if (sine2 < 1e-4 && cosine > 0) {
        // series in s = sin b: f = asin(s) / s, d/dc = -(c / s) d/ds
        const double u = 1.0 / 3 + sine2 * (3.0 / 10 + sine2 * (15.0 / 56 + sine2 * (35.0 / 144)));
        const double du = 3.0 / 5 + sine2 * (15.0 / 14 + sine2 * (35.0 / 24));
        const double f = 1 + sine2 * (1.0 / 6 + sine2 * (3.0 / 40 + sine2 * (5.0 / 112)));
        return {f, -cosine * u, -u + cosine * cosine * du};
    }
    const double sine = std::sqrt(sine2);
    const double f = std::atan2(sine, cosine) / sine;
    const double slope = (f * cosine - 1) / sine2;
    return {f, slope, (f + 3 * cosine * slope) / sine2};
}

/// Bending: a = t_a x t_b, moment M = EI (f a / h - kappa).
struct Bend {
    explicit Bend(const RodSegment& s)
        : ta(s.a.director),
          tb(s.b.director),
          arc(triple(ta), triple(tb)),
          turn(vector(arc.turn)),
          cosine(arc.cosine),
          factor(bend_factor(cosine, turn.squaredNorm())),
          own_a(own_at(s, s.a)),
          own_b(own_at(s, s.b)),
          stiffness(s.section->bending_stiffness),
          length(s.length),
          moment(stiffness * (factor.f / length * turn - 0.5 * (own_a + own_b))) {}

    static Vector3d own_at(const RodSegment& s, const SegmentEnd& end) {
        const Vector3d& own = s.section->curvature;
        return vector(own_curvature(own[1], own[2], triple(end.director), triple(end.material)));
    }

    Vector3d ta, tb;
    SegmentBend arc;
    Vector3d turn;
    double cosine;
    BendFactor factor;
    Vector3d own_a, own_b;
    double stiffness, length;
    Vector3d moment;

    [[nodiscard]] Vector3d common() const {
        return factor.f * cosine * moment - factor.slope * moment.dot(turn) * turn;
    }
    [[nodiscard]] Vector3d on_a() const {
        return common() - factor.f * moment.dot(ta) * tb + 0.5 * length * own_a.cross(moment);
    }
    [[nodiscard]] Vector3d on_b() const {
        return -common() + factor.f * moment.dot(tb) * ta + 0.5 * length * own_b.cross(moment);
    }
    [[nodiscard]] double energy() const { return 0.5 * length * moment.squaredNorm() / stiffness; }
};

/// Axial force, and what it and shear do to bending: W of README.md, "Segment", less torsion.
struct Column {
    Column(const RodSegment& s, const Bend& bend)
        : length(s.length),
          stiffness(*s.section, s.length),
          chord(triple(s.a.position), triple(s.b.position), 1 / s.length, triple(bend.ta),
                triple(bend.tb), bend.arc.inverse_both()),
          beam(stiffness, chord, bend.factor.f * bend.factor.f * bend.turn.squaredNorm()),
          along(vector(chord.along)),
          mean(vector(chord.mean)),
          size(1 / bend.arc.inverse_both()) {}

    double length;
    SegmentStiffness stiffness;
    SegmentChord chord;
    BeamColumn beam;
    Vector3d along, mean;  // e, m
    double size;           // |p|

    [[nodiscard]] Vector3d off_chord() const { return mean - chord.cosine * along; }
    [[nodiscard]] Vector3d off_mean() const { return vector(chord.deviation); }
    [[nodiscard]] double energy() const { return length * beam.energy(stiffness); }
};

/// Torsion: torque T; twist h tau carried, and k chi of the deviation.
struct Torsion {
    Torsion(const RodSegment& s, const Bend& bend, const Column& column)
        : length(s.length),
          stiffness(s.section->torsional_stiffness),
          share(column.stiffness.bending_share),
          deviation(twist_of_deviation(column.chord, bend.arc.turn)),
          torque(stiffness * (s.twist + share * deviation / length - s.section->curvature[0])),
          inverse_one(bend.arc.inverse_one),
          axis(inverse_one * (bend.ta + bend.tb)) {}

    double length, stiffness;
    double share;      // k
    double deviation;  // chi
    double torque;
    double inverse_one;
    Vector3d axis;  // (t_a + t_b) / (1 + cos b)

    [[nodiscard]] double energy() const { return 0.5 * length * torque * torque / stiffness; }
};

/// Derivatives of chi = e . (t_a x t_b).
Vector9 gradient_of_chi(const Bend& bend, const Column& column, const Torsion& torsion) {
    const Vector3d& e = column.along;
    Vector9 gradient;
    gradient << column.chord.inverse_ratio * (bend.turn - torsion.deviation * e), bend.tb.cross(e),
        e.cross(bend.ta);
    return gradient;
}

/// Derivatives of W (J): what chord and directors feel of the column and of chi.
Vector9 gradient_of_energy(const Bend& bend, const Column& column, const Torsion& torsion) {
    const BeamColumn& beam = column.beam;
    const double bending = beam.moment * bend.factor.f;
    const Vector3d shearing = beam.shearing / column.size * column.off_mean();
    Vector9 gradient;
    gradient << vector(beam.pull(column.chord)), -bending * bend.tb - shearing,
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
    hessian(1, 1) -= beam.moment * bend.factor.slope;
    return hessian;
}

/// Second derivatives of W (J), with torsion at a given torque.
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
    const Matrix3d turning = -beam.moment * bend.factor.f * Matrix3d::Identity();
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

/// How the couples of bending without axial force change with the rotations of the nodes.
struct CoupleTangent {
    Matrix36 on_a, on_b;
};

CoupleTangent couple_tangent(const Bend& bend) {
    const Matrix3d sa = skew(bend.ta);
    const Matrix3d sb = skew(bend.tb);
    const Matrix3d none = Matrix3d::Zero();
    const double h = bend.length;
    const double f = bend.factor.f;
    const double slope = bend.factor.slope;
    const double c = bend.cosine;
    const Vector3d& m = bend.moment;
    const Vector3d& a = bend.turn;

    const Matrix36 dta = beside(-sa, none);
    const Matrix36 dtb = beside(none, -sb);
    const Matrix36 da = beside(sb * sa, -sa * sb);
    Row6 dc;
    dc << a.transpose(), -a.transpose();
    const Matrix3d own_a = skew(bend.own_a);
    const Matrix3d own_b = skew(bend.own_b);
    const Matrix36 dm = bend.stiffness * ((slope / h) * a * dc + (f / h) * da +
                                          beside(Matrix3d(0.5 * own_a), Matrix3d(0.5 * own_b)));

    // derivative of f c M - f' (M . a) a
    const double ma = m.dot(a);
    const Row6 dma = a.transpose() * dm + m.transpose() * da;
    const Matrix36 common = m * ((slope * c + f) * dc) + f * c * dm -
                            a * (bend.factor.curve * ma * dc + slope * dma) - slope * ma * da;
    const double along_a = m.dot(bend.ta);
    const double along_b = m.dot(bend.tb);
    const Row6 dalong_a = bend.ta.transpose() * dm + m.transpose() * dta;
    const Row6 dalong_b = bend.tb.transpose() * dm + m.transpose() * dtb;
    const Matrix3d sm = skew(m);

    CoupleTangent d;
    d.on_a = common - bend.tb * (slope * along_a * dc + f * dalong_a) - f * along_a * dtb +
             0.5 * h * (beside(sm * own_a, none) + own_a * dm);
    d.on_b = -common + bend.ta * (slope * along_b * dc + f * dalong_b) + f * along_b * dta +
             0.5 * h * (beside(none, sm * own_b) + own_b * dm);
    return d;
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

SegmentForces segment_forces(const RodSegment& s) {
    const Bend bend(s);
    const Column column(s, bend);
    const Torsion torsion(s, bend, column);
    const Vector9 gradient = gradient_of_energy(bend, column, torsion);
    const Vector3d pull = gradient.head<3>() / s.length;
    const Vector3d twisting = torsion.torque * torsion.axis;
    SegmentForces forces;
    forces.on_a << pull, gradient.segment<3>(3).cross(bend.ta) + bend.on_a() + twisting;
    forces.on_b << -pull, gradient.tail<3>().cross(bend.tb) + bend.on_b() - twisting;
    forces.energy = column.energy() + bend.energy() + torsion.energy();
    return forces;
}

SegmentTangent segment_tangent(const RodSegment& s) {
    const Bend bend(s);
    const Column column(s, bend);
    const Torsion torsion(s, bend, column);
    const Vector9 gradient = gradient_of_energy(bend, column, torsion);
    Vector9 twist =  // h tau by the motion of the nodes
        torsion.share * by_motion(gradient_of_chi(bend, column, torsion), bend);
    twist.segment<3>(3) -= torsion.axis;
    twist.tail<3>() += torsion.axis;

    Matrix9 tangent = -by_motion(hessian_of_energy(bend, column, torsion), bend) -
                      torsion.stiffness / s.length * twist * twist.transpose();
    // forces on directors act where these have turned to
    tangent.block<3, 3>(3, 3) -= skew(gradient.segment<3>(3)) * skew(bend.ta);
    tangent.block<3, 3>(6, 6) -= skew(gradient.tail<3>()) * skew(bend.tb);

    const CoupleTangent couple = couple_tangent(bend);
    const Matrix36 turning = torsion.torque * axis_tangent(bend, torsion);
    tangent.block<3, 6>(3, 3) += couple.on_a + turning;
    tangent.block<3, 6>(6, 3) += couple.on_b - turning;
    return by_nodes(tangent);
}

}  // namespace drillstrand
