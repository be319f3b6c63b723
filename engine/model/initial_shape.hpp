/// The shape in which a string starts.
#pragma once

#include <vector>

#include "drillstrand/scene.hpp"

namespace drillstrand {

/// Strains of the segments at time 0, from the scene's mesh, well and head pose. Coaxial: along the
/// well's axis, or straight where there is no well, without stretch, shear or twist. Stress-free:
/// the string's own shape. The uniform strain of `initial` is added.
std::vector<Vector6> initial_strains(const Scene& scene, const InitialCase& initial);

/// The same shape as nodes and directors, from the scene's initial strains too.
InitialNodes initial_nodes(const Scene& scene, const InitialCase& initial);

}  // namespace drillstrand
