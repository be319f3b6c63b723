#include "rod/director_steps.hpp"

#include <algorithm>
#include <vector>

#include "rod/director.hpp"

namespace drillstrand::test {

using Eigen::Vector3d;

StepAccount kernel_director_step(const Scene& scene, PlainRod& rod, const EndLoad& head,
                                 const EndLoad& bit, double drift_before, double kick,
                                 double drift) {
    const std::size_t nodes = rod.node.size();
    const DirectorModel model(scene);
    using R = DirectorRow;
    Table<R> state(nodes);
    state.fill(R::director, Vector3d::UnitX());
    state.fill(R::last_director, Vector3d::UnitX());
    std::copy(rod.twist.begin(), rod.twist.end(), state.row(R::last_twist));
    Table<R> next = state;
    Table<SegmentRow> segments(nodes);
    std::vector<Vector3d> positions;
    for (const PlainNode& node : rod.node)
        positions.push_back(node.position);
    Table<WallRow> wall = model.surroundings.wall_at(positions);
    for (std::size_t k = 0; k < nodes; ++k) {
        const PlainNode& node = rod.node[k];
        const auto entry = static_cast<std::ptrdiff_t>(k);
        state.set(R::position, entry, node.position);
        state.set(R::velocity, entry, node.velocity);
        state.set(R::director, entry, node.director);
        state.set(R::angular_velocity, entry, node.angular_velocity);
        state.set(R::last_director, entry, node.last_director);
        state.set(R::material, entry, node.material);
        state.row(R::spin)[k] = node.spin;
        if (model.surroundings.empty()) continue;
        wall.row(WallRow::elongation_axial)[k] = node.spring.elongation.axial;
        wall.row(WallRow::elongation_azimuthal)[k] = node.spring.elongation.azimuthal;
        wall.row(WallRow::sliding)[k] = node.spring.sliding;
        wall.row(WallRow::depth)[k] = node.depth;
        wall.row(WallRow::rebounds)[k] = node.rebounds;
    }
    // beyond the bit, as the integrator leaves it
    const auto beyond = static_cast<std::ptrdiff_t>(nodes);
    state.set(R::position, beyond, rod.node.back().position);
    state.set(R::director, beyond, rod.node.back().director);
    state.set(R::last_director, beyond, rod.node.back().last_director);

    const std::vector<BlockSpan> spans = equal_spans(state.blocks());
    for (const BlockSpan span : spans)
        director_segments(model, state, segments, span, drift_before);
    write_end_load(segments, -1, {head.pull, head.couple}, rod.node.front().director);
    write_end_load(segments, beyond - 1, {bit.pull, bit.couple}, rod.node.back().director);
    StepAccount account;
    for (const BlockSpan span : spans) {
        const NodeStep done = director_nodes(model, state, next, segments, wall, span, kick, drift);
        account.outflow += done.outflow;
        account.impacts += static_cast<int>(done.impacts);
        account.slips += static_cast<int>(done.slips);
        account.faults += static_cast<int>(done.faults);
    }
    for (std::size_t k = 0; k + 1 < nodes; ++k)
        rod.twist[k] = next.row(R::last_twist)[k];
    for (std::size_t k = 0; k < nodes; ++k) {
        PlainNode& node = rod.node[k];
        node.position = next.vector(R::position, k);
        node.velocity = next.vector(R::velocity, k);
        node.director = next.vector(R::director, k);
        node.angular_velocity = next.vector(R::angular_velocity, k);
        node.last_director = next.vector(R::last_director, k);
        if (model.features.curved) node.material = next.vector(R::material, k);
        node.spin = next.row(R::spin)[k];
        if (model.surroundings.empty()) continue;
        node.spring = {
            {wall.row(WallRow::elongation_axial)[k], wall.row(WallRow::elongation_azimuthal)[k]},
            wall.row(WallRow::sliding)[k]};
        node.depth = wall.row(WallRow::depth)[k];
        node.rebounds = wall.row(WallRow::rebounds)[k];
        node.fluid_mass = wall.row(WallRow::fluid_mass)[k];
    }
    return account;
}

}  // namespace drillstrand::test
