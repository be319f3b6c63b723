#include "bench_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace drillstrand::bench {

namespace {

constexpr std::size_t momenta = 6;  // lines of momenta, then those of stresses

/// The value of one entry of a state, by its line in the engine's layout.
const double& entry(const PlainState& state, std::size_t row, std::size_t k) {
    const Six& v = row < momenta ? state.momentum[k] : state.stress[k];
    const auto component = static_cast<Eigen::Index>(row % 3);
    return row % 6 < 3 ? v.angular[component] : v.linear[component];
}

std::size_t entries(const PlainState& state, std::size_t row) {
    return row < momenta ? state.momentum.size() : state.stress.size();
}

}  // namespace

Scene make_scene(int segments, const SceneFeatures& features, double offset) {
    Case input = read_case(DRILLSTRAND_CASES "/well2_drilling_paper.toml",
                           {{"mesh.segments", fmt::format("{}", segments)},
                            {"head.rotation", R"("2 Hz")"},
                            {"bit.weight", R"("50 kN")"},
                            {"bit.torque", R"("5 kN m")"},
                            {"initial.offset", fmt::format("[{}, 0, 0]", offset)},
                            {"fluid.drag", features.drag ? "true" : "false"},
                            {"fluid.regime", features.inertial_flow ? "inertial" : "laminar"},
                            {"fluid.added_mass", features.fluid_mass ? "true" : "false"}});
    if (!features.well) {
        input.well.reset();
        input.fluid.reset();
    }
    if (features.damping == Damping::none) input.damping = {};
    return build_scene(input);
}

PlainState perturbed_state(const Scene& scene) {
    PlainState state = initial_state(scene);
    std::mt19937 random(20241);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&](double a, double b, double c) {
        return Eigen::Vector3d(a * uniform(random), b * uniform(random), c * uniform(random));
    };
    for (std::size_t k = 0; k < state.momentum.size(); ++k) {
        const double mass = scene.mesh.node[k].mass;
        state.momentum[k].linear += mass * vector(0.02, 0.02, 0.02);
        state.momentum[k].angular += scene.inertia[k] * vector(2, 0.002, 0.002);
    }
    for (Six& stress : state.stress) {
        stress.angular += vector(500, 5, 5);
        stress.linear += vector(5e4, 50, 50);
    }
    return state;
}

Table<StrandRow> to_table(const PlainState& state) {
    Table<StrandRow> table(state.momentum.size());
    for (std::size_t row = 0; row < Table<StrandRow>::lines; ++row) {
        for (std::size_t k = 0; k < entries(state, row); ++k)
            table.line(row)[k] = entry(state, row, k);
    }
    return table;
}

double relative_difference(const PlainState& plain, const Table<StrandRow>& table) {
    double worst = 0;
    for (std::size_t row = 0; row < Table<StrandRow>::lines; ++row) {
        double most = 0;
        double difference = 0;
        for (std::size_t k = 0; k < entries(plain, row); ++k) {
            const double value = entry(plain, row, k);
            most = std::max(most, std::abs(value));
            difference = std::max(difference, std::abs(value - table.line(row)[k]));
        }
        if (most > 0) worst = std::max(worst, difference / most);
    }
    return worst;
}

}  // namespace drillstrand::bench
