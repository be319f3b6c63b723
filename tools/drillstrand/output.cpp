#include "output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <system_error>

#include "commands.hpp"
#include "drillstrand/torque_drag_file.hpp"
#include "read_apart.hpp"

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;

/// How the tables of export and calibrate begin.
constexpr std::array table_starts = {
    std::string_view("time[s],head_stress_twist_moment["),
    std::string_view("time[s],arc_length[m],position_north["),
    std::string_view("time[s],arc_length[m],twist_moment["),
    std::string_view("measured_depth[m],north[m],east[m],down[m],radius[m]"),
    std::string_view("bit_depth[m],load,measured["),
};

/// How those of torque-drag begin: with the first column of the first motion behind the depth.
bool is_torque_drag_table(std::string_view text) {
    constexpr std::array motions = {TorqueDragMotion::tripping_in, TorqueDragMotion::tripping_out,
                                    TorqueDragMotion::rotating, TorqueDragMotion::drilling,
                                    TorqueDragMotion::sliding};
    const std::string depth = torque_drag_depth_datasets().front().name;
    const std::string along = torque_drag_profile_datasets().front().name;
    return std::any_of(motions.begin(), motions.end(), [&](TorqueDragMotion motion) {
        const std::string name = motion_name(motion);
        return text.starts_with(fmt::format("bit_depth[m],{}_{}", name, depth)) ||
               text.starts_with(fmt::format("measured_depth[m],{}_{}", name, along));
    });
}

/// The first bytes of a file.
std::string start_of(const fs::path& path) {
    std::string text(512, '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

}  // namespace

std::vector<InputFile> inputs_of(const Case& input) {
    std::vector<InputFile> inputs;
    for (const fs::path& path : input.files)
        inputs.push_back({path, inputs.empty() ? "the case file" : "an input of the case"});
    return inputs;
}

void require_output(std::string_view option, const fs::path& output, const OutputRules& rules) {
    if (output.empty()) return;
    if (output == "-")
        throw UsageError(fmt::format(
            "{0} -: a result cannot go to the standard output; name a file: {0} OUT", option));
    std::error_code ignored;
    for (const InputFile& input : rules.inputs)
        if (fs::equivalent(output, input.path, ignored))
            throw UsageError(fmt::format("{} {}: that is {}; name another file", option,
                                         output.string(), input.words));
    // what is no file is refused by who writes it
    if (!fs::is_regular_file(output, ignored)) return;
    if (!is_own_file(output))
        throw UsageError(
            fmt::format("{} {}: drillstrand did not write the file of that name, and "
                        "leaves it alone; name another file",
                        option, output.string()));
    if (!rules.overwrite)
        throw UsageError(fmt::format(
            "{} {}: there is a file of that name; --overwrite replaces it, or name another file",
            option, output.string()));
}

void require_different(std::string_view option, const fs::path& output,
                       std::string_view other_option, const fs::path& other) {
    if (output.empty() || other.empty() || followed(output) != followed(other)) return;
    throw UsageError(fmt::format("{} {}: that is the file of {}; name another file", option,
                                 output.string(), other_option));
}

bool is_own_file(const fs::path& path) {
    const std::string start = start_of(path);
    if (start.starts_with("\x89HDF\r\n")) return is_own_result_apart(path);
    return start.find("<meta name=\"generator\" content=\"drillstrand\">") != std::string::npos ||
           start.find("<!-- made by drillstrand -->") != std::string::npos ||
           std::any_of(table_starts.begin(), table_starts.end(),
                       [&](std::string_view table) { return start.starts_with(table); }) ||
           is_torque_drag_table(start);
}

}  // namespace drillstrand::program
