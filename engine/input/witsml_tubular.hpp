/// Strings in WITSML: the components of a tubular.
#pragma once

#include <filesystem>
#include <vector>

#include "drillstrand/error.hpp"
#include "input/component_reader.hpp"

namespace drillstrand {

/// Head to bit: WITSML numbers components in the sequence in which they enter the hole, bit first.
/// WITSML has no elasticity: it follows from the material, which is steel where none is named.
/// Throws InputError where the file is not as it should be.
std::vector<PlacedComponent> read_tubular(const std::filesystem::path& path,
                                          const SourceLocation& asked_at);

}  // namespace drillstrand
