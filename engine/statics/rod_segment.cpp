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

/// Stretch and shear, and their forces; mean director m along p = t_a + t_b.
struct Stretch {
    Stretch(const RodSegment& s, const SegmentBend& arc)
        : strain(triple(s.a.position), triple(s.b.position), 1 / s.length, triple(s.a.director),
                 triple(s.b.director), arc.inverse_both()),
          size(1 / arc.inverse_both()),
          mean(vector(strain.mean)),
          along(strain.along),
          across(vector(strain.across)),
          axial(s.section->axial_stiffness),
          shear(s.section->shear_stiffness),
          tension(axial * (along - 1)),
          lever(s.length * (shear * along - tension) / size) {}

    SegmentStretch strain;
    double size;  // |p|
    Vector3d mean;
    double along;
    Vector3d across;
    double axial, shear, tension;
    double lever;  // w of the lean h W = w sh

    [[nodiscard]] Vector3d pull() const { return tension * mean + shear * across; }
    [[nodiscard]] Vector3d lean() const { return lever * across; }
    [[nodiscard]] double energy(double h) const {
        const double stretch = along - 1;
        return 0.5 * h * (axial * stretch * stretch + shear * across.squaredNorm());
    }
};

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

/// Torsion: torque T about e = (t_a + t_b) / (1 + cos b).
struct Torsion {
    Torsion(const RodSegment& s, const SegmentBend& arc)
        : stiffness(s.section->torsional_stiffness),
          torque(stiffness * (s.twist - s.section->curvature[0])),
          sum(s.a.director + s.b.director),
          inverse(arc.inverse_one),
          axis(inverse * sum) {}
    double stiffness, torque;
    Vector3d sum;
    double inverse;
    Vector3d axis;
    [[nodiscard]] double energy(double h) const { return 0.5 * h * torque * torque / stiffness; }
};

/// How the couples of bending and torsion change with the rotations of the nodes.
struct CoupleTangent {
    Matrix36 on_a, on_b;
};

CoupleTangent couple_tangent(const RodSegment& s, const Bend& bend, const Torsion& torsion) {
    const Matrix3d sa = skew(bend.ta);
    const Matrix3d sb = skew(bend.tb);
    const Matrix3d none = Matrix3d::Zero();
    const double h = s.length;
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

    const Vector3d& e = torsion.axis;
    Row6 dtorque;
    dtorque << -e.transpose(), e.transpose();
    dtorque *= torsion.stiffness / h;
    const Matrix36 de = torsion.inverse * (dta + dtb) - torsion.inverse * e * dc;
    const Matrix36 twisting = e * dtorque + torsion.torque * de;
    d.on_a += twisting;
    d.on_b -= twisting;
    return d;
}

}  // namespace

SegmentForces segment_forces(const RodSegment& s) {
    const Bend bend(s);
    const Stretch stretch(s, bend.arc);
    const Torsion torsion(s, bend.arc);
    const Vector3d twisting = torsion.torque * torsion.axis;
    const Vector3d pull = stretch.pull();
    const Vector3d lean = stretch.lean();
    SegmentForces forces;
    forces.on_a << pull, bend.ta.cross(lean) + bend.on_a() + twisting;
    forces.on_b << -pull, bend.tb.cross(lean) + bend.on_b() - twisting;
    forces.energy = stretch.energy(s.length) + bend.energy() + torsion.energy(s.length);
    return forces;
}

SegmentTangent segment_tangent(const RodSegment& s) {
    const Bend bend(s);
    const Stretch q(s, bend.arc);
    const double h = s.length;
    const Vector3d& m = q.mean;
    const Vector3d& sh = q.across;
    const Matrix3d normal = Matrix3d::Identity() - m * m.transpose();
    const double softer = q.axial - q.shear;

    // pull n by the chord (A1) and by p (B); lean L by the chord (-h B^T) and by p (C)
    const Matrix3d by_chord = q.shear * Matrix3d::Identity() + softer * m * m.transpose();
    const Matrix3d by_mean =
        (softer * m * sh.transpose() + (q.tension - q.shear * q.along) * normal) / q.size;
    const Matrix3d lean_by_mean =
        -h * softer / (q.size * q.size) * sh * sh.transpose() -
        q.lever / q.size * (sh * m.transpose() + m * sh.transpose() + q.along * normal);

    const Matrix3d sa = skew(bend.ta);
    const Matrix3d sb = skew(bend.tb);
    const Matrix3d turned_lean = skew(q.lean());
    const CoupleTangent couple = couple_tangent(s, bend, Torsion(s, bend.arc));

    SegmentTangent d;
    d.aa << -by_chord / h, -by_mean * sa, sa * by_mean.transpose(),
        turned_lean * sa - sa * lean_by_mean * sa + couple.on_a.leftCols<3>();
    d.ab << by_chord / h, -by_mean * sb, -sa * by_mean.transpose(),
        -sa * lean_by_mean * sb + couple.on_a.rightCols<3>();
    d.ba << by_chord / h, by_mean * sa, sb * by_mean.transpose(),
        -sb * lean_by_mean * sa + couple.on_b.leftCols<3>();
    d.bb << -by_chord / h, by_mean * sb, -sb * by_mean.transpose(),
        turned_lean * sb - sb * lean_by_mean * sb + couple.on_b.rightCols<3>();
    return d;
}

}  // namespace drillstrand
