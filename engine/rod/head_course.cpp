#include "rod/head_course.hpp"

#include <algorithm>

#include "drillstrand/schedule_parts.hpp"

namespace drillstrand {

using Eigen::Vector3d;

HeadCourse::HeadCourse(const HeadCase& head)
    : rotation_(head.rotation),
      along_(part_of_d3(head.velocity)),
      tilting_(head.tilting),
      velocity_(head.velocity),
      is_axial_(drillstrand::is_axial(head.velocity) && drillstrand::is_axial(head.tilting)) {
    moves_ = !is_axial_ || std::any_of(along_.values().begin(), along_.values().end(),
                                       [](double speed) { return speed != 0; });
}

Vector6 HeadCourse::velocity(double time) const {
    Vector6 velocity;
    velocity << tilting_(time), velocity_(time);
    velocity[0] += rotation_(time);
    return velocity;
}

Pose HeadCourse::after(const Pose& pose, double time, double step) const {
    Vector3d w = tilting_.integral(time + step) - tilting_.integral(time);
    w[0] += turn(time, step);
    const Vector3d v = velocity_.integral(time + step) - velocity_.integral(time);
    const SegmentPose moved = segment_pose(1.0, w[0], w[1], w[2], v[0], v[1], v[2]);
    Eigen::Matrix3d turned;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            turned(i, j) = moved.rotation[i][j];
    return {pose.frame * turned,
            pose.position +
                pose.frame * Vector3d(moved.position[0], moved.position[1], moved.position[2])};
}

}  // namespace drillstrand
