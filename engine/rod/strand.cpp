#include "rod/strand.hpp"

#include <cmath>
#include <utility>

#include "forces/contact.hpp"
#include "forces/fluid.hpp"
#include "forces/wall_rows.hpp"
#include "numerics/ordered_sum.hpp"

namespace drillstrand {

StrandConstants::StrandConstants(const Scene& scene)
    : table_(rows, static_cast<std::size_t>(scene.segments) + 1) {
    // Padding has no stiffness, no length and no weight: it stays at rest, unstressed, and divides
    // nothing by zero.
    for (const Row unit :
         {torsion_compliance, bending_compliance, axial_compliance, shear_compliance, inverse_cell,
          mass, inverse_mass, inverse_polar, inverse_transverse}) {
        table_.fill(unit, 1.0);
    }
    const StringMesh& mesh = scene.mesh;
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const SectionProperties& s = mesh.segment[k];
        const auto set = [&](Row row, double value) { table_.row(row)[k] = value; };
        set(half_length, mesh.length[k] / 2);
        set(length, mesh.length[k]);
        set(inverse_length, 1 / mesh.length[k]);
        set(torsion, s.torsional_stiffness);
        set(bending, s.bending_stiffness);
        set(axial, s.axial_stiffness);
        set(shear, s.shear_stiffness);
        set(torsion_compliance, 1 / s.torsional_stiffness);
        set(bending_compliance, 1 / s.bending_stiffness);
        set(axial_compliance, 1 / s.axial_stiffness);
        set(shear_compliance, 1 / s.shear_stiffness);
        set(twist0, s.curvature[0]);
        set(bend10, s.curvature[1]);
        set(bend20, s.curvature[2]);
    }
    for (std::size_t k = 0; k < mesh.cell.size(); ++k) {
        const SectionProperties& s = mesh.node[k];
        const auto set = [&](Row row, double value) { table_.row(row)[k] = value; };
        set(inverse_cell, 1 / mesh.cell[k]);
        set(mobile_cell, mesh.cell[k]);
        set(mass, s.mass);
        set(inverse_mass, 1 / s.mass);
        set(inverse_polar, 1 / s.polar_inertia);
        set(inverse_transverse, 1 / scene.inertia[k]);
        set(weight, scene.weight[k]);
    }
    if (scene.head.motion != HeadMotion::free) table_.row(mobile_cell)[0] = 0.0;
}

StrandModel::StrandModel(const Scene& scene, Level its_level)
    : constants(scene),
      surroundings(scene, its_level),
      level(its_level),
      features(scene.features),
      internal_damping(scene.damping.internal),
      external_damping(scene.damping.external),
      kelvin_voigt(scene.damping.kelvin_voigt),
      down(scene.down),
      segments(static_cast<std::size_t>(scene.segments)) {}

namespace {

using Constants = StrandConstants;
using Work = StrandWorkRow;

// ------------------------------------------------------------------ named rows, from an entry on

/// Momenta and stresses, or their rates: to read.
struct StrandIn {
    StrandIn(const Table<StrandRow>& rod, std::ptrdiff_t first)
        : pi(rod.triples(StrandRow::angular_momentum, first)),
          p(rod.triples(StrandRow::linear_momentum, first)),
          m(rod.triples(StrandRow::moment, first)),
          n(rod.triples(StrandRow::force, first)) {}
    ConstTriples pi, p, m, n;
};

/// The same, to write.
struct StrandOut {
    StrandOut(Table<StrandRow>& rod, std::ptrdiff_t first)
        : pi(rod.triples(StrandRow::angular_momentum, first)),
          p(rod.triples(StrandRow::linear_momentum, first)),
          m(rod.triples(StrandRow::moment, first)),
          n(rod.triples(StrandRow::force, first)) {}
    Triples pi, p, m, n;
};

/// A moment and a force of a segment on one of its nodes.
template <class Vectors>
struct WrenchRows {
    template <class Workspace>
    WrenchRows(Workspace& work, StrandWorkRow row, std::ptrdiff_t first)
        : moment(work.triples(row, first)), force(work.triples(row, first, 3)) {}
    Vectors moment, force;
};

struct SegmentConstants {
    SegmentConstants(const Constants& c, std::ptrdiff_t first)
        : length(c.row(Constants::length) + first),
          half_length(c.row(Constants::half_length) + first),
          inverse_length(c.row(Constants::inverse_length) + first),
          torsion(c.row(Constants::torsion) + first),
          bending(c.row(Constants::bending) + first),
          axial(c.row(Constants::axial) + first),
          shear(c.row(Constants::shear) + first),
          torsion_compliance(c.row(Constants::torsion_compliance) + first),
          bending_compliance(c.row(Constants::bending_compliance) + first),
          axial_compliance(c.row(Constants::axial_compliance) + first),
          shear_compliance(c.row(Constants::shear_compliance) + first),
          twist0(c.row(Constants::twist0) + first),
          bend10(c.row(Constants::bend10) + first),
          bend20(c.row(Constants::bend20) + first) {}
    const double *length, *half_length, *inverse_length, *torsion, *bending, *axial, *shear,
        *torsion_compliance, *bending_compliance, *axial_compliance, *shear_compliance, *twist0,
        *bend10, *bend20;
};

struct NodeConstants {
    NodeConstants(const Constants& c, std::ptrdiff_t first)
        : inverse_cell(c.row(Constants::inverse_cell) + first),
          mobile_cell(c.row(Constants::mobile_cell) + first),
          mass(c.row(Constants::mass) + first),
          inverse_mass(c.row(Constants::inverse_mass) + first),
          inverse_polar(c.row(Constants::inverse_polar) + first),
          inverse_transverse(c.row(Constants::inverse_transverse) + first),
          weight(c.row(Constants::weight) + first) {}
    const double *inverse_cell, *mobile_cell, *mass, *inverse_mass, *inverse_polar,
        *inverse_transverse, *weight;
};

/// Linear velocity of a node in body axes, M^-1 p: sideways (d1, d2) the fluid goes along.
template <bool heavy>
DRILLSTRAND_INLINE Triple linear_velocity(const Triple& p, double mass, double inverse_mass,
                                          const double* fluid_mass, std::size_t k) {
    if constexpr (heavy) {
        const double across = 1.0 / (mass + fluid_mass[k]);
        return {inverse_mass * p.x, across * p.y, across * p.z};
    } else {
        return scaled(inverse_mass, p);
    }
}

/// Segments of one block: everything that vectorises.
/// Returns the power of Kelvin-Voigt damping on the rod.
template <bool heavy>
DRILLSTRAND_KERNEL double segments_of_block(const StrandModel& model, const Table<StrandRow>& state,
                                            Table<StrandRow>& rate, Table<Work>& work,
                                            const Table<WallRow>& wall, std::size_t block,
                                            double (*step)[block_size]) {
    const double kelvin_voigt = model.kelvin_voigt;
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(block * block_size);
    const StrandIn in(state, first);
    const StrandIn next(state, first + 1);
    const StrandOut out(rate, first);
    const WrenchRows<Triples> on_first(work, Work::wrench_on_first, first);
    const WrenchRows<Triples> on_last(work, Work::wrench_on_last, first);
    const SegmentConstants c(model.constants, first);
    const NodeConstants node(model.constants, first);
    const double* fluid_mass = heavy ? wall.row(WallRow::fluid_mass) + first : nullptr;

    const auto segment = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        // strains U = A^-1 S + Ubar
        const Triple m = in.m[k];
        const Triple n = in.n[k];
        const Triple kappa = {c.torsion_compliance[k] * m.x + c.twist0[k],
                              c.bending_compliance[k] * m.y + c.bend10[k],
                              c.bending_compliance[k] * m.z + c.bend20[k]};
        const Triple gamma = {c.axial_compliance[k] * n.x + 1.0, c.shear_compliance[k] * n.y,
                              c.shear_compliance[k] * n.z};

        // velocities V = M^-1 P of the two end nodes
        const Triple pi_a = in.pi[k];
        const Triple pi_b = next.pi[k];
        const Triple p_a = in.p[k];
        const Triple p_b = next.p[k];
        const double ip_a = node.inverse_polar[k];
        const double ip_b = node.inverse_polar[k + 1];
        const double it_a = node.inverse_transverse[k];
        const double it_b = node.inverse_transverse[k + 1];
        const Triple w_a = {ip_a * pi_a.x, it_a * pi_a.y, it_a * pi_a.z};
        const Triple w_b = {ip_b * pi_b.x, it_b * pi_b.y, it_b * pi_b.z};
        const Triple v_a =
            linear_velocity<heavy>(p_a, node.mass[k], node.inverse_mass[k], fluid_mass, k);
        const Triple v_b = linear_velocity<heavy>(p_b, node.mass[k + 1], node.inverse_mass[k + 1],
                                                  fluid_mass, k + 1);
        const Triple w = combine(0.5, w_a, 0.5, w_b);
        const Triple v = combine(0.5, v_a, 0.5, v_b);

        // compatibility (paper eq. 4): k' = w' + k x w, g' = v' + k x v + g x w
        const double ih = c.inverse_length[k];
        const Triple k_x_w = cross(kappa, w);
        const Triple k_x_v = cross(kappa, v);
        const Triple g_x_w = cross(gamma, w);
        const Triple m_dot = {c.torsion[k] * (ih * (w_b.x - w_a.x) + k_x_w.x),
                              c.bending[k] * (ih * (w_b.y - w_a.y) + k_x_w.y),
                              c.bending[k] * (ih * (w_b.z - w_a.z) + k_x_w.z)};
        const Triple n_dot = {c.axial[k] * (ih * (v_b.x - v_a.x) + k_x_v.x + g_x_w.x),
                              c.shear[k] * (ih * (v_b.y - v_a.y) + k_x_v.y + g_x_w.y),
                              c.shear[k] * (ih * (v_b.z - v_a.z) + k_x_v.z + g_x_w.z)};
        out.m.set(k, m_dot);
        out.n.set(k, n_dot);

        // Kelvin-Voigt: the stress that acts is S + tau A dU/dt; its own work is lost
        const Triple m_all = combine(1.0, m, kelvin_voigt, m_dot);
        const Triple n_all = combine(1.0, n, kelvin_voigt, n_dot);

        // wrenches S +- h/2 (k x m + g x n, k x n) on the end nodes
        const double hh = c.half_length[k];
        const Triple k_x_m = cross(kappa, m_all);
        const Triple g_x_n = cross(gamma, n_all);
        const Triple k_x_n = cross(kappa, n_all);
        const Triple couple = combine(hh, k_x_m, hh, g_x_n);
        on_first.moment.set(k, combine(1.0, m_all, 1.0, couple));
        on_last.moment.set(k, combine(1.0, m_all, -1.0, couple));
        on_first.force.set(k, combine(1.0, n_all, hh, k_x_n));
        on_last.force.set(k, combine(1.0, n_all, -hh, k_x_n));

        const SegmentPose pose =
            segment_pose(c.length[k], kappa.x, kappa.y, kappa.z, gamma.x, gamma.y, gamma.z);
        step[0][k] = pose.rotation[0][0];
        step[1][k] = pose.rotation[0][1];
        step[2][k] = pose.rotation[0][2];
        step[3][k] = pose.rotation[1][0];
        step[4][k] = pose.rotation[1][1];
        step[5][k] = pose.rotation[1][2];
        step[6][k] = pose.rotation[2][0];
        step[7][k] = pose.rotation[2][1];
        step[8][k] = pose.rotation[2][2];
        step[9][k] = pose.position[0];
        step[10][k] = pose.position[1];
        step[11][k] = pose.position[2];

        // - h B dU/dt . dU/dt
        const Triple k_dot = {c.torsion_compliance[k] * m_dot.x, c.bending_compliance[k] * m_dot.y,
                              c.bending_compliance[k] * m_dot.z};
        const Triple g_dot = {c.axial_compliance[k] * n_dot.x, c.shear_compliance[k] * n_dot.y,
                              c.shear_compliance[k] * n_dot.z};
        return -kelvin_voigt * c.length[k] * (dot(m_dot, k_dot) + dot(n_dot, g_dot));
    };
    alignas(block_alignment) double power[block_size];
#pragma omp simd
    for (std::size_t k = 0; k < block_size; ++k)
        power[k] = segment(k);
    return ordered_sum(power, block_size);
}

/// Product of the poses of a block's segments: pose of each node in the frame of the first, and the
/// whole block's step. The rows of the rotation run in parallel.
DRILLSTRAND_KERNEL void chain_segments_of_block(const double (*step)[block_size], Table<Work>& work,
                                                std::size_t block, SegmentPose& block_step) {
    constexpr int lanes = 4;  // three rows and an idle one
    alignas(32) double rotation[3][lanes] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    alignas(32) double position[lanes] = {0, 0, 0, 0};
    double* rows[12];
    for (std::size_t i = 0; i < 9; ++i)
        rows[i] = work.row(Work::local_rotation, i) + block * block_size;
    for (std::size_t i = 0; i < 3; ++i)
        rows[9 + i] = work.row(Work::local_position, i) + block * block_size;
    for (std::size_t k = 0; k < block_size; ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j)
                rows[3 * i + j][k] = rotation[j][i];
            rows[9 + i][k] = position[i];
        }
        alignas(32) double turned[3][lanes];
#pragma omp simd
        for (int i = 0; i < lanes; ++i) {
            const double a = rotation[0][i];
            const double b = rotation[1][i];
            const double c = rotation[2][i];
            position[i] += a * step[9][k] + b * step[10][k] + c * step[11][k];
            turned[0][i] = a * step[0][k] + b * step[3][k] + c * step[6][k];
            turned[1][i] = a * step[1][k] + b * step[4][k] + c * step[7][k];
            turned[2][i] = a * step[2][k] + b * step[5][k] + c * step[8][k];
        }
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t i = 0; i < lanes; ++i)
                rotation[j][i] = turned[j][i];
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            block_step.rotation[i][j] = rotation[j][i];
        block_step.position[i] = position[i];
    }
}

/// What surrounds the nodes, as far as a kernel has to know.
enum class Around { nothing, wall, mud, flowing_mud };

/// Nodes of one block. Features are known at compile time: what is off is not compiled in.
template <Around around, bool heavy, bool with_damping, class Wall>
DRILLSTRAND_KERNEL double nodes_of_block(const StrandModel& model, const Table<StrandRow>& state,
                                         Table<StrandRow>& rate, const Table<Work>& work,
                                         const Pose& start, Table<WallRow>& wall,
                                         std::size_t block) {
    constexpr bool in_well = around != Around::nothing;
    constexpr bool with_drag = around == Around::mud || around == Around::flowing_mud;
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(block * block_size);
    const StrandIn in(state, first);
    const StrandOut out(rate, first);
    const WrenchRows<ConstTriples> after(work, Work::wrench_on_first, first);
    const WrenchRows<ConstTriples> before(work, Work::wrench_on_last, first - 1);
    const ConstTriples row_1 = work.triples(Work::local_rotation, first);
    const ConstTriples row_2 = work.triples(Work::local_rotation, first, 3);
    const ConstTriples row_3 = work.triples(Work::local_rotation, first, 6);
    const ConstTriples local_position = work.triples(Work::local_position, first);
    const NodeConstants c(model.constants, first);

    // the two segments and their strain rates, for D_in
    const SegmentConstants c_after(model.constants, first);
    const SegmentConstants c_before(model.constants, first - 1);
    const StrandIn rate_after(rate, first);
    const StrandIn rate_before(rate, first - 1);
    const DampingPair internal_damping = model.internal_damping;
    const DampingPair external_damping = model.external_damping;

    // pose of the block's first node; gravity in its frame
    const Eigen::Matrix3d& f = start.frame;
    const Triple frame_1 = {f(0, 0), f(0, 1), f(0, 2)};
    const Triple frame_2 = {f(1, 0), f(1, 1), f(1, 2)};
    const Triple frame_3 = {f(2, 0), f(2, 1), f(2, 2)};
    const Eigen::Vector3d down_in_block = f.transpose() * model.down;
    const Triple down = {down_in_block.x(), down_in_block.y(), down_in_block.z()};
    const Triple origin = {start.position.x(), start.position.y(), start.position.z()};

    const SurroundingsParameters& parameters = model.surroundings.parameters();
    const WallRows around_node = in_well ? WallRows(model.surroundings, wall, first) : WallRows();
    const Wall varying(wall, first);
    const FrictionParameters shared_friction = parameters.friction;
    const double cone = shared_friction.cone();
    const double least_normal = parameters.least_normal;
    const double viscosity = parameters.viscosity;
    const Thinning thinning = parameters.thinning;
    const double film = parameters.film;
    const double wet_in_contact = parameters.contact_drag ? 1.0 : 0.0;
    const double eccentric_axial = parameters.eccentric_axial_drag ? 1.0 : 0.0;

    const auto node = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        double power = 0.0;
        const Triple pi = in.pi[k];
        const Triple p = in.p[k];
        const Triple w = {c.inverse_polar[k] * pi.x, c.inverse_transverse[k] * pi.y,
                          c.inverse_transverse[k] * pi.z};
        const Triple v =
            linear_velocity<heavy>(p, c.mass[k], c.inverse_mass[k], around_node.fluid_mass, k);

        // rod: S' + mean of (k x m + g x n, k x n), over the node's cell
        const double ic = c.inverse_cell[k];
        Triple pi_dot = combine(ic, after.moment[k], -ic, before.moment[k]);
        Triple p_dot = combine(ic, after.force[k], -ic, before.force[k]);

        // inertia in body axes: Pi x w + p x v (which vanishes where no fluid goes along), p x w
        pi_dot = combine(1.0, pi_dot, 1.0, cross(pi, w));
        if constexpr (heavy) pi_dot = combine(1.0, pi_dot, 1.0, cross(p, v));
        p_dot = combine(1.0, p_dot, 1.0, cross(p, w));

        // weight
        const Triple r1 = row_1[k];
        const Triple r2 = row_2[k];
        const Triple r3 = row_3[k];
        const double mg = c.weight[k];
        p_dot.x += mg * (r1.x * down.x + r2.x * down.y + r3.x * down.z);
        p_dot.y += mg * (r1.y * down.x + r2.y * down.y + r3.y * down.z);
        p_dot.z += mg * (r1.z * down.x + r2.z * down.y + r3.z * down.z);

        Triple couple = {0, 0, 0};
        Triple push = {0, 0, 0};
        if constexpr (in_well) {
            // directors and position in space
            const Triple column_1 = {r1.x, r2.x, r3.x};
            const Triple column_2 = {r1.y, r2.y, r3.y};
            const Triple column_3 = {r1.z, r2.z, r3.z};
            const Triple d3 = {dot(frame_1, column_1), dot(frame_2, column_1),
                               dot(frame_3, column_1)};
            const Triple d1 = {dot(frame_1, column_2), dot(frame_2, column_2),
                               dot(frame_3, column_2)};
            const Triple d2 = {dot(frame_1, column_3), dot(frame_2, column_3),
                               dot(frame_3, column_3)};
            const Triple here = local_position[k];
            const Triple x = {origin.x + dot(frame_1, here), origin.y + dot(frame_2, here),
                              origin.z + dot(frame_3, here)};
            const WellFrame frame = well_frame(x, around_node.arc(k));
            around_node.leaves[k] =
                foot_leaves(frame, around_node.end_cosine[k], around_node.reach[k]) ? 1.0 : 0.0;

            // the well's directions in body axes; motion along them
            const Triple r = {dot(frame.r, d3), dot(frame.r, d1), dot(frame.r, d2)};
            const Triple l = {dot(frame.l, d3), dot(frame.l, d1), dot(frame.l, d2)};
            const Triple t = cross(r, l);
            const double v_r = dot(v, r);
            const double v_l = dot(v, l);
            const double v_t = dot(v, t);
            const double w_l = dot(w, l);

            // where the wall varies its normal leans: it also pushes to where the hole is wide and
            // the wall soft
            VaryingWall::Slopes slopes = {0.0, 0.0};
            FrictionParameters friction = shared_friction;
            if constexpr (Wall::varies) {
                slopes = varying.vary(k, frame);
                friction = varying.friction(k, shared_friction);
            }
            const double dr =
                penetration(frame.eccentricity, around_node.hole[k], around_node.pipe[k]);
            const double approach = Wall::varies ? v_r + slopes.hole * v_l : v_r;
            const double normal = normal_force(dr, approach, around_node.stiffness[k],
                                               around_node.dashpot[k], least_normal);
            const FrictionSpring spring = around_node.spring(k);
            const Tangential held = friction_force(spring, normal, friction);
            const Tangential rub = {dr > 0.0 ? held.axial : 0.0, dr > 0.0 ? held.azimuthal : 0.0};
            // the paper's azimuthal spring does not see the node's motion around the well
            const Tangential slip = slip_velocity(v_l, cone * v_t, w_l, around_node.pipe[k]);
            around_node.depth[k] = dr;
            around_node.normal[k] = normal;
            around_node.slip_axial[k] = slip.axial;
            around_node.slip_azimuthal[k] = slip.azimuthal;
            around_node.rolling[k] = rolling_speed(v_t, frame.eccentricity, around_node.hole[k]);

            double f_r = normal;
            double f_l = rub.axial;
            double f_t = rub.azimuthal;
            double c_l = around_node.pipe[k] * rub.azimuthal;
            if constexpr (Wall::varies) {
                const double depth = dr > 0.0 ? dr : 0.0;
                f_l += slopes.hole * normal - 0.5 * slopes.stiffness * depth * depth;
            }
            if constexpr (with_drag) {
                DragCoefficients drag =
                    drag_coefficients(around_node.annulus(k, frame.eccentricity, film));
                drag.axial = eccentric_axial * drag.axial + around_node.concentric_axial[k];
                // without inertia of the flow its coefficients are 0
                const double flowed_by = around_node.flow_radius_at(k);
                if constexpr (around == Around::flowing_mud) {
                    const MudAround mud = around_node.mud(k);
                    f_l += mud.load;
                    drag = flowing_drag(drag, around_node.flow(k), mud, thinning, flowed_by,
                                        around_node.hole[k], v_r, v_l, v_t, w_l);
                } else {
                    drag = with_inertia(scaled(drag, viscosity), around_node.flow(k), flowed_by,
                                        std::sqrt(v_r * v_r + v_t * v_t), v_l, w_l);
                }
                drag = around_wall(drag, frame.eccentricity, flowed_by, around_node.hole[k], film,
                                   wet_in_contact);
                f_r -= drag.radial * v_r;
                f_l -= drag.axial * v_l;
                f_t -= drag.around * v_t + drag.cross * w_l;
                c_l -= drag.cross * v_t + drag.spin * w_l;
            }
            if constexpr (heavy) {
                // the fluid's v^2 grad M / 2; its v dM/dt is in the momentum. Its power is that of
                // the changing mass, -v^2 dM/dt / 2: both move energy within what moves sideways
                const AddedMass added = around_node.annulus_mass(
                    k, around_node.annulus(k, frame.eccentricity, film), frame.eccentricity);
                const double by_fluid = -0.5 * (v_r * v_r + v_t * v_t) * added.slope;
                f_r += by_fluid;
                power -= c.mobile_cell[k] * by_fluid * v_r;
            }
            push = combine(1.0, combine(f_r, r, f_l, l), f_t, t);
            couple = combine(c_l, l, 0.0, l);
        }
        if constexpr (with_damping) {
            // D_ex V + D_in dU/dt, the strain rate as the mean of the neighbours over the cell
            const double after_share = ic * c_after.half_length[k];
            const double before_share = ic * c_before.half_length[k];
            double a = internal_damping.rotation * after_share;
            double b = internal_damping.rotation * before_share;
            const Triple m_a = rate_after.m[k];
            const Triple m_b = rate_before.m[k];
            const Triple n_a = rate_after.n[k];
            const Triple n_b = rate_before.n[k];
            couple.x -= external_damping.rotation * w.x +
                        a * c_after.torsion_compliance[k] * m_a.x +
                        b * c_before.torsion_compliance[k] * m_b.x;
            couple.y -= external_damping.rotation * w.y +
                        a * c_after.bending_compliance[k] * m_a.y +
                        b * c_before.bending_compliance[k] * m_b.y;
            couple.z -= external_damping.rotation * w.z +
                        a * c_after.bending_compliance[k] * m_a.z +
                        b * c_before.bending_compliance[k] * m_b.z;
            a = internal_damping.translation * after_share;
            b = internal_damping.translation * before_share;
            push.x -= external_damping.translation * v.x + a * c_after.axial_compliance[k] * n_a.x +
                      b * c_before.axial_compliance[k] * n_b.x;
            push.y -= external_damping.translation * v.y + a * c_after.shear_compliance[k] * n_a.y +
                      b * c_before.shear_compliance[k] * n_b.y;
            push.z -= external_damping.translation * v.z + a * c_after.shear_compliance[k] * n_a.z +
                      b * c_before.shear_compliance[k] * n_b.z;
        }
        if constexpr (in_well || with_damping) {
            pi_dot = combine(1.0, pi_dot, 1.0, couple);
            p_dot = combine(1.0, p_dot, 1.0, push);
            power += c.mobile_cell[k] * (dot(couple, w) + dot(push, v));
        }
        out.pi.set(k, pi_dot);
        out.p.set(k, p_dot);
        return power;
    };
    alignas(block_alignment) double power[block_size];
#pragma omp simd
    for (std::size_t k = 0; k < block_size; ++k)
        power[k] = node(k);
    return ordered_sum(power, block_size);
}

/// One instance of the node kernel per set of features.
using NodeKernel = double (*)(const StrandModel&, const Table<StrandRow>&, Table<StrandRow>&,
                              const Table<Work>&, const Pose&, Table<WallRow>&, std::size_t);

template <Around around, bool heavy, bool with_damping>
NodeKernel node_kernel_around(const StrandModel& model) {
    return model.features.varied_wall
               ? at_level<nodes_of_block<around, heavy, with_damping, VaryingWall>>(model.level)
               : at_level<nodes_of_block<around, heavy, with_damping, EvenWall>>(model.level);
}

template <bool heavy, bool with_damping>
NodeKernel node_kernel_in_well(const StrandModel& model) {
    if (model.features.flowing_mud)
        return node_kernel_around<Around::flowing_mud, heavy, with_damping>(model);
    return model.features.drag ? node_kernel_around<Around::mud, heavy, with_damping>(model)
                               : node_kernel_around<Around::wall, heavy, with_damping>(model);
}

template <bool with_damping>
NodeKernel node_kernel_damped(const StrandModel& model) {
    if (!model.features.well)
        return at_level<nodes_of_block<Around::nothing, false, with_damping, EvenWall>>(
            model.level);
    return model.features.fluid_mass ? node_kernel_in_well<true, with_damping>(model)
                                     : node_kernel_in_well<false, with_damping>(model);
}

NodeKernel node_kernel(const StrandModel& model) {
    // Kelvin-Voigt damping acts in the segments
    return model.internal_damping.any() || model.external_damping.any()
               ? node_kernel_damped<true>(model)
               : node_kernel_damped<false>(model);
}

Eigen::Matrix3d rotation_of(const SegmentPose& step) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&step.rotation[0][0]);
}

}  // namespace

void segment_pass(const StrandModel& model, const Table<StrandRow>& state, Table<StrandRow>& rate,
                  StrandWorkspace& work, const Table<WallRow>& wall, std::size_t begin,
                  std::size_t end) {
    const auto segments = model.features.fluid_mass
                              ? at_level<segments_of_block<true>>(model.level)
                              : at_level<segments_of_block<false>>(model.level);
    const auto chain = at_level<chain_segments_of_block>(model.level);
    alignas(block_alignment) double step[12][block_size];
    for (std::size_t block = begin; block < end; ++block) {
        work.segment_power[block] = segments(model, state, rate, work.table, wall, block, step);
        chain(step, work.table, block, work.block_step[block]);
    }
}

void set_head_wrench(StrandWorkspace& work, const Vector6& stress) {
    for (std::size_t i = 0; i < 6; ++i)
        work.table.row(Work::wrench_on_last, i)[-1] = stress[static_cast<Eigen::Index>(i)];
}

Vector6 wrench_on_head(const StrandWorkspace& work) {
    Vector6 wrench;
    for (std::size_t i = 0; i < 6; ++i)
        wrench[static_cast<Eigen::Index>(i)] = work.table.row(Work::wrench_on_first, i)[0];
    return wrench;
}

void set_bit_wrench(StrandWorkspace& work, std::size_t segments, const Vector6& stress) {
    for (std::size_t i = 0; i < 6; ++i)
        work.table.row(Work::wrench_on_first, i)[segments] = stress[static_cast<Eigen::Index>(i)];
}

void chain_blocks(const Pose& head, const StrandWorkspace& work, std::vector<Pose>& block_start,
                  std::size_t end) {
    block_start[0] = head;
    for (std::size_t block = 1; block < end; ++block) {
        const Pose& last = block_start[block - 1];
        const SegmentPose& step = work.block_step[block - 1];
        block_start[block].position =
            last.position + last.frame * Eigen::Map<const Eigen::Vector3d>(step.position);
        block_start[block].frame = last.frame * rotation_of(step);
    }
}

void node_pass(const StrandModel& model, const Table<StrandRow>& state, Table<StrandRow>& rate,
               StrandWorkspace& work, const std::vector<Pose>& block_start, Table<WallRow>& wall,
               std::size_t begin, std::size_t end) {
    const NodeKernel kernel = node_kernel(model);
    for (std::size_t block = begin; block < end; ++block) {
        work.power[block] = work.segment_power[block] +
                            kernel(model, state, rate, work.table, block_start[block], wall, block);
    }
}

Pose node_pose(const StrandWorkspace& work, const std::vector<Pose>& block_start,
               std::size_t node) {
    const Pose& start = block_start[node / block_size];
    SegmentPose local{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            local.rotation[i][j] = work.table.row(Work::local_rotation, 3 * i + j)[node];
        local.position[i] = work.table.row(Work::local_position, i)[node];
    }
    return {start.frame * rotation_of(local),
            start.position + start.frame * Eigen::Map<const Eigen::Vector3d>(local.position)};
}

Vector6 momentum_of(const Table<StrandRow>& state, std::size_t node) {
    Vector6 momentum;
    momentum << state.vector(StrandRow::angular_momentum, node),
        state.vector(StrandRow::linear_momentum, node);
    return momentum;
}

Vector6 stress_of(const Table<StrandRow>& state, std::size_t segment) {
    Vector6 stress;
    stress << state.vector(StrandRow::moment, segment), state.vector(StrandRow::force, segment);
    return stress;
}

void set_momentum(Table<StrandRow>& state, std::size_t node, const Vector6& momentum) {
    const auto entry = static_cast<std::ptrdiff_t>(node);
    state.set(StrandRow::angular_momentum, entry, momentum.head<3>());
    state.set(StrandRow::linear_momentum, entry, momentum.tail<3>());
}

void set_stress(Table<StrandRow>& state, std::size_t segment, const Vector6& stress) {
    const auto entry = static_cast<std::ptrdiff_t>(segment);
    state.set(StrandRow::moment, entry, stress.head<3>());
    state.set(StrandRow::force, entry, stress.tail<3>());
}

}  // namespace drillstrand
