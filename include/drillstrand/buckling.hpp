/// Buckling of the straight string: critical loads and modes of the discrete rod, clamped at the
/// head, under its weight and a dead axial load at the tip. Theory: engine/statics/README.md.
#pragma once

#include <cstddef>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

/// What the tip node weighs: the half segment that belongs to it, or a whole one as in the paper,
/// which hangs half a segment too much on the string.
enum class TipWeight { half, full };

/// The straight string as buckling sees it: one value per segment, head to bit.
struct StraightRod {
    std::vector<double> length;             ///< m
    std::vector<double> axial_stiffness;    ///< N
    std::vector<double> shear_stiffness;    ///< N
    std::vector<double> bending_stiffness;  ///< N m2
    std::vector<double> weight_below;  ///< of the nodes below, along the rod; tension positive (N)
};

/// The string of a scene, straight along the scene's head. Buoyed weight counts with its component
/// along the rod; the well is left out. Throws std::invalid_argument where a component is bent or
/// twisted when unstressed.
StraightRod straight_rod(const Scene& scene, TipWeight tip_weight);

/// A way out of the straight shape.
struct BucklingMode {
    double load = 0;              ///< dead compressive load at the tip, above weight (N)
    std::vector<Vector6> strain;  ///< N: change of (k3, k1, k2, g3, g1, g2), 1/m and 1, scaled so
                                  ///< that the largest deflection is 1 m
};

/// Number of modes of the rod whose load compresses no segment by half of its length or more:
/// twice the number of segments, but for stocky rods. Throws std::invalid_argument where weight
/// stretches a segment so far that loads cannot be ordered (by about half of kGA).
std::size_t count_buckling_modes(const StraightRod& rod);

/// The first `count` modes, at most count_buckling_modes(), in ascending order of their loads.
/// Modes come in pairs of one load: the first bends about d1 (k1, with shear g2), the second about
/// d2 (k2, with shear g1).
std::vector<BucklingMode> buckling_modes(const StraightRod& rod, std::size_t count);

}  // namespace drillstrand
