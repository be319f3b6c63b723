/// Where a command writes its result.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/new_file.hpp"

namespace drillstrand::program {

/// A file that a command reads, and what it is in words.
struct InputFile {
    std::filesystem::path path;
    std::string_view words;
};

std::vector<InputFile> inputs_of(const Case& input);

/// What may be written over.
struct OutputRules {
    bool overwrite = false;         ///< the option --overwrite: files that drillstrand wrote
    std::vector<InputFile> inputs;  ///< never

    [[nodiscard]] Existing existing() const {
        return overwrite ? Existing::replace : Existing::keep;
    }
};

/// Throws UsageError, naming the option, where a file may not be written: the standard output, an
/// input (also by another name or link), a file that drillstrand did not write, and an older result
/// without --overwrite. An empty path is no file.
void require_output(std::string_view option, const std::filesystem::path& output,
                    const OutputRules& rules);

/// Throws UsageError where two options name one file.
void require_different(std::string_view option, const std::filesystem::path& output,
                       std::string_view other_option, const std::filesystem::path& other);

/// Whether drillstrand wrote a file: results by their attributes, pages and files for ParaView by
/// the mark at their start, tables by the names of their first columns.
bool is_own_file(const std::filesystem::path& path);

}  // namespace drillstrand::program
