#include "support/plain_wall.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace drillstrand::test {

PlainWall plain_wall(const Scene& scene, const Eigen::Vector3d& point) {
    const std::size_t number = scene.well->find_arc(point, 0);
    const WellArc& arc = scene.well->arcs()[number];
    PlainWall wall;
    wall.section = scene.well->project(point, number);
    const double angle = arc.curvature * (wall.section.measured_depth - arc.measured_depth_start);
    const double distance = wall.section.measured_depth - arc.measured_depth_start;
    const double along = arc.curvature > 0 ? std::sin(angle) / arc.curvature : distance;
    // the foot is faster than the point by the ratio of their distances from the centre
    double nearer = 1;
    if (arc.curvature > 0) {
        const Eigen::Vector3d centre = arc.start + arc.normal / arc.curvature;
        const Eigen::Vector3d across = arc.tangent.cross(arc.normal).normalized();
        const Eigen::Vector3d arm = point - centre;
        nearer = 1 / (arc.curvature * (arm - arm.dot(across) * across).norm());
    }
    const double per_way = std::cos(angle) * nearer;
    wall.lean = arc.widening * per_way;
    wall.firmness = arc.firmness + arc.firming * along;
    wall.firming = arc.firming * per_way;
    if (scene.contact.restitution) wall.damping = std::sqrt(arc.firmness);
    wall.static_friction = scene.section_friction[arc.section].fixed;
    wall.dynamic_friction = scene.section_friction[arc.section].slide;
    return wall;
}

ContactCase contact_at(const Scene& scene, const PlainWall& wall) {
    ContactCase contact = scene.contact;
    contact.static_friction = wall.static_friction;
    contact.dynamic_friction = wall.dynamic_friction;
    return contact;
}

}  // namespace drillstrand::test
