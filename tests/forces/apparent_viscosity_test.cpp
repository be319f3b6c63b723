// Drag of mud that thins and yields: power laws between cylinders in closed form, limits, energy.
#include "forces/apparent_viscosity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "support/annular_flow.hpp"
#include "support/dice.hpp"

namespace drillstrand {
namespace {

using test::Dice;

constexpr double pi = std::numbers::pi;

struct Mud {
    double consistency, index, yield_stress;

    [[nodiscard]] Thinning thinning() const {
        return {consistency, yield_stress, 0.5 * (1 - index)};
    }
    [[nodiscard]] MudAround at_rest(double pipe, double hole) const {
        return {0, 0, 0, axial_thinning(index, pipe, hole), spin_thinning(index, pipe, hole)};
    }
};

/// Creeping drag of a concentric pipe (no inertia), as kernels take it.
DragCoefficients drag_of(const Mud& mud, double pipe, double hole, double along, double spin) {
    return flowing_drag(drag_coefficients({0, pipe, hole}), {0, 0, 0, 0}, mud.at_rest(pipe, hole),
                        mud.thinning(), pipe, hole, 0, along, 0, spin);
}

// M = 2 pi R^2 K (2 w / (n (1 - (R/Rw)^(2/n))))^n
TEST(ApparentViscosity, GivesTheCoupleOfAPowerLawBetweenCylinders) {
    for (const double n : {0.3, 0.6, 0.9, 1.0}) {
        for (const double pipe : {0.04, 0.07, 0.1}) {
            const double hole = 0.11;
            const double spin = 3000;  // rates far above 1/s
            const double rate = 2 * spin / (n * (1 - std::pow(pipe / hole, 2 / n)));
            const double expected = 2 * pi * pipe * pipe * 0.5 * std::pow(rate, n);
            const double couple = drag_of({0.5, n, 0}, pipe, hole, 0, spin).spin * spin;
            EXPECT_NEAR(couple / expected, 1, 1e-6) << n << ' ' << pipe;
        }
    }
}

// F = 2 pi R K (v (1/n - 1) / (R (1 - (R/Rw)^(1/n - 1))))^n
TEST(ApparentViscosity, GivesThePullOfAPowerLawBetweenCylinders) {
    for (const double n : {0.3, 0.6, 0.9}) {
        for (const double pipe : {0.04, 0.07, 0.1}) {
            const double hole = 0.11;
            const double speed = 300;
            const double power = 1 / n - 1;
            const double rate = speed * power / (pipe * (1 - std::pow(pipe / hole, power)));
            const double expected = 2 * pi * pipe * 0.5 * std::pow(rate, n);
            const double pull = drag_of({0.5, n, 0}, pipe, hole, speed, 0).axial * speed;
            EXPECT_NEAR(pull / expected, 1, 1e-6) << n << ' ' << pipe;
        }
    }
}

// Bingham between cylinders, sheared throughout: stress at the pipe = (mu w + yield ln(Rw/R)) 2 /
// (1 - (R/Rw)^2). The yield stress acts undivided here, which in narrow annuli is exact.
TEST(ApparentViscosity, GivesTheCoupleOfABinghamFluidInNarrowAnnuli) {
    const double hole = 0.11;
    const double spin = 20;
    for (const double gap : {0.002, 0.01, 0.04}) {
        const double pipe = hole - gap;
        const double stress =
            (0.03 * spin + 5 * std::log(hole / pipe)) * 2 / (1 - std::pow(pipe / hole, 2));
        const double expected = 2 * pi * pipe * pipe * stress;
        const double couple = drag_of({0.03, 1, 5}, pipe, hole, 0, spin).spin * spin;
        EXPECT_LT(couple, expected);
        EXPECT_GT(couple, expected * (1 - 1.1 * gap / pipe));
    }
}

TEST(ApparentViscosity, OfANewtonianFluidIsItsViscosityBitForBit) {
    Dice dice(81);
    for (int trial = 0; trial < 1000; ++trial) {
        const double hole = dice.between(0.05, 0.3);
        const double pipe = hole * dice.between(0.2, 0.95);
        const double viscosity = dice.decades(1e-4, 1);
        const DragCoefficients unit =
            drag_coefficients({dice.between(0, 0.9) * (hole - pipe), pipe, hole});
        const FlowInertia flow = flow_inertia(1200, viscosity, 1, pipe, hole);
        const double across = dice.decades(1e-3, 1);
        const double along = dice.decades(1e-3, 1);
        const double spin = dice.decades(1e-2, 30);
        const Mud newtonian{viscosity, 1, 0};
        const DragCoefficients found =
            flowing_drag(unit, flow, newtonian.at_rest(pipe, hole), newtonian.thinning(), pipe,
                         hole, across, along, 0, spin);
        const DragCoefficients expected =
            with_inertia(scaled(unit, viscosity), flow, pipe, across, along, spin);
        EXPECT_EQ(found.radial, expected.radial);
        EXPECT_EQ(found.axial, expected.axial);
        EXPECT_EQ(found.around, expected.around);
        EXPECT_EQ(found.cross, expected.cross);
        EXPECT_EQ(found.spin, expected.spin);
    }
}

TEST(ApparentViscosity, IsThatOfOnePerSecondAtRestAndFallsWithTheRate) {
    const Thinning mud = Mud{0.8, 0.5, 4}.thinning();
    EXPECT_DOUBLE_EQ(apparent_viscosity(mud, 0), 0.8 + 4);
    double before = 0.8 + 4;
    for (double rate = 0.1; rate < 1e4; rate *= 2) {
        const double viscosity = apparent_viscosity(mud, rate * rate);
        EXPECT_LT(viscosity, before);
        // the stress itself rises
        EXPECT_GT(viscosity * 2 * rate, before * rate);
        before = viscosity;
        const double stress = 4 + 0.8 * std::pow(rate, 0.5);
        if (rate > 100) {
            EXPECT_NEAR(viscosity * rate / stress, 1, 1e-4);
        }
    }
}

TEST(ApparentViscosity, LeavesDragThatOnlyTakesEnergy) {
    Dice dice(82);
    for (int trial = 0; trial < 10000; ++trial) {
        const double hole = dice.between(0.05, 0.3);
        const double pipe = hole * dice.between(0.2, 0.95);
        const Mud mud{dice.decades(1e-3, 5), dice.between(0.1, 1), dice.between(0, 20)};
        MudAround around = mud.at_rest(pipe, hole);
        around.speed = dice.between(-2, 2);
        around.shear = dice.between(-500, 500);
        const DragCoefficients drag = flowing_drag(
            drag_coefficients({dice.between(0, 0.99) * (hole - pipe), pipe, hole}),
            flow_inertia(1200, mud.consistency, 1, pipe, hole), around, mud.thinning(), pipe, hole,
            dice.between(-3, 3), dice.between(-3, 3), dice.between(-3, 3), dice.between(-30, 30));
        EXPECT_GT(drag.radial, 0);
        EXPECT_GT(drag.axial, 0);
        EXPECT_GT(drag.around, 0);
        EXPECT_GT(drag.around * drag.spin, drag.cross * drag.cross);
    }
}

TEST(ApparentViscosity, ThinsWithWhatIsPumpedAndWithSidewaysMotion) {
    const Mud mud{0.8, 0.5, 4};
    const double pipe = 0.07;
    const double hole = 0.11;
    const DragCoefficients unit = drag_coefficients({0.01, pipe, hole});
    const auto spin_drag = [&](double shear, double sideways) {
        MudAround around = mud.at_rest(pipe, hole);
        around.shear = shear;
        return flowing_drag(unit, {0, 0, 0, 0}, around, mud.thinning(), pipe, hole, sideways, 0, 0,
                            1)
            .spin;
    };
    EXPECT_LT(spin_drag(100, 0), 0.5 * spin_drag(0, 0));
    EXPECT_LT(spin_drag(0, 0.5), 0.5 * spin_drag(0, 0));
}

}  // namespace
}  // namespace drillstrand
