/// A barrier for the few threads of one team that meet many times a millisecond.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

namespace drillstrand {

/// Waiting threads spin for longer than a team that has its cores for itself ever takes to meet.
/// Then another is late, because something else runs on its core: they yield to the system between
/// looks, and the time is counted. One object serves any number of meetings of the same team.
class Barrier {
  public:
    explicit Barrier(int threads) : threads_(threads) {}

    /// Only while no thread is waiting.
    void set_threads(int threads) { threads_ = threads; }

    void wait() {
        if (threads_ == 1) return;
        const unsigned generation = generation_.load(std::memory_order_relaxed);
        if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
            arrived_.store(0, std::memory_order_relaxed);
            generation_.store(generation + 1, std::memory_order_release);
            return;
        }
        for (int spin = 0; spin < spins_before_yield; ++spin) {
            if (generation_.load(std::memory_order_acquire) != generation) return;
            relax();
        }
        wait_for_late(generation);
    }

    /// Time that threads have waited for late ones, all together (s).
    [[nodiscard]] double waited() const {
        return 1e-9 * static_cast<double>(waited_.load(std::memory_order_relaxed));
    }

  private:
    static constexpr int spins_before_yield = 2000;  // some 20 us

    /// Tells the processor that this thread only waits.
    static void relax() {
#if defined(__x86_64__)
        __builtin_ia32_pause();
#endif
    }

    void wait_for_late(unsigned generation) {
        using WallClock = std::chrono::steady_clock;
        const auto start = WallClock::now();
        while (generation_.load(std::memory_order_acquire) == generation)
            std::this_thread::yield();
        const auto time = std::chrono::nanoseconds(WallClock::now() - start);
        waited_.fetch_add(time.count(), std::memory_order_relaxed);
    }

    int threads_;
    alignas(64) std::atomic<int> arrived_{0};
    alignas(64) std::atomic<unsigned> generation_{0};
    alignas(64) std::atomic<std::chrono::nanoseconds::rep> waited_{0};
};

}  // namespace drillstrand
