/// What both rods report in the same way: energies, and contact with the wall.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "forces/surroundings.hpp"
#include "rod/whirl.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// A = diag(GJ, EI, EI, EA, kGA, kGA), and Ubar = (twist, bending 1, bending 2, 1, 0, 0).
Vector6 stiffness_of(const SectionProperties& section);
Vector6 stress_free_strain(const SectionProperties& section);
/// M = diag(rho Ip, rho I, rho I, m, m + f, m + f) of a node, f that of the fluid which moves
/// sideways with it (kg/m).
Vector6 inertia_of(const Scene& scene, std::size_t node, double fluid_mass);
/// f at a node.
double fluid_mass_at(const Table<WallRow>& wall, std::size_t node);

/// Strain energy of stresses of all segments (J).
double elastic_energy(const Scene& scene, const std::vector<Vector6>& stress);
/// Kinetic energy of a node's cell (J), of its momentum per length in body axes.
double kinetic_energy(const Scene& scene, std::size_t node, double fluid_mass,
                      const Vector6& momentum);
/// Force of mud in motion on the cell of a head that is driven (N), along its d3.
Eigen::Vector3d mud_on_head(const Scene& scene, const Surroundings& surroundings);

/// Energy of the weight of all nodes (J).
double potential_energy(const Scene& scene, const std::vector<Eigen::Vector3d>& position);

/// Contact of each node.
std::vector<NodeContact> contacts_of(const Surroundings& surroundings, const Table<WallRow>& wall,
                                     const std::vector<Eigen::Vector3d>& position);

/// Energy of the normal and friction springs of all nodes (J).
double spring_energy(const Scene& scene, const std::vector<NodeContact>& contacts);

/// Friction of the wall on the whole string, down the well, and where it acts.
struct WallDrag {
    double force = 0;  ///< N
    double depth = 0;  ///< measured depth, mean weighted by its size; 0 where there is none (m)
};
/// `friction` per length at each node (N/m).
WallDrag wall_drag(const Scene& scene, const std::vector<double>& friction,
                   const std::vector<double>& well_depth);

/// The largest penetration that a helix of a node's own compression has: clearance q / (1 - q),
/// q = F^2 / (4 EI k_el), ten clearances at most, deeper than which no run goes (m). 0 where
/// nothing is compressed. `tension` of each segment (N).
double helix_penetration(const Scene& scene, const std::vector<NodeContact>& contacts,
                         const std::vector<double>& tension);

/// What a record needs of each node, whatever the rod.
struct NodeReport {
    std::vector<NodeContact> contact;
    std::vector<NodeVelocity> velocity;
};

/// Completes a record that has the energies of the rod and of its weight by the wall and the
/// whirl of the nodes, and by what happened until then. `tension` of each segment (N).
void account_for(SeriesRecord& record, const Scene& scene, const NodeReport& nodes,
                 const std::vector<double>& tension, const Accounts& accounts,
                 const EnergyOrigin& origin);

/// Adds the place of each node in the well, the force of the wall on it, and its whirl.
void report_wall(const Scene& scene, Profile& profile, const Table<WallRow>& wall,
                 const NodeReport& nodes);

}  // namespace drillstrand
