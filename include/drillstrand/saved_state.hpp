/// The state of a run as rows of numbers: what a checkpoint holds.
#pragma once

#include <string>
#include <vector>

namespace drillstrand {

struct SavedRow {
    std::string name;  ///< part of the state and row, as in "rod/position"
    std::string unit;
    std::vector<double> values;
};

/// In an order that depends on the kind of integrator alone.
using SavedState = std::vector<SavedRow>;

}  // namespace drillstrand
