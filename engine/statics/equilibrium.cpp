#include "drillstrand/equilibrium.hpp"

#include <numbers>
#include <stdexcept>

#include "drillstrand/side_force.hpp"
#include "rod/director_report.hpp"
#include "rod/report.hpp"
#include "statics/search.hpp"

namespace drillstrand {

namespace {

/// The records that the leapfrog would give of this state, with the walls' steady friction.
void report(const Scene& scene, EquilibriumSearch& search, Equilibrium& result) {
    Scene at_rest = scene;
    at_rest.initial_nodes = result.nodes;
    at_rest.head.rotation = {};
    at_rest.head.tilting = at_rest.head.velocity = {};
    const DirectorString string(at_rest);
    const DirectorState state = initial_state(string);
    result.series = series_record(string, state);
    result.profile = profile_record(string, state);
    const std::vector<WallReport> walls = search.balance().walls(search.state());
    std::vector<double> friction;
    for (std::size_t k = 0; k < walls.size(); ++k) {
        result.profile.contact_force[k] = walls[k].force;
        result.profile.normal_force[k] = walls[k].normal;
        friction.push_back(walls[k].force.dot(string.model.surroundings.direction(
            state.wall, k, result.nodes.position[k], result.profile.director[k])));
    }
    const WallDrag drag = wall_drag(scene, friction, result.profile.well_depth);
    result.series.wall_drag = drag.force;
    result.series.drag_depth = drag.depth;
    result.profile.side_force = side_force(scene.mesh.node_s, result.profile.normal_force,
                                           scene.side_force_window, scene.mesh.node_s);
    double potential = 0;
    for (std::size_t k = 0; k < walls.size(); ++k)
        potential -= scene.mesh.cell[k] * scene.weight[k] *
                     scene.down.dot(result.nodes.position[k] - scene.initial_nodes.position[k]);
    result.series.energy.potential = potential;
}

void check_head(const Scene& scene) {
    if (scene.head.motion == HeadMotion::free)
        throw std::invalid_argument("find_equilibrium: the head is free");
}

}  // namespace

SteadyMotion steady_motion(StringMotion motion, double rotation_rate) {
    switch (motion) {
        case StringMotion::rest:
            return {};
        case StringMotion::rotating:
        case StringMotion::drilling:
            return {0, rotation_rate};
        case StringMotion::tripping_in:
        case StringMotion::sliding:
            return {1, 0};
        case StringMotion::tripping_out:
            return {-1, 0};
    }
    throw std::invalid_argument("steady_motion: no such motion");
}

bool bit_is_loaded(StringMotion motion) {
    return motion == StringMotion::rest || motion == StringMotion::drilling ||
           motion == StringMotion::sliding;
}

EquilibriumOptions equilibrium_options(const Case& input) {
    const EquilibriumCase& wanted = input.equilibrium;
    constexpr double usual_rate = 2 * std::numbers::pi;  // rad/s
    const double scheduled = input.head.rotation.values().back();
    EquilibriumOptions options;
    options.motion = steady_motion(wanted.motion, scheduled != 0 ? scheduled : usual_rate);
    if (wanted.axial_speed) options.motion.axial_speed = *wanted.axial_speed;
    if (wanted.rotation) options.motion.rotation_rate = *wanted.rotation;
    options.bit_loads = bit_is_loaded(wanted.motion);
    if (input.fluid && wanted.motion == StringMotion::tripping_in)
        options.trip_speed = input.fluid->trip_speed;
    if (input.fluid && wanted.motion == StringMotion::tripping_out)
        options.trip_speed = -input.fluid->trip_speed;
    return options;
}

Equilibrium find_equilibrium(const Scene& scene, const EquilibriumOptions& options) {
    check_head(scene);
    EquilibriumSearch search(scene, options);
    search.run();

    Equilibrium result;
    result.nodes = search.state().nodes();
    report(scene, search, result);
    result.series.weight_on_bit = search.balance().weight_on_bit();
    result.series.bit_torque = search.balance().bit_torque();
    result.hook_load = search.balance().hook_load(search.state());
    result.surface_torque = search.balance().surface_torque(search.state());
    if (scene.head.hoist)
        result.series.dead_line_tension +=
            (result.hook_load - result.series.hook_load) / scene.head.hoist->lines;
    result.series.hook_load = result.hook_load;
    result.series.surface_torque = result.surface_torque;
    const Vector6 on_bit = search.balance().bit(search.state()).load;
    result.bit_force = on_bit.head<3>();
    result.bit_couple = on_bit.tail<3>();
    result.iterations = search.iterations();
    result.residual = search.residual();
    result.stable = search.is_stable();
    result.warnings = search.warnings();
    return result;
}

InitialNodes equilibrium_nodes(const Scene& scene, const EquilibriumOptions& options) {
    check_head(scene);
    EquilibriumSearch search(scene, options);
    search.run();
    return search.state().nodes();
}

}  // namespace drillstrand
