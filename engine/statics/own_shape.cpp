#include "statics/own_shape.hpp"

#include <Eigen/Geometry>
#include <unsupported/Eigen/AutoDiff>

#include "model/segment_strain.hpp"
#include "statics/bend_factor.hpp"
#include "statics/skew.hpp"

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix39 = Eigen::Matrix<double, 3, 9>;
/// A number with its derivatives by (u_b - u_a, w_a, w_b).
using Dual = Eigen::AutoDiffScalar<Vector9>;

template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

/// What the own shape sees of a segment.
template <class Scalar>
struct Nodes {
    Vector3<Scalar> chord;         // D
    Vector3<Scalar> ta, tb;        // directors
    Vector3<Scalar> own_a, own_b;  // kappa_a, kappa_b
    Scalar twist;                  // theta = h tau_f
};

Vector3d own_at(const RodSegment& s, const SegmentEnd& end) {
    const Vector3d& own = s.section->curvature;
    return vector(own_curvature(own[1], own[2], triple(end.director), triple(end.material)));
}

Nodes<double> nodes_of(const RodSegment& s) {
    return {(s.b.position - s.a.position) / s.length,
            s.a.director,
            s.b.director,
            own_at(s, s.a),
            own_at(s, s.b),
            s.length * s.twist};
}

/// A vector that moves by `along` times (u_b - u_a) and turns with w_a and w_b where told.
Vector3<Dual> dual(const Vector3d& v, double along, bool with_a, bool with_b) {
    Matrix39 d = Matrix39::Zero();
    d.leftCols<3>() = along * Matrix3d::Identity();
    if (with_a) d.middleCols<3>(3) = -skew(v);
    if (with_b) d.rightCols<3>() = -skew(v);
    Vector3<Dual> moving;
    for (Eigen::Index i = 0; i < 3; ++i)
        moving[i] = Dual(v[i], d.row(i).transpose());
    return moving;
}

Nodes<Dual> moving(const Nodes<double>& at, double length) {
    const Vector3d axis = (at.ta + at.tb) / (1 + at.ta.dot(at.tb));
    Vector9 twist;
    twist << Vector3d::Zero(), -axis, axis;
    return {dual(at.chord, 1 / length, false, false),
            dual(at.ta, 0, true, false),
            dual(at.tb, 0, false, true),
            dual(at.own_a, 0, true, false),
            dual(at.own_b, 0, false, true),
            Dual(at.twist, twist)};
}

/// Constants of a segment with its own shape.
struct Constants {
    explicit Constants(const RodSegment& s)
        : length(s.length),
          bending(s.section->bending_stiffness),
          share(SegmentStiffness(*s.section, s.length).bending_share),
          sheared((1 - share) * length / 12),
          twisting(bending * bending * length / (12 * s.section->torsional_stiffness)),
          own2(s.section->curvature.tail<2>().squaredNorm()) {}

    double length;
    double bending;   // EI
    double share;     // k
    double sheared;   // (1 - k) h / 12
    double twisting;  // EI^2 h / (12 GJ)
    double own2;      // |kappa|^2
};

/// The scalars and vectors from which energy and forces are made.
template <class Scalar>
struct Shape {
    using Vector = Vector3<Scalar>;

    Shape(const Nodes<Scalar>& at, const Constants& with)
        : nodes(at),
          c(with),
          ratio(at.chord.norm()),
          along(at.chord / ratio),
          both(at.ta + at.tb),
          size(both.norm()),
          mean(both / size),
          turn(at.ta.cross(at.tb)),
          cosine(at.ta.dot(at.tb)),
          factor(bend_factor<Scalar>(cosine, turn.squaredNorm())),
          own(Scalar(0.5) * (at.own_a + at.own_b)),
          change(at.own_b - at.own_a),
          aside(mean.cross(change)),
          twisting(0.5 * (at.own_a.dot(at.tb) - at.own_b.dot(at.ta))),
          weight(c.bending * (1 + at.twist * at.twist / 12)) {}

    const Nodes<Scalar>& nodes;
    const Constants& c;
    Scalar ratio;
    Vector along;  // e
    Vector both;   // p
    Scalar size;
    Vector mean;  // m
    Vector turn;  // a
    Scalar cosine;
    BendFactor<Scalar> factor;
    Vector own;       // mean of kappa_a and kappa_b
    Vector change;    // Delta = kappa_b - kappa_a
    Vector aside;     // v = m x Delta
    Scalar twisting;  // eta
    Scalar weight;    // EI (1 + theta^2/12)

    [[nodiscard]] Scalar twist() const { return c.sheared * aside.dot(turn); }

    [[nodiscard]] Scalar energy() const {
        const Scalar& theta = nodes.twist;
        return -weight * factor.f * turn.dot(own) +
               0.5 * c.length * c.bending * c.own2 * (1 - (1 - c.share) * theta * theta / 12) -
               c.share * c.bending * along.dot(aside) - 0.5 * c.twisting * twisting * twisting;
    }
};

/// Force on a, and couples on a and b.
template <class Scalar>
struct ShapeForces {
    using Vector = Vector3<Scalar>;
    Vector pull, on_a, on_b;

    ShapeForces(const Shape<Scalar>& s, double torque) {
        const Nodes<Scalar>& at = s.nodes;
        const Constants& c = s.c;
        const auto without = [](const Vector& v, const Vector& unit) {
            return Vector(v - unit * unit.dot(v));
        };
        const Scalar sheared(c.sheared * torque);
        const Scalar held(c.share * c.bending);
        const Vector by_aside = sheared * s.turn - held * s.along;
        const Vector by_mean = without(s.change.cross(by_aside), s.mean) / s.size;
        const Vector by_turn = sheared * s.aside - (s.weight * s.factor.f) * s.own;
        const Scalar by_cosine = -s.weight * s.factor.slope * s.turn.dot(s.own);
        const Scalar by_twisting = -0.5 * c.twisting * s.twisting;
        const Vector by_ta =
            at.tb.cross(by_turn) + by_cosine * at.tb + by_mean - by_twisting * at.own_b;
        const Vector by_tb =
            by_turn.cross(at.ta) + by_cosine * at.ta + by_mean + by_twisting * at.own_a;
        const Vector by_own = (-0.5 * s.weight * s.factor.f) * s.turn;
        const Vector by_change = by_aside.cross(s.mean);
        const Scalar by_twist =
            -c.bending / 6 * at.twist * (s.factor.f * s.turn.dot(s.own) + 6 * c.sheared * c.own2);
        const Vector twisting = by_twist / (1 + s.cosine) * s.both;

        pull = -held / c.length / s.ratio * without(s.aside, s.along);
        on_a = by_ta.cross(at.ta) + (by_own - by_change + by_twisting * at.tb).cross(at.own_a) +
               twisting;
        on_b = by_tb.cross(at.tb) + (by_own + by_change - by_twisting * at.ta).cross(at.own_b) -
               twisting;
    }
};

}  // namespace

OwnShape::OwnShape(const RodSegment& segment)
    : segment_(segment), is_bent_(!segment.section->curvature.tail<2>().isZero(0)) {}

double OwnShape::twist() const {
    if (!is_bent_) return 0;
    const Constants constants(segment_);
    const Nodes<double> nodes = nodes_of(segment_);
    return Shape<double>(nodes, constants).twist();
}

Vector9 OwnShape::gradient_of_twist() const {
    if (!is_bent_) return Vector9::Zero();
    const Constants constants(segment_);
    const Nodes<Dual> nodes = moving(nodes_of(segment_), segment_.length);
    return Shape<Dual>(nodes, constants).twist().derivatives();
}

void OwnShape::add_to(SegmentForces& forces, double torque) const {
    if (!is_bent_) return;
    const Constants constants(segment_);
    const Nodes<double> nodes = nodes_of(segment_);
    const Shape<double> shape(nodes, constants);
    const ShapeForces<double> own(shape, torque);
    Vector6 on_a;
    Vector6 on_b;
    on_a << own.pull, own.on_a;
    on_b << -own.pull, own.on_b;
    forces.on_a += on_a;
    forces.on_b += on_b;
    forces.energy += shape.energy();
}

void OwnShape::add_to(Matrix9& tangent, double torque) const {
    if (!is_bent_) return;
    const Constants constants(segment_);
    const Nodes<Dual> nodes = moving(nodes_of(segment_), segment_.length);
    const Shape<Dual> shape(nodes, constants);
    const ShapeForces<Dual> own(shape, torque);
    for (Eigen::Index i = 0; i < 3; ++i) {
        tangent.row(i) -= own.pull[i].derivatives();
        tangent.row(3 + i) += own.on_a[i].derivatives();
        tangent.row(6 + i) += own.on_b[i].derivatives();
    }
}

}  // namespace drillstrand
