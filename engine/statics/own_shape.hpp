/// What the stress-free curvature of a segment adds to its forces: engine/statics/README.md, "Own
/// shape".
#pragma once

#include "statics/rod_segment.hpp"

namespace drillstrand {

/// Nothing where the segment is straight by itself.
class OwnShape {
  public:
    explicit OwnShape(const RodSegment& segment);

    /// What the segment is twisted by its own deviation where shear takes part of the chord's
    /// (rad), and its derivatives by (u_b - u_a, w_a, w_b).
    [[nodiscard]] double twist() const;
    [[nodiscard]] Vector9 gradient_of_twist() const;

    /// Adds forces and energy at this torque (N m).
    void add_to(SegmentForces& forces, double torque) const;
    /// Adds the derivatives of (force on b, couples) by (u_b - u_a, w_a, w_b), the torque held.
    void add_to(Matrix9& tangent, double torque) const;

  private:
    const RodSegment& segment_;
    bool is_bent_;
};

}  // namespace drillstrand
