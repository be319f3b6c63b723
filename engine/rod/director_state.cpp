#include "rod/director_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "rod/director_report.hpp"

namespace drillstrand {

DirectorString::DirectorString(const Scene& scene_of_run, Level level)
    : scene(scene_of_run),
      model(scene, level),
      head(scene),
      bit(scene),
      jar(scene.mesh),
      substeps(scene),
      spans(equal_spans(blocks_for(model.segments + 1))) {}

DirectorState initial_state(const DirectorString& string) {
    const Scene& scene = string.scene;
    const InitialNodes& initial = scene.initial_nodes;
    const std::size_t nodes = string.model.segments + 1;
    DirectorState state;
    state.rod = Table<DirectorRow>(nodes);
    // padding: directors of unit length
    state.rod.fill(DirectorRow::director, Eigen::Vector3d::UnitX());
    state.rod.fill(DirectorRow::last_director, Eigen::Vector3d::UnitX());
    state.wall = string.model.surroundings.wall_at(initial.position);
    state.accounts = Accounts(string.spans.size());
    state.statistics.smallest_step = std::numeric_limits<double>::infinity();

    for (std::size_t k = 0; k < nodes; ++k) {
        const auto entry = static_cast<std::ptrdiff_t>(k);
        state.rod.set(DirectorRow::position, entry, initial.position[k]);
        state.rod.set(DirectorRow::director, entry, initial.director[k]);
        state.rod.set(DirectorRow::last_director, entry, initial.director[k]);
    }
    std::copy(initial.twist.begin(), initial.twist.end(), state.rod.row(DirectorRow::last_twist));
    state.head = string.head.start(initial.director.front());
    string.head.settle(state.head, Table<SegmentRow>(nodes), state.rod, state.rod, 0, 0);

    const std::vector<Eigen::Matrix3d> frame = material_frames(
        string, state.rod, state.rod.row(DirectorRow::last_twist), string.head.d1(state.head, 0));
    for (std::size_t k = 0; k < nodes; ++k)
        state.rod.set(DirectorRow::material, static_cast<std::ptrdiff_t>(k), frame[k].col(1));
    state.bit = string.bit.start(frame.back().col(1));
    state.rock = string.bit.start_on_rock();
    string.bit.finish(state.bit, state.rock, Table<SegmentRow>(nodes), state.rod, state.rod,
                      well_at_bit(string, state.wall, state.rod), {});

    if (scene.head.hoist) string.head.hang(state.head, snapshot(string, state).segments);

    state.origin = energy_origin(string, state);
    return state;
}

void string_segments(const DirectorString& string, const JarState& jar,
                     const Table<DirectorRow>& rod, Table<SegmentRow>& segments, BlockSpan span,
                     double drift) {
    director_segments(string.model, rod, segments, span, drift);
    if (string.jar.is_in(span)) string.jar.slacken(jar, string.model, rod, segments);
}

Eigen::Vector3d well_at_bit(const DirectorString& string, const Table<WallRow>& wall,
                            const Table<DirectorRow>& rod) {
    const std::size_t node = string.model.segments;
    return string.model.surroundings.direction(wall, node, rod.vector(DirectorRow::position, node),
                                               rod.vector(DirectorRow::director, node));
}

void load_bit(const DirectorString& string, const DirectorState& state,
              const Table<DirectorRow>& rod, double time, Table<SegmentRow>& segments) {
    const double rate = rod.row(DirectorRow::spin)[string.model.segments];
    string.bit.load(state.bit, state.rock, segments, rod, well_at_bit(string, state.wall, rod),
                    string.head.opposed_rate(time, rate), time);
}

void start_again(const DirectorString& string, DirectorState& state) {
    DirectorSnapshot at = snapshot(string, state);
    string.bit.finish(state.bit, state.rock, at.segments, state.rod, at.rod,
                      well_at_bit(string, state.wall, state.rod), {});
    state.rod = std::move(at.rod);
    std::copy_n(at.segments.row(SegmentRow::twist), string.model.segments,
                state.rod.row(DirectorRow::last_twist));
    state.wall = std::move(at.wall);
    state.jar = at.jar;
    state.clock.last_step = 0;
    state.course = {};
}

void derive(const DirectorString& string, DirectorState& state) {
    const Course& course = state.course;
    if (!(std::isfinite(state.clock.time) && state.clock.last_step >= 0) || course.done < 0 ||
        course.done > course.steps || !(course.start <= course.end) ||
        state.time_error.due < state.statistics.steps || state.statistics.steps < 0)
        throw std::invalid_argument("the clock of the saved state is out of order");
    if (!state.accounts.are_counts())
        throw std::invalid_argument("impacts or slips of the saved state are no counts");
    string.jar.check(state.jar);
    string.model.surroundings.derive(state.wall);
}

}  // namespace drillstrand
