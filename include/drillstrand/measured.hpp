/// Channels measured on a rig, to lay beside a simulation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drillstrand {

/// What is measured at the surface.
struct MeasuredChannels {
    std::vector<double> time;       ///< s, ascending
    std::vector<double> hook_load;  ///< N, as long as `time`; empty where the table has none
    std::vector<double> torque;     ///< N m, likewise
};

/// Reads a CSV file with the columns time and at least one of hook_load and torque, with units in
/// the header as in "time[min],hook_load[klbf],torque[kN m]"; without units they are in SI. Other
/// columns are ignored. Throws InputError at the field that is wrong.
MeasuredChannels read_measured(const std::filesystem::path& path);

}  // namespace drillstrand
