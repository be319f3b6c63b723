// The load at the bit: weight, torque and dead loads, as stress in the axes of the last section.
#include "rod/bit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace drillstrand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A bit tilted by `tilt` (rad) about its d1 out of a well that goes down.
BitMotion tilted_bit(double tilt, double rotation_rate) {
    BitMotion motion;
    Matrix3d frame;  // d3, d1, d2 in the columns
    frame << Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY();
    motion.frame = Eigen::AngleAxisd(tilt, Vector3d::UnitX()) * frame;
    motion.well_direction = Vector3d::UnitZ();
    motion.opposed_rate = rotation_rate;
    return motion;
}

/// Force on the bit in the space frame.
Vector3d force_in_space(const BitMotion& motion, const Vector6& stress) {
    return motion.frame * stress.tail<3>();
}

TEST(Bit, FrictionOf16GivesTenKilonewtonMetresAtSixtyFiveKilonewtons) {
    BitCase bit;
    bit.friction = 1.6023;  // the paper rounds to 1.6 (section 2.2.3); R = 0.12225 m
    bit.weight = 65e3;
    EXPECT_NEAR(Bit(bit, 0.12225).full_torque(0.0), 10e3, 1.0);
    EXPECT_DOUBLE_EQ(Bit(bit, 0.12225).full_torque(0.0),
                     1.6023 * std::numbers::pi * 0.12225 / 4 * 65e3);
}

TEST(Bit, TorqueFollowsItsSchedule) {
    BitCase bit;
    bit.torque = ScalarSchedule({45, 50}, {0, 10e3});
    EXPECT_DOUBLE_EQ(Bit(bit, 0.1).full_torque(45), 0);
    EXPECT_DOUBLE_EQ(Bit(bit, 0.1).full_torque(47.5), 5e3);
    EXPECT_DOUBLE_EQ(Bit(bit, 0.1).full_torque(60), 10e3);
}

TEST(Bit, TorqueOpposesRotationInBothSensesAndVanishesAtRest) {
    BitCase bit;
    bit.torque = 10e3;
    EXPECT_DOUBLE_EQ(Bit(bit, 0.12225).stress(tilted_bit(0, 3), 0)[0], -10e3);
    EXPECT_DOUBLE_EQ(Bit(bit, 0.12225).stress(tilted_bit(0, -3), 0)[0], 10e3);
    EXPECT_DOUBLE_EQ(Bit(bit, 0.12225).stress(tilted_bit(0, 0), 0)[0], 0);
}

TEST(Bit, TorqueFallsLinearlyToZeroBelowTheSmoothingSpeed) {
    BitCase bit;
    bit.torque = 10e3;
    bit.smoothing_speed = 0.1;
    EXPECT_DOUBLE_EQ(Bit(bit, 0.12225).stress(tilted_bit(0, 0.025), 0)[0], -2.5e3);
    EXPECT_DOUBLE_EQ(Bit(bit, 0.12225).stress(tilted_bit(0, -0.05), 0)[0], 5e3);
    EXPECT_DOUBLE_EQ(Bit(bit, 0.12225).stress(tilted_bit(0, 0.1), 0)[0], -10e3);
    EXPECT_DOUBLE_EQ(Bit(bit, 0.12225).stress(tilted_bit(0, 5), 0)[0], -10e3);
}

TEST(Bit, WeightAlongTheWellPushesAgainstTheWellWhateverTheTilt) {
    BitCase bit;
    bit.weight = 65e3;
    bit.direction = BitDirection::well;
    for (const double tilt : {0.0, 0.3, -1.2}) {
        const BitMotion motion = tilted_bit(tilt, 1);
        const Vector3d force = force_in_space(motion, Bit(bit, 0.12225).stress(motion, 0));
        EXPECT_LT((force - Vector3d(0, 0, -65e3)).norm(), 1e-9);
    }
}

TEST(Bit, FollowerWeightPushesAlongThePipe) {
    BitCase bit;
    bit.weight = 65e3;
    bit.direction = BitDirection::follower;
    for (const double tilt : {0.0, 0.3, -1.2}) {
        const Vector6 stress = Bit(bit, 0.12225).stress(tilted_bit(tilt, 1), 0);
        EXPECT_DOUBLE_EQ(stress[3], -65e3);
        EXPECT_DOUBLE_EQ(stress[4], 0);
        EXPECT_DOUBLE_EQ(stress[5], 0);
    }
}

TEST(Bit, DeadLoadsKeepTheirDirectionInSpace) {
    BitCase bit;
    bit.force = Vector3d(1e3, -2e3, 3e3);
    bit.dead_moment = Vector3d(40, 50, -60);
    for (const double tilt : {0.0, 0.7}) {
        const BitMotion motion = tilted_bit(tilt, 0);
        const Vector6 stress = Bit(bit, 0.12225).stress(motion, 0);
        EXPECT_LT((force_in_space(motion, stress) - Vector3d(1e3, -2e3, 3e3)).norm(), 1e-9);
        EXPECT_LT((motion.frame * stress.head<3>() - Vector3d(40, 50, -60)).norm(), 1e-9);
    }
}

TEST(Bit, FollowerCoupleTurnsWithTheSection) {
    BitCase bit;
    bit.moment = Vector3d(1, 2, 3);
    for (const double tilt : {0.0, 0.7}) {
        EXPECT_LT(
            (Bit(bit, 0.12225).stress(tilted_bit(tilt, 0), 0).head<3>() - Vector3d(1, 2, 3)).norm(),
            1e-12);
    }
}

}  // namespace
}  // namespace drillstrand
