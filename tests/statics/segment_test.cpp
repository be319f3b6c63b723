// One segment of the static rod: the exact beam-column, forces against its energy, tangents
// against its forces.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "drillstrand/drill_string.hpp"
#include "model/pose.hpp"
#include "model/segment_strain.hpp"
#include "statics/rod_segment.hpp"
#include "support/dice.hpp"

namespace drillstrand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Dice;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

Matrix3d turn(const Vector3d& rotation) {
    const double angle = rotation.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix()
                     : Matrix3d::Identity();
}

/// How a trial segment is strained: z = (axial strain) EA h^2/EI within limits, directors and
/// chord off each other by up to these angles (rad).
struct Straining {
    double low, high;
    double bend, deviation;
};

constexpr Straining strainings[] = {{-9, 0, 0.01, 0.01}, {-9, 0, 2.2, 1},   {-1, 1, 1, 0.5},
                                    {0, 10, 2.2, 1},     {5, 10, 0.1, 0.2}, {10, 100, 2.2, 1},
                                    {1e3, 1e4, 1, 0.5}};

/// A segment with a shape of its own, and stiffnesses of order one, so that no term hides.
struct Trial {
    SectionProperties section;
    RodSegment segment;

    Trial(Dice& dice, const Straining& range) {
        const double h = dice.between(0.5, 2);
        const double z = dice.between(range.low, range.high);
        const double strain = std::copysign(dice.between(0.05, 0.3), z);
        section.bending_stiffness = dice.between(0.5, 2);
        section.torsional_stiffness = dice.between(0.5, 2);
        section.axial_stiffness = z / strain * section.bending_stiffness / (h * h);
        section.shear_stiffness = dice.between(2, 20) * section.bending_stiffness / (h * h);
        section.curvature = dice.vector(1 / h);

        const Vector3d t = dice.vector(1).normalized();
        const auto end = [&](const Vector3d& position) {
            const Vector3d director = turn(dice.vector(range.bend / 2)) * t;
            return SegmentEnd{position, director, director.cross(dice.vector(1)).normalized()};
        };
        segment = {h, &section, end(dice.vector(1)), end(Vector3d::Zero()),
                   dice.between(-1, 1) / h};
        const Vector3d mean = (segment.a.director + segment.b.director).normalized();
        const Vector3d along = turn(dice.vector(range.deviation)) * mean;
        const double b = std::acos(segment.a.director.dot(segment.b.director));
        const double arc = 1 + b * b / 24 + (1 - along.dot(mean)) / 5;
        segment.b.position = segment.a.position + h * (1 + strain) / arc * along;
    }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;
};

template <class Check>
void for_trials(const Check& check) {
    unsigned seed = 0;
    for (const Straining& range : strainings) {
        for (int i = 0; i < 20; ++i) {
            Dice dice(++seed);
            check(Trial(dice, range).segment);
        }
    }
}

/// The segment after displacements (m) and rotations (rad) of its nodes, a before b.
RodSegment moved(const RodSegment& segment, const Vector12& motion) {
    const auto end = [](const SegmentEnd& from, const Vector6& by) {
        const Matrix3d rotation = turn(by.tail<3>());
        return SegmentEnd{from.position + by.head<3>(), rotation * from.director,
                          rotation * from.material};
    };
    RodSegment next = segment;
    next.a = end(segment.a, motion.head<6>());
    next.b = end(segment.b, motion.tail<6>());
    // by how much the angle between the frames has changed, carried by the shortest turn
    const auto angle = [](const RodSegment& s) {
        const Vector3d from = carried(s.a.material, s.a.director, s.b.director);
        return std::atan2(s.b.director.dot(from.cross(s.b.material)), from.dot(s.b.material));
    };
    next.twist +=
        std::remainder(angle(next) - angle(segment), 2 * std::numbers::pi) / segment.length;
    return next;
}

Vector12 forces(const RodSegment& segment) {
    const SegmentForces of = segment_forces(segment);
    Vector12 both;
    both << of.on_a, of.on_b;
    return both;
}

/// Derivative of a function of the segment by one component of its motion, of fourth order.
template <class Function>
auto derivative(const RodSegment& segment, int component, const Function& function) {
    constexpr double step = 3e-4;
    using Value = decltype(function(segment));
    const auto across = [&](double width) {
        const Vector12 motion = width * Vector12::Unit(component);
        return Value((function(moved(segment, motion)) - function(moved(segment, -motion))) /
                     (2 * width));
    };
    return Value((4 * across(step) - across(2 * step)) / 3);
}

TEST(SegmentForces, AreTheGradientOfTheEnergy) {
    for_trials([](const RodSegment& segment) {
        const Vector12 force = forces(segment);
        for (int i = 0; i < 12; ++i) {
            const double gradient = derivative(
                segment, i, [](const RodSegment& s) { return segment_forces(s).energy; });
            EXPECT_NEAR(-gradient, force[i], 1e-9 * force.norm()) << i;
        }
    });
}

TEST(SegmentTangent, IsTheDerivativeOfTheForces) {
    for_trials([](const RodSegment& segment) {
        const SegmentTangent of = segment_tangent(segment);
        Matrix12 tangent;
        tangent << of.aa, of.ab, of.ba, of.bb;
        for (int i = 0; i < 12; ++i) {
            const Vector12 column = derivative(segment, i, forces);
            EXPECT_LT((column - tangent.col(i)).norm(), 1e-9 * tangent.norm()) << i;
        }
    });
}

TEST(SegmentForces, BalanceEachOther) {
    for_trials([](const RodSegment& segment) {
        const SegmentForces of = segment_forces(segment);
        const Vector3d chord = segment.b.position - segment.a.position;
        const Vector6 sum = of.on_a + of.on_b;
        EXPECT_EQ(sum.head<3>().norm(), 0);
        EXPECT_LT((sum.tail<3>() + chord.cross(of.on_b.head<3>())).norm(), 1e-14 * of.on_a.norm());
    });
}

TEST(SegmentForces, TurnWithASegmentThatMovesRigidly) {
    Dice dice(7);
    for_trials([&](const RodSegment& here) {
        const Matrix3d rotation = turn(dice.vector(3));
        const Vector3d shift = dice.vector(10);
        const auto carried_along = [&](const SegmentEnd& end) {
            return SegmentEnd{rotation * end.position + shift, rotation * end.director,
                              rotation * end.material};
        };
        const RodSegment there{here.length, here.section, carried_along(here.a),
                               carried_along(here.b), here.twist};
        const SegmentForces before = segment_forces(here);
        const SegmentForces after = segment_forces(there);
        const double rounding = 1e-13 * before.on_b.norm();
        EXPECT_NEAR(after.energy, before.energy, 1e-13 * before.energy);
        EXPECT_LT((after.on_a.head<3>() - rotation * before.on_a.head<3>()).norm(), rounding);
        EXPECT_LT((after.on_a.tail<3>() - rotation * before.on_a.tail<3>()).norm(), rounding);
        EXPECT_LT((after.on_b.tail<3>() - rotation * before.on_b.tail<3>()).norm(), rounding);
    });
}

/// A slender segment of EI = 1 that bends in a plane by small angles from its chord, under the
/// axial strain z EI/(EA h^2).
double end_moment(double z, double angle_a, double angle_b, double shear = 1e15) {
    SectionProperties section;
    section.bending_stiffness = 1;
    section.torsional_stiffness = 1;
    section.axial_stiffness = 3e8;
    section.shear_stiffness = shear;
    const auto end = [](double x, double angle) {
        return SegmentEnd{{x, 0, 0},
                          {std::cos(angle), std::sin(angle), 0},
                          {-std::sin(angle), std::cos(angle), 0}};
    };
    const double h = 1.5;
    const double bend = angle_b - angle_a;
    const double mean = 0.5 * (angle_a + angle_b);
    const double arc = 1 + bend * bend / 24 + mean * mean / 10;
    const double chord = h * (1 + z / (section.axial_stiffness * h * h)) / arc;
    return h * segment_forces({h, &section, end(0, angle_a), end(chord, angle_b), 0}).on_a[5];
}

/// sqrt(y) coth sqrt(y)
double exact_symmetric(double y) {
    const double x = std::sqrt(std::abs(y));
    return y > 0 ? x / std::tanh(x) : x / std::tan(x);
}

TEST(BeamColumn, BendsIntoABowAsTheExactOneUnderTensionAndCompression) {
    constexpr double angle = 1e-7;
    for (const double z : {-9.0, -4.0, -0.1, 0.1, 4.0, 29.0, 58.0})
        EXPECT_NEAR(end_moment(z, -angle, angle) / (2 * angle) / exact_symmetric(z / 4), 1, 1e-6)
            << z;
}

TEST(BeamColumn, BendsIntoAnSAsTheExactOneUnderTensionAndCompression) {
    constexpr double angle = 1e-7;
    for (const double z : {-9.0, -4.0, -0.1, 0.1, 4.0, 29.0, 58.0}) {
        const double exact = 0.5 * z / (exact_symmetric(z / 4) - 1);
        EXPECT_NEAR(-end_moment(z, angle, angle) / angle / exact, 1, 1e-6) << z;
    }
}

TEST(BeamColumn, BendsIntoAnSWithShearInSeries) {
    constexpr double angle = 1e-7;
    constexpr double shear = 7;
    const double series = 1 / (1 + 12 / (shear * 1.5 * 1.5));
    EXPECT_NEAR(-end_moment(0, angle, angle, shear) / angle, 6 * series, 1e-6);
}

TEST(SegmentForces, StretchAlongTheChordAlone) {
    SectionProperties section;
    section.bending_stiffness = 2;
    section.torsional_stiffness = 3;
    section.axial_stiffness = 50;
    section.shear_stiffness = 20;
    const Vector3d t(0, 0.6, 0.8);
    const SegmentEnd a{{1, 2, 3}, t, {1, 0, 0}};
    const SegmentEnd b{a.position + 1.01 * 4 * t, t, {1, 0, 0}};
    const SegmentForces of = segment_forces({4, &section, a, b, 0});
    EXPECT_LT((of.on_a.head<3>() - 0.01 * 50 * t).norm(), 1e-13);
    EXPECT_LT(of.on_a.tail<3>().norm(), 1e-14);
    EXPECT_NEAR(of.energy, 0.5 * 4 * 50 * 0.01 * 0.01, 1e-14);
}

/// Torque over GJ/h of a segment of a helix that turns by this angle about its axis, its frames
/// carried along the helix: none but for the error of the segment.
double helix_twist(double angle) {
    constexpr double slope = 0.5;  // of the helix to its axis (rad)
    const auto tangent = [](double at) {
        return Vector3d(std::sin(slope) * std::cos(at), std::sin(slope) * std::sin(at),
                        std::cos(slope));
    };
    const Vector3d first = tangent(0).cross(Vector3d::UnitZ()).normalized();
    Vector3d material = first;
    constexpr int steps = 2000;
    for (int i = 0; i < steps; ++i)
        material = carried(material, tangent(angle * i / steps), tangent(angle * (i + 1) / steps));
    const Vector3d end(std::sin(slope) * std::sin(angle), std::sin(slope) * (1 - std::cos(angle)),
                       angle * std::cos(slope));
    SectionProperties section;
    section.bending_stiffness = section.torsional_stiffness = 1;
    section.axial_stiffness = section.shear_stiffness = 1e9;
    RodSegment segment{
        angle, &section, {Vector3d::Zero(), tangent(0), first}, {end, tangent(angle), material}, 0};
    const Vector3d from = carried(first, tangent(0), tangent(angle));
    segment.twist =
        std::atan2(tangent(angle).dot(from.cross(material)), from.dot(material)) / angle;
    return angle * segment_forces(segment).on_a.tail<3>().dot(tangent(0));
}

TEST(SegmentForces, DoNotTwistAHelixWhoseFramesFollowIt) {
    const double coarse = helix_twist(0.4);
    const double fine = helix_twist(0.2);
    EXPECT_LT(std::abs(fine), 1e-6);  // the shortest turn alone errs by 1.5e-4
    EXPECT_NEAR(std::log2(coarse / fine), 5, 0.2);
}

}  // namespace
}  // namespace drillstrand
