/// Surveys in WITSML: the stations of a trajectory.
#pragma once

#include <filesystem>
#include <memory>

#include "drillstrand/error.hpp"
#include "input/station_source.hpp"

namespace drillstrand {

/// Stations in order of measured depth, whatever their order in the file, which WITSML leaves open.
/// Throws InputError where the file is not as it should be.
std::unique_ptr<StationSource> open_trajectory(const std::filesystem::path& path,
                                               const SourceLocation& asked_at);

}  // namespace drillstrand
