/// Messages about lengths repeat them as the user wrote them.
#include <gtest/gtest.h>

#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

const std::string field_case = R"([well]
survey = "survey.csv"
section = [{to = "1000 ft", diameter = "12.25 in"}, {to = "1700 ft", diameter = "8.5 in"}]
[string]
[[string.component]]
name = "pipe"
length = "1200 ft"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
linear_density = "19.5 lb/ft"
youngs_modulus = "206 GPa"
[[string.component]]
name = "collar"
length = "300 ft"
outer_diameter = "8 in"
inner_diameter = "3 in"
density = 7850
youngs_modulus = "206 GPa"
[mesh]
segments = 50
[torque_drag]
depths = ["500 ft", "1000 ft"]
[run]
duration = "5 min"
)";

std::string message_after(const std::string& passage, const std::string& replacement) {
    TrialFolder folder;
    folder.write("survey.csv", "MD (ft),Inc,Azi\n0,0,0\n1700,2,40\n");
    folder.write("case.toml", replaced(field_case, passage, replacement));
    return folder.message("case.toml");
}

TEST(OwnUnits, ThePlainCaseIsRead) {
    EXPECT_EQ(message_after("50", "60"), "");
}

TEST(OwnUnits, DiametersAndDepthsAreRepeatedAsWritten) {
    EXPECT_EQ(
        message_after("outer_diameter = \"8 in\"", "outer_diameter = \"8.65 in\""),
        R"(case.toml:15:18: component 2 ("collar") has an outer diameter of 8.65 in; expected )"
        "at most 8.5 in, the diameter of the well from 1200 ft to 1500 ft");
    EXPECT_EQ(message_after("outer_diameter = \"8 in\"", "outer_diameter = \"9 5/8 in\""),
              R"(case.toml:15:18: component 2 ("collar") has an outer diameter of 9 5/8 in; )"
              "expected at most 8.5 in, the diameter of the well from 1200 ft to 1500 ft");
    EXPECT_EQ(message_after("\"4.276 in\"", "\"6 in\""),
              "case.toml:9:18: string.component.0.inner_diameter is 6 in; expected less than the "
              "outer diameter of 5 in");
    EXPECT_EQ(message_after("\"4.276 in\"", "0.15"),
              "case.toml:9:18: string.component.0.inner_diameter is 0.15 m; expected less than the "
              "outer diameter of 5 in");
    EXPECT_EQ(message_after("to = \"1700 ft\"", "to = \"900 ft\""),
              "case.toml:3:59: well.section.1.to is 900 ft; expected more than 1000 ft, where the "
              "section starts");
}

TEST(OwnUnits, SumsAreInFeetWhereLengthsAre) {
    EXPECT_EQ(message_after("length = \"300 ft\"", "length = \"600 ft\""),
              "case.toml:4:1: the string is 1800 ft long; expected at most 1700 ft, the length of "
              "the surveyed well");
}

TEST(OwnUnits, DepthsOfTorqueAndDragAreRepeatedAsWritten) {
    EXPECT_EQ(
        message_after("[\"500 ft\", \"1000 ft\"]", "[\"500 ft\", \"400 ft\"]"),
        "case.toml:22:21: torque_drag.depths.1 is 400 ft; expected more than 500 ft, the depth "
        "before it");
    EXPECT_EQ(
        message_after("[\"500 ft\", \"1000 ft\"]", "[\"500 ft\", \"1900 ft\"]"),
        "case.toml:22:21: torque_drag.depths.1 is 1900 ft; expected more than 0 ft, where the "
        "well starts, and at most 1700 ft, where its survey ends");
    EXPECT_EQ(message_after("[\"500 ft\", \"1000 ft\"]",
                            "{from = \"900 ft\", to = \"800 ft\", step = \"10 ft\"}"),
              "case.toml:22:33: torque_drag.depths.to is 800 ft; expected at least from, 900 ft");
}

TEST(OwnUnits, TimesAreRepeatedAsWritten) {
    EXPECT_EQ(message_after("[run]", "[head]\nrotation = [[\"1 min\", 0], [\"59 s\", 1]]\n[run]"),
              "case.toml:24:28: head.rotation.1.0 is time 59 s after 1 min; expected ascending "
              "times");
    EXPECT_EQ(message_after("duration = \"5 min\"",
                            "duration = \"5 min\"\n[output]\ninterval = "
                            "1e-9"),
              "case.toml:26:12: output.interval makes 3e+11 records in 5 min; expected at most "
              "1e+08, an interval of at least 3e-06 s");
}

}  // namespace
}  // namespace drillstrand
