// Operations in words become schedules that go where the words say.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "drillstrand/case.hpp"
#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

HeadCase head_with(const std::string& operations, const std::string& more = "") {
    return read_trial("rotation = [[0, 0], [2, \"110 rpm\"]]",
                      "operations = [" + operations + "]\n" + more)
        .head;
}

TEST(Operations, GoTheirWayAtTheirSpeed) {
    const HeadCase head = head_with(
        R"("wait 3 s", "trip in 12 m at 0.5 m/s", "wait 4 s", "trip out 2 m at 0.25 m/s")");
    const auto speed = [&](double time) { return head.velocity(time)[0]; };
    const auto place = [&](double time) { return head.velocity.integral(time)[0]; };
    EXPECT_EQ(speed(3), 0);
    EXPECT_NEAR(speed(4), 0.25, 1e-12);
    EXPECT_NEAR(speed(10), 0.5, 1e-12);
    // 12 m at 0.5 m/s and two ramps of 2 s
    EXPECT_NEAR(place(29), 12, 1e-12);
    EXPECT_EQ(speed(30), 0);
    EXPECT_NEAR(speed(36), -0.25, 1e-12);
    EXPECT_NEAR(place(60), 10, 1e-12);
    EXPECT_EQ(speed(60), 0);
}

TEST(Operations, AreSlowerOverAShortWay) {
    // as quickly reached: 0.5 m/s in 2 s; over 0.25 m up to 0.25 m/s, in 1 s, and down again
    const HeadCase head = head_with(R"("trip in 25 cm at 0.5 m/s")");
    EXPECT_NEAR(head.velocity(1)[0], 0.25, 1e-12);
    EXPECT_NEAR(head.velocity.integral(2)[0], 0.25, 1e-12);
    EXPECT_EQ(head.velocity(2)[0], 0);
}

TEST(Operations, TurnUntilTheyAreToldOtherwise) {
    const HeadCase head = head_with(
        R"("rotate 60 rpm", "wait 10 s", "rotate 90 rpm in 5 s", "trip in 4 m at 1 m/s", "slips in")",
        "ramp_time = 1");
    constexpr double rpm = std::numbers::pi / 30;
    EXPECT_NEAR(head.rotation(0.5), 30 * rpm, 1e-12);
    EXPECT_NEAR(head.rotation(11), 60 * rpm, 1e-12);
    EXPECT_NEAR(head.rotation(13.5), 75 * rpm, 1e-12);
    EXPECT_NEAR(head.rotation(21), 90 * rpm, 1e-12);
    EXPECT_EQ(head.rotation(22), 0);
    ASSERT_EQ(head.slips.size(), 1U);
    EXPECT_NEAR(head.slips[0].begin, 22, 1e-12);
    EXPECT_TRUE(std::isinf(head.slips[0].end));
}

TEST(Operations, HoldTheStringInSlipsUntilItMoves) {
    const HeadCase head = head_with(
        R"("slips in", "wait 10 s", "rotate 60 rpm", "slips in", "wait 5 s", "slips out", "wait 5 s")");
    ASSERT_EQ(head.slips.size(), 2U);
    EXPECT_EQ(head.slips[0].begin, 0);
    EXPECT_EQ(head.slips[0].end, 10);
    EXPECT_EQ(head.slips[1].begin, 14);
    EXPECT_EQ(head.slips[1].end, 19);
}

TEST(Operations, FeedTheDrumOfAHoist) {
    const HeadCase head =
        head_with(R"("trip in 2 m at 0.5 m/s")", "[head.hoist]\nmass = 1e4\nline_stiffness = 1e6");
    EXPECT_NEAR(head.hoist->block_speed.integral(10), 2, 1e-12);
    EXPECT_EQ(head.velocity(3)[0], 0);
}

}  // namespace
}  // namespace drillstrand
