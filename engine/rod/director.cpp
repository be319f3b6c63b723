#include "rod/director.hpp"

#include <cmath>

#include "forces/implicit_contact.hpp"
#include "forces/well_frame.hpp"
#include "numerics/kernel.hpp"
#include "numerics/vector_math.hpp"
#include "rod/rows.hpp"

namespace drillstrand {

DirectorConstants::DirectorConstants(const Scene& scene)
    : table_(rows, static_cast<std::size_t>(scene.segments) + 1) {
    // Padding has no stiffness and no weight: it stays where it is and divides nothing by zero.
    for (const Row unit : {length, inverse_cell, mass, inverse_mass, polar, inverse_polar,
                           transverse, inverse_transverse}) {
        table_.fill(unit, 1.0);
    }
    const StringMesh& mesh = scene.mesh;
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const SectionProperties& s = mesh.segment[k];
        const auto set = [&](Row row, double value) { table_.row(row)[k] = value; };
        set(length, mesh.length[k]);
        set(inverse_length, 1 / mesh.length[k]);
        set(torsion, s.torsional_stiffness);
        set(bending, s.bending_stiffness);
        set(axial, s.axial_stiffness);
        set(shear, s.shear_stiffness);
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
        set(polar, s.polar_inertia);
        set(inverse_polar, 1 / s.polar_inertia);
        set(transverse, scene.inertia[k]);
        set(inverse_transverse, 1 / scene.inertia[k]);
        set(weight, scene.weight[k]);
    }
    if (scene.head.motion == HeadMotion::driven) table_.row(mobile_cell)[0] = 0.0;
    // padding keeps no energy account
    for (std::size_t k = mesh.cell.size(); k < table_.blocks() * block_size; ++k)
        table_.row(mobile_cell)[k] = 0.0;
}

DirectorModel::DirectorModel(const Scene& scene)
    : constants(scene),
      scene_features(scene.features),
      internal_damping(scene.damping.internal),
      external_damping(scene.damping.external),
      kelvin_voigt(scene.damping.kelvin_voigt),
      down(scene.down),
      segments(static_cast<std::size_t>(scene.segments)) {
    if (internal_damping > 0 || external_damping > 0) features.damping = Damping::paper;
    if (kelvin_voigt > 0) features.damping = Damping::kelvin_voigt;
    for (const SectionProperties& segment : scene.mesh.segment)
        features.curved = features.curved || !segment.curvature.isZero(0);
}

namespace {

using Constants = DirectorConstants;

/// Half the area on the unit sphere of the triangle a, b, c, as the tangent of a small angle.
DRILLSTRAND_INLINE double half_triangle(const Triple& a, const Triple& b, const Triple& c) {
    const double volume = dot(a, cross(b, c));
    return volume / (1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// The change of twist that moving directors cause: area of the quadrilateral of the two directors
/// before and after. arctan x = x - x^3/3: steps turn directors by milliradians.
DRILLSTRAND_INLINE double swept_area(const Triple& a0, const Triple& b0, const Triple& b1,
                                     const Triple& a1) {
    const double x = half_triangle(a0, b0, b1);
    const double y = half_triangle(a0, b1, a1);
    return 2.0 * (x - x * x * x * (1.0 / 3.0) + y - y * y * y * (1.0 / 3.0));
}

DRILLSTRAND_INLINE Triple without(const Triple& v, const Triple& unit) {
    return combine(1.0, v, -dot(v, unit), unit);
}

template <Damping damping, bool curved>
DRILLSTRAND_KERNEL void segments_of_span(const DirectorModel& model, const BlockTable& state,
                                         BlockTable& segments, BlockSpan span, double drift) {
    const auto first = static_cast<std::ptrdiff_t>(span.begin * block_size);
    const std::size_t count = span.entries();
    const Constants& c = model.constants;
    const ConstRows x_a = rows_at(state, position, first);
    const ConstRows x_b = rows_at(state, position, first + 1);
    const ConstRows t_a = rows_at(state, director, first);
    const ConstRows t_b = rows_at(state, director, first + 1);
    const ConstRows last_a = rows_at(state, last_director, first);
    const ConstRows last_b = rows_at(state, last_director, first + 1);
    const double* spin_a = state.row(spin) + first;
    const double* spin_b = spin_a + 1;
    const ConstRows v_a = rows_at(state, velocity, first);
    const ConstRows v_b = rows_at(state, velocity, first + 1);
    const ConstRows w_a = rows_at(state, angular_velocity, first);
    const ConstRows w_b = rows_at(state, angular_velocity, first + 1);
    const ConstRows d1_a = rows_at(state, material, first);
    const ConstRows d1_b = rows_at(state, material, first + 1);
    double* twist = segments.row(SegmentRow::twist) + first;
    double* torque_out = segments.row(SegmentRow::torque) + first;
    double* viscous_torque = segments.row(SegmentRow::viscous_torque) + first;
    const Rows viscous_pull = rows_at(segments, SegmentRow::viscous_pull, first);
    const Rows viscous_couple = rows_at(segments, SegmentRow::viscous_couple, first);
    const Rows viscous_lean = rows_at(segments, SegmentRow::viscous_lean, first);
    const Rows pull = rows_at(segments, SegmentRow::pull, first);
    const Rows couple = rows_at(segments, SegmentRow::couple, first);
    const Rows lean = rows_at(segments, SegmentRow::lean, first);
    const Rows drag_force = rows_at(segments, SegmentRow::drag_force, first);
    const Rows drag_couple = rows_at(segments, SegmentRow::drag_couple, first);
    const Rows first_couple = rows_at(segments, SegmentRow::first_couple, first);
    const Rows last_couple = rows_at(segments, SegmentRow::last_couple, first);
    const double* length = c.row(Constants::length) + first;
    const double* inverse_length = c.row(Constants::inverse_length) + first;
    const double* torsion = c.row(Constants::torsion) + first;
    const double* bending = c.row(Constants::bending) + first;
    const double* axial = c.row(Constants::axial) + first;
    const double* shear = c.row(Constants::shear) + first;
    const double* twist0 = c.row(Constants::twist0) + first;
    const double* bend10 = c.row(Constants::bend10) + first;
    const double* bend20 = c.row(Constants::bend20) + first;
    const double kelvin_voigt = model.kelvin_voigt;
    const double internal_damping = model.internal_damping;

    const auto segment = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const double h = length[k];
        const double ih = inverse_length[k];
        const Triple ta = t_a[k];
        const Triple tb = t_b[k];

        // stretch and shear: D = dx / h, mean director m, g = D . m, sh = D - g m
        const Triple d = combine(ih, x_b[k], -ih, x_a[k]);
        const double cosine = dot(ta, tb);
        const double inverse_one = 1.0 / (1.0 + cosine);
        const double inverse_both = std::sqrt(0.5 * inverse_one);  // 1 / |t_k + t_k+1|
        const Triple m = combine(inverse_both, ta, inverse_both, tb);
        const double g = dot(d, m);
        const Triple sh = combine(1.0, d, -g, m);
        const double stretch_force = axial[k] * (g - 1.0);
        const Triple n = combine(stretch_force, m, shear[k], sh);
        const double w = h * (shear[k] * g - stretch_force) * inverse_both;

        // bending: kb = (b / sin b) (t_k x t_k+1) / h, from tan(b/2) = |t x t| / (1 + cos b)
        const Triple a = cross(ta, tb);
        const double half_tangent2 = dot(a, a) * inverse_one * inverse_one;
        const double factor = 2.0 * arctangent_ratio(half_tangent2) * inverse_one;
        const double bend = factor * ih;
        Triple bending_moment = scaled(bending[k] * bend, a);

        // twist: h tau += dt (s_k+1 - s_k) + swept area; torque about e = (t_k + t_k+1)/(1 + cos b)
        twist[k] +=
            ih * (drift * (spin_b[k] - spin_a[k]) + swept_area(last_a[k], last_b[k], tb, ta));
        double torque = torsion[k] * twist[k];
        if constexpr (curved) torque -= torsion[k] * twist0[k];

        if constexpr (curved) {
            // own shape: kappa = k1 d1 + k2 d2, the mean of both nodes'; m = EI (kb - kappa)
            const Triple a1 = d1_a[k];
            const Triple b1 = d1_b[k];
            const Triple a2 = cross(ta, a1);
            const Triple b2 = cross(tb, b1);
            const Triple kappa_a = combine(bend10[k], a1, bend20[k], a2);
            const Triple kappa_b = combine(bend10[k], b1, bend20[k], b2);
            const Triple kappa = combine(0.5, kappa_a, 0.5, kappa_b);
            const double ei = bending[k];
            const Triple moment = {ei * (bend * a.x - kappa.x), ei * (bend * a.y - kappa.y),
                                   ei * (bend * a.z - kappa.z)};
            // gradient of h m . kb: f = b / sin b of c = cos b, f' = (f c - 1) / |a|^2
            const double a2_norm = dot(a, a);
            const double slope = a2_norm > 1e-8 ? (factor * cosine - 1.0) / a2_norm : -1.0 / 3.0;
            const double along = slope * dot(moment, a);
            const Triple common = combine(factor * cosine, moment, -along, a);
            const Triple on_first = combine(1.0, common, -factor * dot(moment, ta), tb);
            const Triple on_last = combine(1.0, common, -factor * dot(moment, tb), ta);
            // gradient of -h m . kappa as the frames turn
            const Triple turn_a = cross(kappa_a, moment);
            const Triple turn_b = cross(kappa_b, moment);
            first_couple.set(k, combine(1.0, on_first, 0.5 * h, turn_a));
            last_couple.set(k, combine(-1.0, on_last, 0.5 * h, turn_b));
            bending_moment = {0.0, 0.0, 0.0};
        }
        if constexpr (damping != Damping::none) {
            // rates of strain from velocities: g' = dv/h - w x D, k' = dw/h
            const Triple wa = combine(1.0, w_a[k], spin_a[k], ta);
            const Triple wb = combine(1.0, w_b[k], spin_b[k], tb);
            const Triple mean = combine(0.5, wa, 0.5, wb);
            const Triple g_rate =
                combine(1.0, combine(ih, v_b[k], -ih, v_a[k]), -1.0, cross(mean, d));
            const Triple k_rate = combine(ih, wb, -ih, wa);
            drag_force.set(k, scaled(internal_damping, g_rate));
            drag_couple.set(k, scaled(internal_damping, k_rate));
            if constexpr (damping == Damping::kelvin_voigt) {
                const double g_along = dot(g_rate, m);
                const double stretching = kelvin_voigt * axial[k] * g_along;
                const double shearing = kelvin_voigt * shear[k];
                const double twisting = kelvin_voigt * torsion[k] * dot(k_rate, m);
                const Triple along_both = combine(1.0, ta, 1.0, tb);
                const Triple n_rate = combine(stretching - shearing * g_along, m, shearing, g_rate);
                viscous_pull.set(k, n_rate);
                viscous_lean.set(k, scaled(0.5 * h, cross(d, n_rate)));
                viscous_couple.set(k, combine(kelvin_voigt * bending[k], without(k_rate, m),
                                              twisting * inverse_one, along_both));
                viscous_torque[k] = twisting;
            }
        }
        const double t = torque * inverse_one;
        pull.set(k, n);
        couple.set(k, combine(1.0, bending_moment, t, combine(1.0, ta, 1.0, tb)));
        torque_out[k] = torque;
        lean.set(k, scaled(w, sh));
    };
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        segment(k);
}

/// What surrounds the nodes, as far as a kernel has to know.
enum class Around { nothing, wall, wall_paper_law, wall_and_mud, wall_and_mud_paper_law };

constexpr bool has_wall(Around around) {
    return around != Around::nothing;
}
constexpr bool has_mud(Around around) {
    return around == Around::wall_and_mud || around == Around::wall_and_mud_paper_law;
}
constexpr bool has_paper_law(Around around) {
    return around == Around::wall_paper_law || around == Around::wall_and_mud_paper_law;
}

template <Around around, Damping damping, bool curved>
DRILLSTRAND_KERNEL NodeStep nodes_of_span(const DirectorModel& model, const BlockTable& state,
                                          BlockTable& next, const BlockTable& segments,
                                          Surroundings& surroundings, BlockSpan span, double kick,
                                          double drift) {
    const auto first = static_cast<std::ptrdiff_t>(span.begin * block_size);
    const std::size_t count = span.entries();
    if (count == 0) return {};  // or the compiler would keep scalar loops for it
    const Constants& c = model.constants;
    const ConstRows x_in = rows_at(state, position, first);
    const ConstRows v_in = rows_at(state, velocity, first);
    const ConstRows t_in = rows_at(state, director, first);
    const ConstRows w_in = rows_at(state, angular_velocity, first);
    const ConstRows d1_in = rows_at(state, material, first);
    const double* spin_in = state.row(spin) + first;
    const Rows x_out = rows_at(next, position, first);
    const Rows v_out = rows_at(next, velocity, first);
    const Rows t_out = rows_at(next, director, first);
    const Rows w_out = rows_at(next, angular_velocity, first);
    const Rows last_out = rows_at(next, last_director, first);
    const Rows d1_out = rows_at(next, material, first);
    double* spin_out = next.row(spin) + first;
    const ConstRows pull_after = rows_at(segments, SegmentRow::pull, first);
    const ConstRows pull_before = rows_at(segments, SegmentRow::pull, first - 1);
    const ConstRows couple_after = rows_at(segments, SegmentRow::couple, first);
    const ConstRows couple_before = rows_at(segments, SegmentRow::couple, first - 1);
    const ConstRows lean_after = rows_at(segments, SegmentRow::lean, first);
    const ConstRows lean_before = rows_at(segments, SegmentRow::lean, first - 1);
    const double* torque_after = segments.row(SegmentRow::torque) + first;
    const double* torque_before = torque_after - 1;
    const ConstRows drag_force_before = rows_at(segments, SegmentRow::drag_force, first - 1);
    const ConstRows drag_couple_before = rows_at(segments, SegmentRow::drag_couple, first - 1);
    const ConstRows viscous_pull_after = rows_at(segments, SegmentRow::viscous_pull, first);
    const ConstRows viscous_pull_before = rows_at(segments, SegmentRow::viscous_pull, first - 1);
    const ConstRows viscous_couple_after = rows_at(segments, SegmentRow::viscous_couple, first);
    const ConstRows viscous_couple_before =
        rows_at(segments, SegmentRow::viscous_couple, first - 1);
    const ConstRows viscous_lean_after = rows_at(segments, SegmentRow::viscous_lean, first);
    const ConstRows viscous_lean_before = rows_at(segments, SegmentRow::viscous_lean, first - 1);
    const double* viscous_torque_after = segments.row(SegmentRow::viscous_torque) + first;
    const double* viscous_torque_before = viscous_torque_after - 1;
    const ConstRows first_couple = rows_at(segments, SegmentRow::first_couple, first);
    const ConstRows last_couple = rows_at(segments, SegmentRow::last_couple, first - 1);
    const double* inverse_cell = c.row(Constants::inverse_cell) + first;
    const double* mobile_cell = c.row(Constants::mobile_cell) + first;
    const double* mass = c.row(Constants::mass) + first;
    const double* inverse_mass = c.row(Constants::inverse_mass) + first;
    const double* polar = c.row(Constants::polar) + first;
    const double* inverse_polar = c.row(Constants::inverse_polar) + first;
    const double* transverse = c.row(Constants::transverse) + first;
    const double* inverse_transverse = c.row(Constants::inverse_transverse) + first;
    const double* weight = c.row(Constants::weight) + first;
    const Triple down = triple(model.down);
    const double external_damping = model.external_damping;

    using S = Surroundings;
    constexpr bool wall = has_wall(around);
    const auto s_row = [&](S::Row row) { return wall ? surroundings.row(row) + first : nullptr; };
    const ConstRows arc_start = {s_row(S::start_x), s_row(S::start_y), s_row(S::start_z)};
    const ConstRows arc_tangent = {s_row(S::tangent_x), s_row(S::tangent_y), s_row(S::tangent_z)};
    const ConstRows arc_normal = {s_row(S::normal_x), s_row(S::normal_y), s_row(S::normal_z)};
    const double* curvature = s_row(S::curvature);
    const double* hole = s_row(S::hole);
    const double* end_cosine = s_row(S::end_cosine);
    const double* reach = s_row(S::reach);
    const double* concentric_axial = s_row(S::concentric_axial);
    const double* pipe = s_row(S::pipe);
    const double* stiffness = s_row(S::stiffness);
    const double* dashpot = s_row(S::damping);
    double* elongation_axial = s_row(S::elongation_axial);
    double* elongation_azimuthal = s_row(S::elongation_azimuthal);
    double* sliding = s_row(S::sliding);
    double* depth = s_row(S::depth);
    double* normal_out = s_row(S::normal);
    double* leaves = s_row(S::leaves);
    const SurroundingsParameters& p = surroundings.parameters();
    const FrictionParameters friction = p.friction;
    const double least_normal = p.least_normal;
    const double viscosity = p.viscosity;
    const double film = p.film;
    const double eccentric_axial = p.eccentric_axial_drag ? 1.0 : 0.0;

    // between the loops of a block in a well: velocities and the well frame
    alignas(block_alignment) double hold[18][most_blocks_at_once * block_size];
    const Rows v_held = {hold[0], hold[1], hold[2]};
    const Rows v_rod_held = {hold[3], hold[4], hold[5]};
    const Rows r_held = {hold[6], hold[7], hold[8]};
    const Rows l_held = {hold[9], hold[10], hold[11]};
    double* s_held = hold[12];
    double* s_rod_held = hold[13];
    double* u_r = hold[14];
    double* u_l = hold[15];
    double* u_t = hold[16];
    double* eccentricity = hold[17];

    /// Directors follow angular velocities: t turned by dt Om, exactly of unit length.
    const auto turn = [&](std::size_t k, const Triple& w) DRILLSTRAND_LAMBDA {
        const Triple t = t_in[k];
        const double q = 0.25 * drift * drift * dot(w, w);
        const double inverse_q = 1.0 / (1.0 + q);
        w_out.set(k, w);
        t_out.set(k, combine((1.0 - q) * inverse_q, t, drift * inverse_q, cross(w, t)));
        last_out.set(k, t);
    };

    /// Positions follow velocities after all forces: x += dt v. The work of damping and
    /// surroundings is theirs times the mean of the velocities of both half steps.
    const auto move = [&](std::size_t k, const Triple& v, const Triple& v_rod, double s,
                          double s_rod) DRILLSTRAND_LAMBDA {
        NodeStep done;
        if constexpr (wall || damping != Damping::none) {
            const double work =
                mass[k] * dot(combine(1.0, v, -1.0, v_rod), combine(0.5, v_in[k], 0.5, v)) +
                polar[k] * (s - s_rod) * 0.5 * (spin_in[k] + s);
            done.outflow = -mobile_cell[k] * work;
        }
        done.faults = mobile_cell[k] > 0.0 && !(dot(v, v) + s * s < 1e20) ? 1.0 : 0.0;
        x_out.set(k, combine(1.0, x_in[k], drift, v));
        v_out.set(k, v);
        spin_out[k] = s;
        if constexpr (curved) {
            // d1 goes along with t by the shortest way, then turns about it by dt s
            const Triple t = t_in[k];
            const Triple moved = {t_out.x[k], t_out.y[k], t_out.z[k]};
            const Triple d1 = d1_in[k];
            const Triple sum = combine(1.0, t, 1.0, moved);
            const double onto = dot(d1, moved) / (1.0 + dot(t, moved));
            const Triple carried = combine(1.0, d1, -onto, sum);
            // Cayley's rotation, by the tangent of half the angle to its fifth power
            const double angle = drift * s;
            const double a2 = angle * angle;
            const double tangent = 0.5 * angle * (1.0 + a2 * (1.0 / 12.0) * (1.0 + a2 * 0.1));
            const double unit = 1.0 / (1.0 + tangent * tangent);
            d1_out.set(k, combine((1.0 - tangent * tangent) * unit, carried, 2.0 * tangent * unit,
                                  cross(moved, carried)));
        }
        return done;
    };

    /// Velocities after the forces of the rod, the weight and the damping.
    const auto predict = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const Triple t = t_in[k];
        const double ic = inverse_cell[k];
        const double to_velocity = kick * inverse_mass[k];
        const double to_spin = kick * inverse_polar[k];
        const double to_turning = kick * inverse_transverse[k];

        // rod: differences of the segments' forces over the cell
        Triple force = combine(ic, pull_after[k], -ic, pull_before[k]);
        const double mg = weight[k];
        force = combine(1.0, force, mg, down);
        const Triple leaning = cross(t, combine(ic, lean_after[k], ic, lean_before[k]));
        Triple couple = combine(ic, couple_after[k], -ic, couple_before[k]);
        couple = combine(1.0, couple, 1.0, leaning);
        double torque = ic * (torque_after[k] - torque_before[k]);
        if constexpr (curved) {
            const Triple own = combine(ic, first_couple[k], ic, last_couple[k]);
            couple = combine(1.0, couple, 1.0, own);
            torque += dot(own, t);
        }
        couple = without(couple, t);

        Triple v = combine(1.0, v_in[k], to_velocity, force);
        double s = spin_in[k] + to_spin * torque;

        // gyroscopic term, I dOm/dt = Ip s (t x Om): half with the velocities before the kick,
        // half, implicit, with those after, which keeps the angular momentum to rounding
        const double gyration = 0.5 * to_turning * polar[k];
        const double before = gyration * spin_in[k];
        const double after = gyration * s;
        Triple w = w_in[k];
        w = combine(1.0, w, before, cross(t, w));
        w = combine(1.0, w, to_turning, couple);
        const double settled = 1.0 / (1.0 + after * after);
        w = combine(settled, w, after * settled, cross(t, w));

        const Triple v_rod = v;
        const double s_rod = s;
        NodeStep done;
        if constexpr (damping != Damping::none) {
            // Kelvin-Voigt and D_in with the rates of the last half step, D_ex implicit. D_in moves
            // momentum toward the bit: rates of the segment on the head's side, since the mean of
            // both segments gains energy where it lags half a step behind
            const Triple w_rod = w;
            const Triple dragged = drag_force_before[k];
            const Triple turned = drag_couple_before[k];
            Triple resisting = scaled(-1.0, turned);
            Triple pulling = scaled(-1.0, dragged);
            double twisting = -dot(turned, t);
            if constexpr (damping == Damping::kelvin_voigt) {
                const Triple bending =
                    combine(ic, viscous_couple_after[k], -ic, viscous_couple_before[k]);
                const Triple shearing =
                    combine(ic, viscous_lean_after[k], ic, viscous_lean_before[k]);
                resisting = combine(1.0, resisting, 1.0, combine(1.0, bending, 1.0, shearing));
                pulling = combine(1.0, pulling, 1.0,
                                  combine(ic, viscous_pull_after[k], -ic, viscous_pull_before[k]));
                twisting += ic * (viscous_torque_after[k] - viscous_torque_before[k]);
            }
            v = combine(1.0, v, to_velocity, pulling);
            w = combine(1.0, w, to_turning, without(resisting, t));
            s += to_spin * twisting;
            v = scaled(1.0 / (1.0 + to_velocity * external_damping), v);
            w = scaled(1.0 / (1.0 + to_turning * external_damping), w);
            s *= 1.0 / (1.0 + to_spin * external_damping);
            const double work =
                transverse[k] * dot(combine(1.0, w, -1.0, w_rod), combine(0.5, w_in[k], 0.5, w));
            done.outflow = -mobile_cell[k] * work;
        }
        done.faults = mobile_cell[k] > 0.0 && !(dot(w, w) < 1e20) ? 1.0 : 0.0;
        turn(k, w);
        if constexpr (wall) {
            v_held.set(k, v);
            s_held[k] = s;
            s_rod_held[k] = s_rod;
            if constexpr (damping != Damping::none) v_rod_held.set(k, v_rod);
        } else {
            const NodeStep moved = move(k, v, v_rod, s, s_rod);
            done.outflow += moved.outflow;
            done.faults += moved.faults;
        }
        return done;
    };

    double outflow = 0.0;
    double faults = 0.0;
#pragma omp simd reduction(+ : outflow, faults)
    for (std::size_t k = 0; k < count; ++k) {
        const NodeStep done = predict(k);
        outflow += done.outflow;
        faults += done.faults;
    }
    if constexpr (!wall) {
        return {outflow, 0.0, 0.0, 0.0, faults};
    } else {
        /// Where the node is in the well, and how it moves there.
        struct Place {
            double leaves, touches, touched, impact;
        };
        const auto surround = [&](std::size_t k) DRILLSTRAND_LAMBDA {
            const ArcNumbers arc = {arc_start[k], arc_tangent[k], arc_normal[k], curvature[k],
                                    hole[k]};
            const WellFrame frame = well_frame(x_in[k], arc);
            const double dr = penetration(frame.eccentricity, hole[k], pipe[k]);
            const Triple v = {hold[0][k], hold[1][k], hold[2][k]};
            Place place;
            place.leaves = foot_leaves(frame, end_cosine[k], reach[k]) ? 1.0 : 0.0;
            place.touches = dr > 0.0 ? 1.0 : 0.0;
            place.touched = depth[k] > 0.0 ? 1.0 : 0.0;
            place.impact = place.touches * (1.0 - place.touched);
            leaves[k] = place.leaves;
            depth[k] = dr;
            eccentricity[k] = frame.eccentricity;
            r_held.set(k, frame.r);
            l_held.set(k, frame.l);
            u_r[k] = dot(v, frame.r);
            u_l[k] = dot(v, frame.l);
            u_t[k] = dot(v, frame.t);
            return place;
        };
        double leavers = 0.0;
        double touching = 0.0;
        double touched = 0.0;
        double impacts = 0.0;
#pragma omp simd reduction(+ : leavers, touching, touched, impacts)
        for (std::size_t k = 0; k < count; ++k) {
            const Place place = surround(k);
            leavers += place.leaves;
            touching += place.touches;
            touched += place.touched;
            impacts += place.impact;
        }

        // pressing and rubbing in two loops: what waits for the one does not hold up the other
        const auto press = [&](std::size_t k) DRILLSTRAND_LAMBDA {
            const Mobility mobility = {kick * inverse_mass[k], kick * inverse_polar[k]};
            const double approach = u_r[k] - circling_speed(eccentricity[k], u_t[k], kick);
            const double normal = implicit_normal_force(depth[k], approach, stiffness[k],
                                                        dashpot[k], least_normal, kick, mobility);
            normal_out[k] = normal;
            u_r[k] += mobility.translation * normal;
        };
        const auto rub = [&](std::size_t k) DRILLSTRAND_LAMBDA {
            const Mobility mobility = {kick * inverse_mass[k], kick * inverse_polar[k]};
            const WellVelocity u = {u_r[k], u_l[k], u_t[k], s_held[k]};
            const double dr = depth[k];
            const double normal = normal_out[k];
            const FrictionSpring spring = {{elongation_axial[k], elongation_azimuthal[k]},
                                           sliding[k]};
            const FrictionStep done =
                has_paper_law(around)
                    ? paper_step(spring, u, stiffness[k] * dr, dr, pipe[k], kick, mobility,
                                 friction)
                    : coulomb_step(spring, u, normal, dr, pipe[k], kick, mobility, friction);
            const double slip = done.spring.sliding > sliding[k] ? 1.0 : 0.0;
            elongation_axial[k] = done.spring.elongation.axial;
            elongation_azimuthal[k] = done.spring.elongation.azimuthal;
            sliding[k] = done.spring.sliding;
            u_l[k] = u.l + mobility.translation * done.force.axial;
            u_t[k] = u.t + mobility.translation * done.force.azimuthal;
            s_held[k] = u.spin + mobility.rotation * pipe[k] * done.force.azimuthal;
            return slip;
        };
        double slips = 0.0;
        const bool contact = touching + touched > 0.0;
        if (contact) {
#pragma omp simd
            for (std::size_t k = 0; k < count; ++k)
                press(k);
#pragma omp simd reduction(+ : slips)
            for (std::size_t k = 0; k < count; ++k)
                slips += rub(k);
        }

        if constexpr (has_mud(around)) {
            const auto wade = [&](std::size_t k) DRILLSTRAND_LAMBDA {
                const Mobility mobility = {kick * inverse_mass[k], kick * inverse_polar[k]};
                const double held = drag_eccentricity(eccentricity[k], pipe[k], hole[k], film);
                const DragCoefficients drag = drag_coefficients(held, pipe[k], hole[k]);
                const double axial = eccentric_axial * drag.axial + concentric_axial[k];
                // nodes in contact get no fluid force (paper)
                const WellVelocity after =
                    implicit_drag({u_r[k], u_l[k], u_t[k], s_held[k]}, drag, axial,
                                  depth[k] > 0.0 ? 0.0 : viscosity, mobility);
                u_r[k] = after.r;
                u_l[k] = after.l;
                u_t[k] = after.t;
                s_held[k] = after.spin;
            };
            if (touching < static_cast<double>(count)) {
#pragma omp simd
                for (std::size_t k = 0; k < count; ++k)
                    wade(k);
            }
        }

        const auto rod_velocity = [&](std::size_t k) DRILLSTRAND_LAMBDA {
            constexpr std::size_t row = damping == Damping::none ? 0 : 3;
            return Triple{hold[row][k], hold[row + 1][k], hold[row + 2][k]};
        };
        const auto leave = [&](std::size_t k) DRILLSTRAND_LAMBDA {
            // changes along r, l and t, on the velocity before them
            const Triple r = {hold[6][k], hold[7][k], hold[8][k]};
            const Triple l = {hold[9][k], hold[10][k], hold[11][k]};
            const Triple t = cross(r, l);
            const Triple before = {hold[0][k], hold[1][k], hold[2][k]};
            const Triple v_rod = rod_velocity(k);
            Triple v = combine(1.0, before, u_r[k] - dot(before, r), r);
            v = combine(1.0, v, u_l[k] - dot(before, l), l);
            v = combine(1.0, v, u_t[k] - dot(before, t), t);
            return move(k, v, v_rod, s_held[k], s_rod_held[k]);
        };
        const auto pass = [&](std::size_t k) DRILLSTRAND_LAMBDA {
            const Triple v = {hold[0][k], hold[1][k], hold[2][k]};
            return move(k, v, rod_velocity(k), s_held[k], s_rod_held[k]);
        };
        if (has_mud(around) || contact) {
#pragma omp simd reduction(+ : outflow, faults)
            for (std::size_t k = 0; k < count; ++k) {
                const NodeStep done = leave(k);
                outflow += done.outflow;
                faults += done.faults;
            }
        } else {
#pragma omp simd reduction(+ : outflow, faults)
            for (std::size_t k = 0; k < count; ++k) {
                const NodeStep done = pass(k);
                outflow += done.outflow;
                faults += done.faults;
            }
        }
        return {outflow, impacts, slips, leavers, faults};
    }
}

using SegmentKernel = void (*)(const DirectorModel&, const BlockTable&, BlockTable&, BlockSpan,
                               double);
using NodeKernel = NodeStep (*)(const DirectorModel&, const BlockTable&, BlockTable&,
                                const BlockTable&, Surroundings&, BlockSpan, double, double);

template <Damping damping>
SegmentKernel segment_kernel_damped(bool curved) {
    return curved ? segments_of_span<damping, true> : segments_of_span<damping, false>;
}

SegmentKernel segment_kernel(const DirectorFeatures& features) {
    switch (features.damping) {
        case Damping::none:
            return segment_kernel_damped<Damping::none>(features.curved);
        case Damping::paper:
            return segment_kernel_damped<Damping::paper>(features.curved);
        default:
            return segment_kernel_damped<Damping::kelvin_voigt>(features.curved);
    }
}

template <Around around, Damping damping>
NodeKernel node_kernel_damped(bool curved) {
    return curved ? nodes_of_span<around, damping, true> : nodes_of_span<around, damping, false>;
}

template <Around around>
NodeKernel node_kernel_around(const DirectorFeatures& features) {
    switch (features.damping) {
        case Damping::none:
            return node_kernel_damped<around, Damping::none>(features.curved);
        case Damping::paper:
            return node_kernel_damped<around, Damping::paper>(features.curved);
        default:
            return node_kernel_damped<around, Damping::kelvin_voigt>(features.curved);
    }
}

NodeKernel node_kernel(const DirectorModel& model, const SurroundingsParameters& p) {
    const bool paper = p.friction.cone < 0.5;
    if (!model.scene_features.well) return node_kernel_around<Around::nothing>(model.features);
    if (model.scene_features.drag)
        return paper ? node_kernel_around<Around::wall_and_mud_paper_law>(model.features)
                     : node_kernel_around<Around::wall_and_mud>(model.features);
    return paper ? node_kernel_around<Around::wall_paper_law>(model.features)
                 : node_kernel_around<Around::wall>(model.features);
}

}  // namespace

void director_segments(const DirectorModel& model, const BlockTable& state, BlockTable& segments,
                       BlockSpan span, double drift) {
    segment_kernel(model.features)(model, state, segments, span, drift);
}

NodeStep director_nodes(const DirectorModel& model, const BlockTable& state, BlockTable& next,
                        const BlockTable& segments, Surroundings& surroundings, BlockSpan span,
                        double kick, double drift) {
    return node_kernel(model, surroundings.parameters())(model, state, next, segments, surroundings,
                                                         span, kick, drift);
}

}  // namespace drillstrand
