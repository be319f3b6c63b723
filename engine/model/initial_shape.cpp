#include "model/initial_shape.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

#include "rod/pose.hpp"

namespace drillstrand {

namespace {

/// Strain that turns the section by the shortest way until d3 points along `direction`, over a
/// length h: bending only.
Vector6 bend_toward(const Pose& pose, const Eigen::Vector3d& direction, double h) {
    const Eigen::Vector3d d3 = pose.frame.col(0);
    const Eigen::Vector3d axis = d3.cross(direction);
    const double sine = axis.norm();
    const double angle = std::atan2(sine, d3.dot(direction));
    Vector6 strain;
    strain << Eigen::Vector3d::Zero(), 1, 0, 0;
    if (sine > 0) strain.head<3>() = pose.frame.transpose() * axis * (angle / sine / h);
    return strain;
}

/// Segments that bend like the well but neither stretch nor shear cannot keep every node on the
/// axis where its curvature changes within a segment. Each segment therefore ends not quite along
/// the well but tilted toward the axis, by a part of what would cancel the node's offset over one
/// segment: offsets then stay of the order of c h^2/16 and die out within a few segments.
std::vector<Vector6> strains_along(const Well& well, const StringMesh& mesh, const Pose& head) {
    constexpr double correction = 0.3;
    std::vector<Vector6> strains;
    Pose pose = head;
    const double mouth = well.measured_depth_start();
    std::size_t arc = well.arc_at(mouth);
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const double h = mesh.length[k];
        arc = well.find_arc(pose.position, arc);
        const Eigen::Vector3d to_axis = well.project(pose.position, arc).axis - pose.position;
        const Eigen::Vector3d ahead = well.at(mouth + mesh.node_s[k + 1]).direction;
        const Eigen::Vector3d direction = (ahead + correction / h * to_axis).normalized();
        strains.push_back(bend_toward(pose, direction, h));
        pose = poses_from_strains(pose, {h}, {strains.back()}).back();
    }
    return strains;
}

/// Straight, or bent to the string's own shape.
std::vector<Vector6> strains_without_well(const Scene& scene, InitialState state) {
    std::vector<Vector6> strains;
    for (const SectionProperties& segment : scene.mesh.segment) {
        Vector6 strain;
        strain << Eigen::Vector3d::Zero(), 1, 0, 0;
        if (state == InitialState::stress_free) strain.head<3>() = segment.curvature;
        strains.push_back(strain);
    }
    return strains;
}

}  // namespace

std::vector<Vector6> initial_strains(const Scene& scene, const InitialCase& initial) {
    const bool along_well = scene.well && initial.state == InitialState::coaxial;
    std::vector<Vector6> strains =
        along_well ? strains_along(*scene.well, scene.mesh, {scene.head_frame, scene.head_position})
                   : strains_without_well(scene, initial.state);
    for (Vector6& strain : strains)
        strain.head<3>() += initial.curvature;
    return strains;
}

}  // namespace drillstrand
