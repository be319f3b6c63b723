#include <cmath>

#include "forces/fluid.hpp"
#include "forces/implicit_contact.hpp"
#include "forces/wall_rows.hpp"
#include "model/pose.hpp"
#include "numerics/ordered_sum.hpp"
#include "rod/director.hpp"
#include "rod/director_rows.hpp"

namespace drillstrand {

namespace {

/// What surrounds the nodes, as far as a kernel has to know. Mud drags as in creeping flow,
/// streaming mud by its inertia as well, flowing mud thins, yields or is pumped besides.
enum class Around { nothing, wall, mud, streaming_mud, flowing_mud };

/// Of nodes in a well: the velocity and the spin after the rod's forces and the damping (`v`, `s`)
/// and after the rod's alone (`v_rod`, `s_rod`), r and l of the well frame, the velocity in it
/// (`u`), the eccentricity, what a force across the well does to the velocity (`across`: kick over
/// the mass that moves sideways), 1 where the node came to the wall since the last step (`came`),
/// the annulus around it, the mass of the fluid that goes along and its slope, the drag of creeping
/// flow. Where the wall varies along the well, how its radius and stiffness grow down the well:
/// what touches it needs them before the drag is there, whose lines they have.
using Held = HeldLines<31>;
struct HeldRows {
    explicit HeldRows(Held& held)
        : v(held.triples(0)),
          v_rod(held.triples(3)),
          r(held.triples(6)),
          l(held.triples(9)),
          s(held.line[12]),
          s_rod(held.line[13]),
          u_r(held.line[14]),
          u_l(held.line[15]),
          u_t(held.line[16]),
          eccentricity(held.line[17]),
          across(held.line[18]),
          fluid_mass(held.line[19]),
          came(held.line[20]),
          annulus_spread(held.line[21]),
          annulus_sinh(held.line[22]),
          annulus_cosh(held.line[23]),
          annulus_distance(held.line[24]),
          fluid_slope(held.line[25]),
          drag_radial(held.line[26]),
          drag_axial(held.line[27]),
          drag_around(held.line[28]),
          drag_cross(held.line[29]),
          drag_spin(held.line[30]),
          widening(held.line[26]),
          stiffening(held.line[27]) {}
    Triples v, v_rod, r, l;
    double *s, *s_rod, *u_r, *u_l, *u_t, *eccentricity, *across, *fluid_mass, *came,
        *annulus_spread, *annulus_sinh, *annulus_cosh, *annulus_distance, *fluid_slope,
        *drag_radial, *drag_axial, *drag_around, *drag_cross, *drag_spin, *widening, *stiffening;
};

/// The forces of the rod on its nodes, and their motion.
template <bool wall, bool heavy, Damping damping, bool curved>
struct RodNodes {
    RodNodes(const DirectorModel& model, const Table<DirectorRow>& rod, Table<DirectorRow>& next,
             const Table<SegmentRow>& segments, std::ptrdiff_t first, double kick_s, double drift_s)
        : c(model.constants, first),
          in(rod, first),
          out(next, first),
          after(segments, first),
          before(segments, first - 1),
          down(triple(model.down)),
          external_damping(model.external_damping),
          kick(kick_s),
          drift(drift_s) {}

    NodeConstants c;
    NodesIn in;
    NodesOut out;
    SegmentsIn after, before;  ///< the segments on the bit's and on the head's side
    Triple down;
    DampingPair external_damping;
    double kick, drift;

    DRILLSTRAND_INLINE void turn(std::size_t k, const Triple& w) const {
        const Triple t = in.t[k];
        out.w.set(k, w);
        out.t.set(k, turned_director(t, w, drift));
        out.last_t.set(k, t);
        out.last_twist[k] = after.twist[k];
    }

    DRILLSTRAND_INLINE void turn_material(std::size_t k, double s) const {
        out.d1.set(k, turned_material(in.d1[k], in.t[k], at(out.t, k), drift * s));
    }

    /// Positions follow velocities after all forces: x += dt v. The work of damping and
    /// surroundings is theirs times the mean of the velocities of both half steps.
    DRILLSTRAND_INLINE NodeStep move(std::size_t k, const Triple& v, const Triple& v_rod, double s,
                                     double s_rod, const HeldRows& held) const {
        NodeStep done;
        if constexpr (wall || damping != Damping::none) {
            const Triple change = combine(1.0, v, -1.0, v_rod);
            const Triple mean = combine(0.5, in.v[k], 0.5, v);
            double work =
                c.mass[k] * dot(change, mean) + c.polar[k] * (s - s_rod) * 0.5 * (in.s[k] + s);
            if constexpr (heavy) {
                const Triple l = at(held.l, k);
                work += held.fluid_mass[k] * (dot(change, mean) - dot(change, l) * dot(mean, l));
            }
            done.outflow = -c.mobile_cell[k] * work;
        }
        if constexpr (curved) {
            const double along = 0.5 * dot(in.d1[k], combine(1.0, in.v[k], 1.0, v));
            done.outflow -= c.mobile_cell[k] * kick * centrifugal(k) * along;
        }
        done.faults = c.mobile_cell[k] > 0.0 && !(dot(v, v) + s * s < 1e20) ? 1.0 : 0.0;
        out.x.set(k, combine(1.0, in.x[k], drift, v));
        out.v.set(k, v);
        out.s[k] = s;
        if constexpr (curved) turn_material(k, s);
        return done;
    }

    /// Force of an eccentric mass along d1 (N/m). Its power is the drive's, whose torque for it is
    /// left out.
    DRILLSTRAND_INLINE double centrifugal(std::size_t k) const {
        return c.unbalance[k] * in.s[k] * in.s[k];
    }

    /// Velocities after the forces of the rod, the weight and the damping; moves the node, or
    /// leaves that to what surrounds it.
    DRILLSTRAND_INLINE NodeStep predict(std::size_t k, const HeldRows& held) const {
        const Triple t = in.t[k];
        const double ic = c.inverse_cell[k];
        const double to_velocity = kick * c.inverse_mass[k];
        const double to_spin = kick * c.inverse_polar[k];
        const double to_turning = kick * c.inverse_transverse[k];

        const auto [pulled, couple, torque] = rod_load<curved>(after, before, t, ic, k);
        Triple force = combine(1.0, pulled, c.weight[k], down);
        if constexpr (curved) force = combine(1.0, force, centrifugal(k), in.d1[k]);

        Triple v = combine(1.0, in.v[k], to_velocity, force);
        double s = in.s[k] + to_spin * torque;

        // gyroscopic term, I dOm/dt = Ip s (t x Om): half with the velocities before the kick,
        // half, implicit, with those after, which keeps the angular momentum to rounding
        const double gyration = 0.5 * to_turning * c.polar[k];
        const double gyration_before = gyration * in.s[k];
        const double gyration_after = gyration * s;
        Triple w = in.w[k];
        w = combine(1.0, w, gyration_before, cross(t, w));
        w = combine(1.0, w, to_turning, couple);
        const double settled = 1.0 / (1.0 + gyration_after * gyration_after);
        w = combine(settled, w, gyration_after * settled, cross(t, w));

        const Triple v_rod = v;
        const double s_rod = s;
        NodeStep done;
        if constexpr (damping != Damping::none) {
            // Kelvin-Voigt and D_in with the rates of the last half step, D_ex implicit. D_in moves
            // momentum toward the bit: rates of the segment on the head's side, since the mean of
            // both segments gains energy where it lags half a step behind
            const Triple w_rod = w;
            const Triple dragged = before.drag_force[k];
            const Triple turned = before.drag_couple[k];
            Triple resisting = scaled(-1.0, turned);
            Triple pulling = scaled(-1.0, dragged);
            double twisting = -dot(turned, t);
            if constexpr (damping == Damping::kelvin_voigt) {
                const RodLoad viscous = viscous_load(after, before, ic, k);
                resisting = combine(1.0, resisting, 1.0, viscous.couple);
                pulling = combine(1.0, pulling, 1.0, viscous.force);
                twisting += viscous.torque;
            }
            v = combine(1.0, v, to_velocity, pulling);
            w = combine(1.0, w, to_turning, without(resisting, t));
            s += to_spin * twisting;
            v = scaled(1.0 / (1.0 + to_velocity * external_damping.translation), v);
            w = scaled(1.0 / (1.0 + to_turning * external_damping.rotation), w);
            s *= 1.0 / (1.0 + to_spin * external_damping.rotation);
            const double work =
                c.transverse[k] * dot(combine(1.0, w, -1.0, w_rod), combine(0.5, in.w[k], 0.5, w));
            done.outflow = -c.tilting_cell[k] * work;
        }
        done.faults = c.tilting_cell[k] > 0.0 && !(dot(w, w) < 1e20) ? 1.0 : 0.0;
        turn(k, w);
        if constexpr (wall) {
            held.v.set(k, v);
            held.s[k] = s;
            held.s_rod[k] = s_rod;
            if constexpr (damping != Damping::none) held.v_rod.set(k, v_rod);
        } else {
            const NodeStep moved = move(k, v, v_rod, s, s_rod, held);
            done.outflow += moved.outflow;
            done.faults += moved.faults;
        }
        return done;
    }
};

/// What walls and mud do to the held velocities of nodes in a well. Where it is `heavy`, fluid
/// moves sideways with the pipe; where it is `damped`, so are their impulses.
template <bool heavy, bool damped>
struct WellNodes {
    WellNodes(const DirectorModel& model, Table<WallRow>& table, const NodeConstants& constants,
              const NodesIn& nodes, const HeldRows& held, std::ptrdiff_t first, double kick_s,
              double drift_s)
        : c(constants),
          in(nodes),
          wall(model.surroundings, table, first),
          h(held),
          kick(kick_s),
          drift(drift_s),
          external_damping(model.external_damping),
          friction(model.surroundings.parameters().friction),
          thinning(model.surroundings.parameters().thinning),
          least_normal(model.surroundings.parameters().least_normal),
          restitution(model.surroundings.parameters().restitution),
          normal_law(model.surroundings.parameters().normal_law),
          hunt_crossley(model.surroundings.parameters().hunt_crossley),
          viscosity(model.surroundings.parameters().viscosity),
          film(model.surroundings.parameters().film),
          wet_in_contact(model.surroundings.parameters().contact_drag ? 1.0 : 0.0),
          eccentric_axial(model.surroundings.parameters().eccentric_axial_drag ? 1.0 : 0.0) {}

    NodeConstants c;
    NodesIn in;
    WallRows wall;
    HeldRows h;
    double kick, drift;
    DampingPair external_damping;
    FrictionParameters friction;
    Thinning thinning;
    double least_normal, restitution;
    NormalLaw normal_law;
    double hunt_crossley, viscosity, film, wet_in_contact, eccentric_axial;

    /// D_ex, which is implicit, takes its part of what walls and mud give: without that a node at
    /// rest would need less of the wall the longer the step.
    DRILLSTRAND_INLINE Mobility mobility(std::size_t k) const {
        const double along = kick * c.inverse_mass[k];
        const double across = heavy ? h.across[k] : along;
        const double rotation = kick * c.inverse_polar[k];
        if constexpr (!damped) return {across, along, rotation};
        const double kept = 1.0 / (1.0 + along * external_damping.translation);
        return {kept * across, kept * along,
                rotation / (1.0 + rotation * external_damping.rotation)};
    }

    /// Where the node is in the well.
    struct Place {
        double leaves, touches, touched, impact;
    };
    /// Finds its place, and, where no fluid goes along, its velocity in the well.
    template <class Wall>
    DRILLSTRAND_INLINE Place surround(std::size_t k, const Wall& varying) const {
        const WellFrame frame = well_frame(in.x[k], wall.arc(k));
        if constexpr (Wall::varies) {
            const auto slopes = varying.vary(k, frame);
            h.widening[k] = slopes.hole;
            h.stiffening[k] = slopes.stiffness;
        }
        const double dr = penetration(frame.eccentricity, wall.hole[k], wall.pipe[k]);
        Place place;
        place.leaves = foot_leaves(frame, wall.end_cosine[k], wall.reach[k]) ? 1.0 : 0.0;
        place.touches = dr > 0.0 ? 1.0 : 0.0;
        place.touched = wall.depth[k] > 0.0 ? 1.0 : 0.0;
        place.impact = place.touches * (1.0 - place.touched);
        wall.leaves[k] = place.leaves;
        wall.depth[k] = dr;
        h.eccentricity[k] = frame.eccentricity;
        h.came[k] = place.impact;
        h.r.set(k, frame.r);
        h.l.set(k, frame.l);
        if constexpr (!heavy) project(k);
        return place;
    }

    /// Its velocity along the directions of the well.
    DRILLSTRAND_INLINE void project(std::size_t k) const {
        const Triple v = at(h.v, k);
        const Triple r = at(h.r, k);
        const Triple l = at(h.l, k);
        h.u_r[k] = dot(v, r);
        h.u_l[k] = dot(v, l);
        h.u_t[k] = dot(v, cross(r, l));
    }

    /// The annulus around it.
    DRILLSTRAND_INLINE void enclose(std::size_t k) const {
        const Annulus annulus = wall.annulus(k, h.eccentricity[k], film);
        h.annulus_spread[k] = annulus.spread;
        h.annulus_sinh[k] = annulus.sinh;
        h.annulus_cosh[k] = annulus.cosh;
        h.annulus_distance[k] = annulus.distance;
    }

    /// The fluid around it and in it.
    DRILLSTRAND_INLINE void weigh_fluid(std::size_t k) const {
        const AddedMass added = wall.annulus_mass(k, annulus(k), h.eccentricity[k]);
        h.fluid_mass[k] = wall.inside[k] + added.coefficient;
        h.fluid_slope[k] = added.slope;
    }

    /// Sideways the forces until now moved the fluid too: of the change of velocity that the pipe
    /// alone would have had, it has the part m / M, M = m + fluid. Where M changes with the place,
    /// the fluid exerts v^2 grad M / 2 - v dM/dt, here at the mean of the velocities before and
    /// after the other forces.
    DRILLSTRAND_INLINE void take_fluid_along(std::size_t k) const {
        const Triple r = at(h.r, k);
        const Triple l = at(h.l, k);
        const Triple t = cross(r, l);
        const double fluid = h.fluid_mass[k];
        const double inverse = 1.0 / (c.mass[k] + fluid);
        const double kept = fluid * inverse;
        const Triple before = in.v[k];
        const auto slowed = [&](const Triple& v) {
            const Triple change = combine(1.0, v, -1.0, before);
            const Triple across = combine(1.0, change, -dot(change, l), l);
            return combine(1.0, v, -kept, across);
        };
        const Triple v_rod = slowed(damped ? at(h.v_rod, k) : at(h.v, k));
        const double v_r = 0.5 * (dot(before, r) + dot(v_rod, r));
        const double v_t = 0.5 * (dot(before, t) + dot(v_rod, t));
        const double rate = kick * h.fluid_slope[k] * inverse;
        // bounded, should a node be faster than the fluid can go out of its way
        const double gain = rate / (1.0 + std::abs(rate) * std::sqrt(v_r * v_r + v_t * v_t));
        const double by_r = 0.5 * gain * (v_r * v_r - v_t * v_t);
        const double by_t = gain * v_r * v_t;
        const Triple push = combine(by_r, r, by_t, t);
        if constexpr (damped) {
            h.v.set(k, combine(1.0, slowed(at(h.v, k)), 1.0, push));
            h.v_rod.set(k, combine(1.0, v_rod, 1.0, push));
        } else {
            h.v.set(k, combine(1.0, v_rod, 1.0, push));
        }
        h.across[k] = kick * inverse;
        wall.fluid_mass[k] = fluid;
        project(k);
    }

    /// Where the wall varies, its normal leans: it also pushes the node to where the hole is wide
    /// and the wall soft.
    template <bool varied_wall, NormalLaw law>
    DRILLSTRAND_INLINE void press(std::size_t k) const {
        const Mobility m = mobility(k);
        const double lean = varied_wall ? h.widening[k] : 0.0;
        Mobility leaning = m;
        double speed = h.u_r[k];
        if constexpr (varied_wall) {
            leaning.across += lean * lean * m.along;
            speed += lean * h.u_l[k];
        }
        // positions go straight on for a drift: none where a whole step is looked at
        const double approach = speed - circling_speed(h.eccentricity[k], h.u_t[k], drift);
        const double normal =
            law == NormalLaw::hertz
                ? implicit_hertz_force(wall.depth[k], approach, wall.stiffness[k], hunt_crossley,
                                       least_normal, kick, leaning)
                : implicit_normal_force(wall.depth[k], approach, wall.stiffness[k], wall.dashpot[k],
                                        least_normal, kick, leaning);
        wall.normal[k] = normal;
        h.u_r[k] += m.across * normal;
        if constexpr (varied_wall) {
            const double depth = wall.depth[k] > 0.0 ? wall.depth[k] : 0.0;
            const double stiffening = energy_stiffness(law, h.stiffening[k], depth);
            h.u_l[k] += m.along * (lean * normal - 0.5 * stiffening * depth * depth);
        }
    }

    /// Impact with the restitution that the case asks for, in closed form: a collision may be over
    /// sooner than a step can tell. A node that comes to the wall is sent back with e times its
    /// speed, before or after the rod's kick, whichever is less: the wall then only takes energy.
    /// The step took it into the wall without work against its springs: on its way out these do no
    /// more than hold it and let it out gently, or they would give what they never took.
    template <bool varied_wall>
    DRILLSTRAND_INLINE void rebound(std::size_t k) const {
        constexpr double gentle = 0.05;  // of the depth in a step
        const Mobility m = mobility(k);
        const double pressed = wall.normal[k];
        const double star_r = h.u_r[k] - m.across * pressed;
        double across = m.across;
        double star = star_r;
        double coming = -dot(in.v[k], at(h.r, k));
        if constexpr (varied_wall) {
            const double lean = h.widening[k];
            across += lean * lean * m.along;
            star += lean * (h.u_l[k] - m.along * lean * pressed);
            coming -= lean * dot(in.v[k], at(h.l, k));
        }
        const double least = coming < -star ? coming : -star;
        const double speed = least > 0.0 ? least : 0.0;
        const bool bounces = h.came[k] * speed > 0.0;
        const double out = gentle * wall.depth[k] - kick * star;
        // who comes out faster than that is not held: that would be work of the wall
        const bool held = out > 0.0 && kick * coming > -2.0 * gentle * wall.depth[k];
        const double holding = held ? out / (kick * across) : 0.0;
        const bool passed = h.came[k] + wall.rebounds[k] > 0.0;
        const bool inside = wall.depth[k] > 0.0 && passed && holding < pressed;
        const double rest = inside ? holding : pressed;
        const double normal = bounces ? (restitution * speed - star) / across : rest;
        wall.normal[k] = normal;
        wall.rebounds[k] = bounces || inside ? 1.0 : 0.0;
        h.u_r[k] = star_r + m.across * normal;
        if constexpr (varied_wall) h.u_l[k] += m.along * h.widening[k] * (normal - pressed);
    }

    /// 1 where the node began to slide. The contact rolls with the velocity of the step before:
    /// that of a node that sticks is then none, whatever pulls at it. So does the surface slip
    /// where friction `falls` with its speed.
    template <FrictionLaw law, bool falls, class Wall>
    DRILLSTRAND_INLINE double rub(std::size_t k, const Wall& varying) const {
        const Mobility m = mobility(k);
        FrictionParameters its = friction;
        if constexpr (Wall::varies) its = varying.friction(k, friction);
        const WellVelocity u = {h.u_r[k], h.u_l[k], h.u_t[k], h.s[k]};
        const double dr = wall.depth[k];
        const double normal = wall.normal[k];
        const FrictionSpring spring = wall.spring(k);
        const double around = dot(in.v[k], cross(at(h.r, k), at(h.l, k)));
        if constexpr (falls) {
            const double along = dot(in.v[k], at(h.l, k));
            const double surface = around + wall.pipe[k] * in.s[k];
            its = its.at_speed2(along * along + surface * surface);
        }
        const double rolled = kick * rolling_speed(around, h.eccentricity[k], wall.hole[k]);
        const FrictionStep done =
            law == FrictionLaw::paper
                ? paper_step(spring, u, wall.stiffness[k] * dr, dr, rolled, wall.pipe[k], kick, m,
                             its)
                : coulomb_step(spring, u, normal, dr, rolled, wall.pipe[k], kick, m, its);
        const double slip = done.spring.sliding > wall.sliding[k] ? 1.0 : 0.0;
        wall.elongation_axial[k] = done.spring.elongation.axial;
        wall.elongation_azimuthal[k] = done.spring.elongation.azimuthal;
        wall.sliding[k] = done.spring.sliding;
        h.u_l[k] = u.l + m.along * done.force.axial;
        h.u_t[k] = u.t + m.across * done.force.azimuthal;
        h.s[k] = u.spin + m.rotation * wall.pipe[k] * done.force.azimuthal;
        return slip;
    }

    /// The annulus around the node: fluid that goes along knows it already.
    DRILLSTRAND_INLINE Annulus annulus(std::size_t k) const {
        if constexpr (!heavy) return wall.annulus(k, h.eccentricity[k], film);
        const double pipe = wall.flow_radius_at(k);
        return {film_eccentricity(h.eccentricity[k], pipe, wall.hole[k], film),
                pipe,
                wall.hole[k],
                h.annulus_spread[k],
                h.annulus_sinh[k],
                h.annulus_cosh[k],
                h.annulus_distance[k]};
    }

    /// What creeping flow does to it, of mud that flows per unit viscosity.
    template <Around around>
    DRILLSTRAND_INLINE void creep(std::size_t k) const {
        DragCoefficients drag = drag_coefficients(annulus(k));
        drag.axial = eccentric_axial * drag.axial + wall.concentric_axial[k];
        if constexpr (around != Around::flowing_mud) drag = scaled(drag, viscosity);
        h.drag_radial[k] = drag.radial;
        h.drag_axial[k] = drag.axial;
        h.drag_around[k] = drag.around;
        h.drag_cross[k] = drag.cross;
        h.drag_spin[k] = drag.spin;
    }

    /// Drag of the whole flow. Flowing mud pushes first, and is as viscous as the node's velocity
    /// then makes it.
    template <Around around>
    DRILLSTRAND_INLINE void wade(std::size_t k) const {
        DragCoefficients drag = {h.drag_radial[k], h.drag_axial[k], h.drag_around[k],
                                 h.drag_cross[k], h.drag_spin[k]};
        WellVelocity u = {h.u_r[k], h.u_l[k], h.u_t[k], h.s[k]};
        const double pipe = wall.flow_radius_at(k);
        if constexpr (around == Around::streaming_mud) {
            drag = with_inertia(drag, wall.flow(k), pipe, std::sqrt(u.r * u.r + u.t * u.t), u.l,
                                u.spin);
        }
        if constexpr (around == Around::flowing_mud) {
            const MudAround mud = wall.mud(k);
            u.l += mobility(k).along * mud.load;
            drag = flowing_drag(drag, wall.flow(k), mud, thinning, pipe, wall.hole[k], u.r, u.l,
                                u.t, u.spin);
        }
        drag = around_wall(drag, h.eccentricity[k], pipe, wall.hole[k], film, wet_in_contact);
        const WellVelocity after = implicit_drag(u, drag, mobility(k));
        h.u_r[k] = after.r;
        h.u_l[k] = after.l;
        h.u_t[k] = after.t;
        h.s[k] = after.spin;
    }

    /// The velocity in space: changes along r, l and t, on the velocity before them.
    DRILLSTRAND_INLINE Triple velocity(std::size_t k) const {
        const Triple r = at(h.r, k);
        const Triple l = at(h.l, k);
        const Triple t = cross(r, l);
        const Triple before = at(h.v, k);
        Triple v = combine(1.0, before, h.u_r[k] - dot(before, r), r);
        v = combine(1.0, v, h.u_l[k] - dot(before, l), l);
        return combine(1.0, v, h.u_t[k] - dot(before, t), t);
    }
};

/// How many nodes of a span leave their arc, touch the wall, touched it before and came to it.
struct Met {
    double leavers, touching, touched, impacts;
};

template <class Wall, class Well>
DRILLSTRAND_INLINE Met surround_nodes(const Well& well, const Wall& wall, std::size_t count) {
    double leavers = 0.0;
    double touching = 0.0;
    double touched = 0.0;
    double impacts = 0.0;
#pragma omp simd reduction(+ : leavers, touching, touched, impacts)
    for (std::size_t k = 0; k < count; ++k) {
        const auto place = well.surround(k, wall);
        leavers += place.leaves;
        touching += place.touches;
        touched += place.touched;
        impacts += place.impact;
    }
    return {leavers, touching, touched, impacts};
}

template <FrictionLaw law, bool falls, class Wall, class Well>
DRILLSTRAND_INLINE double rub_nodes(const Well& well, const Wall& wall, std::size_t count) {
    double slips = 0.0;
#pragma omp simd reduction(+ : slips)
    for (std::size_t k = 0; k < count; ++k)
        slips += well.template rub<law, falls>(k, wall);
    return slips;
}

template <class Wall, NormalLaw law, class Well>
DRILLSTRAND_INLINE void press_nodes(const Well& well, std::size_t count) {
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        well.template press<Wall::varies, law>(k);
}
/// By the law of the wall; that of a wall which does not vary is linear.
template <class Wall, class Well>
DRILLSTRAND_INLINE void press_nodes(const Well& well, std::size_t count) {
    if constexpr (Wall::varies) {
        if (well.normal_law == NormalLaw::hertz)
            return press_nodes<Wall, NormalLaw::hertz>(well, count);
    }
    press_nodes<Wall, NormalLaw::linear>(well, count);
}

/// Pressing and rubbing in two loops: what waits for the one does not hold up the other. Returns
/// how many nodes began to slide.
template <class Wall, class Well>
DRILLSTRAND_INLINE double touch_wall(const Well& well, const Wall& wall, std::size_t count) {
    press_nodes<Wall>(well, count);
    if (well.restitution >= 0.0) {
#pragma omp simd
        for (std::size_t k = 0; k < count; ++k)
            well.template rebound<Wall::varies>(k);
    }
    if (well.friction.law == FrictionLaw::paper)
        return rub_nodes<FrictionLaw::paper, false>(well, wall, count);
    if constexpr (Wall::varies) {
        if (well.friction.inverse_speed2 > 0.0)
            return rub_nodes<FrictionLaw::coulomb, true>(well, wall, count);
    }
    return rub_nodes<FrictionLaw::coulomb, false>(well, wall, count);
}

template <Around around, bool heavy, Damping damping, bool curved>
DRILLSTRAND_KERNEL NodeStep nodes_of_span(const DirectorModel& model, const Table<DirectorRow>& rod,
                                          Table<DirectorRow>& next,
                                          const Table<SegmentRow>& segments, Table<WallRow>& wall,
                                          BlockSpan span, double kick, double drift) {
    const auto first = static_cast<std::ptrdiff_t>(span.begin * block_size);
    const std::size_t count = span.entries();
    if (count == 0) return {};  // or the compiler would keep scalar loops for it
    constexpr bool in_well = around != Around::nothing;
    constexpr bool damped = damping != Damping::none;
    Held scratch;
    const HeldRows held(scratch);
    const RodNodes<in_well, heavy, damping, curved> nodes(model, rod, next, segments, first, kick,
                                                          drift);

    // sums of counts are exact in any order, that of energies is not
    alignas(block_alignment) double outflow[most_blocks_at_once * block_size];
    double faults = 0.0;
#pragma omp simd reduction(+ : faults)
    for (std::size_t k = 0; k < count; ++k) {
        const NodeStep done = nodes.predict(k, held);
        outflow[k] = done.outflow;
        faults += done.faults;
    }
    if constexpr (!in_well) {
        return {ordered_sum(outflow, count), 0.0, 0.0, 0.0, faults};
    } else {
        const WellNodes<heavy, damped> well(model, wall, nodes.c, nodes.in, held, first, kick,
                                            drift);
        const bool varied_wall = model.features.varied_wall;
        const Met met = varied_wall ? surround_nodes(well, VaryingWall(wall, first), count)
                                    : surround_nodes(well, EvenWall(wall, first), count);
        if constexpr (heavy) {
#pragma omp simd
            for (std::size_t k = 0; k < count; ++k)
                well.enclose(k);
#pragma omp simd
            for (std::size_t k = 0; k < count; ++k)
                well.weigh_fluid(k);
#pragma omp simd
            for (std::size_t k = 0; k < count; ++k)
                well.take_fluid_along(k);
        }

        double slips = 0.0;
        const bool contact = met.touching + met.touched > 0.0;
        if (contact) {
            slips = varied_wall ? touch_wall(well, VaryingWall(wall, first), count)
                                : touch_wall(well, EvenWall(wall, first), count);
        }

        constexpr bool in_mud = around != Around::wall;
        if constexpr (in_mud) {
            // mud that flows pushes what touches, too
            if (around == Around::flowing_mud || well.wet_in_contact > 0.0 ||
                met.touching < static_cast<double>(count)) {
#pragma omp simd
                for (std::size_t k = 0; k < count; ++k)
                    well.template creep<around>(k);
#pragma omp simd
                for (std::size_t k = 0; k < count; ++k)
                    well.template wade<around>(k);
            }
        }

        const Triples& v_rod = damped ? held.v_rod : held.v;
        if (in_mud || contact) {
#pragma omp simd reduction(+ : faults)
            for (std::size_t k = 0; k < count; ++k) {
                const NodeStep done =
                    nodes.move(k, well.velocity(k), at(v_rod, k), held.s[k], held.s_rod[k], held);
                outflow[k] += done.outflow;
                faults += done.faults;
            }
        } else {
#pragma omp simd reduction(+ : faults)
            for (std::size_t k = 0; k < count; ++k) {
                const NodeStep done =
                    nodes.move(k, at(held.v, k), at(v_rod, k), held.s[k], held.s_rod[k], held);
                outflow[k] += done.outflow;
                faults += done.faults;
            }
        }
        return {ordered_sum(outflow, count), met.impacts, slips, met.leavers, faults};
    }
}

using NodeKernel = NodeStep (*)(const DirectorModel&, const Table<DirectorRow>&,
                                Table<DirectorRow>&, const Table<SegmentRow>&, Table<WallRow>&,
                                BlockSpan, double, double);

template <Around around, bool heavy>
NodeKernel node_kernel_around(const DirectorModel& model) {
    return with_features(
        model.features, [level = model.level](auto damping, auto curved) -> NodeKernel {
            return at_level<nodes_of_span<around, heavy, damping(), curved()>>(level);
        });
}

template <bool heavy>
NodeKernel node_kernel_in_well(const DirectorModel& model) {
    const SceneFeatures& features = model.features;
    if (!features.drag) return node_kernel_around<Around::wall, heavy>(model);
    if (features.flowing_mud) return node_kernel_around<Around::flowing_mud, heavy>(model);
    return features.inertial_flow ? node_kernel_around<Around::streaming_mud, heavy>(model)
                                  : node_kernel_around<Around::mud, heavy>(model);
}

NodeKernel node_kernel(const DirectorModel& model) {
    const SceneFeatures& features = model.features;
    if (!features.well) return node_kernel_around<Around::nothing, false>(model);
    return features.fluid_mass ? node_kernel_in_well<true>(model)
                               : node_kernel_in_well<false>(model);
}

}  // namespace

NodeStep director_nodes(const DirectorModel& model, const Table<DirectorRow>& rod,
                        Table<DirectorRow>& next, const Table<SegmentRow>& segments,
                        Table<WallRow>& wall, BlockSpan span, double kick, double drift) {
    return node_kernel(model)(model, rod, next, segments, wall, span, kick, drift);
}

}  // namespace drillstrand
