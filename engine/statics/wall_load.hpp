/// Force of the wall on a node in steady motion, and its derivatives: engine/statics/README.md,
/// "Wall".
#pragma once

#include <Eigen/Core>

#include "drillstrand/case.hpp"
#include "drillstrand/equilibrium.hpp"
#include "drillstrand/well.hpp"
#include "statics/rod_segment.hpp"

namespace drillstrand {

/// Parts of the normal force that rub along the well and around it, against the motion.
struct FrictionShares {
    double axial = 0;
    double azimuthal = 0;
};

/// Friction of a surface of this radius (m) that moves steadily: on the cone of the dynamic
/// coefficients, against the velocity of the surface.
FrictionShares friction_shares(const FrictionCoefficients& dynamic, const SteadyMotion& motion,
                               double radius);

/// A node at the wall.
struct WallSite {
    const WellArc* arc;
    Eigen::Vector3d position;  ///< m
    Eigen::Vector3d director;
    double pipe_radius;  ///< m
    double stiffness;    ///< k_el of a wall of firmness 1 times the cell (N/m)
    double stiffest;     ///< bound of the wall's stiffness times the cell (N/m)
    NormalLaw law;       ///< of the wall's spring; hertz: K for k_el
    FrictionShares friction;
};

/// Zero in the open hole.
struct WallLoad {
    Vector6 load = Vector6::Zero();                      ///< force (N) and couple (N m)
    Eigen::Vector3d friction = Eigen::Vector3d::Zero();  ///< part of the force (N)
    double couple = 0;                                   ///< of friction, about the director (N m)
    double energy = 0;                                   ///< of the wall's spring (J)
    double stiffness = 0;                                ///< growth of the force with depth (N/m)
};

WallLoad wall_load(const WallSite& site);

/// Derivative of the load by displacement and rotation of the node; zero in the open hole.
Matrix6 wall_tangent(const WallSite& site);

}  // namespace drillstrand
