/// Buckling of the straight string: critical loads and modes of the discrete rod, clamped at the
/// head, under its weight and a dead axial load at the tip, and the ways out of the straight shape
/// under a given load. Theory: engine/statics/README.md.
#pragma once

#include <cstddef>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

/// What a segment is between its nodes, and what the nodes weigh.
enum class Discretisation {
    beam_column,  ///< the exact beam-column; nodes weigh their cells
    paper,        ///< constant strain; the tip weighs a whole segment, half of one too much
};

/// "beam-column" or "paper".
constexpr const char* discretisation_name(Discretisation discretisation) {
    return discretisation == Discretisation::paper ? "paper" : "beam-column";
}

/// The straight string as buckling sees it: one value per segment, head to bit.
struct StraightRod {
    std::vector<double> length;             ///< m
    std::vector<double> axial_stiffness;    ///< N
    std::vector<double> shear_stiffness;    ///< N
    std::vector<double> bending_stiffness;  ///< N m2
    std::vector<double> weight_below;  ///< of the nodes below, along the rod; tension positive (N)
    Discretisation discretisation = Discretisation::beam_column;
};

/// The string of a scene, straight along the scene's head. Buoyed weight counts with its component
/// along the rod; the well is left out. Throws std::invalid_argument where a component is bent or
/// twisted when unstressed.
StraightRod straight_rod(const Scene& scene, Discretisation discretisation);

/// A way out of the straight shape.
struct BucklingMode {
    double load = 0;              ///< dead compressive load at the tip, above weight (N)
    std::vector<Vector6> strain;  ///< N: change of (k3, k1, k2, g3, g1, g2) in the middle of each
                                  ///< segment, 1/m and 1, scaled so that the largest deflection is
                                  ///< 1 m
};

/// The load up to which the rod's mesh can tell its modes: it compresses no segment to half of its
/// length nor, in a beam-column, by more than what buckles it between two nodes that do not turn
/// (N). Throws std::invalid_argument where the weight of a rod of the paper stretches a segment so
/// far that loads cannot be ordered (by about half of kGA).
double highest_buckling_load(const StraightRod& rod);

/// Number of modes of the rod below highest_buckling_load(), which throws as it does: twice the
/// number of segments, but for stocky rods, and for heavy ones on coarse meshes.
std::size_t count_buckling_modes(const StraightRod& rod);

/// The first `count` modes, at most count_buckling_modes(), in ascending order of their loads.
/// Modes come in pairs of one load: the first bends about d1 (k1, with shear g2), the second about
/// d2 (k2, with shear g1).
std::vector<BucklingMode> buckling_modes(const StraightRod& rod, std::size_t count);

/// A shape in which the straight rod gives way under a load above critical.
struct UnstableMode {
    /// Negative eigenvalue of the Hessian: the energy of the shape is half of it times the integral
    /// of the squared curvature (N m2). The bending stiffness, where there is neither load nor
    /// weight.
    double eigenvalue = 0;
    std::vector<Vector6> strain;  ///< as BucklingMode has it
};

/// The unstable shapes of a rod under a load.
struct Instability {
    double load = 0;                  ///< dead, compressive, at the tip, above weight (N)
    std::vector<UnstableMode> modes;  ///< in pairs as BucklingMode, by ascending eigenvalue
};

/// As many shapes as there are modes of lower load. Throws std::invalid_argument where the load is
/// none below highest_buckling_load().
Instability find_instability(const StraightRod& rod, double load);

}  // namespace drillstrand
