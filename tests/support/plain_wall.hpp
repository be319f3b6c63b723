/// The wall of the well at a point, with trigonometry: what plain twins of kernels use.
#pragma once

#include <Eigen/Core>

#include "drillstrand/scene.hpp"

namespace drillstrand::test {

struct PlainWall {
    WellCrossSection section;
    double lean = 0;      ///< growth of the radius as the point moves along the well
    double firmness = 1;  ///< stiffness over that of [contact]
    double firming = 0;   ///< its growth along the well (1/m)
    double damping = 1;   ///< over that of [contact]
    FrictionCoefficients static_friction, dynamic_friction;
};

PlainWall plain_wall(const Scene& scene, const Eigen::Vector3d& point);

/// The contact of a scene with the friction of that wall.
ContactCase contact_at(const Scene& scene, const PlainWall& wall);

}  // namespace drillstrand::test
