#include "model/pose.hpp"

#include <cstddef>

namespace drillstrand {

std::vector<Pose> poses_from_strains(const Pose& head, const std::vector<double>& length,
                                     const std::vector<Vector6>& strain) {
    std::vector<Pose> poses(length.size() + 1);
    poses[0] = head;
    for (std::size_t k = 0; k < length.size(); ++k) {
        const Vector6& u = strain[k];
        const SegmentPose step = segment_pose(length[k], u[0], u[1], u[2], u[3], u[4], u[5]);
        const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(
            &step.rotation[0][0]);
        const Eigen::Map<const Eigen::Vector3d> position(step.position);
        poses[k + 1].position = poses[k].position + poses[k].frame * position;
        poses[k + 1].frame = poses[k].frame * rotation;
    }
    return poses;
}

}  // namespace drillstrand
