/// Where a command writes its result.
#pragma once

#include <filesystem>

namespace drillstrand::program {

/// The output as the user names it. Throws UsageError where it is the standard output or the case
/// file.
std::filesystem::path checked_output(const std::filesystem::path& output,
                                     const std::filesystem::path& case_path);

}  // namespace drillstrand::program
