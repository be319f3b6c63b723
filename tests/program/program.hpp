/// The program as a user meets it: a test runs the built drillstrand in a folder of its own.
#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/result_file.hpp"
#include "results/made_up_run.hpp"

namespace drillstrand {

namespace fs = std::filesystem;

inline constexpr const char* pipe_case = R"(title = "A pipe hangs and swings"
[[string.component]]
name = "pipe"
length = 24
outer_diameter = 0.1397
inner_diameter = 0.1155
linear_density = 34.2277
youngs_modulus = "200 GPa"
[mesh]
segments = 8
[head]
direction = [1, 0, 0]
rotation = 0
[run]
duration = 0.01
integrator = "dormand-prince"
[output]
interval = 0.001
profile_interval = 0.005
)";

struct Ending {
    int code = -1;  ///< exit code, or -signal
    std::string out;
    std::string err;
};

inline std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// A working directory with a case in it, where the program runs.
class Program : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directory(desk());
        write("pipe.toml", pipe_case);
    }

    rlim_t largest_file = RLIM_INFINITY;  ///< bytes that the program may write into one
    std::vector<int> closed;              ///< standard streams that the program does not get
    std::string full;                     ///< a device in place of its standard output
    int output = -1;                      ///< a descriptor for its standard output

    [[nodiscard]] fs::path desk() const { return folder_ / "desk"; }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(desk() / name) << text;
    }

    pid_t start(std::vector<std::string> arguments) const {
        const pid_t child = ::fork();
        if (child != 0) return child;
        arguments.insert(arguments.begin(), DRILLSTRAND_PROGRAM);
        std::vector<char*> pointers;
        for (std::string& argument : arguments)
            pointers.push_back(argument.data());
        pointers.push_back(nullptr);
        const rlimit limit{largest_file, largest_file};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        redirect(STDOUT_FILENO, full.empty() ? folder_ / "out" : fs::path(full));
        redirect(STDERR_FILENO, folder_ / "err");
        if (output >= 0) ::dup2(output, STDOUT_FILENO);
        for (const int stream : closed)
            ::close(stream);
        if (::chdir(desk().c_str()) == 0) ::execv(pointers.front(), pointers.data());
        ::_exit(125);
    }

    [[nodiscard]] Ending ending_of(pid_t child) const {
        int status = 0;
        ::waitpid(child, &status, 0);
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
        return {code, text_of(folder_ / "out"), text_of(folder_ / "err")};
    }

    [[nodiscard]] Ending run(const std::vector<std::string>& arguments) const {
        return ending_of(start(arguments));
    }

    [[nodiscard]] std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(desk()))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

    /// Starts a run that would take hours and waits until its file holds records.
    [[nodiscard]] pid_t start_long_run() const {
        const pid_t child = start({"run", "pipe.toml", "--set", "run.duration=100000"});
        while (!holds_records() && is_running(child))
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return child;
    }

    /// Whether a child has not ended yet; leaves its ending to ending_of().
    [[nodiscard]] static bool is_running(pid_t child) {
        siginfo_t ending{};
        const int failed =
            ::waitid(P_PID, static_cast<id_t>(child), &ending, WEXITED | WNOHANG | WNOWAIT);
        return failed == 0 && ending.si_pid == 0;
    }

    [[nodiscard]] bool holds_records() const {
        try {
            const Result result = read_result(desk() / "pipe.h5");
            return result.series.size() > 1 && result.footer.statistics.steps > 0;
        } catch (const ResultError&) {
            return false;
        }
    }

  private:
    static void redirect(int stream, const fs::path& path) {
        const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
        ::dup2(file, stream);
    }

    ScratchFolder folder_;
};

inline std::string reached_text(const Result& result) {
    std::ostringstream text;
    text << "results up to " << result.series.back().time << " s are ";
    return text.str();
}

/// One line on the error stream, beginning as every error does.
inline auto is_one_error(const std::string& words) {
    return testing::AllOf(
        testing::StartsWith("drillstrand: error: "), testing::HasSubstr(words),
        testing::EndsWith("\n"),
        testing::ResultOf(
            [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }, 1));
}

}  // namespace drillstrand
