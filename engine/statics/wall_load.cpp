#include "statics/wall_load.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "forces/contact.hpp"
#include "forces/well_frame.hpp"
#include "statics/skew.hpp"

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The well frame as vectors, with what its derivatives need.
struct Section {
    explicit Section(const WallSite& site) {
        const WellArc& arc = *site.arc;
        const WellFrame frame =
            well_frame(triple(site.position), {triple(arc.start), triple(arc.tangent),
                                               triple(arc.normal), arc.curvature, arc.radius});
        r = vector(frame.r);
        l = vector(frame.l);
        t = vector(frame.t);
        eccentricity = frame.eccentricity;
        depth = penetration(frame.eccentricity, arc.radius, site.pipe_radius);
        const double a_c = frame.along * arc.curvature;
        const double rho = std::hypot(a_c, frame.toward);
        inward = (frame.toward * arc.normal - a_c * arc.tangent) / rho;
        turning = arc.curvature / rho;
    }
    Vector3d r, l, t;
    Vector3d inward;      ///< toward the centre of the bend
    double turning;       ///< turn of the section per displacement along l (1/m)
    double eccentricity;  ///< m
    double depth;         ///< penetration (m)
};

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
    const Section s(site);
    if (s.depth <= 0) return result;
    const double normal = site.stiffness * s.depth;
    result.friction = -normal * (site.friction.axial * s.l + site.friction.azimuthal * s.t);
    result.couple = -normal * site.pipe_radius * site.friction.azimuthal;
    result.load << normal * s.r + result.friction, result.couple * site.director;
    result.energy = 0.5 * normal * s.depth;
    return result;
}

Matrix6 wall_tangent(const WallSite& site) {
    Matrix6 d = Matrix6::Zero();
    const Section s(site);
    if (s.depth <= 0) return d;
    const double normal = site.stiffness * s.depth;
    const FrictionShares& rub = site.friction;

    // the penetration grows by -r . dx; the section turns by `turning` l . dx about its own t axis
    const Matrix3d dr = -s.turning * s.r.dot(s.inward) * s.l * s.l.transpose() -
                        s.t * s.t.transpose() / s.eccentricity;
    const Matrix3d dl = s.turning * s.inward * s.l.transpose();
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
