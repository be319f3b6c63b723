/// The case that a command is about.
#pragma once

#include <filesystem>

#include "commands.hpp"
#include "drillstrand/case.hpp"

namespace drillstrand::program {

/// read_case(), with what it warns of said to the user.
Case case_of(const std::filesystem::path& path, const Overrides& overrides);

}  // namespace drillstrand::program
