// What the inertia of the mud adds to its drag, and what is left of drag at the wall.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "forces/fluid.hpp"
#include "support/annular_flow.hpp"
#include "support/dice.hpp"

namespace drillstrand {
namespace {

using test::Annulus;
using test::Dice;
using test::Stirring;

constexpr double pi = std::numbers::pi;

FluidCase random_mud(Dice& dice) {
    FluidCase fluid;
    fluid.density = dice.between(900, 2200);
    fluid.viscosity = dice.decades(1e-4, 10);
    fluid.drag_coefficient = dice.between(0.5, 2);
    return fluid;
}

Annulus random_annulus(Dice& dice, double most = 0.999) {
    const double hole = dice.decades(0.05, 0.5);
    const double pipe = hole * dice.between(0.2, 0.95);
    return {pipe, hole, (hole - pipe) * dice.between(0.01, most)};
}

Stirring random_motion(Dice& dice) {
    return {dice.decades(1e-6, 10), dice.sign() * dice.decades(1e-6, 10),
            dice.sign() * dice.decades(1e-6, 100)};
}

/// The drag of the engine's kernels, step by step as they take it.
DragCoefficients drag_of(const FluidCase& fluid, const Annulus& annulus, const Stirring& motion) {
    const double e = annulus.eccentricity;
    DragCoefficients drag =
        scaled(drag_coefficients({film_eccentricity(e, annulus.pipe, annulus.hole, fluid.film),
                                  annulus.pipe, annulus.hole}),
               fluid.viscosity);
    if (fluid.regime == FlowRegime::inertial) {
        const FlowInertia flow = flow_inertia(fluid.density, fluid.viscosity,
                                              fluid.drag_coefficient, annulus.pipe, annulus.hole);
        drag = with_inertia(drag, flow, annulus.pipe, motion.across, motion.along, motion.spin);
    }
    return around_wall(drag, e, annulus.pipe, annulus.hole, fluid.film,
                       fluid.contact_drag ? 1.0 : 0.0);
}

Eigen::Matrix4d matrix_of(const DragCoefficients& drag) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    matrix(0, 0) = drag.radial;
    matrix(1, 1) = drag.axial;
    matrix.bottomRightCorner<2, 2>() << drag.around, drag.cross, drag.cross, drag.spin;
    return matrix;
}

/// Largest difference of two matrices, entry by entry, over the entry where it is not 0.
double relative_difference(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) {
    double worst = 0;
    for (Eigen::Index i = 0; i < 4; ++i)
        for (Eigen::Index j = 0; j < 4; ++j)
            worst = std::max(worst, std::abs(b(i, j) != 0 ? a(i, j) / b(i, j) - 1 : a(i, j)));
    return worst;
}

TEST(FlowInertia, DragIsThatOfTheTextbooks) {
    Dice dice(41);
    for (int trial = 0; trial < 10000; ++trial) {
        FluidCase fluid = random_mud(dice);
        fluid.regime = dice.sign() > 0 ? FlowRegime::inertial : FlowRegime::laminar;
        fluid.contact_drag = dice.sign() > 0;
        const Annulus annulus = random_annulus(dice, 1.1);
        const Stirring motion = random_motion(dice);
        EXPECT_LT(relative_difference(matrix_of(drag_of(fluid, annulus, motion)),
                                      test::textbook_drag(fluid, annulus, motion)),
                  1e-9);
    }
}

// Bilgen and Boulos (1973), where the gap's Reynolds number is that of vortices and turbulence.
TEST(FlowInertia, CoupleOnASpinningPipeIsThePrintedCorrelation) {
    FluidCase water;
    water.density = 1000;
    water.viscosity = 1e-3;
    const Annulus annulus = {0.07, 0.11, 0};
    for (const double spin : {0.5, 2.0, 10.0, 100.0}) {
        const FlowInertia flow =
            flow_inertia(water.density, water.viscosity, 1, annulus.pipe, annulus.hole);
        const double reynolds = flow.swirl_reynolds * spin;
        EXPECT_DOUBLE_EQ(flow.swirl_reynolds, 0.07 * 0.04 / 1e-6);
        const double torque = flow.swirl * spin * spin * swirl_coefficient(reynolds);
        // Re + 1 in place of Re
        EXPECT_NEAR(torque / test::turbulent_torque(water, annulus, spin), 1, 0.6 / reynolds);
    }
}

TEST(FlowInertia, TorqueCoefficientGoesOverAtAReynoldsNumberOfTenThousand) {
    EXPECT_NEAR(swirl_coefficient(1e3) / (1.03 / std::sqrt(1e3)), 1, 1e-3);
    EXPECT_NEAR(swirl_coefficient(1e6) / (0.065 * std::pow(1e6, -0.2)), 1, 1e-6);
    EXPECT_NEAR(swirl_coefficient(1e4) / (1.03 / std::sqrt(1e4)), 1, 1e-3);
    EXPECT_NEAR(swirl_coefficient(1e4) / (0.065 * std::pow(1e4, -0.2)), 1, 1.1e-2);
}

// f = 0.079 Re^-1/4, Re = v 2 t / nu; wall stress f rho v^2 / 2 around the pipe
TEST(FlowInertia, PullAlongThePipeIsThatOfBlasius) {
    Dice dice(42);
    for (int trial = 0; trial < 1000; ++trial) {
        const FluidCase fluid = random_mud(dice);
        const Annulus annulus = random_annulus(dice);
        const double speed = dice.decades(0.1, 10);
        const double reynolds = speed * 2 * annulus.clearance() * fluid.density / fluid.viscosity;
        const double stress = 0.079 * std::pow(reynolds, -0.25) * fluid.density * speed * speed / 2;
        const FlowInertia flow =
            flow_inertia(fluid.density, fluid.viscosity, 1, annulus.pipe, annulus.hole);
        const DragCoefficients drag = with_inertia({}, flow, annulus.pipe, 0, speed, 0);
        EXPECT_NEAR(drag.axial * speed / (stress * 2 * pi * annulus.pipe), 1, 1e-12);
    }
}

// C_d rho v^2 R, v the speed in the gap that the pipe leaves
TEST(FlowInertia, ForceAcrossIsThatOfABlockedCylinder) {
    const FlowInertia flow = flow_inertia(1200, 0.01, 1.2, 0.07, 0.11);
    const DragCoefficients drag = with_inertia({}, flow, 0.07, 0.3, 0, 0);
    const double gap_speed = 0.3 * 0.11 / 0.04;
    EXPECT_NEAR(drag.radial * 0.3, 1.2 * 1200 * gap_speed * gap_speed * 0.07, 1e-9);
    EXPECT_EQ(drag.around, drag.radial);
    EXPECT_EQ(drag.spin, 0);
    EXPECT_EQ(drag.axial, 0);
}

TEST(FlowInertia, GoesOverIntoCreepingFlowAtSmallReynoldsNumbers) {
    Dice dice(43);
    for (int trial = 0; trial < 1000; ++trial) {
        FluidCase fluid = random_mud(dice);
        const Annulus annulus = random_annulus(dice);
        // Reynolds numbers of 1e-4
        const double speed =
            1e-4 * fluid.viscosity / fluid.density / (annulus.pipe + annulus.clearance());
        const Stirring motion = {speed, speed, speed / annulus.pipe};
        const Eigen::Matrix4d inertial = matrix_of(drag_of(fluid, annulus, motion));
        fluid.regime = FlowRegime::laminar;
        EXPECT_LT(relative_difference(inertial, matrix_of(drag_of(fluid, annulus, motion))), 1e-3);
    }
}

TEST(FlowInertia, NeverLessensADrag) {
    Dice dice(44);
    for (int trial = 0; trial < 1000; ++trial) {
        FluidCase fluid = random_mud(dice);
        const Annulus annulus = random_annulus(dice);
        const Stirring motion = random_motion(dice);
        const Eigen::Vector4d inertial = matrix_of(drag_of(fluid, annulus, motion)).diagonal();
        fluid.regime = FlowRegime::laminar;
        const Eigen::Vector4d creeping = matrix_of(drag_of(fluid, annulus, motion)).diagonal();
        EXPECT_GE((inertial - creeping).minCoeff(), 0);
    }
}

TEST(FlowInertia, LeavesDragThatOnlyTakesEnergy) {
    Dice dice(45);
    for (int trial = 0; trial < 10000; ++trial) {
        FluidCase fluid = random_mud(dice);
        fluid.contact_drag = dice.sign() > 0;
        const Annulus annulus = random_annulus(dice, 0.99999);
        const Eigen::Matrix4d drag = matrix_of(drag_of(fluid, annulus, random_motion(dice)));
        // in units in which the pipe's radius is 1: those of translation and rotation differ
        const Eigen::Vector4d unit(1, 1, 1, 1 / annulus.pipe);
        const Eigen::Matrix4d scaled = unit.asDiagonal() * drag * unit.asDiagonal();
        EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(scaled).eigenvalues().minCoeff(),
                  0);
    }
}

TEST(WallDrag, DoesNotJumpWhereAPipeTouchesDown) {
    Dice dice(46);
    for (int trial = 0; trial < 1000; ++trial) {
        const FluidCase fluid = random_mud(dice);
        Annulus annulus = random_annulus(dice);
        const Stirring motion = random_motion(dice);
        const double clearance = annulus.clearance();
        annulus.eccentricity = clearance * (1 - 1e-13);
        const Eigen::Matrix4d above = matrix_of(drag_of(fluid, annulus, motion));
        annulus.eccentricity = clearance * (1 + 1e-13);
        const Eigen::Matrix4d below = matrix_of(drag_of(fluid, annulus, motion));
        EXPECT_LT((above - below).norm(), 1e-10 * above.norm());
        // and is continuous where the film begins to fade
        annulus.eccentricity = clearance * (1 - fluid.film * (1 + 1e-11));
        const Eigen::Matrix4d whole = matrix_of(drag_of(fluid, annulus, motion));
        annulus.eccentricity = clearance * (1 - fluid.film * (1 - 1e-11));
        const Eigen::Matrix4d fading = matrix_of(drag_of(fluid, annulus, motion));
        EXPECT_LT(relative_difference(fading, whole), 1e-8);
    }
}

TEST(WallDrag, OfAPipeThatTouchesResistsMotionAcrossAloneBecauseFrictionHoldsTheShear) {
    FluidCase fluid;
    fluid.density = 1200;
    fluid.viscosity = 0.05;
    const Annulus annulus = {0.07, 0.11, 0.0401};
    const DragCoefficients drag = drag_of(fluid, annulus, {0.1, 0.2, 3});
    EXPECT_GT(drag.radial, 0);
    EXPECT_GT(drag.around, 0);
    EXPECT_EQ(drag.axial, 0);
    EXPECT_EQ(drag.cross, 0);
    EXPECT_EQ(drag.spin, 0);
    // halfway through the film half of the shear is left
    const Annulus film = {0.07, 0.11, 0.04 * (1 - 0.005)};
    const Annulus thin = {0.07, 0.11, 0.04 * (1 - 0.01)};
    fluid.regime = FlowRegime::laminar;
    EXPECT_NEAR(drag_of(fluid, film, {}).spin / drag_of(fluid, thin, {}).spin, 0.5, 1e-9);
    EXPECT_NEAR(drag_of(fluid, film, {}).around / drag_of(fluid, thin, {}).around, 1, 1e-9);
}

TEST(WallDrag, OfThePaperEndsWhereThePipeTouches) {
    FluidCase fluid;
    fluid.density = 1200;
    fluid.viscosity = 0.05;
    fluid.contact_drag = false;
    EXPECT_EQ(matrix_of(drag_of(fluid, {0.07, 0.11, 0.0401}, {0.1, 0.2, 3})).norm(), 0);
    // and until then nothing fades
    const Annulus almost = {0.07, 0.11, 0.04 * (1 - 1e-6)};
    const Annulus film = {0.07, 0.11, 0.04 * (1 - 0.01)};
    EXPECT_NEAR(drag_of(fluid, almost, {}).spin / drag_of(fluid, film, {}).spin, 1, 1e-12);
}

}  // namespace
}  // namespace drillstrand
