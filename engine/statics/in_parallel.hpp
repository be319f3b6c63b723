/// Work on independent items, shared by threads.
#pragma once

#include <cstddef>
#include <exception>
#include <vector>

namespace drillstrand {

/// Calls `action` with every number below `count`, in parallel; the error of the least number,
/// where there is one, passes through.
template <class Action>
void for_each_in_parallel(std::size_t count, int threads, const Action& action) {
    std::vector<std::exception_ptr> errors(count);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (std::size_t i = 0; i < count; ++i) {
        try {
            action(i);
        } catch (...) {
            errors[i] = std::current_exception();
        }
    }
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
}

}  // namespace drillstrand
