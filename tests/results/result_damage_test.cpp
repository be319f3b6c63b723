/// What is left of a result file when the process is killed or the disk is full.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <functional>
#include <thread>

#include "drillstrand/error.hpp"
#include "drillstrand/result_file.hpp"
#include "results/made_up_run.hpp"

namespace drillstrand {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Runs `action` in a process of its own.
pid_t start(const std::function<void()>& action) {
    std::fflush(nullptr);  // or the child would print it once more
    const pid_t child = ::fork();
    if (child != 0) return child;
    try {
        action();
    } catch (const std::exception&) {
        ::_exit(99);
    }
    ::_exit(0);
}

int status_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

/// A record that can be recomputed from its time, so that damage shows.
SeriesRecord sample(int k) {
    MadeUpRun run(1, static_cast<unsigned>(k));
    return run.series(k);
}

Profile frame(int k) {
    MadeUpRun run(40, static_cast<unsigned>(k));
    return run.profile(k);
}

/// Flushes all the time rather than once a second, so that most kills hit a flush; frames are as
/// rare among flushes as in a run.
void write_until_killed(const fs::path& path) {
    MadeUpRun run(40);
    ResultWriter writer(path, run.header());
    for (int k = 0;; ++k) {
        for (int i = 0; i < 16; ++i)
            writer.append(sample(16 * k + i));
        if (k % 32 == 0) writer.append(frame(k / 32));
        writer.flush({});
    }
}

void expect_sound(const Result& result) {
    EXPECT_EQ(result.footer.status, "running");
    for (std::size_t k = 0; k < result.series.size(); ++k)
        expect_same_bits(result.series[k], sample(static_cast<int>(k)), series_datasets());
    for (std::size_t k = 0; k < result.profiles.size(); ++k)
        expect_same_bits(result.profiles[k], frame(static_cast<int>(k)), profile_datasets());
}

class KilledRun : public testing::TestWithParam<unsigned> {};

TEST_P(KilledRun, LeavesAFileThatIsReadableUpToTheLastFlush) {
    const ScratchFolder folder;
    const fs::path path = folder / "out.h5";
    std::mt19937 random(GetParam());
    const pid_t child = start([&] { write_until_killed(path); });
    while (!fs::exists(path))
        std::this_thread::yield();
    std::this_thread::sleep_for(
        std::chrono::microseconds(std::uniform_int_distribution<int>(0, 300000)(random)));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    ASSERT_TRUE(WIFSIGNALED(status_of(child)));
    expect_sound(read_result(path));
}

INSTANTIATE_TEST_SUITE_P(Moments, KilledRun, testing::Range(1U, 9U));

/// Lets no file of this process grow past `bytes`, as a full disk would.
void limit_file_size(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
}

/// Writes until the disk is full, then closes the file as failed. Returns 0 where every step went
/// as the header promises.
int fill_disk(const fs::path& path) {
    MadeUpRun run(40);
    limit_file_size(4 << 20);
    ResultWriter writer(path, run.header());
    std::string failure;
    for (int k = 0; failure.empty(); ++k) {
        try {
            writer.append(sample(k));
            writer.append(frame(k));
            if (k % 16 == 0) writer.flush({});
        } catch (const ResultError& error) {
            failure = error.what();
        }
    }
    if (failure != path.string() + ": cannot write: File too large") return 2;
    ResultFooter footer;
    footer.status = "failed: " + failure;
    try {
        writer.close(footer);
    } catch (const ResultError&) {
        return 3;
    }
    return 0;
}

/// What a process printed on its error stream, and how it ended.
std::pair<int, std::string> run_and_listen(const fs::path& errors, const std::function<int()>& f) {
    const pid_t child = start([&] {
        const int file = ::open(errors.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
        ::dup2(file, STDERR_FILENO);
        std::exit(f());  // with the end-of-process work of the HDF5 library
    });
    const int status = status_of(child);
    std::ifstream stream(errors);
    return {status, std::string(std::istreambuf_iterator<char>(stream), {})};
}

TEST(FullDisk, IsOneErrorAndTheFileSaysSo) {
    const ScratchFolder folder;
    const fs::path path = folder / "out.h5";
    const auto [status, printed] =
        run_and_listen(folder / "errors", [&] { return fill_disk(path); });
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(printed, "");

    const Result result = read_result(path);
    EXPECT_THAT(result.footer.status, HasSubstr("failed: "));
    EXPECT_THAT(result.footer.status, HasSubstr("File too large"));
    EXPECT_GT(result.series.size(), 100U);
    for (std::size_t k = 0; k < result.series.size(); ++k)
        expect_same_bits(result.series[k], sample(static_cast<int>(k)), series_datasets());
    for (std::size_t k = 0; k < result.profiles.size(); ++k)
        expect_same_bits(result.profiles[k], frame(static_cast<int>(k)), profile_datasets());
}

TEST(FullDisk, ADroppedWriterNeitherThrowsNorPrints) {
    const ScratchFolder folder;
    const fs::path path = folder / "out.h5";
    const auto [status, printed] = run_and_listen(folder / "errors", [&] {
        MadeUpRun run(40);
        ResultWriter writer(path, run.header());
        writer.append(sample(0));
        writer.flush({});
        writer.append(sample(1));
        limit_file_size(fs::file_size(path));
        return 0;
    });
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(printed, "");
    EXPECT_EQ(read_result(path).series.size(), 1U);
}

TEST(FullDisk, AtTheStartLeavesAnOlderResultAsItWas) {
    const ScratchFolder folder;
    const fs::path path = folder / "out.h5";
    MadeUpRun run(40);
    ResultWriter(path, run.header()).close(run.footer("complete"));
    const auto [status, printed] = run_and_listen(folder / "errors", [&] {
        limit_file_size(1000);
        try {
            ResultWriter(path, run.header());
        } catch (const ResultError&) {
            return 0;
        }
        return 1;
    });
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(printed, "");
    EXPECT_EQ(read_result(path).footer.status, "complete");
}

}  // namespace
}  // namespace drillstrand
