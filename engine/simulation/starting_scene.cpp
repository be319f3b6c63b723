#include "drillstrand/equilibrium.hpp"
#include "drillstrand/simulation.hpp"

namespace drillstrand {

Scene starting_scene(const Case& input) {
    Scene scene = build_scene(input);
    if (input.initial.state != InitialState::equilibrium) return scene;
    EquilibriumOptions at_start;
    at_start.load_time = 0;
    scene.initial_nodes = equilibrium_nodes(scene, at_start);
    return scene;
}

}  // namespace drillstrand
