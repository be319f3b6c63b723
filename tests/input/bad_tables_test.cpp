/// Every kind of mistake in a survey or component table gets one line that names its place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

using namespace std::string_literals;

struct BadTable {
    std::string text;
    std::string message;
};

void expect_survey_messages(const std::vector<BadTable>& tables) {
    for (const BadTable& table : tables) {
        SCOPED_TRACE(table.text);
        TrialFolder folder;
        folder.write("case.toml", trial_case);
        folder.write("survey.csv", table.text);
        EXPECT_EQ(folder.message("case.toml"), table.message);
    }
}

TEST(BadTables, MistakesInASurveyAreLocated) {
    expect_survey_messages({
        {"", "survey.csv:1:1: the table is empty; expected a header and rows"},
        {"# only a comment\n\n", "survey.csv:1:1: the table is empty; expected a header and rows"},
        {"md,inclination,azimuth\n",
         "survey.csv:1:1: the survey has 0 stations; expected at least two"},
        {"md,inclination,azimuth\n0,0,0\n",
         "survey.csv:1:1: the survey has 1 stations; expected at least two"},
        {"md,tilt,azimuth\n0,0,0\n520,1,0\n",
         R"(survey.csv:1:1: missing column "inclination"; expected it beside md, tilt, azimuth)"},
        {"Well A\nby hand\nMD;Azi\n0;0\n520;0\n",
         R"(survey.csv:3:1: missing column "inclination"; expected it beside md, azimuth)"},
        {"MD Inc Azi\n0 0 0\n520 1 0\n",
         R"(survey.csv:1:1: missing column "md"; expected it beside md inc azi; columns are parted by commas, semicolons or tabs)"},
        {"md,inclination,azimuth,md\n0,0,0,0\n520,1,0,0\n",
         R"(survey.csv:1:24: column "md" is the md, as "md" is; expected it once)"},
        {"MD (m),MD (ft),Inc,Azi\n0,0,0,0\n520,1706,1,0\n",
         R"~(survey.csv:1:8: column "MD (ft)" is the md, as "MD (m)" is; expected it once)~"},
        {"MD,Inc,Azi,TVD (ft)\n0,0,0,0\n520,1,0,520\n",
         "survey.csv:1:1: column md has no unit beside tvd in ft; expected one, as in md[m] or "
         "md[ft]"},
        {"MD (m),Inc,Azi\nft,deg,deg\n0,0,0\n520,1,0\n",
         R"(survey.csv:2:1: md is in "ft" here and in "m" in the header; expected one unit)"},
        {"MD,Inc,Azi\nft,turns,deg\n0,0,0\n520,1,0\n",
         R"(survey.csv:2:4: column inclination: unknown unit "turns"; expected an angle such as deg, rad)"},
        {"MD,Inc,Azi\nfurlongs,deg,deg\n0,0,0\n520,1,0\n",
         R"(survey.csv:2:1: column md: unknown unit "furlongs"; expected a length such as m, mm, in, ft)"},
        {"MD;Inc;Azi\n0,0;0,0;0\n520.5;1,5;0\n",
         R"(survey.csv:2:1: md is "0,0", while other numbers have decimal points; expected decimal points)"},
        {"MD;Inc;Azi\n0;0;0\n1,520;1;0\n",
         R"(survey.csv:3:1: md is "1,520", whose comma may be a decimal one or part thousands; expected decimal points)"},
        {"MD;Inc;Azi\n0;0;0\n1.520,5;1;0\n",
         R"(survey.csv:3:1: md is "1.520,5"; expected a number (the unit goes into the header))"},
        {"md[ft],inclination,azimuth\n100,5,30\n520,6,0\n",
         R"(survey.csv:2:1: the survey starts at md 100 ft; expected a station at 0, or in [well] tie_in = "vertical" (a vertical station at 0 is added) or "start" (the well starts there))"},
        {"md[kN],inclination,azimuth\n0,0,0\n520,1,0\n",
         "survey.csv:1:1: column md: kN is a force; expected a length such as m, mm, in, ft"},
        {"md[fott],inclination,azimuth\n0,0,0\n520,1,0\n",
         R"(survey.csv:1:1: column md: unknown unit "fott"; did you mean "ft"?)"},
        {"md[m,inclination,azimuth\n0,0,0\n520,1,0\n",
         R"(survey.csv:1:1: header "md[m" does not end with ]; expected NAME[UNIT])"},
        {"md,inclination,azimuth\n0,0,0\n520, 1 deg,0\n",
         R"(survey.csv:3:6: inclination is "1 deg"; expected a number (the unit goes into the header))"},
        {"md,inclination,azimuth\n0,0,0\n520,nan,0\n",
         R"(survey.csv:3:5: inclination is "nan"; expected a finite number)"},
        {"md,inclination,azimuth\n0,0,0\n520,1,inf\n",
         R"(survey.csv:3:7: azimuth is "inf"; expected a finite number)"},
        {"md,inclination,azimuth\n0,0,0\n520,,0\n",
         R"(survey.csv:3:5: inclination is ""; expected a number (the unit goes into the header))"},
        {"md,inclination,azimuth\n0,0,0\n520,1\n",
         "survey.csv:3:6: the row has 2 fields; expected 3 as in the header"},
        {"md,inclination,azimuth\n0,0,0\n520,1,5,0\n",
         "survey.csv:3:9: the row has 4 fields; expected 3 as in the header"},
        {"md[ft],inclination,azimuth\n0,0,0\n5e6,1,0\n",
         "survey.csv:3:1: md is 5e6 ft; expected -1e6 to 1e6 m"},
        {"md,inclination,azimuth\n0,0,0\n520,181,0\n",
         "survey.csv:3:5: inclination is 181; expected 0 to 180 degrees"},
        {"md,inclination,azimuth\n0,-1,0\n520,1,0\n",
         "survey.csv:2:3: inclination is -1; expected 0 to 180 degrees"},
        {"md,inclination,azimuth\n0,0,0\n520,1,0\n520,2,0\n",
         "survey.csv:4:1: md is 520 m after 520 m; expected ascending measured depths"},
        {"md,inclination,azimuth\n0,0,0\n520,180,0\n",
         "survey.csv:3:5: the well turns back by 180 degrees from the station before; expected a "
         "smaller dogleg, which defines an arc"},
        {"md,inclination,azimuth\n0,90,10\n520,90,190\n",
         "survey.csv:3:5: the well turns back by 180 degrees from the station before; expected a "
         "smaller dogleg, which defines an arc"},
        {"\357\273\277# \303\274ber\r\n\r\nmd , inclination , azimuth , note\r\n0, 0, 0, "
         "\"\303\274, ok\"\r\n520, x, 0, a\r\n",
         R"(survey.csv:5:6: inclination is "x"; expected a number (the unit goes into the header))"},
        {"md,inclination,azimuth\n0,0,\"0\n520,1,0\n",
         R"(survey.csv:2:5: ""0" has an open quote; expected a closing one on the line)"},
    });
}

TEST(BadTables, BinaryFilesAreNotSurveys) {
    expect_survey_messages({
        {"\211HDF\r\n\032\n\000\000\000"s,
         "survey.csv:1:1: not text; expected a table in UTF-8, columns separated by commas"},
        {"md,inclination,azimuth\n0,0,\377\n520,1,0\n"s,
         "survey.csv:2:5: not text; expected a table in UTF-8, columns separated by commas"},
        {"md,inclination,azimuth\n0,0,0\000\n520,1,0\n"s,
         "survey.csv:2:6: not text; expected a table in UTF-8, columns separated by commas"},
    });
}

TEST(BadTables, MistakesInAComponentTableAreLocated) {
    const std::vector<BadTable> tables{
        {"length,outer_diameter,linear_density,youngs_modulus\n",
         "pipes.csv:1:1: the table has no rows; expected at least one component"},
        {"length,outer_diametre,linear_density,youngs_modulus\n400,0.1,29,2e11\n",
         R"(pipes.csv:1:8: unknown column "outer_diametre"; did you mean "outer_diameter"?)"},
        {"length,wall,linear_density,youngs_modulus\n400,0.1,29,2e11\n",
         R"(pipes.csv:1:8: unknown column "wall"; known here: name, length, outer_diameter, inner_diameter, linear_density, density, youngs_modulus, poisson_ratio, yield_strength, curvature_twist, curvature_bend1, curvature_bend2, bending_stiffness, torsional_stiffness, axial_stiffness, shear_stiffness, inertia, polar_inertia, material_density, joint_length, tool_joint_outer_diameter, tool_joint_inner_diameter, tool_joint_length, contact_diameter, contact_length, contact_position, contact_stiffness, bend, bend_position, toolface, eccentric_mass, eccentric_mass_position, element_length)"},
        {"length[kN],outer_diameter,linear_density,youngs_modulus\n400,0.1,29,2e11\n",
         "pipes.csv:1:1: column length: kN is a force; expected a length such as m, mm, in, "
         "ft"},
        {"length,outer_diameter,linear_density,youngs_modulus\n400,,29,2e11\n",
         R"(pipes.csv:2:1: missing key "outer_diameter"; expected a length such as "5 in", or all stiffnesses and inertias outright)"},
        {"length,outer_diameter,linear_density,youngs_modulus\n400,0.1,-29,2e11\n",
         "pipes.csv:2:9: linear_density is -29; expected 1e-9 to 1e9 kg/m"},
        {"length,outer_diameter,linear_density,youngs_modulus\n400,0.1,30 ft,2e11\n",
         R"(pipes.csv:2:9: linear_density is "30 ft"; expected a number (the unit goes into the header))"},
        {"length,outer_diameter,linear_density,youngs_modulus,poisson_ratio[m]\n400,0.1,29,"
         "2e11,0."
         "3\n",
         "pipes.csv:1:53: column poisson_ratio has the unit m; expected none"},
        {"name,length,outer_diameter,linear_density,youngs_modulus\npipe,400,0.1,29,2e11\nbig,"
         "100,"
         "0.32,29,2e11\n",
         R"(pipes.csv:3:9: component 2 ("big") has an outer diameter of 0.32 m; expected at most 0.3111 m, the diameter of the well from 400 m to 500 m)"},
    };
    for (const BadTable& table : tables) {
        SCOPED_TRACE(table.text);
        TrialFolder folder;
        folder.write("survey.csv", trial_survey);
        folder.write("pipes.csv", table.text);
        folder.write("case.toml", with_component_file(trial_case, "pipes.csv"));
        EXPECT_EQ(folder.message("case.toml"), table.message);
    }
}

}  // namespace
}  // namespace drillstrand
