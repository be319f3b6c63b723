/// Files of torque and drag: HDF5, and tables for a spreadsheet. The layout is listed in
/// engine/results/README.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drillstrand/new_file.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/torque_drag.hpp"

namespace drillstrand {

/// A study, and what it was computed of. Nothing runs in time: integrator and threads of the header
/// are not stored; its mesh is that of the last depth.
struct TorqueDragResult {
    ResultHeader header;
    TorqueDrag study;
    std::string version;  ///< of the drillstrand that wrote the file; set by reading
    std::string commit;
};

/// One value of a motion per depth of the bit, or per segment at the last depth.
struct TorqueDragDataset {
    std::string name;  ///< in HDF5 below the group of the motion
    bool integer = false;
    std::string units;
    std::string description;
    std::vector<double> (*values)(const TorqueDragCurve& curve);
    void (*assign)(TorqueDragCurve& curve, const std::vector<double>& values);
};

const std::vector<TorqueDragDataset>& torque_drag_depth_datasets();
const std::vector<TorqueDragDataset>& torque_drag_profile_datasets();

/// Writes a file, which takes its name once it is sound. Throws ResultError where it cannot be
/// written.
void write_torque_drag(const std::filesystem::path& path, const TorqueDragResult& result,
                       Existing existing = Existing::replace);

/// Comma-separated values in SI, one line per depth of the bit, or per segment at the last depth;
/// columns of all motions, MOTION_NAME[UNIT]. Numbers that are missing are nan.
void write_torque_drag_table(const std::filesystem::path& path, const TorqueDrag& study,
                             Existing existing = Existing::replace);
void write_torque_drag_profile_table(const std::filesystem::path& path, const TorqueDrag& study,
                                     Existing existing = Existing::replace);

/// Whether a file is one of torque and drag. Throws ResultError where it is no result file.
bool holds_torque_drag(const std::filesystem::path& path);

/// Reads all but the reasons why equilibria were not found. Throws ResultError where the file is
/// not one of torque and drag.
TorqueDragResult read_torque_drag(const std::filesystem::path& path);

}  // namespace drillstrand
