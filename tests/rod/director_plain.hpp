/// One step of the director rod (engine/rod/README.md, "Director rod") written node by node, with
/// nothing from the vector kernels: rotations by quaternions and angle-axis, areas by parallel
/// transport, drag by textbooks and a dense solve. Friction of one node is the engine's, held to
/// its own tests in tests/forces.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drillstrand/scene.hpp"
#include "forces/contact.hpp"

namespace drillstrand::test {

struct PlainNode {
    Eigen::Vector3d position, velocity;
    Eigen::Vector3d director, angular_velocity;  ///< the latter normal to the former
    Eigen::Vector3d last_director;               ///< of the step before
    Eigen::Vector3d material;                    ///< d1
    double spin = 0;
    FrictionSpring spring{};
    double depth = 0;       ///< of penetration, at the step before
    double rebounds = 0;    ///< 1 where an impact sent it back and it is still in the wall
    double fluid_mass = 0;  ///< that moves sideways along (kg/m)
};

struct PlainRod {
    std::vector<PlainNode> node;
    std::vector<double> twist;  ///< of the segments
};

/// What the outside does to an end, as the segment beyond it would (N, N m).
struct EndLoad {
    Eigen::Vector3d pull = Eigen::Vector3d::Zero();
    Eigen::Vector3d couple = Eigen::Vector3d::Zero();
};

/// What a step did besides moving the rod.
struct StepAccount {
    double outflow = 0;  ///< J
    int impacts = 0;
    int slips = 0;
    int faults = 0;
};

/// Moves a rod with a free head: twist follows the last `drift_before` seconds, forces act for
/// `kick`, velocities for `drift`.
StepAccount plain_director_step(const Scene& scene, PlainRod& rod, const EndLoad& head,
                                const EndLoad& bit, double drift_before, double kick, double drift);

/// Elastic energy of the rod, own shapes included (J).
double plain_elastic_energy(const Scene& scene, const PlainRod& rod);

}  // namespace drillstrand::test
