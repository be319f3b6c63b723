// Strings as they are screwed together, in equilibrium: tool joints, stabilisers, bent motors, on
// meshes that follow them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "drillstrand/equilibrium.hpp"
#include "statics/statics_cases.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double degree = pi / 180;
constexpr double pound_force = 4.4482216152605;  // N
constexpr double foot = 0.3048;                  // m
constexpr double inch = 0.0254;                  // m

std::size_t node_at(const Scene& scene, double s) {
    const std::vector<double>& nodes = scene.mesh.node_s;
    const auto nearest = std::min_element(nodes.begin(), nodes.end(), [&](double a, double b) {
        return std::abs(a - s) < std::abs(b - s);
    });
    return static_cast<std::size_t>(nearest - nodes.begin());
}

/// Force of the wall on a node (N).
double wall_force(const Scene& scene, const Equilibrium& found, std::size_t node) {
    return found.profile.normal_force[node] * scene.mesh.cell[node];
}

/// A mesh that follows the string with segments of at most h (m).
std::string following(double h) {
    return fmt::format("[mesh]\nelement_length = {:.17g}\n", h);
}

// ------------------------------------------------------------------ tool joints

TEST(JointedPipe, OnALevelWallTakesTheTorqueOfItsJointsRadius) {
    // 5 in pipe, NC50 joints of 6 5/8 in; the first pieces hang from a head on the axis
    const double joint = 6.625 * inch / 2;
    Case input = test::case_from(R"(
        [[string.component]]
        length = 950
        outer_diameter = "5 in"
        inner_diameter = "4.276 in"
        linear_density = 31.9
        youngs_modulus = "206 GPa"
        joint_length = 9.5
        tool_joint_outer_diameter = "6.625 in"
        tool_joint_inner_diameter = "3.5 in"
        tool_joint_length = 0.45
    )" + following(10));
    input.well = test::well_through({{0, pi / 2, 0}, {1000, pi / 2, 0}}, 0.2159);
    input.contact.dynamic_friction = {0.3, 0.3};
    input.head.position = Vector3d(0, 0, 0.2159 / 2 - joint);
    EquilibriumOptions options;
    options.motion = {0, 6};
    const Scene scene = build_scene(input);
    const Equilibrium found = find_equilibrium(scene, options);
    double weight = 0;
    double bodies = 0;
    for (std::size_t k = 0; k < scene.mesh.node.size(); ++k) {
        weight += wall_force(scene, found, k);
        const bool is_joint = scene.mesh.node[k].outer_radius == joint;
        if (!is_joint) bodies += wall_force(scene, found, k);
    }
    EXPECT_EQ(bodies, 0) << "the pipe between joints sags by less than they are thicker";
    // they climb the wall by the angle of friction
    const double climbed = weight * std::hypot(1, 0.3);
    EXPECT_NEAR(climbed / (31.9 * input.gravity * 950), 1, 5e-3);
    EXPECT_NEAR(found.surface_torque / (0.3 * weight * joint), 1, 5e-3);
}

/// Largest bending moment of a pipe between tool joints that is pulled through a bend, over that of
/// the bend (Lubinski 1961).
double amplification(double tension, int segments_per_joint) {
    const double bend = 5 * degree / (100 * foot);  // 5 deg/100 ft
    const double length = 600 * foot;
    Case input = test::case_from(fmt::format(R"(
        gravity = 0
        [[string.component]]
        length = {:.17g}
        outer_diameter = "5 in"
        inner_diameter = "4.276 in"
        linear_density = "19.5 lb/ft"
        youngs_modulus = "30e6 psi"
        joint_length = "30 ft"
        tool_joint_outer_diameter = "6.5 in"
        [mesh]
        element_length = 20
        segments_per_joint = {}
    )",
                                             length, segments_per_joint));
    input.bit.weight = -tension;
    input.bit.direction = BitDirection::well;
    input.well = test::well_through({{0, 0, 0}, {1.1 * length, 1.1 * bend * length, 0}}, 0.2159);
    input.contact.normal_stiffness = 1e9;
    const Scene scene = build_scene(input);
    const Equilibrium found = find_equilibrium(scene);
    const std::size_t node = node_at(scene, 300 * foot);
    return found.profile.moment[node].tail<2>().norm() /
           (scene.mesh.node[node].bending_stiffness * bend);
}

TEST(JointedPipe, BendsAtItsJointsByLubinskisFactorWithTwoSegmentsBetween) {
    EXPECT_NEAR(amplification(50e3 * pound_force, 2) / 2.0265, 1, 0.01);
    EXPECT_NEAR(amplification(100e3 * pound_force, 2) / 2.7737, 1, 0.01);
    EXPECT_NEAR(amplification(200e3 * pound_force, 2) / 3.8939, 1, 0.01);
    EXPECT_NEAR(amplification(100e3 * pound_force, 1) / 2.7737, 1, 0.01);
}

// ------------------------------------------------------------------ stabilisers

/// Force on a stabiliser in the middle of a level assembly whose bit is as wide as the hole.
double stabiliser_force(double element_length) {
    Case input = test::case_from(R"(
        [[string.component]]
        length = 40
        outer_diameter = 0.1651
        inner_diameter = 0.0714
        linear_density = 133
        youngs_modulus = "206 GPa"
        [[string.component]]
        name = "stabiliser"
        length = 1.7
        outer_diameter = 0.1651
        inner_diameter = 0.0714
        linear_density = 133
        youngs_modulus = "206 GPa"
        contact_diameter = 0.2127
        contact_position = 0.61
        [[string.component]]
        length = 17.93
        outer_diameter = 0.1651
        inner_diameter = 0.0714
        linear_density = 133
        youngs_modulus = "206 GPa"
        [[string.component]]
        name = "bit"
        length = 0.3
        outer_diameter = 0.1651
        inner_diameter = 0.0714
        linear_density = 133
        youngs_modulus = "206 GPa"
        contact_diameter = 0.2159
        contact_position = 0.3
    )" + following(element_length));
    input.well = test::well_through({{0, pi / 2, 0}, {1000, pi / 2, 0}}, 0.2159);
    const Scene scene = build_scene(input);
    const Equilibrium found = find_equilibrium(scene);
    return wall_force(scene, found, node_at(scene, 40.61));
}

TEST(Stabiliser, CarriesTheSameForceWhereverTheMeshWouldHavePutItsNodes) {
    const double fine = stabiliser_force(0.25);
    EXPECT_GT(fine, 1e4);
    for (const double h : {0.7, 1.3, 2.0, 3.1})
        EXPECT_NEAR(stabiliser_force(h) / fine, 1, 0.01) << h;
}

TEST(Stabiliser, WiderThanItsHoleIsHeldOnTheAxis) {
    // 10 m of collar, level, between a head on the axis and a stabiliser at its lower end
    const auto found = [](double diameter) {
        Case input = test::case_from(fmt::format(R"(
            [[string.component]]
            length = 10
            outer_diameter = 0.1651
            inner_diameter = 0.0714
            linear_density = 133
            youngs_modulus = "206 GPa"
            contact_diameter = {:.17g}
            contact_position = 10
            contact_length = 0.3
        )",
                                                 diameter) +
                                     following(1));
        input.well = test::well_through({{0, pi / 2, 0}, {1000, pi / 2, 0}}, 0.2159);
        return find_equilibrium(build_scene(input));
    };
    // a clamped and a simply supported end: 3/8 of the weight on the latter
    const double support = 3.0 / 8 * 133 * 9.80665 * 10;
    for (const double diameter : {0.2159, 0.2164}) {
        const double below_the_axis = found(diameter).series.bit_position.z();
        EXPECT_NEAR(below_the_axis / (support / (6e8 * 0.3)), 1, 0.02) << diameter;
    }
    EXPECT_NEAR(found(0.2149).series.bit_position.z(), 0.0005, 0.0001);
}

// ------------------------------------------------------------------ bends

TEST(BentMotor, PointsThePipeBelowByItsAngleToItsToolface) {
    // weightless, without a well: the head looks down, d1 east, d2 = down x east = south
    const auto bit = [](double toolface) {
        return find_equilibrium(build_scene(test::case_from(fmt::format(R"(
            gravity = 0
            [[string.component]]
            length = 10
            outer_diameter = 0.17
            inner_diameter = 0.07
            linear_density = 130
            youngs_modulus = "206 GPa"
            bend = "1.75 deg"
            bend_position = 8
            toolface = {:.17g}
            [initial]
            state = "stress-free"
        )",
                                                                        toolface) +
                                                            following(1))))
            .series.bit_position;
    };
    const double reach = 2 * std::sin(1.75 * degree);
    EXPECT_NEAR(bit(0).y(), reach, 1e-3 * reach);
    EXPECT_NEAR(bit(0).x(), 0, 1e-3 * reach);
    EXPECT_NEAR(bit(pi / 2).x(), -reach, 1e-3 * reach);
    EXPECT_NEAR(bit(pi / 2).z(), 8 + 2 * std::cos(1.75 * degree), 3e-4);
}

/// A part of the assembly of MADSim's example (Scientific Drilling 2021, MIT licence): diameters
/// (in), length (ft), weight (lb/ft), E (psi); blades (in) and their place from its upper end (ft).
struct Part {
    double outer, inner, length, weight, modulus;
    double blade = 0, place = 0;
};

/// From its head, which is drawn out by 4.75 ft to the start of the survey. The bend is 5.25 ft
/// above the bit.
const std::vector<Part> assembly{
    {6.5, 3.25, 34.75, 85.41322836671759, 28.5e6},
    {6.5, 3, 5.5, 89.62492601793642, 28.5e6},
    {6.5, 3.25, 30, 85.41322836671759, 28.5e6},
    {6.75, 2.875, 6, 100.53322293459314, 28.5e6, 8.25, 3},
    {6.5, 3.25, 3, 85.41322836671759, 30e6},
    {6.5, 5.5, 20, 73.99673735725938, 30e6},
    {6.5, 4, 5.5, 70.75652054047612, 30e6},
    {6.5, 4, 0.5, 70.75652054047612, 30e6},
    {6.5, 3, 4, 89.62492601793642, 30e6, 8.25, 2},
    {7.875, 1.25, 0.75, 162.95058212565598, 30e6, 8.5, 0.75},
};

std::string assembly_case(double element_length) {
    std::string text = fmt::format(R"(
        [contact]
        static_friction = 0
        dynamic_friction = 0
        [fluid]
        density = "10 ppg"
        viscosity = 0
        [bit]
        weight = "30 klbf"
        torque = "3.5 klbf ft"
        [mesh]
        element_length = {:.17g}
    )",
                                   element_length * foot);
    for (std::size_t i = 0; i < assembly.size(); ++i) {
        const Part& part = assembly[i];
        text += fmt::format(
            "[[string.component]]\nlength = \"{:.17g} ft\"\nouter_diameter = \"{:.17g} in\"\n"
            "inner_diameter = \"{:.17g} in\"\nlinear_density = \"{:.17g} lb/ft\"\n"
            "youngs_modulus = \"{:.17g} psi\"\n",
            part.length, part.outer, part.inner, part.weight, part.modulus);
        if (part.blade > 0)
            text += fmt::format(
                "contact_diameter = \"{:.17g} in\"\ncontact_position = \"{:.17g} ft\"\n",
                part.blade, part.place);
        if (i == 6) text += "bend = \"1.75 deg\"\nbend_position = \"5.5 ft\"\n";
    }
    return text;
}

TEST(BentMotor, InATurnPressesTheWallAsTheVendorsProgramSays) {
    for (const double h : {1.0, 3.0}) {
        Case input = test::case_from(assembly_case(h));
        input.well = test::well_through({{0, pi / 2, pi},
                                         {55 * foot, pi / 2, 185.5 * degree},
                                         {110 * foot, pi / 2, 191 * degree}},
                                        8.5 * inch);
        const Scene scene = build_scene(input);
        const Equilibrium found = find_equilibrium(scene);
        const auto at = [&](double feet) { return node_at(scene, (110 - feet) * foot); };
        const auto force = [&](double feet) {
            return wall_force(scene, found, at(feet)) / pound_force;
        };
        EXPECT_NEAR(force(0) / 14800, 1, 0.03) << h;
        EXPECT_NEAR(force(2.75) / 17342, 1, 0.03) << h;
        EXPECT_NEAR(force(36.75) / 2187, 1, 0.03) << h;
        double largest = 0;
        for (const Vector3d& moment : found.profile.moment)
            largest = std::max(largest, moment.tail<2>().norm());
        EXPECT_NEAR(largest / (pound_force * foot) / 40574, 1, 0.03) << h;
    }
}

// ------------------------------------------------------------------ graded meshes

/// A pipe of 24 m clamped level at its head, on segments of a quarter of the length around a place.
std::string graded_cantilever(int mesh) {
    const double h = 24.0 / mesh;
    return "gravity = 9.81\n" + test::table_2_pipe +
           fmt::format(
               "[mesh]\nelement_length = {:.17g}\n"
               "refine = [{{from = 8, to = 11, element_length = {:.17g}}}]\n"
               "[head]\ndirection = [1, 0, 0]\n",
               h, h / 4);
}

TEST(GradedMesh, OfACantileverConvergesToTheExactTipAtFourthOrder) {
    const Vector3d exact(22.948260142372, 0, 6.566100128076828);
    const auto error = [&](int mesh) {
        const Equilibrium found =
            find_equilibrium(build_scene(test::case_from(graded_cantilever(mesh))));
        return (found.series.bit_position - exact).norm();
    };
    EXPECT_LT(error(8), 0.2e-3);
    // lengths are whole parts of stretches: they do not halve to the last digit
    EXPECT_NEAR(std::log2(error(8) / error(32)) / 2, 4, 0.5);
}

}  // namespace
}  // namespace drillstrand
