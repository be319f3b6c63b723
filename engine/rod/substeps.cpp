#include "rod/substeps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "forces/wall_rows.hpp"
#include "numerics/ordered_sum.hpp"
#include "rod/director_rows.hpp"
#include "rod/segment_rates.hpp"

namespace drillstrand {

// ------------------------------------------------------------------ the polynomial

namespace {

/// Damping of the polynomial: keeps kappa phi away from 0 and 1.
constexpr double nu = 0.25;

struct Chebyshev {
    double w, value, slope;  ///< w, T_p(w), T_p'(w)

    explicit Chebyshev(int p)
        : w(1 + nu / (static_cast<double>(p) * p)), value(std::cosh(p * std::acosh(w))) {
        const double angle = std::acosh(w);
        slope = p * std::sinh(p * angle) / std::sinh(angle);
    }
    [[nodiscard]] double beta() const { return 2 * value / slope; }
    [[nodiscard]] double reach() const { return (1 + w) / beta(); }
};

}  // namespace

SubstepPolynomial::SubstepPolynomial(int substeps) : substeps_(substeps) {
    const Chebyshev at(substeps);
    w_ = at.w;
    beta_ = at.beta();
    value_ = at.value;
    double before = 1;
    double here = w_;
    for (int m = 1; m < substeps; ++m) {
        const double next = 2 * w_ * here - before;
        weights_.push_back(2 * w_ * here / next);
        before = here;
        here = next;
    }
}

int SubstepPolynomial::substeps_for(double kappa) {
    if (kappa <= 1) return 1;
    int p = std::max(2, static_cast<int>(std::sqrt(kappa)));
    while (Chebyshev(p).reach() < kappa)
        ++p;
    return p;
}

double SubstepPolynomial::slope() const {
    const double p2 = static_cast<double>(substeps_) * substeps_;
    const double first = 2 * value_ / beta_;
    const double second = (w_ * first - p2 * value_) / (1 - w_ * w_);
    return beta_ * beta_ * second / (4 * value_);
}

int substeps_in(const FineStretch& stretch, double step) {
    const double ratio = step / stretch.free_step;
    return SubstepPolynomial::substeps_for(ratio * ratio);
}

// ------------------------------------------------------------------ constants and work

namespace {

/// Constants of segments and nodes of a stretch.
enum Constant : std::size_t {
    deviating,      // segment, P = 12 k EI/h^3 (N/m)
    stretching,     // segment, (EA/h - P) 4/h^2 (N/m^3)
    bending,        // segment, B = EI/h (N m)
    twisting,       // segment, (GJ/h - B) 4/h^2 (N/m)
    mass,           // node, of its cell (kg)
    inverse_mass,   // node, 0 where its motion is prescribed (1/kg)
    transverse,     // node (kg m2)
    inverse_turn,   // node (1/(kg m2))
    polar,          // node (kg m2)
    inverse_polar,  // node (1/(kg m2))
    cell,           // node (m)
    constants
};

/// What a step writes. Vectors take three lines.
enum Line : std::size_t {
    force = 0,          // node, of rod and wall at the whole step (N)
    couple = 3,         // node (N m)
    down_well = 6,      // node, l
    director = 9,       // node, t
    axis = 12,          // segment, half its chord (m)
    place = 15,         // node, displacement in the substeps (m)
    turn = 18,          // node, rotation in the substeps
    place_change = 21,  // node, in the last substep (m)
    turn_change = 24,   // node
    pull = 27,          // segment, force on its first node, its reaction on the last (N)
    first_couple = 30,  // segment, couple on its first node (N m)
    last_couple = 33,   // segment, on its last
    to_axis = 36,       // node, r
    held = 39,          // node, force of the wall as it holds the node where it is (N)
    lateral = 42,       // node, mass that moves sideways (kg)
    inverse_lateral = 43,
    held_torque = 44,  // node (N m)
    // node, stiffness of the wall where it touches: toward the axis, elsewhere (N/m), and of
    // friction against the spin (N m)
    wall_normal = 45,
    wall_around = 46,
    wall_spin = 47,
    stored_outflow = 48,  // node (J)
    lines = 49
};

/// The work table's lines from the first node of a stretch on.
struct WorkLines {
    explicit WorkLines(BlockTable& table)
        : force(of(table, Line::force)),
          couple(of(table, Line::couple)),
          down_well(of(table, Line::down_well)),
          director(of(table, Line::director)),
          axis(of(table, Line::axis)),
          place(of(table, Line::place)),
          turn(of(table, Line::turn)),
          place_change(of(table, Line::place_change)),
          turn_change(of(table, Line::turn_change)),
          pull(of(table, Line::pull)),
          first_couple(of(table, Line::first_couple)),
          last_couple(of(table, Line::last_couple)),
          to_axis(of(table, Line::to_axis)),
          held(of(table, Line::held)),
          lateral(table.row(Line::lateral)),
          inverse_lateral(table.row(Line::inverse_lateral)),
          held_torque(table.row(Line::held_torque)),
          wall_normal(table.row(Line::wall_normal)),
          wall_around(table.row(Line::wall_around)),
          wall_spin(table.row(Line::wall_spin)) {}

    static Triples of(BlockTable& table, std::size_t line) {
        return {table.row(line), table.row(line + 1), table.row(line + 2)};
    }

    Triples force, couple, down_well, director, axis, place, turn, place_change, turn_change, pull,
        first_couple, last_couple, to_axis, held;
    double *lateral, *inverse_lateral, *held_torque, *wall_normal, *wall_around, *wall_spin;
};

struct ConstantLines {
    explicit ConstantLines(const BlockTable& table)
        : stretching(table.row(Constant::stretching)),
          deviating(table.row(Constant::deviating)),
          bending(table.row(Constant::bending)),
          twisting(table.row(Constant::twisting)),
          mass(table.row(Constant::mass)),
          inverse_mass(table.row(Constant::inverse_mass)),
          transverse(table.row(Constant::transverse)),
          inverse_turn(table.row(Constant::inverse_turn)),
          polar(table.row(Constant::polar)),
          inverse_polar(table.row(Constant::inverse_polar)),
          cell(table.row(Constant::cell)) {}
    const double *stretching, *deviating, *bending, *twisting, *mass, *inverse_mass, *transverse,
        *inverse_turn, *polar, *inverse_polar, *cell;
};

/// How much faster a segment is under its expected load than straight and slack, squared.
double stiffening_by_load(const Scene& scene, std::size_t segment, const ExpectedLoad& load) {
    const double loaded = fastest(segment_rates(scene, segment, load));
    const double slack = fastest(segment_rates(scene, segment, {}));
    return std::max(1.0, loaded * loaded / (slack * slack));
}

BlockTable constants_of(const Scene& scene, const std::vector<ExpectedLoad>& loads,
                        const FineStretch& stretch) {
    const std::size_t nodes = stretch.end - stretch.first + 1;
    BlockTable table(constants, nodes);
    const StringMesh& mesh = scene.mesh;
    for (std::size_t i = 0; i + 1 < nodes; ++i) {
        const std::size_t k = stretch.first + i;
        const SegmentStiffness stiffness(mesh.segment[k], mesh.length[k]);
        const double h = mesh.length[k];
        const double by_load = stiffening_by_load(scene, k, loads[k]);
        const double deviation = stiffness.deviation / h;
        const double bend = stiffness.bending * h;
        const double by_axis = by_load * 4 / (h * h);
        table.row(deviating)[i] = by_load * deviation;
        table.row(stretching)[i] = by_axis * (stiffness.axial / h - deviation);
        table.row(bending)[i] = by_load * bend;
        table.row(twisting)[i] = by_axis * (1 / (stiffness.twisting * h) - bend);
    }
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t k = stretch.first + i;
        const double length = mesh.cell[k];
        const bool held = k == 0 && scene.head.motion == HeadMotion::driven;
        const auto set = [&](Constant row, Constant inverse, double value) {
            table.row(row)[i] = held ? 0.0 : value;
            table.row(inverse)[i] = held ? 0.0 : 1 / value;
        };
        set(mass, inverse_mass, mesh.node[k].mass * length);
        set(transverse, inverse_turn, scene.inertia[k] * length);
        set(polar, inverse_polar, mesh.node[k].polar_inertia * length);
        table.row(cell)[i] = length;
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
    const ConstantLines c(constant_table);
    const WorkLines work(work_table);
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
        const auto hold = [&](std::size_t k) DRILLSTRAND_LAMBDA {
            const WellFrame frame = well_frame(in.x[k], wall.arc(k));
            const double depth = penetration(frame.eccentricity, wall.hole[k], wall.pipe[k]);
            const double touching = (depth > 0.0 ? 1.0 : 0.0) * c.cell[k];
            const double firm = touching * wall.stiffness[k];
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
            work.wall_normal[k] = firm;
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
#pragma omp simd
        for (std::size_t k = 0; k < nodes; ++k)
            hold(k);
#pragma omp simd
        for (std::size_t k = 0; k < nodes; ++k)
            add(k);
    }
}

/// A mass that differs along and across a direction, times a vector.
DRILLSTRAND_INLINE Triple times(double across, double along, const Triple& direction,
                                const Triple& v) {
    return combine(across, v, (along - across) * dot(v, direction), direction);
}

/// u + a x b, in six multiplications that each add.
DRILLSTRAND_INLINE Triple plus_cross(const Triple& u, const Triple& a, const Triple& b) {
    return {u.x + a.y * b.z - a.z * b.y, u.y + a.z * b.x - a.x * b.z, u.z + a.x * b.y - a.y * b.x};
}

/// The straight, slack segment k when its nodes have moved apart and turned (the sum of both): the
/// force on its first node. `axis` is half its chord: a rigid motion of what is stretched leaves no
/// force, either.
DRILLSTRAND_INLINE Triple pull_of(const ConstantLines& c, std::size_t k, const Triple& axis,
                                  const Triple& apart, const Triple& both_turns) {
    const Triple across = plus_cross(apart, axis, both_turns);
    return combine(c.deviating[k], across, c.stretching[k] * dot(apart, axis), axis);
}

/// Its couple on the first node by bending and twist, where the last turns more than the first.
DRILLSTRAND_INLINE Triple bend_of(const ConstantLines& c, std::size_t k, const Triple& axis,
                                  const Triple& turned) {
    return combine(c.bending[k], turned, c.twisting[k] * dot(turned, axis), axis);
}

/// The substeps of a stretch, from rest.
template <bool touches>
DRILLSTRAND_KERNEL void take_substeps(const BlockTable& constant_table, std::size_t blocks,
                                      double step, const SubstepPolynomial& polynomial,
                                      BlockTable& work_table) {
    const ConstantLines c(constant_table);
    const WorkLines work(work_table);
    const std::size_t count = blocks * block_size;  // padding has no mass, it stays where it is
    if (count == 0) return;  // or the compiler would keep scalar loops for it
    const double factor = polynomial.first_factor() * step * step;
    const auto begin = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple moved = scaled(factor, times(work.inverse_lateral[k], c.inverse_mass[k],
                                                  at(work.down_well, k), at(work.force, k)));
        const Triple turned = scaled(factor, times(c.inverse_turn[k], c.inverse_polar[k],
                                                   at(work.director, k), at(work.couple, k)));
        work.place.set(k, moved);
        work.turn.set(k, turned);
        work.place_change.set(k, moved);
        work.turn_change.set(k, turned);
    };
    const auto resist = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple apart = combine(1.0, at(work.place, k + 1), -1.0, at(work.place, k));
        const Triple turned = combine(1.0, at(work.turn, k + 1), -1.0, at(work.turn, k));
        const Triple both = combine(1.0, at(work.turn, k + 1), 1.0, at(work.turn, k));
        const Triple axis = at(work.axis, k);
        const Triple pull = pull_of(c, k, axis, apart, both);
        const Triple lever = cross(axis, pull);
        const Triple bend = bend_of(c, k, axis, turned);
        work.pull.set(k, pull);
        work.first_couple.set(k, combine(1.0, lever, 1.0, bend));
        work.last_couple.set(k, combine(1.0, lever, -1.0, bend));
    };
    // nothing pulls before the first and behind the last segment: their lines are 0
    const Triples before_pull = {work.pull.x - 1, work.pull.y - 1, work.pull.z - 1};
    const Triples before_couple = {work.last_couple.x - 1, work.last_couple.y - 1,
                                   work.last_couple.z - 1};
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        begin(k);
    const auto move = [&](std::size_t k, double kept, double more) DRILLSTRAND_LAMBDA {
        Triple left = combine(1.0, at(work.force, k), 1.0,
                              combine(1.0, at(work.pull, k), -1.0, at(before_pull, k)));
        const Triple couple =
            combine(1.0, at(work.couple, k), 1.0,
                    combine(1.0, at(work.first_couple, k), 1.0, at(before_couple, k)));
        const Triple l = at(work.down_well, k);
        const Triple t = at(work.director, k);
        const double about = dot(couple, t);
        double held = about;
        if constexpr (touches) {
            const Triple y = at(work.place, k);
            const Triple r = at(work.to_axis, k);
            const double around = work.wall_around[k];
            left = combine(1.0, left, -around, y);
            left = combine(1.0, left, -(work.wall_normal[k] - around) * dot(y, r), r);
            held -= work.wall_spin[k] * dot(at(work.turn, k), t);
        }
        // the change: kept times the last one and more times M^-1 left
        const double across = more * work.inverse_lateral[k];
        const double along = (more * c.inverse_mass[k] - across) * dot(left, l);
        const double turning = more * c.inverse_turn[k];
        const double spinning = more * c.inverse_polar[k] * held - turning * about;
        const Triple moved = combine(across, left, along, l);
        const Triple turned = combine(turning, couple, spinning, t);
        const Triple step_on = combine(kept, at(work.place_change, k), 1.0, moved);
        const Triple turn_on = combine(kept, at(work.turn_change, k), 1.0, turned);
        work.place_change.set(k, step_on);
        work.turn_change.set(k, turn_on);
        work.place.set(k, combine(1.0, at(work.place, k), 1.0, step_on));
        work.turn.set(k, combine(1.0, at(work.turn, k), 1.0, turn_on));
    };
    // several substeps go along the stretch one block behind the other, so that its numbers come
    // into the first-level cache once for all of them: a block needs the one behind it before the
    // substep, and of the one before it the last segment's forces, which are kept
    constexpr std::size_t at_once = 4;
    const std::vector<double>& weights = polynomial.weights();
    for (std::size_t done = 0; done < weights.size(); done += at_once) {
        const std::size_t together = std::min(at_once, weights.size() - done);
        for (std::size_t wave = 0; wave + 1 < blocks + together; ++wave) {
            for (std::size_t i = wave < blocks ? 0 : wave + 1 - blocks; i < together && i <= wave;
                 ++i) {
                const std::size_t first = (wave - i) * block_size;
                const double weight = weights[done + i];
#pragma omp simd
                for (std::size_t k = first; k < first + block_size; ++k)
                    resist(k);
#pragma omp simd
                for (std::size_t k = first; k < first + block_size; ++k)
                    move(k, weight - 1.0, weight * factor);
            }
        }
    }
    // what would have brought the nodes there from rest in a step, less what acts: M y 2/T^2 - f
    const double by_step = 2.0 / (step * step);
    const auto compare = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple needed =
            times(work.lateral[k], c.mass[k], at(work.down_well, k), at(work.place, k));
        const Triple turning =
            times(c.transverse[k], c.polar[k], at(work.director, k), at(work.turn, k));
        work.place_change.set(k, combine(by_step, needed, -1.0, at(work.force, k)));
        work.turn_change.set(k, combine(by_step, turning, -1.0, at(work.couple, k)));
    };
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        compare(k);
}

/// The impulses of surroundings and damping on the nodes, as the step took them for nodes that move
/// by themselves, less those of the wall as it held them before.
DRILLSTRAND_KERNEL void gather_impulses(const Table<DirectorRow>& rod,
                                        const Table<DirectorRow>& next,
                                        const BlockTable& constant_table, std::size_t first_node,
                                        std::size_t nodes, double kick, BlockTable& work_table) {
    const auto first = static_cast<std::ptrdiff_t>(first_node);
    const NodesIn in(rod, first);
    const NodesIn out(next, first);
    const ConstantLines c(constant_table);
    const WorkLines work(work_table);
    const auto gather = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple given = times(work.lateral[k], c.mass[k], at(work.down_well, k),
                                   combine(1.0, out.v[k], -1.0, in.v[k]));
        const Triple of_rod = combine(kick, at(work.force, k), kick, at(work.place_change, k));
        const Triple t = at(work.director, k);
        const double torque = dot(at(work.couple, k), t) + dot(at(work.turn_change, k), t);
        work.force.set(k, combine(1.0, given, -1.0, of_rod));
        work.couple.set(k, scaled(c.polar[k] * (out.s[k] - in.s[k]) - kick * torque, t));
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
    const ConstantLines c(constant_table);
    const WorkLines work(work_table);
    const auto share = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple t = at(work.director, k);
        const Triple faster = times(work.inverse_lateral[k], c.inverse_mass[k],
                                    at(work.down_well, k), at(work.place_change, k));
        const Triple turned =
            times(c.inverse_turn[k], c.inverse_polar[k], t, at(work.turn_change, k));
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
        const double spinning = dot(at(work.couple, k), t) + kick * work.held_torque[k];
        outflow[k] = -0.5 * (dot(given, faster) + spinning * spun);
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
    const WorkLines work(work_table);
    const auto add = [&](SegmentRow pull, SegmentRow lean, SegmentRow torque, double sign,
                         std::size_t segment, std::size_t k) {
        const auto entry = static_cast<std::ptrdiff_t>(segment);
        const auto to = [&](SegmentRow row, double factor, const Triple& change) {
            const Triples rows = segments.triples(row, entry);
            rows.set(0, combine(1.0, at(rows, 0), factor, change));
        };
        const Triple t = at(work.director, k);
        const Triple couple = at(work.turn_change, k);
        to(pull, sign, at(work.place_change, k));
        to(lean, 1.0, cross(couple, t));
        segments.row(torque)[entry] += sign * dot(couple, t);
    };
    for (std::size_t k = 1; k < nodes; ++k)
        add(SegmentRow::last_pull, SegmentRow::last_lean, SegmentRow::last_torque, -1.0,
            first_node + k - 1, k);
    if (ConstantLines(constant_table).mass[0] > 0.0)
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

Substeps::Substeps(const Scene& scene) : plan_(step_plan(scene)) {
    if (plan_.stretches.empty()) return;
    const std::vector<ExpectedLoad> loads = expected_loads(scene);
    for (const FineStretch& stretch : plan_.stretches)
        constants_.push_back(constants_of(scene, loads, stretch));
}

int Substeps::substeps(std::size_t i, double step) const {
    return substeps_in(plan_.stretches[i], plan_.undamped(step));
}

Substeps::Work Substeps::work_for(std::size_t i) const {
    return {BlockTable(lines, nodes(i)), 0, SubstepPolynomial(1)};
}

void Substeps::average(const DirectorModel& model, const Table<DirectorRow>& rod,
                       Table<WallRow>& wall, std::size_t i, double step, Work& work,
                       Table<SegmentRow>& segments) const {
    if (work.step != step) {
        work.step = step;
        work.polynomial = SubstepPolynomial(substeps(i, step));
    }
    if (work.polynomial.substeps() == 1) return;
    gather_kernel(model)(model, rod, segments, wall, constants_[i], first_node(i), nodes(i),
                         work.lines);
    take(model, i, work);
    hand_over(constants_[i], work.lines, first_node(i), nodes(i), segments);
}

double Substeps::share(const DirectorModel& model, const Table<DirectorRow>& rod,
                       Table<DirectorRow>& next, std::size_t i, double kick, double drift,
                       Work& work) const {
    if (work.polynomial.substeps() == 1) return 0;
    const BlockTable& its = constants_[i];
    at_level<gather_impulses>(model.level)(rod, next, its, first_node(i), nodes(i), kick,
                                           work.lines);
    take(model, i, work);
    const auto kernel = model.features.curved ? at_level<share_impulses<true>>(model.level)
                                              : at_level<share_impulses<false>>(model.level);
    return kernel(rod, next, its, first_node(i), nodes(i), kick, drift, work.lines,
                  work.lines.row(Line::stored_outflow));
}

void Substeps::take(const DirectorModel& model, std::size_t i, Work& work) const {
    const double* wall = work.lines.row(Line::wall_normal);
    const bool touches = std::any_of(wall, wall + nodes(i), [](double w) { return w > 0; });
    const auto kernel = touches ? at_level<take_substeps<true>>(model.level)
                                : at_level<take_substeps<false>>(model.level);
    kernel(constants_[i], blocks_for(nodes(i)), plan_.undamped(work.step), work.polynomial,
           work.lines);
}

double Substeps::added_energy(const Table<DirectorRow>& rod, double step) const {
    double sum = 0;
    for (std::size_t i = 0; i < count(); ++i) {
        const int taken = substeps(i, step);
        if (taken == 1) continue;
        const double period = plan_.undamped(step);
        const double factor = 0.25 * period * period * SubstepPolynomial(taken).slope();
        const ConstantLines c(constants_[i]);
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
            const Triple turned = combine(1.0, turning(k + 1), -1.0, turning(k));
            const Triple both = combine(1.0, turning(k + 1), 1.0, turning(k));
            const std::size_t segment = k - first_node(i);
            const Triple axis = triple(Eigen::Vector3d(0.5 * chord));
            const Triple pull = pull_of(c, segment, axis, apart, both);
            sum += factor * (dot(pull, apart) + dot(bend_of(c, segment, axis, turned), turned) -
                             dot(cross(axis, pull), both));
        }
    }
    return 0.5 * sum;
}

}  // namespace drillstrand
