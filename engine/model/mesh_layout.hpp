/// Where the nodes of a mesh lie along the string.
#pragma once

#include <vector>

#include "model/string_layout.hpp"

namespace drillstrand {

/// Arc lengths of nodes (m), from 0 to the string's: even, or at its places with segments of gently
/// changing length between (engine/model/README.md, "Mesh"). Throws std::invalid_argument where
/// that takes more segments than are allowed.
std::vector<double> node_places(const StringCase& string, const StringLayout& layout,
                                const MeshCase& mesh);

}  // namespace drillstrand
