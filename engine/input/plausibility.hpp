/// Numbers that are possible and that no engineer means: a unit left out, a list upside down.
#pragma once

#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "input/case_sections.hpp"

namespace drillstrand {

/// A line for each of them, "FILE:LINE:COL: KEY is VALUE, ...; did you mean ...?", of a case that
/// is read: of `root`, its document, and of its string.
std::vector<std::string> implausible_numbers(const toml::table& root, const Case& input,
                                             const StringInput& string);

}  // namespace drillstrand
