// Pressure losses of fluids that thin and yield, against closed forms, against the integral over
// the profile, and against numbers of API RP 13D.
#include "forces/duct_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/dice.hpp"

namespace drillstrand {
namespace {

using test::Dice;

constexpr double inch = 0.0254;
constexpr double foot = 0.3048;
constexpr double ppg = 119.826427;  // kg/m3
constexpr double psi = 6894.757;    // Pa

Rheology random_mud(Dice& dice) {
    return {dice.between(0, 20), dice.decades(1e-3, 5), dice.between(0.2, 1)};
}

/// 8 U/D or 6 U/t by Simpson's rule over the sheared part of the profile: with s the stress over
/// that of the wall, the flow is the integral of s^3 (slot: s^2) times the rate over s.
double integrated_rate(const Rheology& mud, Duct duct, double wall_stress) {
    const double yielding = std::min(1.0, mud.yield / wall_stress);
    constexpr int parts = 2000;
    double sum = 0;
    for (int i = 0; i <= parts; ++i) {
        // points gather at the yield surface, where the rate has a root there
        const double share = static_cast<double>(i) / parts;
        const double s = yielding + (1 - yielding) * share * share;
        const double power = duct == Duct::pipe ? s * s : s;
        const double weight = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * power * mud.rate(s * wall_stress) * 2 * share * (1 - yielding);
    }
    return (duct == Duct::pipe ? 4 : 3) * sum / (3 * parts);
}

TEST(DuctFlow, OfHerschelBulkleyFluidIsTheIntegralOverItsProfile) {
    Dice dice(71);
    for (int trial = 0; trial < 200; ++trial) {
        const Rheology mud = random_mud(dice);
        const double stress = mud.yield + dice.decades(0.1, 100);
        for (const Duct duct : {Duct::pipe, Duct::slot}) {
            const double expected = integrated_rate(mud, duct, stress);
            EXPECT_NEAR(newtonian_rate(mud, duct, stress), expected, 1e-7 * expected);
        }
    }
}

TEST(DuctFlow, OfAPowerLawHasTheStressOfMetznerAndReed) {
    for (const double n : {0.3, 0.5, 0.8, 1.0}) {
        const Rheology mud{0, 0.7, n};
        for (const double rate : {0.1, 10.0, 1000.0}) {
            const double pipe = 0.7 * std::pow(rate * (3 * n + 1) / (4 * n), n);
            const double slot = 0.7 * std::pow(rate * (2 * n + 1) / (3 * n), n);
            EXPECT_NEAR(laminar_stress(mud, Duct::pipe, rate) / pipe, 1, 1e-13);
            EXPECT_NEAR(laminar_stress(mud, Duct::slot, rate) / slot, 1, 1e-13);
        }
    }
}

TEST(DuctFlow, OfABinghamFluidIsThatOfBuckinghamAndReiner) {
    const Rheology mud{5, 0.02, 1};
    for (const double stress : {5.01, 6.0, 10.0, 50.0}) {
        const double y = 5 / stress;
        const double pipe = stress / 0.02 * (1 - 4 * y / 3 + std::pow(y, 4) / 3);
        const double slot = stress / 0.02 * (1 - 3 * y / 2 + std::pow(y, 3) / 2);
        EXPECT_NEAR(newtonian_rate(mud, Duct::pipe, stress), pipe, 1e-10 * stress / 0.02);
        EXPECT_NEAR(newtonian_rate(mud, Duct::slot, stress), slot, 1e-10 * stress / 0.02);
    }
    EXPECT_EQ(newtonian_rate(mud, Duct::pipe, 5), 0);
}

TEST(DuctFlow, StressIsTheInverseOfItsRateAndNeverBelowYield) {
    Dice dice(72);
    for (int trial = 0; trial < 1000; ++trial) {
        const Rheology mud = random_mud(dice);
        const Duct duct = dice.sign() > 0 ? Duct::pipe : Duct::slot;
        const double rate = dice.decades(1e-6, 1e5);
        const double stress = laminar_stress(mud, duct, rate);
        EXPECT_GT(stress, mud.yield);
        // near the yield stress rounding of the stress is large beside what is beyond it
        const double rounding = 1e-15 * stress / (stress - mud.yield) / mud.index;
        EXPECT_NEAR(newtonian_rate(mud, duct, stress) / rate, 1, 1e-12 + 10 * rounding);
    }
}

TEST(DuctFlow, OfWaterIsThatOfPoiseuilleAndOfBlasius) {
    const Rheology water{0, 1e-3, 1};
    const WallFlow creeping = wall_flow(water, 1000, Duct::pipe, 0.1, 1e-3);
    EXPECT_TRUE(creeping.laminar);
    EXPECT_NEAR(pressure_gradient(Duct::pipe, 0.1, creeping.stress), 32 * 1e-3 * 1e-3 / 0.01, 1e-8);
    for (const double speed : {0.2, 1.0, 3.0}) {  // Reynolds numbers of 2e4 to 3e5
        const WallFlow flow = wall_flow(water, 1000, Duct::pipe, 0.1, speed);
        EXPECT_FALSE(flow.laminar);
        EXPECT_NEAR(flow.reynolds, speed * 0.1 / 1e-6, 1e-6 * flow.reynolds);
        const double friction = 0.0791 / std::pow(flow.reynolds, 0.25);
        EXPECT_NEAR(flow.stress / (friction * 1000 * speed * speed / 2), 1, 0.01);
    }
}

// A worked example of API RP 13D (1995), as github.com/BillyFrcs/DrillingOperations repeats it: mud
// of 12.8 ppg; drill pipe of 4.5 in in a hole of 8.625 in, 335 gal/min; n and K at low rates.
TEST(DuctFlow, LosesInTheAnnulusOfAWorkedExampleWhatIsPrinted) {
    const Rheology mud{0, 2.61, 0.275};
    const double gap = (8.625 - 4.5) / 2 * inch;
    const WallFlow flow = wall_flow(mud, 12.8 * ppg, Duct::slot, gap, 151.47 * foot / 60);
    EXPECT_TRUE(flow.laminar);
    // 24/Re of the print is 16/Re here
    EXPECT_NEAR(flow.reynolds, 1024.75 * 16 / 24, 0.003 * flow.reynolds);
    const double loss = pressure_gradient(Duct::slot, gap, flow.stress) * 855 * foot;
    EXPECT_NEAR(loss / psi, 0.02342 * 151.47 * 151.47 * 12.8 / (92916 * 4.125) * 855, 0.06);
}

// Inside its drill collars of 2.25 in: n = 0.64, K = 3.21 dyn s^n/cm2, Reynolds number 26 144; the
// turbulent factor (log n + 3.93)/50 Re^-((1.75 - log n)/7) of the same edition.
TEST(DuctFlow, InDrillCollarsOfAWorkedExampleIsTurbulentWithThePrintedReynoldsNumber) {
    const Rheology mud{0, 0.321, 0.64};
    const double bore = 2.25 * inch;
    const double speed = 1619.91 * foot / 60;
    const WallFlow flow = wall_flow(mud, 12.8 * ppg, Duct::pipe, bore, speed);
    EXPECT_FALSE(flow.laminar);
    EXPECT_NEAR(flow.reynolds, 26144, 0.005 * flow.reynolds);
    const double friction = flow.stress / (12.8 * ppg * speed * speed / 2);
    EXPECT_NEAR(friction, 0.07472 * std::pow(26144, -0.27769), 0.002 * friction);
}

TEST(DuctFlow, LosesMoreTheFasterItIsAndNeverLessThanLaminarFlow) {
    Dice dice(73);
    for (int trial = 0; trial < 200; ++trial) {
        const Rheology mud = random_mud(dice);
        double before = 0;
        for (double speed = 0.01; speed < 20; speed *= 1.1) {
            const WallFlow flow = wall_flow(mud, 1200, Duct::slot, 0.03, speed);
            EXPECT_GT(flow.stress, before);
            EXPECT_GE(flow.stress * (1 + 1e-12), laminar_stress(mud, Duct::slot, 6 * speed / 0.03));
            EXPECT_EQ(wall_flow(mud, 1200, Duct::slot, 0.03, -speed).stress, -flow.stress);
            before = flow.stress;
        }
    }
}

}  // namespace
}  // namespace drillstrand
