/// What both rods report in the same way: energies, and contact with the wall.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "forces/surroundings.hpp"
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
/// Energy of the weight of all nodes (J).
double potential_energy(const Scene& scene, const std::vector<Eigen::Vector3d>& position);

/// The contact of all nodes with the wall.
struct WallContact {
    std::int64_t nodes = 0;
    double deepest = 0;        ///< penetration (m)
    double relative = 0;       ///< largest penetration divided by the clearance of its node
    double spring_energy = 0;  ///< of normal and friction springs (J)
};
WallContact contact_with(const Scene& scene, const Surroundings& surroundings,
                         const Table<WallRow>& wall, const std::vector<Eigen::Vector3d>& position);

/// Completes a record that has the energies of the rod and of its weight by those of the wall, and
/// by what happened until then.
void account_for(SeriesRecord& record, const WallContact& contact, const Accounts& accounts,
                 const EnergyOrigin& origin);

/// Adds the place of each node in the well and the force of the wall on it.
void report_wall(const Scene& scene, Profile& profile, const Surroundings& surroundings,
                 const Table<WallRow>& wall);

}  // namespace drillstrand
