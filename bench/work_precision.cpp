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
#include "drillstrand/equilibrium.hpp"
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
    // equilibria are those of the leapfrog's rod; ARKODE integrates the strand of dormand-prince
    const bool director_rod = job.method == "leapfrog" || job.method == "equilibrium";
    list.emplace_back("run.integrator", director_rod ? "\"leapfrog\"" : "\"dormand-prince\"");
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
    if (job.method == "equilibrium") {
        const auto found = std::make_shared<Equilibrium>();
        found->profile = make_integrator(scene, {})->profile();
        return {[found, &scene](double) { *found = find_equilibrium(scene); },
                [found] { return found->profile; },
                [found] {
                    StepStatistics statistics;
                    statistics.steps = found->iterations;
                    return statistics;
                }};
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

/// A component of the stress at a node: of the cubic whose means over the four nearest segments are
/// those given, since stresses live on segments.
double stress_at(const std::vector<Vector6>& stress, std::size_t node, Eigen::Index component) {
    static constexpr double weight[5][4] = {{25, -23, 13, -3},  // times 1/12; at the first end
                                            {3, 13, -5, 1},     // after the first segment
                                            {-1, 7, 7, -1},
                                            {1, -5, 13, 3},
                                            {-3, 13, -23, 25}};
    const std::size_t first = std::min(node < 2 ? 0 : node - 2, stress.size() - 4);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
        sum += weight[node - first][i] / 12 * stress[first + i][component];
    return sum;
}

/// Size of the bending moment at a node. Releases whose records had no moments at nodes, which this
/// program is built in to be compared with, have the mean of both segments.
template <class AnyProfile>
double bending_at(const AnyProfile& profile, std::size_t node) {
    if constexpr (requires { profile.moment; }) {
        return profile.moment[node].template tail<2>().norm();
    } else {
        const std::size_t below = std::min(node, profile.stress.size() - 1);
        const std::size_t above = node > 0 ? node - 1 : 0;
        return 0.5 * (profile.stress[above] + profile.stress[below]).template segment<2>(1).norm();
    }
}

/// What is compared, at evenly spaced nodes: place, tension, twist moment, bending moment, and the
/// normal force of the wall per length.
std::vector<double> at_stations(const Profile& profile, int stations) {
    const std::size_t segments = profile.stress.size();
    const std::size_t every = segments / static_cast<std::size_t>(stations);
    std::vector<double> row;
    for (std::size_t node = 0; node <= segments; node += every) {
        for (Eigen::Index i = 0; i < 3; ++i)
            row.push_back(profile.position[node][i]);
        row.push_back(stress_at(profile.stress, node, 3));
        row.push_back(stress_at(profile.stress, node, 0));
        row.push_back(bending_at(profile, node));
        row.push_back(profile.normal_force.empty() ? 0.0 : profile.normal_force[node]);
    }
    return row;
}

/// Of a station: three coordinates, tension, twist moment, bending moment, side force.
constexpr std::size_t quantities = 7;

/// The last of several records, with the mean stresses and forces of all.
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
    if (scene.segments % job.stations != 0 || scene.segments < 4) {
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
    app.add_option("--method", job.method, "leapfrog, dormand-prince, arkode or equilibrium")
        ->check(CLI::IsMember({"leapfrog", "dormand-prince", "arkode", "equilibrium"}));
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
