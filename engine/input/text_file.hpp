/// Reading whole text files.
#pragma once

#include <filesystem>
#include <string>

#include "drillstrand/error.hpp"

namespace drillstrand {

/// The bytes of a regular file of at most 64 MiB; never waits. Throws InputError at `asked_at`
/// ("cannot read WHAT ...") where there is no such file, it is a directory, pipe, socket or device,
/// cannot be opened or is larger than any case or table.
std::string read_text_file(const std::filesystem::path& path, const SourceLocation& asked_at);

}  // namespace drillstrand
