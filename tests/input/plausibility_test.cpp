/// Numbers that no engineer means are warned of, in the user's words; what is drilled with is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

void without_folder(std::string& text, const TrialFolder& folder) {
    const std::string path = folder.path("").string();
    if (text.starts_with(path)) text.erase(0, path.size());
}

/// The trial case after some changes, each of a passage into another: its warnings, without the
/// folder.
std::vector<std::string> warnings_after(
    const std::vector<std::pair<std::string, std::string>>& changes,
    const Overrides& overrides = {}) {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    std::string text = trial_case;
    for (const auto& [passage, replacement] : changes)
        text = replaced(text, passage, replacement);
    folder.write("case.toml", text);
    std::vector<std::string> warnings = folder.read("case.toml", overrides).warnings;
    for (std::string& warning : warnings)
        without_folder(warning, folder);
    return warnings;
}

/// Of a string in a table, in the trial well.
std::vector<std::string> warnings_of_table(const std::string& table) {
    TrialFolder folder;
    folder.write("survey.csv", "md,inclination,azimuth\n0,0,0\n5000,0,0\n");
    folder.write("bha.csv", table);
    folder.write("case.toml",
                 replaced(with_component_file(trial_case, "bha.csv"), "0.3111", "0.5"));
    std::vector<std::string> warnings = folder.read("case.toml").warnings;
    for (std::string& warning : warnings)
        without_folder(warning, folder);
    return warnings;
}

struct Slip {
    std::string passage;
    std::string replacement;
    std::string warning;
};

TEST(Plausibility, ASlipIsNamedAtItsPlaceInTheWordsOfTheUser) {
    const std::vector<Slip> slips{
        {"density = 1917", "density = 9.8",
         R"(case.toml:8:11: fluid.density is 9.8 kg/m3, no drilling fluid; did you mean "9.8 ppg"?)"},
        {"density = 1917", "density = 1.2",
         R"(case.toml:8:11: fluid.density is 1.2 kg/m3, no drilling fluid; did you mean "1.2 sg"?)"},
        {"density = 1917", "density = 75",
         R"(case.toml:8:11: fluid.density is 75 kg/m3, no drilling fluid; did you mean "75 lb/ft3"?)"},
        {"density = 1917", "density = \"9.8 sg\"",
         R"(case.toml:8:11: fluid.density is 9.8 sg, no drilling fluid; did you mean "9.8 ppg"?)"},
        {"density = 1917", "density = \"1917 ppg\"",
         R"(case.toml:8:11: fluid.density is 1917 ppg, no drilling fluid; did you mean "1917 kg/m3"?)"},
        {"density = 1917", "density = 3300",
         "case.toml:8:11: fluid.density is 3300 kg/m3, no drilling fluid"},
        {"viscosity = 1e-3", "viscosity = 20",
         R"(case.toml:9:13: fluid.viscosity is 20 Pa s, thicker than any drilling fluid; did you mean "20 cP"?)"},
        {"viscosity = 1e-3", "consistency = 0.5\nyield_stress = \"6 psi\"",
         R"(case.toml:10:16: fluid.yield_stress is 6 psi, stiffer than any drilling fluid; did you mean "6 lbf/100ft2"?)"},
        {"viscosity = 1e-3", "viscosity = 1e-3\nflow_rate = 475",
         R"(case.toml:10:13: fluid.flow_rate is 475 m3/s, more than any pump gives; did you mean "475 gpm"?)"},
        {"\"110 rpm\"", "110",
         R"(case.toml:31:25: head.rotation is 110 rad/s, faster than any top drive; did you mean "110 rpm"?)"},
        {"\"110 rpm\"", "\"-110 Hz\"",
         R"(case.toml:31:25: head.rotation is -110 Hz, faster than any top drive; did you mean "-110 rpm"?)"},
        {"[run]", "[equilibrium]\nmotion = \"rotating\"\nrotation = 60\n[run]",
         R"(case.toml:39:12: equilibrium.rotation is 60 rad/s, faster than any top drive; did you mean "60 rpm"?)"},
        {"\"65 kN\"", "65",
         R"(case.toml:34:24: bit.weight is 65 N, too little to drill with; did you mean "65 kN"?)"},
        {"\"65 kN\"", "\"650 klbf\"",
         R"(case.toml:34:24: bit.weight is 650 klbf, more than any bit bears)"},
        {"\"65 kN\"", "\"30000 kN\"",
         "case.toml:34:24: bit.weight is 30000 kN, more than any bit bears"},
        {"[run]", "[contact]\nstatic_friction = [0.3, 30]\ndynamic_friction = 0.25\n[run]",
         "case.toml:38:25: contact.static_friction is 30, more than the weight that it brakes; did "
         "you mean 0.3, 30 %?"},
        {"[run]", "[torque_drag]\nfriction = 25\n[run]",
         "case.toml:38:12: torque_drag.friction is 25, more than the weight that it brakes; did "
         "you "
         "mean 0.25, 25 %?"},
        {"\"19.5 lb/ft\"", "19.5",
         R"(case.toml:17:18: string.component.0.linear_density is 19.5 kg/m, 5730 kg/m3 over its section, where steel has 7850 kg/m3; did you mean "19.5 lb/ft"?)"},
        {"\"19.5 lb/ft\"", "\"29.02 lb/ft\"",
         R"(case.toml:17:18: string.component.0.linear_density is 29.02 lb/ft, 1.269e+04 kg/m3 over its section, where steel has 7850 kg/m3; did you mean "29.02 kg/m"?)"},
        {"density = 7850", "density = 7.85",
         R"(case.toml:24:11: string.component.1.density is 7.85 kg/m3, steel has 7850 kg/m3; did you mean "7.85 g/cm3"?)"},
        {"density = 7850", "density = 65.5",
         R"(case.toml:24:11: string.component.1.density is 65.5 kg/m3, steel has 7850 kg/m3; did you mean "65.5 ppg"?)"},
    };
    for (const Slip& slip : slips) {
        SCOPED_TRACE(slip.replacement);
        EXPECT_THAT(warnings_after({{slip.passage, slip.replacement}}), ElementsAre(slip.warning));
    }
}

TEST(Plausibility, AnElasticityInAWrongUnitIsNamed) {
    const auto pipe = [](const std::string& modulus) {
        return warnings_of_table(
            "name,length,outer_diameter[in],inner_diameter[in],linear_density[lb/ft],"
            "youngs_modulus" +
            modulus + "\n");
    };
    EXPECT_THAT(pipe("\npipe,900,5,4.276,19.5,30e6"),
                ElementsAre(R"(bha.csv:2:23: youngs_modulus is 30e6 Pa, no metal's elasticity; )"
                            R"(did you mean "30e6 psi"?)"));
    EXPECT_THAT(pipe("\npipe,900,5,4.276,19.5,206000"),
                ElementsAre(R"(bha.csv:2:23: youngs_modulus is 206000 Pa, no metal's elasticity; )"
                            R"(did you mean "206000 MPa"?)"));
    EXPECT_THAT(pipe("[psi]\npipe,900,5,4.276,19.5,206"),
                ElementsAre(R"(bha.csv:2:23: youngs_modulus is 206 psi, no metal's elasticity; )"
                            R"(did you mean "206 GPa"?)"));
    EXPECT_THAT(pipe("[GPa]\npipe,900,5,4.276,19.5,206"), IsEmpty());
    EXPECT_THAT(pipe("[Mpsi]\npipe,900,5,4.276,19.5,30"), IsEmpty());
}

TEST(Plausibility, OverridesAreNamedAsSuch) {
    EXPECT_THAT(warnings_after({}, {{"fluid.density", "10"}}),
                ElementsAre("--set fluid.density: fluid.density is 10 kg/m3, no drilling fluid; "
                            "did you mean \"10 ppg\"?"));
}

TEST(Plausibility, AStringListedFromTheBitIsNamed) {
    EXPECT_THAT(warnings_of_table("name,length,outer_diameter[in],inner_diameter[in],"
                                  "linear_density[lb/ft],youngs_modulus[GPa]\n"
                                  "bit,0.3,8.5,2.25,150,206\n"
                                  "collar,90,6.5,2.8125,91,206\n"
                                  "heavy-weight pipe,200,5,3,49.7,206\n"
                                  "drill pipe,2500,5,4.276,21.4,206\n"),
                ElementsAre("bha.csv:2:9: the string starts with 2.926 times the weight per length "
                            "of its last component, its longest; components are listed from head "
                            "to bit: is this list from bit to head?"));
}

TEST(Plausibility, AWellMuchLongerThanItsStringIsNamed) {
    EXPECT_THAT(warnings_after({{"length = 400", "length = 40"}, {"length = 100", "length = 10"}}),
                ElementsAre("case.toml:11:1: the string is 50 m long in a well of 520 m; is its "
                            "pipe missing, or a unit of lengths or of the survey?"));
    EXPECT_THAT(warnings_after({{"length = 400", "length = 40"},
                                {"length = 100", "length = 10"},
                                {"[run]", "[torque_drag]\n[run]"}}),
                IsEmpty());
    EXPECT_THAT(warnings_after({{"length = 400", "length = 40"},
                                {"length = 100", "length = 10"},
                                {"[head]", "[head]\nposition = [0, 0, 400]"}}),
                IsEmpty());
}

TEST(Plausibility, WhatIsDrilledWithIsLeftInPeace) {
    EXPECT_THAT(warnings_after({}), IsEmpty());
    EXPECT_THAT(warnings_after({{"density = 1917", "density = \"0.9 sg\""},
                                {"viscosity = 1e-3", "viscosity = 1"},
                                {"\"110 rpm\"", "\"400 rpm\""},
                                {"\"65 kN\"", "\"500 kN\""},
                                {"[run]", "[contact]\nstatic_friction = 1\n[run]"}}),
                IsEmpty());
    // a string that is pushed and does not turn
    EXPECT_THAT(warnings_after({{"\"110 rpm\"", "0"}, {"\"65 kN\"", "\"1 MN\""}}), IsEmpty());
}

/// Strings of github.com/Open-Source-Drilling-Community/Dixit-Drillstring-Model-2023
/// (Test_Case_1_D, commit f64a43ce) and of github.com/Sky370/Static-Torque-and-Drag (NewData.xlsx,
/// sheet BHA, commit 034ecd72), weights over lengths.
TEST(Plausibility, PublishedStringsAreLeftInPeace) {
    const std::string header =
        "name,length,outer_diameter[in],inner_diameter[in],linear_density[lb/ft],"
        "youngs_modulus[GPa]\n";
    EXPECT_THAT(warnings_of_table(header + "drill pipe,1900,5.875,5.045,30.766,210\n"
                                           "hwdp,18.3,4.5,2.5,37.415,210\n"
                                           "collar,82.3,6,2,85.517,210\n"
                                           "bit,0.762,6,2,85.521,210\n"),
                IsEmpty());
    const std::string other =
        "drill pipe,1880,5.5,4.78,25.930,206.8\n"
        "sub,1.17,7.27,2.75,121.229,206.8\n"
        "drill collar,1.3,6.75,3.25,93.681,206.8\n"
        "float sub,1.256,6.75,2.75,101.711,206.8\n"
        "drill collar,8.885,6.75,3.25,93.680,206.8\n"
        "bit,0.305,7.95,2.83,100.64,206.8\n";
    EXPECT_THAT(warnings_of_table(header + other), IsEmpty());
    // the motor's listed diameter does not go with its listed weight
    EXPECT_THAT(warnings_of_table(header + other + "motor,10.76,4,3.25,91.0,206.8\n"),
                ElementsAre("bha.csv:8:20: linear_density is 91.0 lb/ft, 4.915e+04 kg/m3 over its "
                            "section, where steel has 7850 kg/m3"));
}

/// Pipe of the catalogues, by nominal size and weight with tool joints (API RP 7G, tables 1 and 8).
TEST(Plausibility, PipeOfTheCataloguesIsLeftInPeace) {
    EXPECT_THAT(
        warnings_of_table("name,length,outer_diameter[in],inner_diameter[in],linear_density[lb/ft],"
                          "youngs_modulus[GPa]\n"
                          "2 3/8 in 6.65 lb/ft,100,2.375,1.815,7.11,206.8\n"
                          "3 1/2 in 13.3 lb/ft,100,3.5,2.764,14.6,206.8\n"
                          "4 in 14 lb/ft,100,4,3.34,15.9,206.8\n"
                          "4 1/2 in 16.6 lb/ft,100,4.5,3.826,18.8,206.8\n"
                          "5 in 25.6 lb/ft,100,5,4,29.2,206.8\n"
                          "5 1/2 in 21.9 lb/ft,100,5.5,4.778,24.8,206.8\n"
                          "6 5/8 in 25.2 lb/ft,100,6.625,5.965,28.7,206.8\n"
                          "aluminium,100,5.787,4.921,14.2,71\n"
                          "titanium,100,5.5,4.778,15.4,114\n"),
        IsEmpty());
}

class ShippedCases : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedCases, AreLeftInPeace) {
    EXPECT_THAT(read_case(GetParam()).warnings, IsEmpty());
}

std::vector<std::filesystem::path> shipped_cases() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(DRILLSTRAND_SOURCE_DIR "/cases"))
        if (entry.path().extension() == ".toml") paths.push_back(entry.path());
    return paths;
}

INSTANTIATE_TEST_SUITE_P(Plausibility, ShippedCases, testing::ValuesIn(shipped_cases()),
                         [](const auto& of) { return of.param.stem().string(); });

}  // namespace
}  // namespace drillstrand
