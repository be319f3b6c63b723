/// drillstrand export: a result file for ParaView or a spreadsheet.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "commands.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/result_file.hpp"
#include "export_csv.hpp"
#include "export_vtk.hpp"
#include "messages.hpp"
#include "output.hpp"
#include "printable.hpp"
#include "read_apart.hpp"

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const ExportOptions& options) {
    fs::path folder = options.folder;
    if (folder.empty()) folder = options.result.stem();
    if (folder == "-")
        throw UsageError(
            "-o -: an export is several files, not for the standard output; name a folder: -o DIR");
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
        throw UsageError(
            fmt::format("-o {}: a file of that name is there; name a folder", folder.string()));
    return folder;
}

Result read_run(const fs::path& path) {
    Contents contents = read_apart(path);
    if (const auto other = other_than_run(contents))
        throw UsageError(
            fmt::format("{}: this holds {}; export takes what drillstrand run or equilibrium wrote",
                        path.string(), *other));
    return std::get<Result>(std::move(contents));
}

void make_folder(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem)
        throw std::runtime_error(
            fmt::format("{}: cannot make the folder: {}", folder.string(), problem.message()));
}

/// Files of before /well was there tell of a well only by what the string did in it.
bool misses_its_well(const Result& result) {
    if (result.header.well || result.profiles.empty()) return false;
    const std::vector<double>& depths = result.profiles.front().well_depth;
    return std::any_of(depths.begin(), depths.end(), [](double depth) { return depth != 0; });
}

void warn(const ExportOptions& options, const Result& result) {
    const std::string path = printable(options.result.string());
    if (misses_its_well(result))
        say("drillstrand: warning: {}: an older drillstrand left out the well; the export "
            "is without it\n",
            path);
    if (result.profiles.empty())
        say("drillstrand: warning: {}: no profiles yet; the export has none\n", path);
}

void write_files(const ExportOptions& options, const fs::path& folder, const Result& result,
                 Existing existing) {
    try {
        if (options.vtk)
            write_vtk(folder, result, existing);
        else
            write_csv(folder, result, existing);
    } catch (const ResultError& error) {
        // some of the files may be there by now
        throw WriteError(error.what());
    }
}

}  // namespace

int export_result(const ExportOptions& options) {
    if (options.vtk == options.csv)
        throw UsageError("export needs one of --vtk (for ParaView) and --csv (for a spreadsheet)");
    const fs::path folder = folder_of(options);
    const Result result = read_run(options.result);
    const OutputRules rules{options.overwrite, {{options.result, "the result file"}}};
    for (const fs::path& file : options.vtk ? vtk_files(folder, result) : csv_files(folder, result))
        require_output("-o", file, rules);
    make_folder(folder);
    warn(options, result);
    write_files(options, folder, result, rules.existing());
    say("drillstrand: {} is in {}\n",
        options.vtk ? "string.pvd, for ParaView," : "series.csv, beside other tables,",
        printable(folder.string()));
    return done;
}

}  // namespace drillstrand::program
