// Equilibria against exact shapes, loads and laws of statics. Exact shapes without a closed form:
// boundary-value solution of the Simo-Reissner rod by shooting to 1e-13.
#include "drillstrand/equilibrium.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/simulation.hpp"
#include "statics/rod_segment.hpp"
#include "statics/rod_state.hpp"
#include "statics/statics_cases.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Equilibrium equilibrium_of(const std::string& toml) {
    return find_equilibrium(build_scene(test::case_from(toml)));
}

Vector3d tip_of(const std::string& toml) {
    return equilibrium_of(toml).series.bit_position;
}

/// Order of convergence from three meshes, each twice as fine, of the error of the tip (m), of
/// which the coarsest has at most this one.
template <class Tip>
void expect_fourth_order(const Tip& tip, const Vector3d& exact, int coarsest, double error) {
    const double coarse = (tip(coarsest) - exact).norm();
    const double middle = (tip(2 * coarsest) - exact).norm();
    const double fine = (tip(4 * coarsest) - exact).norm();
    EXPECT_LT(coarse, error);
    EXPECT_NEAR(std::log2(coarse / middle), 4, 0.3);
    EXPECT_NEAR(std::log2(middle / fine), 4, 0.3);
}

TEST(Equilibrium, CantileverUnderItsOwnWeightSagsToTheExactTipAtFourthOrder) {
    const auto tip = [](int segments) {
        return tip_of("gravity = 9.81\n" + test::table_2_pipe + test::mesh(segments) +
                      "[head]\ndirection = [1, 0, 0]\n");
    };
    expect_fourth_order(tip, {22.948260142372, 0, 6.566100128076828}, 8, 0.2e-3);
}

TEST(Equilibrium, WeightAndAForceAcrossBendAPipeInSpaceToTheExactTipAtFourthOrder) {
    std::string pipe = test::table_2_pipe;
    pipe.replace(pipe.find("length = 24"), 11, "length = 40");
    const auto tip = [&](int segments) {
        return tip_of("gravity = 9.81\n" + pipe + test::mesh(segments) +
                      "[head]\ndirection = [1, 0, 0]\n[bit]\nforce = [0, 1500, 1500]\n");
    };
    expect_fourth_order(tip, {22.129932298185, 6.72771372247, 29.938713606436}, 8, 1.2e-3);
}

TEST(Equilibrium, DeadForceBendsThePipeAsTheElasticaAtFourthOrder) {
    // P L2/EI = 10; without shear and stretch the tip goes down 0.8106090248803 L and back by
    // 0.5549955977538 L (elliptic integrals)
    const auto slender = [](int segments) {
        return tip_of("gravity = 0\n" + test::rod({1, 1, 1, 1e8, 1e8}) + test::mesh(segments) +
                      "[head]\ndirection = [1, 0, 0]\n[bit]\nforce = [0, 0, 10]\n");
    };
    expect_fourth_order(slender, {1 - 0.5549955977538, 0, 0.8106090248803}, 8, 2e-5);
    const auto pipe = [](int segments) {
        return tip_of("gravity = 0\n" + test::table_2_pipe + test::mesh(segments) +
                      fmt::format("[head]\ndirection = [1, 0, 0]\n[bit]\nforce = [0, 0, {:.17g}]\n",
                                  10 * test::table_2_bending_stiffness / (24.0 * 24.0)));
    };
    expect_fourth_order(pipe, {10.680006002700965, 0, 19.455644049347967}, 8, 5e-4);
}

TEST(Equilibrium, MomentOfTwoPiEIOverLRollsThePipeUpToACircleOnEveryMesh) {
    const Vector3d moment(0, 2 * pi * test::table_2_bending_stiffness / 24, 0);
    for (const int mesh : {4, 12, 50}) {
        Case input = test::case_from("gravity = 0\n" + test::table_2_pipe + test::mesh(mesh) +
                                     "[head]\ndirection = [1, 0, 0]\n");
        input.bit.moment = moment;  // d1 points east
        EXPECT_LT(find_equilibrium(build_scene(input)).series.bit_position.norm(), 1e-8) << mesh;
        std::swap(input.bit.moment, input.bit.dead_moment);
        EXPECT_LT(find_equilibrium(build_scene(input)).series.bit_position.norm(), 1e-8) << mesh;
    }
}

TEST(Equilibrium, BatheAndBolourchisBendIsPulledOutOfItsPlaneToTheExactTipAtFourthOrder) {
    // an eighth of a circle of radius 100, E = 1e7, nu = 0, section 1 x 1, k = 1, GJ = 2 G I
    const auto bend = [](double force) {
        return [force](int segments) {
            return tip_of(
                "gravity = 0\n" +
                test::rod({25 * pi, 1e7 / 12, 1e7 / 12, 1e7, 5e6}, "curvature = [0, 0, 0.01]") +
                test::mesh(segments) +
                fmt::format("[head]\ndirection = [0, 1, 0]\n[initial]\nstate = "
                            "\"stress-free\"\n[bit]\nforce = [0, 0, {}]\n",
                            force));
        };
    };
    expect_fourth_order(bend(300), {22.24478094536764, 58.7791224896828, 40.191891670150234}, 8,
                        1e-3);
    expect_fourth_order(bend(600), {15.684800534038827, 47.15043857362901, 53.47485879182495}, 8,
                        3e-3);
}

TEST(Equilibrium, RodThatIsBentAndTwistedByItselfIsPulledToTheExactTipAtFourthOrder) {
    const auto tip = [](int segments) {
        return tip_of(
            "gravity = 0\n" +
            test::rod({25 * pi, 1e7 / 12, 3e5, 1e7, 5e6}, "curvature = [0.02, 0.012, -0.03]") +
            test::mesh(segments) +
            "[head]\ndirection = [0, 1, 0]\n[initial]\nstate = \"stress-free\"\n"
            "[bit]\nforce = [0, 0, 100]\n");
    };
    expect_fourth_order(tip, {-21.66114770841, 24.55200687699, 51.38545972745}, 8, 0.04);
}

TEST(Equilibrium, DeadCoupleHoldsARodOfEqualStiffnessesInAHelixAtFourthOrder) {
    // closed form: x = integral of exp(s M/EI x) e1; circulatory, so that no motion settles there
    const auto helix = [](double moment) {
        return [moment](int segments) {
            return tip_of("gravity = 0\n" + test::rod({10, 100, 100, 1e6, 1e6}) +
                          test::mesh(segments) +
                          fmt::format("[head]\ndirection = [1, 0, 0]\n[bit]\ndead_moment = "
                                      "[{0:.17g}, 0, {0:.17g}]\n",
                                      moment));
        };
    };
    expect_fourth_order(helix(50), {5.501240626379335, 0.2946520936915577, 4.498759373620664}, 16,
                        6e-3);
    expect_fourth_order(helix(62.8318530718),
                        {5.288826199284144, 1.478721456412797, 4.711173800715854}, 16, 0.015);
}

TEST(Equilibrium, HangingPipeStretchesByHalfItsWeightOverItsStiffnessButForTheLastCell) {
    // of the last half cell, a sixth hangs on the node above: engine/model/README.md, "Lumping"
    for (const int segments : {1, 7, 200}) {
        const Equilibrium found =
            equilibrium_of("gravity = 9.81\n" + test::table_3_pipe(1000) + test::mesh(segments));
        const double weight = 31.8557 * 9.81 * 1000;
        const double stretch = 0.1912947027061573 * (1 - 1 / (6.0 * segments * segments));
        EXPECT_NEAR(found.series.bit_position.z() - 1000, stretch, 1e-10) << segments;
        EXPECT_NEAR(found.hook_load, weight, 1e-6) << segments;
        EXPECT_TRUE(found.stable);
    }
}

/// Couple that holds the head (N m) of a rod of EI = 1e6 N m2 and 30 m with this load (N) along it
/// and 1 N across its end.
double clamp_moment(int mesh, double tension) {
    const Scene scene = build_scene(test::case_from(
        "gravity = 0\n" + test::rod({30, 1e6, 1e6, 1e12, 1e13}) + test::mesh(mesh) +
        fmt::format("[head]\ndirection = [1, 0, 0]\n[bit]\nforce = [{:.17g}, 0, 1]\n", tension)));
    const InitialNodes nodes = find_equilibrium(scene).nodes;
    const RodState state(nodes, scene.head_frame.col(1), scene.mesh.length);
    return segment_forces({scene.mesh.length[0], scene.mesh.segment.data(), state.end(0),
                           state.end(1), state.twist[0]})
        .on_a.tail<3>()
        .norm();
}

TEST(Equilibrium, StringUnderTensionBendsAtItsClampAsExactlyOnCoarseMeshes) {
    for (const double z : {1.0, 10.0, 30.0, 60.0}) {  // T h2/EI
        const double root = std::sqrt(z) / 6;         // of T/EI, h = 6 m
        const double exact_moment = std::tanh(30 * root) / root;
        EXPECT_NEAR(clamp_moment(5, 1e6 * root * root) / exact_moment, 1, 1e-5) << z;
    }
}

TEST(Equilibrium, ColumnOfOneSegmentBendsAtItsClampAsExactlyUpToItsLoad) {
    for (const double z : {0.5, 1.0, 2.0}) {  // of 2.47 at which it buckles
        const double root = std::sqrt(z) / 30;
        const double exact_moment = std::tan(30 * root) / root;
        EXPECT_NEAR(clamp_moment(1, -1e6 * root * root) / exact_moment, 1, 1e-4) << z;
    }
}

TEST(Equilibrium, TorqueOfARotatingBitTwistsTheFreeStringByTLOverGJ) {
    Case input = test::case_from("gravity = 9.81\n" + test::table_3_pipe(1000) + test::mesh(50) +
                                 "[bit]\ntorque = 10000\n");
    EquilibriumOptions options;
    options.motion = steady_motion(StringMotion::rotating, 10);
    const Equilibrium found = find_equilibrium(build_scene(input), options);
    EXPECT_NEAR(found.surface_torque, 10000, 1e-6);
    for (const double twist : found.nodes.twist)
        EXPECT_NEAR(twist, -10000 / test::table_3_bending_stiffness, 1e-12);  // GJ = EI: nu = 0
}

// ------------------------------------------------------------------ buckling

double buckling_load(int segments) {
    const Equilibrium found = equilibrium_of("gravity = 0\n" + test::table_3_pipe(1000) +
                                             test::mesh(segments) + "[bit]\nforce = [0, 0, -5]\n");
    EXPECT_EQ(found.warnings.size(), 1U);
    EXPECT_TRUE(found.stable);
    double factor = 0;
    EXPECT_EQ(std::sscanf(found.warnings.at(0).c_str(), "the string buckles at %lf", &factor), 1);
    return 5 * factor;
}

TEST(EquilibriumBuckling, ColumnReportsEulersLoadOnEveryMesh) {
    const double exact = 4.2827419665;  // pi^2 EI / (4 L^2)
    for (const int segments : {3, 10, 40, 100})
        EXPECT_NEAR(buckling_load(segments), exact, 1e-6 * exact) << segments;
}

TEST(EquilibriumBuckling, ColumnBeyondItsLoadIsFoundBentAsTheElastica) {
    const double load = 1.3;  // times pi^2 EI / (4 L^2)
    const Equilibrium found =
        equilibrium_of("gravity = 0\n" + test::rod({1, 1, 1, 1e8, 1e8}) + test::mesh(100) +
                       fmt::format("[bit]\nforce = [0, 0, {:.17g}]\n", -load * pi * pi / 4));
    const double tip_angle = std::acos(found.nodes.director.back().z());
    const double integral = std::comp_ellint_1(std::sin(0.5 * tip_angle));
    EXPECT_TRUE(found.stable);
    EXPECT_NEAR(std::pow(2 * integral / pi, 2), load, 1e-3);
}

TEST(EquilibriumBuckling, PipeUnderLoadBelowItsCriticalOneIsStraightAndStable) {
    const Equilibrium found = equilibrium_of("gravity = 0\n" + test::table_3_pipe(1000) +
                                             test::mesh(20) + "[bit]\nforce = [0, 0, -4]\n");
    EXPECT_TRUE(found.warnings.empty());
    EXPECT_TRUE(found.stable);
    EXPECT_LT(found.series.bit_position.head<2>().norm(), 1e-9);
}

// ------------------------------------------------------------------ wells and friction

constexpr double inclination = pi / 3;
constexpr double length = 300;
constexpr double friction = 0.3;
constexpr int segments = 60;
constexpr double wall = 1e7;        // Pa
constexpr double hertz_wall = 1e9;  // Pa/m^0.5

/// A pipe in a straight inclined well of 0.22 m that lies on the wall, `climb` up from its low side
/// against positive rotation, from head to bit: the exact state is straight.
struct InclinedPipe {
    explicit InclinedPipe(double climb, NormalLaw law = NormalLaw::linear)
        : along(std::sin(inclination), 0, std::cos(inclination)),
          up(std::cos(inclination), 0, -std::sin(inclination)) {
        Case input = test::case_from(test::table_3_pipe(length) + test::mesh(segments) +
                                     "[bit]\nweight = 2e4\ntorque = 500\n");
        weight = 31.8557 * input.gravity;
        normal = weight * std::sin(inclination) * std::cos(climb);
        const Vector3d toward_axis = std::cos(climb) * up - std::sin(climb) * along.cross(up);
        input.well = test::well_through({{0, inclination, 0}, {1000, inclination, 0}}, 0.22);
        input.contact.normal_law = law;
        input.contact.normal_stiffness = law == NormalLaw::hertz ? hertz_wall : wall;
        input.contact.static_friction = {friction, friction};
        input.contact.dynamic_friction = {friction, friction};
        input.bit.direction = BitDirection::well;
        depth = law == NormalLaw::hertz ? std::pow(normal / hertz_wall, 2.0 / 3) : normal / wall;
        input.head.position = -(0.04 + depth) * toward_axis;
        scene = build_scene(input);
    }

    [[nodiscard]] Equilibrium moving(const SteadyMotion& motion, bool bit_loads) const {
        EquilibriumOptions options;
        options.motion = motion;
        options.bit_loads = bit_loads;
        return find_equilibrium(scene, options);
    }

    [[nodiscard]] double axial_weight() const { return weight * std::cos(inclination) * length; }
    /// The head's own half cell is held by the head, not by the wall.
    [[nodiscard]] double wall_force() const { return normal * (length - 0.5 * length / segments); }

    Vector3d along, up;
    double weight = 0;  // N/m
    double normal = 0;  // N/m
    double depth = 0;   // m
    Scene scene;
};

constexpr double exact = 1e-4;  // N and N m, of 1e5: rounding

TEST(InclinedPipe, AtRestHangsOnTheHeadWithTheWeightAlongTheWellLessTheBits) {
    const InclinedPipe pipe(0);
    const Equilibrium found = pipe.moving({}, true);
    EXPECT_NEAR(found.hook_load, pipe.axial_weight() - 2e4, exact);
    EXPECT_NEAR(found.surface_torque, 0, exact);
    EXPECT_EQ(found.series.contact_nodes, segments + 1);
    EXPECT_NEAR(found.profile.normal_force.back(), pipe.normal, 1e-6 * pipe.normal);
}

TEST(InclinedPipe, LiesInHertzsWallAtTheDepthOfItsWeightAndRubsAsInAnother) {
    const InclinedPipe pipe(0, NormalLaw::hertz);
    const Equilibrium rest = pipe.moving({}, true);
    EXPECT_NEAR(rest.hook_load, pipe.axial_weight() - 2e4, exact);
    EXPECT_NEAR(rest.series.max_penetration, pipe.depth, 1e-6 * pipe.depth);
    EXPECT_NEAR(rest.profile.normal_force.back(), pipe.normal, 1e-6 * pipe.normal);
    const Equilibrium out = pipe.moving(steady_motion(StringMotion::tripping_out, 0), false);
    EXPECT_NEAR(out.hook_load, pipe.axial_weight() + friction * pipe.wall_force(), exact);
    const InclinedPipe climbed(std::atan(friction), NormalLaw::hertz);
    const Equilibrium turned = climbed.moving(steady_motion(StringMotion::rotating, 10), true);
    EXPECT_NEAR(turned.surface_torque, 500 + 0.07 * friction * climbed.wall_force(), exact);
}

TEST(InclinedPipe, TrippingAddsOrTakesFrictionAndLeavesTheBitAlone) {
    const InclinedPipe pipe(0);
    const double drag = friction * pipe.wall_force();
    for (const auto& [motion, sign] :
         {std::pair{StringMotion::tripping_in, -1.0}, std::pair{StringMotion::tripping_out, 1.0}}) {
        const Equilibrium found = pipe.moving(steady_motion(motion, 0), bit_is_loaded(motion));
        EXPECT_NEAR(found.hook_load, pipe.axial_weight() + sign * drag, exact);
        EXPECT_NEAR(found.series.wall_drag, sign * drag, exact);
        EXPECT_NEAR(found.surface_torque, 0, exact);
        EXPECT_EQ(found.bit_force.norm(), 0);
    }
}

TEST(InclinedPipe, SlidingPushesTheBitAgainstFriction) {
    const InclinedPipe pipe(0);
    const Equilibrium found = pipe.moving(steady_motion(StringMotion::sliding, 0), true);
    EXPECT_NEAR(found.hook_load, pipe.axial_weight() - 2e4 - friction * pipe.wall_force(), exact);
    EXPECT_NEAR(found.surface_torque, 0, exact);
}

TEST(InclinedPipe, RotatingClimbsByTheAngleOfFrictionAndTakesTorqueButNoDrag) {
    const InclinedPipe pipe(std::atan(friction));
    const Equilibrium found = pipe.moving(steady_motion(StringMotion::rotating, 10), true);
    EXPECT_NEAR(found.hook_load, pipe.axial_weight() - 2e4, exact);
    EXPECT_NEAR(found.surface_torque, 500 + 0.07 * friction * pipe.wall_force(), exact);
    const Vector3d aside = found.series.bit_position - found.series.head_position;
    EXPECT_LT((aside - aside.dot(pipe.along) * pipe.along).norm(), 1e-9);
}

TEST(InclinedPipe, RotationTakesFrictionAwayFromTripping) {
    // the surface moves at 30 degrees to the well
    const double angle = pi / 6;
    const InclinedPipe pipe(std::atan(friction * std::sin(angle)));
    const SteadyMotion motion{-std::cos(angle), std::sin(angle) / 0.07};
    const Equilibrium found = pipe.moving(motion, false);
    EXPECT_NEAR(found.hook_load,
                pipe.axial_weight() + friction * std::cos(angle) * pipe.wall_force(), exact);
    EXPECT_NEAR(found.surface_torque, 0.07 * friction * std::sin(angle) * pipe.wall_force(), exact);
}

TEST(InclinedPipe, FrictionOfCombinedMotionIsMuTimesTheNormalForce) {
    const Equilibrium found = InclinedPipe(0).moving({0.3, 5}, false);
    for (std::size_t k = 1; k < found.profile.contact_force.size(); ++k) {
        const Vector3d& force = found.profile.contact_force[k];
        EXPECT_NEAR(force.norm(), found.profile.normal_force[k] * std::hypot(1, friction),
                    1e-9 * force.norm());
    }
}

TEST(LevelString, LiesOnTheWallWithItsWeightFromTheFourthNodeThatTouches) {
    // collars on segments of 6 m whose head is held on the axis: 0.044 m above the wall
    Case input = test::case_from(R"(
        [[string.component]]
        length = 180
        outer_diameter = 0.127
        inner_diameter = 0.07
        linear_density = 67.9
        youngs_modulus = "206 GPa"
    )" + test::mesh(30));
    input.well = test::well_through({{0, pi / 2, 0}, {1000, pi / 2, 0}}, 0.2159);
    input.contact.normal_stiffness = wall;
    const Equilibrium found = find_equilibrium(build_scene(input));
    const std::vector<double>& force = found.profile.normal_force;
    const double weight = 67.9 * input.gravity;
    const auto first = std::find_if(force.begin(), force.end(), [](double f) { return f > 0; });
    ASSERT_LT(first - force.begin(), 6);
    for (auto node = first + 3; node != force.end(); ++node)
        EXPECT_NEAR(*node, weight, 0.01 * weight) << node - force.begin();
}

/// Ratio of the tensions at the middle of the first segment and at the bit of a limp weightless
/// line that is pulled out of a bend of 90 degrees, over the capstan's exp(mu angle).
double capstan_ratio(int mesh) {
    constexpr double bend = 100;  // m
    constexpr double pull = 1e4;  // N
    Case input =
        test::case_from("gravity = 0\n" + test::rod({150, 10, 10, 1e8, 1e8}) + test::mesh(mesh));
    input.well = test::well_through({{0, 0, 0}, {bend * pi / 2, pi / 2, 0}}, 0.102);
    input.bit.direction = BitDirection::well;
    input.bit.weight = -pull;
    // on the inside of the bend, where the line comes to lie
    input.head.position = Vector3d(1e-3 + pull / bend / input.contact.normal_stiffness, 0, 0);
    input.contact.dynamic_friction = {0.2, 0.2};
    EquilibriumOptions options;
    options.motion = steady_motion(StringMotion::tripping_out, 0);
    const Equilibrium found = find_equilibrium(build_scene(input), options);
    const double depth = 0.5 * (found.profile.well_depth[0] + found.profile.well_depth[1]);
    const double angle = (found.profile.well_depth.back() - depth) / bend;
    return found.series.head_stress[3] / pull / std::exp(0.2 * angle);
}

TEST(Capstan, TensionGrowsByTheExponentialOfFrictionTimesAngleAtSecondOrder) {
    const double coarse = capstan_ratio(50) - 1;
    const double fine = capstan_ratio(100) - 1;
    EXPECT_LT(std::abs(fine), 1e-4);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
}

// ------------------------------------------------------------------ moments at the nodes

double bending_at(const Equilibrium& found, std::size_t node) {
    return found.profile.moment[node].tail<2>().norm();
}

/// Moment per load and length at s of a beam-column that is clamped at 0, free at `span`, and
/// pulled with T = k^2 EI: M'' = k^2 M + 1, M'(0) = -span, M(span) = 0.
double loaded_moment(double k, double span, double s) {
    if (k == 0) return (span - s) * (span - s) / 2;
    const double a = (span / k * std::sinh(k * span) + 1 / (k * k)) / std::cosh(k * span);
    return a * std::cosh(k * s) - span / k * std::sinh(k * s) - 1 / (k * k);
}

TEST(MomentsAtTheNodes, UnderWeightAndTensionAreThoseOfTheBeamColumn) {
    constexpr double bending = 1e8;
    constexpr double h = 10;
    for (const double z : {0.0, 1.0, 5.0}) {  // T h2/EI
        const Equilibrium found = equilibrium_of(
            "gravity = 1e-3\n" + test::rod({10 * h, bending, bending, 1e13, 1e14}) +
            test::mesh(10) +
            fmt::format("[head]\ndirection = [1, 0, 0]\n[bit]\nforce = [{:.17g}, 0, 0]\n",
                        z * bending / (h * h)));
        const double k = std::sqrt(z) / h;
        const double largest = 1e-3 * loaded_moment(k, 10 * h, 0);
        for (std::size_t node = 0; node <= 10; ++node) {
            const double s = h * static_cast<double>(node);
            EXPECT_NEAR(bending_at(found, node), 1e-3 * std::abs(loaded_moment(k, 10 * h, s)),
                        2.5e-3 * largest)
                << z << ", " << node;
        }
    }
}

TEST(MomentsAtTheNodes, OfAPipeThatIsPulledThroughABendAreThoseOfTheBend) {
    // pressed to the inside with T/R all along: with T h2/EI = 5, the moments of a string that is
    // held at its nodes alone are 39 % larger
    constexpr double bend = 300;  // m
    constexpr double bending = 1e6;
    constexpr double pull = 5e4;  // N, on segments of 10 m
    Case input = test::case_from("gravity = 0\n" + test::rod({300, bending, bending, 1e10, 1e10}) +
                                 test::mesh(30));
    input.well = test::well_through({{0, 0, 0}, {bend * pi / 2, pi / 2, 0}}, 0.102);
    input.bit.direction = BitDirection::well;
    input.bit.weight = -pull;
    const double inside = 1e-3 + pull / bend / input.contact.normal_stiffness;
    input.head.position = Vector3d(inside, 0, 0);
    const Equilibrium found = find_equilibrium(build_scene(input));
    for (std::size_t node = 8; node <= 22; ++node) {
        EXPECT_GT(found.profile.normal_force[node], 0);
        EXPECT_NEAR(bending_at(found, node), bending / (bend - inside), 1e-3 * bending / bend)
            << node;
    }
}

TEST(MomentsAtTheNodes, OverALoneSupportAreThoseOfAPointForce) {
    // a level pipe with a joint in its middle that alone comes down to the wall
    const auto part = [](double span, double diameter) {
        return fmt::format(R"(
            [[string.component]]
            length = {}
            outer_diameter = {}
            linear_density = 1
            inertia = 1e-6
            bending_stiffness = 1e8
            torsional_stiffness = 1e8
            axial_stiffness = 1e12
            shear_stiffness = 1e13
        )",
                           span, diameter);
    };
    for (const int half : {6, 12}) {
        Case input = test::case_from("gravity = 9.81\n" + part(11.5, 0.1) + part(1, 0.298) +
                                     part(11.5, 0.1) + test::mesh(2 * half));
        input.well = test::well_through({{0, pi / 2, 0}, {1000, pi / 2, 0}}, 0.3);
        const Scene scene = build_scene(input);
        const Equilibrium found = find_equilibrium(scene);
        const auto middle = static_cast<std::size_t>(half);
        const double reaction = found.profile.normal_force[middle] * scene.mesh.cell[middle];
        EXPECT_GT(reaction, 20);
        for (std::size_t node = 0; node <= 2 * middle; ++node) {
            const double left = 24 - scene.mesh.node_s[node];
            const double lever = std::max(left - 12, 0.0);
            EXPECT_NEAR(bending_at(found, node),
                        std::abs(9.81 * left * left / 2 - reaction * lever), 1)
                << half << ", " << node;
        }
    }
}

// ------------------------------------------------------------------ next to no weight

/// A pipe of that length (m) that starts on the axis of a well which is vertical down to 200 m and
/// then bends to the north-east.
Case bent_well_case(double pipe_length, double gravity) {
    Case input = test::case_from(fmt::format("gravity = {:.17g}\n", gravity) +
                                 test::table_3_pipe(pipe_length) + test::mesh(100));
    input.well = test::well_through(
        {{0, 0, 0}, {200, 0, 0}, {500, pi / 4, pi / 6}, {2000, pi / 3, pi / 4}}, 0.22);
    return input;
}

constexpr double rounding_force = 1e-4;  // N: EA eps x / h = 3e-5 N for 190 m on 100 segments

TEST(WeightlessString, OnTheAxisOfAWellStaysThereWithoutForce) {
    for (const double gravity : {0.0, 1e-15, 1e-9}) {
        const Equilibrium found = find_equilibrium(build_scene(bent_well_case(190, gravity)));
        EXPECT_NEAR(found.hook_load, 0, rounding_force) << gravity;
        EXPECT_LT(found.residual, rounding_force) << gravity;
        EXPECT_NEAR(found.series.bit_position.z(), 190, 1e-9) << gravity;
        EXPECT_LT(found.series.bit_position.head<2>().norm(), 1e-3) << gravity;
        EXPECT_EQ(found.series.contact_nodes, 0) << gravity;
        EXPECT_TRUE(found.stable) << gravity;
    }
}

TEST(WeightlessString, RotatesInAWellWithoutTorque) {
    EquilibriumOptions options;
    options.motion = steady_motion(StringMotion::rotating, 10);
    const Equilibrium found = find_equilibrium(build_scene(bent_well_case(190, 0)), options);
    EXPECT_NEAR(found.hook_load, 0, rounding_force);
    EXPECT_NEAR(found.surface_torque, 0, rounding_force);
}

TEST(WeightlessString, IsTheLimitOfEverLighterStringsInABend) {
    const Equilibrium none = find_equilibrium(build_scene(bent_well_case(500, 0)));
    EXPECT_GT(none.series.contact_nodes, 0);
    for (const double gravity : {1e-15, 1e-9, 1e-6}) {
        const Equilibrium light = find_equilibrium(build_scene(bent_well_case(500, gravity)));
        EXPECT_LT((light.series.bit_position - none.series.bit_position).norm(), 1e-5) << gravity;
        EXPECT_NEAR(light.hook_load, none.hook_load, rounding_force + 2e4 * gravity) << gravity;
        EXPECT_TRUE(light.stable) << gravity;
    }
}

TEST(WeightlessString, OfNeutralBuoyancyIsThatWithoutGravity) {
    const Equilibrium none = find_equilibrium(build_scene(bent_well_case(500, 0)));
    Case floating = bent_well_case(500, 9.81);
    const double area = pi / 4 * (0.14 * 0.14 - 0.12 * 0.12);
    floating.fluid = FluidCase{.density = 31.8557 / area, .viscosity = 1e-3};
    const Scene scene = build_scene(floating);
    EXPECT_LT(std::abs(scene.weight[50]), 1e-11);
    const Equilibrium found = find_equilibrium(scene);
    EXPECT_LT((found.series.bit_position - none.series.bit_position).norm(), 1e-5);
    EXPECT_NEAR(found.hook_load, none.hook_load, rounding_force);
}

/// A pipe that points north and down from the head at a place, without a well.
Equilibrium free_pipe(const Vector3d& head, double gravity) {
    Case input = test::case_from(fmt::format("gravity = {:.17g}\n", gravity) + test::table_2_pipe +
                                 test::mesh(24) + "[head]\ndirection = [1, 0, 2]\n");
    input.head.position = head;
    return find_equilibrium(build_scene(input));
}

TEST(WeightlessString, IsStraightWhereverItsHeadIs) {
    for (const double far : {0.0, 1e3, 1e5}) {
        const Vector3d head(far, -far, far);
        const Equilibrium found = free_pipe(head, 0);
        const Vector3d tip = 24 * Vector3d(1, 0, 2).normalized();
        EXPECT_LT((found.series.bit_position - head - tip).norm(), 1e-9 * (1 + far)) << far;
        EXPECT_TRUE(found.stable);
    }
}

TEST(WeightlessString, SagsWithTheLeastWeightByWLToTheFourthOver8EI) {
    for (const double gravity : {1e-9, 1e-6, 1e-3}) {
        const Vector3d across = Vector3d(-2, 0, 1) / std::sqrt(5.0);
        const double sag = free_pipe(Vector3d::Zero(), gravity).series.bit_position.dot(across);
        const double weight = 34.2277 * gravity / std::sqrt(5.0);
        const double exact_sag = weight * std::pow(24, 4) / (8 * test::table_2_bending_stiffness) +
                                 weight * 24 * 24 / (2 * test::table_2_shear_stiffness);
        EXPECT_NEAR(sag, exact_sag, 2e-3 * exact_sag + 1e-11) << gravity;
    }
}

TEST(WeightlessString, HangsFromAFarHeadAsFromTheOrigin) {
    const Equilibrium near = free_pipe(Vector3d::Zero(), 9.81);
    const Vector3d head(1e5, -1e5, 2e5);
    const Equilibrium far = free_pipe(head, 9.81);
    EXPECT_LT((far.series.bit_position - head - near.series.bit_position).norm(), 1e-6);
    EXPECT_NEAR(far.hook_load, near.hook_load, 0.1);  // EA eps x / h = 0.05 N
}

// ------------------------------------------------------------------ runs from equilibrium

TEST(EquilibriumStart, ShippedWellsStayAtRestForTenSecondsWithoutDrive) {
    for (const char* name : {"well1", "well2", "well3"}) {
        Case input = read_case(fmt::format("{}/cases/{}.toml", DRILLSTRAND_SOURCE_DIR, name),
                               {{"initial.state", "equilibrium"}, {"head.rotation", "0"}});
        const Scene scene = starting_scene(input);
        IntegratorOptions options = integrator_options(input.run);
        options.threads = 1;
        const auto leapfrog = make_integrator(scene, options);
        const Vector3d start = leapfrog->series().bit_position;
        leapfrog->advance(10, 1'000'000);
        const SeriesRecord end = leapfrog->series();
        EXPECT_LT(end.energy.kinetic, 1e-6) << name;
        EXPECT_LT((end.bit_position - start).norm(), 1e-6) << name;
        EXPECT_GT(end.contact_nodes, scene.segments / 4) << name;
    }
}

TEST(EquilibriumStart, ADampedStringAtRestPressesTheWallAsInEquilibriumAtAnyStep) {
    Case input = test::case_from("gravity = 9.81\n" + test::table_3_pipe(100) + test::mesh(20) +
                                 "[damping]\nexternal_translation = 300\nexternal_rotation = 3\n" +
                                 "[contact]\nstatic_friction = 0\ndynamic_friction = 0\n");
    input.well = test::well_through({{0, pi / 3, 0}, {100, pi / 2, 0}, {200, pi / 2, 0}}, 0.2);
    input.initial.state = InitialState::equilibrium;
    const Scene scene = starting_scene(input);
    const std::vector<double> expected = find_equilibrium(scene).profile.normal_force;
    for (const double cfl : {0.9, 0.3}) {
        IntegratorOptions options = integrator_options(input.run);
        options.cfl = cfl;
        const auto leapfrog = make_integrator(scene, options);
        leapfrog->advance(2, 1'000'000);
        const std::vector<double> force = leapfrog->profile().normal_force;
        for (std::size_t k = 0; k < force.size(); ++k)
            EXPECT_NEAR(force[k], expected[k], 1e-6 * (1 + expected[k])) << cfl << ", " << k;
    }
}

TEST(EquilibriumStart, FromANeighbouringStateIsThatOfAColdStart) {
    const InclinedPipe pipe(0);
    EquilibriumOptions options;
    options.motion = steady_motion(StringMotion::tripping_out, 0);
    const Equilibrium cold = find_equilibrium(pipe.scene, options);
    options.start = pipe.moving(steady_motion(StringMotion::tripping_in, 0), false).nodes;
    const Equilibrium warm = find_equilibrium(pipe.scene, options);
    EXPECT_NEAR(warm.hook_load, cold.hook_load, exact);
    EXPECT_LT(warm.iterations, cold.iterations);
}

TEST(EquilibriumFailure, AFreeHeadAndAStringThatNeverSettlesAreErrors) {
    const std::string pipe = test::table_3_pipe(1000) + test::mesh(20);
    EXPECT_THROW(equilibrium_of(pipe + "[head]\nmotion = \"free\"\n"), std::invalid_argument);
    EquilibriumOptions options;
    options.max_iterations = 2;
    const Scene scene =
        build_scene(test::case_from("gravity = 9.81\n" + test::table_2_pipe + test::mesh(8) +
                                    "[head]\ndirection = [1, 0, 0]\n"));
    EXPECT_THROW(find_equilibrium(scene, options), SimulationError);
}

}  // namespace
}  // namespace drillstrand
