#include "rod/report.hpp"

#include <algorithm>
#include <cmath>

#include "drillstrand/side_force.hpp"

namespace drillstrand {

Vector6 stiffness_of(const SectionProperties& section) {
    Vector6 a;
    a << section.torsional_stiffness, section.bending_stiffness, section.bending_stiffness,
        section.axial_stiffness, section.shear_stiffness, section.shear_stiffness;
    return a;
}

Vector6 stress_free_strain(const SectionProperties& section) {
    Vector6 u;
    u << section.curvature, 1, 0, 0;
    return u;
}

Vector6 inertia_of(const Scene& scene, std::size_t node, double fluid_mass) {
    const SectionProperties& section = scene.mesh.node[node];
    const double across = section.mass + fluid_mass;
    Vector6 inertia;
    inertia << section.polar_inertia, scene.inertia[node], scene.inertia[node], section.mass,
        across, across;
    return inertia;
}

double fluid_mass_at(const Table<WallRow>& wall, std::size_t node) {
    return wall.blocks() > 0 ? wall.row(WallRow::fluid_mass)[node] : 0.0;
}

double elastic_energy(const Scene& scene, const std::vector<Vector6>& stress) {
    double sum = 0;
    for (std::size_t k = 0; k < stress.size(); ++k) {
        sum += 0.5 * scene.mesh.length[k] *
               stress[k].dot(stress[k].cwiseQuotient(stiffness_of(scene.mesh.segment[k])));
    }
    return sum;
}

double kinetic_energy(const Scene& scene, std::size_t node, double fluid_mass,
                      const Vector6& momentum) {
    return 0.5 * scene.mesh.cell[node] *
           momentum.dot(momentum.cwiseQuotient(inertia_of(scene, node, fluid_mass)));
}

double potential_energy(const Scene& scene, const std::vector<Eigen::Vector3d>& position) {
    double sum = 0;
    for (std::size_t k = 0; k < position.size(); ++k)
        sum -= scene.mesh.cell[k] * scene.weight[k] * scene.down.dot(position[k]);
    return sum;
}

WallContact contact_with(const Scene& scene, const Surroundings& surroundings,
                         const Table<WallRow>& wall, const std::vector<Eigen::Vector3d>& position) {
    WallContact sum;
    for (std::size_t k = 0; k < position.size(); ++k) {
        const NodeContact c = surroundings.contact(wall, k, position[k]);
        if (c.penetration <= 0) continue;
        ++sum.nodes;
        sum.deepest = std::max(sum.deepest, c.penetration);
        sum.relative = std::max(sum.relative, c.penetration / (c.eccentricity - c.penetration));
        sum.spring_energy += scene.mesh.cell[k] * c.spring_energy;
    }
    return sum;
}

void account_for(SeriesRecord& record, const WallContact& contact, const Accounts& accounts,
                 const EnergyOrigin& origin) {
    EnergyAccount& energy = record.energy;
    energy.springs = contact.spring_energy;
    energy.elastic += contact.spring_energy;
    energy.potential -= origin.potential;
    // what the surroundings took and the contact springs do not hold is gone
    energy.dissipation = origin.springs - contact.spring_energy;
    double impacts = 0;
    double slips = 0;
    for (std::size_t i = 0; i < accounts.outflow.size(); ++i) {
        energy.dissipation += accounts.outflow[i];
        impacts += accounts.impacts[i];
        slips += accounts.slips[i];
    }
    record.max_penetration = contact.deepest;
    record.relative_penetration = contact.relative;
    record.contact_nodes = contact.nodes;
    record.impacts = std::llround(impacts);
    record.slips = std::llround(slips);
    // who came and is not there has left
    record.contact_changes = 2 * record.impacts - record.contact_nodes;
}

void report_wall(const Scene& scene, Profile& profile, const Surroundings& surroundings,
                 const Table<WallRow>& wall) {
    for (std::size_t k = 0; k < profile.position.size(); ++k) {
        const NodeContact c = surroundings.contact(wall, k, profile.position[k]);
        profile.eccentricity.push_back(c.eccentricity);
        profile.well_depth.push_back(c.well_depth);
        profile.fluid_mass.push_back(fluid_mass_at(wall, k));
        profile.contact_force.push_back(c.force);
        profile.normal_force.push_back(std::max(c.normal_force, 0.0));
    }
    profile.side_force = side_force(scene.mesh.node_s, profile.normal_force,
                                    scene.side_force_window, scene.mesh.node_s);
}

}  // namespace drillstrand
