#include "model/pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Vector6 strain(const Vector3d& curvature, const Vector3d& stretch) {
    Vector6 u;
    u << curvature, stretch;
    return u;
}

TEST(Pose, IsTheMatrixExponentialOfTheStrain) {
    std::mt19937 random(11);
    std::normal_distribution<double> gauss;
    std::uniform_real_distribution<double> decade(-9, 0);
    for (int trial = 0; trial < 300; ++trial) {
        const double h = 0.7;
        const double angle = pi * std::pow(10, decade(random));
        const Vector3d k =
            angle / h * Vector3d(gauss(random), gauss(random), gauss(random)).normalized();
        const Vector3d g(1 + 0.1 * gauss(random), 0.1 * gauss(random), 0.1 * gauss(random));
        Eigen::Matrix4d screw = Eigen::Matrix4d::Zero();
        screw.topLeftCorner<3, 3>() << 0, -k[2], k[1], k[2], 0, -k[0], -k[1], k[0], 0;
        screw.topRightCorner<3, 1>() = g;
        const Eigen::Matrix4d turned = h * screw;
        const Eigen::Matrix4d expected = turned.exp();
        const Pose end = poses_from_strains({}, {h}, {strain(k, g)}).back();
        EXPECT_LT((end.frame - expected.topLeftCorner<3, 3>()).norm(), 1e-14);
        EXPECT_LT((end.position - expected.topRightCorner<3, 1>()).norm(), 1e-14);
    }
}

TEST(Pose, UniformBendingClosesACircleWhateverTheMesh) {
    for (const std::size_t segments : {3U, 10U, 57U}) {
        const double length = 20;
        const std::vector<double> h(segments, length / static_cast<double>(segments));
        const std::vector<Vector6> bent(segments,
                                        strain({0, 2 * pi / length, 0}, Vector3d::UnitX()));
        const Pose end = poses_from_strains({}, h, bent).back();
        EXPECT_LT(end.position.norm(), 1e-13 * length);
        EXPECT_LT((end.frame - Eigen::Matrix3d::Identity()).norm(), 1e-13);
    }
}

TEST(Pose, TwistAndBendingTogetherDrawAHelixOfTextbookPitchAndRadius) {
    // curvature k and torsion t: radius k/(k^2+t^2), rise per length t/sqrt(k^2+t^2)
    const double k = 0.3;
    const double t = 0.4;
    const double length = 2 * pi / std::hypot(k, t);  // one turn
    const std::size_t segments = 12;
    const std::vector<double> h(segments, length / static_cast<double>(segments));
    const std::vector<Pose> poses = poses_from_strains(
        {}, h, std::vector<Vector6>(segments, strain({t, k, 0}, Vector3d::UnitX())));
    // after one turn the curve has moved along its axis only, by the rise of one turn
    const Vector3d axis = Vector3d(t, k, 0).normalized();
    const double rise = length * t / std::hypot(k, t);
    EXPECT_LT((poses.back().position - rise * axis).norm(), 1e-13 * length);
    // half a turn away the curve is two radii from where it would be straight along the axis
    const Vector3d across = poses[segments / 2].position - rise / 2 * axis - poses.front().position;
    EXPECT_NEAR(across.norm(), 2 * k / (k * k + t * t), 1e-13 * length);
}

}  // namespace
}  // namespace drillstrand
