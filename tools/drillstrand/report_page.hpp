/// The page: template, style, plotting library and script are part of the program
/// (tools/report/), and what the run has to say goes between them.
#pragma once

#include <filesystem>
#include <string>

#include "drillstrand/new_file.hpp"

namespace drillstrand::program {

struct PageContent {
    std::string title;
    std::string metadata;  ///< JSON
    std::string data;      ///< base64
};

/// Writes the page beside `path` and then gives it its name, so that a browser never loads half of
/// one. Throws ResultError where it cannot be written.
void write_page(const std::filesystem::path& path, const PageContent& content, Existing existing);

}  // namespace drillstrand::program
