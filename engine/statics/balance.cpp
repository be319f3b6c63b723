#include "statics/balance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/segment_strain.hpp"
#include "statics/well_section.hpp"

namespace drillstrand {

using Eigen::Vector3d;

Balance::Balance(const Scene& scene, const LoadCase& loads)
    : scene_(scene), head_(scene), bit_(scene), loads_(loads), first_(first_moving_node(scene)) {
    if (scene.well) {
        const Well& well = *scene.well;
        std::size_t guess = well.arc_at(well.measured_depth_start());
        for (const Vector3d& x : scene.initial_nodes.position) {
            guess = well.find_arc(x, guess);
            arc_.push_back(guess);
        }
    }
    mud_ = mud_loads(scene, loads.mud);
    for (std::size_t k = 0; k < mud_.size(); ++k)
        mud_[k] *= scene.mesh.cell[k];
}

/// What rubs at a node, in the section of the well that it is in.
FrictionShares Balance::friction(std::size_t node, const WellArc& arc) const {
    if (!held_friction_.empty() || loads_.friction == 0) return {};
    const FrictionShares full = friction_shares(scene_.section_friction[arc.section].slide,
                                                loads_.motion, scene_.mesh.node[node].outer_radius);
    return {loads_.friction * full.axial, loads_.friction * full.azimuthal};
}

RodSegment Balance::segment(const RodState& state, std::size_t k) const {
    return {scene_.mesh.length[k], &scene_.mesh.segment[k], state.end(k), state.end(k + 1),
            state.twist[k]};
}

const WellArc* Balance::arc(std::size_t node, const Vector3d& position) {
    if (!scene_.well) return nullptr;
    arc_[node] = scene_.well->find_arc(position, arc_[node]);
    return &scene_.well->arcs()[arc_[node]];
}

WallSite Balance::site(const RodState& state, std::size_t node) {
    const WellArc* around = arc(node, state.position[node]);
    const double cell = scene_.mesh.cell[node];
    return {around,
            state.position[node],
            state.director[node],
            scene_.mesh.node[node].outer_radius,
            scene_.normal_stiffness[node] * cell,
            loads_.stiffest_wall * cell,
            scene_.contact.normal_law,
            friction(node, *around)};
}

Vector3d Balance::mud_force(const RodState& state, std::size_t node) {
    const Vector3d& x = state.position[node];
    return mud_[node] * well_section(x, *arc(node, x)).l;
}

Eigen::Matrix3d Balance::mud_tangent(const RodState& state, std::size_t node) {
    const Vector3d& x = state.position[node];
    return mud_[node] * well_section(x, *arc(node, x)).l_by_position();
}

BitLoad Balance::bit(const RodState& state) {
    const std::size_t last = state.twist.size();
    return bit_load(bit_, loads_.bit, state.end(last), arc(last, state.position[last]));
}

void Balance::hold_friction(const RodState& state) {
    free_friction();
    std::vector<Vector6> held(state.position.size(), Vector6::Zero());
    for (std::size_t node = 1; node < held.size() && scene_.well; ++node) {
        const WallLoad wall = wall_load(site(state, node));
        held[node] << wall.friction, wall.load.tail<3>();
    }
    held_friction_ = std::move(held);
}

bool Imbalance::is_rounding() const {
    for (std::size_t k = 0; k < force.size(); ++k) {
        if (!(force[k].head<3>().norm() <= rounding[k].force &&
              force[k].tail<3>().norm() <= rounding[k].couple))
            return false;
    }
    return true;
}

double Imbalance::least_energy_change() const {
    constexpr double part = 1e-12;
    return std::max(part * energy_sum, energy_rounding);
}

/// Each of two positions is known to eps |x| / 2, a director to eps: a chord of h to r = eps (|x| +
/// h), its strain and deviation to r / h. Pull follows with EA, or 12 EI / h^2 of a stocky segment,
/// couples with an arm of h at most, bending and torsion with EI / h and GJ / h; a wall with its
/// stiffness.
void Balance::add_rounding(const RodState& state, std::size_t segment, double pull,
                           const WallLoad& touch, Imbalance& sum) const {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    const std::size_t node = segment + 1;
    const SectionProperties& section = scene_.mesh.segment[segment];
    const double h = scene_.mesh.length[segment];
    const double position =
        eps * std::max(state.position[segment].norm(), state.position[node].norm());
    const double r = position + eps * h;
    const SegmentStiffness stiffness(section, h);
    const double force = std::max(stiffness.axial, stiffness.deviation) * r / h;
    const double couple =
        h * force + eps * (section.bending_stiffness + section.torsional_stiffness) / h;
    sum.energy_rounding += (pull + 0.5 * force) * r;

    const auto add = [&](std::size_t at, double wall) {
        Imbalance::Rounding& its = sum.rounding[at - first_];
        its.force += force + wall;
        its.couple += couple + scene_.mesh.node[at].outer_radius * wall;
    };
    if (segment >= first_) add(segment, 0);
    add(node, scene_.well ? wall_stiffness(node, touch) * position : 0);
}

/// How fast the force of the wall on a node grows with its depth, or would where it touched (N/m).
/// Hertz's wall begins with nothing.
double Balance::wall_stiffness(std::size_t node, const WallLoad& touch) const {
    if (scene_.contact.normal_law == NormalLaw::hertz) return touch.stiffness;
    return std::min(scene_.well->arcs()[arc_[node]].firmness * scene_.normal_stiffness[node],
                    loads_.stiffest_wall) *
           scene_.mesh.cell[node];
}

/// What a pinned head may do: turn across its director.
Matrix6 Balance::tilt_of(const RodState& state) {
    const Vector3d& t = state.director.front();
    Matrix6 tilt = Matrix6::Zero();
    tilt.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity() - t * t.transpose();
    return tilt;
}

/// A pinned head yields by its tilt alone. What projects on it turns with the director: of a torque
/// T about it, T (dq x t) goes over to the tilt.
void Balance::pin_head(const RodState& state, BlockTridiagonal& matrix) const {
    const Vector3d& t = state.director.front();
    const double torque = segment_forces(segment(state, 0)).on_a.tail<3>().dot(t);
    const Matrix6 tilt = tilt_of(state);
    for (int i = 0; i < 3; ++i)
        matrix.diagonal[0].block<3, 1>(3, 3 + i) += torque * Vector3d::Unit(i).cross(t);
    matrix.diagonal[0] = tilt * matrix.diagonal[0] * tilt + Matrix6::Identity() - tilt;
    matrix.upper[0] = tilt * matrix.upper[0];
    matrix.lower[1] = matrix.lower[1] * tilt;
}

Imbalance Balance::imbalance(const RodState& state) {
    const std::size_t segments = state.twist.size();
    Imbalance sum;
    const std::size_t moving = segments + 1 - first_;
    sum.rounding.resize(moving);
    sum.force.assign(moving, Vector6::Zero());
    sum.loose.assign(moving, Vector6::Zero());
    const auto add_energy = [&](double energy) {
        sum.energy += energy;
        sum.energy_sum += std::abs(energy);
    };
    // potentials count from the initial nodes: small numbers
    const auto sunk = [&](std::size_t node) {
        return Vector3d(state.position[node] - scene_.initial_nodes.position[node]);
    };
    for (std::size_t k = 0; k < segments; ++k) {
        const SegmentForces forces = segment_forces(segment(state, k));
        const std::size_t node = k + 1;
        const std::size_t b = node - first_;
        if (k >= first_) sum.force[k - first_] += forces.on_a;
        sum.force[b] += forces.on_b;
        add_energy(forces.energy);
        const WallLoad wall = scene_.well ? wall_load(site(state, node)) : WallLoad{};
        add_rounding(state, k, forces.on_a.head<3>().norm(), wall, sum);

        const Vector3d weight =
            loads_.weight * scene_.mesh.cell[node] * scene_.weight[node] * scene_.down;
        sum.force[b].head<3>() += weight;
        add_energy(-weight.dot(sunk(node)));
        if (!scene_.well) continue;
        if (!mud_.empty()) {
            const Vector3d pushed = mud_force(state, node);
            sum.force[b].head<3>() += pushed;
            sum.loose[b].head<3>() += pushed;
        }
        sum.force[b] += wall.load;
        sum.loose[b].head<3>() += wall.friction;
        sum.loose[b].tail<3>() += wall.load.tail<3>();
        add_energy(wall.energy);
        if (held_friction_.empty()) continue;
        const Vector6& held = held_friction_[node];
        sum.force[b] += held;
        sum.loose[b].tail<3>() += held.tail<3>();
        add_energy(-held.head<3>().dot(sunk(node)));
    }
    if (first_ == 0) sum.force.front() = tilt_of(state) * sum.force.front();
    const BitLoad on_bit = bit(state);
    sum.force.back() += on_bit.load;
    sum.loose.back() += on_bit.load;
    sum.loose.back().head<3>() -= on_bit.dead_force;
    add_energy(-on_bit.dead_force.dot(sunk(segments)));
    return sum;
}

void Balance::stiffness(const RodState& state, BlockTridiagonal& matrix) {
    const std::size_t segments = state.twist.size();
    matrix.set_zero();
    for (std::size_t k = 0; k < segments; ++k) {
        const SegmentTangent d = segment_tangent(segment(state, k));
        const std::size_t b = k + 1 - first_;
        if (k >= first_) {
            matrix.diagonal[b - 1] -= d.aa;
            matrix.upper[b - 1] -= d.ab;
            matrix.lower[b] -= d.ba;
        }
        matrix.diagonal[b] -= d.bb;
        if (scene_.well) matrix.diagonal[b] += wall_stiffness(state, k + 1);
        if (!mud_.empty()) matrix.diagonal[b].topLeftCorner<3, 3>() -= mud_tangent(state, k + 1);
    }
    if (first_ == 0) pin_head(state, matrix);
    matrix.diagonal.back() -= bit(state).tangent;
}

Matrix6 Balance::wall_stiffness(const RodState& state, std::size_t node) {
    return -wall_tangent(site(state, node));
}

double Balance::hook_load(const RodState& state) const {
    Vector3d pull = segment_forces(segment(state, 0)).on_a.head<3>();
    if (!mud_.empty()) pull += mud_.front() * state.director.front();
    return head_.hook_load(pull, state.director.front(), loads_.bit.time);
}

double Balance::surface_torque(const RodState& state) const {
    const Vector3d couple = segment_forces(segment(state, 0)).on_a.tail<3>();
    return head_.surface_torque(couple.dot(state.director.front()), loads_.bit.time);
}

double Balance::weight_on_bit() const {
    return loads_.bit.factor * bit_.loads().weight(loads_.bit.time);
}

double Balance::bit_torque() const {
    return loads_.bit.factor * bit_.torque(loads_.bit.rotation_rate, loads_.bit.time);
}

std::vector<WallReport> Balance::walls(const RodState& state) {
    std::vector<WallReport> report(state.position.size(), {Vector3d::Zero(), 0});
    if (!scene_.well) return report;
    for (std::size_t node = 1; node < report.size(); ++node) {
        const WallLoad wall = wall_load(site(state, node));
        const double per_length = 1 / scene_.mesh.cell[node];
        report[node].force = per_length * wall.load.head<3>();
        report[node].normal = per_length * (wall.load.head<3>() - wall.friction).norm();
    }
    return report;
}

}  // namespace drillstrand
