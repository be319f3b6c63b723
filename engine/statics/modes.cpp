#include "drillstrand/modes.hpp"

#include <omp.h>

#include <algorithm>
#include <stdexcept>

#include "statics/forced_response.hpp"
#include "statics/free_vibrations.hpp"
#include "statics/in_parallel.hpp"
#include "statics/mode_shape.hpp"
#include "statics/search.hpp"
#include "statics/vibration_matrices.hpp"

namespace drillstrand {

namespace {

/// What the search comes to.
const RodState& settled(EquilibriumSearch& search) {
    search.run();
    return search.state();
}

const Scene& with_held_head(const Scene& scene) {
    if (scene.head.motion == HeadMotion::free)
        throw std::invalid_argument("StringVibration: the head is free");
    return scene;
}

StaticShape shape_of(const Scene& scene, Balance& balance, const RodState& state) {
    StaticShape shape{state.position, state.director, {}};
    const std::vector<WallReport> walls = balance.walls(state);
    for (std::size_t node = 0; node < walls.size(); ++node)
        shape.side_force.push_back(scene.mesh.cell[node] * walls[node].normal);
    return shape;
}

int threads_for(int asked) {
    return asked > 0 ? asked : omp_get_num_procs();
}

}  // namespace

struct StringVibration::State {
    State(const Scene& its_scene, const EquilibriumOptions& options, WallGrip grip)
        : scene(with_held_head(its_scene)),
          search(scene, options),
          shape(shape_of(scene, search.balance(), settled(search))),
          matrices(vibration_matrices(scene, search.balance(), search.state(), grip)),
          free(matrices) {}

    const Scene& scene;
    EquilibriumSearch search;
    StaticShape shape;
    VibrationMatrices matrices;
    FreeVibrations free;
};

StringVibration::StringVibration(const Scene& scene, const EquilibriumOptions& equilibrium,
                                 WallGrip grip)
    : state_(std::make_unique<State>(scene, equilibrium, grip)) {}

StringVibration::~StringVibration() = default;

const StaticShape& StringVibration::static_shape() const {
    return state_->shape;
}

const std::vector<std::string>& StringVibration::warnings() const {
    return state_->search.warnings();
}

std::size_t StringVibration::most_modes(const Scene& scene) {
    return 3 * scene.mesh.length.size();
}

std::vector<VibrationMode> StringVibration::modes(double rotation_rate, std::size_t count) const {
    std::vector<VibrationMode> modes;
    for (const FreeVibration& free : state_->free.at(rotation_rate, count))
        modes.push_back(described_mode(state_->scene, state_->search.state(), state_->matrices,
                                       free.frequency, free.motion));
    return modes;
}

std::vector<CampbellPoint> StringVibration::campbell(const std::vector<double>& rotation_rates,
                                                     std::size_t count, int threads) const {
    std::vector<CampbellPoint> points(rotation_rates.size() * count);
    for_each_in_parallel(rotation_rates.size(), threads_for(threads), [&](std::size_t i) {
        const std::vector<FreeVibration> found = state_->free.at(rotation_rates[i], count);
        for (std::size_t k = 0; k < count; ++k) {
            const ModeCharacter character =
                mode_character(state_->search.state(), state_->matrices, found[k].motion);
            points[i * count + k] = {rotation_rates[i], found[k].frequency, character.kind(),
                                     character.whirl};
        }
    });
    return points;
}

std::vector<CriticalSpeed> StringVibration::critical_speeds(double order, double highest_rate,
                                                            std::size_t count) const {
    const std::size_t available = count_critical_speeds(order, highest_rate);
    std::vector<CriticalSpeed> speeds;
    for (const FreeVibration& free : state_->free.critical(order, std::min(count, available))) {
        const ModeCharacter character =
            mode_character(state_->search.state(), state_->matrices, free.motion);
        speeds.push_back({order, free.frequency / order, character.kind(), character.whirl});
    }
    return speeds;
}

std::size_t StringVibration::count_critical_speeds(double order, double highest_rate) const {
    return state_->free.count_critical(order, order * highest_rate);
}

std::vector<ForcedResponse> StringVibration::response(const Excitation& excitation,
                                                      const std::vector<double>& rotation_rates,
                                                      int threads) const {
    const ShakenString string{state_->scene, state_->search.state(), state_->matrices};
    std::vector<ForcedResponse> responses(rotation_rates.size());
    for_each_in_parallel(rotation_rates.size(), threads_for(threads), [&](std::size_t i) {
        responses[i] = forced_response(string, excitation, rotation_rates[i]);
    });
    return responses;
}

}  // namespace drillstrand
