// Runs one case by one method, times the advance alone, and prints the motion as JSON, for
// work_precision.py.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/simulation.hpp"

#ifdef DRILLSTRAND_ARKODE
#include "arkode_strand.hpp"
#endif

namespace drillstrand::bench {
namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

struct Job {
    std::string path;
    std::vector<std::string> settings;
    std::string method = "leapfrog";
    double tolerance = 1e-5;
    int order = 4;
    int stations = 1;
    int means = 1;
    int threads = 1;
    double seconds = 0;
    int most_repetitions = 1;
};

/// A method in the middle of a run.
struct Runner {
    std::function<void(double)> advance;
    std::function<Profile()> profile;
    std::function<StepStatistics()> statistics;
};

Overrides overrides(const Job& job) {
    Overrides list;
    for (const std::string& setting : job.settings) {
        const std::size_t at = setting.find('=');
        if (at == std::string::npos) throw std::invalid_argument("--set " + setting + ": no '='");
        list.emplace_back(setting.substr(0, at), setting.substr(at + 1));
    }
    if (job.method != "arkode") list.emplace_back("run.integrator", '"' + job.method + '"');
    return list;
}

Runner make_runner(const Job& job, const Case& input, const Scene& scene) {
    if (job.method == "arkode") {
#ifdef DRILLSTRAND_ARKODE
        const auto strand = std::make_shared<ArkodeStrand>(scene, job.tolerance, job.order);
        return {[strand](double end) { strand->advance(end); },
                [strand] { return strand->profile(); }, [strand] { return strand->statistics(); }};
#else
        throw std::runtime_error("this build has no ARKODE: install libsundials-dev and configure");
#endif
    }
    IntegratorOptions options;
    options.kind = input.run.integrator;
    options.absolute_tolerance = input.run.absolute_tolerance;
    options.relative_tolerance = input.run.relative_tolerance;
    options.cfl = input.run.cfl;
    options.threads = job.threads;
    const std::shared_ptr<Integrator> integrator = make_integrator(scene, options);
    constexpr std::int64_t no_limit = std::int64_t{1} << 60U;
    return {[integrator](double end) { integrator->advance(end, no_limit); },
            [integrator] { return integrator->profile(); },
            [integrator] { return integrator->statistics(); }};
}

/// What is compared: place of evenly spaced nodes, and stress there, which lives on the segments to
/// both sides: their mean, or the line through the two nearest at an end. Second order in h.
std::vector<double> at_stations(const Profile& profile, int stations) {
    const std::size_t segments = profile.stress.size();
    const std::size_t every = segments / static_cast<std::size_t>(stations);
    const auto stress = [&](std::size_t node, Eigen::Index component) {
        const auto of = [&](std::size_t segment) { return profile.stress[segment][component]; };
        if (node == 0) return 1.5 * of(0) - 0.5 * of(1);
        if (node == segments) return 1.5 * of(segments - 1) - 0.5 * of(segments - 2);
        return 0.5 * (of(node - 1) + of(node));
    };
    std::vector<double> row;
    for (std::size_t node = 0; node <= segments; node += every) {
        for (Eigen::Index i = 0; i < 3; ++i)
            row.push_back(profile.position[node][i]);
        row.push_back(stress(node, 3));
        row.push_back(stress(node, 0));
    }
    return row;
}

constexpr std::size_t quantities = 5;  // of a station: three coordinates, tension, twist moment

/// The last of several records, with the mean tension and twist moment of all.
std::vector<double> with_mean_stress(const std::vector<std::vector<double>>& parts) {
    std::vector<double> row = parts.back();
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (i % quantities < 3) continue;
        row[i] = 0;
        for (const std::vector<double>& part : parts)
            row[i] += part[i] / static_cast<double>(parts.size());
    }
    return row;
}

struct Outcome {
    double wall = 0;       ///< of all advances (s)
    double processor = 0;  ///< of all threads (s)
    StepStatistics statistics;
    std::vector<double> time;
    std::vector<std::vector<double>> rows;
};

Outcome run_once(const Job& job, const Case& input, const Scene& scene) {
    using Clock = std::chrono::steady_clock;
    const Runner runner = make_runner(job, input, scene);
    Outcome outcome;
    outcome.time.push_back(0.0);
    outcome.rows.push_back(at_stations(runner.profile(), job.stations));
    const double interval = input.output.interval;
    const auto samples = static_cast<int>(input.run.duration / interval + 0.5);
    std::vector<std::vector<double>> parts;
    for (int i = 1; i <= samples * job.means; ++i) {
        const double end = i * interval / job.means;
        const auto start = Clock::now();
        const std::clock_t processor_start = std::clock();
        runner.advance(end);
        outcome.processor += static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
        outcome.wall += std::chrono::duration<double>(Clock::now() - start).count();
        parts.push_back(at_stations(runner.profile(), job.stations));
        if (i % job.means == 0) {
            outcome.time.push_back(end);
            outcome.rows.push_back(with_mean_stress(parts));
            parts.clear();
        }
    }
    outcome.statistics = runner.statistics();
    return outcome;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

void print(const Outcome& outcome, const std::vector<double>& walls,
           const std::vector<double>& processors) {
    const StepStatistics& s = outcome.statistics;
    std::string rows;
    for (const std::vector<double>& row : outcome.rows)
        rows += fmt::format("{}[{:.17g}]", rows.empty() ? "" : ",\n", fmt::join(row, ","));
    std::cout << fmt::format(
        "{{\"wall\": {:.6g}, \"processor\": {:.6g}, \"repetitions\": {}, \"steps\": {}, "
        "\"rejected\": {}, "
        "\"evaluations\": {},\n\"time\": [{:.17g}],\n\"rows\": [{}]}}\n",
        median(walls), median(processors), walls.size(), s.steps, s.rejected, s.evaluations,
        fmt::join(outcome.time, ","), rows);
}

void run(const Job& job) {
    const Case input = read_case(job.path, overrides(job));
    const Scene scene = starting_scene(input);
    if (scene.segments % job.stations != 0 || scene.segments < 2) {
        throw std::invalid_argument(fmt::format("{} segments do not divide into {} stretches",
                                                scene.segments, job.stations));
    }
    std::vector<double> walls;
    std::vector<double> processors;
    double sum = 0;
    std::optional<Outcome> outcome;
    do {
        outcome = run_once(job, input, scene);
        walls.push_back(outcome->wall);
        processors.push_back(outcome->processor);
        sum += outcome->wall;
    } while (sum < job.seconds && static_cast<int>(walls.size()) < job.most_repetitions);
    print(*outcome, walls, processors);
}

}  // namespace
}  // namespace drillstrand::bench

int main(int count, char** arguments) {
    CLI::App app("Times one case by one method and prints its motion as JSON.");
    drillstrand::bench::Job job;
    app.add_option("case", job.path, "case file")->required();
    app.add_option("--set", job.settings, "key.path=value")->take_all();
    app.add_option("--method", job.method, "leapfrog, dormand-prince or arkode")
        ->check(CLI::IsMember({"leapfrog", "dormand-prince", "arkode"}));
    app.add_option("--tolerance", job.tolerance, "of arkode");
    app.add_option("--order", job.order, "of arkode");
    app.add_option("--stations", job.stations, "stretches between the nodes that are reported");
    app.add_option("--means", job.means, "samples that a record's stresses are the mean of");
    app.add_option("--threads", job.threads, "of the engine's integrators");
    app.add_option("--seconds", job.seconds, "repeat until the runs have taken so long in all");
    app.add_option("--most-repetitions", job.most_repetitions, "but not more often than this");
    CLI11_PARSE(app, count, arguments);
    try {
        drillstrand::bench::run(job);
    } catch (const std::exception& error) {
        std::cerr << "bench_work_precision: error: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
