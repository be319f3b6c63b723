/// The program drillstrand: reads the command line, runs a subcommand, turns errors into one line
/// and an exit code.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>
#include <string_view>
#include <system_error>

#include "commands.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/version.hpp"
#include "messages.hpp"
#include "printable.hpp"

namespace drillstrand::program {

namespace {

/// Commands of the interface that later versions bring.
constexpr std::array<std::string_view, 1> later_commands = {"study"};

/// One line, whatever the message quotes: names of files and what strangers wrote into them.
int fail(ExitCode code, std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    say("drillstrand: error: {}\n", printable(message));
    return code;
}

Overrides parse_overrides(const std::vector<std::string>& arguments) {
    Overrides overrides;
    for (const std::string& argument : arguments) {
        const std::size_t equals = argument.find('=');
        if (equals == std::string::npos || equals == 0)
            throw UsageError(fmt::format(
                "--set {}: no value; write --set key.path=value, as in --set run.duration=5",
                argument));
        overrides.emplace_back(argument.substr(0, equals), argument.substr(equals + 1));
    }
    return overrides;
}

/// The command line in CLI11's terms, and the values it fills.
class CommandLine {
  public:
    CommandLine() {
        app_.set_version_flag("--version", fmt::format("drillstrand {} ({})", version(), commit()));
        app_.set_help_flag("-h,--help", "Print this help");
        app_.require_subcommand(0, 1);
        add_run();
        add_check();
        add_buckling();
        add_modes();
        add_equilibrium();
        add_torque_drag();
        add_calibrate();
        add_report();
        add_export();
        add_info();
        for (CLI::App* command : {run_, check_, buckling_, modes_, equilibrium_, torque_drag_,
                                  calibrate_, report_, export_, info_})
            command->set_version_flag("--version", app_.version());
    }

    int execute(int argc, char** argv) {
        refuse_later_command(argc, argv);
        try {
            app_.parse(argc, argv);
        } catch (const CLI::Success& help_or_version) {
            std::ostringstream text;
            const int code = app_.exit(help_or_version, text, text);
            fmt::print("{}", text.str());
            return code;
        } catch (const CLI::ParseError& error) {
            throw UsageError(
                fmt::format("{}; see {} --help", describe(error, argc, argv), command_name()));
        }
        refuse_empty_values();
        if (run_->parsed()) return start_run();
        if (check_->parsed()) return check({case_path_, parse_overrides(overrides_)});
        if (buckling_->parsed()) return start_buckling();
        if (modes_->parsed()) return start_modes();
        if (equilibrium_->parsed())
            return equilibrium({case_path_, output_, parse_overrides(overrides_), overwrite_});
        if (torque_drag_->parsed())
            return torque_drag({case_path_, output_, table_path_, profile_table_path_,
                                parse_overrides(overrides_), overwrite_});
        if (calibrate_->parsed())
            return calibrate(
                {case_path_, measured_path_, table_path_, parse_overrides(overrides_), overwrite_});
        if (report_->parsed())
            return report({result_path_, output_, measured_path_, offset_, follow_, overwrite_});
        if (export_->parsed())
            return export_result({result_path_, output_, vtk_, csv_, overwrite_});
        if (info_->parsed()) return info(result_path_);
        throw UsageError("no command; see drillstrand --help");
    }

  private:
    void add_run() {
        run_ = app_.add_subcommand("run", "Simulate a case and write a result file");
        run_->add_option("CASE.toml", case_path_, "The case to simulate")->required();
        run_->add_option("-o,--output", output_,
                         "Result file; default: the case's name with .h5, in the working directory")
            ->type_name("OUT.h5");
        run_->add_option("--threads", threads_, "Threads to use; 0: all cores")
            ->check(CLI::Range(0, 4096))
            ->type_name("N");
        run_->add_option("--isa", isa_, "Instruction set of the kernels; default: the best one")
            ->check(CLI::IsMember({"baseline", "avx2", "avx512"}))
            ->type_name("baseline|avx2|avx512");
        add_overrides(*run_);
        add_overwrite(*run_);
        run_->add_flag("--quiet", quiet_, "No progress on the error stream");
        run_->add_option("--restart", restart_,
                         "Go on from a checkpoint, bit for bit, and append to the result")
            ->type_name("OUT.checkpoint.h5");
    }

    void add_check() {
        check_ = app_.add_subcommand(
            "check", "Read and validate a case, print its scene and cost; simulate nothing");
        check_->add_option("CASE.toml", case_path_, "The case to check")->required();
        add_overrides(*check_);
    }

    void add_buckling() {
        buckling_ = app_.add_subcommand(
            "buckling", "Print the critical loads of the straight string, clamped at the head");
        buckling_->add_option("CASE.toml", case_path_, "The case with the string")->required();
        buckling_
            ->add_option("--modes", buckling_modes_,
                         "Number of modes, which come in pairs of one load; default: six, or all "
                         "where there are fewer")
            ->check(CLI::Range(1, 1000000))
            ->type_name("M");
        buckling_
            ->add_option("--at-load", at_load_,
                         "Also find the unstable shapes under this load at the tip, as in "
                         "\"10 kN\"; default: none")
            ->type_name("FORCE");
        buckling_->add_flag("--paper", paper_,
                            "The paper's discretisation: segments of constant strain, a whole "
                            "segment's weight at the tip");
        buckling_
            ->add_option("-o,--output", output_, "File for loads, modes and shapes; default: none")
            ->type_name("OUT.h5");
        add_overrides(*buckling_);
        add_overwrite(*buckling_);
    }

    void add_modes() {
        modes_ = app_.add_subcommand(
            "modes", "Print how the string vibrates about its static state, and write its modes");
        modes_->add_option("CASE.toml", case_path_, "The case with the string")->required();
        modes_->add_option("--number", vibration_.number, "Number of modes; default: 10")
            ->check(CLI::Range(1, 1000000))
            ->type_name("N");
        modes_
            ->add_option("--rpm", vibration_.rpm,
                         "Rate at which the string turns; default: that of the case's equilibrium")
            ->check(CLI::Range(0.0, 100000.0))
            ->type_name("RPM");
        modes_
            ->add_option("--campbell", vibration_.campbell,
                         "Also frequencies over a range of rates, and critical speeds, as in "
                         "0:200:10; default: none")
            ->type_name("FROM:TO[:STEP]");
        modes_
            ->add_option("--orders", vibration_.orders,
                         "Orders of critical speeds, as in 1,3,6; default: 1 and that of the bit's "
                         "blades or cones")
            ->delimiter(',')
            ->check(CLI::Range(0.001, 1000.0))
            ->type_name("N,N,...");
        modes_->add_flag("--unbalance", vibration_.unbalance,
                         "Also the response to the string's eccentric masses, at --rpm or over the "
                         "range of --campbell");
        modes_
            ->add_option("--bit-force", vibration_.bit_force,
                         "Also the response to a force along the bit of this amplitude, as in "
                         "\"10 kN\"; default: none")
            ->type_name("FORCE");
        modes_
            ->add_option("--bit-torque", vibration_.bit_torque,
                         "Also the response to a torque about the bit of this amplitude, as in "
                         "\"1 kN m\"; default: none")
            ->type_name("TORQUE");
        modes_
            ->add_option("--bit-order", vibration_.bit_order,
                         "Order of these two; default: that of the bit's blades or cones, or 1")
            ->check(CLI::Range(0.001, 1000.0))
            ->type_name("N");
        modes_
            ->add_option("-o,--output", output_,
                         "Result file; default: the case's name with _modes.h5, in the working "
                         "directory")
            ->type_name("OUT.h5");
        add_overrides(*modes_);
        add_overwrite(*modes_);
    }

    void add_equilibrium() {
        equilibrium_ = app_.add_subcommand(
            "equilibrium",
            "Print the equilibrium under the final loads, at rest or in steady motion");
        equilibrium_->add_option("CASE.toml", case_path_, "The case with the string")->required();
        equilibrium_->add_option("-o,--output", output_, "File for the equilibrium; default: none")
            ->type_name("OUT.h5");
        add_overrides(*equilibrium_);
        add_overwrite(*equilibrium_);
    }

    void add_torque_drag() {
        torque_drag_ = app_.add_subcommand(
            "torque-drag", "Print hook load and surface torque against the depth of the bit");
        torque_drag_->add_option("CASE.toml", case_path_, "The case with well and string")
            ->required();
        torque_drag_->add_option("-o,--output", output_, "File for all results; default: none")
            ->type_name("OUT.h5");
        torque_drag_->add_option("--csv", table_path_, "Table of all depths; default: none")
            ->type_name("OUT.csv");
        torque_drag_
            ->add_option("--profile-csv", profile_table_path_,
                         "Table along the string at the last depth; default: none")
            ->type_name("OUT.csv");
        add_overrides(*torque_drag_);
        add_overwrite(*torque_drag_);
    }

    void add_calibrate() {
        calibrate_ = app_.add_subcommand(
            "calibrate", "Fit friction and block weight to measured hook loads and torques");
        calibrate_->add_option("CASE.toml", case_path_, "The case with well and string")
            ->required();
        calibrate_
            ->add_option("POINTS.csv", measured_path_,
                         "Table of measured points: depth, pick_up, slack_off, rotating, torque")
            ->required();
        calibrate_
            ->add_option("--csv", table_path_, "Table of points beside the fit; default: none")
            ->type_name("OUT.csv");
        add_overrides(*calibrate_);
        add_overwrite(*calibrate_);
    }

    void add_report() {
        report_ = app_.add_subcommand("report", "Write a page of pictures of a result file");
        report_->add_option("OUT.h5", result_path_, "The result file")->required();
        report_
            ->add_option(
                "-o,--output", output_,
                "The page; default: the result's name with .html, in the working directory")
            ->type_name("OUT.html");
        report_
            ->add_option("--compare", measured_path_,
                         "Table of measured channels to lay beside: time, hook_load, torque")
            ->type_name("MEASURED.csv");
        report_
            ->add_option("--offset", offset_,
                         "What to add to measured times, as in \"30 s\" or \"-2 min\"")
            ->type_name("TIME");
        report_->add_flag("--follow", follow_, "Write the page again until the run ends");
        add_overwrite(*report_);
    }

    void add_export() {
        export_ =
            app_.add_subcommand("export", "Write a result file for ParaView or a spreadsheet");
        export_->add_option("OUT.h5", result_path_, "The result file")->required();
        export_->add_flag("--vtk", vtk_, "String and well for ParaView: open string.pvd, well.vtp");
        export_->add_flag("--csv", csv_, "Tables of series and profiles, comma-separated");
        export_
            ->add_option("-o,--output", output_,
                         "The folder; default: the result's stem, in the working directory")
            ->type_name("DIR");
        add_overwrite(*export_);
    }

    void add_info() {
        info_ = app_.add_subcommand("info", "Print what a result file holds and how it was made");
        info_->add_option("OUT.h5", result_path_, "The result file")->required();
    }

    void add_overrides(CLI::App& command) {
        command.add_option("--set", overrides_, "Replace a value of the case; may be repeated")
            ->type_name("key.path=value")
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }

    void add_overwrite(CLI::App& command) {
        command.add_flag("--overwrite", overwrite_,
                         "Replace files of the same names, where drillstrand wrote them");
    }

    /// An option that is given says something.
    void refuse_empty_values() const {
        for (const CLI::App* command : app_.get_subcommands()) {
            for (const CLI::Option* option : command->get_options()) {
                const std::vector<std::string>& values = option->results();
                if (std::find(values.begin(), values.end(), "") != values.end())
                    throw UsageError(fmt::format("{}: nothing given; expected {}",
                                                 option->get_name(), option->get_type_name()));
            }
        }
    }

    int start_run() {
        RunOptions options;
        options.case_path = case_path_;
        options.output = output_;
        options.threads = threads_;
        options.isa = isa_;
        options.restart = restart_;
        options.overrides = parse_overrides(overrides_);
        options.quiet = quiet_;
        options.overwrite = overwrite_;
        return run(options);
    }

    int start_buckling() {
        BucklingOptions options;
        options.case_path = case_path_;
        options.output = output_;
        if (buckling_modes_ > 0) options.modes = static_cast<std::size_t>(buckling_modes_);
        options.at_load = at_load_;
        if (paper_) options.discretisation = Discretisation::paper;
        options.overrides = parse_overrides(overrides_);
        options.overwrite = overwrite_;
        return buckling(options);
    }

    int start_modes() {
        vibration_.case_path = case_path_;
        vibration_.output = output_;
        vibration_.overrides = parse_overrides(overrides_);
        vibration_.overwrite = overwrite_;
        return modes(vibration_);
    }

    static void refuse_later_command(int argc, char** argv) {
        if (argc < 2) return;
        const std::string_view command = argv[1];
        if (std::find(later_commands.begin(), later_commands.end(), command) !=
            later_commands.end())
            throw UsageError(fmt::format("{} is not available in this version", command));
    }

    /// CLI11's words, but for an unknown command, where they do not say what would be right.
    [[nodiscard]] std::string describe(const CLI::ParseError& error, int argc, char** argv) const {
        const bool is_command = argc > 1 && argv[1][0] != '-';
        if (is_command && app_.get_subcommands().empty())
            return fmt::format(
                "unknown command '{}'; the commands are run, check, buckling, modes, "
                "equilibrium, torque-drag, calibrate, report, export and info",
                argv[1]);
        return error.what();
    }

    [[nodiscard]] std::string command_name() const {
        const auto commands = app_.get_subcommands();
        return commands.empty() ? "drillstrand" : "drillstrand " + commands.front()->get_name();
    }

    CLI::App app_{"Simulates drill strings: rods in wells, with contact, friction and fluid.",
                  "drillstrand"};
    CLI::App* run_ = nullptr;
    CLI::App* check_ = nullptr;
    CLI::App* buckling_ = nullptr;
    CLI::App* modes_ = nullptr;
    CLI::App* equilibrium_ = nullptr;
    CLI::App* torque_drag_ = nullptr;
    CLI::App* calibrate_ = nullptr;
    CLI::App* report_ = nullptr;
    CLI::App* export_ = nullptr;
    CLI::App* info_ = nullptr;
    std::string case_path_;
    std::string result_path_;
    std::string output_;
    std::string table_path_;
    std::string profile_table_path_;
    std::string measured_path_;
    std::string offset_;
    std::string restart_;
    int threads_ = -1;
    std::string isa_;
    int buckling_modes_ = 0;
    ModesCommand vibration_;
    std::string at_load_;
    bool paper_ = false;
    std::vector<std::string> overrides_;
    bool quiet_ = false;
    bool follow_ = false;
    bool vtk_ = false;
    bool csv_ = false;
    bool overwrite_ = false;
};

int fail_at_output(int error) {
    if (error == 0) return done;
    return fail(simulation_failed, fmt::format("standard output: cannot write: {}",
                                               std::generic_category().message(error)));
}

/// The command; every error becomes one line.
int execute(int argc, char** argv) {
    try {
        return CommandLine().execute(argc, argv);
    } catch (const UsageError& error) {
        return fail(wrong_input, error.what());
    } catch (const InputError& error) {
        return fail(wrong_input, error.what());
    } catch (const WriteError& error) {
        return fail(simulation_failed, error.what());
    } catch (const ResultError& error) {
        return fail(wrong_input, error.what());
    } catch (const std::system_error& error) {
        if (std::ferror(stdout) == 0) return fail(simulation_failed, error.what());
        const int why = error.code().value();
        // a reader who closed the pipe has had enough
        if (why == EPIPE) std::clearerr(stdout);
        return fail_at_output(why == EPIPE ? 0 : why);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        return fail(simulation_failed, error.what());
    }
}

/// Ends the program where a function of a library that promised not to throw did: some of them (of
/// toml++) allocate memory all the same.
[[noreturn]] void end_at_once() noexcept {
    std::string_view line =
        "drillstrand: error: a library gave up: out of memory, or a fault of its own\n";
    try {
        if (const std::exception_ptr thrown = std::current_exception())
            std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        line = "drillstrand: error: out of memory\n";
    } catch (...) {
        // the line stands
    }
    write_message(line);
    std::_Exit(simulation_failed);
}

}  // namespace

}  // namespace drillstrand::program

int main(int argc, char** argv) {
    using namespace drillstrand::program;
    open_missing_streams();
    std::set_terminate(end_at_once);
    std::signal(SIGPIPE, SIG_IGN);
    int code = simulation_failed;
    try {
        code = execute(argc, argv);
        const int error = finish_standard_output();
        if (code == done) code = fail_at_output(error);
    } catch (...) {
        write_message("drillstrand: error: out of memory\n");
    }
    // After a failure HDF5's own work at the end of a process would try once more, and say so.
    if (code == simulation_failed) std::_Exit(code);
    return code;
}
