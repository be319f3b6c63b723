// Normal force and friction of one node whose motion along the wall is prescribed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "forces/contact.hpp"

namespace drillstrand {
namespace {

constexpr double stiffness = 1e6;  // k_tan (Pa)
constexpr double normal = 250;     // N/m
constexpr double touching = 1e-3;  // m of penetration
constexpr double inside = -1e-3;   // m of open hole

FrictionParameters material(Tangential fixed, Tangential slide,
                            FrictionLaw law = FrictionLaw::coulomb) {
    return friction_parameters(stiffness, fixed, slide, law);
}
const FrictionParameters steel = material({0.6, 0.6}, {0.42, 0.42});

double size(const Tangential& v) {
    return std::hypot(v.axial, v.azimuthal);
}

/// A spring whose surface point has moved in `steps` equal parts.
FrictionSpring moved(FrictionSpring spring, Tangential way, int steps, const FrictionParameters& p,
                     double normal_force = normal) {
    const Tangential slip = {way.axial / steps, way.azimuthal / steps};
    for (int i = 0; i < steps; ++i)
        spring = coulomb_spring(spring, slip, 0, normal_force, touching, p);
    return spring;
}

TEST(NormalForce, IsSpringAndDashpotTowardTheAxis) {
    EXPECT_DOUBLE_EQ(normal_force(2e-3, 0.1, 1e7, 1e4, 0), 2e4 - 1e3);
    EXPECT_DOUBLE_EQ(normal_force(2e-3, -0.1, 1e7, 1e4, 0), 2e4 + 1e3);
}

TEST(NormalForce, NeverPullsUnlessTheDashpotMay) {
    const double free = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(normal_force(1e-4, 1.0, 1e7, 1e4, 0), 0);
    EXPECT_DOUBLE_EQ(normal_force(1e-4, 1.0, 1e7, 1e4, free), 1e3 - 1e4);
}

TEST(NormalForce, VanishesInTheOpenHole) {
    const double free = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(normal_force(-1e-4, -1.0, 1e7, 1e4, 0), 0);
    EXPECT_EQ(normal_force(-1e-4, 1.0, 1e7, 1e4, free), 0);
    EXPECT_EQ(normal_force(0, -1.0, 1e7, 1e4, 0), 0);
}

TEST(Coulomb, BelowTheStaticLimitFrictionIsASpring) {
    const double way = 0.59 * normal / stiffness;
    const FrictionSpring spring = moved({}, {way, 0}, 50, steel);
    EXPECT_EQ(spring.sliding, 0);
    EXPECT_NEAR(friction_force(spring, normal, steel).axial, -0.59 * normal, 1e-9);
    EXPECT_EQ(friction_force(spring, normal, steel).azimuthal, 0);
}

TEST(Coulomb, SteadySlidingIsHeldByDynamicFrictionNotBySomeMeanOfBoth) {
    FrictionSpring spring = moved({}, {1e-3, 0}, 1000, steel);
    double sum = 0;
    constexpr int samples = 1000;
    for (int i = 0; i < samples; ++i) {
        spring = moved(spring, {1e-6, 0}, 1, steel);
        sum += friction_force(spring, normal, steel).axial;
        EXPECT_EQ(spring.sliding, 1);
    }
    EXPECT_NEAR(sum / samples, -0.42 * normal, 1e-9 * normal);
}

TEST(Coulomb, SlidingPointSticksAgainWithTheStaticLimitWhenItTurnsBack) {
    FrictionSpring spring = moved({}, {1e-3, 0}, 1000, steel);
    spring = moved(spring, {-1e-5, 0}, 1, steel);
    EXPECT_EQ(spring.sliding, 0);
    // from -0.42 N to nearly +0.6 N without slip
    spring = moved(spring, {-(0.42 + 0.59) * normal / stiffness + 1e-5, 0}, 100, steel);
    EXPECT_EQ(spring.sliding, 0);
    EXPECT_NEAR(friction_force(spring, normal, steel).axial, 0.59 * normal, 1e-6 * normal);
}

TEST(Coulomb, ConeIsRoundAndFrictionPointsAgainstTheSlip) {
    for (double angle = 0; angle < 6.3; angle += 0.3) {
        const Tangential way = {1e-2 * std::cos(angle), 1e-2 * std::sin(angle)};
        const FrictionSpring spring = moved({}, way, 1000, steel);
        const Tangential force = friction_force(spring, normal, steel);
        EXPECT_NEAR(size(force), 0.42 * normal, 1e-9 * normal);
        EXPECT_NEAR(force.axial, -0.42 * normal * std::cos(angle), 1e-9 * normal);
        EXPECT_NEAR(force.azimuthal, -0.42 * normal * std::sin(angle), 1e-9 * normal);
    }
}

// Rotation frees a string axially: the friction of fast rotation has no axial part left.
TEST(Coulomb, RotationTakesTheAxialFriction) {
    const FrictionSpring spring = moved({}, {1e-3, 1e-1}, 10000, steel);
    EXPECT_NEAR(friction_force(spring, normal, steel).axial, -0.42 * normal * 0.01, 1e-4 * normal);
}

TEST(Coulomb, CoefficientsMayDifferAlongAndAroundTheWell) {
    const FrictionParameters grooved = material({0.3, 0.6}, {0.2, 0.5});
    const FrictionSpring along = moved({}, {1e-2, 0}, 1000, grooved);
    const FrictionSpring around = moved({}, {0, 1e-2}, 1000, grooved);
    EXPECT_NEAR(friction_force(along, normal, grooved).axial, -0.2 * normal, 1e-9 * normal);
    EXPECT_NEAR(friction_force(around, normal, grooved).azimuthal, -0.5 * normal, 1e-9 * normal);
    // in between, the force ends on the ellipse
    const FrictionSpring diagonal = moved({}, {1e-2, 1e-2}, 1000, grooved);
    const Tangential force = friction_force(diagonal, normal, grooved);
    EXPECT_NEAR(std::hypot(force.axial / 0.2, force.azimuthal / 0.5), normal, 1e-9 * normal);
}

TEST(Coulomb, DirectionWithoutFrictionIsFree) {
    const FrictionParameters rails = material({0, 0.6}, {0, 0.42});
    const FrictionSpring spring = moved({}, {1e-2, 1e-2}, 1000, rails);
    EXPECT_EQ(friction_force(spring, normal, rails).axial, 0);
    EXPECT_NEAR(friction_force(spring, normal, rails).azimuthal, -0.42 * normal, 1e-9 * normal);
    const FrictionParameters ice = material({0, 0}, {0, 0});
    EXPECT_EQ(size(friction_force(moved({}, {1e-2, 1e-2}, 10, ice), normal, ice)), 0);
}

TEST(Coulomb, FallingNormalForceTakesTheLimitWithIt) {
    const FrictionSpring spring = moved({}, {1e-3, 0}, 1000, steel);
    EXPECT_NEAR(friction_force(spring, 100, steel).axial, -42, 1e-9);
    EXPECT_NEAR(friction_force(spring, 0, steel).axial, 0, 1e-300);
}

TEST(Coulomb, WallThatPullsDoesNotRub) {
    const FrictionSpring stretched = moved({}, {1e-3, 1e-3}, 1000, steel);
    EXPECT_NEAR(size(friction_force(stretched, -normal, steel)), 0, 1e-290);
    const FrictionSpring spring = coulomb_spring(stretched, {1e-6, 0}, 0, -normal, touching, steel);
    EXPECT_NEAR(size(spring.elongation), 0, 1e-290);
}

TEST(Coulomb, SpringIsForgottenInTheOpenHole) {
    const FrictionSpring stretched = moved({}, {1e-3, 1e-3}, 1000, steel);
    const FrictionSpring spring = coulomb_spring(stretched, {0, 0}, 0, 0, inside, steel);
    EXPECT_EQ(size(spring.elongation), 0);
    EXPECT_EQ(spring.sliding, 0);
}

TEST(Coulomb, SlipOfASpinningPipeIsThatOfItsSurface) {
    const Tangential rolling = slip_velocity(0.2, -0.7, 10, 0.07);
    EXPECT_DOUBLE_EQ(rolling.axial, 0.2);
    EXPECT_NEAR(rolling.azimuthal, 0, 1e-15);
}

// --- rolling

FrictionParameters rolling_steel(double creep, FrictionLaw law = FrictionLaw::coulomb) {
    return friction_parameters(stiffness, {0.6, 0.6}, {0.42, 0.3}, law, creep);
}

/// A spring held in both directions while the contact rolls, in equal steps.
FrictionSpring held_and_rolled(double way, int steps, const FrictionParameters& p) {
    FrictionSpring spring = {{1e-4 * 0.6, -1e-4 * 0.4}, 0};
    for (int i = 0; i < steps; ++i) {
        spring = p.law == FrictionLaw::paper
                     ? paper_spring(spring, {0, 0}, way / steps, normal, touching, p)
                     : coulomb_spring(spring, {0, 0}, way / steps, normal, touching, p);
    }
    return spring;
}

// du/ds = -xi k u / (mu_d N): a carpet of bristles of which rolling brings fresh ones in
TEST(Rolling, RelaxesAHeldSpringExponentially) {
    for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::paper}) {
        const FrictionParameters p = rolling_steel(0.005, law);
        const double way = 0.02;
        const FrictionSpring spring = held_and_rolled(way, 100000, p);
        const double axial = 0.42 * normal / (0.005 * stiffness);  // way of relaxation (m)
        const double azimuthal = 0.3 * normal / (0.005 * stiffness);
        EXPECT_NEAR(spring.elongation.axial / (0.6e-4 * std::exp(-way / axial)), 1, 1e-5);
        EXPECT_NEAR(spring.elongation.azimuthal / (-0.4e-4 * std::exp(-way / azimuthal)), 1, 1e-5);
        EXPECT_EQ(spring.sliding, 0);
    }
}

TEST(Rolling, InOneLongStepLeavesTheImplicitShare) {
    const double way = 0.5;
    const FrictionSpring spring = held_and_rolled(way, 1, rolling_steel(0.005));
    EXPECT_DOUBLE_EQ(spring.elongation.axial,
                     0.6e-4 / (1 + stiffness * 0.005 * way / (0.42 * normal)));
}

TEST(Rolling, WithoutCreepLeavesTheSpringAlone) {
    for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::paper}) {
        const FrictionSpring spring = held_and_rolled(10, 100, rolling_steel(0, law));
        EXPECT_EQ(spring.elongation.axial, 0.6e-4);
        EXPECT_EQ(spring.elongation.azimuthal, -0.4e-4);
    }
}

// Drawn over the wall at a creepage c while it rolls, the force settles at c / xi of mu_d N.
TEST(Rolling, ForceIsInProportionToTheCreepageAndSaturatesAtXi) {
    const double creep = 0.005;
    const FrictionParameters p = rolling_steel(creep);
    const auto settled = [&](double creepage) {
        FrictionSpring spring{};
        constexpr double way = 1e-4;
        for (int i = 0; i < 100000; ++i)
            spring = coulomb_spring(spring, {creepage * way, 0}, way, normal, touching, p);
        return friction_force(spring, normal, p).axial / (0.42 * normal);
    };
    EXPECT_NEAR(settled(0.1 * creep), -0.1, 1e-9);
    EXPECT_NEAR(settled(-0.9 * creep), 0.9, 1e-9);
    EXPECT_NEAR(settled(10 * creep), -1, 1e-9);
}

TEST(Rolling, ContactGoesAroundTheWallAtTheRateOfThePipe) {
    // a pipe at e = 0.04 m with 0.2 m/s goes around at 5 rad/s: its contact at 5 times 0.11 m
    EXPECT_NEAR(rolling_speed(-0.2, 0.04, 0.11), 0.55, 1e-15);
    EXPECT_EQ(rolling_speed(0, 0, 0.11), 0);
}

// --- the paper's two springs

/// Mean force of one of the paper's springs over many teeth of its saw.
Tangential mean_paper_force(Tangential direction) {
    const FrictionParameters p = material({0.6, 0.6}, {0.42, 0.42}, FrictionLaw::paper);
    constexpr int steps = 200000;
    const double step = 0.18 * normal / stiffness / 500;  // 500 steps to a tooth
    FrictionSpring spring{};
    Tangential sum = {0, 0};
    for (int i = 0; i < steps; ++i) {
        spring = paper_spring(spring, {step * direction.axial, step * direction.azimuthal}, 0,
                              normal, touching, p);
        const Tangential force = friction_force(spring, normal, p);
        sum.axial += force.axial / steps;
        sum.azimuthal += force.azimuthal / steps;
    }
    return sum;
}

TEST(PaperLaw, SawtoothHasTheMeanOfStaticAndDynamicFriction) {
    EXPECT_NEAR(mean_paper_force({1, 0}).axial, -0.51 * normal, 0.005 * normal);
    EXPECT_NEAR(mean_paper_force({0, -1}).azimuthal, 0.51 * normal, 0.005 * normal);
}

TEST(PaperLaw, SpringsAreIndependentSoThatDiagonalSlidingMeetsMoreThanTheConeAllows) {
    const Tangential force = mean_paper_force({1, 1});
    EXPECT_NEAR(force.axial, -0.51 * normal, 0.005 * normal);
    EXPECT_NEAR(force.azimuthal, -0.51 * normal, 0.005 * normal);
}

TEST(PaperLaw, SpringBeyondTheStaticLimitIsShortenedToTheDynamicOne) {
    const FrictionParameters p = material({0.6, 0.6}, {0.42, 0.42}, FrictionLaw::paper);
    const double limit = 0.6 * normal / stiffness;
    const FrictionSpring below = paper_spring({}, {0.999 * limit, 0}, 0, normal, touching, p);
    EXPECT_DOUBLE_EQ(below.elongation.axial, 0.999 * limit);
    const FrictionSpring past = paper_spring({}, {-1.001 * limit, 0}, 0, normal, touching, p);
    EXPECT_DOUBLE_EQ(past.elongation.axial, -0.42 * normal / stiffness);
}

TEST(PaperLaw, SpringsAreForgottenInTheOpenHole) {
    const FrictionParameters p = material({0.6, 0.6}, {0.42, 0.42}, FrictionLaw::paper);
    const FrictionSpring spring = paper_spring({{1e-4, -1e-4}, 0}, {0, 0}, 0, 0, inside, p);
    EXPECT_EQ(size(spring.elongation), 0);
}

}  // namespace
}  // namespace drillstrand
