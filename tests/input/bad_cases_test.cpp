/// Every kind of mistake in a case file gets one line that names its place and the cure.
/// Each row changes one passage of the trial case (trial_case.hpp) and gives the whole message.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

struct Mistake {
    std::string passage;      // of the trial case
    std::string replacement;  // what the user wrote instead
    std::string message;
};

void expect_messages(const std::vector<Mistake>& mistakes) {
    for (const Mistake& mistake : mistakes) {
        SCOPED_TRACE(mistake.replacement);
        TrialFolder folder;
        folder.write("survey.csv", trial_survey);
        folder.write("case.toml", replaced(trial_case, mistake.passage, mistake.replacement));
        EXPECT_EQ(folder.message("case.toml"), mistake.message);
    }
}

TEST(BadCases, UnknownKeysNameTheNearestKnownKey) {
    expect_messages({
        {R"(title = "Trial")", R"(titel = "Trial")",
         R"(case.toml:1:1: unknown key "titel"; did you mean "title"?)"},
        {"[run]", "[runs]", R"(case.toml:37:2: unknown key "runs"; did you mean "run"?)"},
        {"duration = 20\n", "duration = 20\nabsolute_tolerence = 1\n",
         R"(case.toml:39:1: unknown key "run.absolute_tolerence"; did you mean "absolute_tolerance"?)"},
        {"length = 400", "lenght = 400",
         R"(case.toml:14:1: unknown key "string.component.0.lenght"; did you mean "length"?)"},
        {"weight = [[5", "wieght = [[5",
         R"(case.toml:34:1: unknown key "bit.wieght"; did you mean "weight"?)"},
        {"viscosity = 1e-3", "Viscosity = 1e-3",
         R"(case.toml:9:1: unknown key "fluid.Viscosity"; did you mean "viscosity"?)"},
        {"duration = 20\n", "duration = 20\n[contact]\nfriction = 0.3\n",
         R"(case.toml:40:1: unknown key "contact.friction"; did you mean "static_friction"?)"},
        {"duration = 20\n", "duration = 20\n[output]\nzzzzzz = 0.3\n",
         R"(case.toml:40:1: unknown key "output.zzzzzz"; known here: interval, profile_interval, checkpoint_interval, side_force_window, cycles, sensor)"},
        {"diameter = 0.3111", "section = [{to = 500, diametre = 0.3}]",
         R"(case.toml:5:23: unknown key "well.section.0.diametre"; did you mean "diameter"?)"},
    });
}

TEST(BadCases, MissingKeysAreAskedForAtTheirTable) {
    expect_messages({
        {"segments = 50\n", "",
         R"(case.toml:27:1: missing key "mesh.segments"; expected a number of segments, or element_length)"},
        {"[mesh]\nsegments = 50\n", "",
         R"(case.toml:1:1: missing key "mesh"; expected a table with segments or element_length)"},
        {"survey = \"survey.csv\"\n", "",
         R"(case.toml:3:1: missing key "well.survey"; expected the name of a CSV file, or of WITSML in .xml)"},
        {"diameter = 0.3111\n", "",
         R"(case.toml:3:1: missing key "well.diameter"; expected a length such as "12.25 in", or [[well.section]])"},
        {"density = 1917\n", "",
         R"(case.toml:7:1: missing key "fluid.density"; expected a density such as "10 ppg")"},
        {"viscosity = 1e-3\n", "",
         R"(case.toml:7:1: missing key "fluid.viscosity"; expected a viscosity such as "1 cP", or drag = false)"},
        {"length = 400\n", "",
         R"(case.toml:12:1: missing key "string.component.0.length"; expected a length such as 9.1 or "30 ft")"},
        {"outer_diameter = \"5 in\"\n", "",
         R"(case.toml:12:1: missing key "string.component.0.outer_diameter"; expected a length such as "5 in", or all stiffnesses and inertias outright)"},
        {"youngs_modulus = \"206 GPa\"\n[[", "[[",
         R"(case.toml:12:1: missing key "string.component.0.youngs_modulus"; expected a pressure such as "206 GPa", or all four stiffnesses outright)"},
        {"linear_density = \"19.5 lb/ft\"\n", "",
         R"(case.toml:12:1: missing key "string.component.0.linear_density"; expected a mass per length such as "19.5 lb/ft", or density)"},
    });
}

TEST(BadCases, ValuesOfTheWrongTypeSayWhatWasExpected) {
    expect_messages({
        {R"(title = "Trial")", "title = 12",
         "case.toml:1:9: title is 12; expected a text in quotes"},
        {R"(title = "Trial")", "title = \"Trial\"\ncontact = 3",
         "case.toml:2:11: contact is 3; expected a table [contact]"},
        {"[mesh]\nsegments = 50\n", "mesh = 50\n",
         R"(case.toml:27:1: unknown key "string.component.1.mesh"; known here: name, length, outer_diameter, inner_diameter, linear_density, density, youngs_modulus, poisson_ratio, yield_strength, curvature, jar, bending_stiffness, torsional_stiffness, axial_stiffness, shear_stiffness, inertia, polar_inertia, material_density, joint_length, tool_joint_outer_diameter, tool_joint_inner_diameter, tool_joint_length, contact_diameter, contact_length, contact_position, contact_stiffness, bend, bend_position, toolface, eccentric_mass, eccentric_mass_position, element_length)"},
        {"[head]\n", "[output]\ninterval = {}\n[head]\n",
         "case.toml:31:12: output.interval is a table; expected a number in SI or a time such as "
         "s, min, h"},
        {"duration = 20\n", "duration = true\n",
         "case.toml:38:12: run.duration is true; expected a number in SI or a time such as s, min, "
         "h"},
        {"duration = 20\n", "duration = 2024-05-06\n",
         "case.toml:38:12: run.duration is a date or time; expected a number in SI or a time such "
         "as s, min, h"},
        {"duration = 20\n", "duration = [20]\n",
         "case.toml:38:12: run.duration is a list; expected a number in SI or a time such as s, "
         "min, h"},
        {"segments = 50", "segments = 50.5",
         "case.toml:28:12: mesh.segments is 50.5; expected a whole number from 1 to 10000000"},
        {"segments = 50", R"(segments = "50")",
         R"(case.toml:28:12: mesh.segments is "50"; expected a whole number from 1 to 10000000)"},
        {"viscosity = 1e-3", "viscosity = 1e-3\ndrag = \"yes\"",
         R"(case.toml:10:8: fluid.drag is "yes"; expected true or false)"},
        {"viscosity = 1e-3", "viscosity = 1e-3\ninside = \"air\"",
         R"(case.toml:10:10: fluid.inside is "air"; expected "fluid" or "empty")"},
        {"viscosity = 1e-3", "viscosity = 1e-3\ninside = 1",
         "case.toml:10:10: fluid.inside is 1; expected a text in quotes"},
        {R"(name = "pipe")", "name = 7",
         "case.toml:13:8: string.component.0.name is 7; expected a text in quotes"},
        {R"(name = "pipe")", R"(poisson_ratio = "0.3")",
         R"(case.toml:13:17: string.component.0.poisson_ratio is "0.3"; expected a number without a unit)"},
        {"[head]", "[head]\nposition = 3",
         "case.toml:31:12: head.position is 3; expected a list of three values"},
        {"[head]", "[head]\nposition = [0, 0]",
         "case.toml:31:12: head.position has 2 entries; expected a list of three values"},
        {"[head]", "[head]\nposition = [0, 0, false]",
         "case.toml:31:19: head.position.2 is false; expected a number in SI or a length such as "
         "m, mm, in, ft"},
        {"duration = 20\n", "duration = 20\n[contact]\nstatic_friction = [0.1, 0.2, 0.3]\n",
         "case.toml:40:19: contact.static_friction has 3 entries; expected a number or [axial, "
         "azimuthal]"},
    });
}

TEST(BadCases, UnitsOfTheWrongKindAreNamed) {
    expect_messages({
        {"length = 400", R"(length = "400 kN")",
         "case.toml:14:10: string.component.0.length: kN is a force; expected a length such as m, "
         "mm, in, ft"},
        {"length = 400", R"(length = "400 n")",
         R"(case.toml:14:10: string.component.0.length: unknown unit "n"; did you mean "N"?)"},
        {"length = 400", R"(length = "400")",
         R"(case.toml:14:10: string.component.0.length: "400" has no unit; expected a length such as m, mm, in, ft, or a number without quotes in SI)"},
        {"length = 400", R"(length = "long")",
         R"(case.toml:14:10: string.component.0.length: "long" does not start with a number; expected a length such as m, mm, in, ft)"},
        {"length = 400", R"(length = "400 furlongs")",
         R"(case.toml:14:10: string.component.0.length: unknown unit "furlongs"; expected a length such as m, mm, in, ft)"},
        {"torque = \"10 kN m\"\n", "torque = \"7000 ft lb\"\n",
         "case.toml:35:10: bit.torque: ft lb is an inertia per length; expected a moment such as N "
         "m, kN m, ft lbf (a pound of force is lbf, a kilogram of force kgf)"},
        {"density = 1917", R"(density = "10 pgg")",
         R"(case.toml:8:11: fluid.density: unknown unit "pgg"; did you mean "ppg"?)"},
        {"youngs_modulus = \"206 GPa\"\n[[", "youngs_modulus = \"206 Gpa\"\n[[",
         R"(case.toml:18:18: string.component.0.youngs_modulus: unknown unit "Gpa"; did you mean "GPa"?)"},
        {R"("110 rpm")", R"("110 s")",
         "case.toml:31:25: head.rotation.1.1: s is a time; expected a frequency such as rpm, Hz, "
         "rad/s"},
        {"diameter = 0.3111", R"(diameter = "12,25 in")",
         R"(case.toml:5:12: well.diameter: cannot read the unit ",25 in" from ",25 in" on; expected a length such as m, mm, in, ft)"},
        {"viscosity = 1e-3", R"(viscosity = "1 Pa /")",
         R"(case.toml:9:13: fluid.viscosity: unit "Pa /" ends with an operator; expected a viscosity such as Pa s, mPa s, cP)"},
    });
}

TEST(BadCases, ValuesOutOfRangeSayTheRange) {
    expect_messages({
        {"duration = 20\n", "duration = 0\n",
         "case.toml:38:12: run.duration is 0; expected 1e-9 to 1e9 s"},
        {"duration = 20\n", "duration = inf\n",
         "case.toml:38:12: run.duration is inf; expected a finite number"},
        {"duration = 20\n", "duration = nan\n",
         "case.toml:38:12: run.duration is nan; expected a finite number"},
        {"duration = 20\n", "duration = \"1e999 s\"\n",
         R"(case.toml:38:12: run.duration: "1e999 s" is not a finite number; expected a finite one)"},
        {"duration = 20\n", "duration = \"1e308 h\"\n",
         R"(case.toml:38:12: run.duration: "1e308 h" is too large; expected a finite number)"},
        {"length = 400", R"(length = "-400 ft")",
         R"(case.toml:14:10: string.component.0.length is "-400 ft"; expected 1e-6 to 1e6 m)"},
        {"segments = 50", "segments = 0",
         "case.toml:28:12: mesh.segments is 0; expected a whole number from 1 to 10000000"},
        {"segments = 50", "segments = 9000000000",
         "case.toml:28:12: mesh.segments is 9000000000; expected a whole number from 1 to "
         "10000000"},
        {"segments = 50", "element_length = 1e-9",
         "case.toml:28:18: mesh.element_length is 1e-09; expected 1e-6 to 1e6 m"},
        {"segments = 50", "element_length = 1e-5",
         "case.toml:28:18: mesh.element_length makes 50000000 segments; expected at most "
         "10000000"},
        {R"(title = "Trial")", "title = \"Trial\"\ngravity = -9.81",
         "case.toml:2:11: gravity is -9.81; expected 0 to 1000 m/s2"},
        {"viscosity = 1e-3", "viscosity = 1e-3\nfilm = 1",
         "case.toml:10:8: fluid.film is 1; expected at least 1e-6 and less than 1"},
        {R"(name = "pipe")", "poisson_ratio = 0.6",
         "case.toml:13:17: string.component.0.poisson_ratio is 0.6; expected -0.99 to 0.5"},
        {R"(inner_diameter = "3 in")", R"(inner_diameter = "8 in")",
         "case.toml:23:18: string.component.1.inner_diameter is 8 in; expected less than the "
         "outer diameter of 8 in"},
        {"duration = 20\n", "duration = 20\ncfl = 1.5\n",
         "case.toml:39:7: run.cfl is 1.5; expected 1e-6 to 1"},
        {"duration = 20\n", "duration = 20\ntolerance = 0\n",
         "case.toml:39:13: run.tolerance is 0; expected 1e-12 to 1"},
        {"duration = 20\n", "duration = 20\ntolerance = 0.01\nintegrator = \"dormand-prince\"\n",
         "case.toml:39:13: run.tolerance is for the leapfrog; dormand-prince has "
         "run.absolute_tolerance and run.relative_tolerance"},
        {"duration = 20\n", "duration = 20\nthreads = -1\n",
         "case.toml:39:11: run.threads is -1; expected a whole number from 0 to 4096"},
        {"duration = 20\n", "duration = 20\n[contact]\nrestitution = 1.1\n",
         "case.toml:40:15: contact.restitution is 1.1; expected 0 to 1"},
        {"duration = 20\n",
         "duration = 20\n[contact]\nstatic_friction = [0.5, 0.3]\ndynamic_friction = 0.4\n",
         "case.toml:41:20: contact.dynamic_friction is 0.4; expected at most static_friction, 0.3"},
        {"weight = [[5, 0], [10, \"65 kN\"]]", "weight = \"-1 kN\"",
         R"(case.toml:34:10: bit.weight is "-1 kN"; expected 0 to 1e12 N)"},
        {"[head]", "[head]\ndirection = [0, 0, 0]",
         "case.toml:31:13: head.direction has no length; expected a vector that is not zero"},
        {"torque = \"10 kN m\"\n", "torque = -1\n",
         "case.toml:35:10: bit.torque is -1; expected 0 to 1e12 N m"},
    });
}

TEST(BadCases, ASlipOfThePenIsNotSimulated) {
    expect_messages({
        {"youngs_modulus = \"206 GPa\"\n[[", "youngs_modulus = 1e-300\n[[",
         "case.toml:18:18: string.component.0.youngs_modulus is 1e-300; expected 1000 to 1e15 Pa"},
        {"length = 400", "length = 1e-300",
         "case.toml:14:10: string.component.0.length is 1e-300; expected 1e-6 to 1e6 m"},
        {"duration = 20\n", "duration = 20\nlocal_steps = 1\n",
         "case.toml:39:15: run.local_steps is 1; expected true or false"},
        {"duration = 20\n", "duration = 20\ncfl = 1e-300\n",
         "case.toml:39:7: run.cfl is 1e-300; expected 1e-6 to 1"},
        {"duration = 20\n", "duration = 1e300\n",
         "case.toml:38:12: run.duration is 1e+300; expected 1e-9 to 1e9 s"},
        {"duration = 20\n", "duration = 20\n[output]\ninterval = 1e-300\n",
         "case.toml:40:12: output.interval is 1e-300; expected 1e-9 to 1e9 s"},
        {R"([[0, 0], [2, "110 rpm"]])", R"([[0, 0], [2, "1e200 rpm"]])",
         "case.toml:31:25: head.rotation.1.1 is \"1e200 rpm\"; expected -100000 to 100000 rad/s"},
        {"[head]", "[head]\nposition = [0, 0, 1e30]",
         "case.toml:31:19: head.position.2 is 1e+30; expected -1e6 to 1e6 m"},
    });
}

TEST(BadCases, SensorsHaveNamesOfTheirOwnAndPlacesInTheString) {
    const std::string before = "duration = 20\n";
    const auto sensors = [&](const std::string& list) {
        return before + "[output]\nsensor = [" + list + "]\n";
    };
    expect_messages({
        {before, sensors("{name = \"a/b\", depth = 1}"),
         "case.toml:40:19: output.sensor.0.name is \"a/b\"; expected 1 to 64 letters, digits, "
         "\"-\" "
         "and \"_\", such as \"mwd\""},
        {before, sensors("{name = \"a\", depth = 1}, {name = \"a\", depth = 2}"),
         "case.toml:40:44: output.sensor.1.name is \"a\"; expected a name that no other sensor "
         "has"},
        {before, sensors("{name = \"a\"}"),
         "case.toml:40:11: missing key \"output.sensor.0.depth\"; expected a place along the "
         "string "
         "such as \"12 m\""},
        {before, sensors("{name = \"a\", depth = 1, interval = 1e-8}"),
         "case.toml:40:46: output.sensor.0.interval makes 2e+09 records in 20 s; expected at most "
         "1e+08, an interval of at least 2e-07 s"},
        {before, before + "[output]\ncycles = {slope = 0}\n",
         "case.toml:40:19: output.cycles.slope is 0; expected 1 to 20"},
    });
}

TEST(BadCases, MoreRecordsThanAnybodyReadsAreRefused) {
    expect_messages({
        {"duration = 20\n", "duration = 20\n[output]\ninterval = 1e-7\n",
         "case.toml:40:12: output.interval makes 2e+08 records in 20 s; expected at most 1e+08, an "
         "interval of at least 2e-07 s"},
        {"duration = 20\n", "duration = 20\n[output]\nprofile_interval = 1e-9\n",
         "case.toml:40:20: output.profile_interval makes 2e+10 records in 20 s; expected at most "
         "1e+08, an interval of at least 2e-07 s"},
        {"duration = 20\n", "duration = 1e8\n",
         "case.toml:38:12: run.duration makes 1e+09 records with output.interval = 0.1 s; expected "
         "at most 1e+08, an interval of at least 1 s"},
    });
}

TEST(BadCases, SchedulesMustAscendInTime) {
    expect_messages({
        {R"([[0, 0], [2, "110 rpm"]])", R"([[2, 0], [2, "110 rpm"]])",
         "case.toml:31:22: head.rotation.1.0 is time 2 s after 2 s; expected ascending times"},
        {R"([[0, 0], [2, "110 rpm"]])", "[[0, 0], [2]]",
         "case.toml:31:21: head.rotation.1 has 1 entries; expected [time, value]"},
        {R"([[0, 0], [2, "110 rpm"]])", "[0, 2]",
         "case.toml:31:13: head.rotation.0 is 0; expected a value or a list of [time, value] "
         "pairs"},
        {R"([[0, 0], [2, "110 rpm"]])", "[]",
         "case.toml:31:12: head.rotation is an empty list; expected a value or a list of [time, "
         "value] pairs"},
        {R"([[0, 0], [2, "110 rpm"]])", R"([["0 m", 0]])",
         "case.toml:31:14: head.rotation.0.0: m is a length; expected a time such as s, min, h"},
        {"torque = \"10 kN m\"\n", "force = [[0, [0, 0, 0]], [1, [0, 0]]]\n",
         "case.toml:35:30: bit.force.1.1 has 2 entries; expected a list of three values"},
        {"torque = \"10 kN m\"\n", "force = [[0, [0, 0, 0]], [1, 5]]\n",
         "case.toml:35:30: bit.force.1.1 is 5; expected a list of three values"},
        {"torque = \"10 kN m\"\n", "force = []\n",
         "case.toml:35:9: bit.force is an empty list; expected [x, y, z] or a list of [time, [x, "
         "y, z]] pairs"},
    });
}

TEST(BadCases, KeysThatExcludeEachOtherAreRefused) {
    expect_messages({
        {"torque = \"10 kN m\"\n", "torque = \"10 kN m\"\nfriction = 1.6\n",
         "case.toml:36:12: bit.friction excludes bit.torque; expected one of the two"},
        {"segments = 50", "segments = 50\nelement_length = 10",
         "case.toml:29:18: mesh.element_length excludes mesh.segments; expected one of the two"},
        {"density = 7850", "density = 7850\nlinear_density = 200",
         "case.toml:24:11: string.component.1.density excludes string.component.1.linear_density; "
         "expected one of the two"},
        {"diameter = 0.3111", "diameter = 0.3111\nsection = [{to = 500, diameter = 0.3}]",
         "case.toml:6:11: well.section excludes well.diameter; expected one of the two"},
        {"duration = 20\n", "duration = 20\n[contact]\nrestitution = 0.5\nnormal_damping = 1e4\n",
         "case.toml:40:15: contact.restitution excludes contact.normal_damping; expected one of "
         "the two"},
        {"[string]", "[string]\ncomponents = \"bha.csv\"",
         "case.toml:12:14: string.components excludes string.component; expected one of the two"},
        {"[head]", "[head]\nforce = [1, 0, 0]",
         R"(case.toml:31:9: head.force has no effect; expected it with head.motion = "free")"},
        {"[head]", "[head]\nmotion = \"free\"",
         R"(case.toml:32:12: head.rotation has no effect; expected it with head.motion = "driven")"},
    });
}

TEST(BadCases, TheStringMustFitTheWell) {
    expect_messages({
        {"length = 400", "length = 440",
         "case.toml:11:1: the string is 540 m long; expected at most 520 m, the length of the "
         "surveyed well"},
        {"diameter = 0.3111", "diameter = 0.2",
         R"(case.toml:22:18: component 2 ("collar") has an outer diameter of 8 in; expected at most 0.2 m, the diameter of the well from 400 m to 500 m)"},
        {"diameter = 0.3111",
         R"(section = [{to = 450, diameter = 0.3}, {to = 520, diameter = "7 in"}])",
         R"(case.toml:22:18: component 2 ("collar") has an outer diameter of 8 in; expected at most 7 in, the diameter of the well from 450 m to 500 m)"},
        {"diameter = 0.3111", "section = [{to = 450, diameter = 0.3}, {to = 450, diameter = 0.2}]",
         "case.toml:5:46: well.section.1.to is 450 m; expected more than 450 m, where the section "
         "starts"},
        {"diameter = 0.3111", "section = []",
         "case.toml:5:11: well.section is empty; expected at least one section"},
    });
}

/// The last key of the pipe of the trial case, for more keys behind it.
const std::string pipe_end =
    "youngs_modulus = \"206 GPa\"\n[[string.component]]\nname = \"collar\"";
std::string pipe_with(const std::string& keys) {
    return "youngs_modulus = \"206 GPa\"\n" + keys + "\n[[string.component]]\nname = \"collar\"";
}

TEST(BadCases, ToolJointsFitTheirPipe) {
    expect_messages({
        {pipe_end, pipe_with("tool_joint_length = 0.4"),
         "case.toml:19:21: string.component.0.tool_joint_length has no effect; expected it with "
         "string.component.0.joint_length"},
        {pipe_end, pipe_with("joint_length = 9.5"),
         R"(case.toml:12:1: missing key "string.component.0.tool_joint_outer_diameter"; expected a length such as "6.625 in")"},
        {pipe_end, pipe_with("joint_length = 9.5\ntool_joint_outer_diameter = \"4 in\""),
         "case.toml:20:29: string.component.0.tool_joint_outer_diameter is 4 in; expected more "
         "than the inner diameter of 4.276 in"},
        {pipe_end,
         pipe_with("joint_length = 9.5\ntool_joint_outer_diameter = 0.17\n"
                   "tool_joint_length = 5"),
         "case.toml:21:21: string.component.0.tool_joint_length is 5 m; expected less than half of "
         "a joint of 9.5 m"},
    });
}

TEST(BadCases, JointsAreNoSlices) {
    expect_messages({
        {pipe_end, pipe_with("joint_length = \"1 mm\"\ntool_joint_outer_diameter = 0.17"),
         "case.toml:19:16: string.component.0.joint_length makes 400000 pieces of 400 m; expected "
         "at most 20000"},
    });
}

TEST(BadCases, ContactPointsAndBendsLieInTheirComponent) {
    expect_messages({
        {pipe_end, pipe_with("contact_length = 0.4"),
         "case.toml:19:18: string.component.0.contact_length has no effect; expected it with "
         "string.component.0.contact_diameter"},
        {pipe_end, pipe_with("contact_diameter = \"4 in\""),
         "case.toml:19:20: string.component.0.contact_diameter is 4 in; expected at least the "
         "outer diameter of 5 in"},
        {pipe_end, pipe_with("contact_diameter = 0.3\ncontact_position = 401"),
         "case.toml:20:20: string.component.0.contact_position is 401 m; expected at most 400 m, "
         "the length of the component"},
        {pipe_end, pipe_with("contact_diameter = \"12.5 in\""),
         R"(case.toml:15:18: component 1 ("pipe") has a contact diameter of 12.5 in; expected at most 0.3111 m, the diameter of the well from 0 m to 400 m)"},
        {pipe_end, pipe_with("toolface = 0.4"),
         "case.toml:19:12: string.component.0.toolface has no effect; expected it with "
         "string.component.0.bend"},
        {pipe_end, pipe_with("bend = \"90 deg\""),
         "case.toml:19:8: string.component.0.bend is \"90 deg\"; expected -0.8 to 0.8 rad"},
        {pipe_end, pipe_with("bend = 0.03\nbend_position = 500"),
         "case.toml:20:17: string.component.0.bend_position is 500 m; expected at most 400 m, the "
         "length of the component"},
    });
}

TEST(BadCases, EccentricMassesTurnWithTheLeapfrogsRod) {
    expect_messages({
        {pipe_end, pipe_with("eccentric_mass_position = 3"),
         "case.toml:19:27: string.component.0.eccentric_mass_position has no effect; expected it "
         "with string.component.0.eccentric_mass"},
    });
}

TEST(BadCases, JarsTripBeforeTheySlide) {
    const std::string header = "[string.component.jar]\n";
    const auto jar = [&](const std::string& keys) { return pipe_with(header + keys); };
    const std::string upward = "up_force = 1e5\nup_travel = 0.2";
    expect_messages({
        {pipe_end, jar("delay = 3"),
         "case.toml:19:1: string.component.0.jar never trips; expected up_force with up_travel, or "
         "down_force with down_travel"},
        {pipe_end, jar("up_force = \"400 kN\""),
         "case.toml:19:1: missing key \"string.component.0.jar.up_travel\"; expected the way to "
         "the "
         "blow, such as \"0.2 m\""},
        {pipe_end, jar("down_travel = 0.1\n" + upward),
         "case.toml:20:15: string.component.0.jar.down_travel has no effect; expected it with "
         "string.component.0.jar.down_force"},
        {pipe_end, jar(upward + "\nposition = 401"),
         "case.toml:22:12: string.component.0.jar.position is 401 m; expected at most 400 m, the "
         "length of the component"},
        {pipe_end, jar(upward + "\ndelay = \"20 min\""),
         "case.toml:22:9: string.component.0.jar.delay is \"20 min\"; expected 0 to 1000 s"},
        {pipe_end, jar(upward + "\nstroke = 1"),
         "case.toml:22:1: unknown key \"string.component.0.jar.stroke\"; known here: position, "
         "up_force, up_travel, down_force, down_travel, delay"},
        {"[run]", header + upward + "\n[run]\nintegrator = \"dormand-prince\"",
         "case.toml:37:1: string.component.1.jar slides in the leapfrog's rod alone; expected "
         "run.integrator = \"leapfrog\""},
    });
    const std::string two = replaced(replaced(trial_case, pipe_end, jar(upward)), "[mesh]",
                                     header + upward + "\n[mesh]");
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    folder.write("case.toml", two);
    EXPECT_EQ(
        folder.message("case.toml"),
        "case.toml:30:1: string.component.1.jar is the second in the string; expected at most "
        "one jar");
}

TEST(BadCases, BitLawsAndDrivesHaveTheirOwnKeys) {
    const std::string torque = "torque = \"10 kN m\"";
    const auto law = [](const std::string& more) { return "law = \"stribeck\"" + more; };
    const std::string rotation = "rotation = [[0, 0], [2, \"110 rpm\"]]";
    const auto drive = [&](const std::string& keys) {
        return rotation + "\n[head.drive]\n" + keys;
    };
    expect_messages({
        {rotation, drive("proportional = 2000"),
         "case.toml:33:16: head.drive.proportional has no effect; expected it with "
         "head.drive.control = \"pi\""},
        {rotation, drive("control = \"pi\""),
         "case.toml:32:1: missing key \"head.drive.proportional\"; expected a torque over a rate, "
         "such as \"2 kN m s\""},
        {rotation, drive("control = \"tuned\""),
         "case.toml:32:1: missing key \"head.drive.frequency\"; expected a frequency to damp, such "
         "as \"0.2 Hz\""},
        {rotation, drive("control = \"matched\"\nfrequency = 1"),
         "case.toml:34:13: head.drive.frequency has no effect; expected it with "
         "head.drive.control = \"tuned\""},
        {rotation, drive("torque_limit = \"0 kN m\""),
         "case.toml:33:16: head.drive.torque_limit is \"0 kN m\"; expected 1e-9 to 1e12 N m"},
        {rotation, drive("power_limit = \"900 kN\""),
         "case.toml:33:15: head.drive.power_limit: kN is a force; expected a power such as W, kW, "
         "hp"},
        {rotation, "motion = \"free\"\n[head.drive]\ncontrol = \"stiff\"",
         "case.toml:32:1: head.drive has no effect; expected it with head.motion = \"driven\""},
        {torque, law(""),
         "case.toml:33:1: missing key \"bit.static_torque\"; expected a torque such as \"8 kN m\""},
        {torque, law("\nstatic_torque = 5000\ndynamic_torque = 6000"),
         "case.toml:37:18: bit.dynamic_torque is above bit.static_torque, 5000 N m; expected at "
         "most that"},
        {torque, torque + "\nstatic_torque = 5000",
         "case.toml:36:17: bit.static_torque has no effect; expected it with bit.law = "
         "\"stribeck\""},
        {torque, torque + "\n" + law("\nstatic_torque = 5000"),
         "case.toml:35:10: bit.torque has no effect; expected it with bit.law = \"prescribed\""},
        {torque, torque + "\nfeed = \"5 m/s\"",
         "case.toml:36:8: bit.feed has no effect; expected it with bit.law = \"cutting\""},
        {"weight = [[5, 0], [10, \"65 kN\"]]\ntorque = \"10 kN m\"", "law = \"cutting\"",
         "case.toml:33:1: missing key \"bit.cutting\"; expected a table with the rock's "
         "specific_energy"},
        {torque, "law = \"cutting\"",
         "case.toml:34:10: bit.weight has no effect; expected it with another bit.law; by this one "
         "it is what the rock asks for"},
        {"[run]", "[head.drive]\n[run]\nintegrator = \"dormand-prince\"",
         "case.toml:37:1: head.drive is for the leapfrog's rod; expected run.integrator = "
         "\"leapfrog\""},
        {torque + "\n\n[run]", law("\nstatic_torque = 1\n[run]\nintegrator = \"dormand-prince\""),
         "case.toml:35:7: bit.law is for the leapfrog's rod; expected run.integrator = "
         "\"leapfrog\""},
    });
}

TEST(BadCases, HeadsThatMoveHaveTheirOwnKeys) {
    const std::string rotation = "rotation = [[0, 0], [2, \"110 rpm\"]]";
    const auto hoist = [&](const std::string& keys) {
        return rotation + "\n[head.hoist]\n" + keys;
    };
    const std::string block = "mass = 1e4\nline_stiffness = 1e6\n";
    expect_messages({
        {rotation, rotation + "\nvelocity = 0.3",
         "case.toml:32:12: head.velocity is 0.3; expected [x, y, z] or a list of [time, [x, y, z]] "
         "pairs"},
        {rotation, "angular_velocity = [1, 0, 0]\n" + rotation,
         "case.toml:31:20: head.angular_velocity excludes head.rotation; expected one of the two"},
        {rotation, "motion = \"pinned\"\nvelocity = [1, 0, 0]",
         "case.toml:32:12: head.velocity has no effect; expected it with head.motion = \"driven\""},
        {rotation, "velocity = [0, 0.1, 0]\n[head.drive]\ncontrol = \"stiff\"",
         "case.toml:31:12: head.velocity moves the head across d3; expected none of that with "
         "head.drive"},
        {rotation, "velocity = [[0, [0, 0, 0]], [5, [2, 0, 0]]]",
         "case.toml:31:12: head.velocity takes the bit to 535 m, at 20 s; expected at most 520 m, "
         "the end of the surveyed well"},
        {rotation, hoist("mass = 1e4"),
         "case.toml:32:1: missing key \"head.hoist.line_stiffness\"; expected that of one line, "
         "such as \"1e6 N/m\""},
        {rotation, hoist(block + "block_speed = 0.1\nhook_load = 1e5"),
         "case.toml:36:13: head.hoist.hook_load excludes head.hoist.block_speed; expected one of "
         "the two"},
        {rotation, hoist(block + "block_speed = \"2 m/s\""),
         "case.toml:35:15: head.hoist.block_speed takes the bit to 540 m, at 20 s; expected at "
         "most 520 m, the end of the surveyed well"},
        {rotation, "velocity = [1, 0, 0]\n[head.hoist]\n" + block,
         "case.toml:31:12: head.velocity is for a head without a hoist; expected "
         "head.hoist.block_speed"},
        {rotation, "motion = \"pinned\"\n[head.hoist]\n" + block,
         "case.toml:32:1: head.hoist has no effect; expected it with head.motion = \"driven\""},
        {rotation, hoist(block + "[head.hoist.autodriller]\noff_bottom_load = 1"),
         "case.toml:35:1: head.hoist.autodriller has no limit; expected weight, rate or torque"},
        {rotation, hoist(block + "[head.hoist.autodriller]\nweight = 1e5"),
         "case.toml:35:1: missing key \"head.hoist.autodriller.weight_gain\"; expected a drum "
         "speed over an error"},
        {rotation, hoist(block + "[head.hoist.autodriller]\nrate = 1\nweight_gain = 1"),
         "case.toml:37:15: head.hoist.autodriller.weight_gain has no effect; expected it with "
         "head.hoist.autodriller.weight"},
        {"[run]", "[head.hoist]\n" + block + "[run]\nintegrator = \"dormand-prince\"",
         "case.toml:37:1: head.hoist is for the leapfrog's rod; expected run.integrator = "
         "\"leapfrog\""},
    });
}

TEST(BadCases, OperationsAreOfKnownWords) {
    const std::string rotation = "rotation = [[0, 0], [2, \"110 rpm\"]]";
    const auto list = [](const std::string& operations) {
        return "operations = [" + operations + "]";
    };
    expect_messages({
        {rotation, list("\"slips in\", \"spin 3 rpm\""),
         "case.toml:31:27: head.operations.1 is \"spin 3 rpm\"; expected slips in, slips out, "
         "rotate 120 rpm, trip in 28 m at 0.3 m/s, trip out 28 m at 0.3 m/s, drill 5 m at 20 m/h "
         "or wait 10 s"},
        {rotation, list("\"drill 5 m\""),
         "case.toml:31:15: head.operations.0 is \"drill 5 m\" without a speed; expected drill 5 m "
         "at 20 m/h"},
        {rotation, list("\"trip in 3 s at 1 m/s\""),
         "case.toml:31:15: head.operations.0 is \"trip in 3 s at 1 m/s\": s is a time; expected a "
         "length such as m, mm, in, ft"},
        {rotation, list("\"wait -3 s\""),
         "case.toml:31:15: head.operations.0 is \"wait -3 s\": -3 s is out of range; expected 1e-9 "
         "to 1e9"},
        {rotation, list("3"), "case.toml:31:15: head.operations.0 is 3; expected a text in quotes"},
        {rotation, list("\"wait 10 s\"") + "\n" + rotation,
         "case.toml:32:12: head.rotation excludes head.operations; expected one of the two"},
        {rotation, rotation + "\nramp_time = 1",
         "case.toml:32:13: head.ramp_time has no effect; expected it with head.operations"},
        {rotation, list("\"trip in 28 m at 5 m/s\""),
         "case.toml:31:14: head.operations takes the bit to 528 m, at 7.6 s; expected at most 520 "
         "m, the end of the surveyed well"},
        {rotation,
         list("\"wait 10 s\"") +
             "\n[head.hoist]\nmass = 1e4\nline_stiffness = 1e6\nhook_load = 1e5",
         "case.toml:31:14: head.operations feeds the drum; expected no head.hoist.block_speed, "
         "hook_load or autodriller"},
    });
}

TEST(BadCases, MeshesThatFollowTheStringHaveTheirOwnKeys) {
    expect_messages({
        {"segments = 50", "segments = 50\nelement_length = 7",
         "case.toml:29:18: mesh.element_length excludes mesh.segments; expected one of the two"},
        {"segments = 50", "segments = 50\nsegments_per_joint = 2",
         "case.toml:29:22: mesh.segments_per_joint excludes mesh.segments; expected one of the "
         "two"},
        {"segments = 50", "element_length = 7\nsegments_per_joint = 0",
         "case.toml:29:22: mesh.segments_per_joint is 0; expected a whole number from 1 to 1000"},
        {"segments = 50", "element_length = 1e-5",
         "case.toml:28:18: mesh.element_length makes 50000000 segments; expected at most 10000000"},
        {"segments = 50", "element_length = 7\nrefine = [{from = 5, to = 3, element_length = 1}]",
         "case.toml:29:27: mesh.refine.0.to is 3 m; expected more than 5 m, where the stretch "
         "starts"},
        {"segments = 50",
         "element_length = 7\nrefine = [{from = 500, to = 503, element_length = 1}]",
         "case.toml:29:19: mesh.refine.0.from is 500 m; expected less than 500 m, the length of "
         "the "
         "string"},
        {"segments = 50",
         "element_length = 7\nrefine = [{from = 5, to = 9, measured_from = \"top\", element_length "
         "= 1}]",
         R"(case.toml:29:46: mesh.refine.0.measured_from is "top"; expected "head" or "bit")"},
    });
}

/// A case whose well has these sections, from column 12 of line 5 on.
Mistake in_sections(const std::string& sections, const std::string& message) {
    return {"diameter = 0.3111", "section = [" + sections + "]", message};
}

TEST(BadCases, SectionsOfAWellFollowEachOtherAndHaveWallsThatCanBe) {
    expect_messages({
        in_sections("{from = 1, to = 520, diameter = 0.3}",
                    "case.toml:5:20: well.section.0.from is 1 m; expected at most 0 m, where the "
                    "survey starts"),
        in_sections("{to = 100, diameter = 0.3}, {from = 110, to = 520, diameter = 0.3}",
                    "case.toml:5:48: well.section.1.from is 110 m; expected 100 m, where the "
                    "section before ends"),
        in_sections("{to = 520, diameter = [0.3]}",
                    "case.toml:5:34: well.section.0.diameter has 1 entries; expected a length or "
                    "[from, to]"),
        in_sections("{to = 520, diameter = [0.3, -0.3]}",
                    "case.toml:5:40: well.section.0.diameter.1 is -0.3; expected 1e-6 to 1000 m"),
        in_sections("{name = 3, to = 520, diameter = 0.3}",
                    "case.toml:5:20: well.section.0.name is 3; expected a text in quotes"),
        in_sections("{to = 520, diameter = 0.3, static_friction = -1}",
                    "case.toml:5:57: well.section.0.static_friction is -1; expected 0 to 1000"),
        in_sections("{to = 520, diameter = 0.3, static_friction = 0.2, dynamic_friction = 0.3}",
                    "case.toml:5:81: well.section.0.dynamic_friction is 0.3; expected at most "
                    "static_friction, 0.2"),
        in_sections("{to = 520, diameter = 0.3, dynamic_friction = 0.7}",
                    "case.toml:5:58: well.section.0.dynamic_friction is 0.7; expected at most "
                    "static_friction, 0.6"),
        in_sections("{to = 520, diameter = 0.3, normal_stiffness = \"1 m\"}",
                    "case.toml:5:58: well.section.0.normal_stiffness: m is a length; expected a "
                    "pressure such as Pa, MPa, GPa, psi"),
        in_sections("{to = 450, diameter = 0.3}, {to = 520, diameter = [0.3, 0.1]}",
                    "case.toml:22:18: component 2 (\"collar\") has an outer diameter of 8 in; "
                    "expected at most 0.157142857 m, the diameter of the well from 450 m to 500 "
                    "m"),
    });
}

/// A case whose well is tortuous.
Mistake in_tortuosity(const std::string& keys, const std::string& message) {
    return {"diameter = 0.3111", "diameter = 0.3111\ntortuosity = {" + keys + "}", message};
}

TEST(BadCases, TortuosityIsOneOfAPlanner) {
    expect_messages({
        in_tortuosity("period = 30",
                      "case.toml:6:14: missing key \"well.tortuosity.amplitude\"; "
                      "expected an angle such as \"0.5 deg\", or [build, turn]"),
        in_tortuosity("amplitude = 0.01",
                      "case.toml:6:14: missing key \"well.tortuosity.period\"; expected a length "
                      "such as \"100 ft\""),
        in_tortuosity("amplitude = 1, period = 30",
                      "case.toml:6:27: well.tortuosity.amplitude is 1; expected 0 to 0.5 rad"),
        in_tortuosity("amplitude = [0.1, 0.1, 0.1], period = 30",
                      "case.toml:6:27: well.tortuosity.amplitude has 3 entries; expected an angle "
                      "or [build, turn]"),
        in_tortuosity("amplitude = 0.1, period = 0.001",
                      "case.toml:6:41: well.tortuosity.period is 0.001 m; expected at least 0.0624 "
                      "m in a survey of 520 m"),
        in_tortuosity("model = \"cosine\", amplitude = 0.1, period = 30",
                      "case.toml:6:23: well.tortuosity.model is \"cosine\"; expected \"sine\" or "
                      "\"helical\" or \"random\""),
        in_tortuosity(
            "amplitude = 0.1, period = 30, seed = 3",
            "case.toml:6:52: well.tortuosity.seed has no effect; expected it with model = "
            "\"random\""),
        in_tortuosity("model = \"random\", amplitude = 0.1, period = 30, seed = -3",
                      "case.toml:6:70: well.tortuosity.seed is -3; expected a whole number from 0 "
                      "to 1000000000"),
        in_tortuosity("amplitude = 0.1, period = 30, from = 521",
                      "case.toml:6:52: well.tortuosity.from is 521 m; expected 0 m to 520 m, in "
                      "the survey"),
        in_tortuosity("amplitude = 0.1, period = 30, from = 100, to = 90",
                      "case.toml:6:62: well.tortuosity.to is 90 m; expected 100 m to 520 m, in the "
                      "survey"),
        in_tortuosity("amplitude = 0.1, period = 30, wave = 90",
                      "case.toml:6:45: unknown key \"well.tortuosity.wave\"; known here: model, "
                      "amplitude, period, seed, from, to"),
    });
}

TEST(BadCases, FluidHasARegimeThatItsKeysFit) {
    expect_messages({
        {"viscosity = 1e-3", "viscosity = 1e-3\nregime = \"turbulent\"",
         R"(case.toml:10:10: fluid.regime is "turbulent"; expected "inertial" or "laminar")"},
        {"viscosity = 1e-3", "viscosity = 1e-3\nregime = \"laminar\"\ndrag_coefficient = 1.2",
         R"(case.toml:11:20: fluid.drag_coefficient has no effect; expected it with regime = "inertial")"},
        {"viscosity = 1e-3", "viscosity = 1e-3\ndrag_coefficient = -1",
         "case.toml:10:20: fluid.drag_coefficient is -1; expected 0 to 1000"},
        {"viscosity = 1e-3", "viscosity = 1e-3\nadded_mass = 1",
         "case.toml:10:14: fluid.added_mass is 1; expected true or false"},
    });
}

TEST(BadCases, FrictionThatFallsWithSpeedIsCoulombsOnTheLeapfrogsRod) {
    expect_messages({
        {"duration = 20\n", "duration = 20\n[contact]\nstribeck_speed = -0.1\n",
         "case.toml:40:18: contact.stribeck_speed is -0.1; expected 0 to 1e6 m/s"},
        {"duration = 20\n",
         "duration = 20\n[contact]\nlaw = \"paper\"\nstribeck_speed = \"0.1 m/s\"\n",
         "case.toml:41:18: contact.stribeck_speed has no effect; expected it with contact.law = "
         "\"coulomb\""},
        {"duration = 20\n",
         "duration = 20\nintegrator = \"dormand-prince\"\n[contact]\nstribeck_speed = 0.1\n",
         "case.toml:41:18: contact.stribeck_speed is for the leapfrog's rod; expected "
         "run.integrator = \"leapfrog\""},
    });
}

TEST(BadCases, MudInMotionIsOfOneKindAndHasAnnulusAndPump) {
    const auto fluid = [](const std::string& keys, const std::string& message) {
        return Mistake{"viscosity = 1e-3", keys, "case.toml:" + message};
    };
    expect_messages({
        fluid("viscosity = 1e-3\nconsistency = 0.5",
              "10:15: fluid.consistency excludes fluid.viscosity; expected one of the two"),
        fluid("consistency = \"0.5 Pa s\"",
              R"(9:15: fluid.consistency is "0.5 Pa s"; expected a number without a unit)"),
        fluid("consistency = 0.5\nflow_index = 1.5",
              "10:14: fluid.flow_index is 1.5; expected 0.1 to 1"),
        fluid("consistency = 0.5\nyield_stress = \"5 Pa s\"",
              "10:16: fluid.yield_stress: Pa s is a viscosity; expected a pressure such as Pa, "
              "MPa, GPa, psi"),
        fluid("viscosity = 1e-3\nyield_stress = 5",
              "10:16: fluid.yield_stress has no effect; expected it with fluid.consistency"),
        fluid("viscosity = 1e-3\nflow_rate = \"30 L\"",
              "10:13: fluid.flow_rate: L is a volume; expected a flow rate such as m3/s, L/min, "
              "gpm"),
        fluid("viscosity = 1e-3\nflow_rate = -1",
              "10:13: fluid.flow_rate is -1; expected 0 to 1000 m3/s"),
        fluid("viscosity = 0\nflow_rate = 0.03",
              "10:13: fluid.flow_rate needs friction to lose pressure; expected fluid.viscosity "
              "above 0"),
        fluid(
            "viscosity = 1e-3\ninside = \"empty\"\nflow_rate = 0.03",
            R"(11:13: fluid.flow_rate goes through a pipe that is empty; expected fluid.inside = "fluid")"),
        fluid("viscosity = 1e-3\nnozzle_area = 5e-4",
              "10:15: fluid.nozzle_area has no effect; expected it with fluid.flow_rate"),
        fluid("viscosity = 1e-3\ndrag = false\nflow_rate = 0.03",
              "11:13: fluid.flow_rate has no effect; expected it with a well and fluid.drag = "
              "true"),
        fluid("viscosity = 0\ntrip_speed = 1",
              "10:14: fluid.trip_speed needs friction to press on mud; expected fluid.viscosity "
              "above 0"),
    });
}

TEST(BadCases, RollingCreepIsAPartOfTheWay) {
    expect_messages({
        {"duration = 20\n", "duration = 20\n[contact]\nrolling_creep = 1.5\n",
         "case.toml:40:17: contact.rolling_creep is 1.5; expected 0 to 1"},
        {"duration = 20\n", "duration = 20\n[contact]\nrolling_creep = -0.1\n",
         "case.toml:40:17: contact.rolling_creep is -0.1; expected 0 to 1"},
    });
}

TEST(BadCases, DampingIsGivenForBothMotionsOrForEach) {
    const auto damping = [](const std::string& keys) {
        return "duration = 20\n[damping]\n" + keys + "\n";
    };
    expect_messages({
        {"duration = 20\n", damping("internal = 1\ninternal_rotation = 2"),
         "case.toml:41:21: damping.internal_rotation excludes damping.internal; expected one of "
         "the two"},
        {"duration = 20\n", damping("external_translation = 2\nexternal = 1"),
         "case.toml:40:24: damping.external_translation excludes damping.external; expected one of "
         "the two"},
        {"duration = 20\n", damping("external_rotation = \"1 N s/m2\""),
         "case.toml:40:21: damping.external_rotation: N s/m2 is a viscosity; expected a damping of "
         "rotation per length such as N s, kg m/s"},
        {"duration = 20\n", damping("internal_rotation = \"1 N s/m\""),
         "case.toml:40:21: damping.internal_rotation: N s/m is a damping; expected a damping of "
         "rates of bending and twist such as N m s, kg m2/s"},
        {"duration = 20\n", damping("external_translation = \"1 N s/m\""),
         "case.toml:40:24: damping.external_translation: N s/m is a damping; expected a viscosity "
         "such as Pa s, mPa s, cP"},
        {"duration = 20\n", damping("external_rotation = -1"),
         "case.toml:40:21: damping.external_rotation is -1; expected 0 to 1e12 N s"},
    });
}

TEST(BadCases, EquilibriumNeedsAHeldHeadTheLeapfrogAndRatesThatGoWithTheMotion) {
    expect_messages({
        {"duration = 20\n",
         "duration = 20\nintegrator = \"dormand-prince\"\n[initial]\nstate = \"equilibrium\"\n",
         R"(case.toml:41:9: initial.state is that of the leapfrog's rod; expected run.integrator = "leapfrog", or )"
         R"(initial.state = "coaxial")"},
        {"rotation = [[0, 0], [2, \"110 rpm\"]]\n",
         "motion = \"free\"\n[initial]\nstate = \"equilibrium\"\n",
         R"(case.toml:33:9: initial.state needs a head that holds the string; expected head.motion = "driven")"},
        {"duration = 20\n", "duration = 20\n[equilibrium]\naxial_speed = 1\n",
         R"(case.toml:40:15: equilibrium.axial_speed has no effect; expected it with motion = "rotating", "drilling", "sliding", "tripping_in" or "tripping_out")"},
        {"duration = 20\n", "duration = 20\n[equilibrium]\nmotion = \"sliding\"\nrotation = 1\n",
         R"(case.toml:41:12: equilibrium.rotation has no effect; expected it with motion = "rotating", "drilling", "tripping_in" or "tripping_out")"},
        {"duration = 20\n",
         "duration = 20\n[equilibrium]\nmotion = \"tripping_out\"\naxial_speed = 1\n",
         "case.toml:41:15: equilibrium.axial_speed does not go out of the hole; expected less than "
         "0 m/s"},
        {"duration = 20\n",
         "duration = 20\n[equilibrium]\nmotion = \"tripping_in\"\nrotation = \"20 rpm\"\n",
         "case.toml:41:12: equilibrium.rotation needs its speed too; expected "
         "equilibrium.axial_speed"},
        {"duration = 20\n", "duration = 20\n[equilibrium]\nmotion = \"rotating\"\nrotation = 0\n",
         "case.toml:41:12: equilibrium.rotation is 0; expected a rate, or another motion"},
        {"duration = 20\n", "duration = 20\n[equilibrium]\nmotion = \"drilling\"\nrotation = 0\n",
         "case.toml:41:12: equilibrium.rotation is 0; expected a rate, or another motion"},
        {"duration = 20\n", "duration = 20\n[equilibrium]\nmotion = \"whirling\"\n",
         R"(case.toml:40:10: equilibrium.motion is "whirling"; expected "rest" or "rotating" or "drilling" or "tripping_in" or "tripping_out" or "sliding")"},
    });
}

TEST(BadCases, TextThatIsNotTomlIsLocated) {
    expect_messages({
        {"duration = 20\n", "duration = \n",
         "case.toml:38:12: not valid TOML: Error while parsing key-value pair: expected value, saw "
         "'\\n'"},
        {"duration = 20\n", "duration = 20\nduration = 30\n",
         "case.toml:39:12: not valid TOML: Error while parsing key-value pair: cannot redefine "
         "existing integer 'duration'"},
        {"duration = 20\n", "duration = 20 s\n",
         "case.toml:38:15: not valid TOML: Error while parsing key-value pair: expected a comment "
         "or whitespace, saw 's'"},
        {R"(title = "Trial")", R"(title = "Trial)",
         "case.toml:1:15: not valid TOML: Error while parsing string: unescaped control characters "
         "other than TAB (U+0009) are explicitly prohibited"},
        {R"(title = "Trial")", "title = \"Tri\377\"",
         "case.toml:1:12: not valid TOML: Encountered invalid utf-8 sequence"},
        {"[mesh]", "[run]\n[mesh]",
         "case.toml:38:1: not valid TOML: Error while parsing table header: cannot redefine "
         "existing table 'run'"},
        {R"(survey = "survey.csv")", R"(survey = "elsewhere.csv")",
         R"(case.toml:4:10: cannot read "elsewhere.csv": No such file or directory; expected an existing, readable file)"},
        {R"(survey = "survey.csv")", R"(survey = ".")",
         R"(case.toml:4:10: cannot read ".": it is a directory; expected a file)"},
        {R"(survey = "survey.csv")", R"(survey = "survey.csv\u0000")",
         R"(case.toml:4:10: cannot read "survey.csv ": no such file name)"},
    });
}

}  // namespace
}  // namespace drillstrand
