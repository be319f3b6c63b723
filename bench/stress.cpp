/// Stability stress test of the leapfrog: random scenes over engineers' ranges, several at a time.
/// One line of CSV per scene on stdout. bench/stress.py runs it and judges the result.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "drillstrand/energy_audit.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/simulation.hpp"
#include "processor_clock.hpp"
#include "stress_scenes.hpp"

namespace drillstrand::bench {

namespace {

struct Options {
    unsigned seed = 1;
    int first = 0;
    int scenes = 200;
    double duration = 20;  ///< s
    double cfl = 0.9;
    int most_segments = 0;
    int jobs = 0;
    bool assemblies = false;
    bool driven = false;
    bool one_step = false;
};

Case scene_case(int index, const Options& options) {
    Case input = options.assemblies ? assembly_scene(options.seed, index, options.duration)
                 : options.driven   ? driven_scene(options.seed, index, options.duration)
                                    : stress_scene(options.seed, index, options.duration);
    input.run.local_steps = !options.one_step;
    return input;
}

/// What a run did that may show an instability.
class Watch : public Observer {
  public:
    void on_series(const SeriesRecord& record) override {
        audit_.add(record.energy);
        most_appeared_ = std::max(most_appeared_, audit_.appeared());
        penetration = std::max(penetration, record.max_penetration);
        last = record;
    }
    void on_profile(const Profile& /*profile*/) override {}
    bool on_progress(double /*time*/, const StepStatistics& /*statistics*/) override {
        return true;
    }
    [[nodiscard]] double residual() const { return audit_.residual(); }
    /// The most energy that had appeared from nowhere at any record, of what moved in the run.
    [[nodiscard]] double gain() const {
        return audit_.moved() > 0 ? most_appeared_ / audit_.moved() : 0;
    }

    double penetration = 0;  ///< m
    SeriesRecord last;

  private:
    EnergyAudit audit_;
    double most_appeared_ = 0;  ///< J
};

struct Outcome {
    std::string kind = "complete";
    std::string why;
};

Outcome run_scene(const Scene& scene, const Options& options, Watch& watch,
                  StepStatistics& statistics) {
    IntegratorOptions choice;
    choice.kind = IntegratorKind::leapfrog;
    choice.cfl = options.cfl;
    choice.threads = 1;
    const auto integrator = make_integrator(scene, choice);
    Outcome outcome;
    try {
        simulate(*integrator, {options.duration, 0.1, 0}, watch);
    } catch (const GuardError& error) {
        outcome = {"guard", error.what()};
    } catch (const SimulationError& error) {
        outcome = {"diverged", error.what()};
    }
    statistics = integrator->statistics();
    return outcome;
}

double steepest_dogleg(const Case& input) {
    const std::vector<double> severities = dogleg_severities(input.well->survey);
    return *std::max_element(severities.begin(), severities.end());
}

std::string describe(const Case& input, const Scene& scene) {
    constexpr double per_30_metres = 30 * 180 / 3.14159265358979323846;
    const bool free = input.head.motion == HeadMotion::free;
    double least = 1e9;
    double most = 0;
    for (const Component& c : input.string.components) {
        least = std::min(least, c.outer_diameter);
        most = std::max(most, c.outer_diameter);
    }
    const double length = total_length(input.string);
    const FluidCase fluid = input.fluid.value_or(FluidCase{});
    return fmt::format(
        "{:.0f},{},{},{:.4f},{:.4f},{:.2f},{},{:.1f},{},{:.0f},{:.1f},{},{:.2f},{:.2f},{:.2f},"
        "{:.2f},{:.3g},{:.3g},{},{:.0f},{:.3f},{:.3g},{:.3g},{:.3g}",
        length, scene.segments, input.string.components.size(), least, most,
        length / scene.segments, input.well->sections.size(),
        steepest_dogleg(input) * per_30_metres, free ? "free" : "driven",
        free ? 0 : input.head.rotation.values().back() * 60 / 6.283185307179586,
        input.bit.weight.values().back() / 1000,
        input.bit.direction == BitDirection::well ? "well" : "follower",
        input.contact.static_friction.axial, input.contact.static_friction.azimuthal,
        input.contact.dynamic_friction.axial, input.contact.dynamic_friction.azimuthal,
        input.contact.normal_stiffness, input.contact.tangential_stiffness,
        input.contact.restitution ? fmt::format("e={:.2f}", *input.contact.restitution)
                                  : fmt::format("{:.3g}", input.contact.normal_damping),
        fluid.density, fluid.drag ? fluid.viscosity : 0.0, input.damping.internal.translation,
        input.damping.external.translation, input.damping.kelvin_voigt);
}

constexpr const char* header =
    "scene,length_m,segments,components,least_diameter_m,most_diameter_m,h_m,well_diameters,"
    "dogleg_deg_30m,head,rotation_rpm,weight_kN,weight_direction,static_axial,static_azimuthal,"
    "dynamic_axial,dynamic_azimuthal,normal_stiffness,tangential_stiffness,normal_damping,"
    "fluid_density,viscosity,internal_damping,external_damping,kelvin_voigt,outcome,time_s,steps,"
    "residual,gain,penetration_m,impacts,slips,processor_s,why";

std::string report(int index, const Options& options) {
    const Case input = scene_case(index, options);
    const double start = processor_seconds();  // this thread does all the work of its scene
    Watch watch;
    StepStatistics statistics;
    const Scene scene = starting_scene(input);
    const Outcome outcome = run_scene(scene, options, watch, statistics);
    const double spent = processor_seconds() - start;
    return fmt::format("{},{},{},{:.1f},{},{:.3g},{:.3g},{:.4g},{},{},{:.2f},\"{}\"\n", index,
                       describe(input, scene), outcome.kind, watch.last.time, statistics.steps,
                       watch.residual(), watch.gain(), watch.penetration, watch.last.impacts,
                       watch.last.slips, spent, outcome.why);
}

bool is_too_large(int index, const Options& options) {
    return options.most_segments > 0 &&
           build_scene(scene_case(index, options)).segments > options.most_segments;
}

void run_all(const Options& options) {
    fmt::print("{}\n", header);
    std::mutex taking;
    std::mutex printing;
    int next = options.first;
    int left = options.scenes;
    // the next scene that is not too large; -1 where there are enough
    const auto take = [&] {
        const std::lock_guard lock(taking);
        if (left == 0) return -1;
        --left;
        while (is_too_large(next, options))
            ++next;
        return next++;
    };
    std::vector<std::jthread> workers;
    const unsigned jobs = options.jobs > 0 ? static_cast<unsigned>(options.jobs)
                                           : std::max(1U, std::thread::hardware_concurrency());
    for (unsigned i = 0; i < jobs; ++i) {
        workers.emplace_back([&] {
            for (int index = take(); index >= 0; index = take()) {
                const std::string line = report(index, options);
                const std::lock_guard lock(printing);
                fmt::print("{}", line);
                std::fflush(stdout);
            }
        });
    }
}

}  // namespace

}  // namespace drillstrand::bench

int main(int argc, char** argv) {
    drillstrand::bench::Options options;
    CLI::App app{"Random scenes for the leapfrog, as CSV"};
    app.add_option("--seed", options.seed, "seed of all scenes")->capture_default_str();
    app.add_option("--first", options.first, "number of the first scene")->capture_default_str();
    app.add_option("--scenes", options.scenes, "how many")->capture_default_str();
    app.add_option("--duration", options.duration, "simulated s of each")->capture_default_str();
    app.add_option("--most-segments", options.most_segments, "leave larger scenes out; 0: none")
        ->capture_default_str();
    app.add_option("--cfl", options.cfl)->capture_default_str();
    app.add_flag("--assemblies", options.assemblies,
                 "strings with tool joints, stabilisers and bits on meshes that follow them");
    app.add_flag(
        "--driven", options.driven,
        "bits that stick, cut or roll, motors, drives, hoists, jars, Hertz walls, moving mud");
    app.add_flag("--one-step", options.one_step, "one step for all, no substeps");
    app.add_option("--jobs", options.jobs, "scenes at a time; 0: all cores")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    drillstrand::bench::run_all(options);
}
