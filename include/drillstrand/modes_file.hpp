/// Files of modes of vibration (HDF5). The layout is listed in engine/results/README.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drillstrand/modes.hpp"
#include "drillstrand/new_file.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/result_layout.hpp"

namespace drillstrand {

/// The vibrations of a string, and what they were computed of. Nothing runs in time: integrator and
/// threads of the header are not stored.
struct ModesResult {
    ResultHeader header;
    double rotation_rate = 0;  ///< at which the modes were found (rad/s)
    WallGrip grip = WallGrip::sticks;
    StaticShape shape;
    std::vector<VibrationMode> modes;
    std::vector<CampbellPoint> campbell;
    std::vector<CriticalSpeed> critical_speeds;
    std::optional<Excitation> excitation;  ///< where a response was asked for
    std::vector<ForcedResponse> response;
    std::string version;  ///< of the drillstrand that wrote the file; set by reading
    std::string commit;
};

/// Written once.
const std::vector<RecordDataset<StaticShape>>& static_shape_datasets();
/// One entry per mode.
const std::vector<RecordDataset<VibrationMode>>& mode_datasets();
/// One entry per mode and rate of turning, where there is a Campbell diagram.
const std::vector<RecordDataset<CampbellPoint>>& campbell_datasets();
/// One entry per critical speed, where any were found.
const std::vector<RecordDataset<CriticalSpeed>>& critical_speed_datasets();
/// One entry per rate of turning, where a response was asked for.
const std::vector<RecordDataset<ForcedResponse>>& response_datasets();

/// Writes a file, which takes its name once it is sound. Throws ResultError where it cannot be
/// written.
void write_modes(const std::filesystem::path& path, const ModesResult& result,
                 Existing existing = Existing::replace);

/// Whether a file is one of modes of vibration. Throws ResultError where it is no result file.
bool holds_modes(const std::filesystem::path& path);

/// Throws ResultError where the file is not one of modes of vibration.
ModesResult read_modes(const std::filesystem::path& path);

}  // namespace drillstrand
