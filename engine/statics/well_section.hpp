/// The cross section of the well at a point, with what turns it when the point moves.
#pragma once

#include <Eigen/Core>

#include "drillstrand/well.hpp"
#include "forces/well_frame.hpp"

namespace drillstrand {

struct WellSection {
    WellFrame frame;
    Eigen::Vector3d r, l, t;  ///< as in WellFrame (engine/forces/well_frame.hpp)
    Eigen::Vector3d inward;   ///< unit, toward the centre of the bend
    double turning;           ///< turn of the section per displacement along l (1/m)
    double eccentricity;      ///< distance of the point from the axis (m)

    /// How l changes with the point (1/m): l turns toward `inward` as the point moves along l.
    [[nodiscard]] Eigen::Matrix3d l_by_position() const { return turning * inward * l.transpose(); }
};

WellSection well_section(const Eigen::Vector3d& point, const WellArc& arc);

}  // namespace drillstrand
