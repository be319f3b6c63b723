/// Studies of torque and drag: the stiff string against exact loads and against the soft string.
#include "drillstrand/torque_drag.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "drillstrand/error.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

using Motion = TorqueDragMotion;

constexpr double degree = std::numbers::pi / 180;
constexpr double radius = 0.07;  // m

const std::vector<Motion> all_motions{Motion::tripping_in, Motion::tripping_out, Motion::rotating,
                                      Motion::drilling, Motion::sliding};

/// Pipe of 0.14 m x 0.12 m, 31.8557 kg/m, in water; g = 9.81 m/s2.
constexpr double pipe_weight = 272.43968589;  // N/m

const std::string pipe = R"(gravity = 9.81
[fluid]
density = 1000
[[string.component]]
name = "pipe"
length = 1000
outer_diameter = 0.14
inner_diameter = 0.12
linear_density = 31.8557
youngs_modulus = "200 GPa"
poisson_ratio = 0.0
)";

const std::string collar = R"([[string.component]]
name = "collar"
length = 100
outer_diameter = 0.18
inner_diameter = 0.07
linear_density = 170
youngs_modulus = "200 GPa"
poisson_ratio = 0.0
)";
constexpr double collar_weight =
    9.81 * (170 - 1000 * std::numbers::pi / 4 * (0.18 * 0.18 - 0.07 * 0.07));  // N/m

/// The string in a well of 0.22 m.
Case case_in(const std::vector<SurveyStation>& survey, double friction,
             const std::string& string = pipe) {
    Case input = test::case_from(string + "[mesh]\nelement_length = 10\n[run]\nduration = 1\n");
    input.well = WellCase{survey, {{survey.back().measured_depth, 0.22}}};
    input.bit.direction = BitDirection::well;
    input.torque_drag.friction = FrictionCoefficients{friction, friction};
    input.torque_drag.motions = all_motions;
    return input;
}

std::vector<SurveyStation> vertical(double depth) {
    return {{0, 0, 0}, {depth, 0, 0}};
}

const TorqueDragCurve& curve(const TorqueDrag& study, Motion motion) {
    return *std::find_if(study.curves.begin(), study.curves.end(),
                         [&](const TorqueDragCurve& one) { return one.motion == motion; });
}

void expect_close(double value, double expected, double relative) {
    EXPECT_NEAR(value, expected, relative * std::abs(expected));
}

constexpr double bend_end = 500 + 300 * 60 * degree;
constexpr double total_depth = bend_end + 1000;

Case build_and_hold(double friction) {
    Case input =
        case_in({{0, 0, 0}, {500, 0, 0}, {bend_end, 60 * degree, 0}, {total_depth, 60 * degree, 0}},
                friction);
    input.bit.weight = ScalarSchedule(50e3);
    input.torque_drag.depths = {total_depth};
    return input;
}

TEST(TorqueDrag, StiffHookLoadsOfBuildAndHoldWellAreNearThoseOfTheSoftString) {
    for (const double mu : {0.1, 0.2, 0.35}) {
        for (const TorqueDragCurve& one : compute_torque_drag(build_and_hold(mu)).curves) {
            expect_close(one.hook_load.front(), one.soft_hook_load.front(), 0.01);
            EXPECT_THAT(one.failures, testing::IsEmpty());
        }
    }
}

TEST(TorqueDrag, StiffStringClimbsTheWallAsItTurnsWhichLightensItsTorque) {
    // At the angle atan(mu) the wall's normal force and its friction balance the lateral load
    // together; the soft string leaves friction out of that balance.
    for (const double mu : {0.1, 0.2, 0.35}) {
        for (const TorqueDragCurve& one : compute_torque_drag(build_and_hold(mu)).curves) {
            if (one.motion != Motion::rotating && one.motion != Motion::drilling) continue;
            expect_close(one.surface_torque.front(),
                         one.soft_surface_torque.front() / std::sqrt(1 + mu * mu), 0.01);
        }
    }
}

// A slant that casing lets the string slide down and the open hole does not: what slides is
// w (L cos - sum of mu_i L_i sin), and weight on the bit takes as much from the hook.
TEST(TorqueDrag, LocksUpWhereFrictionBearsTheString) {
    const double inclination = 70 * degree;
    Case input = case_in({{0, inclination, 1}, {3000, inclination, 1}}, 0);
    input.torque_drag.friction.reset();
    WellSectionCase casing{.to = 1200, .diameter = 0.22};
    casing.static_friction = casing.dynamic_friction = {0.2, 0.2};
    WellSectionCase open{.to = 3000, .diameter = 0.22};
    open.static_friction = open.dynamic_friction = {0.5, 0.5};
    input.well->sections = {casing, open};
    input.torque_drag.depths = {1000, 2000, 3000};
    input.bit.weight = ScalarSchedule(20e3);
    const double cased = std::cos(inclination) - 0.2 * std::sin(inclination);
    const double opened = std::cos(inclination) - 0.5 * std::sin(inclination);
    const double weight = input.bit.weight.values().back();
    for (const TorqueDragCurve& one : compute_torque_drag(input).curves) {
        if (one.motion != Motion::tripping_in && one.motion != Motion::sliding) {
            EXPECT_TRUE(std::isnan(one.lock_up_depth));
            continue;
        }
        const bool slides = one.motion == Motion::sliding;
        const double borne = slides ? weight / pipe_weight : 0;
        // the first metres below the head, which holds the pipe off the wall, do not rub
        EXPECT_NEAR(one.lock_up_depth, 1200 - (1200 * cased - borne) / opened, 20);
        if (!slides) continue;
        // nothing is left at 3000 m
        EXPECT_EQ(one.largest_weight, 0);
    }
    input.torque_drag.depths = {2000};
    input.torque_drag.motions = {Motion::sliding};
    EXPECT_NEAR(compute_torque_drag(input).curves.front().largest_weight,
                pipe_weight * (1200 * cased + 800 * opened), 1e3);
}

// Casing to 1200 m and open hole below: what rubs is the sum of mu_i w L_i sin(inclination).
TEST(TorqueDrag, InCasingAndOpenHoleHasTheFrictionOfEach) {
    const double inclination = 50 * degree;
    Case input = case_in({{0, inclination, 1}, {2000, inclination, 1}}, 0);
    input.torque_drag.friction.reset();
    WellSectionCase casing{.to = 1200, .diameter = 0.22};
    casing.static_friction = casing.dynamic_friction = {0.15, 0.15};
    WellSectionCase open{.to = 2000, .diameter = 0.22};
    open.static_friction = open.dynamic_friction = {0.35, 0.35};
    input.well->sections = {casing, open};
    input.torque_drag.depths = {600, 2000};
    const TorqueDrag study = compute_torque_drag(input);
    const double press = pipe_weight * std::sin(inclination);
    const double slope = pipe_weight * std::cos(inclination);
    constexpr double near = 0.005;
    for (const TorqueDragCurve& one : study.curves) {
        if (one.motion == Motion::sliding || one.motion == Motion::drilling) continue;
        const bool rotates = one.motion == Motion::rotating;
        const double sign = rotates ? 0 : one.motion == Motion::tripping_in ? -1 : 1;
        const double in_casing = slope * 600 + sign * 0.15 * press * 600;
        const double in_both = slope * 2000 + sign * press * (0.15 * 1200 + 0.35 * 800);
        expect_close(one.soft_hook_load[0], in_casing, 1e-9);
        expect_close(one.soft_hook_load[1], in_both, 1e-9);
        expect_close(one.hook_load[0], in_casing, near);
        expect_close(one.hook_load[1], in_both, near);
        if (!rotates) continue;
        expect_close(one.soft_surface_torque[1], radius * press * (0.15 * 1200 + 0.35 * 800), 1e-9);
        const double climbing =
            radius * press * (0.15 * 1200 / std::hypot(1, 0.15) + 0.35 * 800 / std::hypot(1, 0.35));
        expect_close(one.surface_torque[1], climbing, near);
    }
    // the study's own friction is that of all sections
    input.torque_drag.friction = FrictionCoefficients{0.2, 0.2};
    const TorqueDrag own = compute_torque_drag(input);
    expect_close(curve(own, Motion::tripping_out).soft_hook_load[1],
                 slope * 2000 + press * 0.2 * 2000, 1e-9);
}

/// Mud of a well by its pump; without friction.
Case pumped(double depth) {
    Case input = case_in(vertical(depth), 0);
    input.fluid->viscosity = 0.4;
    input.fluid->flow_index = 0.7;
    input.fluid->yield_stress = 4;
    input.fluid->flow_rate = 0.03;
    input.fluid->nozzle_area = 4e-4;
    input.torque_drag.depths = {depth};
    return input;
}

TEST(TorqueDrag, MudInMotionLiftsTheStringByTheForceThatIsTold) {
    const TorqueDragCurve rotating = curve(compute_torque_drag(pumped(1000)), Motion::rotating);
    EXPECT_LT(rotating.mud_force[0], -1000 * 0.03 * 0.03 / 4e-4);  // of the jets alone
    const double expected = 1000 * pipe_weight + rotating.mud_force[0];
    expect_close(rotating.hook_load[0], expected, 1e-9);
    expect_close(rotating.soft_hook_load[0], expected, 1e-6);
    // the pump's pressure and the column
    expect_close(rotating.bit_pressure[0], rotating.equivalent_density[0] * 9.81 * 1000, 1e-9);
    EXPECT_GT(rotating.bit_pressure[0], 1000 * 9.81 * 1000);
    EXPECT_GT(rotating.standpipe_pressure[0], rotating.bit_pressure[0] - 1000 * 9.81 * 1000);
}

// Balance of the metal from the bit up: pressure and jets on its end, its weight, shear of both
// flows on its walls.
TEST(TorqueDrag, TrueTensionIsWhatPressuresAndShearOnTheMetalMakeIt) {
    const Case input = pumped(1000);
    const TorqueDrag study = compute_torque_drag(input);
    const TorqueDragCurve& rotating = curve(study, Motion::rotating);
    const TorqueDragProfile& profile = rotating.profile;
    constexpr double outer = std::numbers::pi * 0.07 * 0.07;
    constexpr double inner = std::numbers::pi * 0.06 * 0.06;
    const auto loss = [&](const std::vector<double>& pressure) {  // beside the column's
        const std::size_t last = pressure.size() - 1;
        return (pressure[last] - pressure[0]) /
                   (study.measured_depth[last] - study.measured_depth[0]) -
               1000 * 9.81;
    };
    const double inside = -loss(profile.inside_pressure);
    const double annulus = loss(profile.outside_pressure);
    const double speed = 0.03 / inner;
    const double jet = 0.03 / 4e-4;
    const double bit_loss = 500 * jet * jet / (0.95 * 0.95);
    const double end = (rotating.bit_pressure[0] + bit_loss) * inner -
                       rotating.bit_pressure[0] * outer + 1000 * 0.03 * (speed - jet);
    const double shear = annulus * (0.11 - 0.07) / 2 * 2 * std::numbers::pi * 0.07;
    const double per_length = 31.8557 * 9.81 + inside * inner - shear;
    for (const std::size_t k : {std::size_t{0}, profile.tension.size() / 2}) {
        const double expected = end + per_length * (1000 - study.measured_depth[k]);
        expect_close(profile.true_tension[k], expected, 1e-6);
    }
}

TEST(TorqueDrag, TripsPushMudAside) {
    Case input = pumped(1000);
    input.fluid->trip_speed = 0.5;
    const TorqueDrag study = compute_torque_drag(input);
    const TorqueDragCurve& in = curve(study, Motion::tripping_in);
    const TorqueDragCurve& out = curve(study, Motion::tripping_out);
    // surge lifts, swab holds, by as much; the pump stands still
    EXPECT_LT(in.mud_force[0], 0);
    expect_close(out.mud_force[0], -in.mud_force[0], 1e-9);
    for (const TorqueDragCurve* trip : {&in, &out}) {
        expect_close(trip->hook_load[0], 1000 * pipe_weight + trip->mud_force[0], 1e-9);
        expect_close(trip->soft_hook_load[0], 1000 * pipe_weight + trip->mud_force[0], 1e-6);
    }
    expect_close(in.bit_pressure[0] + out.bit_pressure[0], 2 * 1000 * 9.81 * 1000, 1e-9);
    EXPECT_GT(in.equivalent_density[0], 1000);
    EXPECT_LT(curve(study, Motion::rotating).mud_force[0], 0);
}

TEST(TorqueDrag, MudInMotionInABentWellLiftsStiffAndSoftStringAlike) {
    Case input = build_and_hold(0.2);
    const double at_rest =
        curve(compute_torque_drag(input), Motion::tripping_out).hook_load.front();
    input.fluid->viscosity = 0.4;
    input.fluid->flow_index = 0.7;
    input.fluid->flow_rate = 0.03;
    const TorqueDragCurve out = curve(compute_torque_drag(input), Motion::tripping_out);
    expect_close(out.hook_load.front(), out.soft_hook_load.front(), 0.01);
    // less tension presses less in the bend: friction adds to the lift
    EXPECT_LT(out.hook_load.front(), at_rest + out.mud_force.front());
}

// A casing shoe at 1200 m, with a node on it and one in its shoulder.
TEST(TorqueDrag, OverAShoeThatNodesStandOnIsFound) {
    Case input = build_and_hold(0.2);
    WellSectionCase casing{.to = 1200, .diameter = 0.25};
    casing.dynamic_friction = casing.static_friction = {0.15, 0.15};
    WellSectionCase open{.to = total_depth, .diameter = 0.22};
    open.normal_stiffness = 2e6;
    input.well->sections = {casing, open};
    input.torque_drag.friction.reset();
    for (const double depth : {1200.0, 1200.1, total_depth}) {
        input.torque_drag.depths = {depth};
        for (const TorqueDragCurve& one : compute_torque_drag(input).curves) {
            EXPECT_THAT(one.failures, testing::IsEmpty());
            expect_close(one.hook_load.front(), one.soft_hook_load.front(), 0.02);
        }
    }
}

TEST(TorqueDrag, InStraightInclinedWellHasTheLoadsOfABodyOnASlope) {
    const double inclination = 50 * degree;
    const double mu = 0.3;
    Case input = case_in({{0, inclination, 1}, {2000, inclination, 1}}, mu);
    input.bit.weight = ScalarSchedule(30e3);
    input.bit.torque = ScalarSchedule(2e3);
    input.torque_drag.depths = {2000};
    const TorqueDrag study = compute_torque_drag(input);
    const double along = pipe_weight * 2000 * std::cos(inclination);
    const double rub = mu * pipe_weight * 2000 * std::sin(inclination);
    const double climbing_rub = rub / std::sqrt(1 + mu * mu);

    // at the clamped head the string hangs free over some 25 m
    constexpr double near = 0.005;
    const auto hook = [&](Motion motion) { return curve(study, motion).hook_load.front(); };
    const auto torque = [&](Motion motion) { return curve(study, motion).surface_torque.front(); };
    expect_close(hook(Motion::tripping_in), along - rub, near);
    expect_close(hook(Motion::tripping_out), along + rub, near);
    expect_close(hook(Motion::sliding), along - rub - 30e3, near);
    expect_close(hook(Motion::rotating), along, near);
    expect_close(hook(Motion::drilling), along - 30e3, near);
    expect_close(torque(Motion::rotating), climbing_rub * radius, 0.02);
    expect_close(torque(Motion::drilling) - torque(Motion::rotating), 2e3, 0.01);
    EXPECT_NEAR(torque(Motion::tripping_in), 0, 1e-6);
}

TEST(TorqueDrag, NeutralPointOfVerticalStringIsWhereTheWeightBelowIsThatOnTheBit) {
    Case input = case_in(vertical(1000), 0.2);
    input.bit.weight = ScalarSchedule(4e3);
    // above the last segment, of whose weight a part hangs on the node above
    input.mesh.segments = 200;
    input.torque_drag.depths = {400, 1000};
    const TorqueDrag study = compute_torque_drag(input);
    for (std::size_t i = 0; i < 2; ++i) {
        const double bit = study.bit_depth[i];
        EXPECT_NEAR(curve(study, Motion::drilling).neutral_point[i], bit - 4e3 / pipe_weight, 1e-6);
        EXPECT_NEAR(curve(study, Motion::rotating).neutral_point[i], bit, 1e-6);
    }
}

TEST(TorqueDrag, StringIsCutOrLengthenedAtItsTop) {
    Case input = case_in(vertical(1500), 0.2, pipe + collar);
    input.torque_drag.motions = {Motion::rotating};
    input.torque_drag.depths = {60, 100, 437.5, 1100, 1400};
    const TorqueDrag study = compute_torque_drag(input);
    for (std::size_t i = 0; i < study.bit_depth.size(); ++i) {
        const double collars = std::min(100.0, study.bit_depth[i]);
        const double weight =
            collar_weight * collars + pipe_weight * (study.bit_depth[i] - collars);
        expect_close(study.curves.front().hook_load[i], weight, 1e-9);
        expect_close(study.curves.front().soft_hook_load[i], weight, 1e-9);
    }
    // segments keep their 10 m
    EXPECT_EQ(study.segment_s.size(), 140U);
    EXPECT_DOUBLE_EQ(study.node_s.back(), 1400);
}

TEST(TorqueDrag, ProfileAgreesWithHookLoadTorqueAndSectionOfThePipe) {
    const TorqueDrag study = compute_torque_drag(build_and_hold(0.2));
    const TorqueDragCurve& drilling = curve(study, Motion::drilling);
    const TorqueDragProfile& profile = drilling.profile;
    const double segment = total_depth / static_cast<double>(study.segment_s.size());
    EXPECT_NEAR(profile.tension.front(), drilling.hook_load.front() - pipe_weight * segment / 2, 1);
    EXPECT_NEAR(profile.torque.front(), drilling.surface_torque.front(), 1);
    // in the bend the pipe takes the curvature of the well: stress E R / 300 m
    const auto middle =
        std::lower_bound(study.measured_depth.begin(), study.measured_depth.end(), 650) -
        study.measured_depth.begin();
    const auto k = static_cast<std::size_t>(middle);
    expect_close(profile.bending_stress[k], 200e9 * radius / 300, 0.05);
    const double area = std::numbers::pi / 4 * (0.14 * 0.14 - 0.12 * 0.12);
    const double polar = std::numbers::pi / 32 * (std::pow(0.14, 4) - std::pow(0.12, 4));
    const double normal = std::abs(profile.tension[k]) / area + profile.bending_stress[k];
    const double shear = profile.torque[k] * radius / polar;
    expect_close(profile.von_mises_stress[k], std::sqrt(normal * normal + 3 * shear * shear),
                 1e-12);
}

TEST(TorqueDrag, FlagsCompressionPastTheLimits) {
    // horizontal, sliding: 217.5 kN snake, 307.5 kN wind up; 171 kN buckle a segment of 10 m
    const double level = 90 * degree;
    Case input = case_in({{0, level, 0}, {300, level, 0}}, 0.1);
    input.mesh.segments = 200;
    input.torque_drag.motions = {Motion::sliding};
    input.torque_drag.depths = {300};
    const auto state = [&](double weight_on_bit) {
        input.bit.weight = ScalarSchedule(weight_on_bit);
        return compute_torque_drag(input).curves.front().buckling.front();
    };
    EXPECT_EQ(state(200e3), BucklingState::none);
    EXPECT_EQ(state(230e3), BucklingState::sinusoidal);
}

TEST(TorqueDrag, DoesNotDependOnTheNumberOfThreads) {
    Case input = build_and_hold(0.3);
    input.torque_drag.motions = {Motion::tripping_in, Motion::tripping_out, Motion::rotating};
    input.torque_drag.depths = {300, 600, 900, 1200};
    const TorqueDrag one = compute_torque_drag(input, 1);
    const TorqueDrag two = compute_torque_drag(input, 2);
    for (std::size_t m = 0; m < one.curves.size(); ++m) {
        EXPECT_EQ(one.curves[m].hook_load, two.curves[m].hook_load);
        EXPECT_EQ(one.curves[m].surface_torque, two.curves[m].surface_torque);
        EXPECT_EQ(one.curves[m].profile.side_force, two.curves[m].profile.side_force);
    }
}

TEST(TorqueDrag, MissingEquilibriumLeavesTheOthers) {
    // wound up in a vertical hole and turned against friction, the string rolls without end
    Case input = case_in(vertical(1000), 0.2);
    input.bit.weight = ScalarSchedule(50e3);
    input.torque_drag.depths = {300, 1000};
    const TorqueDrag study = compute_torque_drag(input);
    const TorqueDragCurve& drilling = curve(study, Motion::drilling);
    EXPECT_TRUE(std::isnan(drilling.hook_load[0]));
    EXPECT_TRUE(std::isnan(drilling.surface_torque[0]));
    EXPECT_TRUE(std::isnan(drilling.neutral_point[0]));
    EXPECT_FALSE(std::isnan(drilling.soft_hook_load[0]));
    ASSERT_FALSE(drilling.failures.empty());
    EXPECT_EQ(drilling.failures[0].bit_depth, 300);
    EXPECT_THAT(drilling.failures[0].reason, testing::HasSubstr("no equilibrium found"));
    for (const double load : curve(study, Motion::rotating).hook_load)
        EXPECT_FALSE(std::isnan(load));
}

TEST(TorqueDrag, WithoutDepthsGoesDownToTheBitInEvenSteps) {
    Case input = case_in(vertical(1200), 0.2);
    input.torque_drag.motions = {Motion::rotating};
    const std::vector<double> depths = compute_torque_drag(input).bit_depth;
    ASSERT_EQ(depths.size(), 20U);
    EXPECT_DOUBLE_EQ(depths.front(), 50);
    EXPECT_DOUBLE_EQ(depths.back(), 1000);
}

std::string refusal(const Case& input) {
    try {
        static_cast<void>(compute_torque_drag(input));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(TorqueDrag, RefusesAStringThatDoesNotFitOnItsWayDown) {
    Case input = case_in(vertical(1200), 0.2);
    input.well->sections = {{100, 0.13}, {1200, 0.22}};
    EXPECT_THAT(refusal(input), testing::HasSubstr("a pipe of 0.14 m comes to"));
}

TEST(TorqueDrag, NeedsAWellAndAHeadAtItsStart) {
    Case input = case_in(vertical(1200), 0.2);
    input.head.position = Eigen::Vector3d(0, 0, 5);
    EXPECT_THAT(refusal(input), testing::HasSubstr("leave it out"));
    input.head.position.reset();
    input.head.direction = Eigen::Vector3d::UnitX();
    EXPECT_THAT(refusal(input), testing::HasSubstr("head.direction is not that of the well"));
    input.head.direction = Eigen::Vector3d::UnitZ();
    EXPECT_EQ(refusal(input), "");
    input.head.motion = HeadMotion::free;
    EXPECT_THAT(refusal(input), testing::HasSubstr("\"driven\""));
    input.well.reset();
    EXPECT_THAT(refusal(input), testing::HasSubstr("add a table [well]"));
}

}  // namespace
}  // namespace drillstrand
