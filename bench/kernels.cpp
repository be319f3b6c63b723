/// Time per node of each kernel of the step loop beside its scalar twin (plain_strand.hpp). How to
/// run it and what the numbers mean: bench/README.md. Names are KERNEL/vector/N and KERNEL/plain/N.
///
/// Before anything is timed, both sides must agree on the rates of every scene.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <functional>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench_scene.hpp"
#include "drillstrand/version.hpp"
#include "forces/fluid.hpp"
#include "integrators/dormand_prince.hpp"
#include "numerics/kernel.hpp"

namespace drillstrand::bench {
namespace {

using State = benchmark::State;

constexpr int meshes[] = {64, 322, 4000};

/// Reports ns per node, of processor time but where several threads share the work; `work` is the
/// number of nodes that one iteration has seen.
void report(State& state, double work) {
    state.counters["ns_per_node"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * work * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

benchmark::internal::Benchmark* add(const std::string& kernel, const std::string& side,
                                    int segments, const std::function<void(State&)>& run) {
    return benchmark::RegisterBenchmark(fmt::format("{}/{}/{}", kernel, side, segments).c_str(),
                                        run);
}

/// One scene with a state, in both layouts.
struct Bench {
    Bench(int segments, const SceneFeatures& features)
        : scene(make_scene(segments, features)),
          head(driven_head(scene, 0)),
          plain_state(perturbed_state(scene)),
          plain_rate(plain_state),
          plain(scene),
          model(scene),
          state(to_table(plain_state)),
          rate(nodes()),
          work(nodes()),
          block_start(work.table.blocks()),
          wall(model.surroundings.wall_at(positions())) {
        segments_by_vectors();
        nodes_by_vectors();
        segments_plainly();
        nodes_plainly();
        const double difference = relative_difference(plain_rate, rate);
        if (!(difference < 1e-6)) {
            throw std::runtime_error(fmt::format(
                "the kernels and their scalar twin differ by {:.1e} of the largest rate",
                difference));
        }
    }

    [[nodiscard]] std::size_t nodes() const { return plain_state.momentum.size(); }
    [[nodiscard]] std::size_t blocks() const { return work.table.blocks(); }

    void segments_by_vectors() {
        segment_pass(model, state, rate, work, wall, 0, blocks());
        chain_blocks(head, work, block_start, blocks());
    }
    void nodes_by_vectors() { node_pass(model, state, rate, work, block_start, wall, 0, blocks()); }
    void segments_plainly() { plain.segments(plain_state, plain_rate, head); }
    void nodes_plainly() { plain.nodes(plain_state, plain_rate, 0, nodes()); }

    Scene scene;
    Pose head;
    PlainState plain_state;
    PlainState plain_rate;
    PlainStrand plain;
    StrandModel model;
    Table<StrandRow> state;
    Table<StrandRow> rate;
    StrandWorkspace work;
    std::vector<Pose> block_start;
    Table<WallRow> wall;

  private:
    [[nodiscard]] std::vector<Eigen::Vector3d> positions() const {
        std::vector<Eigen::Vector3d> position;
        for (std::size_t k = 0; k < nodes(); ++k)
            position.push_back(plain.pose(k).position);
        return position;
    }
};

/// Times `run(bench)` on one scene that all repetitions share.
void add_pass(const std::string& kernel, const std::string& side, std::shared_ptr<Bench> bench,
              void (*run)(Bench&)) {
    add(kernel, side, bench->scene.segments, [bench, run](State& state) {
        for ([[maybe_unused]] auto _ : state) {
            run(*bench);
            benchmark::ClobberMemory();
        }
        report(state, static_cast<double>(bench->nodes()));
    });
}

void segments_then_nodes_by_vectors(Bench& bench) {
    bench.segments_by_vectors();
    bench.nodes_by_vectors();
}
void segments_then_nodes_plainly(Bench& bench) {
    bench.segments_plainly();
    bench.nodes_plainly();
}

/// A feature set as RESULTS.md names it.
struct NamedFeatures {
    const char* name;
    SceneFeatures features;
};
constexpr SceneFeatures everything = {.well = true,
                                      .drag = true,
                                      .inertial_flow = true,
                                      .fluid_mass = true,
                                      .damping = Damping::paper};
const NamedFeatures feature_sets[] = {
    {"free", {}},
    {"damped", {.damping = Damping::paper}},
    {"well", {.well = true}},
    {"well+laminar drag", {.well = true, .drag = true}},
    {"well+drag", {.well = true, .drag = true, .inertial_flow = true}},
    {"well+drag+mass", {.well = true, .drag = true, .inertial_flow = true, .fluid_mass = true}},
    {"well+drag+mass+damped", everything},
};

void add_strand_kernels(int segments) {
    for (const NamedFeatures& set : feature_sets) {
        const auto bench = std::make_shared<Bench>(segments, set.features);
        const std::string name = set.name;
        const bool first = !set.features.well && set.features.damping == Damping::none;
        const bool last = set.features.well && set.features.damping != Damping::none;
        if (first) {
            add_pass("segments", "vector", bench, [](Bench& b) { b.segments_by_vectors(); });
            add_pass("segments", "plain", bench, [](Bench& b) { b.segments_plainly(); });
        }
        add_pass("nodes " + name, "vector", bench, [](Bench& b) { b.nodes_by_vectors(); });
        add_pass("nodes " + name, "plain", bench, [](Bench& b) { b.nodes_plainly(); });
        if (first || last) {
            add_pass("right-hand side " + name, "vector", bench, segments_then_nodes_by_vectors);
            add_pass("right-hand side " + name, "plain", bench, segments_then_nodes_plainly);
        }
        if (last) {
            constexpr double dt = 1e-5;
            add_pass("springs", "vector", bench, [](Bench& b) {
                for (std::size_t block = 0; block < b.blocks(); ++block)
                    b.model.surroundings.advance_springs(b.wall, dt, block);
            });
            add_pass("springs", "plain", bench,
                     [](Bench& b) { b.plain.advance_springs(dt, 0, b.nodes()); });
        }
    }
}

DRILLSTRAND_KERNEL void drag_of_all(const double* eccentricity, double* sum, std::size_t count,
                                    double pipe, double hole) {
    const auto node = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const DragCoefficients c = drag_coefficients({eccentricity[k], pipe, hole});
        sum[k] = c.radial + c.axial + c.around + c.cross + c.spin;
    };
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k)
        node(k);
}

void plain_drag_of_all(const double* eccentricity, double* sum, std::size_t count, double pipe,
                       double hole) {
    for (std::size_t k = 0; k < count; ++k) {
        const DragCoefficients c = plain_drag_coefficients(eccentricity[k], pipe, hole);
        sum[k] = c.radial + c.axial + c.around + c.cross + c.spin;
    }
}

void add_drag(int segments) {
    constexpr double pipe = 0.07;
    constexpr double hole = 0.155;
    const auto run = [segments](auto drag) {
        return [segments, drag](State& state) {
            const auto count = static_cast<std::size_t>(segments) + 1;
            std::vector<double> eccentricity(count);
            std::vector<double> sum(count);
            for (std::size_t k = 0; k < count; ++k) {
                eccentricity[k] =
                    0.99 * (hole - pipe) * static_cast<double>(k) / static_cast<double>(segments);
            }
            for ([[maybe_unused]] auto _ : state) {
                drag(eccentricity.data(), sum.data(), count, pipe, hole);
                benchmark::ClobberMemory();
            }
            report(state, static_cast<double>(count));
        };
    };
    add("drag coefficients", "vector", segments, run(at_level<drag_of_all>({})));
    add("drag coefficients", "plain", segments, run(plain_drag_of_all));
}

/// A scene that is stepped.
struct NamedScene {
    const char* name;
    SceneFeatures features;
    double offset;  ///< m
};
const NamedScene stepped_scenes[] = {
    {"step free", {}, 0},
    {"step in mud", everything, 0},
    {"step on wall", everything, 0.09},  // all nodes in contact
};

constexpr Tolerances tolerances;
constexpr int settling_steps = 100;
constexpr int compared_steps = 20;
constexpr int steps_at_once = 20;

void add_engine_step(const NamedScene& named, int segments, int threads) {
    const auto run = [named, segments, threads](State& state) {
        const Scene scene = make_scene(segments, named.features, named.offset);
        DormandPrince integrator(scene, tolerances, threads);
        integrator.advance(1e9, settling_steps);
        const auto attempts = [&] {
            const StepStatistics s = integrator.statistics();
            return s.steps + s.rejected;
        };
        const auto before = attempts();
        for ([[maybe_unused]] auto _ : state)
            integrator.advance(1e9, steps_at_once);
        report(state, static_cast<double>(attempts() - before) * (segments + 1) /
                          static_cast<double>(state.iterations()));
    };
    if (threads == 1) {
        add(named.name, "vector", segments, run);
    } else {
        add(named.name, "vector, 2 threads", segments, run)->UseRealTime();
    }
}

void add_plain_step(const NamedScene& named, int segments) {
    add(named.name, "plain", segments, [named, segments](State& state) {
        const Scene scene = make_scene(segments, named.features, named.offset);
        PlainDormandPrince integrator(scene, tolerances);
        integrator.advance(settling_steps);
        const long before = integrator.attempts();
        for ([[maybe_unused]] auto _ : state)
            integrator.advance(steps_at_once);
        report(state, static_cast<double>(integrator.attempts() - before) * (segments + 1) /
                          static_cast<double>(state.iterations()));
    });
}

/// Both integrators must take the same first steps. Where stability sets the step, the error that
/// controls it is a growing mode, and rounding differences grow tenfold every few steps.
void compare_steps(const NamedScene& named) {
    const Scene scene = make_scene(meshes[1], named.features, named.offset);
    DormandPrince engine(scene, tolerances, 1);
    PlainDormandPrince plain(scene, tolerances);
    engine.advance(1e9, compared_steps);
    plain.advance(compared_steps);
    const double difference = std::abs(engine.time() / plain.time() - 1);
    if (!(difference < 1e-6)) {
        throw std::runtime_error(
            fmt::format("{}: {} steps of the engine and of its scalar twin differ by {:.1e} of the "
                        "time they reach",
                        named.name, compared_steps, difference));
    }
}

void add_all() {
    for (const int segments : meshes) {
        add_strand_kernels(segments);
        add_drag(segments);
        for (const NamedScene& scene : stepped_scenes) {
            add_engine_step(scene, segments, 1);
            add_engine_step(scene, segments, 2);
            add_plain_step(scene, segments);
        }
    }
}

}  // namespace
}  // namespace drillstrand::bench

int main(int count, char** arguments) {
    using namespace drillstrand;
    benchmark::Initialize(&count, arguments);
    if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
    benchmark::AddCustomContext("drillstrand", version() + ", commit " + commit());
    benchmark::AddCustomContext("compiler", "g++ " __VERSION__);
    try {
        for (const auto& scene : bench::stepped_scenes)
            bench::compare_steps(scene);
        bench::add_all();
    } catch (const std::exception& error) {
        std::cerr << "bench_kernels: error: " << error.what() << '\n';
        return 1;
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
