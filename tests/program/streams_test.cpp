/// The program without its standard streams, or with some that take nothing.
#include <cctype>
#include <csignal>

#include "program/program.hpp"

namespace drillstrand {
namespace {

using testing::HasSubstr;

using Command = std::vector<std::string>;

constexpr const char* well_case = R"(title = "Small"
[well]
survey = "survey.csv"
diameter = 0.25
[[string.component]]
length = 800
outer_diameter = 0.14
inner_diameter = 0.12
linear_density = 31.8557
youngs_modulus = "200 GPa"
[mesh]
element_length = 20
[torque_drag]
depths = [500]
[run]
duration = 1
)";

/// Everything that the program can be asked for, with the exit code that belongs to it.
std::vector<std::pair<Command, int>> all_commands() {
    return {{{"run", "pipe.toml", "-o", "new.h5"}, 0},
            {{"run", "pipe.toml", "-o", "new.h5", "--set", "damping.internal=-1"}, 2},
            {{"check", "pipe.toml"}, 0},
            {{"buckling", "pipe.toml", "-o", "new.h5", "--set", "gravity=0"}, 0},
            {{"equilibrium", "pipe.toml", "-o", "new.h5"}, 0},
            {{"torque-drag", "well.toml", "-o", "new.h5", "--csv", "new.csv"}, 0},
            {{"report", "older.h5", "-o", "new.html"}, 0},
            {{"export", "older.h5", "--csv", "-o", "new"}, 0},
            {{"export", "older.h5", "--vtk", "-o", "new"}, 0},
            {{"info", "older.h5"}, 0},
            {{"info", "no.h5"}, 2},
            {{"--help"}, 0},
            {{"run", "--help"}, 0},
            {{"--version"}, 0},
            {{}, 2}};
}

/// A desk with a case of each kind and an older result.
class Streams : public Program {
  protected:
    void SetUp() override {
        Program::SetUp();
        write("well.toml", well_case);
        write("survey.csv", "md,inclination,azimuth\n0,0,0\n300,0,0\n600,40,0\n1000,40,0\n");
        ASSERT_EQ(run({"run", "pipe.toml", "-o", "older.h5"}).code, 0);
    }

    /// What the command wrote, file by file, and then removes it.
    std::vector<std::pair<std::string, std::string>> take_new_files() {
        std::vector<std::pair<std::string, std::string>> taken;
        for (const auto& entry : fs::recursive_directory_iterator(desk())) {
            const std::string name = fs::relative(entry.path(), desk()).string();
            if (name.starts_with("new") && entry.is_regular_file())
                taken.emplace_back(name, is_result(name) ? "" : text_of(entry.path()));
        }
        std::sort(taken.begin(), taken.end());
        for (const char* name : {"new.h5", "new.csv", "new.html", "new"})
            fs::remove_all(desk() / name);
        return taken;
    }

    /// The wall time of a run, in its file, is never the same; its records are.
    bool is_result(const std::string& name) {
        if (!name.ends_with(".h5")) return false;
        EXPECT_TRUE(is_own_result(desk() / name)) << name;
        if (name == "new.h5" && is_run_) {
            const Result result = read_result(desk() / name);
            EXPECT_EQ(result.footer.status, "complete");
            EXPECT_EQ(result.series.size(), 11U);
        }
        return true;
    }

    bool is_run_ = false;
};

/// Times that a command takes or estimates have other digits each time.
std::string without_numbers(std::string text) {
    const auto is_of_number = [](unsigned char c) {
        return std::isdigit(c) != 0 || c == '.' || c == '+' || c == '-' || c == 'e';
    };
    std::erase_if(text, is_of_number);
    return text;
}

class WithoutStreams : public Streams, public testing::WithParamInterface<int> {};

TEST_P(WithoutStreams, EveryCommandDoesItsWork) {
    for (const auto& [command, code] : all_commands()) {
        SCOPED_TRACE(testing::PrintToString(command));
        is_run_ = !command.empty() && command.front() == "run";
        closed.clear();
        const Ending open = run(command);
        EXPECT_EQ(open.code, code) << open.err;
        const auto expected = take_new_files();

        for (int stream = 0; stream < 3; ++stream)
            if ((GetParam() >> stream & 1) != 0) closed.push_back(stream);
        const Ending ending = run(command);
        EXPECT_EQ(ending.code, code) << ending.err;
        EXPECT_EQ(take_new_files(), expected);
        const auto is_closed = [&](int stream) { return (GetParam() >> stream & 1) != 0; };
        if (code == 2) {
            EXPECT_EQ(ending.err, is_closed(STDERR_FILENO) ? "" : open.err);
        }
        if (is_closed(STDOUT_FILENO)) {
            EXPECT_EQ(ending.out, "");
        } else {
            EXPECT_EQ(without_numbers(ending.out), without_numbers(open.out));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Closed, WithoutStreams, testing::Range(1, 8));

TEST_F(Streams, AStandardOutputThatIsFullIsOneErrorOfEveryCommandThatPrints) {
    full = "/dev/full";
    for (const auto& [command, code] : all_commands()) {
        const bool prints = !command.empty() && command.front() != "run" &&
                            command.front() != "report" && command.front() != "export";
        const bool helps = !command.empty() && command.back() == "--help";
        if (code != 0 || (!prints && !helps)) continue;
        SCOPED_TRACE(testing::PrintToString(command));
        const Ending ending = run(command);
        EXPECT_EQ(ending.code, 1);
        EXPECT_THAT(ending.err,
                    is_one_error("standard output: cannot write: No space left on device"));
        take_new_files();
    }
}

TEST_F(Streams, AReaderWhoHasHadEnoughIsNoError) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ::close(ends[0]);
    output = ends[1];
    const Ending ending = run({"info", "older.h5"});
    ::close(ends[1]);
    EXPECT_EQ(ending.code, 0);
    EXPECT_EQ(ending.err, "");
}

}  // namespace
}  // namespace drillstrand
