/// A barrier for the few threads of one team that meet many times a millisecond.
#pragma once

#include <atomic>
#include <thread>

namespace drillstrand {

/// Waiting threads spin, and yield to the system when the others are late (fewer cores than
/// threads). One object serves any number of meetings of the same team.
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
        for (int spins = 0; generation_.load(std::memory_order_acquire) == generation; ++spins) {
            if (spins > spins_before_yield) std::this_thread::yield();
        }
    }

  private:
    static constexpr int spins_before_yield = 2000;

    int threads_;
    alignas(64) std::atomic<int> arrived_{0};
    alignas(64) std::atomic<unsigned> generation_{0};
};

}  // namespace drillstrand
