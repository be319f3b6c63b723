#include "drillstrand/hydraulics.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "forces/annulus.hpp"
#include "forces/duct_flow.hpp"

namespace drillstrand {

namespace {

constexpr double pi = std::numbers::pi;

/// The mud around one node.
struct Gap {
    double pipe, hole;  ///< radii (m)

    [[nodiscard]] double width() const { return hole - pipe; }
    [[nodiscard]] double area() const { return pi * (hole - pipe) * (hole + pipe); }
    [[nodiscard]] double displaced() const { return pi * pipe * pipe; }
    /// Part of the string's speed that mud which clings to it adds to the flow past it: exact for a
    /// Newtonian fluid (Burkhardt 1961).
    [[nodiscard]] double clinging() const {
        const double b2 = pipe * pipe / (hole * hole);
        const double log_b2 = std::log(b2);
        return (b2 - b2 * log_b2 - 1) / ((1 - b2) * log_b2);
    }
};

std::vector<Gap> gaps_of(const Scene& scene) {
    std::vector<Gap> gaps;
    std::size_t arc = 0;
    for (std::size_t k = 0; k < scene.mesh.node.size(); ++k) {
        const Eigen::Vector3d& position = scene.initial_nodes.position[k];
        arc = scene.well->find_arc(position, arc);
        const double hole = scene.well->project(position, arc).radius;
        gaps.push_back({flow_radius(scene.mesh.node[k].flow_radius, hole), hole});
    }
    return gaps;
}

/// Flow past a string that moves (m/s, down the well) as the mud of a concentric annulus, whose
/// clinging makes it faster.
struct AnnularFlow {
    double speed;     ///< mean, up (m/s)
    WallFlow wall;    ///< of the pressure's part
    double gradient;  ///< Pa/m
    double load;      ///< on the string, down the well (N/m)

    AnnularFlow(const Rheology& mud, double density, const Gap& gap, const MudMotion& motion)
        : speed((motion.flow_rate + motion.axial_speed * gap.displaced()) / gap.area()),
          wall(wall_flow(mud, density, Duct::slot, gap.width(),
                         speed + gap.clinging() * motion.axial_speed)),
          gradient(pressure_gradient(Duct::slot, gap.width(), wall.stress)),
          load(-pi * gap.pipe * gap.hole * gradient) {
        if (motion.axial_speed == 0 || wall.rate == 0) return;
        const double viscosity = wall.stress / wall.rate;
        load -= 2 * pi * viscosity * motion.axial_speed / std::log(gap.hole / gap.pipe);
    }
};

/// Pressures along the string, from the mouth of the annulus down, through the bit and up the pipe;
/// what is in a pipe whose end is closed rests on that. Losses of a segment are means of its
/// nodes'.
void add_up_pressures(const Scene& scene, bool closed, Hydraulics& flow) {
    const std::size_t nodes = scene.mesh.node.size();
    const auto mean_loss = [&](const std::vector<double>& gradient, std::size_t segment) {
        return 0.5 * scene.mesh.length[segment] * (gradient[segment] + gradient[segment + 1]);
    };
    const std::vector<Eigen::Vector3d>& x = scene.initial_nodes.position;
    const auto column = [&](std::size_t k) {
        return scene.fluid->density * scene.gravity * scene.down.dot(x[k] - x.front());
    };
    flow.outside_pressure.assign(nodes, 0);
    flow.inside_pressure.assign(nodes, 0);
    for (std::size_t k = 0; k + 1 < nodes; ++k) {
        flow.annulus_loss += mean_loss(flow.annulus_gradient, k);
        flow.outside_pressure[k + 1] = column(k + 1) + flow.annulus_loss;
    }
    flow.bit_pressure = flow.outside_pressure.back();
    const double below = closed ? 0 : flow.annulus_loss + flow.bit_loss;
    for (std::size_t k = nodes; k-- > 0;) {
        if (k + 1 < nodes) flow.inside_loss += mean_loss(flow.inside_gradient, k);
        flow.inside_pressure[k] = column(k) + below + flow.inside_loss;
    }
    flow.standpipe_pressure = flow.inside_pressure.front();
    if (scene.fluid->inside == InsideOfPipe::empty) flow.inside_pressure.assign(nodes, 0);
}

/// Nozzles without diffusers (Eckel and Bielstein 1951).
void pass_bit(const FluidCase& fluid, double flow_rate, Hydraulics& flow) {
    if (fluid.nozzle_area == 0) return;
    constexpr double discharge = 0.95;
    const double jet_speed = flow_rate / fluid.nozzle_area;
    flow.bit_loss = fluid.density * jet_speed * jet_speed / (2 * discharge * discharge);
    flow.jet_force = fluid.density * flow_rate * jet_speed;
}

double equivalent_density(const Scene& scene, double pressure) {
    const std::vector<Eigen::Vector3d>& x = scene.initial_nodes.position;
    const double head = scene.gravity * scene.down.dot(x.back() - x.front());
    return head > 0 ? pressure / head : scene.fluid->density;
}

}  // namespace

MudMotion mud_motion(const Scene& scene, double trip_speed) {
    if (!scene.well || !scene.fluid) return {};
    if (trip_speed != 0) return {0, trip_speed};
    return {scene.fluid->flow_rate, 0};
}

double inner_area(const SectionProperties& section) {
    return section.outer_area - section.metal_area;
}

Hydraulics hydraulics_of(const Scene& scene, const MudMotion& motion) {
    if (!scene.well || !scene.fluid)
        throw std::invalid_argument("hydraulics_of: the scene has no well or no fluid");
    const FluidCase& fluid = *scene.fluid;
    const Rheology mud = rheology_of(fluid);
    const StringMesh& mesh = scene.mesh;
    const double length = mesh.node_s.back();
    const std::vector<Gap> gaps = gaps_of(scene);
    Hydraulics flow;
    for (std::size_t k = 0; k < gaps.size(); ++k) {
        const double bore = 2 * std::sqrt(inner_area(mesh.node[k]) / pi);
        const WallFlow inside = wall_flow(mud, fluid.density, Duct::pipe, bore,
                                          motion.flow_rate / inner_area(mesh.node[k]));
        const AnnularFlow annulus(mud, fluid.density, gaps[k], motion);
        flow.pipe_radius.push_back(gaps[k].pipe);
        flow.hole_radius.push_back(gaps[k].hole);
        flow.inside_gradient.push_back(pressure_gradient(Duct::pipe, bore, inside.stress));
        flow.annulus_gradient.push_back(annulus.gradient);
        flow.annulus_speed.push_back(annulus.speed);
        flow.annulus_shear.push_back(annulus.wall.rate);
        flow.axial_load.push_back(annulus.load);
        if (!inside.laminar) flow.turbulent_inside += mesh.cell[k] / length;
        if (!annulus.wall.laminar) flow.turbulent_annulus += mesh.cell[k] / length;
    }
    pass_bit(fluid, motion.flow_rate, flow);
    flow.axial_load.back() -= flow.jet_force / mesh.cell.back();
    for (std::size_t k = 0; k < gaps.size(); ++k)
        flow.axial_force += mesh.cell[k] * flow.axial_load[k];
    add_up_pressures(scene, motion.axial_speed != 0, flow);
    flow.equivalent_density = equivalent_density(scene, flow.bit_pressure);
    return flow;
}

std::vector<double> mud_loads(const Scene& scene, const MudMotion& motion) {
    if (motion.is_rest()) return {};
    return hydraulics_of(scene, motion).axial_load;
}

}  // namespace drillstrand
