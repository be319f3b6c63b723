#include "statics/wall_load.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forces/contact.hpp"
#include "statics/skew.hpp"
#include "statics/well_section.hpp"

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The wall as a node meets it: an energy k depth^2/2 of its place, or 2/5 k depth^2.5.
struct Wall {
    NormalLaw law;
    double depth;       ///< m; negative in the open hole
    double stiffness;   ///< k, times the cell (N/m)
    double lean;        ///< growth of the hole's radius along l
    double stiffening;  ///< growth of k along l (N/m2)

    /// Normal force (N) of a spring of stiffness k, growth of the force (N/m), energy (J).
    [[nodiscard]] double force(double k) const { return secant_stiffness(law, k, depth) * depth; }
    [[nodiscard]] double tangent() const { return tangent_stiffness(law, stiffness, depth); }
    [[nodiscard]] double energy(double k) const {
        return 0.5 * energy_stiffness(law, k, depth) * depth * depth;
    }

    /// Against the growth of the depth.
    [[nodiscard]] Vector3d normal(const WellSection& section) const {
        return section.r + lean * section.l;
    }
};

/// How the growth along l of what grows by `growth` along the arc changes with the place.
Vector3d change_of_growth(const WellSection& section, const WellArc& arc, double growth) {
    const WellFrame& frame = section.frame;
    return growth * section.turning * frame.inverse * frame.inverse *
           (frame.toward * section.inward - frame.along * arc.curvature * section.l);
}

Wall wall_at(const WallSite& site, const WellSection& section) {
    const AlongArc hole = along_arc(section.frame, site.arc->radius, site.arc->widening);
    const AlongArc firmness = along_arc(section.frame, site.arc->firmness, site.arc->firming);
    const double own = site.stiffness * firmness.value;
    return {site.law, penetration(section.eccentricity, hole.value, site.pipe_radius),
            std::min(own, site.stiffest), hole.slope,
            own < site.stiffest ? site.stiffness * firmness.slope : 0.0};
}

}  // namespace

FrictionShares friction_shares(const FrictionCoefficients& dynamic, const SteadyMotion& motion,
                               double radius) {
    const FrictionCoefficients& mu = dynamic;
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
    const Wall wall = wall_at(site, s);
    const double depth = wall.depth;
    if (depth <= 0) return result;
    const double normal = wall.force(wall.stiffness);
    const Vector3d push = normal * wall.normal(s) - wall.energy(wall.stiffening) * s.l;
    result.friction = -normal * (site.friction.axial * s.l + site.friction.azimuthal * s.t);
    result.couple = -normal * site.pipe_radius * site.friction.azimuthal;
    result.load << push + result.friction, result.couple * site.director;
    result.energy = wall.energy(wall.stiffness);
    result.stiffness = wall.tangent();
    return result;
}

Matrix6 wall_tangent(const WallSite& site) {
    Matrix6 d = Matrix6::Zero();
    const WellSection s = well_section(site.position, *site.arc);
    const Wall wall = wall_at(site, s);
    const double depth = wall.depth;
    if (depth <= 0) return d;
    const double normal = wall.force(wall.stiffness);
    const double tangent = wall.tangent();
    const FrictionShares& rub = site.friction;

    // the penetration grows by -normal . dx, the stiffness by stiffening l . dx; the section turns
    // by `turning` l . dx about its own t axis
    const Matrix3d dr = -s.turning * s.r.dot(s.inward) * s.l * s.l.transpose() -
                        s.t * s.t.transpose() / s.eccentricity;
    const Matrix3d dl = s.l_by_position();
    Matrix3d dt;
    for (Eigen::Index i = 0; i < 3; ++i)
        dt.col(i) = dr.col(i).cross(s.l) + s.r.cross(dl.col(i));
    const Vector3d inward = wall.normal(s);
    const Vector3d direction = inward - rub.axial * s.l - rub.azimuthal * s.t;
    d.topLeftCorner<3, 3>() = -tangent * direction * inward.transpose() +
                              normal * (dr + (wall.lean - rub.axial) * dl - rub.azimuthal * dt);

    const double arm = site.pipe_radius * rub.azimuthal;
    const Vector3d& axis = site.director;
    d.bottomLeftCorner<3, 3>() = tangent * arm * axis * inward.transpose();
    d.bottomRightCorner<3, 3>() = normal * arm * skew(axis);
    if (site.arc->widening == 0 && wall.stiffening == 0) return d;

    const Vector3d stiffening = wall.force(wall.stiffening) * s.l;
    const Vector3d leaning = change_of_growth(s, *site.arc, normal * site.arc->widening);
    const double firming = wall.stiffening == 0 ? 0.0 : site.stiffness * site.arc->firming;
    const Vector3d softening = change_of_growth(s, *site.arc, -wall.energy(1) * firming);
    d.topLeftCorner<3, 3>() += direction * stiffening.transpose() +
                               stiffening * inward.transpose() - wall.energy(wall.stiffening) * dl +
                               s.l * (leaning + softening).transpose();
    d.bottomLeftCorner<3, 3>() -= arm * axis * stiffening.transpose();
    return d;
}

}  // namespace drillstrand
