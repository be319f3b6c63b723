#include "signals.hpp"

#include <atomic>
#include <csignal>

namespace drillstrand::program {

namespace {

// The one global of the program: a signal handler can reach nothing else.
std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not take a lock");

extern "C" void request_stop(int) {
    stop.store(true, std::memory_order_relaxed);
}

}  // namespace

void watch_signals() {
    struct sigaction action = {};
    action.sa_handler = request_stop;
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // nohup has the hang-up ignored, and means it
    struct sigaction hang_up = {};
    sigaction(SIGHUP, nullptr, &hang_up);
    if (hang_up.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool stop_requested() {
    return stop.load(std::memory_order_relaxed);
}

}  // namespace drillstrand::program
