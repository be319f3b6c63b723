/// Survey and component tables in the forms that people keep them in.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::vector<SurveyStation> read_survey_text(const std::string& text) {
    TrialFolder folder;
    folder.write("case.toml", trial_case);
    folder.write("survey.csv", text);
    return folder.read("case.toml").well->survey;
}

TEST(Tables, SurveyWithoutUnitsIsInMetresAndDegrees) {
    expect_same(read_survey_text("md,inclination,azimuth\n0,0,0\n609.6,30,270\n"),
                {{0, 0, 0}, {609.6, 30 * degree, 270 * degree}});
}

TEST(Tables, FeetAndMetresGiveTheSameStations) {
    expect_same(read_survey_text("md[ft],inclination[deg],azimuth[deg]\n0,0,0\n2000,30,270\n"),
                read_survey_text("md[m],inclination[rad],azimuth[deg]\n0,0,0\n"
                                 "609.6,0.52359877559829887,270\n"));
}

TEST(Tables, SpacesCommentsQuotesExtraColumnsAndOrderDoNotMatter) {
    expect_same(read_survey_text("\xEF\xBB\xBF# measured in 2012, north is \"true\"\r\n\r\n"
                                 "Note, Azimuth (deg), MD [m] ,inclination,tvd\r\n"
                                 "\"tie-in, surface\", 0, 0, 0, 0\r\n"
                                 "  # lost\r\n"
                                 "\"\"\"good\"\"\", 270,+609.6 , 3e1,\r\n"
                                 ",,,,\r\n"),
                {{0, 0, 0}, {609.6, 30 * degree, 270 * degree}});
}

TEST(Tables, ComponentTableGivesTheSameStringAsTheList) {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    folder.write("list.toml", trial_case);
    folder.write("table.toml", with_component_file(trial_case, "tables/bha.csv"));
    std::filesystem::create_directory(folder.path("tables"));
    folder.write("tables/bha.csv",
                 "name,length,outer_diameter[in],inner_diameter[in],linear_density[lb/ft],density,"
                 "youngs_modulus[GPa]\n"
                 "pipe,400,5,4.276,19.5,,206\n"
                 "collar,100,8,3,,7850,206\n");
    const std::vector<Component> list = folder.read("list.toml").string.components;
    const std::vector<Component> table = folder.read("table.toml").string.components;
    ASSERT_EQ(list.size(), table.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
        EXPECT_EQ(table[k].name, list[k].name);
        EXPECT_EQ(table[k].length, list[k].length);
        EXPECT_DOUBLE_EQ(table[k].outer_diameter, list[k].outer_diameter);
        EXPECT_DOUBLE_EQ(table[k].inner_diameter, list[k].inner_diameter);
        EXPECT_DOUBLE_EQ(table[k].linear_density, list[k].linear_density);
        EXPECT_EQ(table[k].youngs_modulus, list[k].youngs_modulus);
        EXPECT_EQ(table[k].poisson_ratio, list[k].poisson_ratio);
    }
}

TEST(Tables, ComponentTablesMayHaveSemicolonsOrTabs) {
    const std::string table =
        "name,length,outer_diameter[in],inner_diameter[in],linear_density[lb/ft],"
        "youngs_modulus[GPa]\npipe,400,5.5,4.276,19.5,206\n";
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    folder.write("case.toml", with_component_file(trial_case, "bha.csv"));
    for (const char separator : {';', '\t'}) {
        std::string text = table;
        std::replace(text.begin(), text.end(), ',', separator);
        folder.write("bha.csv", text);
        const Component component = folder.read("case.toml").string.components.at(0);
        EXPECT_EQ(component.name, "pipe");
        EXPECT_DOUBLE_EQ(component.outer_diameter, 5.5 * 0.0254);
    }
}

TEST(Tables, ComponentTableHoldsStressFreeStrainsAndSectionProperties) {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    folder.write("case.toml", with_component_file(trial_case, "bha.csv"));
    folder.write("bha.csv",
                 "length,outer_diameter,linear_density,youngs_modulus,curvature_twist,"
                 "curvature_bend1[deg/30m],curvature_bend2,bending_stiffness[kN m2],poisson_ratio\n"
                 "100,0.1,20,2e11,0.25,30,0.5,7,0.25\n");
    const Component component = folder.read("case.toml").string.components.at(0);
    EXPECT_EQ(component.curvature[0], 0.25);
    EXPECT_DOUBLE_EQ(component.curvature[1], degree);
    EXPECT_EQ(component.curvature[2], 0.5);
    EXPECT_EQ(component.bending_stiffness, 7000);
    EXPECT_EQ(component.poisson_ratio, 0.25);
}

}  // namespace
}  // namespace drillstrand
