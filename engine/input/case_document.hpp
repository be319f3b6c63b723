/// A case file as a TOML document, overrides applied.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drillstrand {

struct CaseDocument {
    toml::table root;  ///< every key and value keeps its place
    std::string text;  ///< as read; written anew, without comments, where there are overrides
};

/// Throws InputError where the file cannot be read or is not TOML, or an override has no place.
CaseDocument load_case_document(const std::filesystem::path& path,
                                const std::vector<std::pair<std::string, std::string>>& overrides);

/// Whether the "file" of a source region is an override, which has no line and column.
bool is_override_source(std::string_view file);

}  // namespace drillstrand
