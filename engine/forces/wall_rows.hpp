/// The wall around the nodes as kernels see it, from an entry on: constants of the surroundings,
/// the arcs of well that the nodes are in, and what a step changes.
#pragma once

#include <cstddef>
#include <utility>

#include "forces/added_mass.hpp"
#include "forces/fluid.hpp"
#include "forces/surroundings.hpp"
#include "forces/well_frame.hpp"
#include "state/rows.hpp"

namespace drillstrand {

struct WallRows {
    /// Nothing to read or write.
    WallRows() = default;
    WallRows(const Surroundings& surroundings, Table<WallRow>& wall, std::ptrdiff_t first)
        : start(std::as_const(wall).triples(WallRow::start, first)),
          tangent(std::as_const(wall).triples(WallRow::tangent, first)),
          normal_to_axis(std::as_const(wall).triples(WallRow::normal_to_axis, first)),
          curvature(wall.row(WallRow::curvature) + first),
          hole(wall.row(WallRow::hole) + first),
          stiffness(wall.row(WallRow::stiffness) + first),
          end_cosine(wall.row(WallRow::end_cosine) + first),
          reach(wall.row(WallRow::reach) + first),
          concentric_axial(wall.row(WallRow::concentric_axial) + first),
          cross_flow(wall.row(WallRow::cross_flow) + first),
          swirl(wall.row(WallRow::swirl) + first),
          swirl_reynolds(wall.row(WallRow::swirl_reynolds) + first),
          stream(wall.row(WallRow::stream) + first),
          pipe(surroundings.row(Surroundings::pipe) + first),
          body(surroundings.row(Surroundings::body) + first),
          inside(surroundings.row(Surroundings::inside) + first),
          displaced(surroundings.row(Surroundings::displaced) + first),
          mud_load(surroundings.row(Surroundings::mud_load) + first),
          mud_speed(surroundings.row(Surroundings::mud_speed) + first),
          mud_shear(surroundings.row(Surroundings::mud_shear) + first),
          axial_thinning(surroundings.row(Surroundings::axial_thinning) + first),
          spin_thinning(surroundings.row(Surroundings::spin_thinning) + first),
          dashpot(wall.row(WallRow::damping) + first),
          elongation_axial(wall.row(WallRow::elongation_axial) + first),
          elongation_azimuthal(wall.row(WallRow::elongation_azimuthal) + first),
          sliding(wall.row(WallRow::sliding) + first),
          depth(wall.row(WallRow::depth) + first),
          normal(wall.row(WallRow::normal) + first),
          slip_axial(wall.row(WallRow::slip_axial) + first),
          slip_azimuthal(wall.row(WallRow::slip_azimuthal) + first),
          rolling(wall.row(WallRow::rolling) + first),
          fluid_mass(wall.row(WallRow::fluid_mass) + first),
          leaves(wall.row(WallRow::leaves) + first),
          rebounds(wall.row(WallRow::rebounds) + first) {}

    ConstTriples start{}, tangent{}, normal_to_axis{};
    const double *curvature = nullptr, *hole = nullptr, *stiffness = nullptr, *end_cosine = nullptr,
                 *reach = nullptr, *concentric_axial = nullptr, *cross_flow = nullptr,
                 *swirl = nullptr, *swirl_reynolds = nullptr, *stream = nullptr, *pipe = nullptr,
                 *body = nullptr, *inside = nullptr, *displaced = nullptr, *mud_load = nullptr,
                 *mud_speed = nullptr, *mud_shear = nullptr, *axial_thinning = nullptr,
                 *spin_thinning = nullptr, *dashpot = nullptr;
    double *elongation_axial = nullptr, *elongation_azimuthal = nullptr, *sliding = nullptr,
           *depth = nullptr, *normal = nullptr, *slip_axial = nullptr, *slip_azimuthal = nullptr,
           *rolling = nullptr, *fluid_mass = nullptr, *leaves = nullptr, *rebounds = nullptr;

    DRILLSTRAND_INLINE ArcNumbers arc(std::size_t k) const {
        return {start[k], tangent[k], normal_to_axis[k], curvature[k], hole[k]};
    }
    DRILLSTRAND_INLINE FlowInertia flow(std::size_t k) const {
        return {cross_flow[k], swirl[k], swirl_reynolds[k], stream[k]};
    }
    DRILLSTRAND_INLINE MudAround mud(std::size_t k) const {
        return {mud_load[k], mud_speed[k], mud_shear[k], axial_thinning[k], spin_thinning[k]};
    }
    DRILLSTRAND_INLINE double flow_radius_at(std::size_t k) const {
        return flow_radius(body[k], hole[k]);
    }
    /// The annulus at a node that is eccentric, with its film.
    DRILLSTRAND_INLINE Annulus annulus(std::size_t k, double eccentricity, double film) const {
        const double flowed_by = flow_radius_at(k);
        return {film_eccentricity(eccentricity, flowed_by, hole[k], film), flowed_by, hole[k]};
    }
    /// Added mass of the annulus at a node (kg/m), and its slope over the eccentricity.
    DRILLSTRAND_INLINE AddedMass annulus_mass(std::size_t k, const Annulus& annulus,
                                              double eccentricity) const {
        const AddedMass added = added_mass(annulus, eccentricity);
        return {displaced[k] * added.coefficient, displaced[k] * added.slope};
    }
    DRILLSTRAND_INLINE FrictionSpring spring(std::size_t k) const {
        return {{elongation_axial[k], elongation_azimuthal[k]}, sliding[k]};
    }
};

/// A wall that is the same all along the well. Kernels have a version for each of both kinds: what
/// does not vary costs nothing.
struct EvenWall {
    static constexpr bool varies = false;
    EvenWall(const Table<WallRow>& /*wall*/, std::ptrdiff_t /*first*/) {}
};

/// A wall whose radius, stiffness or friction vary along the well.
struct VaryingWall {
    static constexpr bool varies = true;
    VaryingWall(Table<WallRow>& wall, std::ptrdiff_t first)
        : hole_start(wall.row(WallRow::hole_start) + first),
          widening(wall.row(WallRow::widening) + first),
          stiffness_start(wall.row(WallRow::stiffness_start) + first),
          stiffening(wall.row(WallRow::stiffening) + first),
          static_axial(wall.row(WallRow::static_axial) + first),
          static_azimuthal(wall.row(WallRow::static_azimuthal) + first),
          dynamic_axial(wall.row(WallRow::dynamic_axial) + first),
          dynamic_azimuthal(wall.row(WallRow::dynamic_azimuthal) + first),
          hole(wall.row(WallRow::hole) + first),
          stiffness(wall.row(WallRow::stiffness) + first) {}

    const double *hole_start, *widening, *stiffness_start, *stiffening, *static_axial,
        *static_azimuthal, *dynamic_axial, *dynamic_azimuthal;
    double *hole, *stiffness;

    /// How radius and stiffness grow along l.
    struct Slopes {
        double hole, stiffness;
    };
    /// Writes radius and stiffness at the node into their rows.
    DRILLSTRAND_INLINE Slopes vary(std::size_t k, const WellFrame& frame) const {
        const AlongArc radius = along_arc(frame, hole_start[k], widening[k]);
        const AlongArc firmness = along_arc(frame, stiffness_start[k], stiffening[k]);
        hole[k] = radius.value;
        stiffness[k] = firmness.value;
        return {radius.slope, firmness.slope};
    }
    /// The friction of the section that the node is in.
    DRILLSTRAND_INLINE FrictionParameters friction(std::size_t k,
                                                   const FrictionParameters& shared) const {
        return shared.with({static_axial[k], static_azimuthal[k]},
                           {dynamic_axial[k], dynamic_azimuthal[k]});
    }
};

}  // namespace drillstrand
