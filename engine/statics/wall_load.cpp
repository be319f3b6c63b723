#include "statics/wall_load.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "forces/contact.hpp"
#include "statics/skew.hpp"
#include "statics/well_section.hpp"

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double depth_of(const WallSite& site, const WellSection& section) {
    return penetration(section.eccentricity, site.arc->radius, site.pipe_radius);
}

}  // namespace

FrictionShares friction_shares(const ContactCase& contact, const SteadyMotion& motion,
                               double radius) {
    const FrictionCoefficients& mu = contact.dynamic_friction;
    const double along = mu.axial > 0 ? motion.axial_speed : 0.0;
    const double around = mu.azimuthal > 0 ? motion.rotation_rate * radius : 0.0;
    const double demand = std::hypot(mu.axial > 0 ? along / mu.axial : 0.0,
                                     mu.azimuthal > 0 ? around / mu.azimuthal : 0.0);
    if (demand == 0) return {};
    return {along / demand, around / demand};
}

WallLoad wall_load(const WallSite& site) {
    WallLoad result;
    const WellSection s = well_section(site.position, *site.arc);
    const double depth = depth_of(site, s);
    if (depth <= 0) return result;
    const double normal = site.stiffness * depth;
    result.friction = -normal * (site.friction.axial * s.l + site.friction.azimuthal * s.t);
    result.couple = -normal * site.pipe_radius * site.friction.azimuthal;
    result.load << normal * s.r + result.friction, result.couple * site.director;
    result.energy = 0.5 * normal * depth;
    return result;
}

Matrix6 wall_tangent(const WallSite& site) {
    Matrix6 d = Matrix6::Zero();
    const WellSection s = well_section(site.position, *site.arc);
    const double depth = depth_of(site, s);
    if (depth <= 0) return d;
    const double normal = site.stiffness * depth;
    const FrictionShares& rub = site.friction;

    // the penetration grows by -r . dx; the section turns by `turning` l . dx about its own t axis
    const Matrix3d dr = -s.turning * s.r.dot(s.inward) * s.l * s.l.transpose() -
                        s.t * s.t.transpose() / s.eccentricity;
    const Matrix3d dl = s.l_by_position();
    Matrix3d dt;
    for (Eigen::Index i = 0; i < 3; ++i)
        dt.col(i) = dr.col(i).cross(s.l) + s.r.cross(dl.col(i));
    const Vector3d direction = s.r - rub.axial * s.l - rub.azimuthal * s.t;
    d.topLeftCorner<3, 3>() = -site.stiffness * direction * s.r.transpose() +
                              normal * (dr - rub.axial * dl - rub.azimuthal * dt);

    const double arm = site.pipe_radius * rub.azimuthal;
    const Vector3d& axis = site.director;
    d.bottomLeftCorner<3, 3>() = site.stiffness * arm * axis * s.r.transpose();
    d.bottomRightCorner<3, 3>() = normal * arm * skew(axis);
    return d;
}

}  // namespace drillstrand
