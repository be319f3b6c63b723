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

TEST_F(Restarted, RecordsOfSensorsAndCountsOfCyclesAreThoseOfARunThatWasNotStopped) {
    const std::vector<std::string> asked = {
        "--set",
        "run.duration=10",
        "--set",
        "output.interval=0.1",
        "--set",
        "output.cycles={interval = 0.03}",
        "--set",
        "output.sensor=[{name = \"a\", depth = 7, interval = 0.02}, {name = \"b\", depth = 1, "
        "measured_from = \"bit\", interval = 7}]"};
    const auto command = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"run", "pipe.toml", "--quiet"};
        words.insert(words.end(), asked.begin(), asked.end());
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    ASSERT_EQ(run(command({"-o", "whole.h5"})).code, 0);
    const pid_t child = start(command({}));
    while (!holds_records() && is_running(child))
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ASSERT_EQ(::kill(child, SIGTERM), 0);
    const Ending stopped = ending_of(child);
    ASSERT_EQ(stopped.code, 130) << stopped.err;
    const Ending ending = run(command({"--restart", "pipe.checkpoint.h5"}));
    ASSERT_EQ(ending.code, 0) << ending.err;

    const Result whole = read_result(desk() / "whole.h5");
    const Result found = read_result(desk() / "pipe.h5");
    ASSERT_EQ(found.sensors.at(0).size(), 501U);
    for (std::size_t k = 0; k < found.sensors[0].size(); ++k) {
        EXPECT_EQ(found.sensors[0][k].time, whole.sensors.at(0)[k].time);
        EXPECT_EQ(found.sensors[0][k].acceleration, whole.sensors[0][k].acceleration);
        EXPECT_EQ(found.sensors[0][k].torque, whole.sensors[0][k].torque);
    }
    EXPECT_EQ(found.sensors.at(1).size(), 3U);
    EXPECT_GT(found.footer.cycles.cycles.front(), 0);
    EXPECT_EQ(found.footer.cycles.cycles, whole.footer.cycles.cycles);
    EXPECT_EQ(found.footer.cycles.equivalent_range, whole.footer.cycles.equivalent_range);
    EXPECT_EQ(found.footer.findings, whole.footer.findings);
}

TEST_F(Restarted, AResultWithFewerRecordsThanTheCheckpointIsRefused) {
    stop_a_run();
    ASSERT_EQ(run({"run", "pipe.toml", "--overwrite", "--quiet"}).code, 0);
    expect_refused({}, "pipe.h5");
}

}  // namespace
}  // namespace drillstrand
