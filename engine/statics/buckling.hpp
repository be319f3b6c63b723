/// The Hessian of the straight rod in one bending plane. Equations: engine/statics/README.md.
#pragma once

#include <cstddef>
#include <vector>

#include "drillstrand/buckling.hpp"
#include "statics/tridiagonal.hpp"

namespace drillstrand {

/// A segment in the rotations of its two ends, by their difference b and their mean m. Its
/// deflection is condensed, as nothing pulls on nodes across the rod.
struct PlaneSegment {
    double bending = 0;           ///< coefficient of b^2 in twice the energy (N m)
    double turning = 0;           ///< coefficient of m^2 (N m)
    double advance = 0;           ///< deflection from end to end over m (m)
    double middle_curvature = 0;  ///< curvature in the middle over b (1/m)
    double middle_shear = 0;      ///< shear in the middle over m
};

/// The Hessian of the rod under a load, less a multiple of the integral of the squared curvature:
/// singular where the multiple is an eigenvalue.
class BendingPlane {
  public:
    /// Load in N; eigenvalue in N m2, at most 0.
    BendingPlane(const StraightRod& rod, double load, double eigenvalue = 0);

    /// N, head to tip.
    [[nodiscard]] const std::vector<PlaneSegment>& segments() const { return segments_; }

    /// Number of eigenvalues below the given one: by Sylvester's law that of negative pivots of the
    /// factorisation in the bends b of segments, from the tip to the head.
    [[nodiscard]] std::size_t eigenvalues_below() const;

    /// In the rotations of nodes 1..N (N m).
    [[nodiscard]] SymmetricTridiagonal stiffness() const;

  private:
    std::vector<PlaneSegment> segments_;
};

}  // namespace drillstrand
