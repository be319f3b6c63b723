// Contact, friction and drag of one node over a step of the leapfrog, against solutions that need
// no closed form: bisection, dense linear algebra, and the laws themselves at the end of the step.
#include "forces/implicit_contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/dice.hpp"

namespace drillstrand {
namespace {

using test::Dice;

constexpr double no_limit = std::numeric_limits<double>::infinity();

// --- normal force

struct Wall {
    double stiffness, damping, dt;
    Mobility mobility;
};

Wall random_wall(Dice& dice) {
    const double dt = dice.decades(1e-6, 1e-2);
    return {dice.decades(1, 1e12), dice.decades(1e-3, 1e10), dt, {dt / dice.decades(1, 1e3), 0, 0}};
}

TEST(ImplicitNormalForce, IsTheForceOfSpringAndDashpotAtTheEndOfTheStep) {
    Dice dice(1);
    for (int trial = 0; trial < 10000; ++trial) {
        const Wall wall = random_wall(dice);
        const double depth = dice.decades(1e-9, 1e-1);
        const double speed = dice.sign() * dice.decades(1e-6, 1e2);
        const double force = implicit_normal_force(depth, speed, wall.stiffness, wall.damping,
                                                   -no_limit, wall.dt, wall.mobility);
        // f = k (dr - dt v) - eta v with v = v* + f dt / m, in long double
        const long double mobility = wall.mobility.across;
        const long double stiffness = wall.stiffness;
        const long double resistance = wall.damping + wall.dt * stiffness;
        const long double after = speed + mobility * force;
        const long double law = stiffness * depth - resistance * after;
        // what rounding of the force does to the law, and of its two parts
        const long double rounding =
            1e-14L * ((1 + resistance * mobility) * std::abs(force) + wall.stiffness * depth +
                      resistance * std::abs(speed));
        EXPECT_LE(std::abs(law - force), rounding);
    }
}

TEST(ImplicitNormalForce, OfAWallThatOnlyPushesIsNeverNegativeAndNoneInTheOpenHole) {
    Dice dice(2);
    int pulls = 0;
    for (int trial = 0; trial < 10000; ++trial) {
        const Wall wall = random_wall(dice);
        const double depth = dice.decades(1e-9, 1e-1);
        const double speed = dice.between(-10, 10);
        const auto force = [&](double at, double least) {
            return implicit_normal_force(at, speed, wall.stiffness, wall.damping, least, wall.dt,
                                         wall.mobility);
        };
        const double free = force(depth, -no_limit);
        EXPECT_EQ(force(depth, 0), std::max(free, 0.0));
        EXPECT_EQ(force(-depth, 0), 0);
        EXPECT_EQ(force(-depth, -no_limit), 0);
        pulls += free < 0 ? 1 : 0;
    }
    EXPECT_GT(pulls, 1000);
}

TEST(ImplicitNormalForce, ReturnsNoNodeFasterThanItCame) {
    // a node that presses on into a wall of any stiffness and damping, until the wall lets it go
    Dice dice(3);
    for (int trial = 0; trial < 500; ++trial) {
        const Wall wall = random_wall(dice);
        const double came = dice.decades(1e-4, 10);  // away from the axis, against r
        double speed = -came;
        double depth = wall.dt * came * dice.between(0, 1);
        int steps = 0;
        for (; depth > 0 && steps < 20000; ++steps) {
            speed += wall.mobility.across * implicit_normal_force(depth, speed, wall.stiffness,
                                                                  wall.damping, 0, wall.dt,
                                                                  wall.mobility);
            depth -= wall.dt * speed;
        }
        EXPECT_LE(std::abs(speed), came) << "after " << steps << " steps";
    }
}

TEST(ImplicitNormalForce, HoldsANodeThatCirclesInTheWellAtTheDepthOfItsCentrifugalForce) {
    // whatever the dashpot: it acts on the distance from the axis, not on the way around it
    const double mass = 43;         // kg/m
    const double speed = 5;         // m/s
    const double clearance = 0.04;  // m
    const double stiffness = 5e7;   // Pa
    const double dt = 1e-3;         // s
    const double depth = mass * speed * speed / (clearance * stiffness);
    for (const double damping : {0.0, 1e4, 1e6, 1e8}) {
        Eigen::Vector2d position(clearance + depth, 0);
        Eigen::Vector2d velocity(0, speed);
        for (int step = 0; step < 20000; ++step) {
            const double eccentricity = position.norm();
            const Eigen::Vector2d r = -position / eccentricity;
            const double around = velocity.dot(Eigen::Vector2d(-r.y(), r.x()));
            const double approach = velocity.dot(r) - circling_speed(eccentricity, around, dt);
            velocity += dt / mass *
                        implicit_normal_force(eccentricity - clearance, approach, stiffness,
                                              damping, 0, dt, {dt / mass, 0, 0}) *
                        r;
            position += dt * velocity;
            if (step < 2000) continue;
            ASSERT_NEAR(position.norm() - clearance, depth, 0.1 * depth)
                << "step " << step << ", damping " << damping;
        }
        EXPECT_NEAR(velocity.norm(), speed, 0.01 * speed) << "damping " << damping;
    }
}

// --- Hertz's wall

TEST(ImplicitHertzForce, TendsToHertzsForceWithHuntAndCrossleysDamping) {
    Dice dice(4);
    for (int trial = 0; trial < 1000; ++trial) {
        const double mass = dice.decades(1, 1e3);
        const double stiffness = dice.decades(1e4, 1e12);
        const double chi = dice.decades(1e-2, 10);
        const double depth = dice.decades(1e-9, 1e-1);
        const double speed = dice.between(-1, 1) * std::min(1.0, 0.5 / chi);
        const double law = stiffness * std::pow(depth, 1.5) * (1 - chi * speed);
        // a step in which the wall changes nothing
        const double secant = stiffness * std::sqrt(depth);
        const double dt = 1e-6 * mass / (std::sqrt(mass * secant) + chi * secant * depth);
        EXPECT_NEAR(
            implicit_hertz_force(depth, speed, stiffness, chi, -no_limit, dt, {dt / mass, 0, 0}),
            law, 1e-4 * law);
        EXPECT_EQ(
            implicit_hertz_force(-depth, speed, stiffness, chi, -no_limit, dt, {dt / mass, 0, 0}),
            0);
    }
}

/// A node that came with `speed` away from the axis, a part of a step deep: with what it goes.
double speed_back(double stiffness, double chi, double mass, double dt, double speed, double part) {
    double v = -speed;
    for (double depth = part * dt * speed; depth > 0; depth -= dt * v)
        v += dt / mass * implicit_hertz_force(depth, v, stiffness, chi, 0, dt, {dt / mass, 0, 0});
    return v;
}

TEST(ImplicitHertzForce, ReturnsNoNodeFasterThanItCame) {
    Dice dice(5);
    for (int trial = 0; trial < 20000; ++trial) {
        const double mass = dice.decades(1, 1e3);
        const double dt = dice.decades(1e-6, 1e-2);
        const double speed = dice.decades(1e-2, 10);
        // from a thirtieth of the contact's time to a hundred times it
        const double time = dt * dice.decades(1e-2, 30);
        const double depth = speed * time / 2.9432;
        const double stiffness = 1.25 * mass * speed * speed / std::pow(depth, 2.5);
        const double chi = dice.between(0, 1) < 0.5 ? 0 : dice.decades(1e-2, 10);
        const double back = speed_back(stiffness, chi, mass, dt, speed, dice.between(0, 1));
        EXPECT_LE(back, speed * (1 + 1e-12)) << time / dt;
    }
}

TEST(ImplicitHertzForce, HoldsANodeThatCirclesInTheWellAtTheDepthOfItsCentrifugalForce) {
    const double mass = 43;         // kg/m
    const double speed = 5;         // m/s
    const double clearance = 0.04;  // m
    const double stiffness = 5e9;   // Pa/m^0.5
    const double dt = 1e-3;         // s
    const double depth = std::pow(mass * speed * speed / clearance / stiffness, 2.0 / 3);
    Eigen::Vector2d position(clearance + depth, 0);
    Eigen::Vector2d velocity(0, speed);
    for (int step = 0; step < 20000; ++step) {
        const double eccentricity = position.norm();
        const Eigen::Vector2d r = -position / eccentricity;
        const double around = velocity.dot(Eigen::Vector2d(-r.y(), r.x()));
        const double approach = velocity.dot(r) - circling_speed(eccentricity, around, dt);
        velocity += dt / mass *
                    implicit_hertz_force(eccentricity - clearance, approach, stiffness, 1, 0, dt,
                                         {dt / mass, 0, 0}) *
                    r;
        position += dt * velocity;
        if (step < 2000) continue;
        ASSERT_NEAR(position.norm() - clearance, depth, 0.1 * depth) << "step " << step;
    }
    EXPECT_NEAR(velocity.norm(), speed, 0.01 * speed);
}

// --- friction

/// The force on the cone by bisection in the logarithm of lambda, in long double.
Tangential cone_by_bisection(const Tangential& b, const Tangential& a, const FrictionParameters& p,
                             double normal) {
    const auto measured = [](double value, double coefficient) {
        return coefficient > 0 ? static_cast<long double>(value) / coefficient : 0.0L;
    };
    const long double w_l = measured(b.axial, p.slide.axial);
    const long double w_t = measured(b.azimuthal, p.slide.azimuthal);
    long double low = 1e-30L;
    long double high = 1e30L;
    for (int i = 0; i < 75; ++i) {  // to 4e-21
        const long double middle = std::sqrt(low * high);
        const long double f_l = w_l / (a.axial + middle);
        const long double f_t = w_t / (a.azimuthal + middle);
        (std::sqrt(f_l * f_l + f_t * f_t) > normal ? low : high) = middle;
    }
    return {p.slide.axial * static_cast<double>(w_l / (a.axial + low)),
            p.slide.azimuthal * static_cast<double>(w_t / (a.azimuthal + low))};
}

/// A point that slides.
struct Slide {
    Tangential b, a;
    FrictionParameters friction;
    double normal;
};

/// `ratio` is that of the mobilities around and along the well, 1 + m R^2 / (rho Ip): between 2 (a
/// thin tube) and 3 (a rod) for a pipe whose inertia follows from its section.
Slide random_slide(Dice& dice, double ratio) {
    Slide s;
    const double mu_l = dice.decades(0.01, 1.5);
    const double mu_t = mu_l * dice.decades(0.2, 5);
    s.friction = friction_parameters(dice.decades(1, 1e12), {mu_l, mu_t}, {mu_l, mu_t},
                                     FrictionLaw::coulomb);
    const double given = dice.decades(1e-12, 1e-3);  // dt^2 / m
    s.a = {given + s.friction.compliance, ratio * given + s.friction.compliance};
    s.normal = dice.decades(1e-6, 1e6);
    // from just outside the cone to a million times its limit
    const double beyond = 1 + dice.decades(1e-9, 1e6);
    const double way = dice.between(0, 2 * std::numbers::pi);
    s.b = {s.normal * mu_l * s.a.axial * beyond * std::cos(way),
           s.normal * mu_t * s.a.azimuthal * beyond * std::sin(way)};
    return s;
}

/// Largest difference from the bisection, relative to the force. Every force must be on the cone
/// and point where the spring is stretched to.
double worst_return(unsigned seed, double least_ratio, double most_ratio) {
    Dice dice(seed);
    double worst = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Slide s = random_slide(dice, dice.decades(least_ratio, most_ratio));
        const Tangential found = return_to_cone(s.b, s.a, s.friction, s.normal);
        const Tangential expected = cone_by_bisection(s.b, s.a, s.friction, s.normal);
        EXPECT_NEAR(std::sqrt(friction_demand2(found, s.friction.slide_inverse)) / s.normal, 1,
                    1e-14);
        EXPECT_GE(found.axial * s.b.axial, 0);
        EXPECT_GE(found.azimuthal * s.b.azimuthal, 0);
        worst = std::max(
            worst, std::hypot(found.axial - expected.axial, found.azimuthal - expected.azimuthal) /
                       std::hypot(expected.axial, expected.azimuthal));
    }
    return worst;
}

TEST(ReturnToCone, IsExactWhereBothDirectionsAreEquallyMobile) {
    EXPECT_LT(worst_return(4, 1, 1 + 1e-12), 2e-15);
}

TEST(ReturnToCone, IsTheSolutionByBisectionForTubesAndRods) {
    EXPECT_LT(worst_return(5, 1, 3), 1e-8);  // measured: 3e-9
}

TEST(ReturnToCone, StaysOnTheConeAndNearTheSolutionForAnyMobilities) {
    // inertias given outright; measured: 0.9e-4 and 0.035
    EXPECT_LT(worst_return(6, 1, 10), 2e-4);
    EXPECT_LT(worst_return(7, 0.01, 100), 0.05);
    // further out only the cone holds
    EXPECT_LT(worst_return(8, 1e-6, 1e6), 1);
}

TEST(ReturnToCone, WithFrictionInOneDirectionLoadsThatDirectionToItsLimit) {
    Dice dice(9);
    for (int trial = 0; trial < 1000; ++trial) {
        Slide s = random_slide(dice, dice.decades(1e-6, 1e6));
        const double mu = dice.decades(0.01, 1.5);
        s.friction = friction_parameters(1e6, {mu, 0}, {mu, 0}, FrictionLaw::coulomb);
        const Tangential along = return_to_cone(s.b, s.a, s.friction, s.normal);
        EXPECT_NEAR(along.axial, std::copysign(mu * s.normal, s.b.axial), 1e-13 * mu * s.normal);
        EXPECT_EQ(along.azimuthal, 0);
        s.friction = friction_parameters(1e6, {0, mu}, {0, mu}, FrictionLaw::coulomb);
        const Tangential around = return_to_cone(s.b, s.a, s.friction, s.normal);
        EXPECT_EQ(around.axial, 0);
        EXPECT_NEAR(around.azimuthal, std::copysign(mu * s.normal, s.b.azimuthal),
                    1e-13 * mu * s.normal);
    }
}

TEST(ReturnToCone, OfAWallThatDoesNotPressIsNoForce) {
    Dice dice(10);
    for (int trial = 0; trial < 1000; ++trial) {
        const Slide s = random_slide(dice, dice.decades(1e-6, 1e6));
        for (const double normal : {0.0, -1.0}) {
            const Tangential found = return_to_cone(s.b, s.a, s.friction, normal);
            EXPECT_EQ(found.axial, 0);
            EXPECT_EQ(found.azimuthal, 0);
        }
    }
}

/// A pipe on the wall: its spring, its motion and the wall's push.
struct Touch {
    FrictionSpring spring;
    WellVelocity v;
    double normal, rolled, radius, dt;
    Mobility mobility;
    FrictionParameters friction;
};

Touch random_touch(Dice& dice) {
    Touch touch;
    const double mass = dice.decades(10, 500);
    touch.radius = dice.decades(0.03, 0.3);
    touch.dt = dice.decades(1e-5, 5e-3);
    // between a thin tube and a rod
    const double fluid = mass * dice.between(0, 3);
    touch.mobility = {touch.dt / (mass + fluid), touch.dt / mass,
                      touch.dt / (mass * touch.radius * touch.radius * dice.between(0.5, 1))};
    const Tangential slide = {dice.decades(0.05, 1), dice.decades(0.05, 1)};
    const double more = dice.between(1, 2);
    touch.friction =
        friction_parameters(dice.decades(1, 1e12), {more * slide.axial, more * slide.azimuthal},
                            slide, FrictionLaw::coulomb, dice.between(0, 0.01));
    touch.normal = dice.decades(1e-3, 1e5);
    touch.rolled = touch.dt * dice.decades(1e-3, 10);
    const double stretch = touch.normal * touch.friction.compliance;
    touch.spring = {{stretch * slide.axial * dice.between(-0.7, 0.7),
                     stretch * slide.azimuthal * dice.between(-0.7, 0.7)},
                    dice.sign() > 0 ? 1.0 : 0.0};
    // speeds about that at which it begins to slide
    const double mobility = touch.mobility.along + touch.friction.compliance / touch.dt;
    const double speed = dice.decades(0.01, 100) * touch.normal * mobility;
    touch.v = {0, speed * dice.between(-1, 1), speed * dice.between(-1, 1),
               speed / touch.radius * dice.between(-1, 1)};
    return touch;
}

FrictionStep step_of(const Touch& t) {
    return coulomb_step(t.spring, t.v, t.normal, 1e-3, t.rolled, t.radius, t.dt, t.mobility,
                        t.friction);
}

TEST(CoulombStep, LeavesASpringThatSticksOrAPointThatSlidesAlongItsForce) {
    Dice dice(11);
    int sliding = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Touch t = random_touch(dice);
        const FrictionStep done = step_of(t);
        const Tangential f = {-done.force.axial, -done.force.azimuthal};  // pipe on wall
        // way of the surface point over the step, with the velocities that the force leaves
        const double around = t.mobility.across + t.radius * t.radius * t.mobility.rotation;
        const Tangential way = {t.dt * (t.v.l - t.mobility.along * f.axial),
                                t.dt * (t.v.t + t.radius * t.v.spin - around * f.azimuthal)};
        // unstrained material that rolls in: xi times the part of mu_d N that the force is
        const double fresh = t.friction.creep * t.rolled / t.normal;
        const Tangential creep = {fresh * f.axial / t.friction.slide.axial,
                                  fresh * f.azimuthal / t.friction.slide.azimuthal};
        const Tangential slip = {
            t.spring.elongation.axial + way.axial - creep.axial - done.spring.elongation.axial,
            t.spring.elongation.azimuthal + way.azimuthal - creep.azimuthal -
                done.spring.elongation.azimuthal};
        const double size = std::hypot(way.axial, way.azimuthal) +
                            std::hypot(f.axial, f.azimuthal) *
                                (t.friction.compliance + t.dt * (around + t.mobility.along)) +
                            std::hypot(creep.axial, creep.azimuthal);
        EXPECT_EQ(done.spring.elongation.axial, t.friction.compliance * f.axial);
        EXPECT_EQ(done.spring.elongation.azimuthal, t.friction.compliance * f.azimuthal);
        if (done.spring.sliding > 0.5) {
            ++sliding;
            EXPECT_NEAR(std::sqrt(friction_demand2(f, t.friction.slide_inverse)) / t.normal, 1,
                        1e-13);
            // the slip is along the force: no component across it, none against it
            const double across = slip.axial * f.azimuthal - slip.azimuthal * f.axial;
            // to what ReturnToCone tests for tubes and rods, or for any ratio of compliances
            const double ratio =
                (t.dt * around + t.friction.compliance + fresh / t.friction.slide.azimuthal) /
                (t.dt * t.mobility.along + t.friction.compliance + fresh / t.friction.slide.axial);
            const double within = ratio > 1 && ratio < 3 ? 1e-7 : 0.05;
            EXPECT_LT(std::abs(across), within * size * std::hypot(f.axial, f.azimuthal));
            EXPECT_GE(slip.axial * f.axial + slip.azimuthal * f.azimuthal,
                      -1e-12 * size * std::hypot(f.axial, f.azimuthal));
        } else {
            EXPECT_LT(std::hypot(slip.axial, slip.azimuthal), 1e-13 * size);
            const Tangential& limit =
                t.spring.sliding > 0.5 ? t.friction.slide_inverse : t.friction.fixed_inverse;
            EXPECT_LE(std::sqrt(friction_demand2(f, limit)), t.normal * (1 + 1e-14));
        }
    }
    EXPECT_GT(sliding, 5000);
    EXPECT_LT(sliding, 15000);
}

TEST(CoulombStep, OnAWallThatPullsDoesNotRub) {
    Dice dice(18);
    for (int trial = 0; trial < 1000; ++trial) {
        Touch t = random_touch(dice);
        t.normal *= -1;
        const FrictionStep done = step_of(t);
        EXPECT_EQ(done.force.axial, 0);
        EXPECT_EQ(done.force.azimuthal, 0);
        EXPECT_EQ(done.spring.sliding, 1);
    }
}

TEST(CoulombStep, InTheOpenHoleForgetsTheSpring) {
    Dice dice(12);
    Touch t = random_touch(dice);
    const FrictionStep done =
        coulomb_step(t.spring, t.v, 0, -1e-3, t.rolled, t.radius, t.dt, t.mobility, t.friction);
    EXPECT_EQ(done.spring.elongation.axial, 0);
    EXPECT_EQ(done.spring.elongation.azimuthal, 0);
    EXPECT_EQ(done.spring.sliding, 0);
    EXPECT_EQ(done.force.axial, 0);
    EXPECT_EQ(done.force.azimuthal, 0);
}

TEST(CoulombStep, LeavesADirectionWithoutFrictionFree) {
    Dice dice(13);
    for (int trial = 0; trial < 1000; ++trial) {
        Touch t = random_touch(dice);
        t.friction = friction_parameters(1e6, {0.6, 0}, {0.4, 0}, FrictionLaw::coulomb);
        EXPECT_EQ(step_of(t).force.azimuthal, 0);
        EXPECT_NE(step_of(t).force.axial, 0);
        t.friction = friction_parameters(1e6, {0, 0.6}, {0, 0.4}, FrictionLaw::coulomb);
        EXPECT_EQ(step_of(t).force.axial, 0);
        EXPECT_NE(step_of(t).force.azimuthal, 0);
    }
}

TEST(PaperStep, HoldsEachSpringByItsOwnLimitAtTheEndOfTheStep) {
    Dice dice(14);
    for (int trial = 0; trial < 10000; ++trial) {
        const Touch t = random_touch(dice);
        const FrictionStep done = paper_step(t.spring, t.v, t.normal, 1e-3, t.rolled, t.radius,
                                             t.dt, t.mobility, t.friction);
        const double k = t.friction.stiffness;
        const auto expect_law = [&](double elongation, double before, double force, double speed,
                                    double mobility, double fixed, double slide) {
            // u = u0 + dt v - xi s k u / (mu_d N), v = v* - M k u: a spring that sticks and rolls
            const double fresh = t.friction.creep * t.rolled / (slide * t.normal);
            const double stuck = (before + t.dt * speed) / (1 + (t.dt * mobility + fresh) * k);
            const double limit = fixed * t.normal;
            if (std::abs(std::abs(k * stuck) - limit) < 1e-12 * limit) return;
            const double expected =
                std::abs(k * stuck) > limit ? std::copysign(slide * t.normal / k, stuck) : stuck;
            const double rounding = 1e-13 * (std::abs(before) + t.dt * std::abs(speed)) /
                                    (1 + (t.dt * mobility + fresh) * k);
            EXPECT_NEAR(elongation, expected, rounding);
            EXPECT_NEAR(force, -k * expected, k * rounding);
        };
        expect_law(done.spring.elongation.axial, t.spring.elongation.axial, done.force.axial, t.v.l,
                   t.mobility.along, t.friction.fixed.axial, t.friction.slide.axial);
        expect_law(done.spring.elongation.azimuthal, t.spring.elongation.azimuthal,
                   done.force.azimuthal, t.radius * t.v.spin,
                   t.radius * t.radius * t.mobility.rotation, t.friction.fixed.azimuthal,
                   t.friction.slide.azimuthal);
    }
}

// --- drag

struct Stirred {
    DragCoefficients drag;
    Mobility mobility;
    WellVelocity v;
};

Stirred random_stir(Dice& dice) {
    Stirred s;
    const double pipe = dice.decades(0.02, 0.3);
    const double hole = pipe * (1 + dice.decades(0.02, 5));
    s.drag = drag_coefficients({dice.between(0, 0.999) * (hole - pipe), pipe, hole});
    if (dice.sign() > 0) s.drag.axial = concentric_axial_drag(pipe, hole);
    s.drag = scaled(s.drag, dice.decades(1e-6, 1e4));
    const double mass = dice.decades(1, 1e3);
    const double fluid = mass * dice.between(0, 3);
    const double dt = dice.decades(1e-6, 1e-2);
    s.mobility = {dt / (mass + fluid), dt / mass, dt / (mass * pipe * pipe * dice.between(0.5, 1))};
    s.v = {dice.between(-5, 5), dice.between(-5, 5), dice.between(-5, 5), dice.between(-50, 50)};
    return s;
}

TEST(ImplicitDrag, IsTheDenseSolutionForVelocitiesThatTheirOwnDragHasBraked) {
    Dice dice(15);
    for (int trial = 0; trial < 10000; ++trial) {
        const Stirred s = random_stir(dice);
        Eigen::Matrix4d drag = Eigen::Matrix4d::Zero();  // of (v_r, v_l, v_t, spin)
        drag(0, 0) = s.drag.radial;
        drag(1, 1) = s.drag.axial;
        drag.bottomRightCorner<2, 2>() << s.drag.around, s.drag.cross, s.drag.cross, s.drag.spin;
        const Eigen::Vector4d mobility(s.mobility.across, s.mobility.along, s.mobility.across,
                                       s.mobility.rotation);
        const Eigen::Matrix4d system =
            Eigen::Matrix4d(Eigen::Matrix4d::Identity() + mobility.asDiagonal() * drag);
        const Eigen::Vector4d star(s.v.r, s.v.l, s.v.t, s.v.spin);
        const WellVelocity v = implicit_drag(s.v, s.drag, s.mobility);
        const Eigen::Vector4d found(v.r, v.l, v.t, v.spin);
        // the velocities must satisfy the law: residual against rounding of its parts
        const Eigen::Vector4d residual = system * found - star;
        const Eigen::Vector4d parts = system.cwiseAbs() * found.cwiseAbs() + star.cwiseAbs();
        for (Eigen::Index i = 0; i < 4; ++i)
            EXPECT_LT(std::abs(residual[i]), 1e-11 * parts[i]) << i;
        const Eigen::Vector4d dense = system.fullPivLu().solve(star);
        EXPECT_LT((found - dense).norm(), 1e-9 * dense.norm() + 1e-12 * star.norm());
    }
}

TEST(ImplicitDrag, OnlyTakesEnergy) {
    Dice dice(16);
    for (int trial = 0; trial < 10000; ++trial) {
        const Stirred s = random_stir(dice);
        // per mobility, which is energy per length over the step
        const auto energy = [&](const WellVelocity& v) {
            return (v.r * v.r + v.t * v.t) / s.mobility.across + v.l * v.l / s.mobility.along +
                   v.spin * v.spin / s.mobility.rotation;
        };
        EXPECT_LE(energy(implicit_drag(s.v, s.drag, s.mobility)), energy(s.v));
    }
}

TEST(ImplicitDrag, WithoutViscosityChangesNothing) {
    Dice dice(17);
    const Stirred s = random_stir(dice);
    const WellVelocity v = implicit_drag(s.v, scaled(s.drag, 0), s.mobility);
    EXPECT_DOUBLE_EQ(v.r, s.v.r);
    EXPECT_DOUBLE_EQ(v.l, s.v.l);
    EXPECT_DOUBLE_EQ(v.t, s.v.t);
    EXPECT_DOUBLE_EQ(v.spin, s.v.spin);
}

}  // namespace
}  // namespace drillstrand
