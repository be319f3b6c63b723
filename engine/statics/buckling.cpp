#include "statics/buckling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "drillstrand/drill_string.hpp"
#include "model/stability_functions.hpp"

namespace drillstrand {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;

/// A segment under its axial force.
struct LoadedSegment {
    double length = 0;   ///< h (m)
    double bending = 0;  ///< EI (N m2)
    double shear = 0;    ///< kGA (N)
    double tension = 0;  ///< T (N)
    double stretch = 0;  ///< 1 + T/EA

    LoadedSegment(const StraightRod& rod, std::size_t segment, double load)
        : length(rod.length[segment]),
          bending(rod.bending_stiffness[segment]),
          shear(rod.shear_stiffness[segment]),
          tension(rod.weight_below[segment] - load),
          stretch(1 + tension / rod.axial_stiffness[segment]) {}
};

/// k = 1/(1 + 12 EI/(kGA h^2)): share of bending in what a segment gives between ends that do not
/// turn.
double bending_share(double bending, double shear, double length) {
    return 1 / (1 + 12 * bending / (shear * length * length));
}

/// The segment of constant strain, whose rotation is linear in arc length.
PlaneSegment constant_strain(const LoadedSegment& segment, double eigenvalue) {
    const auto& [h, stiffness, shear, tension, stretch] = segment;
    const double slope = stretch - tension / shear;  // of the chord, over m
    PlaneSegment plane;
    plane.bending = (stiffness - eigenvalue) / h + h * tension * stretch / 12;
    plane.turning = h * tension * slope;
    plane.advance = h * slope;
    plane.middle_curvature = 1 / h;
    plane.middle_shear = tension / shear;
    return plane;
}

/// Shares of the middle in an exact beam-column, where EI t'' = (T (1 + T/EA) - T^2/kGA) t: with
/// the argument x^2 = t''/t (h/2)^2, h times the curvature there over b and the rotation over m.
struct MiddleShares {
    double curvature = 1;
    double rotation = 1;

    explicit MiddleShares(double square) {
        const double x = std::sqrt(std::abs(square));
        if (x < 1e-8) return;  // x^2 is below rounding
        curvature = x / (square > 0 ? std::sinh(x) : std::sin(x));
        rotation = 1 / (square > 0 ? std::cosh(x) : std::cos(x));
    }
};

/// The exact beam-column (engine/model/segment_strain.hpp) to second order. Its squared curvature
/// is that of the cubic between the nodes.
PlaneSegment beam_column(const LoadedSegment& segment, double eigenvalue) {
    const auto& [h, stiffness, shear, tension, stretch] = segment;
    const StabilityFunctions stability(tension * h * h / stiffness);
    const double share = bending_share(stiffness, shear, h);
    const double along = h * tension * stretch;  // of the chord's turn squared
    const double bend = ((1 + stability.symmetric) * stiffness - eigenvalue) / h;
    const double lean = 12 * share * (stability.antisymmetric * stiffness - share * eigenvalue) / h;
    const double deviation = along / 5 + lean;  // of the square of the chord's turn off m
    const double slope = deviation / (along + deviation);
    const MiddleShares middle(tension * (stretch - tension / shear) * h * h /
                              (4 * (stiffness - eigenvalue)));
    PlaneSegment plane;
    plane.bending = along / 12 + bend;
    plane.turning = along * slope;
    plane.advance = h * stretch * slope;
    plane.middle_curvature = middle.curvature / h;
    plane.middle_shear = tension / shear * middle.rotation;
    return plane;
}

/// Weight of nodes 1..N per unit of their weight per length (m).
std::vector<double> weighing_lengths(const StringMesh& mesh, Discretisation discretisation) {
    std::vector<double> lengths(mesh.cell.begin() + 1, mesh.cell.end());
    if (discretisation == Discretisation::beam_column) return lengths;
    for (std::size_t i = 0; i + 1 < lengths.size(); ++i)
        lengths[i] = (mesh.length[i] + mesh.length[i + 1]) / 2;
    lengths.back() = mesh.length.back();
    return lengths;
}

/// Loads between which the Hessian falls steadily as the load grows, so that each of its
/// eigenvalues passes through zero once.
struct LoadRange {
    double low = 0;   ///< N; no segment is compressed, and the Hessian is positive
    double high = 0;  ///< N
};

/// Compression up to which the energy of a segment falls as it grows (N): to half of the length.
/// That of a beam-column must also have a least deflection, lest the rod buckles between two nodes:
/// 6/5 z (1 + T/EA) + 12 k r_a > 0. As r_a falls from 1 to pi^2/10 at z = -pi^2, z > -k pi^2
/// suffices: half a wave per segment, less by shear.
double compression_limit(const StraightRod& rod, std::size_t segment) {
    const double halving = rod.axial_stiffness[segment] / 2;
    if (rod.discretisation == Discretisation::paper) return halving;
    const double h = rod.length[segment];
    const double stiffness = rod.bending_stiffness[segment];
    const double share = bending_share(stiffness, rod.shear_stiffness[segment], h);
    return std::min(halving, share * pi * pi * stiffness / (h * h));
}

/// Tension stiffens a beam-column whatever it is; a segment of constant strain may be too soft
/// against shear.
void refuse_too_much_tension(const StraightRod& rod, double low) {
    if (rod.discretisation == Discretisation::beam_column) return;
    for (std::size_t i = 0; i < rod.length.size(); ++i) {
        const double softening = 1 / rod.shear_stiffness[i] - 1 / rod.axial_stiffness[i];
        if ((rod.weight_below[i] - low) * softening >= 0.5)
            throw std::invalid_argument(
                "the string's own weight is of the size of its shear stiffness; critical loads "
                "need a stiffer or a lighter string");
    }
}

LoadRange load_range(const StraightRod& rod) {
    LoadRange range{std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < rod.length.size(); ++i) {
        range.low = std::min(range.low, rod.weight_below[i]);
        range.high = std::min(range.high, rod.weight_below[i] + compression_limit(rod, i));
    }
    refuse_too_much_tension(rod, range.low);
    return range;
}

/// Where a condition that fails at `low` and holds at `high` comes to hold, to rounding.
template <class Condition>
double bisect(double low, double high, Condition&& holds) {
    for (;;) {
        const double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) return middle;
        (holds(middle) ? high : low) = middle;
    }
}

/// The load at which eigenvalue number `index` of the Hessian passes through zero.
double critical_load(const StraightRod& rod, std::size_t index, LoadRange range) {
    return bisect(range.low, range.high,
                  [&](double load) { return BendingPlane(rod, load).eigenvalues_below() > index; });
}

/// A value below all eigenvalues under a load (N m2).
double eigenvalue_bound(const StraightRod& rod, double load) {
    double bound = -*std::max_element(rod.bending_stiffness.begin(), rod.bending_stiffness.end());
    while (BendingPlane(rod, load, bound).eigenvalues_below() > 0)
        bound *= 2;
    return bound;
}

/// Negative eigenvalue number `index`, counted from the lowest, whose bound is given.
double eigenvalue(const StraightRod& rod, double load, std::size_t index, double bound) {
    return bisect(bound, 0, [&](double value) {
        return BendingPlane(rod, load, value).eigenvalues_below() > index;
    });
}

/// Rotations of nodes 0..N that a singular plane does not resist: inverse iteration, whose every
/// step damps all others by many orders of magnitude.
Eigen::VectorXd free_rotation(const BendingPlane& plane) {
    constexpr int iterations = 4;
    const TridiagonalFactors factors(plane.stiffness());
    const auto segments = static_cast<Eigen::Index>(plane.segments().size());
    Eigen::VectorXd nodes(segments);
    for (Eigen::Index k = 0; k < segments; ++k)
        nodes[k] = std::sin(static_cast<double>(k * k + 1));  // irregular: no mode is missing
    for (int i = 0; i < iterations; ++i)
        nodes = factors.solve(nodes).normalized();
    Eigen::VectorXd rotation(segments + 1);
    rotation << 0, nodes;
    return rotation;
}

/// Strains of one plane, in the middles of segments.
struct PlaneStrain {
    std::vector<double> bending;  ///< 1/m
    std::vector<double> shear;
};

/// The shape that a singular plane does not resist, scaled so that the largest deflection is 1 m.
PlaneStrain free_shape(const BendingPlane& plane) {
    const Eigen::VectorXd rotation = free_rotation(plane);
    PlaneStrain strain;
    double deflection = 0;
    double largest = 0;
    Eigen::Index node = 0;
    for (const PlaneSegment& segment : plane.segments()) {
        const double mean = 0.5 * (rotation[node] + rotation[node + 1]);
        const double bend = rotation[node + 1] - rotation[node];
        strain.bending.push_back(segment.middle_curvature * bend);
        strain.shear.push_back(segment.middle_shear * mean);
        deflection += segment.advance * mean;
        if (std::abs(deflection) > std::abs(largest)) largest = deflection;
        ++node;
    }
    for (std::size_t i = 0; i < strain.bending.size(); ++i) {
        strain.bending[i] /= largest;
        strain.shear[i] /= largest;
    }
    return strain;
}

/// All six strains. A turn about d1 tilts d3 against d2, one about d2 tilts it along d1; signs are
/// such that the largest deflection is along d2 and along d1.
std::vector<Vector6> about_d1(const PlaneStrain& plane) {
    std::vector<Vector6> strain;
    for (std::size_t i = 0; i < plane.bending.size(); ++i)
        strain.push_back({0, -plane.bending[i], 0, 0, 0, -plane.shear[i]});
    return strain;
}

std::vector<Vector6> about_d2(const PlaneStrain& plane) {
    std::vector<Vector6> strain;
    for (std::size_t i = 0; i < plane.bending.size(); ++i)
        strain.push_back({0, 0, plane.bending[i], 0, -plane.shear[i], 0});
    return strain;
}

}  // namespace

BendingPlane::BendingPlane(const StraightRod& rod, double load, double eigenvalue) {
    const auto plane_segment =
        rod.discretisation == Discretisation::paper ? constant_strain : beam_column;
    segments_.reserve(rod.length.size());
    for (std::size_t i = 0; i < rod.length.size(); ++i)
        segments_.push_back(plane_segment(LoadedSegment(rod, i, load), eigenvalue));
}

std::size_t BendingPlane::eigenvalues_below() const {
    std::size_t negative = 0;
    double below = 0;  // rotational stiffness of all below the segment, at its lower node (N m)
    for (auto segment = segments_.rbegin(); segment != segments_.rend(); ++segment) {
        // Twice the energy in the rotation of the upper node and the segment's bend.
        const double rotation = below + segment->turning;
        const double mixed = below + segment->turning / 2;
        double bend = below + segment->bending + segment->turning / 4;
        if (bend == 0) bend = epsilon * (std::abs(below) + std::abs(segment->bending));
        if (bend < 0) ++negative;
        below = rotation - mixed * (mixed / bend);
    }
    return negative;
}

SymmetricTridiagonal BendingPlane::stiffness() const {
    const auto size = static_cast<Eigen::Index>(segments_.size());
    SymmetricTridiagonal matrix{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size - 1)};
    for (Eigen::Index lower = 0; lower < size; ++lower) {  // unknown of the segment's lower node
        const PlaneSegment& segment = segments_[static_cast<std::size_t>(lower)];
        const double own = segment.bending + segment.turning / 4;
        matrix.diagonal[lower] += own;
        if (lower == 0) continue;  // its upper node is clamped
        matrix.diagonal[lower - 1] += own;
        matrix.off_diagonal[lower - 1] = segment.turning / 4 - segment.bending;
    }
    return matrix;
}

StraightRod straight_rod(const Scene& scene, Discretisation discretisation) {
    const StringMesh& mesh = scene.mesh;
    // A direction given by angles misses the horizontal by rounding.
    const double along = scene.down.dot(scene.head_frame.col(0));
    const double slope = std::abs(along) < 1e-12 ? 0 : along;  // 1: hanging
    const std::vector<double> weighing = weighing_lengths(mesh, discretisation);
    StraightRod rod;
    rod.discretisation = discretisation;
    rod.length = mesh.length;
    rod.weight_below.resize(mesh.length.size());
    double weight = 0;
    for (std::size_t i = mesh.length.size(); i-- > 0;) {
        weight += scene.weight[i + 1] * weighing[i] * slope;
        rod.weight_below[i] = weight;
    }
    for (const SectionProperties& segment : mesh.segment) {
        if (segment.curvature.norm() > 0)
            throw std::invalid_argument(
                "a component is bent or twisted when unstressed, so that the string cannot be "
                "straight; buckling needs curvature = [0, 0, 0] in all of them");
        rod.axial_stiffness.push_back(segment.axial_stiffness);
        rod.shear_stiffness.push_back(segment.shear_stiffness);
        rod.bending_stiffness.push_back(segment.bending_stiffness);
    }
    return rod;
}

double highest_buckling_load(const StraightRod& rod) {
    return load_range(rod).high;
}

std::size_t count_buckling_modes(const StraightRod& rod) {
    return 2 * BendingPlane(rod, load_range(rod).high).eigenvalues_below();
}

std::vector<BucklingMode> buckling_modes(const StraightRod& rod, std::size_t count) {
    const LoadRange range = load_range(rod);
    if (count > count_buckling_modes(rod))
        throw std::invalid_argument("the rod has fewer buckling modes");
    std::vector<BucklingMode> modes;
    for (std::size_t pair = 0; modes.size() < count; ++pair) {
        const double load = critical_load(rod, pair, range);
        const PlaneStrain strain = free_shape(BendingPlane(rod, load));
        modes.push_back({load, about_d1(strain)});
        if (modes.size() < count) modes.push_back({load, about_d2(strain)});
    }
    return modes;
}

Instability find_instability(const StraightRod& rod, double load) {
    if (!(load < highest_buckling_load(rod)))
        throw std::invalid_argument("the rod's mesh cannot tell its modes under such a load");
    Instability instability{load, {}};
    const std::size_t pairs = BendingPlane(rod, load).eigenvalues_below();
    const double bound = eigenvalue_bound(rod, load);
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        const double value = eigenvalue(rod, load, pair, bound);
        const PlaneStrain strain = free_shape(BendingPlane(rod, load, value));
        instability.modes.push_back({value, about_d1(strain)});
        instability.modes.push_back({value, about_d2(strain)});
    }
    return instability;
}

}  // namespace drillstrand
