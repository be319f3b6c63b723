/// Surveys in the forms that people keep them in.
#include <gtest/gtest.h>

#include <numbers>

#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double foot = 0.3048;

const std::vector<SurveyStation> in_metres{
    {0, 0, 0}, {609.6, 30 * degree, 270 * degree}, {1000, 31.5 * degree, 271 * degree}};
const std::vector<SurveyStation> in_feet{{0, 0, 0},
                                         {609.6 * foot, 30 * degree, 270 * degree},
                                         {1000 * foot, 31.5 * degree, 271 * degree}};
const std::string rows = "0,0,0\n609.6,30,270\n1000,31.5,271\n";

std::vector<SurveyStation> read_survey_text(const std::string& text) {
    TrialFolder folder;
    folder.write("case.toml", replaced(trial_case, "length = 400", "length = 40"));
    folder.write("survey.csv", text);
    return folder.read("case.toml").well->survey;
}

TEST(SurveyForms, HeadersAreKnownByTheirUsualNames) {
    for (const char* header :
         {"MD,Inc,Azi", "md,INCL,AZIM", "Depth,Inclination,Azimuth", "DEPT,Inc.,Az",
          "Measured Depth (m),Inclination (deg),Azimuth [deg]", "MD_m,Inc_deg,Azi_deg",
          "measured_depth,inclination,azimuth", "MD [Metres],Incl (Degrees),Azi (\302\260)",
          "\"MD, m\",Inc deg,Azi (Grid) (deg)", "MD RKB (M),INC (DEG),Azimuth (True)"}) {
        SCOPED_TRACE(header);
        expect_same(read_survey_text(std::string(header) + "\n" + rows), in_metres);
    }
}

TEST(SurveyForms, UnitsMayStandInNamesAndWords) {
    for (const char* header : {"MD_ft,Inc,Azi", "MD ft,Inc,Azi", "Depth (Feet),Incl,Azim",
                               "MEASURED DEPTH [FT],INC,AZ"}) {
        SCOPED_TRACE(header);
        expect_same(read_survey_text(std::string(header) + "\n" + rows), in_feet);
    }
}

TEST(SurveyForms, AFootOfTheSurveyorsIsLongerByTwoMillionths) {
    const auto survey = read_survey_text("MD (usft),Inc,Azi\n" + rows);
    EXPECT_DOUBLE_EQ(survey.back().measured_depth, 1000 * 1200.0 / 3937);
}

TEST(SurveyForms, ALineOfUnitsMayFollowTheHeader) {
    for (const char* units :
         {"ft,deg,deg", "(ft),(deg),(deg)", "[feet],[\302\260],[\302\260]", "ft,,", "FT,DEG,DEG"}) {
        SCOPED_TRACE(units);
        expect_same(read_survey_text("MD,Inc,Azi\n" + std::string(units) + "\n\n" + rows), in_feet);
    }
    expect_same(read_survey_text("MD (ft),Inc,Azi\nft,deg,deg\n" + rows), in_feet);
}

TEST(SurveyForms, AHeaderMayTakeTwoLines) {
    expect_same(read_survey_text("Measured,Incl.,Azim.,Vertical\nDepth,,,Depth\n"
                                 "(ft),(deg),(deg),(ft)\n0,0,0,0\n609.6,30,270,\n1000,31.5,271,\n"),
                in_feet);
}

TEST(SurveyForms, LinesBeforeTheHeaderAreSkipped) {
    expect_same(read_survey_text("Survey report;;;\nWell: A-1, 12 1/4\" hole\n"
                                 "Depth reference: RKB, 25 m above MSL\nDate,2019-05-01\n\n"
                                 "MD (m),Inc,Azi\n" +
                                 rows),
                in_metres);
}

TEST(SurveyForms, SemicolonsAndTabsPartColumnsToo) {
    expect_same(read_survey_text("MD;Inc;Azi;Remarks\n0;0;0;\n609.6;30;270;shoe, 9 m\n"
                                 "1000;31.5;271;\n"),
                in_metres);
    expect_same(read_survey_text("MD (m)\tInc\tAzi\n0\t0\t0\n609.6\t30\t270\n1000\t31.5\t271\n"),
                in_metres);
}

TEST(SurveyForms, DecimalCommasAreReadBesideSemicolonsAndTabs) {
    expect_same(read_survey_text("MD;Inc;Azi\n0,00;0;0\n609,6;30;270\n1000;31,5;271\n"), in_metres);
    // three decimals are thousands nowhere in a table that has another number of them
    expect_same(read_survey_text("MD\tInc\tAzi\n0,000\t0\t0\n609,600\t30,000\t270,000\n"
                                 "1000,000\t31,500\t271,000\n"),
                in_metres);
}

TEST(SurveyForms, OtherColumnsAreSkippedWhateverTheyAreCalled) {
    expect_same(read_survey_text("Depth,MD,Inc,TVD (m,Azi,N,N,DLS [deg/30m] (calc)\n"
                                 "x,0,0,0,0,0,0,0\ny,609.6,30,,270,,,\nz,1000,31.5,,271,,,\n"),
                in_metres);
}

TEST(SurveyForms, ATieInMayBeVertical) {
    const std::string survey = "md,inclination,azimuth\n100,5,30\n700,6,30\n";
    const auto well = [](const char* word) {
        return replaced(trial_case, "survey = \"survey.csv\"",
                        std::string("survey = \"survey.csv\"\ntie_in = \"") + word + '"');
    };
    TrialFolder folder;
    folder.write("survey.csv", survey);
    folder.write("case.toml", well("vertical"));
    expect_same(
        folder.read("case.toml").well->survey,
        {{0, 0, 30 * degree}, {100, 5 * degree, 30 * degree}, {700, 6 * degree, 30 * degree}});
    folder.write("case.toml", well("start"));
    expect_same(folder.read("case.toml").well->survey,
                {{100, 5 * degree, 30 * degree}, {700, 6 * degree, 30 * degree}});
}

TEST(SurveyForms, ATieInIsRefusedWhereItSaysNothing) {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    const std::string key = "survey = \"survey.csv\"";
    folder.write("case.toml", replaced(trial_case, key, key + "\ntie_in = \"start\""));
    EXPECT_EQ(folder.message("case.toml"),
              "case.toml:5:10: well.tie_in has no effect; expected it with a survey that starts "
              "below 0");
    folder.write("case.toml", replaced(trial_case, key, key + "\ntie_in = \"surface\""));
    EXPECT_EQ(folder.message("case.toml"),
              "case.toml:5:10: well.tie_in is \"surface\"; expected \"vertical\" or \"start\"");
    folder.write("survey.csv", "md,inclination,azimuth\n100,180,0\n700,180,5\n");
    folder.write("case.toml", replaced(trial_case, key, key + "\ntie_in = \"vertical\""));
    EXPECT_EQ(folder.message("case.toml"),
              "survey.csv:2:1: the well goes up at its first station; expected well.tie_in = "
              "\"start\", as a vertical start would turn back by 180 degrees");
}

}  // namespace
}  // namespace drillstrand
