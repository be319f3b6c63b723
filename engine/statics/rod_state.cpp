#include "statics/rod_state.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace drillstrand {

namespace {

using Eigen::Vector3d;

/// v taken along by the shortest turn from one unit vector to another.
Vector3d carried(const Vector3d& v, const Vector3d& from, const Vector3d& to) {
    return v - (v.dot(to) / (1 + from.dot(to))) * (from + to);
}

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

RodState moved(const RodState& state, const std::vector<double>& length, const NodeMotion& motion,
               double scale, StepRule rule) {
    RodState next = state;
    double spin_before = 0;
    Vector3d rotation_before = Vector3d::Zero();
    for (std::size_t k = 0; k < motion.size(); ++k) {
        const std::size_t node = k + 1;
        const Vector3d& t = state.director[node];
        const Vector3d rotation = scale * motion[k].tail<3>();
        const double spin = rotation.dot(t);
        Vector3d& to = next.director[node];
        to = rotated(t, rotation - spin * t).normalized();
        next.material[node] =
            turned_about(carried(state.material[node], t, to), to, spin).normalized();
        next.twist[k] +=
            (spin - spin_before + swept_area(state.director[k], t, to, next.director[k])) /
            length[k];
        if (rule == StepRule::nodes) {
            next.position[node] += scale * motion[k].head<3>();
        } else {
            const Vector3d chord = state.position[node] - state.position[k];
            const Vector3d change =
                scale * (k > 0 ? Vector3d(motion[k].head<3>() - motion[k - 1].head<3>())
                               : Vector3d(motion[k].head<3>()));
            const Vector3d mean = 0.5 * (rotation_before + rotation);
            next.position[node] =
                next.position[k] + rotated(chord + change - mean.cross(chord), mean);
        }
        spin_before = spin;
        rotation_before = rotation;
    }
    return next;
}

}  // namespace drillstrand
