/// The Hessian of the straight rod in one bending plane. Equations: engine/statics/README.md.
#pragma once

#include <cstddef>

#include "drillstrand/buckling.hpp"
#include "statics/tridiagonal.hpp"

namespace drillstrand {

class BendingPlane {
  public:
    /// The rod must outlive the plane.
    explicit BendingPlane(const StraightRod& rod) : rod_(rod) {}

    [[nodiscard]] std::size_t segments() const { return rod_.length.size(); }

    /// Axial force of a segment, tension positive (N).
    [[nodiscard]] double tension(std::size_t segment, double load) const {
        return rod_.weight_below[segment] - load;
    }

    /// Length of a segment under its axial force, divided by its unstressed length.
    [[nodiscard]] double stretch(std::size_t segment, double load) const {
        return 1 + tension(segment, load) / rod_.axial_stiffness[segment];
    }

    /// Number of negative eigenvalues of the Hessian under a load: by Sylvester's law that of
    /// negative pivots of its factorisation in the bending strains, from the tip to the head.
    [[nodiscard]] std::size_t negative_eigenvalues(double load) const;

    /// The Hessian in the rotations of nodes 1..N, shear condensed (N m).
    [[nodiscard]] SymmetricTridiagonal stiffness(double load) const;

  private:
    /// Coefficients of the mean square of a segment's rotation, and of the square of its middle's
    /// rotation, in twice its energy per length (N).
    struct AxialTerms {
        double mean_square = 0;
        double middle_square = 0;
    };
    [[nodiscard]] AxialTerms axial_terms(std::size_t segment, double load) const;

    const StraightRod& rod_;
};

}  // namespace drillstrand
