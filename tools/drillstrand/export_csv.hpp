/// A result as comma-separated values.
#pragma once

#include <filesystem>
#include <vector>

#include "drillstrand/new_file.hpp"
#include "drillstrand/result_file.hpp"

namespace drillstrand::program {

/// Writes series.csv (a row per series time), nodes.csv and segments.csv (a row per profile time
/// and node or segment) and, where the well is known, well.csv into an existing folder. Headers are
/// name[unit]; numbers have the digits that give back the same double. Throws ResultError
/// where a file cannot be written.
void write_csv(const std::filesystem::path& folder, const Result& result, Existing existing);

/// What it would write.
std::vector<std::filesystem::path> csv_files(const std::filesystem::path& folder,
                                             const Result& result);

}  // namespace drillstrand::program
