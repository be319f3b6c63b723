/// drillstrand run: simulates a case and writes a result file.
#include <fmt/format.h>

#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include "case_of.hpp"
#include "commands.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/checkpoint.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/isa.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/run_summary.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/simulation.hpp"
#include "messages.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "read_apart.hpp"
#include "signals.hpp"
#include "step_estimate.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;

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
    header.cycles = input.output.cycles;
    header.sensors = input.output.sensors;
    return header;
}

/// Takes a run's records to its file, its state to checkpoints and its progress to the person who
/// waits.
class Recorder : public Observer {
  public:
    /// `origin`: where a restarted run goes on.
    Recorder(ResultWriter writer, const Scene& scene, const Case& input,
             const Integrator& integrator, Checkpoint origin, fs::path checkpoint_path, bool quiet)
        : writer_(std::move(writer)),
          integrator_(integrator),
          summary_(scene, input),
          checkpoint_(std::move(origin)),
          checkpoint_path_(std::move(checkpoint_path)),
          checkpoint_interval_(input.output.checkpoint_interval),
          case_warnings_(input.warnings),
          wall_before_(checkpoint_.wall_seconds),
          progress_(checkpoint_.time, input.run.duration, quiet) {
        if (!checkpoint_.summary.empty()) summary_.restore(checkpoint_.summary);
    }

    void on_series(const SeriesRecord& record) override {
        writer_.append(record);
        summary_.add(record);
        ++checkpoint_.series;
    }

    void on_profile(const Profile& profile) override {
        writer_.append(profile);
        ++checkpoint_.profiles;
    }

    void on_bending(const BendingRecord& record) override { summary_.add(record); }

    void on_sensor(std::size_t sensor, const SensorRecord& record) override {
        writer_.append(sensor, record);
    }

    bool on_progress(double time, const StepStatistics& /*statistics*/) override {
        if (writer_.is_stale()) writer_.flush(footer("running"));
        const double since_checkpoint = progress_.wall_seconds() - last_checkpoint_;
        if (checkpoint_interval_ > 0 && since_checkpoint >= checkpoint_interval_) save_state();
        progress_.update(time);
        return !stop_requested();
    }

    /// Writes a checkpoint of the run as it is. A checkpoint that fails is no reason to end it.
    bool save_state() {
        writer_.flush(footer("running"));
        try {
            writer_.sync();
            checkpoint_.time = integrator_.time();
            checkpoint_.wall_seconds = wall_seconds();
            checkpoint_.state = integrator_.save();
            checkpoint_.summary = summary_.save();
            write_checkpoint(checkpoint_path_, checkpoint_);
        } catch (const ResultError& error) {
            progress_.clear();
            say("drillstrand: warning: no checkpoint: {}\n", error.what());
            last_checkpoint_ = progress_.wall_seconds();
            return false;
        }
        last_checkpoint_ = progress_.wall_seconds();
        return true;
    }

    void close(const std::string& status) {
        progress_.clear();
        writer_.close(footer(status));
    }

    [[nodiscard]] double written_until() const { return writer_.written_until(); }
    /// Whether the file is still there, as far as was seen.
    [[nodiscard]] bool holds_results() const { return !writer_.is_lost(); }
    [[nodiscard]] double wall_seconds() const { return wall_before_ + progress_.wall_seconds(); }
    [[nodiscard]] const RunSummary& summary() const { return summary_; }
    [[nodiscard]] const fs::path& checkpoint_path() const { return checkpoint_path_; }

    /// What a user should know of the run so far, a sentence each.
    [[nodiscard]] std::vector<std::string> warnings() const {
        std::vector<std::string> sentences = integrator_.warnings();
        for (std::string& sentence : summary_.warnings())
            sentences.push_back(std::move(sentence));
        return sentences;
    }

  private:
    [[nodiscard]] ResultFooter footer(const std::string& status) const {
        ResultFooter footer;
        footer.status = status;
        footer.wall_seconds = wall_seconds();
        footer.energy_residual = summary_.energy_residual();
        footer.largest_penetration = summary_.largest_penetration();
        footer.time_error_median = summary_.time_error_median();
        const BitConduct bit = summary_.bit();
        footer.stick_slip_index = bit.stick_slip_index;
        footer.stuck_share = bit.stuck;
        footer.unloaded_share = bit.unloaded;
        footer.warnings = case_warnings_;
        for (std::string& warning : warnings())
            footer.warnings.push_back(std::move(warning));
        footer.findings = summary_.findings();
        footer.cycles = summary_.cycles();
        footer.statistics = integrator_.statistics();
        footer.statistics.time_error = summary_.time_error_largest();
        return footer;
    }

    ResultWriter writer_;
    const Integrator& integrator_;
    RunSummary summary_;
    Checkpoint checkpoint_;  ///< the last one, and the counts since
    fs::path checkpoint_path_;
    double checkpoint_interval_;              ///< wall s; 0: none
    double last_checkpoint_ = 0;              ///< wall s of this process
    std::vector<std::string> case_warnings_;  ///< of the case itself, said when it was read
    double wall_before_;                      ///< that the run took before this process (s)
    Progress progress_;
};

/// Of integrators that sample it: the fall from a start that is no equilibrium apart from the rest.
std::string time_error_text(const RunSummary& summary) {
    if (summary.time_error_largest() == 0) return "";
    return fmt::format("; time error of 16 steps {:.2g} % (median), {:.2g} % at most{}",
                       100 * summary.time_error_median(), 100 * summary.time_error_largest(),
                       summary.is_settled()
                           ? fmt::format(" after the first {:.3g} s", summary.settled_after())
                           : "");
}

std::string wall_text(const Scene& scene, const RunSummary& summary) {
    const bool untouched = scene.well && summary.largest_penetration() == 0;
    return untouched ? "; the wall was not touched" : "";
}

void print_summary(const Recorder& recorder, const Scene& scene, const Integrator& integrator,
                   const fs::path& output) {
    for (const std::string& warning : recorder.warnings())
        say("drillstrand: warning: {}\n", warning);
    for (const std::string& finding : recorder.summary().findings())
        say("drillstrand: {}\n", finding);
    const StepStatistics statistics = integrator.statistics();
    const RunSummary& summary = recorder.summary();
    const double wall = recorder.wall_seconds();
    say("drillstrand: {:.6g} s simulated in {}: {:.3g} simulated s per s, {} steps, {} "
        "rejected{}{}; "
        "energy out of balance by {:.2g} %. Result: {} (look at it with: drillstrand info {})\n",
        integrator.time(), duration_text(wall), integrator.time() / wall, statistics.steps,
        statistics.rejected, time_error_text(summary), wall_text(scene, summary),
        100 * std::abs(summary.energy_residual()), output.string(), output.string());
}

/// The run broke off: the file says why as far as it can, the error goes on to the caller.
int end_failed(Recorder& recorder, const fs::path& output, const std::string& why) {
    try {
        recorder.close("failed: " + why);
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

int end_interrupted(Recorder& recorder, const fs::path& output) {
    const bool saved = recorder.save_state();
    recorder.close("interrupted");
    std::string how;
    if (saved)
        how = fmt::format("; go on with the same command and --restart {}",
                          recorder.checkpoint_path().string());
    say("drillstrand: interrupted; results up to {:.6g} s are complete in {}{}\n",
        recorder.written_until(), output.string(), how);
    return interrupted;
}

/// Records of each sensor that a run has taken until a checkpoint.
std::vector<std::size_t> sensor_records(const RunSchedule& schedule, const Checkpoint& origin) {
    std::vector<std::size_t> counts;
    for (const SensorCase& sensor : schedule.sensors)
        counts.push_back(records_until(origin.time, sensor.interval, schedule.duration));
    return counts;
}

/// Takes the state of a checkpoint up. Throws ResultError where it is not of this run.
void take_up(const Checkpoint& checkpoint, const fs::path& path, const ResultHeader& header,
             bool same_bits_everywhere, Integrator& integrator) {
    require_same_run(path, checkpoint, header, same_bits_everywhere);
    try {
        integrator.restore(checkpoint.state);
    } catch (const std::invalid_argument& problem) {
        throw ResultError(
            fmt::format("{}: cannot go on from it: {}", path.string(), problem.what()));
    }
}

}  // namespace

int run(const RunOptions& options) {
    const Isa isa = choose_isa(options.isa);
    const fs::path output = output_of(options);
    Case input = case_of(options.case_path, options.overrides);
    require_duration(input);
    const bool goes_on = !options.restart.empty();
    const OutputRules rules{options.overwrite || goes_on, inputs_of(input)};
    const fs::path checkpoint_file = checkpoint_path(output);
    require_output("-o", output, rules);
    require_output("checkpoint", checkpoint_file, {true, rules.inputs});
    if (options.threads >= 0) input.run.threads = options.threads;
    Checkpoint origin;
    // before there are threads, which a process that is copied leaves behind
    if (goes_on) origin = read_checkpoint_apart(options.restart);
    const Scene scene = starting_scene(input);
    IntegratorOptions integration = integrator_options(input.run);
    integration.isa = isa;
    const auto integrator = make_integrator(scene, integration);

    // as asked, or as chosen
    const int threads = input.run.threads > 0 ? input.run.threads : integrator->threads();
    const ResultHeader header = run_header(input, scene, threads, isa);
    if (goes_on) take_up(origin, options.restart, header, input.run.reproducible, *integrator);
    origin.header = header;
    const RecordCounts taken{origin.series, origin.profiles};
    if (!options.quiet)
        for (const std::string& sentence : estimate_step(input, scene).substeps)
            say("drillstrand: substeps: {}\n", sentence);
    watch_signals();
    const RunSchedule schedule = run_schedule(input);
    Recorder recorder(goes_on ? ResultWriter::resume(output, header, taken.series, taken.profiles,
                                                     sensor_records(schedule, origin))
                              : ResultWriter(output, header, rules.existing()),
                      scene, input, *integrator, std::move(origin), checkpoint_file, options.quiet);
    try {
        if (simulate(*integrator, schedule, recorder, taken) == RunOutcome::stopped)
            return end_interrupted(recorder, output);
        recorder.close("complete");
    } catch (const SimulationError& error) {
        return end_failed(recorder, output, error.what());
    } catch (const ResultError& error) {
        return end_failed(recorder, output, error.what());
    } catch (const std::bad_alloc&) {
        return end_failed(recorder, output, "out of memory");
    }
    print_summary(recorder, scene, *integrator, output);
    return done;
}

}  // namespace drillstrand::program
