#include "statics/mode_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace drillstrand {

namespace {

using Complex = std::complex<double>;
using Eigen::Vector3cd;
using Eigen::Vector3d;
using Vector6c = Eigen::Matrix<Complex, 6, 1>;

Vector3cd across(const Vector3d& axis, const Vector3cd& v) {
    return v - axis * (axis.transpose() * v)(0);
}

/// The motion of node k of the whole string.
Vector6c motion_of(const RodState& state, const ComplexMotion& motion, std::size_t node) {
    const std::size_t first = state.position.size() - motion.size();
    return node < first ? Vector6c::Zero() : motion[node - first];
}

/// The number that describes how far a node is out, of a mode of that kind: along or about the
/// axis, or in the local direction in which the furthest node moves.
class Deflection {
  public:
    Deflection(const RodState& state, const ComplexMotion& motion, ModeKind kind)
        : state_(state), motion_(motion), kind_(kind) {
        if (kind == ModeKind::lateral) find_direction();
    }

    [[nodiscard]] double at(std::size_t node) const {
        const Vector6c q = motion_of(state_, motion_, node);
        const Vector3d& t = state_.director[node];
        switch (kind_) {
            case ModeKind::axial:
                return (t.transpose() * q.head<3>())(0).real();
            case ModeKind::torsional:
                return (t.transpose() * q.tail<3>())(0).real();
            case ModeKind::lateral:
                break;
        }
        return direction_.dot(local(node)).real();
    }

  private:
    /// In the axes d1 and d2 of the node.
    [[nodiscard]] Eigen::Vector2cd local(std::size_t node) const {
        const Vector3cd dx = motion_of(state_, motion_, node).head<3>();
        const Vector3d& d1 = state_.material[node];
        const Vector3d d2 = state_.director[node].cross(d1);
        return {(d1.transpose() * dx)(0), (d2.transpose() * dx)(0)};
    }

    void find_direction() {
        for (std::size_t node = 0; node < state_.position.size(); ++node)
            if (local(node).norm() > direction_.norm()) direction_ = local(node);
    }

    const RodState& state_;
    const ComplexMotion& motion_;
    ModeKind kind_;
    Eigen::Vector2cd direction_ = Eigen::Vector2cd::Zero();
};

/// Changes of sign along the string; less than a millionth of the most is none.
std::int64_t crossings_of(const Deflection& deflection, std::size_t nodes) {
    constexpr double nothing = 1e-6;
    std::vector<double> out(nodes);
    double most = 0;
    for (std::size_t k = 0; k < nodes; ++k) {
        out[k] = deflection.at(k);
        most = std::max(most, std::abs(out[k]));
    }
    std::int64_t crossings = 0;
    double last = 0;
    for (const double now : out) {
        if (std::abs(now) < nothing * most) continue;
        if (now * last < 0) ++crossings;
        last = now;
    }
    return crossings;
}

double place_of_largest_bending(const Scene& scene, const RodState& state,
                                const ComplexMotion& motion) {
    double most = 0;
    double place = 0;
    for (std::size_t k = 0; k < state.twist.size(); ++k) {
        const double moment = scene.mesh.segment[k].bending_stiffness *
                              largest_of_period(strain_amplitude(scene, state, motion, k).bending);
        if (moment <= most) continue;
        most = moment;
        place = scene.mesh.segment_s[k];
    }
    return place;
}

/// The factor that makes the largest displacement, or turn, of the motion 1, at the time 0.
Complex scale_of(const ComplexMotion& motion, ModeKind kind) {
    Complex largest = 0;
    for (const Vector6c& q : motion) {
        const Vector3cd part = kind == ModeKind::torsional ? q.tail<3>() : q.head<3>();
        const double length = largest_of_period(part);
        if (length <= std::abs(largest)) continue;
        // at the phase that makes part real as far as can be, its length is largest
        const Complex square = (part.transpose() * part)(0);
        const double phase =
            std::abs(square) > 1e-9 * part.squaredNorm() ? std::arg(square) / 2 : std::arg(part[0]);
        largest = std::polar(length, phase);
    }
    return 1.0 / largest;
}

}  // namespace

ModeKind ModeCharacter::kind() const {
    if (axial > lateral && axial > torsional) return ModeKind::axial;
    return torsional > lateral ? ModeKind::torsional : ModeKind::lateral;
}

std::string_view mode_kind_name(ModeKind kind) {
    switch (kind) {
        case ModeKind::torsional:
            return "torsional";
        case ModeKind::axial:
            return "axial";
        case ModeKind::lateral:
            break;
    }
    return "lateral";
}

ModeCharacter mode_character(const RodState& state, const VibrationMatrices& matrices,
                             const ComplexMotion& motion) {
    ModeCharacter character;
    double whole = 0;
    double swept = 0;
    double lateral_motion = 0;
    const std::size_t first = state.position.size() - motion.size();
    for (std::size_t k = 0; k < motion.size(); ++k) {
        const Vector3d& t = state.director[first + k];
        const Matrix6& mass = matrices.mass[k];
        const Vector6c& q = motion[k];
        whole += q.dot(mass * q).real();
        character.axial +=
            t.dot(mass.topLeftCorner<3, 3>() * t) * std::norm((t.transpose() * q.head<3>())(0));
        character.torsional +=
            t.dot(mass.bottomRightCorner<3, 3>() * t) * std::norm((t.transpose() * q.tail<3>())(0));
        // u goes from Re q to - Im q in a quarter of a period
        const Vector3cd sideways = across(t, q.head<3>());
        const double sideways_mass = mass.topLeftCorner<3, 3>().trace();
        swept -= 2 * sideways_mass * t.dot(sideways.real().cross(sideways.imag()));
        lateral_motion += sideways_mass * sideways.squaredNorm();
    }
    character.axial /= whole;
    character.torsional /= whole;
    character.lateral = 1 - character.axial - character.torsional;
    if (character.kind() == ModeKind::lateral) character.whirl = swept / lateral_motion;
    return character;
}

double largest_of_period(const Eigen::Vector3cd& v) {
    const Complex square = (v.transpose() * v)(0);
    return std::sqrt(0.5 * (v.squaredNorm() + std::abs(square)));
}

SegmentStrainAmplitude strain_amplitude(const Scene& scene, const RodState& state,
                                        const ComplexMotion& motion, std::size_t k) {
    const double h = scene.mesh.length[k];
    const Vector3d e = (state.position[k + 1] - state.position[k]).normalized();
    const Vector6c change = (motion_of(state, motion, k + 1) - motion_of(state, motion, k)) / h;
    const Vector3cd turn = change.tail<3>();
    return {across(e, turn), (e.transpose() * turn)(0), (e.transpose() * change.head<3>())(0)};
}

VibrationMode described_mode(const Scene& scene, const RodState& state,
                             const VibrationMatrices& matrices, double frequency,
                             const ComplexMotion& motion) {
    VibrationMode mode;
    const ModeCharacter character = mode_character(state, matrices, motion);
    mode.frequency = frequency;
    mode.kind = character.kind();
    mode.lateral_share = character.lateral;
    mode.torsional_share = character.torsional;
    mode.axial_share = character.axial;
    mode.whirl = character.whirl;
    const std::size_t nodes = state.position.size();
    mode.crossings = crossings_of(Deflection(state, motion, mode.kind), nodes);
    mode.bending_place = place_of_largest_bending(scene, state, motion);
    const Complex scale = scale_of(motion, mode.kind);
    for (std::size_t node = 0; node < nodes; ++node) {
        const Vector6c q = scale * motion_of(state, motion, node);
        mode.displacement.emplace_back(q.head<3>().real());
        mode.turn.emplace_back(q.tail<3>().real());
        mode.later_displacement.emplace_back(-q.head<3>().imag());
        mode.later_turn.emplace_back(-q.tail<3>().imag());
    }
    return mode;
}

}  // namespace drillstrand
