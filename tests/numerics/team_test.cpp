/// When threads work together and when one goes on alone. Times are made up: nothing waits.
#include "numerics/team.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>
#include <vector>

#include "numerics/barrier.hpp"

namespace drillstrand {
namespace {

constexpr double piece = 0.01;  // s, of work

/// A team whose members wait for each other during `share` of their time, from 0 to `end`; the time
/// it works together.
double together(Team& team, double share, double end) {
    double sum = 0;
    for (double now = 0; now < end; now += piece) {
        if (team.size(now) == 1) continue;
        team.worked(now, now + piece, share * piece);
        sum += piece;
    }
    return sum;
}

TEST(Team, WorksTogetherWhereNobodyIsLate) {
    Team team(2);
    EXPECT_NEAR(together(team, 0, 10), 10, 2 * piece);
}

TEST(Team, IsNotPartedByAStrayInterruption) {
    Team team(4);
    team.worked(0, piece, 0.001);
    EXPECT_EQ(team.size(piece), 4);
}

TEST(Team, LeavesOneThreadAloneWhereTheyWaitForEachOther) {
    Team team(2);
    team.worked(0, piece, 0.5 * piece);
    EXPECT_EQ(team.size(piece), 1);
    EXPECT_LT(team.longest_piece(piece), std::numeric_limits<std::int64_t>::max());
}

TEST(Team, TriesAgainLessAndLessOften) {
    Team team(2);
    // a busy machine: at most a hundredth of the time is lost in attempts
    EXPECT_LT(together(team, 0.9, 20), 0.2);
    EXPECT_LT(together(team, 0.9, 20), 0.2);
}

TEST(Team, WorksTogetherAgainOnceTheMachineIsQuiet) {
    Team team(2);
    together(team, 0.9, 20);
    double now = 20;
    while (team.size(now) == 1)
        now += piece;
    EXPECT_LT(now, 23);
    for (; now < 25; now += piece) {
        ASSERT_EQ(team.size(now), 2);
        team.worked(now, now + piece, 0);
    }
    // and one slow spell counts as the first
    team.worked(now, now + piece, piece);
    EXPECT_EQ(team.size(now + piece), 1);
    EXPECT_EQ(team.size(now + 5 * piece), 2);
}

TEST(Team, OfOneNeverParts) {
    Team team(1);
    EXPECT_EQ(team.size(0), 1);
    EXPECT_EQ(team.longest_piece(0), std::numeric_limits<std::int64_t>::max());
}

TEST(Barrier, LetsNobodyPassBeforeAllHaveCome) {
    constexpr int members = 3;
    constexpr int meetings = 2000;
    Barrier barrier(members);
    std::vector<int> arrived(members * 64, 0);  // a cache line and more each
    std::vector<int> early(members * 64, 0);
    const auto member = [&](std::size_t me) {
        for (int meeting = 1; meeting <= meetings; ++meeting) {
            arrived[me * 64] = meeting;
            barrier.wait();
            for (std::size_t other = 0; other < members; ++other)
                early[me * 64] += arrived[other * 64] < meeting ? 1 : 0;
            barrier.wait();
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t me = 0; me < members; ++me)
        threads.emplace_back(member, me);
    for (std::thread& thread : threads)
        thread.join();
    for (std::size_t me = 0; me < members; ++me)
        EXPECT_EQ(early[me * 64], 0);
}

}  // namespace
}  // namespace drillstrand
