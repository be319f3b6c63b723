/// Where a command writes its result.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace drillstrand::program {

/// The output as the user names it. Throws UsageError where it is the standard output or the case
/// file.
std::filesystem::path checked_output(const std::filesystem::path& output,
                                     const std::filesystem::path& case_path);

/// What a result file of another command than run and equilibrium holds, in words; none for theirs.
/// Throws ResultError where there is no result file.
std::optional<std::string_view> other_contents(const std::filesystem::path& result);

}  // namespace drillstrand::program
