/// The processor's clock of the calling thread.
#pragma once

#include <ctime>

namespace drillstrand::bench {

/// Time (s) that the calling thread has spent on a processor, which neither other work on the
/// machine nor threads of its own team that wait in a loop change.
inline double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace drillstrand::bench
