/// Survey tables: measured depth, inclination and azimuth of the stations.
#pragma once

#include <filesystem>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"

namespace drillstrand {

/// Stations in SI. Throws InputError at the field where the table is wrong, at `asked_at` (the key
/// that names the file) where it cannot be read.
std::vector<SurveyStation> read_survey(const std::filesystem::path& path,
                                       const SourceLocation& asked_at);

}  // namespace drillstrand
