/// What of the string whirls, and what its spin holds. Definitions: engine/rod/README.md, "Whirl".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "forces/surroundings.hpp"

namespace drillstrand {

/// How a node moves.
struct NodeVelocity {
    Eigen::Vector3d linear;  ///< m/s, space frame
    double spin;             ///< rad/s about d3
};

/// Shares, rates and place of the whirl of nodes with these contacts and velocities.
Whirl whirl_of(const Scene& scene, const std::vector<NodeContact>& contacts,
               const std::vector<NodeVelocity>& velocities);

/// Rate of each node around the well's axis, positive with its spin; 0 where it does not whirl
/// (rad/s).
std::vector<double> whirl_rates(const std::vector<NodeContact>& contacts,
                                const std::vector<NodeVelocity>& velocities);

/// Kinetic energy of the spin of all nodes about d3 (J).
double rotation_energy(const Scene& scene, const std::vector<NodeVelocity>& velocities);

}  // namespace drillstrand
