#include "rod/strand_state.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "rod/report.hpp"
#include "rod/sensor.hpp"

namespace drillstrand {

using Eigen::Vector3d;

StrandString::StrandString(const Scene& scene_of_run, Level level)
    : scene(scene_of_run), model(scene, level), head(scene), bit(scene) {}

namespace {

std::vector<Vector3d> positions(const std::vector<Pose>& poses) {
    std::vector<Vector3d> position;
    for (const Pose& pose : poses)
        position.push_back(pose.position);
    return position;
}

std::vector<Vector6> stresses(const StrandString& string, const Table<StrandRow>& rod) {
    std::vector<Vector6> stress;
    for (std::size_t k = 0; k < string.model.segments; ++k)
        stress.push_back(stress_of(rod, k));
    return stress;
}

std::vector<Pose> poses(const StrandString& string, const StrandState& state) {
    std::vector<Vector6> strain;
    for (std::size_t k = 0; k < string.model.segments; ++k) {
        const SectionProperties& s = string.scene.mesh.segment[k];
        strain.emplace_back(stress_of(state.rod, k).cwiseQuotient(stiffness_of(s)) +
                            stress_free_strain(s));
    }
    return poses_from_strains(string.head.pose(state.head, state.clock.time),
                              string.scene.mesh.length, strain);
}

/// Wrench of the first segment on the head in body axes: S + h/2 (k x m + g x n, k x n),
/// Kelvin-Voigt stress included (paper eq. 5).
Vector6 first_wrench(const StrandString& string, const StrandState& state) {
    const SectionProperties& section = string.scene.mesh.segment.front();
    const Vector6 stress = stress_of(state.rod, 0);
    const Vector6 strain =
        stress.cwiseQuotient(stiffness_of(section)) + stress_free_strain(section);
    const Vector6 acting = stress + string.model.kelvin_voigt * stress_of(state.rate, 0);
    const Vector3d k = strain.head<3>();
    const Vector3d g = strain.tail<3>();
    const Vector3d m = acting.head<3>();
    const Vector3d n = acting.tail<3>();
    Vector6 arm;
    arm << k.cross(m) + g.cross(n), k.cross(n);
    return acting + 0.5 * string.scene.mesh.length.front() * arm;
}

}  // namespace

Vector6 velocity_of(const Scene& scene, const Table<StrandRow>& rod, const Table<WallRow>& wall,
                    std::size_t node) {
    return momentum_of(rod, node).cwiseQuotient(inertia_of(scene, node, fluid_mass_at(wall, node)));
}

StrandState initial_state(const StrandString& string) {
    const Scene& scene = string.scene;
    const std::size_t nodes = string.model.segments + 1;
    StrandState state;
    state.rod = Table<StrandRow>(nodes);
    state.rate = Table<StrandRow>(nodes);
    // at rest but for the head, with the stresses of the initial strains
    for (std::size_t k = 0; k + 1 < nodes; ++k) {
        const SectionProperties& s = scene.mesh.segment[k];
        set_stress(state.rod, k,
                   stiffness_of(s).cwiseProduct(scene.initial_strain[k] - stress_free_strain(s)));
    }
    state.head = string.head.start(scene.head_frame.col(0));
    state.wall = string.model.surroundings.wall_at(positions(poses_from_strains(
        {scene.head_frame, scene.head_position}, scene.mesh.length, scene.initial_strain)));
    string.head.prescribe(state.rod, inertia_of(scene, 0, fluid_mass_at(state.wall, 0)), 0.0);
    state.accounts = Accounts(state.rod.blocks());
    state.power.surroundings.resize(state.rod.blocks());
    state.statistics.smallest_step = std::numeric_limits<double>::infinity();

    double step = 1.0;
    for (std::size_t k = 0; k < nodes; ++k) {
        const std::size_t segment = std::min(k, nodes - 2);
        step = std::min(
            step, 0.01 * std::sqrt(scene.inertia[k] / scene.mesh.segment[segment].shear_stiffness));
    }
    state.clock.proposed_step = step;
    return state;
}

BitMotion bit_motion(const StrandString& string, const Table<WallRow>& wall, const Pose& pose,
                     double rotation_rate, double time) {
    return {pose.frame,
            string.model.surroundings.direction(wall, string.model.segments, pose.position,
                                                pose.frame.col(0)),
            string.head.opposed_rate(time, rotation_rate)};
}

void count_events(const StrandString& string, StrandState& state, std::size_t block) {
    if (string.model.surroundings.empty()) return;
    const std::size_t first = block * block_size;
    double* touched = state.wall.row(WallRow::touched) + first;
    double* slid = state.wall.row(WallRow::slid) + first;
    const double* depth = state.wall.row(WallRow::depth) + first;
    const double* sliding = state.wall.row(WallRow::sliding) + first;
    for (std::size_t k = 0; k < block_size; ++k) {
        const double touches = depth[k] > 0 ? 1.0 : 0.0;
        const double slides = sliding[k] > 0 ? 1.0 : 0.0;
        state.accounts.impacts[block] += touches * (1.0 - touched[k]);
        state.accounts.slips[block] += slides * (1.0 - slid[k]);
        touched[k] = touches;
        slid[k] = slides;
    }
}

void derive(const StrandString& string, StrandState& state) {
    if (!(std::isfinite(state.clock.time) && state.clock.proposed_step > 0) ||
        state.statistics.steps < 0)
        throw std::invalid_argument("the clock of the saved state is out of order");
    if (!state.accounts.are_counts())
        throw std::invalid_argument("impacts or slips of the saved state are no counts");
    string.model.surroundings.derive(state.wall);
}

// ------------------------------------------------------------------ what the run reports

namespace {

double kinetic_energy_of(const StrandString& string, const StrandState& state, std::size_t node) {
    return kinetic_energy(string.scene, node, fluid_mass_at(state.wall, node),
                          momentum_of(state.rod, node));
}

/// Of the head's kinetic energy (J) what prescribed motion gives it.
double prescribed_energy(const StrandString& string, const StrandState& state) {
    const double rate = velocity_of(string.scene, state.rod, state.wall, 0)[0];
    return string.head.prescribed_energy(kinetic_energy_of(string, state, 0), rate);
}

NodeReport report_nodes(const StrandString& string, const StrandState& state,
                        const std::vector<Pose>& pose) {
    NodeReport nodes{contacts_of(string.model.surroundings, state.wall, positions(pose)), {}};
    for (std::size_t k = 0; k < pose.size(); ++k) {
        const Vector6 velocity = velocity_of(string.scene, state.rod, state.wall, k);
        nodes.velocity.push_back({pose[k].frame * velocity.tail<3>(), velocity[0]});
    }
    return nodes;
}

}  // namespace

EnergyOrigin energy_origin(const StrandString& string, const StrandState& state) {
    const Scene& scene = string.scene;
    const std::vector<Vector3d> position = positions(poses(string, state));
    EnergyOrigin origin;
    origin.head = prescribed_energy(string, state);
    origin.potential = potential_energy(scene, position);
    origin.springs =
        spring_energy(scene, contacts_of(string.model.surroundings, state.wall, position));
    return origin;
}

SeriesRecord series_record(const StrandString& string, const StrandState& state) {
    const Scene& scene = string.scene;
    const std::size_t last = string.model.segments;
    const std::vector<Pose> pose = poses(string, state);
    const std::vector<Vector3d> position = positions(pose);
    const std::vector<Vector6> stress = stresses(string, state.rod);
    SeriesRecord record;
    record.time = state.clock.time;
    record.head_stress = stress.front();
    record.bit_stress = stress.back();
    record.head_position = position.front();
    record.bit_position = position.back();
    record.head_rotation_rate = velocity_of(scene, state.rod, state.wall, 0)[0];
    record.bit_rotation_rate = velocity_of(scene, state.rod, state.wall, last)[0];
    const double time = state.clock.time;
    const Vector6 on_head = first_wrench(string, state);
    const Eigen::Matrix3d frame = string.head.pose(state.head, time).frame;
    record.hook_load = string.head.hook_load(
        frame * on_head.tail<3>() + mud_on_head(scene, string.model.surroundings), frame.col(0),
        time);
    record.surface_torque = string.head.surface_torque(on_head[0], time);
    record.drive_torque = record.surface_torque;
    record.weight_on_bit = string.bit.loads().weight(time);
    record.bit_torque =
        string.bit.torque(string.head.opposed_rate(time, record.bit_rotation_rate), time);
    record.step_size = state.clock.last_step;

    EnergyAccount& energy = record.energy;
    for (std::size_t k = 0; k <= last; ++k)
        energy.kinetic += kinetic_energy_of(string, state, k);
    energy.elastic = elastic_energy(scene, stress);
    energy.potential = potential_energy(scene, position);
    energy.work = state.head.work + state.bit.work;
    energy.work += prescribed_energy(string, state) - state.origin.head;
    const NodeReport nodes = report_nodes(string, state, pose);
    std::vector<double> tension;
    for (const Vector6& of_segment : stress)
        tension.push_back(of_segment[3]);
    account_for(record, scene, nodes, tension, state.accounts, state.origin);
    return record;
}

std::vector<Eigen::Vector3d> moments_at_nodes(const std::vector<Vector6>& stress) {
    std::vector<Eigen::Vector3d> moment;
    for (std::size_t k = 0; k <= stress.size(); ++k) {
        const Vector6& above = stress[k > 0 ? k - 1 : 0];
        const Vector6& below = stress[std::min(k, stress.size() - 1)];
        moment.emplace_back(0.5 * (above.head<3>() + below.head<3>()));
    }
    return moment;
}

Profile profile_record(const StrandString& string, const StrandState& state) {
    Profile profile;
    profile.time = state.clock.time;
    const std::vector<Pose> pose = poses(string, state);
    profile.position = positions(pose);
    for (std::size_t k = 0; k < pose.size(); ++k) {
        profile.director.emplace_back(pose[k].frame.col(0));
        profile.momentum.push_back(momentum_of(state.rod, k));
    }
    profile.stress = stresses(string, state.rod);
    profile.moment = moments_at_nodes(profile.stress);
    report_wall(string.scene, profile, state.wall, report_nodes(string, state, pose));
    return profile;
}

BendingRecord bending_record(const StrandString& string, const StrandState& state) {
    BendingRecord record{state.clock.time, {}};
    record.moment.reserve(string.model.segments);
    for (const Vector6& stress : stresses(string, state.rod))
        record.moment.emplace_back(stress.segment<2>(1));
    return record;
}

namespace {

/// Rates of the body's components become accelerations with what the body's turning adds; that of
/// an angular velocity is none.
SectionMotion motion_of(const StrandString& string, const StrandState& state,
                        const std::vector<Pose>& pose, std::size_t node) {
    const Vector6 velocity = velocity_of(string.scene, state.rod, state.wall, node);
    const Vector6 rate = velocity_of(string.scene, state.rate, state.wall, node);
    const Vector3d turning = velocity.head<3>();
    const Eigen::Matrix3d& frame = pose[node].frame;
    return {frame, frame * (rate.tail<3>() + turning.cross(Vector3d(velocity.tail<3>()))),
            frame * turning, frame * rate.head<3>()};
}

}  // namespace

std::vector<SensorRecord> sensor_records(const StrandString& string, const StrandState& state,
                                         const std::vector<SensorCase>& sensors) {
    const std::vector<Pose> pose = poses(string, state);
    std::vector<SensorRecord> records;
    for (const SensorCase& sensor : sensors) {
        const SensorPlace place(string.scene.mesh, sensor);
        const SectionMotion motion =
            motion_between(motion_of(string, state, pose, place.segment),
                           motion_of(string, state, pose, place.segment + 1), place.share);
        records.push_back(
            sensor_record(string.scene, sensor, motion, stress_of(state.rod, place.segment)));
        records.back().time = state.clock.time;
    }
    return records;
}

}  // namespace drillstrand
