/// The wall around the nodes as kernels see it, from an entry on: constants of the surroundings,
/// the arcs of well that the nodes are in, and what a step changes.
#pragma once

#include <cstddef>
#include <utility>

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
          end_cosine(wall.row(WallRow::end_cosine) + first),
          reach(wall.row(WallRow::reach) + first),
          concentric_axial(wall.row(WallRow::concentric_axial) + first),
          pipe(surroundings.row(Surroundings::pipe) + first),
          stiffness(surroundings.row(Surroundings::stiffness) + first),
          dashpot(surroundings.row(Surroundings::damping) + first),
          elongation_axial(wall.row(WallRow::elongation_axial) + first),
          elongation_azimuthal(wall.row(WallRow::elongation_azimuthal) + first),
          sliding(wall.row(WallRow::sliding) + first),
          depth(wall.row(WallRow::depth) + first),
          normal(wall.row(WallRow::normal) + first),
          slip_axial(wall.row(WallRow::slip_axial) + first),
          slip_azimuthal(wall.row(WallRow::slip_azimuthal) + first),
          leaves(wall.row(WallRow::leaves) + first) {}

    ConstTriples start{}, tangent{}, normal_to_axis{};
    const double *curvature = nullptr, *hole = nullptr, *end_cosine = nullptr, *reach = nullptr,
                 *concentric_axial = nullptr, *pipe = nullptr, *stiffness = nullptr,
                 *dashpot = nullptr;
    double *elongation_axial = nullptr, *elongation_azimuthal = nullptr, *sliding = nullptr,
           *depth = nullptr, *normal = nullptr, *slip_axial = nullptr, *slip_azimuthal = nullptr,
           *leaves = nullptr;

    DRILLSTRAND_INLINE ArcNumbers arc(std::size_t k) const {
        return {start[k], tangent[k], normal_to_axis[k], curvature[k], hole[k]};
    }
    DRILLSTRAND_INLINE FrictionSpring spring(std::size_t k) const {
        return {{elongation_axial[k], elongation_azimuthal[k]}, sliding[k]};
    }
};

}  // namespace drillstrand
