#include "drillstrand/energy_audit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

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

TEST(EnergyAudit, SpringsThatStartCompressedAreNotTheScale) {
    // a wall gives 1000 J back into its dashpots while 10 J swing, of which 1 J gets lost
    EnergyAudit audit;
    EnergyAccount start;
    start.elastic = start.springs = 1000;
    audit.add(start);
    audit.add(account(10, 0, 0, 990));
    audit.add(account(0, 9, 0, 990));
    EXPECT_DOUBLE_EQ(audit.residual(), -1.0 / 10);
}

TEST(EnergyAudit, GoesOnFromWhatWasSaved) {
    EnergyAudit whole;
    EnergyAudit part;
    for (EnergyAudit* audit : {&whole, &part}) {
        audit->add(account(0, 50, 3, 2));
        audit->add(account(70, 0, 200, 140));
    }
    EnergyAudit later;
    later.restore(part.save());
    for (EnergyAudit* audit : {&whole, &later})
        audit->add(account(1, 2, 30, 41));
    EXPECT_EQ(later.residual(), whole.residual());
    EXPECT_EQ(later.moved(), whole.moved());
    EXPECT_THROW(later.restore({{"energy_audit", "J", {0, 1}}}), std::invalid_argument);
}

}  // namespace
}  // namespace drillstrand
