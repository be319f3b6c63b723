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

Eigen::Vector3d mud_on_head(const Scene& scene, const Surroundings& surroundings) {
    if (!scene.features.flowing_mud) return Eigen::Vector3d::Zero();
    return scene.mesh.cell[0] * surroundings.row(Surroundings::mud_load)[0] *
           scene.head_frame.col(0);
}

double potential_energy(const Scene& scene, const std::vector<Eigen::Vector3d>& position) {
    double sum = 0;
    for (std::size_t k = 0; k < position.size(); ++k)
        sum -= scene.mesh.cell[k] * scene.weight[k] * scene.down.dot(position[k]);
    return sum;
}

std::vector<NodeContact> contacts_of(const Surroundings& surroundings, const Table<WallRow>& wall,
                                     const std::vector<Eigen::Vector3d>& position) {
    std::vector<NodeContact> contacts;
    contacts.reserve(position.size());
    for (std::size_t k = 0; k < position.size(); ++k)
        contacts.push_back(surroundings.contact(wall, k, position[k]));
    return contacts;
}

double spring_energy(const Scene& scene, const std::vector<NodeContact>& contacts) {
    double sum = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k)
        sum += scene.mesh.cell[k] * contacts[k].spring_energy;
    return sum;
}

WallDrag wall_drag(const Scene& scene, const std::vector<double>& friction,
                   const std::vector<double>& well_depth) {
    WallDrag drag;
    double size = 0;
    double moment = 0;
    for (std::size_t k = 0; k < friction.size(); ++k) {
        const double force = scene.mesh.cell[k] * friction[k];
        drag.force += force;
        size += std::abs(force);
        moment += std::abs(force) * well_depth[k];
    }
    if (size > 0) drag.depth = moment / size;
    return drag;
}

namespace {

constexpr double most_of_helix = 10;  // clearances

/// How deep a helix lies in Hertz's wall, q (c + dr) = dr^1.5, c its clearance: by Newton's method
/// from the most, from where it comes down to the root.
double depth_in_hertz_wall(double q, double clearance) {
    constexpr int rounds = 60;
    double depth = most_of_helix * clearance;
    for (int i = 0; i < rounds; ++i) {
        const double root = std::sqrt(depth);
        const double miss = depth * root - q * (clearance + depth);
        const double slope = 1.5 * root - q;
        if (miss <= 0 || slope <= 0) break;
        depth -= miss / slope;
    }
    return depth;
}

/// How deep a helix lies in a wall; q = F^2 / (4 EI k_el) with the wall's k_el or K.
double helix_depth(NormalLaw law, double q, double clearance) {
    if (law == NormalLaw::hertz) return depth_in_hertz_wall(q, clearance);
    const double clearances = q < most_of_helix / (1 + most_of_helix) ? q / (1 - q) : most_of_helix;
    return clearances * clearance;
}

}  // namespace

double helix_penetration(const Scene& scene, const std::vector<NodeContact>& contacts,
                         const std::vector<double>& tension) {
    if (!scene.well) return 0;
    double deepest = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const double above = tension[k > 0 ? k - 1 : 0];
        const double below = tension[std::min(k, tension.size() - 1)];
        const double compression = -0.5 * (above + below);
        if (compression <= 0) continue;
        const double stiffness = contacts[k].firmness * scene.normal_stiffness[k];
        const double q =
            compression * compression / (4 * scene.mesh.node[k].bending_stiffness * stiffness);
        deepest =
            std::max(deepest, helix_depth(scene.contact.normal_law, q, contacts[k].clearance));
    }
    return deepest;
}

namespace {

void report_contact(SeriesRecord& record, const Scene& scene,
                    const std::vector<NodeContact>& contacts) {
    std::vector<double> friction;
    std::vector<double> depth;
    friction.reserve(contacts.size());
    depth.reserve(contacts.size());
    for (const NodeContact& c : contacts) {
        friction.push_back(c.axial_friction);
        depth.push_back(c.well_depth);
        if (c.penetration <= 0) continue;
        ++record.contact_nodes;
        record.relative_penetration = std::max(record.relative_penetration, c.penetration / c.room);
        if (c.penetration <= record.max_penetration) continue;
        record.max_penetration = c.penetration;
        record.penetration_depth = c.well_depth;
    }
    const WallDrag drag = wall_drag(scene, friction, depth);
    record.wall_drag = drag.force;
    record.drag_depth = drag.depth;
}

}  // namespace

void account_for(SeriesRecord& record, const Scene& scene, const NodeReport& nodes,
                 const std::vector<double>& tension, const Accounts& accounts,
                 const EnergyOrigin& origin) {
    EnergyAccount& energy = record.energy;
    energy.rotation = rotation_energy(scene, nodes.velocity);
    energy.springs = spring_energy(scene, nodes.contact);
    energy.elastic += energy.springs;
    energy.potential -= origin.potential;
    // what the surroundings took and the contact springs do not hold is gone
    energy.dissipation = origin.springs - energy.springs;
    double impacts = 0;
    double slips = 0;
    for (std::size_t i = 0; i < accounts.outflow.size(); ++i) {
        energy.dissipation += accounts.outflow[i];
        impacts += accounts.impacts[i];
        slips += accounts.slips[i];
    }
    report_contact(record, scene, nodes.contact);
    record.helix_penetration = helix_penetration(scene, nodes.contact, tension);
    record.whirl = whirl_of(scene, nodes.contact, nodes.velocity);
    record.impacts = std::llround(impacts);
    record.slips = std::llround(slips);
    // who came and is not there has left
    record.contact_changes = 2 * record.impacts - record.contact_nodes;
}

void report_wall(const Scene& scene, Profile& profile, const Table<WallRow>& wall,
                 const NodeReport& nodes) {
    for (std::size_t k = 0; k < profile.position.size(); ++k) {
        const NodeContact& c = nodes.contact[k];
        profile.eccentricity.push_back(c.eccentricity);
        profile.well_depth.push_back(c.well_depth);
        profile.fluid_mass.push_back(fluid_mass_at(wall, k));
        profile.contact_force.push_back(c.force);
        profile.normal_force.push_back(std::max(c.normal_force, 0.0));
    }
    profile.side_force = side_force(scene.mesh.node_s, profile.normal_force,
                                    scene.side_force_window, scene.mesh.node_s);
    profile.whirl_rate = whirl_rates(nodes.contact, nodes.velocity);
}

}  // namespace drillstrand
