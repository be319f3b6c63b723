/// The subcommands. Each returns the exit code of the program; errors are exceptions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "drillstrand/buckling.hpp"

namespace drillstrand::program {

/// Exit codes of the program.
enum ExitCode { done = 0, simulation_failed = 1, wrong_input = 2, interrupted = 130 };

/// The command line is wrong; what() is one line.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

using Overrides = std::vector<std::pair<std::string, std::string>>;

struct RunOptions {
    std::filesystem::path case_path;
    std::filesystem::path output;   ///< empty: the case's stem + .h5 in the working directory
    int threads = -1;               ///< -1: as the case says; 0: all cores
    std::string isa;                ///< as isa_name(); empty: the best of this machine
    std::filesystem::path restart;  ///< a checkpoint; empty: from the start
    Overrides overrides;
    bool quiet = false;
    bool overwrite = false;
};

int run(const RunOptions& options);

struct CheckOptions {
    std::filesystem::path case_path;
    Overrides overrides;
};

int check(const CheckOptions& options);

struct BucklingOptions {
    std::filesystem::path case_path;
    std::filesystem::path output;      ///< empty: no file
    std::optional<std::size_t> modes;  ///< none: six, or all where there are fewer
    std::string at_load;               ///< with its unit; empty: none
    Discretisation discretisation = Discretisation::beam_column;
    Overrides overrides;
    bool overwrite = false;
};

int buckling(const BucklingOptions& options);

struct ModesCommand {
    std::filesystem::path case_path;
    std::filesystem::path output;  ///< empty: the case's stem + _modes.h5 in the working directory
    std::size_t number = 10;
    std::optional<double> rpm;  ///< at which the string turns; none: as the case's equilibrium does
    std::string campbell;       ///< rates in rpm, "FROM:TO" or "FROM:TO:STEP"; empty: none
    std::vector<double> orders;       ///< of critical speeds; none: those of the bit
    bool unbalance = false;           ///< response to eccentric masses
    std::string bit_force;            ///< amplitude with its unit; empty: none
    std::string bit_torque;           ///< amplitude with its unit; empty: none
    std::optional<double> bit_order;  ///< of these two; none: that of the bit
    Overrides overrides;
    bool overwrite = false;
};

int modes(const ModesCommand& command);

struct EquilibriumCommand {
    std::filesystem::path case_path;
    std::filesystem::path output;  ///< empty: no file
    Overrides overrides;
    bool overwrite = false;
};

int equilibrium(const EquilibriumCommand& command);

struct TorqueDragCommand {
    std::filesystem::path case_path;
    std::filesystem::path output;         ///< HDF5; empty: no file
    std::filesystem::path table;          ///< of all depths (CSV); empty: none
    std::filesystem::path profile_table;  ///< along the string at the last depth; empty: none
    Overrides overrides;
    bool overwrite = false;
};

int torque_drag(const TorqueDragCommand& command);

struct CalibrateOptions {
    std::filesystem::path case_path;
    std::filesystem::path points;  ///< measured
    std::filesystem::path table;   ///< of points and fit (CSV); empty: none
    Overrides overrides;
    bool overwrite = false;
};

int calibrate(const CalibrateOptions& options);

struct ReportOptions {
    std::filesystem::path result;
    std::filesystem::path output;    ///< empty: the result's stem + .html in the working directory
    std::filesystem::path measured;  ///< empty: nothing to compare with
    std::string offset;              ///< of the measured clock, a quantity of time; empty: none
    bool follow = false;             ///< write again until the run ends
    bool overwrite = false;
};

int report(const ReportOptions& options);

struct ExportOptions {
    std::filesystem::path result;
    std::filesystem::path folder;  ///< empty: the result's stem in the working directory
    bool vtk = false;              ///< one of the two formats
    bool csv = false;
    bool overwrite = false;
};

int export_result(const ExportOptions& options);

int info(const std::filesystem::path& result_path);

}  // namespace drillstrand::program
