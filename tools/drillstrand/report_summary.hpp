/// The numbers of a run that a page prints in words: from the whole result, not from what of it is
/// drawn.
#pragma once

#include <string>
#include <vector>

#include "drillstrand/result_file.hpp"

namespace drillstrand::program {

/// JSON of {text, good}: how the run ended.
std::string status_json(const std::string& status);

/// JSON list of {id, label, si, field}: what one looks for first.
std::string tiles_json(const Result& result);

/// JSON list of {title, items}: everything else.
std::string facts_json(const Result& result);

/// What to know before believing the pictures.
std::vector<std::string> warnings_of(const Result& result);

}  // namespace drillstrand::program
