/// The right-hand side of the strand equations, one node and one segment at a time: a second
/// implementation, written from engine/rod/README.md without a look at speed, for the vector
/// kernels to be held against.
#pragma once

#include <vector>

#include "drillstrand/scene.hpp"
#include "model/pose.hpp"

namespace drillstrand::test {

/// Momenta of N+1 nodes and stresses of N segments, or their rates.
struct PlainState {
    std::vector<Vector6> momentum;
    std::vector<Vector6> stress;
};

/// Stresses that the outside imposes at the two ends (body axes).
struct EndStress {
    Vector6 head = Vector6::Zero();
    Vector6 bit = Vector6::Zero();
};

struct PlainRates {
    PlainState rate;
    double damping_power = 0;  ///< of D_in and D_ex on the rod (W)
};

/// Poses of all nodes by the matrix exponential of 4 x 4 screw matrices.
std::vector<Pose> plain_poses(const Scene& scene, const Pose& head,
                              const std::vector<Vector6>& stress);

/// Rates of a rod without a well whose ends are both free to move.
PlainRates plain_rates(const Scene& scene, const Pose& head, const PlainState& state,
                       const EndStress& ends);

/// V = M^-1 P of a node, and A^-1 S of a segment.
Vector6 plain_velocity(const Scene& scene, std::size_t node, const Vector6& momentum);
Vector6 plain_strain_change(const Scene& scene, std::size_t segment, const Vector6& stress);

}  // namespace drillstrand::test
