// Time of one step of an integrator per node, peak of the processor and bandwidth of its memory,
// and which instructions a step executes: for scaling.py.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/simulation.hpp"
#include "numerics/kernel.hpp"
#include "processor_clock.hpp"

namespace drillstrand::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Times one thread by the processor's clock, which other work on the machine does not disturb, and
/// several by the wall's.
class Stopwatch {
  public:
    explicit Stopwatch(int threads) : threads_(threads) {}
    [[nodiscard]] double seconds() const {
        if (threads_ > 1) return seconds_since(start_);
        return processor_seconds() - processor_start_;
    }

  private:
    int threads_;
    Clock::time_point start_ = Clock::now();
    double processor_start_ = processor_seconds();
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

constexpr double far_ahead = 1e9;  // s; no run gets there

/// A case with its integrator.
struct Subject {
    Subject(const std::string& path, int threads) : scene(starting_scene(read_case(path))) {
        const Case input = read_case(path);
        IntegratorOptions options;
        options.kind = input.run.integrator;
        options.cfl = input.run.cfl;
        options.threads = threads;
        integrator = make_integrator(scene, options);
    }

    Scene scene;
    std::unique_ptr<Integrator> integrator;
};

// ------------------------------------------------------------------ time per step

struct Timing {
    std::string path;
    int threads = 1;
    std::unique_ptr<Subject> subject;
    std::int64_t steps = 0;       ///< of one measurement
    std::vector<double> seconds;  ///< of each
};

/// Steps that take about `seconds`, by the quickest of a few attempts.
std::int64_t steps_for(Integrator& integrator, int threads, double seconds) {
    constexpr int attempts = 3;
    for (std::int64_t steps = 1;; steps *= 4) {
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < attempts; ++i) {
            const Stopwatch watch(threads);
            integrator.advance(far_ahead, steps);
            least = std::min(least, watch.seconds());
        }
        if (least > 0.1 * seconds) {
            const double wanted = static_cast<double>(steps) * seconds / least;
            return std::max<std::int64_t>(1, static_cast<std::int64_t>(wanted));
        }
    }
}

void time_steps(const std::vector<std::string>& paths, const std::vector<int>& threads, int rounds,
                double seconds) {
    std::vector<Timing> timings;
    for (const std::string& path : paths) {
        for (const int count : threads) {
            Timing& timing = timings.emplace_back();
            timing.path = path;
            timing.threads = count;
            timing.subject = std::make_unique<Subject>(path, count);
            timing.steps = steps_for(*timing.subject->integrator, count, seconds);
        }
    }
    // all in turn, in a new order each round, so that a slow spell of the machine meets all
    std::vector<std::size_t> order(timings.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::mt19937 random(20241);
    for (int round = 0; round < rounds; ++round) {
        std::shuffle(order.begin(), order.end(), random);
        for (const std::size_t i : order) {
            Timing& timing = timings[i];
            const Stopwatch watch(timing.threads);
            timing.subject->integrator->advance(far_ahead, timing.steps);
            timing.seconds.push_back(watch.seconds());
        }
    }
    fmt::print(
        "case,threads,segments,steps,rounds,step median (us),step least (us),nodes in "
        "contact\n");
    for (const Timing& timing : timings) {
        const double to_micro = 1e6 / static_cast<double>(timing.steps);
        const double least = *std::min_element(timing.seconds.begin(), timing.seconds.end());
        fmt::print("{},{},{},{},{},{:.6g},{:.6g},{}\n", timing.path, timing.threads,
                   timing.subject->scene.segments, timing.steps, rounds,
                   to_micro * median(timing.seconds), to_micro * least,
                   timing.subject->integrator->series().contact_nodes);
    }
}

// ------------------------------------------------------------------ peak and bandwidth

template <std::size_t lanes>
struct Vector {
    using Type [[gnu::vector_size(lanes * sizeof(double))]] = double;
};

constexpr std::int64_t rounds_of_peak = 1 << 20;
constexpr std::size_t chains = 12;  // independent sums: enough to hide the latency of an FMA

/// rounds_of_peak multiply-adds of `chains` vectors. Returns their sum, so that it must be
/// computed.
template <std::size_t lanes>
DRILLSTRAND_INLINE double multiply_add(double factor, double term) {
    using V = typename Vector<lanes>::Type;
    V sum[chains];
    for (std::size_t i = 0; i < chains; ++i)
        sum[i] = V{} + static_cast<double>(i);
    const V factors = V{} + factor;
    const V terms = V{} + term;
    for (std::int64_t round = 0; round < rounds_of_peak; ++round) {
#pragma GCC unroll 12
        for (std::size_t i = 0; i < chains; ++i)
            sum[i] = sum[i] * factors + terms;
    }
    double total = 0;
    for (const V& v : sum) {
        for (std::size_t lane = 0; lane < lanes; ++lane)
            total += v[lane];
    }
    return total;
}

#ifdef __x86_64__
[[gnu::target("arch=x86-64-v4")]] double multiply_add_512(double factor, double term) {
    return multiply_add<8>(factor, term);
}
[[gnu::target("arch=x86-64-v3")]] double multiply_add_256(double factor, double term) {
    return multiply_add<4>(factor, term);
}
#endif
double multiply_add_128(double factor, double term) {
    return multiply_add<2>(factor, term);
}

/// The widest multiply-add of this processor, and its lanes.
struct Peak {
    double (*run)(double, double);
    std::size_t lanes;
};

Peak widest() {
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx512f")) return {multiply_add_512, 8};
    if (__builtin_cpu_supports("avx2")) return {multiply_add_256, 4};
#endif
    return {multiply_add_128, 2};
}

/// Best of several: 1e9 operations per second of all threads together.
double peak_of(int threads) {
    const Peak peak = widest();
    double best = 0;
    double keep = 0;
    for (int attempt = 0; attempt < 15; ++attempt) {
        const auto start = Clock::now();
#pragma omp parallel num_threads(threads) reduction(+ : keep)
        keep += peak.run(0.999, 1e-3);
        const double operations = 2.0 * static_cast<double>(peak.lanes * chains) *
                                  static_cast<double>(rounds_of_peak) * threads;
        best = std::max(best, operations / seconds_since(start));
    }
    if (!(keep > 0)) throw std::runtime_error("the sums of the peak kernel are wrong");
    return best * 1e-9;
}

DRILLSTRAND_KERNEL void triad(double* a, const double* b, const double* c, double factor,
                              std::size_t begin, std::size_t end) {
#pragma omp simd
    for (std::size_t i = begin; i < end; ++i)
        a[i] = b[i] + factor * c[i];
}

/// Traffic of a = b + f c over arrays of `bytes` in all, best of several (GB/s): two reads, the
/// write, and the line that the write brings in first.
double bandwidth_of(std::size_t bytes, int threads) {
    const std::size_t count = std::max<std::size_t>(bytes / (3 * sizeof(double)), 512);
    std::vector<double> a(count, 0.0);
    std::vector<double> b(count, 1.0);
    std::vector<double> c(count, 2.0);
    const auto sweep_once = at_level<triad>({});
    const auto sweeps = static_cast<int>(1 + 40'000'000 / count);
    double best = 0;
    for (int attempt = 0; attempt < 7; ++attempt) {
        const auto start = Clock::now();
#pragma omp parallel num_threads(threads)
        {
#pragma omp for schedule(static)
            for (int part = 0; part < threads; ++part) {
                const std::size_t begin =
                    count * static_cast<std::size_t>(part) / static_cast<std::size_t>(threads);
                const std::size_t end =
                    count * static_cast<std::size_t>(part + 1) / static_cast<std::size_t>(threads);
                for (int sweep = 0; sweep < sweeps; ++sweep)
                    sweep_once(a.data(), b.data(), c.data(), 0.5 + 1e-9 * sweep, begin, end);
            }
        }
        const double traffic = 4.0 * sizeof(double) * static_cast<double>(count) * sweeps;
        best = std::max(best, traffic / seconds_since(start));
    }
    if (!(a[count / 2] > 0)) throw std::runtime_error("the triad's result is wrong");
    return best * 1e-9;
}

void measure_machine(const std::vector<int>& threads, const std::vector<double>& kilobytes) {
    fmt::print("what,threads,kilobytes,value\n");
    for (const int count : threads) {
        fmt::print("peak (Gflop/s),{},,{:.5g}\n", count, peak_of(count));
        for (const double size : kilobytes) {
            fmt::print("bandwidth (GB/s),{},{:g},{:.5g}\n", count, size,
                       bandwidth_of(static_cast<std::size_t>(1024 * size), count));
        }
    }
}

// ------------------------------------------------------------------ instructions of a step

/// First address of this program in memory.
std::uint64_t load_address() {
    std::ifstream maps("/proc/self/maps");
    std::string first;
    std::getline(maps, first, '-');
    return std::stoull(first, nullptr, 16);
}

void wait_for_stop(pid_t child) {
    int status = 0;
    if (waitpid(child, &status, 0) < 0 || !WIFSTOPPED(status))
        throw std::runtime_error("the traced process did not stop where it should");
}

/// Runs one step of a case one instruction at a time, in a child process, and prints the address of
/// each in the program's file and the general registers before it: enough to count operations and
/// to know which memory they touch, exactly and the same every time.
void trace(const std::string& path) {
    constexpr int settling_steps = 20;
    Subject subject(path, 1);
    subject.integrator->advance(far_ahead, settling_steps);
    const std::uint64_t base = load_address();
    fmt::print("# {} {} {:x}\n", subject.scene.segments, subject.integrator->series().contact_nodes,
               base);
    std::fflush(stdout);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
        raise(SIGSTOP);
        subject.integrator->advance(far_ahead, 1);
        raise(SIGSTOP);
        _exit(0);
    }
    wait_for_stop(child);
    for (;;) {
        user_regs_struct r{};
        if (ptrace(PTRACE_GETREGS, child, nullptr, &r) != 0 ||
            ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) != 0) {
            throw std::runtime_error("single steps are not allowed here");
        }
        fmt::print(
            "{:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} "
            "{:x}\n",
            r.rip - base, r.rax, r.rbx, r.rcx, r.rdx, r.rsi, r.rdi, r.rbp, r.rsp, r.r8, r.r9, r.r10,
            r.r11, r.r12, r.r13, r.r14, r.r15);
        int status = 0;
        waitpid(child, &status, 0);
        if (!WIFSTOPPED(status)) throw std::runtime_error("the traced process ended early");
        if (WSTOPSIG(status) == SIGSTOP) break;
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
}

}  // namespace
}  // namespace drillstrand::bench

int main(int count, char** arguments) {
    CLI::App app("Measures steps of integrators, and the machine that takes them.");
    app.require_subcommand(1);
    std::vector<std::string> paths;
    std::vector<int> threads{1};
    std::vector<double> kilobytes;
    int rounds = 15;
    double seconds = 0.01;

    CLI::App* step = app.add_subcommand("steps", "time per step, all cases in turn");
    step->add_option("case", paths, "case files")->required();
    step->add_option("--threads", threads, "numbers of threads")->delimiter(',');
    step->add_option("--rounds", rounds, "measurements of each case");
    step->add_option("--seconds", seconds, "of one measurement, about");
    CLI::App* machine = app.add_subcommand("machine", "peak and bandwidth");
    machine->add_option("--threads", threads, "numbers of threads")->delimiter(',');
    machine->add_option("--kilobytes", kilobytes, "of memory to sweep over")->delimiter(',');
    CLI::App* instructions = app.add_subcommand("trace", "instructions that a step executes");
    instructions->add_option("case", paths, "case file")->required()->expected(1);
    CLI11_PARSE(app, count, arguments);
    try {
        using namespace drillstrand::bench;
        if (*step) time_steps(paths, threads, rounds, seconds);
        if (*machine) measure_machine(threads, kilobytes);
        if (*instructions) trace(paths.front());
    } catch (const std::exception& error) {
        std::cerr << "bench_scaling: error: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
