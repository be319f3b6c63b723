#include "rod/director_report.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/segment_strain.hpp"
#include "rod/report.hpp"

namespace drillstrand {

using Eigen::Vector3d;

std::vector<Eigen::Matrix3d> material_frames(const DirectorString& string,
                                             const Table<DirectorRow>& rod, const double* twist,
                                             const Vector3d& head_d1) {
    std::vector<Eigen::Matrix3d> frames;
    frames.reserve(string.model.segments + 1);
    Vector3d d1 = head_d1;
    Vector3d t = rod.vector(DirectorRow::director, 0);
    for (std::size_t k = 0; k <= string.model.segments; ++k) {
        if (k > 0) {
            const Vector3d to = rod.vector(DirectorRow::director, k);
            d1 = followed(d1, t, to, string.scene.mesh.length[k - 1] * twist[k - 1]);
            t = to;
        }
        frames.emplace_back() << t, d1, t.cross(d1);
    }
    return frames;
}

namespace {

/// Stress of a segment in the axes of its middle: strains of chord, directors and twist, times
/// stiffness.
Vector6 segment_stress(const Scene& scene, std::size_t k, const DirectorSnapshot& at) {
    const double h = scene.mesh.length[k];
    const auto node = [&](DirectorRow row, std::size_t i) { return triple(at.rod.vector(row, i)); };
    const Triple ta = node(DirectorRow::director, k);
    const Triple tb = node(DirectorRow::director, k + 1);
    const SegmentBend arc(ta, tb);
    const SegmentStretch stretch(node(DirectorRow::position, k), node(DirectorRow::position, k + 1),
                                 1.0 / h, ta, tb, arc.inverse_both());
    const Vector3d mean = vector(stretch.mean);
    const Vector3d chord = vector(stretch.chord);
    const Vector3d bend = arc.factor() / h * vector(arc.turn);
    const Vector3d d1 = 0.5 * (at.frame[k].col(1) + at.frame[k + 1].col(1));
    const Vector3d d2 = 0.5 * (at.frame[k].col(2) + at.frame[k + 1].col(2));
    Vector6 strain;
    strain << at.segments.row(SegmentRow::twist)[k], bend.dot(d1), bend.dot(d2), stretch.along,
        chord.dot(d1 - d1.dot(mean) * mean), chord.dot(d2 - d2.dot(mean) * mean);
    const SectionProperties& section = scene.mesh.segment[k];
    return stiffness_of(section).cwiseProduct(strain - stress_free_strain(section));
}

}  // namespace

/// Half a kick on copies, and no drift.
DirectorSnapshot snapshot(const DirectorString& string, const DirectorState& state) {
    const DirectorModel& model = string.model;
    const double time = state.clock.time;
    const double last_drift = state.clock.last_step;
    DirectorSnapshot at{state.rod, Table<SegmentRow>(model.segments + 1), state.wall, {}, {}};
    for (const BlockSpan span : string.spans)
        director_segments(model, state.rod, at.segments, span, last_drift);
    string.head.load(at.segments, state.rod, time);
    load_bit(string, state, state.rod, time, at.segments);
    for (const BlockSpan span : string.spans) {
        const NodeStep done = director_nodes(model, state.rod, at.rod, at.segments, at.wall, span,
                                             0.5 * last_drift, 0.0);
        at.impacts += done.impacts;
        at.slips += done.slips;
    }
    string.head.settle(at.rod, time);
    at.frame = material_frames(string, at.rod, at.segments.row(SegmentRow::twist),
                               string.head.d1(state.head, time));
    for (std::size_t k = 0; k < model.segments; ++k)
        at.stress.push_back(segment_stress(string.scene, k, at));
    return at;
}

namespace {

/// Kinetic energy of a node's cell (J), that of the fluid which moves sideways with it included.
double kinetic_energy(const Scene& scene, const Table<DirectorRow>& rod, const Table<WallRow>& wall,
                      std::size_t node) {
    const double s = rod.row(DirectorRow::spin)[node];
    const Vector3d v = rod.vector(DirectorRow::velocity, node);
    const double along = v.dot(rod.vector(DirectorRow::director, node));
    const double speed2 = v.squaredNorm();
    return 0.5 * scene.mesh.cell[node] *
           (scene.mesh.node[node].mass * speed2 +
            fluid_mass_at(wall, node) * (speed2 - along * along) +
            scene.inertia[node] * rod.vector(DirectorRow::angular_velocity, node).squaredNorm() +
            scene.mesh.node[node].polar_inertia * s * s);
}

std::vector<Vector3d> positions(const DirectorString& string, const Table<DirectorRow>& rod) {
    std::vector<Vector3d> position;
    for (std::size_t k = 0; k <= string.model.segments; ++k)
        position.push_back(rod.vector(DirectorRow::position, k));
    return position;
}

}  // namespace

EnergyOrigin energy_origin(const DirectorString& string, const DirectorState& state) {
    const Scene& scene = string.scene;
    const std::vector<Vector3d> position = positions(string, state.rod);
    EnergyOrigin origin;
    if (string.head.is_driven()) origin.head = kinetic_energy(scene, state.rod, state.wall, 0);
    origin.potential = potential_energy(scene, position);
    origin.springs =
        spring_energy(scene, contacts_of(string.model.surroundings, state.wall, position));
    return origin;
}

SeriesRecord series_record(const DirectorString& string, const DirectorState& state) {
    const Scene& scene = string.scene;
    const DirectorSnapshot at = snapshot(string, state);
    const std::size_t last = string.model.segments;
    const std::vector<Vector3d> position = positions(string, at.rod);
    SeriesRecord record;
    record.time = state.clock.time;
    record.head_stress = at.stress.front();
    record.bit_stress = at.stress.back();
    record.head_position = position.front();
    record.bit_position = position.back();
    record.head_rotation_rate = at.rod.row(DirectorRow::spin)[0];
    record.bit_rotation_rate = at.rod.row(DirectorRow::spin)[last];
    const double time = state.clock.time;
    record.hook_load = string.head.hook_load(
        at.segments.vector(SegmentRow::pull, 0) + at.segments.vector(SegmentRow::viscous_pull, 0),
        time);
    record.surface_torque = string.head.surface_torque(
        at.segments.row(SegmentRow::torque)[0] + at.segments.row(SegmentRow::viscous_torque)[0],
        time);
    record.weight_on_bit = string.bit.loads().weight(time);
    record.bit_torque = string.bit.torque(
        string.head.opposed_rate(time, at.rod.row(DirectorRow::spin)[last]), time);
    record.step_size = state.clock.last_step;
    record.time_error = state.time_error.latest;

    EnergyAccount& energy = record.energy;
    for (std::size_t k = 0; k <= last; ++k)
        energy.kinetic += kinetic_energy(scene, at.rod, at.wall, k);
    energy.elastic = elastic_energy(scene, at.stress);
    energy.potential = potential_energy(scene, position);
    energy.work = state.head.work + state.bit.work;
    if (string.head.is_driven())
        energy.work += kinetic_energy(scene, at.rod, at.wall, 0) - state.origin.head;
    NodeReport nodes{contacts_of(string.model.surroundings, at.wall, position), {}};
    for (std::size_t k = 0; k <= last; ++k)
        nodes.velocity.push_back(
            {at.rod.vector(DirectorRow::velocity, k), at.rod.row(DirectorRow::spin)[k]});
    account_for(record, scene, nodes, at.stress, state.accounts, state.origin);
    record.impacts += std::llround(at.impacts);
    record.slips += std::llround(at.slips);
    record.contact_changes = 2 * record.impacts - record.contact_nodes;
    return record;
}

Profile profile_record(const DirectorString& string, const DirectorState& state) {
    const Scene& scene = string.scene;
    const DirectorSnapshot at = snapshot(string, state);
    Profile profile;
    profile.time = state.clock.time;
    profile.stress = at.stress;
    profile.position = positions(string, at.rod);
    for (std::size_t k = 0; k <= string.model.segments; ++k) {
        const Eigen::Matrix3d to_body = at.frame[k].transpose();
        Vector6 momentum;
        momentum << to_body * at.rod.vector(DirectorRow::angular_velocity, k),
            to_body * at.rod.vector(DirectorRow::velocity, k);
        momentum[0] = at.rod.row(DirectorRow::spin)[k];
        momentum = momentum.cwiseProduct(inertia_of(scene, k, fluid_mass_at(at.wall, k)));
        profile.director.emplace_back(at.frame[k].col(0));
        profile.momentum.push_back(momentum);
    }
    report_wall(string.scene, profile, string.model.surroundings, at.wall);
    return profile;
}

std::string describe_divergence(const DirectorString& string,
                                std::initializer_list<const Table<DirectorRow>*> rods,
                                double time) {
    for (const Table<DirectorRow>* rod : rods) {
        for (std::size_t k = 0; k <= string.model.segments; ++k) {
            const Vector3d v = rod->vector(DirectorRow::velocity, k);
            if (v.allFinite() && v.squaredNorm() < 1e20) continue;
            return fmt::format(
                "the solution diverged near node {}, {:.1f} m along the string, at t = {:.6f} s", k,
                string.scene.mesh.node_s[k], time);
        }
    }
    return fmt::format("the solution diverged at t = {:.6f} s", time);
}

}  // namespace drillstrand
