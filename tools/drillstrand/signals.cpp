#include "signals.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace drillstrand::program {

namespace {

// The global of the program: a signal handler can reach nothing else.
std::atomic<std::int64_t> asked_at = 0;  ///< when the first signal came (ms); 0: none has
static_assert(std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may not take a lock");

/// A second signal that comes sooner is the same wish: timeout(1) sends one to the program and one
/// to its group.
constexpr std::int64_t same_wish = 500;  // ms

std::int64_t milliseconds() {
    timespec now = {};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

extern "C" void request_stop(int signal) {
    const std::int64_t now = milliseconds();
    std::int64_t first = 0;
    // another thread may take the second signal while this one takes the first
    if (!asked_at.compare_exchange_strong(first, now) && now - first > same_wish) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);  // once this handler returns
    }
}

}  // namespace

void watch_signals() {
    struct sigaction action = {};
    action.sa_handler = request_stop;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    // one handler at a time
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        sigaddset(&action.sa_mask, signal);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // nohup has the hang-up ignored, and means it
    struct sigaction hang_up = {};
    sigaction(SIGHUP, nullptr, &hang_up);
    if (hang_up.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool stop_requested() {
    return asked_at.load(std::memory_order_relaxed) != 0;
}

}  // namespace drillstrand::program
