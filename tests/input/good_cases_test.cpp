/// What a case file says arrives in SI, and what it leaves out has the documented default.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "drillstrand/error.hpp"
#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

using testing::ElementsAre;

constexpr double pi = std::numbers::pi;

const std::string smallest_case = R"([string]
[[string.component]]
length = 10
outer_diameter = 0.1
linear_density = 20
youngs_modulus = 2e11
[mesh]
segments = 8
[run]
duration = 1
)";

Case read_text(const std::string& text) {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    folder.write("smallest.toml", text);
    return folder.read("smallest.toml");
}

TEST(GoodCases, WhatIsLeftOutHasItsDefault) {
    const Case input = read_text(smallest_case);
    EXPECT_EQ(input.title, "smallest");
    EXPECT_EQ(input.path.filename(), "smallest.toml");
    EXPECT_EQ(input.text, smallest_case);
    EXPECT_EQ(input.gravity, 9.80665);
    EXPECT_FALSE(input.well);
    EXPECT_FALSE(input.fluid);

    EXPECT_EQ(input.string.shear_coefficient, 1);
    ASSERT_EQ(input.string.components.size(), 1U);
    const Component& component = input.string.components.front();
    EXPECT_EQ(component.name, "");
    EXPECT_EQ(component.inner_diameter, 0);
    EXPECT_EQ(component.poisson_ratio, 0.3);
    EXPECT_EQ(component.yield_strength, 900e6);
    EXPECT_TRUE(component.curvature.isZero(0));
    EXPECT_FALSE(component.bending_stiffness);
    EXPECT_FALSE(component.polar_inertia);

    EXPECT_EQ(input.mesh.segments, 8);
    EXPECT_FALSE(input.mesh.segment_inertia);
    EXPECT_FALSE(input.head.position);
    EXPECT_FALSE(input.head.direction);
    EXPECT_EQ(input.head.motion, HeadMotion::driven);
    EXPECT_EQ(input.head.rotation(5), 0);
    EXPECT_TRUE(input.head.force(5).isZero(0));

    EXPECT_EQ(input.bit.weight(5), 0);
    EXPECT_EQ(input.bit.torque(5), 0);
    EXPECT_FALSE(input.bit.friction);
    EXPECT_DOUBLE_EQ(input.bit.smoothing_speed, 2 * pi / 60);
    EXPECT_EQ(input.bit.direction, BitDirection::follower);
    EXPECT_TRUE(input.bit.moment(5).isZero(0));

    EXPECT_EQ(input.contact.normal_stiffness, 1e7);
    EXPECT_EQ(input.contact.normal_damping, 1e5);
    EXPECT_FALSE(input.contact.restitution);
    EXPECT_EQ(input.contact.tangential_stiffness, 1e6);
    EXPECT_EQ(input.contact.static_friction.axial, 0.6);
    EXPECT_EQ(input.contact.dynamic_friction.azimuthal, 0.42);
    EXPECT_EQ(input.contact.law, FrictionLaw::coulomb);
    EXPECT_FALSE(input.contact.tension);

    EXPECT_EQ(input.contact.rolling_creep, 0.005);
    EXPECT_FALSE(input.damping.internal.any());
    EXPECT_FALSE(input.damping.external.any());
    EXPECT_EQ(input.damping.kelvin_voigt, 0);
    EXPECT_EQ(input.initial.state, InitialState::coaxial);
    EXPECT_TRUE(input.initial.curvature.isZero(0));
    EXPECT_TRUE(input.initial.offset.isZero(0));

    EXPECT_EQ(input.run.integrator, IntegratorKind::leapfrog);
    EXPECT_EQ(input.run.cfl, 0.9);
    EXPECT_TRUE(input.run.local_steps);
    EXPECT_EQ(input.run.stress_limit, 5);
    EXPECT_EQ(input.run.absolute_tolerance, 1e-7);
    EXPECT_EQ(input.run.relative_tolerance, 1e-5);
    EXPECT_EQ(input.run.threads, 0);
    EXPECT_EQ(input.output.interval, 0.1);
    EXPECT_EQ(input.output.profile_interval, 5);
    EXPECT_EQ(input.output.checkpoint_interval, 60);
    EXPECT_EQ(input.output.side_force_window, 9.144);
    EXPECT_FALSE(input.run.reproducible);
    EXPECT_FALSE(input.initial.penetration_limit);
}

TEST(GoodCases, FluidInAWellHasItsDefaults) {
    const Case input = read_trial("Trial", "Trial");
    EXPECT_EQ(input.fluid->density, 1917);
    EXPECT_EQ(input.fluid->viscosity, 1e-3);
    EXPECT_EQ(input.fluid->inside, InsideOfPipe::fluid);
    EXPECT_TRUE(input.fluid->drag);
    EXPECT_EQ(input.fluid->axial_drag, AxialDrag::eccentric);
    EXPECT_EQ(input.fluid->film, 0.01);
    EXPECT_EQ(input.fluid->regime, FlowRegime::inertial);
    EXPECT_EQ(input.fluid->drag_coefficient, 1);
    EXPECT_TRUE(input.fluid->contact_drag);
    EXPECT_TRUE(input.fluid->added_mass);
    EXPECT_EQ(input.bit.direction, BitDirection::well);
    ASSERT_EQ(input.well->sections.size(), 1U);
    EXPECT_EQ(input.well->sections[0].to, 520);
    EXPECT_EQ(input.well->sections[0].diameter, 0.3111);
}

TEST(GoodCases, EveryKeyArrivesInSiUnits) {
    const Case input = read_text(R"(title = "All"
gravity = "32 ft/s2"
[well]
survey = "survey.csv"
[[well.section]]
name = "casing"
from = 0
to = "300 m"
diameter = "17.5 in"
static_friction = [0.25, 0.2]
dynamic_friction = 0.2
[[well.section]]
from = "300 m"
to = 520
diameter = ["12 1/4 in", "12 in"]
static_friction = 0.1
normal_stiffness = "2 MPa"
[fluid]
density = "10 ppg"
viscosity = "2 cP"
inside = "empty"
drag = true
axial_drag = "concentric"
film = 0.02
regime = "laminar"
contact_drag = false
added_mass = false
[string]
shear_coefficient = 0.9
[[string.component]]
name = "given"
length = "100 ft"
outer_diameter = "5 in"
inner_diameter = "4 in"
density = "7.85 g/cm3"
youngs_modulus = "200 GPa"
poisson_ratio = 0
yield_strength = "120 ksi"
curvature = [0.1, "3 deg/30m", 0]
bending_stiffness = "7 kN m2"
torsional_stiffness = 8
axial_stiffness = "9 kN"
shear_stiffness = 10
inertia = 11
polar_inertia = "12 kg m"
material_density = "490 lb/ft3"
joint_length = "30 ft"
tool_joint_outer_diameter = "6.5 in"
tool_joint_inner_diameter = "3.25 in"
tool_joint_length = "18 in"
contact_diameter = "12 in"
contact_length = "1 ft"
contact_position = "50 ft"
contact_stiffness = "1 GPa"
bend = "1.75 deg"
bend_position = "25 ft"
toolface = "90 deg"
element_length = "2 ft"
[mesh]
element_length = "10 ft"
segments_per_joint = 3
refine = [{from = 0, to = "30 ft", measured_from = "bit", element_length = "1 ft"}]
segment_inertia = false
[head]
position = [1, "2 m", 3]
direction = [0, 3, 4]
motion = "free"
force = [[0, [0, 0, 0]], ["1 min", ["1 kN", 0, 0]]]
moment = [1, 2, "3 kN m"]
[bit]
weight = "65 kN"
friction = 1.6
smoothing_speed = "2 rpm"
direction = "follower"
contact_length = "1 ft"
force = [1, 2, 3]
dead_moment = [4, 5, 6]
moment = [[0, [7, 8, 9]]]
[contact]
normal_stiffness = "1 MPa"
restitution = 0.3
tangential_stiffness = 2e6
static_friction = [0.5, 0.4]
dynamic_friction = 0.3
rolling_creep = 0.01
law = "paper"
tension = true
[damping]
internal = 1e-2
external = "2 N s/m"
kelvin_voigt = 0
[initial]
state = "coaxial"
curvature = [0, 1e-4, 0]
offset = [0, "1 mm", 0]
penetration_limit = "1 in"
[run]
duration = "1 h"
integrator = "dormand-prince"
cfl = 0.5
local_steps = false
stress_limit = 0
absolute_tolerance = 1e-8
relative_tolerance = 1e-6
threads = 2
reproducible = true
[output]
interval = "10 ms"
profile_interval = 0
checkpoint_interval = "2 min"
side_force_window = "10 ft"
)");
    EXPECT_EQ(input.title, "All");
    EXPECT_DOUBLE_EQ(input.gravity, 32 * 0.3048);
    ASSERT_EQ(input.well->sections.size(), 2U);
    EXPECT_EQ(input.well->sections[0].to, 300);
    EXPECT_DOUBLE_EQ(input.well->sections[0].diameter, 17.5 * 0.0254);
    EXPECT_EQ(input.well->sections[0].name, "casing");
    EXPECT_FALSE(input.well->sections[0].end_diameter);
    EXPECT_EQ(input.well->sections[0].static_friction->azimuthal, 0.2);
    EXPECT_EQ(input.well->sections[0].dynamic_friction->axial, 0.2);
    EXPECT_FALSE(input.well->sections[0].normal_stiffness);
    EXPECT_DOUBLE_EQ(input.well->sections[1].diameter, 12.25 * 0.0254);
    EXPECT_DOUBLE_EQ(*input.well->sections[1].end_diameter, 12 * 0.0254);
    EXPECT_EQ(input.well->sections[1].name, "");
    // less than what slides elsewhere
    EXPECT_EQ(input.well->sections[1].dynamic_friction->axial, 0.1);
    EXPECT_DOUBLE_EQ(*input.well->sections[1].normal_stiffness, 2e6);
    EXPECT_DOUBLE_EQ(input.fluid->density, 4.5359237 / 0.003785411784);
    EXPECT_DOUBLE_EQ(input.fluid->viscosity, 2e-3);
    EXPECT_EQ(input.fluid->inside, InsideOfPipe::empty);
    EXPECT_EQ(input.fluid->axial_drag, AxialDrag::concentric);
    EXPECT_EQ(input.fluid->film, 0.02);
    EXPECT_EQ(input.fluid->regime, FlowRegime::laminar);
    EXPECT_FALSE(input.fluid->contact_drag);
    EXPECT_FALSE(input.fluid->added_mass);

    EXPECT_EQ(input.string.shear_coefficient, 0.9);
    const Component& component = input.string.components.at(0);
    EXPECT_EQ(component.name, "given");
    EXPECT_DOUBLE_EQ(component.length, 30.48);
    EXPECT_DOUBLE_EQ(component.outer_diameter, 0.127);
    EXPECT_DOUBLE_EQ(component.inner_diameter, 0.1016);
    const double pipe = 7850 * pi / 4 * (0.127 * 0.127 - 0.1016 * 0.1016);
    const double joint = 7850 * pi / 4 * (0.1651 * 0.1651 - 0.08255 * 0.08255);
    const double of_joints = 3 * 0.4572 / 30.48;
    EXPECT_NEAR(component.linear_density, pipe + of_joints * (joint - pipe), 1e-9);
    EXPECT_EQ(component.youngs_modulus, 200e9);
    EXPECT_EQ(component.poisson_ratio, 0);
    EXPECT_NEAR(component.yield_strength, 827.4e6, 0.05e6);
    EXPECT_EQ(component.curvature[0], 0.1);
    EXPECT_DOUBLE_EQ(component.curvature[1], pi / 1800);
    EXPECT_EQ(component.bending_stiffness, 7000);
    EXPECT_EQ(component.torsional_stiffness, 8);
    EXPECT_EQ(component.axial_stiffness, 9000);
    EXPECT_EQ(component.shear_stiffness, 10);
    EXPECT_EQ(component.inertia, 11);
    EXPECT_EQ(component.polar_inertia, 12);
    EXPECT_NEAR(*component.material_density, 7849.0, 0.2);
    EXPECT_DOUBLE_EQ(component.joints->spacing, 9.144);
    EXPECT_DOUBLE_EQ(component.joints->outer_diameter, 0.1651);
    EXPECT_DOUBLE_EQ(component.joints->inner_diameter, 0.08255);
    EXPECT_DOUBLE_EQ(component.joints->length, 0.4572);
    EXPECT_DOUBLE_EQ(component.contact->diameter, 0.3048);
    EXPECT_DOUBLE_EQ(component.contact->length, 0.3048);
    EXPECT_DOUBLE_EQ(component.contact->position, 15.24);
    EXPECT_EQ(component.contact->stiffness, 1e9);
    EXPECT_DOUBLE_EQ(component.bend->angle, 1.75 * pi / 180);
    EXPECT_DOUBLE_EQ(component.bend->position, 7.62);
    EXPECT_DOUBLE_EQ(component.bend->toolface, pi / 2);
    EXPECT_DOUBLE_EQ(*component.element_length, 0.6096);
    EXPECT_EQ(input.mesh.segments, 0);
    EXPECT_DOUBLE_EQ(input.mesh.element_length, 3.048);
    EXPECT_EQ(input.mesh.segments_per_joint, 3);
    ASSERT_EQ(input.mesh.refine.size(), 1U);
    EXPECT_DOUBLE_EQ(input.mesh.refine[0].to, 9.144);
    EXPECT_TRUE(input.mesh.refine[0].from_the_bit);
    EXPECT_DOUBLE_EQ(input.mesh.refine[0].element_length, 0.3048);
    EXPECT_EQ(input.mesh.segment_inertia, false);

    EXPECT_EQ(*input.head.position, Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(input.head.direction->isApprox(Eigen::Vector3d(0, 0.6, 0.8)));
    EXPECT_DOUBLE_EQ(input.bit.contact_length, 0.3048);
    EXPECT_EQ(input.head.motion, HeadMotion::free);
    EXPECT_EQ(input.head.force(30), Eigen::Vector3d(500, 0, 0));
    EXPECT_EQ(input.head.moment(30), Eigen::Vector3d(1, 2, 3000));
    EXPECT_EQ(input.bit.weight(0), 65e3);
    EXPECT_EQ(input.bit.friction, 1.6);
    EXPECT_DOUBLE_EQ(input.bit.smoothing_speed, 4 * pi / 60);
    EXPECT_EQ(input.bit.direction, BitDirection::follower);
    EXPECT_EQ(input.bit.force(0), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(input.bit.dead_moment(0), Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(input.bit.moment(0), Eigen::Vector3d(7, 8, 9));

    EXPECT_EQ(input.contact.normal_stiffness, 1e6);
    EXPECT_EQ(input.contact.restitution, 0.3);
    EXPECT_EQ(input.contact.tangential_stiffness, 2e6);
    EXPECT_EQ(input.contact.static_friction.axial, 0.5);
    EXPECT_EQ(input.contact.static_friction.azimuthal, 0.4);
    EXPECT_EQ(input.contact.dynamic_friction.azimuthal, 0.3);
    EXPECT_EQ(input.contact.law, FrictionLaw::paper);
    EXPECT_TRUE(input.contact.tension);
    EXPECT_EQ(input.contact.rolling_creep, 0.01);
    EXPECT_EQ(input.damping.internal.translation, 1e-2);
    EXPECT_EQ(input.damping.internal.rotation, 1e-2);
    EXPECT_EQ(input.damping.external.translation, 2);
    EXPECT_EQ(input.damping.external.rotation, 2);
    EXPECT_EQ(input.initial.curvature[1], 1e-4);
    EXPECT_EQ(input.initial.offset[1], 1e-3);

    EXPECT_EQ(input.run.duration, 3600);
    EXPECT_EQ(input.run.cfl, 0.5);
    EXPECT_FALSE(input.run.local_steps);
    EXPECT_EQ(input.run.stress_limit, 0);
    EXPECT_EQ(input.run.absolute_tolerance, 1e-8);
    EXPECT_EQ(input.run.relative_tolerance, 1e-6);
    EXPECT_EQ(input.run.threads, 2);
    EXPECT_DOUBLE_EQ(input.output.interval, 0.01);
    EXPECT_EQ(input.output.profile_interval, 0);
    EXPECT_EQ(input.output.checkpoint_interval, 120);
    EXPECT_DOUBLE_EQ(input.output.side_force_window, 3.048);
    EXPECT_TRUE(input.run.reproducible);
    EXPECT_EQ(input.initial.penetration_limit, 0.0254);
}

TEST(GoodCases, OnlyARunNeedsADuration) {
    const Case statics = read_text(replaced(smallest_case, "[run]\nduration = 1\n", ""));
    EXPECT_EQ(statics.run.duration, 0);
    try {
        require_duration(statics);
        FAIL() << "a run without a duration";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::EndsWith("smallest.toml: missing key \"run.duration\"; "
                                                    "expected a time such as 200 or \"5 min\" "
                                                    "in a table [run]"));
    }
    EXPECT_NO_THROW(require_duration(read_text(smallest_case)));
}

TEST(GoodCases, NoCheckpointsAreAskedForByAnIntervalOfZero) {
    const Case input = read_text(smallest_case + "[output]\ncheckpoint_interval = 0\n");
    EXPECT_EQ(input.output.checkpoint_interval, 0);
}

TEST(GoodCases, SchedulesAreLinearBetweenPointsAndConstantOutside) {
    const Case input = read_trial("Trial", "Trial");
    EXPECT_THAT(input.bit.weight.times(), ElementsAre(5, 10));
    EXPECT_EQ(input.bit.weight(0), 0);
    EXPECT_DOUBLE_EQ(input.bit.weight(7.5), 32500);
    EXPECT_EQ(input.bit.weight(11), 65e3);
    EXPECT_DOUBLE_EQ(input.head.rotation(100), 110 * 2 * pi / 60);
    EXPECT_EQ(input.bit.torque(3), 10e3);
}

TEST(GoodCases, WholeNumbersMayBeWrittenAsReals) {
    EXPECT_EQ(read_trial("segments = 50", "segments = 5e1").mesh.segments, 50);
}

TEST(GoodCases, ContactPointsPressOnRockOrOnAWallThatIsFirmer) {
    EXPECT_EQ(read_trial("[run]", "[run]").contact.point_stiffness, 6e8);
    EXPECT_EQ(
        read_trial("[run]", "[contact]\nnormal_stiffness = 2e7\n[run]").contact.point_stiffness,
        6e8);
    EXPECT_EQ(
        read_trial("[run]", "[contact]\nnormal_stiffness = 2e9\n[run]").contact.point_stiffness,
        2e9);
    EXPECT_EQ(read_trial("[run]", "[contact]\nnormal_stiffness = 2e7\npoint_stiffness = 3e9\n[run]")
                  .contact.point_stiffness,
              3e9);
}

TEST(GoodCases, AnEccentricMassHasAPlaceInItsComponent) {
    const Case input = read_trial(
        "[mesh]", "eccentric_mass = \"0.5 kg m\"\neccentric_mass_position = \"10 ft\"\n[mesh]");
    EXPECT_EQ(input.string.components[1].eccentric->moment, 0.5);
    EXPECT_DOUBLE_EQ(input.string.components[1].eccentric->position, 3.048);
}

TEST(GoodCases, AJarStandsBehindItsComponent) {
    const Case input = read_trial("[mesh]",
                                  "[string.component.jar]\nup_force = \"90 kip\"\n"
                                  "up_travel = \"8 in\"\ndelay = \"1 min\"\n[mesh]");
    EXPECT_FALSE(input.string.components[0].jar);
    const JarCase& jar = *input.string.components[1].jar;
    EXPECT_EQ(jar.position, 50);
    EXPECT_NEAR(jar.up_force, 400.34e3, 10);
    EXPECT_DOUBLE_EQ(jar.up_travel, 0.2032);
    EXPECT_EQ(jar.down_force, 0);
    EXPECT_EQ(jar.delay, 60);
}

TEST(GoodCases, APartMayBeAsWideAsItsHoleOrWiderByTheInterference) {
    EXPECT_NO_THROW(read_trial("diameter = 0.3111", "diameter = \"8 in\""));
    EXPECT_NO_THROW(read_trial("diameter = 0.3111\n",
                               "diameter = \"7.9 in\"\n[contact]\ninterference = \"0.1 in\"\n"));
}

TEST(GoodCases, SectionPropertiesGivenOutrightReplacePipeAndMaterial) {
    const Case input = read_text(replaced(smallest_case,
                                          "outer_diameter = 0.1\nlinear_density = 20\n"
                                          "youngs_modulus = 2e11\n",
                                          "linear_density = 20\nbending_stiffness = 1\n"
                                          "torsional_stiffness = 2\naxial_stiffness = 3\n"
                                          "shear_stiffness = 4\ninertia = 5\npolar_inertia = 6\n"));
    EXPECT_EQ(input.string.components[0].outer_diameter, 0);
    EXPECT_EQ(input.string.components[0].youngs_modulus, 0);
    EXPECT_EQ(input.string.components[0].shear_stiffness, 4);
}

TEST(GoodCases, StrongerComponentsFitWhereTheWellIsWide) {
    const Case input =
        read_trial("diameter = 0.3111",
                   "section = [{to = 400, diameter = \"7 in\"}, {to = 520, diameter = \"9 in\"}]");
    EXPECT_EQ(input.well->sections.size(), 2U);
}

TEST(GoodCases, FluidWithoutAWellBuoysAndNeedsNoViscosity) {
    const Case input = read_text(smallest_case + "[fluid]\ndensity = 1000\n");
    EXPECT_EQ(input.fluid->density, 1000);
}

TEST(GoodCases, DynamicFrictionLeftOutNeverExceedsTheStaticOne) {
    const Case input = read_text(smallest_case + "[contact]\nstatic_friction = [0.5, 0.3]\n");
    EXPECT_EQ(input.contact.dynamic_friction.axial, 0.42);
    EXPECT_EQ(input.contact.dynamic_friction.azimuthal, 0.3);
}

TEST(GoodCases, ACurvedStringMayStartInItsOwnShape) {
    const Case input = read_text(smallest_case + "[initial]\nstate = \"stress-free\"\n");
    EXPECT_EQ(input.initial.state, InitialState::stress_free);
}

TEST(GoodCases, WindowsLineEndsAndByteOrderMarksDoNoHarm) {
    std::string text = "\xEF\xBB\xBF";
    for (const char c : smallest_case)
        text += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(read_text(text).run.duration, 1);
}

TEST(GoodCases, DampingOfTranslationAndOfRotationHaveUnitsOfTheirOwn) {
    const DampingCase damping = read_text(smallest_case + R"([damping]
internal_translation = "3 N s/m"
internal_rotation = "4 N m s"
external_translation = "5 mPa s"
external_rotation = "6 kN s"
)")
                                    .damping;
    EXPECT_EQ(damping.internal.translation, 3);
    EXPECT_EQ(damping.internal.rotation, 4);
    EXPECT_EQ(damping.external.translation, 5e-3);
    EXPECT_EQ(damping.external.rotation, 6e3);
}

TEST(GoodCases, DampingOfOneMotionLeavesTheOtherAlone) {
    const DampingCase damping =
        read_text(smallest_case + "[damping]\nexternal_rotation = 6\ninternal = 2\n").damping;
    EXPECT_EQ(damping.external.translation, 0);
    EXPECT_EQ(damping.external.rotation, 6);
    EXPECT_EQ(damping.internal.translation, 2);
    EXPECT_EQ(damping.internal.rotation, 2);
}

TEST(GoodCases, DragCoefficientIsThatOfTheInertialRegime) {
    const Case input = read_trial("viscosity = 1e-3",
                                  "viscosity = 1e-3\nregime = \"inertial\"\n"
                                  "drag_coefficient = 1.2\ncontact_drag = true\n");
    EXPECT_EQ(input.fluid->regime, FlowRegime::inertial);
    EXPECT_EQ(input.fluid->drag_coefficient, 1.2);
}

}  // namespace
}  // namespace drillstrand
