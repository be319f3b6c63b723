#include "rod/substeps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "forces/wall_rows.hpp"
#include "numerics/ordered_sum.hpp"
#include "rod/director_rows.hpp"
#include "rod/segment_rates.hpp"
#include "rod/substep_rows.hpp"

namespace drillstrand {

int substeps_in(const FineStretch& stretch, double step) {
    const double ratio = step / stretch.free_step;
    return SubstepPolynomial::substeps_for(ratio * ratio);
}

// ------------------------------------------------------------------ constants

namespace {

/// How much faster a segment is under its expected load than straight and slack, squared.
double stiffening_by_load(const Scene& scene, std::size_t segment, const ExpectedLoad& load) {
    const double loaded = fastest(segment_rates(scene, segment, load));
    const double slack = fastest(segment_rates(scene, segment, {}));
    return std::max(1.0, loaded * loaded / (slack * slack));
}

BlockTable constants_of(const Scene& scene, const std::vector<ExpectedLoad>& loads,
                        const FineStretch& stretch) {
    const std::size_t nodes = stretch.end - stretch.first + 1;
    BlockTable table(SubstepConstant::rows, nodes);
    const StringMesh& mesh = scene.mesh;
    for (std::size_t i = 0; i + 1 < nodes; ++i) {
        const std::size_t k = stretch.first + i;
        const SegmentStiffness stiffness(mesh.segment[k], mesh.length[k]);
        const double h = mesh.length[k];
        const double by_load = stiffening_by_load(scene, k, loads[k]);
        const double deviation = stiffness.deviation / h;
        const double bend = stiffness.bending * h;
        const double by_axis = by_load * 4 / (h * h);
        table.row(SubstepConstant::deviating)[i] = by_load * deviation;
        table.row(SubstepConstant::stretching)[i] = by_axis * (stiffness.axial / h - deviation);
        table.row(SubstepConstant::bending)[i] = by_load * bend;
        table.row(SubstepConstant::twisting)[i] = by_axis * (1 / (stiffness.twisting * h) - bend);
    }
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t k = stretch.first + i;
        const double length = mesh.cell[k];
        const bool held = k == 0 && scene.head.motion != HeadMotion::free;
        const auto set = [&](std::size_t row, std::size_t inverse, double value) {
            table.row(row)[i] = held ? 0.0 : value;
            table.row(inverse)[i] = held ? 0.0 : 1 / value;
        };
        set(SubstepConstant::mass, SubstepConstant::inverse_mass, mesh.node[k].mass * length);
        set(SubstepConstant::transverse, SubstepConstant::inverse_turn, scene.inertia[k] * length);
        set(SubstepConstant::polar, SubstepConstant::inverse_polar,
            mesh.node[k].polar_inertia * length);
        table.row(SubstepConstant::cell)[i] = length;
    }
    return table;
}

// ------------------------------------------------------------------ kernels

/// Forces of the segments, the weight and the wall, as it holds the node where it is, at the whole
/// step, and the directions in which the masses of a node differ.
template <bool in_well, bool viscous, bool curved>
DRILLSTRAND_KERNEL void gather_forces(const DirectorModel& model, const Table<DirectorRow>& rod,
                                      const Table<SegmentRow>& segments, Table<WallRow>& wall_table,
                                      const BlockTable& constant_table, std::size_t first_node,
                                      std::size_t nodes, BlockTable& work_table) {
    const auto first = static_cast<std::ptrdiff_t>(first_node);
    const NodesIn in(rod, first);
    const SegmentsIn after(segments, first);
    const SegmentsIn before(segments, first - 1);
    const SubstepConstants c(constant_table);
    const SubstepLines work(work_table);
    const double* weight = model.constants.row(DirectorConstants::weight) + first;
    const Triple down = triple(model.down);

    const auto pull = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple t = in.t[k];
        RodLoad load = rod_load<curved>(after, before, t, 1.0, k);
        if constexpr (viscous) {
            const RodLoad more = viscous_load(after, before, 1.0, k);
            load.force = combine(1.0, load.force, 1.0, more.force);
            load.couple = combine(1.0, load.couple, 1.0, without(more.couple, t));
            load.torque += more.torque;
        }
        work.force.set(k, combine(1.0, load.force, c.cell[k] * weight[k], down));
        work.couple.set(k, combine(1.0, load.couple, load.torque, t));
        work.down_well.set(k, t);
        work.director.set(k, t);
        work.lateral[k] = c.mass[k];
        work.inverse_lateral[k] = c.inverse_mass[k];
    };
    const auto direct = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        work.axis.set(k, combine(0.5, in.x[k + 1], -0.5, in.x[k]));
    };
#pragma omp simd
    for (std::size_t k = 0; k < nodes; ++k)
        pull(k);
#pragma omp simd
    for (std::size_t k = 0; k < nodes - 1; ++k)
        direct(k);
    if constexpr (in_well) {
        const WallRows wall(model.surroundings, wall_table, first);
        const VaryingWall sections(wall_table, first);
        const FrictionParameters friction = model.surroundings.parameters().friction;
        const NormalLaw normal_law = model.surroundings.parameters().normal_law;
        const auto hold = [&](std::size_t k, NormalLaw law) DRILLSTRAND_LAMBDA {
            const WellFrame frame = well_frame(in.x[k], wall.arc(k));
            const double depth = penetration(frame.eccentricity, wall.hole[k], wall.pipe[k]);
            const double touching = (depth > 0.0 ? 1.0 : 0.0) * c.cell[k];
            const double firm = touching * secant_stiffness(law, wall.stiffness[k], depth);
            const double rubs = touching * friction.stiffness;
            // friction as its spring holds, on the cone of the normal force
            const double normal = firm * depth;
            FrictionParameters its = sections.friction(k, friction);
            its.stiffness = rubs;
            const Tangential rub = friction_force(wall.spring(k), normal, its);
            const Triple rubbing = combine(rub.axial, frame.l, rub.azimuthal, frame.t);
            work.held.set(k, combine(normal, frame.r, 1.0, rubbing));
            work.held_torque[k] = wall.pipe[k] * rub.azimuthal;
            // a node that touches goes around the axis against N/e; friction holds its surface,
            // whose motion is both the node's and that of its spin: (u + R s)^2 <= 2 u^2 + 2 R^2
            // s^2
            const double apart = frame.eccentricity > depth ? frame.eccentricity : depth;
            work.wall_normal[k] = touching * tangent_stiffness(law, wall.stiffness[k], depth);
            work.wall_around[k] = firm * depth / (apart > 0.0 ? apart : 1.0) + 2.0 * rubs;
            work.wall_spin[k] = 2.0 * rubs * wall.pipe[k] * wall.pipe[k];
            work.to_axis.set(k, frame.r);
            work.down_well.set(k, frame.l);
        };
        const auto add = [&](std::size_t k) DRILLSTRAND_LAMBDA {
            const bool mobile = c.mass[k] > 0.0;
            const double sideways = c.mass[k] + c.cell[k] * wall.fluid_mass[k];
            work.lateral[k] = mobile ? sideways : 0.0;
            work.inverse_lateral[k] = mobile ? 1.0 / (mobile ? sideways : 1.0) : 0.0;
            work.force.set(k, combine(1.0, at(work.force, k), 1.0, at(work.held, k)));
            work.couple.set(k, combine(1.0, at(work.couple, k), work.held_torque[k], in.t[k]));
        };
        if (normal_law == NormalLaw::hertz) {
#pragma omp simd
            for (std::size_t k = 0; k < nodes; ++k)
                hold(k, NormalLaw::hertz);
        } else {
#pragma omp simd
            for (std::size_t k = 0; k < nodes; ++k)
                hold(k, NormalLaw::linear);
        }
#pragma omp simd
        for (std::size_t k = 0; k < nodes; ++k)
            add(k);
    }
}

/// The slack segment k of a stretch.
DRILLSTRAND_INLINE SlackSegment<double> segment_at(const SubstepConstants& c, std::size_t k) {
    return {c.deviating[k], c.stretching[k], c.bending[k], c.twisting[k]};
}

/// What the substeps make of the forces, less these: the answer of segments and wall to where the
/// nodes were by the shares of the polynomial. In double precision, so that the forces of a segment
/// balance each other to rounding, whatever the rounds were reckoned in.
template <bool touches>
DRILLSTRAND_KERNEL void answer_to_places(const BlockTable& constant_table, std::size_t blocks,
                                         BlockTable& work_table) {
    const SubstepConstants c(constant_table);
    const SubstepLines work(work_table);
    const std::size_t count = blocks * block_size;
    if (count == 0) return;  // or the compiler would keep scalar loops for it
    const auto resist = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const SlackSegment<double> segment = segment_at(c, k);
        const Triple apart = combine(1, at(work.place, k + 1), -1, at(work.place, k));
        const Triple turned = combine(1, at(work.turn, k + 1), -1, at(work.turn, k));
        const Triple both = combine(1, at(work.turn, k + 1), 1, at(work.turn, k));
        const Triple axis = at(work.axis, k);
        const Triple pull = pull_of(segment, axis, apart, both);
        const Triple bend = bend_of(segment, axis, turned);
        const Triple lever = cross(axis, pull);
        work.pull.set(k, pull);
        work.first_couple.set(k, combine(1, lever, 1, bend));
        work.last_couple.set(k, combine(1, lever, -1, bend));
    };
    // nothing pulls before the first and behind the last segment: their lines are 0
    const Triples pull_before = {work.pull.x - 1, work.pull.y - 1, work.pull.z - 1};
    const Triples couple_before = {work.last_couple.x - 1, work.last_couple.y - 1,
                                   work.last_couple.z - 1};
    const auto sum = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        Triple force = combine(1, at(work.pull, k), -1, at(pull_before, k));
        Triple couple = combine(1, at(work.first_couple, k), 1, at(couple_before, k));
        if constexpr (touches) {
            const Triple t = at(work.director, k);
            const HoldingNode<double> wall = {at(work.to_axis, k), t, work.wall_normal[k],
                                              work.wall_around[k], work.wall_spin[k]};
            force = combine(1, force, 1, wall.force(at(work.place, k)));
            couple = combine(1, couple, wall.torque(at(work.turn, k)), t);
        }
        work.force_change.set(k, force);
        work.couple_change.set(k, couple);
    };
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        resist(k);
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        sum(k);
}

/// The impulses of surroundings and damping on the nodes, as the step took them for nodes that move
/// by themselves, less those of the wall as it held them before. Where Kelvin-Voigt damping sees
/// how light nodes turn, those of gyroscopic couples, too.
template <bool viscous>
DRILLSTRAND_KERNEL void gather_impulses(const Table<DirectorRow>& rod,
                                        const Table<DirectorRow>& next,
                                        const BlockTable& constant_table, std::size_t first_node,
                                        std::size_t nodes, double kick, BlockTable& work_table) {
    const auto first = static_cast<std::ptrdiff_t>(first_node);
    const NodesIn in(rod, first);
    const NodesIn out(next, first);
    const SubstepConstants c(constant_table);
    const SubstepLines work(work_table);
    const auto gather = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple given = times(work.lateral[k], c.mass[k], at(work.down_well, k),
                                   combine(1.0, out.v[k], -1.0, in.v[k]));
        const Triple of_rod = combine(kick, at(work.force, k), kick, at(work.force_change, k));
        const Triple t = at(work.director, k);
        const Triple by_rod = combine(kick, at(work.couple, k), kick, at(work.couple_change, k));
        const double torque = c.polar[k] * (out.s[k] - in.s[k]) - dot(by_rod, t);
        work.force.set(k, combine(1.0, given, -1.0, of_rod));
        if constexpr (viscous) {
            const Triple turned = combine(c.transverse[k], out.w[k], -c.transverse[k], in.w[k]);
            work.couple.set(
                k, combine(1.0, without(combine(1.0, turned, -1.0, by_rod), t), torque, t));
        } else {
            work.couple.set(k, scaled(torque, t));
        }
    };
#pragma omp simd
    for (std::size_t k = 0; k < nodes; ++k)
        gather(k);
}

/// Lets the stretch as a whole take the impulses that the step has given to single nodes. Returns
/// what their work is less than that which was accounted for (J).
template <bool curved>
DRILLSTRAND_KERNEL double share_impulses(const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                                         const BlockTable& constant_table, std::size_t first_node,
                                         std::size_t nodes, double kick, double drift,
                                         BlockTable& work_table, double* outflow) {
    const auto first = static_cast<std::ptrdiff_t>(first_node);
    const NodesIn in(rod, first);
    const NodesIn unshared(std::as_const(next), first);
    const NodesOut out(next, first);
    const SubstepConstants c(constant_table);
    const SubstepLines work(work_table);
    const auto share = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple t = at(work.director, k);
        const Triple faster = times(work.inverse_lateral[k], c.inverse_mass[k],
                                    at(work.down_well, k), at(work.force_change, k));
        const Triple turned =
            times(c.inverse_turn[k], c.inverse_polar[k], t, at(work.couple_change, k));
        const double spun = dot(turned, t);
        const Triple w = combine(1.0, unshared.w[k], 1.0, combine(1.0, turned, -spun, t));
        const double s = unshared.s[k] + spun;
        out.v.set(k, combine(1.0, unshared.v[k], 1.0, faster));
        out.x.set(k, combine(1.0, unshared.x[k], drift, faster));
        out.s[k] = s;
        out.w.set(k, w);
        out.t.set(k, turned_director(t, w, drift));
        if constexpr (curved) out.d1.set(k, turned_material(in.d1[k], t, at(out.t, k), drift * s));
        const Triple given = combine(1.0, at(work.force, k), kick, at(work.held, k));
        const Triple couple = combine(1.0, at(work.couple, k), kick * work.held_torque[k], t);
        outflow[k] = -0.5 * (dot(given, faster) + dot(couple, turned));
    };
#pragma omp simd
    for (std::size_t k = 0; k < nodes; ++k)
        share(k);
    constexpr std::size_t strands = 8;
    return ordered_sum(outflow, (nodes + strands - 1) / strands * strands);
}

/// Hands the changes of the nodes' forces over to the segments before them, that of the first node
/// to the one behind it, but for a node whose motion is prescribed.
void hand_over(const BlockTable& constant_table, BlockTable& work_table, std::size_t first_node,
               std::size_t nodes, Table<SegmentRow>& segments) {
    const SubstepLines work(work_table);
    const auto add = [&](SegmentRow pull, SegmentRow lean, SegmentRow torque, double sign,
                         std::size_t segment, std::size_t k) {
        const auto entry = static_cast<std::ptrdiff_t>(segment);
        const auto to = [&](SegmentRow row, double factor, const Triple& change) {
            const Triples rows = segments.triples(row, entry);
            rows.set(0, combine(1.0, at(rows, 0), factor, change));
        };
        const Triple t = at(work.director, k);
        const Triple couple = at(work.couple_change, k);
        to(pull, sign, at(work.force_change, k));
        to(lean, 1.0, cross(couple, t));
        segments.row(torque)[entry] += sign * dot(couple, t);
    };
    for (std::size_t k = 1; k < nodes; ++k)
        add(SegmentRow::last_pull, SegmentRow::last_lean, SegmentRow::last_torque, -1.0,
            first_node + k - 1, k);
    if (SubstepConstants(constant_table).mass[0] > 0.0)
        add(SegmentRow::pull, SegmentRow::first_lean, SegmentRow::torque, 1.0, first_node, 0);
}

using Gather = void (*)(const DirectorModel&, const Table<DirectorRow>&, const Table<SegmentRow>&,
                        Table<WallRow>&, const BlockTable&, std::size_t, std::size_t, BlockTable&);

template <bool in_well, bool viscous>
Gather gather_kernel(const DirectorModel& model) {
    return model.features.curved ? at_level<gather_forces<in_well, viscous, true>>(model.level)
                                 : at_level<gather_forces<in_well, viscous, false>>(model.level);
}
Gather gather_kernel(const DirectorModel& model) {
    const bool viscous = model.features.damping == Damping::kelvin_voigt;
    if (model.features.well)
        return viscous ? gather_kernel<true, true>(model) : gather_kernel<true, false>(model);
    return viscous ? gather_kernel<false, true>(model) : gather_kernel<false, false>(model);
}

}  // namespace

template <class Real>
SubstepsOf<Real>::SubstepsOf(const Scene& scene) : plan_(step_plan(scene)) {
    if (plan_.stretches.empty()) return;
    const std::vector<ExpectedLoad> loads = expected_loads(scene);
    for (const FineStretch& stretch : plan_.stretches)
        constants_.push_back(constants_of(scene, loads, stretch));
}

template <class Real>
int SubstepsOf<Real>::substeps(std::size_t i, double step) const {
    return substeps_in(plan_.stretches[i], plan_.undamped(step));
}

template <class Real>
typename SubstepsOf<Real>::Work SubstepsOf<Real>::work_for(std::size_t i) const {
    return {BlockTable(SubstepLine::rows, nodes(i)), SubstepRounds<Real>(constants_[i]), 0,
            SubstepPolynomial(1)};
}

template <class Real>
void SubstepsOf<Real>::average(const DirectorModel& model, const Table<DirectorRow>& rod,
                               Table<WallRow>& wall, std::size_t i, double step, Work& work,
                               Table<SegmentRow>& segments) const {
    if (work.step != step) {
        work.step = step;
        work.polynomial = SubstepPolynomial(substeps(i, step));
    }
    if (work.polynomial.substeps() == 1) return;
    gather_kernel(model)(model, rod, segments, wall, constants_[i], first_node(i), nodes(i),
                         work.lines);
    work.rounds.begin_step(work.lines);
    take(model, i, work);
    hand_over(constants_[i], work.lines, first_node(i), nodes(i), segments);
}

template <class Real>
double SubstepsOf<Real>::share(const DirectorModel& model, const Table<DirectorRow>& rod,
                               Table<DirectorRow>& next, std::size_t i, double kick, double drift,
                               Work& work) const {
    if (work.polynomial.substeps() == 1) return 0;
    const BlockTable& its = constants_[i];
    const auto gather = model.features.damping == Damping::kelvin_voigt
                            ? at_level<gather_impulses<true>>(model.level)
                            : at_level<gather_impulses<false>>(model.level);
    gather(rod, next, its, first_node(i), nodes(i), kick, work.lines);
    take(model, i, work);
    const auto kernel = model.features.curved ? at_level<share_impulses<true>>(model.level)
                                              : at_level<share_impulses<false>>(model.level);
    return kernel(rod, next, its, first_node(i), nodes(i), kick, drift, work.lines,
                  work.lines.row(SubstepLine::stored_outflow));
}

template <class Real>
void SubstepsOf<Real>::take(const DirectorModel& model, std::size_t i, Work& work) const {
    const double* wall = work.lines.row(SubstepLine::wall_normal);
    const bool touches = std::any_of(wall, wall + nodes(i), [](double w) { return w > 0; });
    work.rounds.take(model.level, work.polynomial, plan_.undamped(work.step), touches, work.lines);
    const auto kernel = touches ? at_level<answer_to_places<true>>(model.level)
                                : at_level<answer_to_places<false>>(model.level);
    kernel(constants_[i], blocks_for(nodes(i)), work.lines);
}

template <class Real>
double SubstepsOf<Real>::added_energy(const Table<DirectorRow>& rod, double step) const {
    double sum = 0;
    for (std::size_t i = 0; i < count(); ++i) {
        const int taken = substeps(i, step);
        if (taken == 1) continue;
        const double period = plan_.undamped(step);
        const double factor = 0.25 * period * period * SubstepPolynomial(taken).slope();
        const SubstepConstants c(constants_[i]);
        const auto turning = [&](std::size_t node) {
            const Eigen::Vector3d w =
                rod.vector(DirectorRow::angular_velocity, node) +
                rod.row(DirectorRow::spin)[node] * rod.vector(DirectorRow::director, node);
            return triple(w);
        };
        for (std::size_t k = first_node(i); k < last_node(i); ++k) {
            const Eigen::Vector3d chord =
                rod.vector(DirectorRow::position, k + 1) - rod.vector(DirectorRow::position, k);
            const Triple apart = triple(Eigen::Vector3d(rod.vector(DirectorRow::velocity, k + 1) -
                                                        rod.vector(DirectorRow::velocity, k)));
            const Triple axis = triple(Eigen::Vector3d(0.5 * chord));
            const Triple turned = combine(1, turning(k + 1), -1, turning(k));
            const Triple both = combine(1, turning(k + 1), 1, turning(k));
            const SlackSegment<double> segment = segment_at(c, k - first_node(i));
            const Triple pull = pull_of(segment, axis, apart, both);
            sum += factor * (dot(pull, apart) + dot(bend_of(segment, axis, turned), turned) -
                             dot(cross(axis, pull), both));
        }
    }
    return 0.5 * sum;
}

template class SubstepsOf<float>;
template class SubstepsOf<double>;

}  // namespace drillstrand
