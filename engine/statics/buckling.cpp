#include "statics/buckling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "drillstrand/drill_string.hpp"

namespace drillstrand {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Loads between which the Hessian falls steadily as the load grows, so that each of its
/// eigenvalues passes through zero once: from where no segment is compressed to where one is to
/// half its length.
struct LoadRange {
    double low = 0;   ///< N; the Hessian is positive there
    double high = 0;  ///< N
};

LoadRange load_range(const StraightRod& rod) {
    LoadRange range{std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < rod.length.size(); ++i) {
        range.low = std::min(range.low, rod.weight_below[i]);
        range.high = std::min(range.high, rod.weight_below[i] + rod.axial_stiffness[i] / 2);
    }
    for (std::size_t i = 0; i < rod.length.size(); ++i) {
        const double softening = 1 / rod.shear_stiffness[i] - 1 / rod.axial_stiffness[i];
        if ((rod.weight_below[i] - range.low) * softening >= 0.5)
            throw std::invalid_argument(
                "the string's own weight is of the size of its shear stiffness; critical loads "
                "need a stiffer or a lighter string");
    }
    return range;
}

/// The load at which eigenvalue number `index` of the Hessian passes through zero, to rounding.
double critical_load(const BendingPlane& plane, std::size_t index, LoadRange range) {
    for (;;) {
        const double middle = range.low + 0.5 * (range.high - range.low);
        if (middle <= range.low || middle >= range.high) return middle;
        (plane.negative_eigenvalues(middle) > index ? range.high : range.low) = middle;
    }
}

/// Rotations of nodes 0..N in the mode of a critical load: inverse iteration, whose every step
/// damps the other modes by many orders of magnitude.
Eigen::VectorXd mode_rotation(const BendingPlane& plane, double load) {
    constexpr int iterations = 4;
    const TridiagonalFactors factors(plane.stiffness(load));
    const auto segments = static_cast<Eigen::Index>(plane.segments());
    Eigen::VectorXd nodes(segments);
    for (Eigen::Index k = 0; k < segments; ++k)
        nodes[k] = std::sin(static_cast<double>(k * k + 1));  // irregular: no mode is missing
    for (int i = 0; i < iterations; ++i)
        nodes = factors.solve(nodes).normalized();
    Eigen::VectorXd rotation(segments + 1);
    rotation << 0, nodes;
    return rotation;
}

/// Strains of one plane whose deflection grows by stretch x rotation - shear per length.
struct PlaneStrain {
    std::vector<double> bending;  ///< 1/m
    std::vector<double> shear;
};

/// From rotations, scaled so that the largest deflection is 1 m.
PlaneStrain plane_strain(const StraightRod& rod, const BendingPlane& plane, double load,
                         const Eigen::VectorXd& rotation) {
    PlaneStrain strain;
    double deflection = 0;
    double largest = 0;
    for (std::size_t i = 0; i < plane.segments(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const double middle = 0.5 * (rotation[k] + rotation[k + 1]);
        strain.bending.push_back((rotation[k + 1] - rotation[k]) / rod.length[i]);
        strain.shear.push_back(plane.tension(i, load) / rod.shear_stiffness[i] * middle);
        deflection += rod.length[i] * (plane.stretch(i, load) * middle - strain.shear.back());
        if (std::abs(deflection) > std::abs(largest)) largest = deflection;
    }
    for (std::size_t i = 0; i < plane.segments(); ++i) {
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

BendingPlane::AxialTerms BendingPlane::axial_terms(std::size_t segment, double load) const {
    const double force = tension(segment, load);
    return {force * stretch(segment, load), -force * force / rod_.shear_stiffness[segment]};
}

std::size_t BendingPlane::negative_eigenvalues(double load) const {
    std::size_t negative = 0;
    double below = 0;  // rotational stiffness of all below the segment, at its lower node (N m)
    for (std::size_t i = segments(); i-- > 0;) {
        const double h = rod_.length[i];
        const auto [mean_square, middle_square] = axial_terms(i, load);
        // Twice the energy in the rotation of the upper node and the segment's bending strain.
        const double rotation = below + h * (mean_square + middle_square);
        const double mixed = h * (below + h * (mean_square + middle_square) / 2);
        double bending = h * (rod_.bending_stiffness[i] +
                              h * (below + h * (mean_square / 3 + middle_square / 4)));
        if (bending == 0) bending = epsilon * h * rod_.bending_stiffness[i];
        if (bending < 0) ++negative;
        below = rotation - mixed * (mixed / bending);
    }
    return negative;
}

SymmetricTridiagonal BendingPlane::stiffness(double load) const {
    const auto size = static_cast<Eigen::Index>(segments());
    SymmetricTridiagonal matrix{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size - 1)};
    for (std::size_t i = 0; i < segments(); ++i) {
        const double h = rod_.length[i];
        const auto [mean_square, middle_square] = axial_terms(i, load);
        const double bending = rod_.bending_stiffness[i] / h;
        const double own = bending + h * (mean_square / 3 + middle_square / 4);
        const auto lower = static_cast<Eigen::Index>(i);  // unknown of node i + 1
        matrix.diagonal[lower] += own;
        if (i == 0) continue;  // its upper node is clamped
        matrix.diagonal[lower - 1] += own;
        matrix.off_diagonal[lower - 1] = -bending + h * (mean_square / 6 + middle_square / 4);
    }
    return matrix;
}

StraightRod straight_rod(const Scene& scene, TipWeight tip_weight) {
    const StringMesh& mesh = scene.mesh;
    // A direction given by angles misses the horizontal by rounding.
    const double along = scene.down.dot(scene.head_frame.col(0));
    const double slope = std::abs(along) < 1e-12 ? 0 : along;  // 1: hanging
    StraightRod rod;
    rod.length = mesh.length;
    rod.weight_below.resize(mesh.length.size());
    double weight = 0;
    for (std::size_t i = mesh.length.size(); i-- > 0;) {
        const bool is_tip = i + 1 == mesh.length.size();
        const double share = is_tip && tip_weight == TipWeight::full ? 2 : 1;
        weight += share * scene.weight[i + 1] * mesh.cell[i + 1] * slope;
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

std::size_t count_buckling_modes(const StraightRod& rod) {
    return 2 * BendingPlane(rod).negative_eigenvalues(load_range(rod).high);
}

std::vector<BucklingMode> buckling_modes(const StraightRod& rod, std::size_t count) {
    const BendingPlane plane(rod);
    const LoadRange range = load_range(rod);
    if (count > 2 * plane.negative_eigenvalues(range.high))
        throw std::invalid_argument("the rod has fewer buckling modes");
    std::vector<BucklingMode> modes;
    for (std::size_t pair = 0; modes.size() < count; ++pair) {
        const double load = critical_load(plane, pair, range);
        const PlaneStrain strain = plane_strain(rod, plane, load, mode_rotation(plane, load));
        modes.push_back({load, about_d1(strain)});
        if (modes.size() < count) modes.push_back({load, about_d2(strain)});
    }
    return modes;
}

}  // namespace drillstrand
