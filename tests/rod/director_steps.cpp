#include "rod/director_steps.hpp"

#include <algorithm>
#include <vector>

#include "rod/director.hpp"

namespace drillstrand::test {

using Eigen::Vector3d;

namespace {

void write(BlockTable& table, std::size_t row, std::ptrdiff_t k, const Vector3d& v) {
    for (std::size_t i = 0; i < 3; ++i)
        table.row(row + i)[k] = v[static_cast<Eigen::Index>(i)];
}

Vector3d read(const BlockTable& table, std::size_t row, std::size_t k) {
    return {table.row(row)[k], table.row(row + 1)[k], table.row(row + 2)[k]};
}

void write_ghost(BlockTable& segments, std::ptrdiff_t k, const EndLoad& load, const Vector3d& t) {
    for (std::size_t row = SegmentRow::pull; row < SegmentRow::rows; ++row)
        segments.row(row)[k] = 0;
    write(segments, SegmentRow::pull, k, load.pull);
    write(segments, SegmentRow::couple, k, load.couple);
    segments.row(SegmentRow::torque)[k] = load.couple.dot(t);
}

}  // namespace

StepAccount kernel_director_step(const Scene& scene, PlainRod& rod, const EndLoad& head,
                                 const EndLoad& bit, double drift_before, double kick,
                                 double drift) {
    const std::size_t nodes = rod.node.size();
    const DirectorModel model(scene);
    BlockTable state(director_rows, nodes);
    state.fill(director, 1.0);
    state.fill(last_director, 1.0);
    BlockTable next = state;
    BlockTable segments(SegmentRow::rows, nodes);
    std::copy(rod.twist.begin(), rod.twist.end(), segments.row(SegmentRow::twist));
    std::vector<Vector3d> positions;
    for (const PlainNode& node : rod.node)
        positions.push_back(node.position);
    Surroundings surroundings(scene, positions);
    for (std::size_t k = 0; k < nodes; ++k) {
        const PlainNode& node = rod.node[k];
        const auto entry = static_cast<std::ptrdiff_t>(k);
        write(state, position, entry, node.position);
        write(state, velocity, entry, node.velocity);
        write(state, director, entry, node.director);
        write(state, angular_velocity, entry, node.angular_velocity);
        write(state, last_director, entry, node.last_director);
        write(state, material, entry, node.material);
        state.row(spin)[k] = node.spin;
        if (surroundings.empty()) continue;
        surroundings.row(Surroundings::elongation_axial)[k] = node.spring.elongation.axial;
        surroundings.row(Surroundings::elongation_azimuthal)[k] = node.spring.elongation.azimuthal;
        surroundings.row(Surroundings::sliding)[k] = node.spring.sliding;
        surroundings.row(Surroundings::depth)[k] = node.depth;
    }
    // beyond the bit, as the integrator leaves it
    const auto beyond = static_cast<std::ptrdiff_t>(nodes);
    write(state, position, beyond, rod.node.back().position);
    write(state, director, beyond, rod.node.back().director);
    write(state, last_director, beyond, rod.node.back().last_director);

    const std::vector<BlockSpan> spans = equal_spans(state.blocks());
    for (const BlockSpan span : spans)
        director_segments(model, state, segments, span, drift_before);
    write_ghost(segments, -1, head, rod.node.front().director);
    write_ghost(segments, beyond - 1, bit, rod.node.back().director);
    StepAccount account;
    for (const BlockSpan span : spans) {
        const NodeStep done =
            director_nodes(model, state, next, segments, surroundings, span, kick, drift);
        account.outflow += done.outflow;
        account.impacts += static_cast<int>(done.impacts);
        account.slips += static_cast<int>(done.slips);
        account.faults += static_cast<int>(done.faults);
    }
    for (std::size_t k = 0; k + 1 < nodes; ++k)
        rod.twist[k] = segments.row(SegmentRow::twist)[k];
    for (std::size_t k = 0; k < nodes; ++k) {
        PlainNode& node = rod.node[k];
        node.position = read(next, position, k);
        node.velocity = read(next, velocity, k);
        node.director = read(next, director, k);
        node.angular_velocity = read(next, angular_velocity, k);
        node.last_director = read(next, last_director, k);
        if (model.features.curved) node.material = read(next, material, k);
        node.spin = next.row(spin)[k];
        if (surroundings.empty()) continue;
        node.spring = {{surroundings.row(Surroundings::elongation_axial)[k],
                        surroundings.row(Surroundings::elongation_azimuthal)[k]},
                       surroundings.row(Surroundings::sliding)[k]};
        node.depth = surroundings.row(Surroundings::depth)[k];
    }
    return account;
}

}  // namespace drillstrand::test
