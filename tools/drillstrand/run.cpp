/// drillstrand run: simulates a case and writes a result file.
#include <fmt/format.h>

#include <cmath>
#include <new>
#include <utility>

#include "commands.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/energy_audit.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/isa.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/simulation.hpp"
#include "messages.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "signals.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;

constexpr double large_energy_residual = 0.01;

fs::path output_of(const RunOptions& options) {
    if (!options.output.empty()) return options.output;
    return options.case_path.stem().string() + ".h5";
}

/// As asked, or the best one.
Isa choose_isa(const std::string& name) {
    if (name.empty()) return best_isa();
    const Isa isa = isa_from_name(name).value();
    if (isa > best_isa())
        throw UsageError(fmt::format(
            "--isa {}: this machine or build goes up to {}; ask for that or less, or leave it out",
            name, isa_name(best_isa())));
    return isa;
}

ResultHeader run_header(const Case& input, const Scene& scene, int threads, Isa isa) {
    ResultHeader header = result_header(input, scene);
    header.threads = threads;
    header.isa = isa_name(isa);
    return header;
}

/// Takes a run's records to its file and its progress to the person who waits.
class Recorder : public Observer {
  public:
    Recorder(ResultWriter writer, double duration, bool quiet)
        : writer_(std::move(writer)), progress_(duration, quiet) {}

    void on_series(const SeriesRecord& record) override {
        writer_.append(record);
        audit_.add(record.energy);
    }

    void on_profile(const Profile& profile) override { writer_.append(profile); }

    bool on_progress(double time, const StepStatistics& statistics) override {
        if (writer_.is_stale()) writer_.flush(footer("running", statistics));
        progress_.update(time);
        return !stop_requested();
    }

    void close(const std::string& status, const StepStatistics& statistics) {
        progress_.clear();
        writer_.close(footer(status, statistics));
    }

    [[nodiscard]] double written_until() const { return writer_.written_until(); }
    /// Whether the file is still there, as far as was seen.
    [[nodiscard]] bool holds_results() const { return !writer_.is_lost(); }
    [[nodiscard]] double wall_seconds() const { return progress_.wall_seconds(); }
    [[nodiscard]] double energy_residual() const { return audit_.residual(); }

  private:
    [[nodiscard]] ResultFooter footer(const std::string& status,
                                      const StepStatistics& statistics) const {
        ResultFooter footer;
        footer.status = status;
        footer.wall_seconds = progress_.wall_seconds();
        footer.energy_residual = audit_.residual();
        footer.statistics = statistics;
        return footer;
    }

    ResultWriter writer_;
    Progress progress_;
    EnergyAudit audit_;
};

void print_warnings(const Recorder& recorder, const Integrator& integrator) {
    for (const std::string& warning : integrator.warnings())
        say("drillstrand: warning: {}\n", warning);
    const double residual = recorder.energy_residual();
    if (std::abs(residual) <= large_energy_residual) return;
    say("drillstrand: warning: {:.2g} % of the energy that moved {}; the time steps are too "
        "long, or the scene gains energy\n",
        100 * std::abs(residual),
        residual > 0 ? "appeared from nowhere" : "vanished unaccounted for");
}

/// Of integrators that sample it.
std::string time_error_text(const StepStatistics& statistics) {
    if (statistics.time_error == 0) return "";
    return fmt::format(", time error of 16 steps at most {:.2g} %", 100 * statistics.time_error);
}

void print_summary(const Recorder& recorder, const Integrator& integrator, const fs::path& output) {
    const StepStatistics statistics = integrator.statistics();
    const double wall = recorder.wall_seconds();
    say("drillstrand: {:.6g} s simulated in {}: {:.3g} simulated s per s, {} steps, {} "
        "rejected{}. Result: {} (look at it with: drillstrand info {})\n",
        integrator.time(), duration_text(wall), integrator.time() / wall, statistics.steps,
        statistics.rejected, time_error_text(statistics), output.string(), output.string());
}

/// The run broke off: the file says why as far as it can, the error goes on to the caller.
int end_failed(Recorder& recorder, const Integrator& integrator, const fs::path& output,
               const std::string& why) {
    try {
        recorder.close("failed: " + why, integrator.statistics());
    } catch (const std::exception&) {
        // The first failure is the one to report.
    }
    if (recorder.holds_results())
        say("drillstrand: error: {}; results up to {:.6g} s are in {}\n", why,
            recorder.written_until(), output.string());
    else
        say("drillstrand: error: {}\n", why);
    return simulation_failed;
}

int end_interrupted(Recorder& recorder, const Integrator& integrator, const fs::path& output) {
    recorder.close("interrupted", integrator.statistics());
    say("drillstrand: interrupted; results up to {:.6g} s are complete in {}\n",
        recorder.written_until(), output.string());
    return interrupted;
}

}  // namespace

int run(const RunOptions& options) {
    const Isa isa = choose_isa(options.isa);
    const fs::path output = output_of(options);
    Case input = read_case(options.case_path, options.overrides);
    require_duration(input);
    const OutputRules rules{options.overwrite, inputs_of(input)};
    require_output("-o", output, rules);
    if (options.threads >= 0) input.run.threads = options.threads;
    const Scene scene = starting_scene(input);
    IntegratorOptions integration = integrator_options(input.run);
    integration.isa = isa;
    const auto integrator = make_integrator(scene, integration);

    // as asked, or as chosen
    const int threads = input.run.threads > 0 ? input.run.threads : integrator->threads();
    watch_signals();
    Recorder recorder(
        ResultWriter(output, run_header(input, scene, threads, isa), rules.existing()),
        input.run.duration, options.quiet);
    try {
        const RunSchedule schedule{input.run.duration, input.output.interval,
                                   input.output.profile_interval};
        if (simulate(*integrator, schedule, recorder) == RunOutcome::stopped)
            return end_interrupted(recorder, *integrator, output);
        recorder.close("complete", integrator->statistics());
    } catch (const SimulationError& error) {
        return end_failed(recorder, *integrator, output, error.what());
    } catch (const ResultError& error) {
        return end_failed(recorder, *integrator, output, error.what());
    } catch (const std::bad_alloc&) {
        return end_failed(recorder, *integrator, output, "out of memory");
    }
    print_warnings(recorder, *integrator);
    print_summary(recorder, *integrator, output);
    return done;
}

}  // namespace drillstrand::program
