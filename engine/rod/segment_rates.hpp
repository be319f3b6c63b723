/// How fast the segments of the leapfrog's rod move their nodes: engine/integrators/README.md,
/// "Step".
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "drillstrand/scene.hpp"

namespace drillstrand {

/// What a segment may bear in a run and that stiffens it.
struct ExpectedLoad {
    double tension = 0;  ///< N, not negative
    double bend = 0;     ///< angle between its directors
};

/// Tension by weight and by loads on the ends. Bends of the start, of the well's axis and of the
/// string's own shape, and those that loads may add: in a well a helix of its clearance, elsewhere
/// a rod clamped at its head, at rest.
std::vector<ExpectedLoad> expected_loads(const Scene& scene);

/// Bounds of the rates (1/s) of motions in which a segment has a part. The rod as a whole has none
/// faster than the fastest of its segments, each with its share of what is lumped at its nodes
/// (Irons and Treharne 1971).
struct SegmentRates {
    double axial;      ///< of stretch alone
    double torsional;  ///< of twist alone
    double any;        ///< of all motions, with what bends couple
};
inline double fastest(const SegmentRates& rates) {
    return std::max({rates.axial, rates.torsional, rates.any});
}
SegmentRates segment_rates(const Scene& scene, std::size_t segment, const ExpectedLoad& load);

}  // namespace drillstrand
