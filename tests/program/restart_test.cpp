/// Runs that were stopped, and taken up again by their checkpoint.
#include <csignal>

#include "drillstrand/checkpoint.hpp"
#include "drillstrand/isa.hpp"
#include "program/program.hpp"

namespace drillstrand {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class Restarted : public Program {
  protected:
    /// A run of the case that was stopped in its middle: pipe.h5 and pipe.checkpoint.h5.
    void stop_a_run() {
        const pid_t child = start({"run", "pipe.toml", "--set", "run.duration=100000"});
        while (!holds_records() && is_running(child))
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        ASSERT_EQ(::kill(child, SIGTERM), 0);
        const Ending ending = ending_of(child);
        ASSERT_EQ(ending.code, 130) << ending.err;
        EXPECT_THAT(ending.err, HasSubstr("--restart pipe.checkpoint.h5"));
        ASSERT_TRUE(fs::exists(desk() / "pipe.checkpoint.h5"));
    }

    /// Restarts with more arguments, and expects one line of error that leaves the result alone.
    void expect_refused(const std::vector<std::string>& more, const std::string& words) {
        std::vector<std::string> command = {
            "run", "pipe.toml", "--set", "run.duration=100000", "--restart", "pipe.checkpoint.h5"};
        command.insert(command.end(), more.begin(), more.end());
        const std::string before = text_of(desk() / "pipe.h5");
        const Ending ending = run(command);
        EXPECT_EQ(ending.code, 2) << words;
        EXPECT_THAT(ending.err,
                    AllOf(StartsWith("drillstrand: error: "), HasSubstr(words), EndsWith("\n")));
        EXPECT_EQ(std::count(ending.err.begin(), ending.err.end(), '\n'), 1) << ending.err;
        EXPECT_EQ(text_of(desk() / "pipe.h5"), before);
    }
};

TEST_F(Restarted, ARunOfAnotherCaseIsRefusedWithWhatDiffers) {
    stop_a_run();
    expect_refused({"--set", "head.rotation=1"}, "another case: head.rotation differs");
    expect_refused({"--set", "run.integrator=\"leapfrog\""}, "another integrator");
    expect_refused({"--set", "run.duration=50"}, "another case: run.duration differs");
    if (best_isa() > Isa::baseline)
        expect_refused({"--isa", "baseline"}, "another instruction set");
}

TEST_F(Restarted, AFileThatIsNoCheckpointIsRefused) {
    stop_a_run();
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {"pipe.h5", "not a checkpoint"},
        {"pipe.toml", "not a result file"},
        {"none.h5", "No such file"},
        {"", "--restart: nothing given"}};
    for (const auto& [file, words] : wrong) {
        const Ending ending = run({"run", "pipe.toml", "--restart", file});
        EXPECT_EQ(ending.code, 2) << words;
        EXPECT_THAT(ending.err, AllOf(StartsWith("drillstrand: error: "), HasSubstr(words)));
    }
}

TEST_F(Restarted, ADamagedCheckpointIsRefused) {
    stop_a_run();
    const std::string whole = text_of(desk() / "pipe.checkpoint.h5");
    write("pipe.checkpoint.h5", whole.substr(0, whole.size() / 2));
    expect_refused({}, "pipe.checkpoint.h5");
}

TEST_F(Restarted, WhatACheckpointSaysIsShownAndNotObeyed) {
    stop_a_run();
    Checkpoint checkpoint = read_checkpoint(desk() / "pipe.checkpoint.h5");
    checkpoint.header.integrator = "\x1b[2Jowned";
    write_checkpoint(desk() / "pipe.checkpoint.h5", checkpoint);
    expect_refused({}, "another integrator: \\x1b[2Jowned, not");
}

TEST_F(Restarted, AResultWithFewerRecordsThanTheCheckpointIsRefused) {
    stop_a_run();
    ASSERT_EQ(run({"run", "pipe.toml", "--overwrite", "--quiet"}).code, 0);
    expect_refused({}, "pipe.h5");
}

}  // namespace
}  // namespace drillstrand
