#include "rod/director_report.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "model/segment_strain.hpp"
#include "numerics/kernel.hpp"
#include "rod/director_rows.hpp"
#include "rod/report.hpp"
#include "rod/sensor.hpp"

namespace drillstrand {

using Eigen::Vector3d;

std::vector<Eigen::Matrix3d> material_frames(const DirectorString& string,
                                             const Table<DirectorRow>& rod, const double* twist,
                                             const Vector3d& head_d1) {
    std::vector<Eigen::Matrix3d> frames;
    frames.reserve(string.model.segments + 1);
    Vector3d untwisted = head_d1;
    Vector3d t = rod.vector(DirectorRow::director, 0);
    double angle = 0;
    for (std::size_t k = 0; k <= string.model.segments; ++k) {
        if (k > 0) {
            const Vector3d to = rod.vector(DirectorRow::director, k);
            untwisted = carried(untwisted, t, to);
            angle += string.scene.mesh.length[k - 1] * twist[k - 1];
            t = to;
        }
        const Vector3d d1 =
            (std::cos(angle) * untwisted + std::sin(angle) * t.cross(untwisted)).normalized();
        frames.emplace_back() << t, d1, t.cross(d1);
    }
    return frames;
}

namespace {

Triple node_triple(const DirectorSnapshot& at, DirectorRow row, std::size_t node) {
    return triple(at.rod.vector(row, node));
}

/// A segment with the strains and forces of its exact beam-column.
struct ReportedSegment {
    ReportedSegment(const DirectorString& string, std::size_t k, const DirectorSnapshot& at)
        : section(string.scene.mesh.segment[k]),
          length(string.scene.mesh.length[k]),
          stiffness(section, length),
          arc(node_triple(at, DirectorRow::director, k),
              node_triple(at, DirectorRow::director, k + 1)),
          chord(node_triple(at, DirectorRow::position, k),
                node_triple(at, DirectorRow::position, k + 1), 1 / length,
                node_triple(at, DirectorRow::director, k),
                node_triple(at, DirectorRow::director, k + 1), arc.inverse_both()),
          bend(arc.factor() / length * vector(arc.turn)),
          beam(stiffness, chord, length * length * bend.squaredNorm(), string.jar.slid(at.jar, k)) {
    }

    const SectionProperties& section;
    double length;
    SegmentStiffness stiffness;
    SegmentBend arc;
    SegmentChord chord;
    Vector3d bend;  ///< kb (1/m)
    BeamColumn beam;
};

/// Couples of the segments on their first and last nodes, those of damping left out (N m).
Vector3d first_couple(const DirectorSnapshot& at, std::size_t k) {
    const Vector3d t = at.rod.vector(DirectorRow::director, k);
    return t.cross(at.segments.vector(SegmentRow::first_lean, k)) +
           at.segments.vector(SegmentRow::first_couple, k) +
           at.segments.row(SegmentRow::torque)[k] * t;
}
Vector3d last_couple(const DirectorSnapshot& at, std::size_t k) {
    const Vector3d t = at.rod.vector(DirectorRow::director, k + 1);
    return t.cross(at.segments.vector(SegmentRow::last_lean, k)) +
           at.segments.vector(SegmentRow::last_couple, k) -
           at.segments.row(SegmentRow::torque)[k] * t;
}

Triple own_at(const ReportedSegment& segment, const DirectorSnapshot& at, std::size_t node) {
    const Vector3d& curvature = segment.section.curvature;
    return own_curvature(curvature[1], curvature[2], triple(Vector3d(at.frame[node].col(0))),
                         triple(Vector3d(at.frame[node].col(1))));
}

/// h tau less that of the own shape (rad).
double elastic_twist(const ReportedSegment& segment, const DirectorSnapshot& at, std::size_t k) {
    const Triple& turn = segment.arc.turn;
    const double frames = at.segments.row(SegmentRow::twist)[k] - segment.section.curvature[0];
    return segment.length * frames +
           segment.stiffness.bending_share * twist_of_deviation(segment.chord, turn) +
           OwnCurvature::twist(segment.stiffness, segment.length, segment.chord, turn,
                               own_at(segment, at, k), own_at(segment, at, k + 1));
}

/// GJ times a twist per length. (The couple about the directors, `SegmentRow::torque`, has what
/// bending of an own shape adds, too.)
double elastic_torque(const ReportedSegment& segment, double twist) {
    const double sine2 = dot(segment.arc.turn, segment.arc.turn);
    return twist / (segment.length * segment.stiffness.torsion_compliance(sine2));
}

/// Along a segment's axis in its middle, of about length 1.
DRILLSTRAND_INLINE Triple along_middle(const SegmentChord& chord) {
    return combine(1.5, chord.along, -0.5, chord.mean);
}

/// Axes of a segment's middle: d3, d1, d2 in the columns.
Eigen::Matrix3d middle_frame(const ReportedSegment& segment, const DirectorSnapshot& at,
                             std::size_t k) {
    const Vector3d t = vector(along_middle(segment.chord)).normalized();
    const Vector3d across = at.frame[k].col(1) + at.frame[k + 1].col(1);
    const Vector3d d1 = (across - across.dot(t) * t).normalized();
    Eigen::Matrix3d frame;
    frame << t, d1, t.cross(d1);
    return frame;
}

/// The mean moment of bending along a segment, which its ends' directors tell (N m, space frame).
/// (Under tension, between nodes that touch the wall, moments at its ends are larger and in its
/// middle less.)
Vector3d bending_of(const ReportedSegment& segment, const DirectorSnapshot& at, std::size_t k) {
    // mean of a vector that turns with the sections by theta from end to end
    const double theta = segment.length * at.segments.row(SegmentRow::twist)[k];
    const double mean = 0.5 * (1.0 + theta * theta / 12.0);
    const Triple own = combine(mean, own_at(segment, at, k), mean, own_at(segment, at, k + 1));
    return segment.section.bending_stiffness * (segment.bend - vector(own));
}

/// Stress of a segment in the axes of its middle: its torque and mean bending, and the force on its
/// ends.
Vector6 stress_of(const ReportedSegment& segment, const DirectorSnapshot& at, std::size_t k) {
    const Eigen::Matrix3d frame = middle_frame(segment, at, k);
    const Vector3d bending = bending_of(segment, at, k);
    const Vector3d pull = at.segments.vector(SegmentRow::pull, k);
    Vector6 stress;
    stress << elastic_torque(segment, elastic_twist(segment, at, k)), bending.dot(frame.col(1)),
        bending.dot(frame.col(2)), pull.dot(frame.col(0)), pull.dot(frame.col(1)),
        pull.dot(frame.col(2));
    return stress;
}

/// Second integral over s, from the bit, of what is left of an even load once the cells' shares at
/// the nodes are taken from it (m2): h^2/12 where segments are alike, 0 at free ends.
std::vector<double> spread_of_cells(const StringMesh& mesh) {
    const std::size_t last = mesh.length.size();
    std::vector<double> spread(last + 1, 0.0);
    double left = 0;  // the first integral
    for (std::size_t k = last; k > 0; --k) {
        const double h = mesh.length[k - 1];
        left -= mesh.cell[k];
        spread[k - 1] = spread[k] + h * (left + 0.5 * h);
        left += h;
    }
    return spread;
}

/// X - 1 over z/12: the moment with which a segment under axial force holds an even load between
/// clamped ends, over q h^2/12.
double fixed_end_moment(const BeamColumn& beam) {
    const double z = beam.load.value;
    return z == 0 ? 1.0 : 1.0 + 12 * beam.stability.symmetric / z;
}

/// What lies on a string per length, inertia included, as the forces in its segments tell (N/m). A
/// wall presses between nodes where it does on both, but for tool joints and contact points, which
/// hold the pipe at a point, as a node does that touches alone. Nothing is asked of the bit, where
/// cells are right.
std::vector<Vector3d> spread_loads(const DirectorString& string, const DirectorSnapshot& at,
                                   const std::vector<NodeContact>& contacts) {
    const std::size_t last = string.model.segments;
    const auto lies = [&](std::size_t k) {
        return contacts[k].penetration > 0 && !string.scene.mesh.touches_at_a_point[k] ? 1.0 : 0.0;
    };
    std::vector<Vector3d> load(last + 1, Vector3d::Zero());
    for (std::size_t k = 1; k < last; ++k) {
        const Vector3d resultant =
            at.segments.vector(SegmentRow::pull, k - 1) - at.segments.vector(SegmentRow::pull, k);
        const double alone = 1 - lies(k) * 0.5 * (lies(k - 1) + lies(k + 1));
        load[k] = resultant / string.scene.mesh.cell[k] - alone * contacts[k].force;
    }
    if (last > 2) load[0] = 2 * load[1] - load[2];
    return load;
}

/// Moments that the rod bears at its nodes (N m): the mean of what the segments at a node bear
/// there, less what the loads on them, which they know as forces on nodes, do between the nodes
/// (engine/rod/README.md, "Moments at the nodes"). `fixed_end`: of each segment.
std::vector<Vector3d> moments_at_nodes(const DirectorString& string, const DirectorSnapshot& at,
                                       const std::vector<double>& fixed_end,
                                       const std::vector<NodeContact>& contacts) {
    const std::size_t last = string.model.segments;
    const std::vector<double> spread = spread_of_cells(string.scene.mesh);
    const std::vector<Vector3d> load = spread_loads(string, at, contacts);
    std::vector<Vector3d> moment;
    for (std::size_t k = 0; k <= last; ++k) {
        const std::size_t above = k > 0 ? k - 1 : 0;
        const std::size_t below = std::min(k, last - 1);
        const Vector3d before = k > 0 ? Vector3d(-last_couple(at, above)) : first_couple(at, 0);
        const Vector3d after = k < last ? first_couple(at, below) : before;
        const Vector3d t = at.rod.vector(DirectorRow::director, k);
        moment.emplace_back(0.5 * (before + after) + 0.5 * (fixed_end[above] + fixed_end[below]) *
                                                         spread[k] * t.cross(load[k]));
    }
    return moment;
}

/// What a shape of its own adds to the energy of a segment (J).
double own_shape_energy(const ReportedSegment& segment, const DirectorSnapshot& at, std::size_t k) {
    if (segment.section.curvature.tail<2>().isZero(0)) return 0;
    const double theta = segment.length * at.segments.row(SegmentRow::twist)[k];
    return OwnCurvature(
               segment.stiffness, segment.length, node_triple(at, DirectorRow::director, k),
               node_triple(at, DirectorRow::director, k + 1), segment.arc, segment.arc.factor(),
               segment.chord, theta, 0, own_at(segment, at, k), own_at(segment, at, k + 1))
        .energy;
}

/// Elastic energy (J) and axial force (N) of the segments of a block of strings without a
/// curvature of their own. `slid`: Jar::slid_in().
DRILLSTRAND_KERNEL void report_block(const DirectorConstants& c, const Table<DirectorRow>& rod,
                                     const Table<SegmentRow>& segments, std::size_t block,
                                     const double* slid, double* energy_out, double* tension_out) {
    const auto first = static_cast<std::ptrdiff_t>(block * block_size);
    const ConstTriples x_a = rod.triples(DirectorRow::position, first);
    const ConstTriples x_b = rod.triples(DirectorRow::position, first + 1);
    const ConstTriples t_a = rod.triples(DirectorRow::director, first);
    const ConstTriples t_b = rod.triples(DirectorRow::director, first + 1);
    const ConstTriples pull = segments.triples(SegmentRow::pull, first);
    const double* twist = segments.row(SegmentRow::twist) + first;
    const double* twist0 = c.row(DirectorConstants::twist0) + first;
    const StiffnessRows stiffnesses(c, first);
    const double* inverse_length = c.row(DirectorConstants::inverse_length) + first;
    const double* length = c.row(DirectorConstants::length) + first;

    const auto segment = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const double h = length[k];
        const Triple ta = t_a[k];
        const Triple tb = t_b[k];
        const SegmentBend arc(ta, tb);
        const SegmentChord chord(x_a[k], x_b[k], inverse_length[k], ta, tb, arc.inverse_both());
        const double factor = arc.factor();
        const double sine2 = dot(arc.turn, arc.turn);
        const SegmentStiffness stiffness = stiffnesses[k];
        const BeamColumn beam(stiffness, chord, factor * factor * sine2, slid[k]);
        const double elastic_twist = h * (twist[k] - twist0[k]) +
                                     stiffness.bending_share * twist_of_deviation(chord, arc.turn);
        const Triple along = along_middle(chord);
        energy_out[k] =
            h * beam.whole_energy(stiffness) +
            0.5 * elastic_twist * elastic_twist / (h * stiffness.torsion_compliance(sine2));
        tension_out[k] = dot(pull[k], along) / std::sqrt(dot(along, along));
    };
#pragma omp simd
    for (std::size_t k = 0; k < block_size; ++k)
        segment(k);
}

/// Elastic energy of a segment (J).
double energy_of(const ReportedSegment& segment, const DirectorSnapshot& at, std::size_t k) {
    const double twist = elastic_twist(segment, at, k);
    return segment.length * segment.beam.whole_energy(segment.stiffness) +
           own_shape_energy(segment, at, k) + 0.5 * elastic_torque(segment, twist) * twist;
}

struct EnergiesAndTensions {
    std::vector<double> energy;   ///< of each segment, elastic (J)
    std::vector<double> tension;  ///< of each segment (N)
};
EnergiesAndTensions energies_and_tensions(const DirectorString& string,
                                          const DirectorSnapshot& at) {
    const std::size_t count = string.model.segments;
    const std::size_t blocks = (count + block_size - 1) / block_size;
    EnergiesAndTensions of{std::vector<double>(blocks * block_size),
                           std::vector<double>(blocks * block_size)};
    for (std::size_t block = 0; block < blocks; ++block) {
        const std::array<double, block_size> slid = string.jar.slid_in(at.jar, block);
        at_level<report_block>(string.model.level)(
            string.model.constants, at.rod, at.segments, block, slid.data(),
            of.energy.data() + block * block_size, of.tension.data() + block * block_size);
    }
    of.energy.resize(count);
    of.tension.resize(count);
    if (string.model.features.curved)
        for (std::size_t k = 0; k < count; ++k)
            of.energy[k] = energy_of(ReportedSegment(string, k, at), at, k);
    return of;
}

/// What the segments of fine stretches hand to nodes in a step (s); the work of each stretch.
std::vector<Substeps::Work> average_over_substeps(const DirectorString& string,
                                                  const DirectorState& state, double step,
                                                  DirectorSnapshot& at) {
    std::vector<Substeps::Work> works;
    if (string.substeps.empty()) return works;
    at.averaged = at.segments;
    for (std::size_t i = 0; i < string.substeps.count(); ++i) {
        works.push_back(string.substeps.work_for(i));
        string.substeps.average(string.model, state.rod, at.wall, i, step, works[i], *at.averaged);
    }
    return works;
}

}  // namespace

/// Half a kick on copies, and no drift.
DirectorSnapshot snapshot(const DirectorString& string, const DirectorState& state) {
    const DirectorModel& model = string.model;
    const double time = state.clock.time;
    const double last_drift = state.clock.last_step;
    DirectorSnapshot at{state.rod, Table<SegmentRow>(model.segments + 1), {}, state.wall, {}};
    at.jar = string.jar.follow(state.jar, model, state.rod, last_drift);
    for (const BlockSpan span : string.spans)
        string_segments(string, at.jar, state.rod, at.segments, span, last_drift);
    string.head.load(at.segments, state.rod, time);
    load_bit(string, state, state.rod, time, at.segments);
    std::vector<Substeps::Work> works;
    if (last_drift > 0) works = average_over_substeps(string, state, last_drift, at);
    for (const BlockSpan span : string.spans) {
        const NodeStep done = director_nodes(model, state.rod, at.rod, at.handed_over(), at.wall,
                                             span, 0.5 * last_drift, 0.0);
        at.impacts += done.impacts;
        at.slips += done.slips;
    }
    BitState bit = state.bit;
    RockState rock = state.rock;
    if (last_drift > 0)
        string.bit.resist(bit, rock, state.rod, at.rod, well_at_bit(string, state.wall, state.rod),
                          {time, last_drift, 0.0, 0.5 * last_drift});
    for (std::size_t i = 0; i < works.size(); ++i)
        string.substeps.share(model, state.rod, at.rod, i, 0.5 * last_drift, 0.0, works[i]);
    string.head.settle(state.head, at.segments, state.rod, at.rod, time, 0.5 * last_drift);
    at.frame = material_frames(string, at.rod, at.segments.row(SegmentRow::twist),
                               string.head.d1(state.head, time));
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

/// Of the head's kinetic energy (J) what prescribed motion gives it.
double prescribed_energy(const DirectorString& string, const Table<DirectorRow>& rod,
                         const Table<WallRow>& wall) {
    return string.head.prescribed_energy(kinetic_energy(string.scene, rod, wall, 0),
                                         rod.row(DirectorRow::spin)[0]);
}

/// What the segments of a table do to a node; to a pinned one, what its holding does not take.
RodLoad load_on(const Table<SegmentRow>& segments, const Triple& t, std::size_t node,
                bool is_pinned) {
    const auto after = static_cast<std::ptrdiff_t>(node);
    const RodLoad load =
        rod_load<true>(SegmentsIn(segments, after), SegmentsIn(segments, after - 1), t, 1.0, 0);
    return is_pinned ? RodLoad{{}, load.couple, 0.0} : load;
}

/// What the rod's forces on a node do to its velocities in half a step, as an energy (J). The
/// leapfrog keeps the energy 1/2 m v- . v+ of the half steps before and after, which is by this
/// less than that of their mean: of a mode near the bound of the step, almost all of it.
double half_kick_energy(const Scene& scene, const DirectorSnapshot& at, double half_step,
                        std::size_t node, bool is_pinned) {
    const Triple t = node_triple(at, DirectorRow::director, node);
    const RodLoad now = load_on(at.segments, t, node, is_pinned);
    const RodLoad handed = load_on(at.handed_over(), t, node, is_pinned);
    const double along = dot(now.force, t) * dot(handed.force, t);
    const SectionProperties& section = scene.mesh.node[node];
    const double sideways = section.mass + fluid_mass_at(at.wall, node);
    return 0.5 * half_step * half_step / scene.mesh.cell[node] *
           (along / section.mass + (dot(now.force, handed.force) - along) / sideways +
            dot(now.couple, handed.couple) / scene.inertia[node] +
            now.torque * handed.torque / section.polar_inertia);
}

/// Likewise of the whole rod. Substeps keep more than 1/2 m v- . v+ (Substeps::added_energy).
double half_kick_energy(const DirectorString& string, const DirectorSnapshot& at,
                        double half_step) {
    double sum = -string.substeps.added_energy(at.rod, 2 * half_step);
    const bool is_clamped = string.head.is_held() && !string.head.is_pinned();
    for (std::size_t k = is_clamped ? 1 : 0; k <= string.model.segments; ++k)
        sum += half_kick_energy(string.scene, at, half_step, k, k == 0 && string.head.is_pinned());
    return sum;
}

std::vector<Vector3d> positions(const DirectorString& string, const Table<DirectorRow>& rod) {
    std::vector<Vector3d> position;
    position.reserve(string.model.segments + 1);
    for (std::size_t k = 0; k <= string.model.segments; ++k)
        position.push_back(rod.vector(DirectorRow::position, k));
    return position;
}

}  // namespace

EnergyOrigin energy_origin(const DirectorString& string, const DirectorState& state) {
    const Scene& scene = string.scene;
    const std::vector<Vector3d> position = positions(string, state.rod);
    EnergyOrigin origin;
    origin.head = prescribed_energy(string, state.rod, state.wall);
    origin.potential = potential_energy(scene, position);
    origin.springs =
        spring_energy(scene, contacts_of(string.model.surroundings, state.wall, position));
    return origin;
}

double half_kick_energy(const DirectorString& string, const DirectorState& state,
                        double half_step) {
    DirectorSnapshot at = snapshot(string, state);
    average_over_substeps(string, state, 2 * half_step, at);
    return half_kick_energy(string, at, half_step);
}

namespace {

NodeReport report_nodes(const DirectorString& string, const DirectorSnapshot& at,
                        const std::vector<Vector3d>& position) {
    NodeReport nodes{contacts_of(string.model.surroundings, at.wall, position), {}};
    nodes.velocity.reserve(position.size());
    for (std::size_t k = 0; k < position.size(); ++k)
        nodes.velocity.push_back(
            {at.rod.vector(DirectorRow::velocity, k), at.rod.row(DirectorRow::spin)[k]});
    return nodes;
}

}  // namespace

SeriesRecord series_record(const DirectorString& string, const DirectorState& state) {
    const Scene& scene = string.scene;
    const DirectorSnapshot at = snapshot(string, state);
    const std::size_t last = string.model.segments;
    const std::vector<Vector3d> position = positions(string, at.rod);
    SeriesRecord record;
    record.time = state.clock.time;
    record.head_position = position.front();
    record.bit_position = position.back();
    record.head_rotation_rate = at.rod.row(DirectorRow::spin)[0];
    record.bit_rotation_rate = at.rod.row(DirectorRow::spin)[last];
    const double time = state.clock.time;
    record.hook_load = string.head.hook_load(at.segments.vector(SegmentRow::pull, 0) +
                                                 at.segments.vector(SegmentRow::viscous_pull, 0) +
                                                 mud_on_head(scene, string.model.surroundings),
                                             at.rod.vector(DirectorRow::director, 0), time);
    record.dead_line_tension = string.head.dead_line_tension(state.head, time);
    record.surface_torque = string.head.surface_torque(
        at.segments.row(SegmentRow::torque)[0] + at.segments.row(SegmentRow::viscous_torque)[0],
        time);
    record.weight_on_bit = string.bit.weight(state.rock, time);
    record.bit_torque =
        string.bit.law() == BitLaw::prescribed
            ? string.bit.torque(string.head.opposed_rate(time, at.rod.row(DirectorRow::spin)[last]),
                                time)
            : state.bit.torque;
    record.depth_of_cut = string.bit.depth_of_cut(state.rock);
    record.drilled = state.rock.depth;
    record.jar_travel = at.jar.slide;
    record.jar_blows = std::llround(at.jar.blows);
    record.drive_torque = scene.head.drive ? state.head.drive_torque : record.surface_torque;
    record.step_size = state.clock.last_step;
    record.time_error = state.time_error.latest;

    EnergyAccount& energy = record.energy;
    for (std::size_t k = 0; k <= last; ++k)
        energy.kinetic += kinetic_energy(scene, at.rod, at.wall, k);
    energy.half_steps =
        state.origin.half_steps - half_kick_energy(string, at, 0.5 * state.clock.last_step);
    const EnergiesAndTensions of = energies_and_tensions(string, at);
    for (const double elastic : of.energy)
        energy.elastic += elastic;
    if (const auto segment = string.jar.segment()) record.jar_force = of.tension[*segment];
    record.head_stress = stress_of(ReportedSegment(string, 0, at), at, 0);
    record.bit_stress = stress_of(ReportedSegment(string, last - 1, at), at, last - 1);
    energy.potential = potential_energy(scene, position);
    energy.work = state.head.work + state.bit.work;
    energy.work += prescribed_energy(string, at.rod, at.wall) - state.origin.head;
    const NodeReport nodes = report_nodes(string, at, position);
    account_for(record, scene, nodes, of.tension, state.accounts, state.origin);
    energy.dissipation += at.jar.work;
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
    std::vector<double> fixed_end;
    for (std::size_t k = 0; k < string.model.segments; ++k) {
        const ReportedSegment segment(string, k, at);
        profile.stress.push_back(stress_of(segment, at, k));
        fixed_end.push_back(fixed_end_moment(segment.beam));
    }
    profile.position = positions(string, at.rod);
    const NodeReport nodes = report_nodes(string, at, profile.position);
    const std::vector<Vector3d> moments = moments_at_nodes(string, at, fixed_end, nodes.contact);
    for (std::size_t k = 0; k <= string.model.segments; ++k) {
        const Eigen::Matrix3d to_body = at.frame[k].transpose();
        Vector6 momentum;
        momentum << to_body * at.rod.vector(DirectorRow::angular_velocity, k),
            to_body * at.rod.vector(DirectorRow::velocity, k);
        momentum[0] = at.rod.row(DirectorRow::spin)[k];
        momentum = momentum.cwiseProduct(inertia_of(scene, k, fluid_mass_at(at.wall, k)));
        profile.director.emplace_back(at.frame[k].col(0));
        profile.moment.emplace_back(to_body * moments[k]);
        profile.momentum.push_back(momentum);
    }
    report_wall(string.scene, profile, at.wall, nodes);
    return profile;
}

BendingRecord bending_record(const DirectorString& string, const DirectorState& state) {
    DirectorSnapshot at{state.rod, Table<SegmentRow>(string.model.segments + 1), {}, {}, {}};
    at.jar = string.jar.follow(state.jar, string.model, state.rod, state.clock.last_step);
    for (const BlockSpan span : string.spans)
        string_segments(string, at.jar, state.rod, at.segments, span, state.clock.last_step);
    at.frame = material_frames(string, at.rod, at.segments.row(SegmentRow::twist),
                               string.head.d1(state.head, state.clock.time));
    BendingRecord record{state.clock.time, {}};
    record.moment.reserve(string.model.segments);
    for (std::size_t k = 0; k < string.model.segments; ++k) {
        const ReportedSegment segment(string, k, at);
        const Eigen::Matrix3d frame = middle_frame(segment, at, k);
        const Vector3d moment = bending_of(segment, at, k);
        record.moment.emplace_back(moment.dot(frame.col(1)), moment.dot(frame.col(2)));
    }
    return record;
}

namespace {

/// `last_step` (s): what half of it changed of the velocities tells the accelerations; where there
/// was none the string is at rest.
SectionMotion motion_of(const DirectorSnapshot& at, const Table<DirectorRow>& before,
                        double last_step, std::size_t node) {
    const double rate = last_step > 0 ? 2 / last_step : 0;
    const auto change = [&](DirectorRow row) {
        return Vector3d(rate * (at.rod.vector(row, node) - before.vector(row, node)));
    };
    const Vector3d t = at.frame[node].col(0);
    const Vector3d turning = at.rod.vector(DirectorRow::angular_velocity, node);
    const double spin = at.rod.row(DirectorRow::spin)[node];
    const double spin_change = rate * (spin - before.row(DirectorRow::spin)[node]);
    // w = Om + s t, dt/dt = Om x t
    return {at.frame[node], change(DirectorRow::velocity), turning + spin * t,
            change(DirectorRow::angular_velocity) + spin_change * t + spin * turning.cross(t)};
}

}  // namespace

std::vector<SensorRecord> sensor_records(const DirectorString& string, const DirectorState& state,
                                         const std::vector<SensorCase>& sensors) {
    const DirectorSnapshot at = snapshot(string, state);
    const auto motion = [&](std::size_t node) {
        return motion_of(at, state.rod, state.clock.last_step, node);
    };
    std::vector<SensorRecord> records;
    for (const SensorCase& sensor : sensors) {
        const SensorPlace place(string.scene.mesh, sensor);
        const ReportedSegment segment(string, place.segment, at);
        records.push_back(sensor_record(
            string.scene, sensor,
            motion_between(motion(place.segment), motion(place.segment + 1), place.share),
            stress_of(segment, at, place.segment)));
        records.back().time = state.clock.time;
    }
    return records;
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
