/// A result file with which a restarted run goes on.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "drillstrand/error.hpp"
#include "drillstrand/result_file.hpp"
#include "results/made_up_run.hpp"

namespace drillstrand {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::size_t segments = 13;
constexpr int samples_per_frame = 16;

/// Records that can be made again from their number.
SeriesRecord sample(int k) {
    return MadeUpRun(segments, static_cast<unsigned>(k)).series(k);
}

Profile frame(int k) {
    return MadeUpRun(segments, static_cast<unsigned>(k)).profile(k);
}

ResultHeader header() {
    return MadeUpRun(segments).header();
}

/// Appends the samples from `first` to before `last`, and the frames that come before them.
void append(ResultWriter& writer, int first, int last, int samples_a_flush = 100) {
    for (int k = first; k < last; ++k) {
        if (k % samples_per_frame == 0) writer.append(frame(k / samples_per_frame));
        writer.append(sample(k));
        if (k % samples_a_flush == 0) writer.flush({});
    }
}

std::size_t frames_before(int k) {
    return static_cast<std::size_t>((k + samples_per_frame - 1) / samples_per_frame);
}

ResultWriter resume(const fs::path& path, int kept) {
    return ResultWriter::resume(path, header(), static_cast<std::size_t>(kept),
                                frames_before(kept));
}

ResultFooter complete() {
    ResultFooter footer;
    footer.status = "complete";
    return footer;
}

/// Writes samples in one go.
void write(const fs::path& path, int samples) {
    ResultWriter writer(path, header());
    append(writer, 0, samples);
    writer.close(complete());
}

void expect_equal(const fs::path& left, const fs::path& right) {
    const Result found = read_result(left);
    const Result expected = read_result(right);
    ASSERT_EQ(found.series.size(), expected.series.size());
    for (std::size_t k = 0; k < found.series.size(); ++k)
        expect_same_bits(found.series[k], expected.series[k], series_datasets());
    ASSERT_EQ(found.profiles.size(), expected.profiles.size());
    for (std::size_t k = 0; k < found.profiles.size(); ++k)
        expect_same_bits(found.profiles[k], expected.profiles[k], profile_datasets());
    const std::string python = "/usr/bin/python3";
    if (std::system((python + " -c 'import h5py' 2>/dev/null").c_str()) != 0) return;
    EXPECT_EQ(
        std::system((python + " '" DRILLSTRAND_SOURCE_DIR "/tests/results/equal_datasets.py' " +
                     left.string() + " " + right.string())
                        .c_str()),
        0);
}

std::string error_of_resuming(const fs::path& path, const ResultHeader& of, std::size_t series,
                              std::size_t profiles) {
    try {
        ResultWriter::resume(path, of, series, profiles);
    } catch (const ResultError& error) {
        return error.what();
    }
    return "no error";
}

/// Kept samples: none, some of the first chunk, just a chunk, and some more than that, all.
class Resumed : public testing::TestWithParam<int> {};

TEST_P(Resumed, AFileBecomesTheOneThatWasWrittenInOneGo) {
    const ScratchFolder folder;
    write(folder / "whole.h5", 1700);
    {
        ResultWriter broken_off(folder / "out.h5", header());
        append(broken_off, 0, 1300);
    }
    ResultWriter writer = resume(folder / "out.h5", GetParam());
    EXPECT_EQ(writer.written_until(), std::max(GetParam() - 1, 0));
    EXPECT_EQ(read_result(folder / "out.h5").footer.status, "running");
    EXPECT_EQ(read_result(folder / "out.h5").series.size(), static_cast<std::size_t>(GetParam()));
    append(writer, GetParam(), 1700);
    writer.close(complete());
    expect_equal(folder / "out.h5", folder / "whole.h5");
}

INSTANTIATE_TEST_SUITE_P(Keeping, Resumed, testing::Values(0, 1, 500, 512, 1299, 1300));

/// A reader may meet the file in the middle of a flush.
bool holds_more(const fs::path& path, int samples) {
    try {
        return read_result(path).series.size() > static_cast<std::size_t>(samples) + 40;
    } catch (const ResultError&) {
        return false;
    }
}

/// Goes on behind the kept samples until it is killed.
pid_t start_writing(const fs::path& path, int kept) {
    std::fflush(nullptr);  // or the child would print it once more
    const pid_t child = ::fork();
    if (child != 0) return child;
    try {
        ResultWriter writer = kept == 0 ? ResultWriter(path, header()) : resume(path, kept);
        append(writer, kept, 100000000, 3);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
    ::_exit(1);
}

TEST(ResumedTwice, AFileThatWasKilledEachTimeBecomesTheOneThatWasWrittenInOneGo) {
    std::mt19937 random(7);
    for (int round = 0; round < 5; ++round) {
        const ScratchFolder folder;
        const fs::path path = folder / "out.h5";
        int kept = 0;
        for (int kill = 0; kill < 2; ++kill) {
            const pid_t child = start_writing(path, kept);
            const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
            while (!holds_more(path, kept) && std::chrono::steady_clock::now() < deadline)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            const std::chrono::microseconds later(
                std::uniform_int_distribution<int>(0, 30000)(random));
            std::this_thread::sleep_for(later);
            ::kill(child, SIGKILL);
            int status = 0;
            ::waitpid(child, &status, 0);
            ASSERT_TRUE(WIFSIGNALED(status));
            // a frame goes to the file before the sample of its time
            const int written = static_cast<int>(read_result(path).series.size());
            ASSERT_GE(written, kept);
            // the kill may have come between the cut to what was kept and the first new record
            if (written > kept)
                kept = std::uniform_int_distribution<int>(kept + 1, written)(random);
        }
        const int end = kept + 300;
        ResultWriter writer = resume(path, kept);
        append(writer, kept, end);
        writer.close(complete());
        write(folder / "whole.h5", end);
        expect_equal(path, folder / "whole.h5");
    }
}

TEST(Resuming, WhatIsNotThisRunIsRefusedAndStaysAsItIs) {
    const ScratchFolder folder;
    const fs::path path = folder / "out.h5";
    write(path, 100);
    const std::size_t frames = frames_before(100);
    EXPECT_THAT(error_of_resuming(path, header(), 101, frames), HasSubstr("holds 100 records"));
    EXPECT_THAT(error_of_resuming(path, header(), 100, frames + 1), HasSubstr("/profiles/"));
    EXPECT_THAT(error_of_resuming(path, MadeUpRun(segments + 1).header(), 10, 1),
                HasSubstr("another string"));
    ResultHeader other = header();
    other.integrator = "leapfrog";
    EXPECT_THAT(error_of_resuming(path, other, 10, 1), HasSubstr("made by dormand-prince"));
    write(folder / "whole.h5", 100);
    expect_equal(path, folder / "whole.h5");

    EXPECT_THAT(error_of_resuming(folder / "no.h5", header(), 0, 0),
                HasSubstr("No such file or directory"));
    std::ofstream(folder / "text.h5") << "title = \"not a result\"\n";
    EXPECT_THAT(error_of_resuming(folder / "text.h5", header(), 0, 0),
                testing::StartsWith((folder / "text.h5").string() + ": not a result file"));
}

TEST(Resuming, IsRefusedWhileAnotherWriterGoesOn) {
    const ScratchFolder folder;
    const fs::path path = folder / "out.h5";
    ResultWriter writer(path, header());
    append(writer, 0, 50);
    writer.flush({});
    EXPECT_THAT(error_of_resuming(path, header(), 10, 1), HasSubstr("another run writes it"));
    append(writer, 50, 60);
    writer.close(complete());
    EXPECT_EQ(read_result(path).series.size(), 60U);
}

}  // namespace
}  // namespace drillstrand
