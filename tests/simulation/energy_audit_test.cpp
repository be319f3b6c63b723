#include "drillstrand/energy_audit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drillstrand {
namespace {

EnergyAccount account(double kinetic, double potential, double work, double dissipation) {
    EnergyAccount account;
    account.kinetic = kinetic;
    account.potential = potential;
    account.work = work;
    account.dissipation = dissipation;
    return account;
}

TEST(EnergyAudit, AStringThatNeverMovesHasNoResidual) {
    EnergyAudit audit;
    EXPECT_EQ(audit.residual(), 0);
    audit.add(account(0, 7, 0, 0));
    audit.add(account(0, 7, 0, 0));
    EXPECT_EQ(audit.residual(), 0);
}

TEST(EnergyAudit, AnUndampedSwingThatKeepsItsEnergyHasNoResidual) {
    EnergyAudit audit;
    for (int k = 0; k <= 64; ++k) {
        const double fallen = std::pow(std::sin(0.1 * k), 2);
        audit.add(account(100 * fallen, -100 * fallen, 0, 0));
    }
    EXPECT_EQ(audit.residual(), 0);
}

TEST(EnergyAudit, WhatASwingLosesIsRelativeToTheEnergyItMoves) {
    EnergyAudit audit;
    audit.add(account(0, 0, 0, 0));
    audit.add(account(99, -100, 0, 0));
    EXPECT_DOUBLE_EQ(audit.residual(), -1.0 / 100);
}

TEST(EnergyAudit, WorkThatIsPartlyStoredAndPartlyDissipatedBalances) {
    EnergyAudit audit;
    audit.add(account(0, 50, 3, 2));
    audit.add(account(60, 50, 103, 42));
    EXPECT_EQ(audit.residual(), 0);
}

TEST(EnergyAudit, EnergyFromNowhereIsPositiveAndRelativeToTheWork) {
    EnergyAudit audit;
    audit.add(account(0, 0, 0, 0));
    audit.add(account(70, 0, 200, 140));
    EXPECT_DOUBLE_EQ(audit.residual(), 10.0 / 200);
}

TEST(EnergyAudit, WorkThatWasGivenBackStillCountsAsTheScale) {
    EnergyAudit audit;
    audit.add(account(0, 0, 0, 0));
    audit.add(account(0, 0, 100, 100));
    audit.add(account(0, 0, 0, 96));
    EXPECT_DOUBLE_EQ(audit.residual(), 96.0 / 100);
}

}  // namespace
}  // namespace drillstrand
