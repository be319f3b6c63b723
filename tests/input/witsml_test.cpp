/// Surveys and strings in WITSML 1.4.1.1.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numbers>

#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double foot = 0.3048;
constexpr double inch = 0.0254;

std::string text_of(const std::string& name) {
    std::ifstream file(std::string(DRILLSTRAND_SOURCE_DIR "/tests/data/witsml/") + name);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The trial case with survey and string in WITSML.
class WitsmlFolder : public TrialFolder {
  public:
    WitsmlFolder() {
        const std::string text = with_component_file(trial_case, "string.xml");
        write("case.toml", replaced(text, "survey.csv", "survey.XML"));
        write("survey.XML", text_of("trajectory.xml"));
        write("string.xml", text_of("tubular.xml"));
    }
};

TEST(Witsml, TrajectoryGivesStationsInOrderOfDepth) {
    const std::vector<SurveyStation> survey = WitsmlFolder().read("case.toml").well->survey;
    ASSERT_EQ(survey.size(), 3U);
    EXPECT_EQ(survey[0].measured_depth, 0);
    EXPECT_DOUBLE_EQ(survey[1].measured_depth, 304.8);
    EXPECT_DOUBLE_EQ(survey[1].inclination, 0.1);
    EXPECT_DOUBLE_EQ(survey[1].azimuth, 44 * degree);
    EXPECT_DOUBLE_EQ(survey[2].measured_depth, 2000 * foot);
    EXPECT_DOUBLE_EQ(survey[2].inclination, 30 * degree);
    EXPECT_DOUBLE_EQ(survey[2].azimuth, 45.5 * degree);
}

TEST(Witsml, TubularGivesComponentsFromHeadToBit) {
    const std::vector<Component> string = WitsmlFolder().read("case.toml").string.components;
    ASSERT_EQ(string.size(), 3U);
    EXPECT_EQ(string[0].name, "5 in S-135");
    EXPECT_DOUBLE_EQ(string[0].length, 1200 * foot);
    EXPECT_DOUBLE_EQ(string[0].outer_diameter, 5 * inch);
    EXPECT_DOUBLE_EQ(string[0].inner_diameter, 4.276 * inch);
    EXPECT_DOUBLE_EQ(string[0].linear_density, 29.02);
    EXPECT_EQ(string[0].youngs_modulus, 206.8e9);
    EXPECT_EQ(string[1].name, "non-magnetic collar");
    EXPECT_DOUBLE_EQ(string[1].linear_density, 147 * 0.45359237 / foot);
    EXPECT_EQ(string[1].youngs_modulus, 193e9);
    EXPECT_EQ(string[2].name, "PDC bit");
    EXPECT_EQ(string[2].youngs_modulus, 206.8e9);
}

/// The tubular with more in its second component, a collar of 8 in and 30 ft.
std::string with_tools(const std::string& elements) {
    std::string text = text_of("tubular.xml");
    const std::size_t at = text.find("</witsml:tubularComponent>", text.find("<witsml:sequence>2"));
    return text.insert(at, elements);
}

TEST(Witsml, StabilizersBitsAndBendsTouchAndKink) {
    WitsmlFolder folder;
    folder.write(
        "string.xml",
        with_tools("<witsml:stabilizer uid=\"s\"><witsml:lenBlade uom=\"ft\">2</witsml:lenBlade>"
                   "<witsml:odBladeMx uom=\"in\">9.25</witsml:odBladeMx>"
                   "<witsml:distBladeBot uom=\"ft\">3</witsml:distBladeBot>"
                   "</witsml:stabilizer><witsml:bend uid=\"b\">"
                   "<witsml:angle uom=\"dega\">1.5</witsml:angle>"
                   "<witsml:distBendBot uom=\"ft\">6</witsml:distBendBot></witsml:bend>"));
    const std::vector<Component> string = folder.read("case.toml").string.components;
    ASSERT_TRUE(string[1].contact);
    EXPECT_DOUBLE_EQ(string[1].contact->diameter, 9.25 * inch);
    EXPECT_DOUBLE_EQ(string[1].contact->length, 2 * foot);
    EXPECT_NEAR(string[1].contact->position, 26 * foot, 1e-12);
    ASSERT_TRUE(string[1].bend);
    EXPECT_DOUBLE_EQ(string[1].bend->angle, 1.5 * degree);
    EXPECT_NEAR(string[1].bend->position, 24 * foot, 1e-12);
    folder.write("string.xml",
                 with_tools("<witsml:bitRecord uid=\"r\"><witsml:diaBit uom=\"in\">8.5"
                            "</witsml:diaBit></witsml:bitRecord>"));
    EXPECT_DOUBLE_EQ(folder.read("case.toml").string.components[1].contact->diameter, 8.5 * inch);
}

TEST(Witsml, ToolsThatDoNotFitTheirComponentAreRefused) {
    const auto message_of = [](const std::string& elements) {
        WitsmlFolder folder;
        folder.write("string.xml", with_tools(elements));
        const std::string message = folder.message("case.toml");
        return message.substr(message.find(": ") + 2);
    };
    const std::string blades =
        "<stabilizer><lenBlade uom=\"ft\">2</lenBlade><odBladeMx "
        "uom=\"in\">9</odBladeMx></stabilizer>";
    EXPECT_EQ(message_of(replaced(blades, ">9<", ">7<")),
              "odBladeMx is 7 in; expected at least the od of the component");
    EXPECT_EQ(message_of(replaced(blades, "</stabilizer>",
                                  "<distBladeBot uom=\"ft\">30</distBladeBot></stabilizer>")),
              "distBladeBot is 30 ft, beyond the upper end of the component");
    EXPECT_EQ(message_of(replaced(blades, "<odBladeMx uom=\"in\">9</odBladeMx>", "")),
              R"(missing element "odBladeMx" in "stabilizer"; expected it once)");
    EXPECT_EQ(
        message_of(blades + blades),
        R"(the component has 2 elements "stabilizer"; expected one: cut the component between them)");
    EXPECT_EQ(message_of("<bend><angle uom=\"ft\">1</angle></bend>"),
              "angle: ft is a length; expected an angle such as deg, rad");
}

struct Mistake {
    std::string passage;
    std::string replacement;
    std::string message;
};

void expect_messages(const std::string& file, const std::string& text,
                     const std::vector<Mistake>& mistakes) {
    for (const Mistake& mistake : mistakes) {
        SCOPED_TRACE(mistake.replacement);
        WitsmlFolder folder;
        folder.write(file, replaced(text, mistake.passage, mistake.replacement));
        EXPECT_EQ(folder.message("case.toml"), mistake.message);
    }
}

TEST(Witsml, MistakesInATrajectoryAreLocated) {
    expect_messages(
        "survey.XML", text_of("trajectory.xml"),
        {{"</md>", "</dm>",
          "survey.XML:13:23: not valid XML: start-end tags mismatch; expected WITSML 1.4.1.1"},
         {"1.4.1.1\">", "2.0\">",
          R"(survey.XML:3:1: the version is "2.0"; expected WITSML 1.4.1.1)"},
         {" version=\"1.4.1.1\"", "",
          R"(survey.XML:3:1: the version is ""; expected WITSML 1.4.1.1)"},
         {"<trajectory ", "<log/><trajectory ", ""},
         {"</trajectory>", "</trajectory><trajectory uid=\"t-2\"/>",
          R"(survey.XML:35:16: the file has 2 elements "trajectory"; expected one)"},
         {"<md uom=\"ft\">0</md>", "",
          R"(survey.XML:11:5: missing element "md" in "trajectoryStation"; expected it once)"},
         {"<azi uom=\"dega\">45.5", "<azi uom=\"dega\">45</azi><azi uom=\"dega\">45.5",
          R"(survey.XML:23:31: element "azi" is there twice; expected it once)"},
         {"<md uom=\"ft\">2000", "<md>2000",
          "survey.XML:20:7: md has no unit; expected an attribute uom"},
         {"<md uom=\"ft\">2000", "<md uom=\"dega\">2000",
          "survey.XML:20:7: md: unknown unit \"dega\"; did you mean \"deg\"?"},
         {"<md uom=\"ft\">2000", "<md uom=\"ft\">two",
          R"(survey.XML:20:7: md is "two"; expected a finite number)"},
         {"<md uom=\"ft\">2000", "<md uom=\"ft\">1000",
          "survey.XML:28:7: md is 304.8 m after 1000 ft; expected ascending measured depths"},
         {"<incl uom=\"dega\">30", "<incl uom=\"dega\">200",
          "survey.XML:22:7: inclination is 200; expected 0 to 180 degrees"},
         {"<md uom=\"ft\">0</md>", "<md uom=\"ft\">82</md>",
          R"(survey.XML:13:7: the survey starts at md 82 ft; expected a station at 0, or in [well] tie_in = "vertical" (a vertical station at 0 is added) or "start" (the well starts there))"},
         {"<trajectorys", "<!DOCTYPE a [<!ENTITY b \"&c;&c;\"><!ENTITY c \"cc\">]><trajectorys",
          "survey.XML:1:1: the file has a DOCTYPE; expected WITSML, which has none"}});
}

TEST(Witsml, MistakesInATubularAreLocated) {
    expect_messages(
        "string.xml", text_of("tubular.xml"),
        {{"<witsml:sequence>2", "<witsml:sequence>3",
          "string.xml:30:7: sequence 3 is there twice; expected a number for each component"},
         {"<witsml:sequence>2", "<witsml:sequence>two",
          R"(string.xml:21:7: sequence is "two"; expected a whole number, 1 for the bit)"},
         {"<witsml:od uom=\"in\">8</witsml:od>", "",
          R"(string.xml:19:5: missing element "od" in "tubularComponent"; expected it once)"},
         {"<witsml:od uom=\"in\">8", "<witsml:od uom=\"in\">2.5",
          "string.xml:22:7: id is 2.8125 in; expected less than od, 2.5 in"},
         {"<witsml:len uom=\"ft\">30<", "<witsml:len uom=\"ft\">-30<",
          "string.xml:24:7: len is -30 ft; expected 1e-6 to 1e6 m"},
         {"non-magnetic steel", "wood",
          R"(string.xml:26:7: typeMaterial is "wood", whose elasticity is not known; expected one of steel, steel alloy, chrome alloy, non-magnetic steel, aluminum, titanium, beryllium copper, or a table with youngs_modulus)"},
         {"<witsml:od uom=\"in\">9.5", "<witsml:od uom=\"in\">12.5",
          R"(string.xml:15:7: component 3 ("PDC bit") has an outer diameter of 12.5 in; expected at most 0.3111 m, the diameter of the well from 1230 ft to 1231.2 ft)"}});
}

TEST(Witsml, OtherFilesAreRefusedInOneLine) {
    WitsmlFolder folder;
    const auto message_for = [&](const std::string& bytes) {
        folder.write("survey.XML", bytes);
        return folder.message("case.toml");
    };
    EXPECT_EQ(message_for(""),
              "survey.XML:1:1: not valid XML: no document element found; expected WITSML 1.4.1.1");
    EXPECT_EQ(message_for("md,inclination\n0,0\n"),
              "survey.XML:3:1: not valid XML: no document element found; expected WITSML 1.4.1.1");
    EXPECT_EQ(message_for(text_of("tubular.xml")),
              R"(survey.XML:3:1: the root element is "witsml:tubulars"; expected trajectorys of )"
              "WITSML 1.4.1.1");
    EXPECT_EQ(message_for("<trajectorys version=\"1.4.1.1\"/>"),
              R"(survey.XML:1:1: the file has 0 elements "trajectory"; expected one)");
    EXPECT_EQ(message_for("<trajectorys version=\"1.4.1.1\"><trajectory/></trajectorys>"),
              "survey.XML:1:1: the survey has 0 stations; expected at least two");
    EXPECT_EQ(message_for(std::string("\377\376<\000a\000", 6)),
              "survey.XML:1:1: not text; expected XML in UTF-8");
    folder.write("survey.XML", text_of("trajectory.xml"));
    folder.write("string.xml", "<tubulars version=\"1.4.1.1\"><tubular/></tubulars>");
    EXPECT_EQ(folder.message("case.toml"),
              "string.xml:1:29: the tubular has no tubularComponent; expected at least one");
}

TEST(Witsml, DeepAndEntityRiddenFilesCostNoMoreThanOthers) {
    WitsmlFolder folder;
    std::string deep = "<trajectorys version=\"1.4.1.1\">";
    for (int k = 0; k < 1'000'000; ++k)
        deep += "<a>";
    folder.write("survey.XML", deep);
    EXPECT_NE(folder.message("case.toml").find("not valid XML"), std::string::npos);
    // an entity that nothing declares stays as it is written
    folder.write("survey.XML", replaced(text_of("trajectory.xml"), "2000</md>", "&c;</md>"));
    EXPECT_EQ(folder.message("case.toml"),
              R"(survey.XML:20:7: md is "&c;"; expected a finite number)");
}

}  // namespace
}  // namespace drillstrand
