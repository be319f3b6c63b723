/// drillstrand torque-drag as a user meets it.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "drillstrand/torque_drag_file.hpp"

namespace drillstrand {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* survey = "md,inclination,azimuth\n0,0,0\n300,0,0\n600,40,0\n1000,40,0\n";

constexpr const char* small_case = R"(title = "Small"
[well]
survey = "survey.csv"
[[well.section]]
to = 300
diameter = 0.3
[[well.section]]
to = 1000
diameter = 0.22
[[string.component]]
name = "pipe"
length = 800
outer_diameter = 0.14
inner_diameter = 0.12
linear_density = 31.8557
youngs_modulus = "200 GPa"
[mesh]
element_length = 20
[bit]
weight = "20 kN"
[contact]
static_friction = 0.2
[torque_drag]
depths = [500, 700, 900]
[run]
duration = 1
)";

struct Ending {
    int code = -1;
    std::string text;  ///< of both streams
};

class TorqueDragProgram : public testing::Test {
  protected:
    TorqueDragProgram() {
        std::string name = (fs::temp_directory_path() / "drillstrand-test-XXXXXX").string();
        if (mkdtemp(name.data()) != nullptr) folder_ = name;
        std::ofstream(path("survey.csv")) << survey;
        std::ofstream(path("case.toml")) << small_case;
    }
    ~TorqueDragProgram() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }

    /// Runs drillstrand torque-drag with these arguments in the folder.
    [[nodiscard]] Ending run(const std::string& arguments) const {
        return call("torque-drag " + arguments);
    }

    [[nodiscard]] Ending call(const std::string& arguments) const {
        const std::string command =
            "cd " + folder_.string() + " && " + DRILLSTRAND_PROGRAM + " " + arguments + " 2>&1";
        FILE* stream = ::popen(command.c_str(), "r");
        Ending ending;
        for (int c = std::fgetc(stream); c != EOF; c = std::fgetc(stream))
            ending.text += static_cast<char>(c);
        ending.code = WEXITSTATUS(::pclose(stream));
        return ending;
    }

    /// The case with one line instead of its depths.
    void write_with(const std::string& torque_drag) const {
        std::string text = small_case;
        const std::string usual = "depths = [500, 700, 900]";
        std::ofstream(path("other.toml"))
            << text.replace(text.find(usual), usual.size(), torque_drag);
    }

  private:
    fs::path folder_;
};

TEST_F(TorqueDragProgram, PrintsTablesAndWritesFiles) {
    const Ending ending = run("case.toml -o out.h5 --csv out.csv --profile-csv profile.csv");
    EXPECT_EQ(ending.code, 0);
    EXPECT_THAT(ending.text,
                AllOf(HasSubstr("hook load (kN)"), HasSubstr("surface torque (kN m)"),
                      HasSubstr("bit depth (m)"), HasSubstr("tripping out"), HasSubstr("drilling"),
                      HasSubstr("\n         500.00  "), HasSubstr("\n         900.00  "),
                      HasSubstr("with the bit at 900.00 m")));
    const TorqueDragResult result = read_torque_drag(path("out.h5"));
    EXPECT_THAT(result.study.bit_depth, testing::ElementsAre(500, 700, 900));
    EXPECT_EQ(result.study.curves.size(), 4U);
    EXPECT_EQ(result.study.measured_depth.size(), 45U);
    EXPECT_TRUE(fs::exists(path("out.csv")));
    EXPECT_TRUE(fs::exists(path("profile.csv")));
    const Ending info = call("info out.h5");
    EXPECT_EQ(info.code, 0);
    EXPECT_THAT(info.text, AllOf(HasSubstr("torque and drag against the depth of the bit"),
                                 HasSubstr("3, from 500 to 900 m")));
}

TEST_F(TorqueDragProgram, DepthWithoutEquilibriumIsADashAndAWarning) {
    // turned while it is wound up in a vertical hole
    const Ending ending =
        run("case.toml --csv out.csv --set bit.weight='\"60 kN\"' --set mesh.element_length=10 "
            "--set 'torque_drag.depths=[250, 900]' "
            "--set 'torque_drag.motions=[\"rotating\", \"drilling\"]'");
    EXPECT_EQ(ending.code, 0);
    EXPECT_THAT(ending.text,
                HasSubstr("drillstrand: warning: drilling: no equilibrium of the stiff "
                          "string at 1 of 2 depths"));
    EXPECT_THAT(ending.text, testing::ContainsRegex("\n +250\\.00 .* - "));
    EXPECT_THAT(ending.text, testing::Not(HasSubstr("nan")));
}

/// What drillstrand equilibrium prints behind a name, if it is a number.
double printed(const std::string& text, const std::string& name) {
    const std::size_t place = text.find("\n  " + name + ' ');
    return place == std::string::npos ? std::nan("") : std::stod(text.substr(place + 15));
}

TEST_F(TorqueDragProgram, WordsForMotionsMeanTheSameAsInEquilibriumOnAndOffBottom) {
    ASSERT_EQ(run("case.toml -o out.h5 --set 'torque_drag.depths=[800]' --set bit.torque=2000 "
                  "--set 'torque_drag.motions=[\"rotating\", \"drilling\", \"sliding\", "
                  "\"tripping_in\", \"tripping_out\"]'")
                  .code,
              0);
    for (const TorqueDragCurve& curve : read_torque_drag(path("out.h5")).study.curves) {
        const std::string word = motion_name(curve.motion);
        const Ending found = call(
            "equilibrium case.toml --set bit.torque=2000 --set "
            "equilibrium.motion='\"" +
            word + "\"'");
        EXPECT_NEAR(printed(found.text, "hook load"), curve.hook_load.at(0) / 1e3, 1e-5) << word;
        EXPECT_NEAR(printed(found.text, "head torque"), curve.surface_torque.at(0) / 1e3, 1e-5)
            << word;
        const bool loaded =
            curve.motion == TorqueDragMotion::drilling || curve.motion == TorqueDragMotion::sliding;
        EXPECT_THAT(found.text, HasSubstr(loaded ? ", on bottom, 20 kN" : ", off bottom")) << word;
        EXPECT_THAT(found.text, HasSubstr(loaded ? "" : "(0, 0, 0) kN, (0, 0, 0) kN m")) << word;
    }
}

TEST_F(TorqueDragProgram, EquilibriumAtRestSaysWhetherTheBitIsOnBottom) {
    EXPECT_THAT(call("equilibrium case.toml").text,
                HasSubstr("at rest, without friction, on bottom, 20 kN\n"));
    EXPECT_THAT(call("equilibrium case.toml --set bit.weight=0").text,
                HasSubstr("at rest, without friction, off bottom\n"));
    EXPECT_THAT(run("case.toml").text,
                AllOf(HasSubstr("rotating off bottom"),
                      HasSubstr("on bottom, 20 kN, where it drills or slides; else off bottom")));
}

TEST_F(TorqueDragProgram, TakesOverrides) {
    const Ending ending =
        run("case.toml -o out.h5 --set torque_drag.friction=0 --set 'torque_drag.depths={from = "
            "500, to = 600, step = 40}' --set 'torque_drag.motions=[\"sliding\"]'");
    EXPECT_EQ(ending.code, 0);
    const TorqueDragResult result = read_torque_drag(path("out.h5"));
    EXPECT_THAT(result.study.bit_depth, testing::ElementsAre(500, 540, 580, 600));
    ASSERT_EQ(result.study.curves.size(), 1U);
    EXPECT_EQ(result.study.curves[0].motion, TorqueDragMotion::sliding);
}

/// What a line of [torque_drag] is answered with: one line with its place, and exit code 2.
struct Refusal {
    const char* line;
    const char* message;
};

TEST_F(TorqueDragProgram, WrongInputIsOneLineWithItsPlace) {
    const Refusal refusals[] = {
        {"depths = [500, 1200]",
         "other.toml:24:16: torque_drag.depths.1 is 1200 m; expected more than 0 m, where the well "
         "starts, and at most 1000 m, where its survey ends"},
        {"depths = [500, 400]",
         "other.toml:24:16: torque_drag.depths.1 is 400 m; expected more than 500 m, the depth "
         "before it"},
        {"depths = [0]", "other.toml:24:11: torque_drag.depths.0 is 0 m; expected more than 0 m"},
        {"depths = []", "other.toml:24:10: torque_drag.depths is empty; expected a list"},
        {"depths = 500", "other.toml:24:10: torque_drag.depths is 500; expected a list"},
        {"depths = [\"5 kN\"]", "other.toml:24:11: torque_drag.depths.0"},
        {"depths = { from = 500, to = 400, step = 10 }",
         "torque_drag.depths.to is 400 m; expected at least from, 500 m"},
        {"depths = { from = 500, to = 600, step = 0 }", "torque_drag.depths.step is 0"},
        {"depths = { from = 500, to = 600 }", "torque_drag.depths.step"},
        {"motions = [\"flying\"]", "other.toml:24:12: torque_drag.motions.0 is \"flying\""},
        {"motions = [\"sliding\", \"sliding\"]", "torque_drag.motions.1 is there twice"},
        {"friction = -1", "other.toml:24:12: torque_drag.friction is -1"},
        {"depth = 500", "other.toml:24:1: "},
    };
    for (const Refusal& refusal : refusals) {
        write_with(refusal.line);
        const Ending ending = run("other.toml -o out.h5");
        EXPECT_EQ(ending.code, 2) << refusal.line;
        EXPECT_THAT(ending.text, AllOf(StartsWith("drillstrand: error: other.toml:24:"),
                                       HasSubstr(refusal.message)));
        EXPECT_EQ(std::count(ending.text.begin(), ending.text.end(), '\n'), 1) << refusal.line;
        EXPECT_FALSE(fs::exists(path("out.h5"))) << refusal.line;
    }
}

TEST_F(TorqueDragProgram, StringThatDoesNotFitAtADepthIsRefused) {
    // 0.25 m fits into the upper section only, which ends at 300 m
    const Ending ending =
        run("case.toml --set string.component.0.outer_diameter=0.25 --set "
            "string.component.0.length=200 --set 'torque_drag.depths=[250, 400]'");
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.text, HasSubstr("with the bit at 400 m, component 1 (\"pipe\") has an outer "
                                       "diameter of 0.25 m; expected at most 0.22 m"));
}

TEST_F(TorqueDragProgram, CaseWithoutWellIsRefused) {
    std::ofstream(path("other.toml"))
        << "[[string.component]]\nlength = 24\nouter_diameter = 0.14\ninner_diameter = 0.12\n"
           "linear_density = 30\nyoungs_modulus = \"200 GPa\"\n[mesh]\nsegments = 8\n[run]\n"
           "duration = 1\n";
    Ending ending = run("other.toml");
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.text, HasSubstr("add a table [well] with survey and diameter"));
    ending = run("other.toml --set torque_drag.friction=0.2");
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.text, HasSubstr("torque_drag needs a well; expected a table [well]"));
}

TEST_F(TorqueDragProgram, OutputThatCannotBeWrittenIsRefused) {
    for (const std::string option : {"-o -", "-o case.toml", "--csv case.toml", "--csv -"})
        EXPECT_EQ(run("case.toml " + option).code, 2) << option;
    EXPECT_EQ(run("case.toml --csv none/such.csv").code, 2);
}

TEST_F(TorqueDragProgram, CalibrateFitsFrictionToPointsThatItMadeItself) {
    ASSERT_EQ(run("case.toml --csv study.csv").code, 0);
    std::ifstream study(path("study.csv"));
    std::string header;
    std::getline(study, header);
    const auto column = [&](const std::string& name) {
        const std::string before = header.substr(0, header.find(name));
        return std::count(before.begin(), before.end(), ',');
    };
    const auto in = column("tripping_in_hook_load");
    const auto out = column("tripping_out_hook_load");
    std::ofstream points(path("points.csv"));
    points << "depth[m],slack_off[N],pick_up[N]\n";
    for (std::string line; std::getline(study, line);) {
        std::vector<std::string> fields{""};
        for (const char c : line) {
            if (c == ',')
                fields.emplace_back();
            else
                fields.back().push_back(c);
        }
        points << fields[0] << ',' << fields[static_cast<std::size_t>(in)] << ','
               << fields[static_cast<std::size_t>(out)] << '\n';
    }
    points.close();
    const Ending found = call("calibrate case.toml points.csv --csv fit.csv");
    EXPECT_EQ(found.code, 0) << found.text;
    EXPECT_THAT(found.text,
                AllOf(HasSubstr("friction, to 1000 m"), Not(HasSubstr("friction, to 300 m")),
                      HasSubstr("0.2000"), HasSubstr("block weight"), HasSubstr("slack off (kN)")));
    EXPECT_TRUE(fs::exists(path("fit.csv")));
    EXPECT_EQ(call("calibrate case.toml points.csv --csv fit.csv").code, 2);
    EXPECT_EQ(call("calibrate case.toml points.csv --csv fit.csv --overwrite").code, 0);
    std::ofstream(path("none.csv")) << "depth[m],weather\n500,1\n";
    const Ending wrong = call("calibrate case.toml none.csv");
    EXPECT_EQ(wrong.code, 2);
    EXPECT_THAT(wrong.text, HasSubstr("none.csv:1:1: nothing to fit to"));
}

}  // namespace
}  // namespace drillstrand
