/// The program as a user meets it: each test runs the built drillstrand.
#include "program/program.hpp"

#include <csignal>
#include <optional>

#include "drillstrand/buckling_file.hpp"
#include "drillstrand/isa.hpp"
#include "drillstrand/modes_file.hpp"
#include "drillstrand/version.hpp"

namespace drillstrand {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST_F(Program, ARunWritesItsResultInTheWorkingDirectory) {
    const Ending ending = run({"run", "pipe.toml"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.out, "");
    EXPECT_THAT(ending.err,
                AllOf(HasSubstr("simulated s per s"), HasSubstr("drillstrand info pipe.h5")));
    EXPECT_THAT(files(), ElementsAre("pipe.h5", "pipe.toml"));
    const Result result = read_result(desk() / "pipe.h5");
    EXPECT_EQ(result.footer.status, "complete");
    EXPECT_EQ(result.header.title, "A pipe hangs and swings");
    EXPECT_EQ(result.header.integrator, "dormand-prince");
    EXPECT_EQ(result.header.case_text, pipe_case);
    EXPECT_EQ(result.header.node_s.size(), 9U);
    ASSERT_EQ(result.series.size(), 11U);
    EXPECT_EQ(result.series.back().time, 0.01);
    EXPECT_EQ(result.profiles.size(), 3U);
    EXPECT_GT(result.footer.statistics.steps, 0);
    EXPECT_LT(std::abs(result.footer.energy_residual), 0.01);
}

TEST_F(Program, ARunInAWellSaysHowItTurnsAndWhatTheWallsCarryInItsFileAndInInfo) {
    write("well.csv", "md[m],inclination[deg],azimuth[deg]\n0,30,0\n50,30,0\n");
    write("inclined.toml", std::string(pipe_case) +
                               "[well]\nsurvey = \"well.csv\"\n"
                               "diameter = 0.2\n");
    const Ending ending =
        run({"run", "inclined.toml", "--set", "head.rotation=[[0,0],[0.5,\"2 Hz\"]]", "--set",
             "head.direction=[0.5,0,0.8660254037844386]", "--set", "run.integrator=\"leapfrog\"",
             "--set", "run.duration=3", "--set", "output.interval=0.1", "-o", "out.h5"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    const Result result = read_result(desk() / "out.h5");
    ASSERT_EQ(result.footer.findings.size(), 4U);
    const Ending info = run({"info", "out.h5"});
    for (const std::string& finding : result.footer.findings) {
        EXPECT_THAT(ending.err, HasSubstr("drillstrand: " + finding + "\n"));
        EXPECT_THAT(info.out, HasSubstr(finding.substr(finding.find(": ") + 2) + "\n"));
    }
    EXPECT_THAT(result.footer.findings,
                ElementsAre(StartsWith("stick-slip: in the last 1 s: "),
                            StartsWith("whirl: in the last 1 s: "),
                            StartsWith("walls: in the last 1 s: "), StartsWith("penetration: ")));
}

TEST_F(Program, OptionsOfARunReachTheResult) {
    const Ending ending =
        run({"run", "pipe.toml", "-o", "swing.h5", "--threads", "2", "--isa", "baseline", "--set",
             "run.duration=0.002", "--set", "mesh.segments=4", "--quiet"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(files(), ElementsAre("pipe.toml", "swing.h5"));
    const Result result = read_result(desk() / "swing.h5");
    EXPECT_EQ(result.header.threads, 2);
    EXPECT_EQ(result.header.isa, "baseline");
    EXPECT_EQ(result.header.segment_s.size(), 4U);
    EXPECT_EQ(result.series.back().time, 0.002);
}

TEST_F(Program, ARunUsesTheBestInstructionSetAndSaysSo) {
    ASSERT_EQ(run({"run", "pipe.toml", "--quiet"}).code, 0);
    EXPECT_EQ(read_result(desk() / "pipe.h5").header.isa, isa_name(best_isa()));
    EXPECT_THAT(run({"info", "pipe.h5"}).out,
                HasSubstr("instruction set  " + isa_name(best_isa()) + "\n"));
}

TEST_F(Program, AnInstructionSetThatTheMachineLacksIsRefused) {
    if (best_isa() == Isa::avx512) GTEST_SKIP() << "this machine has them all";
    const Ending ending = run({"run", "pipe.toml", "--isa", "avx512"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, is_one_error("goes up to " + isa_name(best_isa())));
    EXPECT_THAT(files(), ElementsAre("pipe.toml"));
}

TEST_F(Program, CheckPrintsTheSceneAndWritesNothing) {
    const Ending ending = run({"check", "pipe.toml"});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(ending.out, AllOf(HasSubstr("A pipe hangs and swings"),
                                  HasSubstr("24 m (78.74 ft)"), HasSubstr("8 of 3 m"),
                                  HasSubstr("8.056 kN (1.811 klbf)"), HasSubstr("steps")));
    EXPECT_THAT(files(), ElementsAre("pipe.toml"));
}

TEST_F(Program, EveryCommandWarnsOfNumbersThatNobodyMeans) {
    write("heavy.toml", std::string(pipe_case) + "[fluid]\ndensity = 9.8\n");
    const std::string warning =
        "heavy.toml:21:11: fluid.density is 9.8 kg/m3, no drilling fluid; did you mean \"9.8 "
        "ppg\"?";
    for (const char* command : {"check", "buckling", "modes", "equilibrium", "run"}) {
        SCOPED_TRACE(command);
        const Ending ending = run({command, "heavy.toml"});
        EXPECT_EQ(ending.code, 0) << ending.err;
        EXPECT_THAT(ending.err, HasSubstr("drillstrand: warning: " + warning + "\n"));
    }
    EXPECT_THAT(read_result(desk() / "heavy.h5").footer.warnings, testing::Contains(warning));
    const Ending study = run({"torque-drag", DRILLSTRAND_SOURCE_DIR "/cases/torque_drag.toml",
                              "--set", "torque_drag.depths=[500]", "--set", "fluid.density=9.8"});
    EXPECT_EQ(study.code, 0) << study.err;
    EXPECT_THAT(study.err, StartsWith("drillstrand: warning: --set fluid.density: "));
    EXPECT_EQ(run({"equilibrium", "heavy.toml", "-o", "rest.h5"}).code, 0);
    EXPECT_THAT(read_result(desk() / "rest.h5").footer.warnings, testing::Contains(warning));
}

TEST_F(Program, CheckPrintsEveryDamping) {
    EXPECT_THAT(run({"check", "pipe.toml"}).out, Not(HasSubstr("Kelvin-Voigt")));
    const Ending ending = run({"check", "pipe.toml", "--set", "damping.kelvin_voigt=1.25e-3",
                               "--set", "damping.internal=0.5"});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(ending.out, AllOf(HasSubstr("Kelvin-Voigt damping, 0.00125 s times"),
                                  HasSubstr("0.5 N s/m of stretch, 0.5 N m s of bending")));
}

TEST_F(Program, CheckAdvisesAStartAtRestWhereAStringWouldFallInItsWell) {
    const std::string well = DRILLSTRAND_SOURCE_DIR "/cases/well1_paper.toml";
    const std::string advice = "Advice: the string starts on the axis of the well and falls";
    const auto check = [&](const std::string& override) {
        return run({"check", well, "--set", override}).out;
    };
    EXPECT_THAT(check("run.duration=1"),
                AllOf(HasSubstr(advice), HasSubstr("initial.state = \"equilibrium\"")));
    EXPECT_THAT(check("initial.state=\"equilibrium\""), Not(HasSubstr(advice)));
    EXPECT_THAT(check("gravity=0"), Not(HasSubstr(advice)));
    EXPECT_THAT(check("run.integrator=\"dormand-prince\""), Not(HasSubstr(advice)));
    EXPECT_THAT(run({"check", "pipe.toml"}).out, Not(HasSubstr(advice)));
}

// Found by a check of a million segments that took five minutes.
TEST_F(Program, CheckSaysWhereItDoesNotLookForALongEquilibrium) {
    const auto check = [&](const char* segments) {
        return run({"check", DRILLSTRAND_SOURCE_DIR "/cases/well2.toml", "--set",
                    std::string("mesh.segments=") + segments});
    };
    const auto says = HasSubstr("Not checked: whether there is an equilibrium to start from");
    EXPECT_THAT(check("10001").out, AllOf(says, Not(HasSubstr("Advice: the string starts"))));
    EXPECT_THAT(check("322").out, Not(says));
}

TEST_F(Program, CheckTellsTheMeshOfEachComponentAndWhatItCouldNotSee) {
    const std::string field = run({"check", DRILLSTRAND_SOURCE_DIR "/cases/field_units.toml"}).out;
    EXPECT_THAT(field, AllOf(HasSubstr("tool joints of 0.16827 m (6.625 in)"),
                             HasSubstr("touches with 0.2159 m (8.5 in) on 0.152 m"),
                             HasSubstr("bent by 1.15 deg"), HasSubstr("open hole, friction"),
                             HasSubstr("7 in each step from 2139.3 to 2167.1 m along the string"),
                             Not(HasSubstr("between nodes"))));
    EXPECT_THAT(run({"run", DRILLSTRAND_SOURCE_DIR "/cases/field_units.toml", "-o", "field.h5",
                     "--set", "run.duration=0.01", "--set", "output.interval=0.01"})
                    .err,
                HasSubstr("drillstrand: substeps: 7 in each step from 2139.3 to 2167.1 m"));
    EXPECT_THAT(run({"check", DRILLSTRAND_SOURCE_DIR "/cases/field_units.toml", "--set",
                     "run.local_steps=false"})
                    .out,
                Not(HasSubstr("substeps")));
    const std::string even =
        run({"check", DRILLSTRAND_SOURCE_DIR "/cases/field_units.toml", "--set",
             "mesh={segments=400}", "--set", "initial.state='coaxial'"})
            .out;
    EXPECT_THAT(even, AllOf(HasSubstr("lies between nodes and touches nothing"),
                            HasSubstr("lies between nodes: its diameter touches nothing")));
    EXPECT_THAT(run({"check", DRILLSTRAND_SOURCE_DIR "/cases/well2.toml"}).out,
                HasSubstr("Advice: drill pipe weighs 9969 kg/m3"));
}

TEST_F(Program, InfoTellsHowAResultWasMade) {
    ASSERT_EQ(run({"run", "pipe.toml"}).code, 0);
    const Ending ending = run({"info", "pipe.h5"});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(ending.out,
                AllOf(HasSubstr("A pipe hangs and swings"), HasSubstr("complete"),
                      HasSubstr("11, from 0 to 0.01 s"), HasSubstr("/series/head_stress[3]"),
                      HasSubstr("/profiles/contact_force"), HasSubstr(version())));
}

TEST_F(Program, BucklingPrintsLoadsInPairsAndWritesAFileOnlyWhenAsked) {
    const std::vector<std::string> command = {"buckling", "pipe.toml", "--set", "gravity=0"};
    Ending ending = run(command);
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    // The pipe of 24 m: pi^2 EI/(4 L^2) = 8.534 kN, less by its stretch and shear.
    EXPECT_THAT(ending.out, AllOf(HasSubstr("A pipe hangs and swings"), HasSubstr("over Euler's"),
                                  HasSubstr("0.99998"), HasSubstr("d1"), HasSubstr("d2")));
    EXPECT_THAT(files(), ElementsAre("pipe.toml"));

    std::vector<std::string> with_file = command;
    with_file.insert(with_file.end(), {"-o", "modes.h5", "--modes", "3", "--paper"});
    ending = run(with_file);
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(files(), ElementsAre("modes.h5", "pipe.toml"));
    const BucklingResult result = read_buckling(desk() / "modes.h5");
    EXPECT_EQ(result.header.title, "A pipe hangs and swings");
    EXPECT_EQ(result.header.node_s.size(), 9U);
    EXPECT_EQ(result.discretisation, Discretisation::paper);
    EXPECT_FALSE(result.instability);
    ASSERT_EQ(result.modes.size(), 3U);
    EXPECT_EQ(result.modes[0].load, result.modes[1].load);
    EXPECT_GT(result.modes[2].load, 8 * result.modes[1].load);
    EXPECT_THAT(run({"info", "modes.h5"}).out,
                AllOf(HasSubstr("/buckling/mode_strain"), HasSubstr("paper")));
}

TEST_F(Program, BucklingAtALoadFindsTheUnstableShapesOfThePairsBelowIt) {
    const auto at = [&](const std::string& load) {
        return run({"buckling", "pipe.toml", "--set", "gravity=0", "--at-load", load, "-o",
                    "modes.h5", "--overwrite"});
    };
    Ending ending = at("10 kN");
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("under 10000 N: 2 unstable shapes"));
    std::optional<Instability> found = read_buckling(desk() / "modes.h5").instability;
    ASSERT_TRUE(found);
    EXPECT_EQ(found->load, 10e3);
    ASSERT_EQ(found->modes.size(), 2U);
    EXPECT_LT(found->modes[0].eigenvalue, 0);
    EXPECT_THAT(run({"info", "modes.h5"}).out,
                AllOf(HasSubstr("10000 N"), HasSubstr("/buckling/instability/eigenvalue")));

    ending = at("8 kN");
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("under 8000 N: 0 unstable shapes"));
    found = read_buckling(desk() / "modes.h5").instability;
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->modes.empty());
    EXPECT_THAT(run({"info", "modes.h5"}).out, HasSubstr("0 unstable shapes"));
}

TEST_F(Program, ModesPrintsFrequenciesAndWritesThem) {
    Ending ending = run({"modes", "pipe.toml", "--set", "gravity=0", "--number", "4"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    EXPECT_THAT(ending.out, AllOf(HasSubstr("A pipe hangs and swings"), HasSubstr("frequency Hz"),
                                  HasSubstr("lateral"), HasSubstr("pipe_modes.h5")));
    const ModesResult result = read_modes(desk() / "pipe_modes.h5");
    EXPECT_EQ(result.header.title, "A pipe hangs and swings");
    EXPECT_EQ(result.grip, WallGrip::sticks);
    ASSERT_EQ(result.modes.size(), 4U);
    EXPECT_EQ(result.modes[0].displacement.size(), result.header.node_s.size());
    EXPECT_TRUE(result.campbell.empty());
    EXPECT_THAT(run({"info", "pipe_modes.h5"}).out,
                AllOf(HasSubstr("/modes/shape"), HasSubstr("mode 4")));

    ending = run({"modes", "pipe.toml", "--set", "gravity=0", "--campbell", "0:120:60", "--orders",
                  "1,3", "--bit-force", "10 kN", "--bit-order", "3", "-o", "range.h5"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(ending.out, AllOf(HasSubstr("critical speed"), HasSubstr("displacement mm")));
    const ModesResult range = read_modes(desk() / "range.h5");
    EXPECT_EQ(range.campbell.size(), 30U);
    EXPECT_EQ(range.response.size(), 3U);
    EXPECT_EQ(range.grip, WallGrip::slides);
    ASSERT_TRUE(range.excitation);
    EXPECT_EQ(range.excitation->order, 3);
    EXPECT_EQ(range.excitation->bit_force, 10e3);
}

TEST_F(Program, ModesThatCannotBeAreRefusedInOneLine) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
        {{"--number", "25"}, "--number 25: a string of 8 segments can tell 24 modes"},
        {{"--number", "0"}, "--number"},
        {{"--rpm", "-1"}, "--rpm"},
        {{"--campbell", "120"}, "--campbell 120: "},
        {{"--campbell", "120:60"}, "FROM:TO"},
        {{"--campbell", "0:60:0"}, "FROM:TO"},
        {{"--campbell", "0:60:1e-6"}, "take a longer step"},
        {{"--orders", "0"}, "--orders"},
        {{"--bit-force", "10 m", "--rpm", "60"}, "--bit-force 10 m: "},
        {{"--bit-force", "10 kN"}, "give --rpm"},
        {{"--bit-force", "10 kN", "--unbalance", "--rpm", "60"}, "ask for one of them"},
        {{"--unbalance", "--rpm", "60"}, "eccentric_mass"},
        {{"-o", "pipe.toml"}, "that is the case file"},
        {{"--set", "head.motion=free"}, "head.motion"}};
    for (const auto& [options, words] : mistakes) {
        std::vector<std::string> command = {"modes", "pipe.toml"};
        command.insert(command.end(), options.begin(), options.end());
        const Ending ending = run(command);
        EXPECT_EQ(ending.code, 2) << words;
        EXPECT_THAT(ending.err, is_one_error(words));
        EXPECT_EQ(ending.out, "");
        EXPECT_THAT(files(), ElementsAre("pipe.toml"));
    }
}

TEST_F(Program, BucklingSaysWhatItLeavesOut) {
    // The pipe lies level, and without a well the load at its bit follows the bit.
    const Ending ending = run({"buckling", "pipe.toml", "--set", "bit.weight=1000"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(ending.err, AllOf(HasSubstr("not vertical"), HasSubstr("flutters")));
}

TEST_F(Program, BucklingThatCannotBeIsRefusedInOneLine) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
        {{"--modes", "17"}, "at most 16"},
        {{"--modes", "0"}, "--modes"},
        {{"--at-load", "10"}, "--at-load 10: "},
        {{"--at-load", "10 m"}, "--at-load 10 m: "},
        {{"--at-load", "1 GN"}, "more segments"},
        {{"-o", "-"}, "-o -: "},
        {{"-o", "pipe.toml"}, "that is the case file"},
        {{"-o", "."}, "Is a directory"},
        {{"-o", "no/modes.h5"}, "No such file or directory"},
        {{"--set", "head.motion=free"}, "pipe.toml: head.motion"},
        {{"--set", "string.component.0.curvature=[0,0.01,0]"}, "curvature"}};
    for (const auto& [options, words] : mistakes) {
        std::vector<std::string> command = {"buckling", "pipe.toml"};
        command.insert(command.end(), options.begin(), options.end());
        const Ending ending = run(command);
        EXPECT_EQ(ending.code, 2) << words;
        EXPECT_THAT(ending.err, is_one_error(words));
        EXPECT_EQ(ending.out, "");
        EXPECT_THAT(files(), ElementsAre("pipe.toml"));
    }
}

TEST_F(Program, AWrongKeyIsOneLineWithItsPlaceAndNothingIsWritten) {
    write("wrong.toml", std::string(pipe_case) + "intervall = 1\n");
    for (const char* command : {"run", "check"}) {
        const Ending ending = run({command, "wrong.toml"});
        EXPECT_EQ(ending.code, 2);
        EXPECT_THAT(ending.err, is_one_error("wrong.toml:20:1:"));
        EXPECT_THAT(ending.err, HasSubstr("interval"));
        EXPECT_THAT(files(), ElementsAre("pipe.toml", "wrong.toml"));
    }
}

TEST_F(Program, AMissingCaseIsOneLine) {
    const Ending ending = run({"run", "no.toml"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, is_one_error("no.toml"));
    EXPECT_THAT(files(), ElementsAre("pipe.toml"));
}

TEST_F(Program, OutputThatCannotBeIsRefused) {
    Ending ending = run({"run", "pipe.toml", "-o", "-"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, is_one_error("-o -: "));

    ending = run({"run", "pipe.toml", "-o", "../desk/pipe.toml"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, is_one_error("that is the case file"));

    ending = run({"run", "pipe.toml", "-o", "."});
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, is_one_error("Is a directory"));

    EXPECT_THAT(files(), ElementsAre("pipe.toml"));
    EXPECT_EQ(text_of(desk() / "pipe.toml"), pipe_case);
}

TEST_F(Program, AnErrorInTheCaseLeavesAnOlderResultAlone) {
    ASSERT_EQ(run({"run", "pipe.toml"}).code, 0);
    const std::string older = text_of(desk() / "pipe.h5");
    EXPECT_EQ(run({"run", "pipe.toml", "--set", "mesh.segments=-3"}).code, 2);
    EXPECT_EQ(text_of(desk() / "pipe.h5"), older);
}

TEST_F(Program, EquilibriumPrintsWhatHoldsTheStringAndWritesAFileOnlyWhenAsked) {
    Ending ending = run({"equilibrium", "pipe.toml"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    EXPECT_THAT(ending.out,
                AllOf(HasSubstr("A pipe hangs and swings"), HasSubstr("at rest"),
                      HasSubstr("hook load"), HasSubstr("bit position"), HasSubstr("iterations")));
    EXPECT_THAT(files(), ElementsAre("pipe.toml"));

    ending = run({"equilibrium", "pipe.toml", "-o", "rest.h5"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    EXPECT_THAT(files(), ElementsAre("pipe.toml", "rest.h5"));
    const Result result = read_result(desk() / "rest.h5");
    EXPECT_EQ(result.footer.status, "complete");
    ASSERT_EQ(result.series.size(), 1U);
    ASSERT_EQ(result.profiles.size(), 1U);
    EXPECT_EQ(result.series[0].energy.kinetic, 0);
    EXPECT_EQ(result.profiles[0].position.back(), result.series[0].bit_position);
    EXPECT_EQ(result.header.integrator, "equilibrium");
    EXPECT_EQ(result.header.outer_radius.size(), result.header.node_s.size())
        << "the string is not in the file";
}

TEST_F(Program, EquilibriumThatCannotBeIsOneLine) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
        {{"-o", "-"}, "-o -: "},
        {{"-o", "pipe.toml"}, "that is the case file"},
        {{"--set", "equilibrium.motion=flying"}, "equilibrium.motion"},
        {{"--set", "head.motion=free"}, "pipe.toml: head.motion"}};
    for (const auto& [options, words] : mistakes) {
        std::vector<std::string> command = {"equilibrium", "pipe.toml"};
        command.insert(command.end(), options.begin(), options.end());
        const Ending ending = run(command);
        EXPECT_EQ(ending.code, 2) << words;
        EXPECT_THAT(ending.err, is_one_error(words));
        EXPECT_EQ(ending.out, "");
    }
    // a helix under a thrust that follows the bit snakes for ever
    const Ending snake =
        run({"equilibrium", std::string(DRILLSTRAND_SOURCE_DIR) + "/cases/vertical_50kN.toml"});
    EXPECT_EQ(snake.code, 1);
    EXPECT_THAT(snake.err, is_one_error("no equilibrium found"));
    EXPECT_THAT(files(), ElementsAre("pipe.toml"));
}

TEST_F(Program, WhatIsNotAvailableYetIsRefusedInOneLine) {
    const std::vector<std::vector<std::string>> later = {{"study", "study.toml"}};
    for (const auto& arguments : later) {
        const Ending ending = run(arguments);
        EXPECT_EQ(ending.code, 2) << arguments.front();
        EXPECT_THAT(ending.err, is_one_error("not available in this version"));
    }
    const std::string help = run({"--help"}).out;
    EXPECT_THAT(help, Not(HasSubstr("study")));
}

TEST_F(Program, AMistypedCommandLineIsOneLine) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
        {{}, "--help"},
        {{"rum", "pipe.toml"}, "unknown command 'rum'"},
        {{"--verbose"}, "--verbose"},
        {{"run"}, "CASE.toml"},
        {{"run", "pipe.toml", "--fast"}, "--fast"},
        {{"run", "pipe.toml", "--threads", "many"}, "many"},
        {{"run", "pipe.toml", "--threads", "-2"}, "-2"},
        {{"run", "pipe.toml", "--isa", "sse9"}, "sse9"},
        {{"run", "pipe.toml", "--set", "run.duration"}, "key.path=value"},
        {{"info"}, "OUT.h5"}};
    for (const auto& [arguments, words] : mistakes) {
        const Ending ending = run(arguments);
        EXPECT_EQ(ending.code, 2) << words;
        EXPECT_THAT(ending.err, is_one_error(words));
        EXPECT_EQ(ending.out, "");
    }
    EXPECT_THAT(files(), ElementsAre("pipe.toml"));
}

TEST_F(Program, HelpAndVersionAreEverywhere) {
    const std::vector<std::vector<std::string>> commands = {{},           {"run"},   {"check"},
                                                            {"buckling"}, {"modes"}, {"info"}};
    for (std::vector<std::string> arguments : commands) {
        arguments.emplace_back("--version");
        Ending ending = run(arguments);
        EXPECT_EQ(ending.code, 0);
        EXPECT_EQ(ending.out, "drillstrand " + version() + " (" + commit() + ")\n");
        arguments.back() = "--help";
        ending = run(arguments);
        EXPECT_EQ(ending.code, 0);
        EXPECT_THAT(ending.out, HasSubstr("Usage: drillstrand"));
        EXPECT_THAT(ending.err, IsEmpty());
    }
}

TEST_F(Program, InfoOnSomethingElseIsOneLine) {
    Ending ending = run({"info", "pipe.toml"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, is_one_error("not a result file"));
    ending = run({"info", "no.h5"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, is_one_error("No such file"));
}

TEST_F(Program, AnErrorShowsControlCharactersAndDoesNotSendThem) {
    const std::string name = "\x1b]0;owned\x07";
    write(name + ".h5", "no result");
    const std::vector<std::vector<std::string>> commands = {
        {"info", name + ".h5"}, {"info", name + ".none"}, {"report", name + ".none"}, {name}};
    for (const std::vector<std::string>& command : commands) {
        const Ending ending = run(command);
        EXPECT_EQ(ending.code, 2) << command.front();
        EXPECT_THAT(ending.err, is_one_error("\\x1b]0;owned\\x07"));
        EXPECT_THAT(ending.err, AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\x07"))));
    }
}

class Interrupted : public Program, public testing::WithParamInterface<int> {};

TEST_P(Interrupted, ARunEndsInOrder) {
    const pid_t child = start_long_run();
    ASSERT_EQ(::kill(child, GetParam()), 0);
    const Ending ending = ending_of(child);
    EXPECT_EQ(ending.code, 130);
    const Result result = read_result(desk() / "pipe.h5");
    EXPECT_EQ(result.footer.status, "interrupted");
    EXPECT_GT(result.footer.statistics.steps, 0);
    ASSERT_GT(result.series.size(), 1U);
    EXPECT_THAT(ending.err, HasSubstr(reached_text(result)));
}

TEST_P(Interrupted, ASignalThatComesTwiceAtOnceIsOneWish) {
    const pid_t child = start_long_run();
    ASSERT_EQ(::kill(child, GetParam()), 0);
    ::kill(child, GetParam());  // as timeout(1) does: to the program, then to its group
    EXPECT_EQ(ending_of(child).code, 130);
    EXPECT_EQ(read_result(desk() / "pipe.h5").footer.status, "interrupted");
}

INSTANTIATE_TEST_SUITE_P(BySignal, Interrupted, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST_F(Program, AKilledRunLeavesAReadableFile) {
    const pid_t child = start_long_run();
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    EXPECT_EQ(ending_of(child).code, -SIGKILL);
    const Result result = read_result(desk() / "pipe.h5");
    EXPECT_EQ(result.footer.status, "running");
    EXPECT_GT(result.series.size(), 1U);
    EXPECT_GT(result.footer.statistics.steps, 0);
    EXPECT_THAT(run({"info", "pipe.h5"}).out, HasSubstr("running, or killed before its end"));
}

TEST_F(Program, AFullDiskEndsARunWithWhatFitted) {
    largest_file = 6 << 20;
    const Ending ending = run({"run", "pipe.toml", "--quiet", "--set", "run.duration=100", "--set",
                               "output.interval=1e-6"});
    EXPECT_EQ(ending.code, 1);
    EXPECT_THAT(ending.err, is_one_error("pipe.h5: cannot write: File too large; results up to"));
    const Result result = read_result(desk() / "pipe.h5");
    EXPECT_THAT(result.footer.status, StartsWith("failed: pipe.h5: cannot write"));
    ASSERT_GT(result.series.size(), 1U);
    EXPECT_THAT(ending.err, HasSubstr(reached_text(result)));
}

}  // namespace
}  // namespace drillstrand
