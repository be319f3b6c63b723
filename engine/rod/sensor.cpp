#include "rod/sensor.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace drillstrand {

using Eigen::Vector3d;

SensorPlace::SensorPlace(const StringMesh& mesh, const SensorCase& sensor) {
    const auto& s = mesh.node_s;
    segment = mesh.segment_at(sensor.depth);
    share = std::clamp((sensor.depth - s[segment]) / (s[segment + 1] - s[segment]), 0.0, 1.0);
}

SectionMotion motion_between(const SectionMotion& first, const SectionMotion& last, double share) {
    const auto mean = [&](const auto& a, const auto& b) {
        return ((1 - share) * a + share * b).eval();
    };
    const Eigen::Matrix3d frame = mean(first.frame, last.frame);
    const Vector3d t = frame.col(0).normalized();
    const Vector3d d1 = (frame.col(1) - frame.col(1).dot(t) * t).normalized();
    SectionMotion motion;
    motion.frame << t, d1, t.cross(d1);
    motion.acceleration = mean(first.acceleration, last.acceleration);
    motion.rotation = mean(first.rotation, last.rotation);
    motion.angular_acceleration = mean(first.angular_acceleration, last.angular_acceleration);
    return motion;
}

SensorRecord sensor_record(const Scene& scene, const SensorCase& sensor,
                           const SectionMotion& motion, const Vector6& stress) {
    const Vector3d arm = sensor.radius * motion.frame.col(1);
    const Vector3d& w = motion.rotation;
    const Vector3d acceleration = motion.acceleration + motion.angular_acceleration.cross(arm) +
                                  w.cross(w.cross(arm)) - scene.gravity * scene.down;
    SensorRecord record;
    record.acceleration = motion.frame.transpose() * acceleration;
    record.rotation_rate = w.dot(motion.frame.col(0));
    record.bending_moment = stress.segment<2>(1);
    record.torque = -stress[0];
    record.tension = stress[3];
    return record;
}

}  // namespace drillstrand
