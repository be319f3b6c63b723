/// A result as comma-separated values.
#pragma once

#include <filesystem>

#include "drillstrand/result_file.hpp"

namespace drillstrand::program {

/// Writes series.csv (a row per series time), nodes.csv and segments.csv (a row per profile time
/// and node or segment) and, where the well is known, well.csv into an existing folder. Headers are
/// name[unit]; numbers have the digits that give back the same double. Throws std::runtime_error
/// where a file cannot be written.
void write_csv(const std::filesystem::path& folder, const Result& result);

}  // namespace drillstrand::program
