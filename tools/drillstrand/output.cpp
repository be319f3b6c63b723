#include "output.hpp"

#include <fmt/format.h>

#include <system_error>

#include "commands.hpp"
#include "drillstrand/buckling_file.hpp"
#include "drillstrand/torque_drag_file.hpp"

namespace drillstrand::program {

std::filesystem::path checked_output(const std::filesystem::path& output,
                                     const std::filesystem::path& case_path) {
    if (output == "-")
        throw UsageError("-o -: a result cannot go to the standard output; name a file: -o OUT.h5");
    std::error_code ignored;
    if (std::filesystem::equivalent(output, case_path, ignored))
        throw UsageError(
            fmt::format("-o {}: that is the case file; name another file", output.string()));
    return output;
}

std::optional<std::string_view> other_contents(const std::filesystem::path& result) {
    if (holds_buckling(result)) return "buckling modes";
    if (holds_torque_drag(result)) return "torque and drag";
    return std::nullopt;
}

}  // namespace drillstrand::program
