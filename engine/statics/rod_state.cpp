#include "statics/rod_state.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "model/pose.hpp"
#include "model/segment_strain.hpp"

namespace drillstrand {

namespace {

using Eigen::Vector3d;

Vector3d turned_about(const Vector3d& v, const Vector3d& axis, double angle) {
    return std::cos(angle) * v + std::sin(angle) * axis.cross(v);
}

Vector3d rotated(const Vector3d& v, const Vector3d& rotation) {
    const double angle = rotation.norm();
    return angle > 0 ? Vector3d(Eigen::AngleAxisd(angle, rotation / angle) * v) : v;
}

/// Signed area on the unit sphere of the triangle a, b, c.
double triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// The change of twist that moving directors cause: the area of the quadrilateral of the two
/// directors before and after.
double swept_area(const Vector3d& a0, const Vector3d& b0, const Vector3d& b1, const Vector3d& a1) {
    return triangle(a0, b0, b1) + triangle(a0, b1, a1);
}

}  // namespace

RodState::RodState(const InitialNodes& nodes, const Vector3d& head_d1,
                   const std::vector<double>& length)
    : position(nodes.position), director(nodes.director), twist(nodes.twist) {
    const Vector3d& t = director.front();
    material.emplace_back((head_d1 - head_d1.dot(t) * t).normalized());
    for (std::size_t k = 0; k < length.size(); ++k) {
        const Vector3d along = carried(material[k], director[k], director[k + 1]);
        material.emplace_back(
            turned_about(along, director[k + 1], length[k] * twist[k]).normalized());
    }
}

namespace {

/// Turns a section by the shortest way of its director and then about it: right for spins of many
/// turns, as a torque at the bit causes.
void turn_by_spin(RodState& next, std::size_t node, const Vector3d& rotation, double spin) {
    const Vector3d t = next.director[node];
    const Vector3d to = rotated(t, rotation - spin * t).normalized();
    next.material[node] = turned_about(carried(next.material[node], t, to), to, spin).normalized();
    next.director[node] = to;
}

void turn_rigidly(RodState& next, std::size_t node, const Vector3d& rotation) {
    next.director[node] = rotated(next.director[node], rotation).normalized();
    next.material[node] = rotated(next.material[node], rotation).normalized();
}

/// Angle from the frame of the node before, carried by the shortest turn of the director, to that
/// of the node; of all that differ by whole turns the nearest to `guess`.
double frame_angle(const RodState& state, std::size_t node, double guess) {
    const Vector3d& t = state.director[node];
    const Vector3d from = carried(state.material[node - 1], state.director[node - 1], t);
    const Vector3d& to = state.material[node];
    const double angle = std::atan2(t.dot(from.cross(to)), from.dot(to));
    constexpr double turn = 2 * std::numbers::pi;
    return angle + turn * std::round((guess - angle) / turn);
}

/// The arc between the nodes of a segment, c S h (README.md, "Segment").
struct Arc {
    SegmentBend bend;
    SegmentChord chord;
    double factor, stretching;

    Arc(const Vector3d& across, const Vector3d& ta, const Vector3d& tb)
        : bend(triple(ta), triple(tb)),
          chord({}, triple(across), 1, triple(ta), triple(tb), bend.inverse_both()),
          factor(bend.factor()),
          stretching(1 + factor * factor * dot(bend.turn, bend.turn) / 24 + chord.angle2() / 10) {}

    /// m
    [[nodiscard]] double length() const { return chord.ratio * stretching; }
};

/// Change of the length of an arc (m) to first order, by those of its chord and directors.
double change_of_length(const Arc& arc, const Vector3d& change, const Vector3d& ta,
                        const Vector3d& change_a, const Vector3d& tb, const Vector3d& change_b) {
    const Vector3d along = vector(arc.chord.along);
    const Vector3d off_chord = vector(arc.chord.mean) - arc.chord.cosine * along;
    const double cosine = ta.dot(change_b) + tb.dot(change_a);
    const double deviation =
        arc.bend.inverse_both() * vector(arc.chord.deviation).dot(change_a + change_b);
    return (arc.stretching * along - off_chord / 5).dot(change) -
           arc.chord.ratio * (arc.factor / 12 * cosine + deviation / 5);
}

/// The chord after a segment whose directors have turned: as they turn in the mean, with its
/// deviation and the length of its arc changed as the motion of its nodes, a before b, says to
/// first order.
Vector3d strained_chord(const RodState& state, const RodState& next, std::size_t k,
                        const Vector6& motion_a, const Vector6& motion_b) {
    const Vector3d& ta = state.director[k];
    const Vector3d& tb = state.director[k + 1];
    const Vector3d chord = state.position[k + 1] - state.position[k];
    const Vector3d change = (motion_b - motion_a).head<3>();
    const Vector3d turn_a = motion_a.tail<3>();
    const Vector3d turn_b = motion_b.tail<3>();
    const Vector3d turn = 0.5 * (turn_a + turn_b);
    const Vector3d turned = rotated(chord + change - turn.cross(chord), turn);
    const Arc before(chord, ta, tb);
    const Arc after(turned, next.director[k], next.director[k + 1]);
    const double length = before.length() + change_of_length(before, change, ta, turn_a.cross(ta),
                                                             tb, turn_b.cross(tb));
    return length / after.length() * turned;
}

}  // namespace

RodState moved(const RodState& state, const std::vector<double>& length, const NodeMotion& motion,
               double scale, StepRule rule) {
    RodState next = state;
    Vector6 before = Vector6::Zero();
    double spin_before = 0;
    const std::size_t heads = motion.size() - length.size();
    if (heads > 0) {
        before = scale * motion.front();
        turn_rigidly(next, 0, before.tail<3>());
    }
    for (std::size_t k = 0; k < length.size(); ++k) {
        const std::size_t node = k + 1;
        const Vector6 now = scale * motion[k + heads];
        const Vector3d rotation = now.tail<3>();
        const Vector3d& t = state.director[node];
        const double spin = rotation.dot(t);
        if (rule == StepRule::nodes) {
            next.position[node] += now.head<3>();
            turn_by_spin(next, node, rotation, spin);
            next.twist[k] +=
                (spin - spin_before +
                 swept_area(state.director[k], t, next.director[node], next.director[k])) /
                length[k];
        } else {
            turn_rigidly(next, node, rotation);
            next.position[node] = next.position[k] + strained_chord(state, next, k, before, now);
            const double guess = length[k] * state.twist[k] + spin - spin_before;
            next.twist[k] = frame_angle(next, node, guess) / length[k];
        }
        before = now;
        spin_before = spin;
    }
    return next;
}

}  // namespace drillstrand
