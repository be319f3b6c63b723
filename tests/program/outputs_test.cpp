/// What the program writes over, and what it leaves alone.
#include <sys/stat.h>

#include <csignal>
#include <functional>

#include "program/program.hpp"

namespace drillstrand {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* survey = "md,inclination,azimuth\n0,0,0\n300,0,0\n600,40,0\n1000,40,0\n";

constexpr const char* string_table =
    "name,length,outer_diameter,inner_diameter,linear_density,youngs_modulus\n"
    "pipe,800,0.14,0.12,31.8557,200e9\n";

constexpr const char* well_case = R"(title = "Small"
[well]
survey = "survey.csv"
diameter = 0.25
[string]
components = "bha.csv"
[mesh]
element_length = 20
[bit]
weight = "20 kN"
[contact]
static_friction = 0.2
[torque_drag]
depths = [500, 700]
[run]
duration = 0.01
[output]
interval = 0.005
profile_interval = 0.005
)";

/// A desk with a case whose well and string are tables.
class Outputs : public Program {
  protected:
    void SetUp() override {
        Program::SetUp();
        write("well.toml", well_case);
        write("survey.csv", survey);
        write("bha.csv", string_table);
    }

    void expect_refused(const std::vector<std::string>& command, const std::string& words) {
        const std::vector<std::string> before = files();
        const Ending ending = run(command);
        EXPECT_EQ(ending.code, 2) << command.front() << ": " << ending.err;
        EXPECT_THAT(ending.err, is_one_error(words)) << command.front();
        EXPECT_EQ(ending.out, "") << command.front();
        EXPECT_EQ(files(), before);
    }
};

using Command = std::vector<std::string>;

Command with(Command command, const Command& more) {
    command.insert(command.end(), more.begin(), more.end());
    return command;
}

TEST_F(Outputs, AnOlderResultIsReplacedOnlyWhereTheUserSaysSo) {
    ASSERT_EQ(run({"run", "well.toml"}).code, 0);
    const std::vector<std::pair<Command, std::string>> commands = {
        {{"run", "well.toml"}, "well.h5"},
        {{"run", "well.toml", "-o", "run.h5"}, "run.h5"},
        {{"equilibrium", "well.toml", "-o", "rest.h5"}, "rest.h5"},
        {{"buckling", "pipe.toml", "-o", "modes.h5"}, "modes.h5"},
        {{"modes", "well.toml"}, "well_modes.h5"},
        {{"torque-drag", "well.toml", "-o", "study.h5"}, "study.h5"},
        {{"torque-drag", "well.toml", "--csv", "study.csv"}, "study.csv"},
        {{"torque-drag", "well.toml", "--profile-csv", "profile.csv"}, "profile.csv"},
        {{"report", "well.h5"}, "well.html"},
        {{"export", "well.h5", "--csv", "-o", "tables"}, "tables/series.csv"},
        {{"export", "well.h5", "--vtk", "-o", "fields"}, "fields/string.pvd"}};
    for (const auto& [command, file] : commands) {
        SCOPED_TRACE(testing::PrintToString(command));
        Ending ending = run(command);
        if (file != "well.h5") {
            EXPECT_EQ(ending.code, 0) << ending.err;
        }
        const std::string older = text_of(desk() / file);
        ASSERT_NE(older, "");
        expect_refused(command, "--overwrite");
        EXPECT_EQ(text_of(desk() / file), older);
        ending = run(with(command, {"--overwrite"}));
        EXPECT_EQ(ending.code, 0) << ending.err;
    }
}

TEST_F(Outputs, NoTableOfTheProgramIsTakenForOneOfAnybodyElse) {
    ASSERT_EQ(run({"run", "well.toml"}).code, 0);
    for (const char* format : {"--csv", "--vtk"}) {
        const Command command = {"export", "well.h5", format};
        ASSERT_EQ(run(command).code, 0);
        std::vector<fs::path> written;
        for (const auto& entry : fs::directory_iterator(desk() / "well"))
            written.push_back(entry.path());
        // each of them alone is in the way, and is known again
        for (const fs::path& path : written) {
            const std::string text = text_of(path);
            fs::remove_all(desk() / "well");
            fs::create_directory(desk() / "well");
            std::ofstream(path, std::ios::binary) << text;
            expect_refused(command, path.filename().string() + ": there is a file of that name");
            EXPECT_EQ(run(with(command, {"--overwrite"})).code, 0) << path;
        }
        fs::remove_all(desk() / "well");
    }
}

TEST_F(Outputs, AnInputIsNeverReplacedWhateverItIsCalled) {
    ASSERT_EQ(run({"run", "well.toml"}).code, 0);
    fs::create_symlink("survey.csv", desk() / "link");
    fs::create_hard_link(desk() / "bha.csv", desk() / "same.csv");
    fs::create_directory(desk() / "folder");
    const std::vector<Command> commands = {{"run", "well.toml", "-o"},
                                           {"equilibrium", "well.toml", "-o"},
                                           {"buckling", "well.toml", "-o"},
                                           {"modes", "well.toml", "-o"},
                                           {"torque-drag", "well.toml", "-o"},
                                           {"torque-drag", "well.toml", "--csv"},
                                           {"torque-drag", "well.toml", "--profile-csv"}};
    for (const Command& command : commands) {
        expect_refused(with(command, {"well.toml", "--overwrite"}), "that is the case file");
        for (const char* input :
             {"survey.csv", "bha.csv", "link", "same.csv", "folder/../survey.csv"})
            expect_refused(with(command, {input, "--overwrite"}), "that is an input of the case");
    }
    write("rig.csv", "time,hook_load\n0,1000\n1,1000\n");
    expect_refused({"report", "well.h5", "-o", "well.h5", "--overwrite"},
                   "that is the result file");
    expect_refused({"report", "well.h5", "--compare", "rig.csv", "-o", "rig.csv", "--overwrite"},
                   "that is the table of --compare");
    EXPECT_EQ(text_of(desk() / "survey.csv"), survey);
    EXPECT_EQ(text_of(desk() / "bha.csv"), string_table);
    EXPECT_EQ(text_of(desk() / "well.toml"), well_case);
}

TEST_F(Outputs, AFileOfAnotherProgramIsNeverReplaced) {
    ASSERT_EQ(run({"run", "well.toml"}).code, 0);
    const std::string html = "<!doctype html>\n<html><head><title>drillstrand</title></head>\n";
    const std::vector<std::pair<std::string, std::string>> foreign = {
        {"page.html", html},
        {"table.csv", "time[s],depth[m]\n0,0\n"},
        {"survey2.csv", "measured_depth[m],inclination[deg],azimuth[deg]\n0,0,0\n"},
        {"empty.h5", ""},
        {"other.h5", "\x89HDF\r\n\x1a\n and nothing that HDF5 knows"},
        {"notes", "bit_depth[m],mine\n"}};
    for (const auto& [name, text] : foreign) {
        write(name, text);
        for (const Command& command :
             {Command{"run", "well.toml", "-o", name}, Command{"report", "well.h5", "-o", name},
              Command{"torque-drag", "well.toml", "--csv", name}})
            expect_refused(with(command, {"--overwrite"}), "drillstrand did not write");
        EXPECT_EQ(text_of(desk() / name), text);
    }
    fs::create_directory(desk() / "well");
    write("well/nodes.csv", "mine\n");
    expect_refused({"export", "well.h5", "--csv", "--overwrite"}, "well/nodes.csv");
    EXPECT_FALSE(fs::exists(desk() / "well/series.csv"));
    expect_refused({"report", "well.h5", "-o", "survey.csv", "--overwrite"},
                   "drillstrand did not write");
}

TEST_F(Outputs, TwoOutputsOfOneCommandDifferInName) {
    expect_refused({"torque-drag", "well.toml", "--csv", "a.csv", "--profile-csv", "a.csv"},
                   "--profile-csv");
    expect_refused({"torque-drag", "well.toml", "-o", "a", "--csv", "./a"}, "--csv");
}

TEST_F(Outputs, ASecondRunToTheSameFileIsRefusedAndTheFirstGoesOn) {
    const pid_t child = start_long_run();
    const Command command = {"run", "pipe.toml", "--overwrite"};
    expect_refused(command, "another run writes it");
    expect_refused({"equilibrium", "pipe.toml", "-o", "pipe.h5", "--overwrite"},
                   "another run writes it");
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    EXPECT_EQ(ending_of(child).code, -SIGKILL);
    // the kernel gave the lock back
    EXPECT_EQ(run(command).code, 0);
}

/// Does something to the result file of a run that goes on.
class Disturbed : public Program {
  protected:
    void expect_error_after(const std::function<void(const fs::path&)>& disturb,
                            const std::string& words) {
        const pid_t child = start_long_run();
        disturb(desk() / "pipe.h5");
        const Ending ending = ending_of(child);
        EXPECT_EQ(ending.code, 1);
        EXPECT_THAT(ending.err, is_one_error(words));
        EXPECT_THAT(ending.err, testing::Not(HasSubstr("results up to")));
    }
};

TEST_F(Disturbed, ADeletedResultIsAnError) {
    expect_error_after([](const fs::path& path) { fs::remove(path); }, "pipe.h5: deleted");
    EXPECT_THAT(files(), ElementsAre("pipe.toml"));
}

TEST_F(Disturbed, AReplacedResultIsAnErrorAndTheOtherFileStays) {
    expect_error_after(
        [&](const fs::path& path) {
            write("other", "mine");
            fs::rename(desk() / "other", path);
        },
        "moved or replaced");
    EXPECT_EQ(text_of(desk() / "pipe.h5"), "mine");
}

TEST_F(Disturbed, ACutOffResultIsAnError) {
    expect_error_after([](const fs::path& path) { fs::resize_file(path, 1000); }, "cut off");
}

TEST_F(Disturbed, AResultDeletedJustBeforeTheSignalIsAnErrorToo) {
    const pid_t child = start_long_run();
    fs::remove(desk() / "pipe.h5");
    ::kill(child, SIGTERM);
    const Ending ending = ending_of(child);
    EXPECT_EQ(ending.code, 1);
    EXPECT_THAT(ending.err, is_one_error("pipe.h5: deleted"));
}

TEST_F(Outputs, WhatAKilledStartLeftIsRemovedByTheNextButNotWhatIsAlive) {
    write("pipe.h5.new1", "half a file of a process that is gone");
    write("pipe.h5.new77_2", "another one");
    write("pipe.h5.newer", "mine");
    const int alive = ::open((desk() / "pipe.h5.new2").c_str(), O_CREAT | O_RDWR, 0600);
    struct flock whole = {};
    whole.l_type = F_RDLCK;
    ASSERT_EQ(::fcntl(alive, F_OFD_SETLK, &whole), 0);
    ASSERT_EQ(run({"run", "pipe.toml"}).code, 0);
    ::close(alive);
    EXPECT_THAT(files(), ElementsAre("bha.csv", "pipe.h5", "pipe.h5.new2", "pipe.h5.newer",
                                     "pipe.toml", "survey.csv", "well.toml"));
}

}  // namespace
}  // namespace drillstrand
