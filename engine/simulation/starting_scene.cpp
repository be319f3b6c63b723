#include <fmt/format.h>

#include "drillstrand/equilibrium.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/simulation.hpp"
#include "forces/surroundings.hpp"

namespace drillstrand {

namespace {

/// Throws InputError where a node starts deeper in the wall than a wall can mean.
void check_penetration(const Case& input, const Scene& scene) {
    const Surroundings surroundings(scene);
    const Table<WallRow> wall = surroundings.wall_at(scene.initial_nodes.position);
    for (std::size_t k = 0; k < scene.mesh.node.size() && scene.well; ++k) {
        const NodeContact contact = surroundings.contact(wall, k, scene.initial_nodes.position[k]);
        const double depth = contact.penetration;
        const double limit = input.initial.penetration_limit.value_or(contact.room);
        if (depth <= limit) continue;
        throw InputError(
            {input.path.string()},
            fmt::format(
                "the string starts {:.4g} m deep in the wall, {:.5g} m from the head; "
                "expected at most {}, {:.4g} m: move it (initial.offset, head.position), "
                "stiffen the wall (contact.normal_stiffness), or set "
                "initial.penetration_limit",
                depth, scene.mesh.node_s[k],
                input.initial.penetration_limit ? "initial.penetration_limit" : "the clearance",
                limit));
    }
}

}  // namespace

Scene starting_scene(const Case& input) {
    Scene scene = build_scene(input);
    if (input.initial.state == InitialState::equilibrium) {
        EquilibriumOptions at_start;
        at_start.load_time = 0;
        try {
            scene.initial_nodes = equilibrium_nodes(scene, at_start);
        } catch (const SimulationError& error) {
            // who did not ask for rest shall have a run all the same
            if (!input.initial.by_default) throw;
            scene.notes.push_back(fmt::format(
                "no equilibrium to start from ({}): the string starts on the axis of the well and "
                "falls to its wall; initial.state = \"coaxial\" asks for that",
                error.what()));
        }
    }
    check_penetration(input, scene);
    return scene;
}

}  // namespace drillstrand
