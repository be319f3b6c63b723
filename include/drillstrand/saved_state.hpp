/// The state of a run as rows of numbers: what a checkpoint holds.
#pragma once

#include <string>
#include <vector>

namespace drillstrand {

/// Whole numbers up to this one (2^53) are doubles.
inline constexpr double largest_whole_number = 9007199254740992.0;

struct SavedRow {
    std::string name;  ///< part of the state and row, as in "rod/position"
    std::string unit;
    std::vector<double> values;
};

/// In an order that depends on the kind of integrator alone.
using SavedState = std::vector<SavedRow>;

}  // namespace drillstrand
