/// How the threads of a leapfrog share the spans of its string.
#pragma once

#include <cstddef>
#include <vector>

#include "rod/director_state.hpp"

namespace drillstrand {

/// What one of several threads takes.
struct WorkShare {
    std::size_t first_span = 0;
    std::size_t end_span = 0;            ///< one past the last
    std::size_t begin = 0;               ///< first block
    std::size_t end = 0;                 ///< one past the last block
    std::vector<std::size_t> stretches;  ///< fine ones among its nodes
    std::vector<std::size_t> early;      ///< spans whose segments these stretches need
};

/// The shares of a team of so many threads: neighbouring spans to each, of work as equal as spans
/// and fine stretches, which nobody shares, allow.
std::vector<WorkShare> shares_of(const DirectorString& string, std::size_t threads);

/// The largest team of which each has a share.
std::size_t most_shares(const DirectorString& string);

}  // namespace drillstrand
