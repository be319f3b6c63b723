/// What a tool in the string records in its own turning axes (engine/rod/README.md, "Sensors").
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "drillstrand/case.hpp"
#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

/// How a section moves, space frame.
struct SectionMotion {
    Eigen::Matrix3d frame;                 ///< d3, d1, d2 in the columns
    Eigen::Vector3d acceleration;          ///< of its centre (m/s2)
    Eigen::Vector3d rotation;              ///< rad/s
    Eigen::Vector3d angular_acceleration;  ///< rad/s2
};

/// Where a sensor is: in a segment, at a share of the way from its first to its last node.
struct SensorPlace {
    SensorPlace(const StringMesh& mesh, const SensorCase& sensor);

    std::size_t segment;
    double share;
};

/// Between two sections: their mean, weighted by nearness.
SectionMotion motion_between(const SectionMotion& first, const SectionMotion& last, double share);

/// All but the time. `stress` of the segment, in body axes.
SensorRecord sensor_record(const Scene& scene, const SensorCase& sensor,
                           const SectionMotion& motion, const Vector6& stress);

}  // namespace drillstrand
