#include "rod/strand.hpp"

#include <cmath>
#include <utility>

#include "forces/contact.hpp"
#include "forces/fluid.hpp"
#include "forces/well_frame.hpp"
#include "rod/rows.hpp"

namespace drillstrand {

StrandConstants::StrandConstants(const Scene& scene)
    : table_(rows, static_cast<std::size_t>(scene.segments) + 1) {
    // Padding has no stiffness, no length and no weight: it stays at rest, unstressed, and divides
    // nothing by zero.
    for (const Row unit :
         {torsion_compliance, bending_compliance, axial_compliance, shear_compliance, inverse_cell,
          inverse_mass, inverse_polar, inverse_transverse}) {
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
        set(inverse_mass, 1 / s.mass);
        set(inverse_polar, 1 / s.polar_inertia);
        set(inverse_transverse, 1 / scene.inertia[k]);
        set(weight, scene.weight[k]);
    }
    if (scene.head.motion == HeadMotion::driven) table_.row(mobile_cell)[0] = 0.0;
}

StrandModel::StrandModel(const Scene& scene)
    : constants(scene),
      features(scene.features),
      internal_damping(scene.damping.internal),
      external_damping(scene.damping.external),
      kelvin_voigt(scene.damping.kelvin_voigt),
      down(scene.down),
      segments(static_cast<std::size_t>(scene.segments)) {}

namespace {

using Constants = StrandConstants;
using Work = StrandWorkspace;

/// Segments of one block: everything that vectorises.
/// Returns the power of Kelvin-Voigt damping on the rod.
DRILLSTRAND_KERNEL double segments_of_block(const StrandModel& model, const BlockTable& state,
                                            BlockTable& rate, BlockTable& work, std::size_t block,
                                            double (*step)[block_size]) {
    const StrandConstants& c = model.constants;
    const double kelvin_voigt = model.kelvin_voigt;
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(block * block_size);
    const ConstRows pi = rows_at(state, angular_momentum, first);
    const ConstRows p = rows_at(state, linear_momentum, first);
    const ConstRows pi_next = rows_at(state, angular_momentum, first + 1);
    const ConstRows p_next = rows_at(state, linear_momentum, first + 1);
    const ConstRows m_rows = rows_at(state, moment, first);
    const ConstRows n_rows = rows_at(state, force, first);
    const Rows m_rate = rows_at(rate, moment, first);
    const Rows n_rate = rows_at(rate, force, first);
    const Rows first_moment = rows_at(work, Work::wrench_on_first, first);
    const Rows first_force = rows_at(work, Work::wrench_on_first + 3, first);
    const Rows last_moment = rows_at(work, Work::wrench_on_last, first);
    const Rows last_force = rows_at(work, Work::wrench_on_last + 3, first);
    const double* length = c.row(Constants::length) + first;
    const double* half_length = c.row(Constants::half_length) + first;
    const double* inverse_length = c.row(Constants::inverse_length) + first;
    const double* torsion = c.row(Constants::torsion) + first;
    const double* bending = c.row(Constants::bending) + first;
    const double* axial = c.row(Constants::axial) + first;
    const double* shear = c.row(Constants::shear) + first;
    const double* torsion_compliance = c.row(Constants::torsion_compliance) + first;
    const double* bending_compliance = c.row(Constants::bending_compliance) + first;
    const double* axial_compliance = c.row(Constants::axial_compliance) + first;
    const double* shear_compliance = c.row(Constants::shear_compliance) + first;
    const double* twist0 = c.row(Constants::twist0) + first;
    const double* bend10 = c.row(Constants::bend10) + first;
    const double* bend20 = c.row(Constants::bend20) + first;
    const double* inverse_mass = c.row(Constants::inverse_mass) + first;
    const double* inverse_polar = c.row(Constants::inverse_polar) + first;
    const double* inverse_transverse = c.row(Constants::inverse_transverse) + first;

    const auto segment = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        // strains U = A^-1 S + Ubar
        const Triple m = m_rows[k];
        const Triple n = n_rows[k];
        const Triple kappa = {torsion_compliance[k] * m.x + twist0[k],
                              bending_compliance[k] * m.y + bend10[k],
                              bending_compliance[k] * m.z + bend20[k]};
        const Triple gamma = {axial_compliance[k] * n.x + 1.0, shear_compliance[k] * n.y,
                              shear_compliance[k] * n.z};

        // velocities V = M^-1 P of the two end nodes
        const Triple pi_a = pi[k];
        const Triple pi_b = pi_next[k];
        const Triple p_a = p[k];
        const Triple p_b = p_next[k];
        const double im_a = inverse_mass[k];
        const double im_b = inverse_mass[k + 1];
        const double ip_a = inverse_polar[k];
        const double ip_b = inverse_polar[k + 1];
        const double it_a = inverse_transverse[k];
        const double it_b = inverse_transverse[k + 1];
        const Triple w_a = {ip_a * pi_a.x, it_a * pi_a.y, it_a * pi_a.z};
        const Triple w_b = {ip_b * pi_b.x, it_b * pi_b.y, it_b * pi_b.z};
        const Triple v_a = {im_a * p_a.x, im_a * p_a.y, im_a * p_a.z};
        const Triple v_b = {im_b * p_b.x, im_b * p_b.y, im_b * p_b.z};
        const Triple w = combine(0.5, w_a, 0.5, w_b);
        const Triple v = combine(0.5, v_a, 0.5, v_b);

        // compatibility (paper eq. 4): k' = w' + k x w, g' = v' + k x v + g x w
        const double ih = inverse_length[k];
        const Triple k_x_w = cross(kappa, w);
        const Triple k_x_v = cross(kappa, v);
        const Triple g_x_w = cross(gamma, w);
        const Triple m_dot = {torsion[k] * (ih * (w_b.x - w_a.x) + k_x_w.x),
                              bending[k] * (ih * (w_b.y - w_a.y) + k_x_w.y),
                              bending[k] * (ih * (w_b.z - w_a.z) + k_x_w.z)};
        const Triple n_dot = {axial[k] * (ih * (v_b.x - v_a.x) + k_x_v.x + g_x_w.x),
                              shear[k] * (ih * (v_b.y - v_a.y) + k_x_v.y + g_x_w.y),
                              shear[k] * (ih * (v_b.z - v_a.z) + k_x_v.z + g_x_w.z)};
        m_rate.set(k, m_dot);
        n_rate.set(k, n_dot);

        // Kelvin-Voigt: the stress that acts is S + tau A dU/dt; its own work is lost
        const Triple m_all = combine(1.0, m, kelvin_voigt, m_dot);
        const Triple n_all = combine(1.0, n, kelvin_voigt, n_dot);

        // wrenches S +- h/2 (k x m + g x n, k x n) on the end nodes
        const double hh = half_length[k];
        const Triple k_x_m = cross(kappa, m_all);
        const Triple g_x_n = cross(gamma, n_all);
        const Triple k_x_n = cross(kappa, n_all);
        const Triple couple = combine(hh, k_x_m, hh, g_x_n);
        first_moment.set(k, combine(1.0, m_all, 1.0, couple));
        last_moment.set(k, combine(1.0, m_all, -1.0, couple));
        first_force.set(k, combine(1.0, n_all, hh, k_x_n));
        last_force.set(k, combine(1.0, n_all, -hh, k_x_n));

        const SegmentPose pose =
            segment_pose(length[k], kappa.x, kappa.y, kappa.z, gamma.x, gamma.y, gamma.z);
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
        const Triple k_dot = {torsion_compliance[k] * m_dot.x, bending_compliance[k] * m_dot.y,
                              bending_compliance[k] * m_dot.z};
        const Triple g_dot = {axial_compliance[k] * n_dot.x, shear_compliance[k] * n_dot.y,
                              shear_compliance[k] * n_dot.z};
        return -kelvin_voigt * length[k] * (dot(m_dot, k_dot) + dot(n_dot, g_dot));
    };
    double power = 0.0;
#pragma omp simd reduction(+ : power)
    for (std::size_t k = 0; k < block_size; ++k)
        power += segment(k);
    return power;
}

/// Product of the poses of a block's segments: pose of each node in the frame of the first, and the
/// whole block's step. The rows of the rotation run in parallel.
DRILLSTRAND_KERNEL void chain_segments_of_block(const double (*step)[block_size], BlockTable& work,
                                                std::size_t block, SegmentPose& block_step) {
    constexpr int lanes = 4;  // three rows and an idle one
    alignas(32) double rotation[3][lanes] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    alignas(32) double position[lanes] = {0, 0, 0, 0};
    double* rows[12];
    for (std::size_t i = 0; i < 12; ++i) {
        rows[i] = work.row(Work::local_rotation + i) + block * block_size;
    }
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

/// Nodes of one block. Features are known at compile time: what is off is not compiled in.
template <bool in_well, bool with_drag, bool with_damping>
DRILLSTRAND_INLINE double nodes_of_block(const StrandModel& model, const BlockTable& state,
                                         BlockTable& rate, const BlockTable& work,
                                         const Pose& start, Surroundings& surroundings,
                                         std::size_t block) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(block * block_size);
    const StrandConstants& c = model.constants;
    const ConstRows pi_rows = rows_at(state, angular_momentum, first);
    const ConstRows p_rows = rows_at(state, linear_momentum, first);
    const Rows pi_rate = rows_at(rate, angular_momentum, first);
    const Rows p_rate = rows_at(rate, linear_momentum, first);
    const ConstRows moment_after = rows_at(work, Work::wrench_on_first, first);
    const ConstRows force_after = rows_at(work, Work::wrench_on_first + 3, first);
    const ConstRows moment_before = rows_at(work, Work::wrench_on_last, first - 1);
    const ConstRows force_before = rows_at(work, Work::wrench_on_last + 3, first - 1);
    const ConstRows row_1 = rows_at(work, Work::local_rotation, first);
    const ConstRows row_2 = rows_at(work, Work::local_rotation + 3, first);
    const ConstRows row_3 = rows_at(work, Work::local_rotation + 6, first);
    const ConstRows local_position = rows_at(work, Work::local_position, first);
    const double* inverse_cell = c.row(Constants::inverse_cell) + first;
    const double* mobile_cell = c.row(Constants::mobile_cell) + first;
    const double* inverse_mass = c.row(Constants::inverse_mass) + first;
    const double* inverse_polar = c.row(Constants::inverse_polar) + first;
    const double* inverse_transverse = c.row(Constants::inverse_transverse) + first;
    const double* weight = c.row(Constants::weight) + first;

    // strain rates of the two neighbours, for D_in
    const std::ptrdiff_t before = first - 1;
    const ConstRows m_rate_after = rows_at(std::as_const(rate), moment, first);
    const ConstRows n_rate_after = rows_at(std::as_const(rate), force, first);
    const ConstRows m_rate_before = rows_at(std::as_const(rate), moment, before);
    const ConstRows n_rate_before = rows_at(std::as_const(rate), force, before);
    const double* half_length = c.row(Constants::half_length) + first;
    const double* half_length_before = c.row(Constants::half_length) + before;
    const double* torsion_compliance = c.row(Constants::torsion_compliance) + first;
    const double* torsion_compliance_before = c.row(Constants::torsion_compliance) + before;
    const double* bending_compliance = c.row(Constants::bending_compliance) + first;
    const double* bending_compliance_before = c.row(Constants::bending_compliance) + before;
    const double* axial_compliance = c.row(Constants::axial_compliance) + first;
    const double* axial_compliance_before = c.row(Constants::axial_compliance) + before;
    const double* shear_compliance = c.row(Constants::shear_compliance) + first;
    const double* shear_compliance_before = c.row(Constants::shear_compliance) + before;
    const double internal_damping = model.internal_damping;
    const double external_damping = model.external_damping;

    // pose of the block's first node; gravity in its frame
    const Eigen::Matrix3d& f = start.frame;
    const Triple frame_1 = {f(0, 0), f(0, 1), f(0, 2)};
    const Triple frame_2 = {f(1, 0), f(1, 1), f(1, 2)};
    const Triple frame_3 = {f(2, 0), f(2, 1), f(2, 2)};
    const Eigen::Vector3d down_in_block = f.transpose() * model.down;
    const Triple down = {down_in_block.x(), down_in_block.y(), down_in_block.z()};
    const Triple origin = {start.position.x(), start.position.y(), start.position.z()};

    using S = Surroundings;
    const SurroundingsParameters& around = surroundings.parameters();
    const auto s_row = [&](S::Row row) {
        return in_well ? surroundings.row(row) + first : nullptr;
    };
    const ConstRows arc_start = {s_row(S::start_x), s_row(S::start_y), s_row(S::start_z)};
    const ConstRows arc_tangent = {s_row(S::tangent_x), s_row(S::tangent_y), s_row(S::tangent_z)};
    const ConstRows arc_normal = {s_row(S::normal_x), s_row(S::normal_y), s_row(S::normal_z)};
    const double* curvature = s_row(S::curvature);
    const double* hole = s_row(S::hole);
    const double* end_cosine = s_row(S::end_cosine);
    const double* reach = s_row(S::reach);
    const double* pipe = s_row(S::pipe);
    const double* stiffness = s_row(S::stiffness);
    const double* damping = s_row(S::damping);
    const double* elongation_axial = s_row(S::elongation_axial);
    const double* elongation_azimuthal = s_row(S::elongation_azimuthal);
    const double* sliding = s_row(S::sliding);
    double* depth_out = s_row(S::depth);
    double* normal_out = s_row(S::normal);
    double* slip_axial = s_row(S::slip_axial);
    double* slip_azimuthal = s_row(S::slip_azimuthal);
    double* leaves = s_row(S::leaves);
    const double* concentric_axial = s_row(S::concentric_axial);
    const FrictionParameters friction = around.friction;
    const double least_normal = around.least_normal;
    const double viscosity = around.viscosity;
    const double film = around.film;
    const double eccentric_axial = around.eccentric_axial_drag ? 1.0 : 0.0;

    const auto node = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        double power = 0.0;
        const Triple pi = pi_rows[k];
        const Triple p = p_rows[k];
        const double im = inverse_mass[k];
        const Triple w = {inverse_polar[k] * pi.x, inverse_transverse[k] * pi.y,
                          inverse_transverse[k] * pi.z};
        const Triple v = {im * p.x, im * p.y, im * p.z};

        // rod: S' + mean of (k x m + g x n, k x n), over the node's cell
        const double ic = inverse_cell[k];
        Triple pi_dot = combine(ic, moment_after[k], -ic, moment_before[k]);
        Triple p_dot = combine(ic, force_after[k], -ic, force_before[k]);

        // inertia in body axes: Pi x w (p x v vanishes), p x w
        pi_dot = combine(1.0, pi_dot, 1.0, cross(pi, w));
        p_dot = combine(1.0, p_dot, 1.0, cross(p, w));

        // weight
        const Triple r1 = row_1[k];
        const Triple r2 = row_2[k];
        const Triple r3 = row_3[k];
        const double mg = weight[k];
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
            const ArcNumbers arc = {arc_start[k], arc_tangent[k], arc_normal[k], curvature[k],
                                    hole[k]};
            const WellFrame frame = well_frame(x, arc);
            leaves[k] = foot_leaves(frame, end_cosine[k], reach[k]) ? 1.0 : 0.0;

            // the well's directions in body axes; motion along them
            const Triple r = {dot(frame.r, d3), dot(frame.r, d1), dot(frame.r, d2)};
            const Triple l = {dot(frame.l, d3), dot(frame.l, d1), dot(frame.l, d2)};
            const Triple t = cross(r, l);
            const double v_r = dot(v, r);
            const double v_l = dot(v, l);
            const double v_t = dot(v, t);
            const double w_l = dot(w, l);

            const double dr = penetration(frame.eccentricity, hole[k], pipe[k]);
            const double normal = normal_force(dr, v_r, stiffness[k], damping[k], least_normal);
            const FrictionSpring spring = {{elongation_axial[k], elongation_azimuthal[k]},
                                           sliding[k]};
            const Tangential held = friction_force(spring, normal, friction);
            const Tangential rub = {dr > 0.0 ? held.axial : 0.0, dr > 0.0 ? held.azimuthal : 0.0};
            // the paper's azimuthal spring does not see the node's motion around the well
            const Tangential slip = slip_velocity(v_l, friction.cone * v_t, w_l, pipe[k]);
            depth_out[k] = dr;
            normal_out[k] = normal;
            slip_axial[k] = slip.axial;
            slip_azimuthal[k] = slip.azimuthal;

            double f_r = normal;
            double f_l = rub.axial;
            double f_t = rub.azimuthal;
            double c_l = pipe[k] * rub.azimuthal;
            if constexpr (with_drag) {
                const double eccentricity =
                    drag_eccentricity(frame.eccentricity, pipe[k], hole[k], film);
                const DragCoefficients drag = drag_coefficients(eccentricity, pipe[k], hole[k]);
                const double axial = eccentric_axial * drag.axial + concentric_axial[k];
                // nodes in contact get no fluid force (paper)
                const double mu = dr > 0.0 ? 0.0 : viscosity;
                f_r -= mu * drag.radial * v_r;
                f_l -= mu * axial * v_l;
                f_t -= mu * (drag.around * v_t + drag.cross * w_l);
                c_l -= mu * (drag.cross * v_t + drag.spin * w_l);
            }
            push = combine(1.0, combine(f_r, r, f_l, l), f_t, t);
            couple = combine(c_l, l, 0.0, l);
        }
        if constexpr (with_damping) {
            // D_ex V + D_in dU/dt, the strain rate as the mean of the neighbours over the cell
            const double a = internal_damping * ic * half_length[k];
            const double b = internal_damping * ic * half_length_before[k];
            const Triple m_a = m_rate_after[k];
            const Triple m_b = m_rate_before[k];
            const Triple n_a = n_rate_after[k];
            const Triple n_b = n_rate_before[k];
            couple.x -= external_damping * w.x + a * torsion_compliance[k] * m_a.x +
                        b * torsion_compliance_before[k] * m_b.x;
            couple.y -= external_damping * w.y + a * bending_compliance[k] * m_a.y +
                        b * bending_compliance_before[k] * m_b.y;
            couple.z -= external_damping * w.z + a * bending_compliance[k] * m_a.z +
                        b * bending_compliance_before[k] * m_b.z;
            push.x -= external_damping * v.x + a * axial_compliance[k] * n_a.x +
                      b * axial_compliance_before[k] * n_b.x;
            push.y -= external_damping * v.y + a * shear_compliance[k] * n_a.y +
                      b * shear_compliance_before[k] * n_b.y;
            push.z -= external_damping * v.z + a * shear_compliance[k] * n_a.z +
                      b * shear_compliance_before[k] * n_b.z;
        }
        if constexpr (in_well || with_damping) {
            pi_dot = combine(1.0, pi_dot, 1.0, couple);
            p_dot = combine(1.0, p_dot, 1.0, push);
            power = mobile_cell[k] * (dot(couple, w) + dot(push, v));
        }
        pi_rate.set(k, pi_dot);
        p_rate.set(k, p_dot);
        return power;
    };
    double power = 0.0;
#pragma omp simd reduction(+ : power)
    for (std::size_t k = 0; k < block_size; ++k)
        power += node(k);
    return power;
}

/// One instance of the node kernel per set of features.
using NodeKernel = double (*)(const StrandModel&, const BlockTable&, BlockTable&, const BlockTable&,
                              const Pose&, Surroundings&, std::size_t);

DRILLSTRAND_KERNEL double free_nodes(const StrandModel& m, const BlockTable& s, BlockTable& r,
                                     const BlockTable& w, const Pose& p, Surroundings& a,
                                     std::size_t b) {
    return nodes_of_block<false, false, false>(m, s, r, w, p, a, b);
}
DRILLSTRAND_KERNEL double damped_nodes(const StrandModel& m, const BlockTable& s, BlockTable& r,
                                       const BlockTable& w, const Pose& p, Surroundings& a,
                                       std::size_t b) {
    return nodes_of_block<false, false, true>(m, s, r, w, p, a, b);
}
DRILLSTRAND_KERNEL double nodes_in_well(const StrandModel& m, const BlockTable& s, BlockTable& r,
                                        const BlockTable& w, const Pose& p, Surroundings& a,
                                        std::size_t b) {
    return nodes_of_block<true, false, false>(m, s, r, w, p, a, b);
}
DRILLSTRAND_KERNEL double damped_nodes_in_well(const StrandModel& m, const BlockTable& s,
                                               BlockTable& r, const BlockTable& w, const Pose& p,
                                               Surroundings& a, std::size_t b) {
    return nodes_of_block<true, false, true>(m, s, r, w, p, a, b);
}
DRILLSTRAND_KERNEL double nodes_in_mud(const StrandModel& m, const BlockTable& s, BlockTable& r,
                                       const BlockTable& w, const Pose& p, Surroundings& a,
                                       std::size_t b) {
    return nodes_of_block<true, true, false>(m, s, r, w, p, a, b);
}
DRILLSTRAND_KERNEL double damped_nodes_in_mud(const StrandModel& m, const BlockTable& s,
                                              BlockTable& r, const BlockTable& w, const Pose& p,
                                              Surroundings& a, std::size_t b) {
    return nodes_of_block<true, true, true>(m, s, r, w, p, a, b);
}

NodeKernel node_kernel(const SceneFeatures& features) {
    if (!features.well) return features.damping ? damped_nodes : free_nodes;
    if (!features.drag) return features.damping ? damped_nodes_in_well : nodes_in_well;
    return features.damping ? damped_nodes_in_mud : nodes_in_mud;
}

Eigen::Matrix3d rotation_of(const SegmentPose& step) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&step.rotation[0][0]);
}

}  // namespace

void segment_pass(const StrandModel& model, const BlockTable& state, BlockTable& rate,
                  StrandWorkspace& work, std::size_t begin, std::size_t end) {
    alignas(block_alignment) double step[12][block_size];
    for (std::size_t block = begin; block < end; ++block) {
        work.segment_power[block] = segments_of_block(model, state, rate, work.table, block, step);
        chain_segments_of_block(step, work.table, block, work.block_step[block]);
    }
}

void set_head_wrench(StrandWorkspace& work, const Vector6& stress) {
    for (std::size_t i = 0; i < 6; ++i) {
        work.table.row(StrandWorkspace::wrench_on_last + i)[-1] =
            stress[static_cast<Eigen::Index>(i)];
    }
}

void set_bit_wrench(StrandWorkspace& work, std::size_t segments, const Vector6& stress) {
    for (std::size_t i = 0; i < 6; ++i) {
        work.table.row(StrandWorkspace::wrench_on_first + i)[segments] =
            stress[static_cast<Eigen::Index>(i)];
    }
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

void node_pass(const StrandModel& model, const BlockTable& state, BlockTable& rate,
               StrandWorkspace& work, const std::vector<Pose>& block_start,
               Surroundings& surroundings, std::size_t begin, std::size_t end) {
    const NodeKernel kernel = node_kernel(model.features);
    for (std::size_t block = begin; block < end; ++block) {
        work.power[block] =
            work.segment_power[block] +
            kernel(model, state, rate, work.table, block_start[block], surroundings, block);
    }
}

Pose node_pose(const StrandWorkspace& work, const std::vector<Pose>& block_start,
               std::size_t node) {
    const Pose& start = block_start[node / block_size];
    SegmentPose local{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            local.rotation[i][j] =
                work.table.row(StrandWorkspace::local_rotation + 3 * i + j)[node];
        }
        local.position[i] = work.table.row(StrandWorkspace::local_position + i)[node];
    }
    return {start.frame * rotation_of(local),
            start.position + start.frame * Eigen::Map<const Eigen::Vector3d>(local.position)};
}

namespace {

Vector6 column(const BlockTable& table, std::size_t first_row, std::size_t entry) {
    Vector6 v;
    for (std::size_t i = 0; i < 6; ++i) {
        v[static_cast<Eigen::Index>(i)] = table.row(first_row + i)[entry];
    }
    return v;
}

}  // namespace

Vector6 stiffness_of(const SectionProperties& section) {
    Vector6 a;
    a << section.torsional_stiffness, section.bending_stiffness, section.bending_stiffness,
        section.axial_stiffness, section.shear_stiffness, section.shear_stiffness;
    return a;
}

Vector6 stress_free_strain(const SectionProperties& section) {
    Vector6 u;
    u << section.curvature, 1, 0, 0;
    return u;
}

Vector6 momentum_of(const BlockTable& state, std::size_t node) {
    return column(state, angular_momentum, node);
}

Vector6 stress_of(const BlockTable& state, std::size_t segment) {
    return column(state, moment, segment);
}

}  // namespace drillstrand
