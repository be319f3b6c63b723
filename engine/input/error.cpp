#include "drillstrand/error.hpp"

#include <fmt/format.h>

#include "input/wording.hpp"

namespace drillstrand {

namespace {

/// One line, whatever file names and quoted values hold.
std::string describe(const SourceLocation& where, const std::string& problem) {
    if (where.line == 0) return on_one_line(fmt::format("{}: {}", where.file, problem));
    return on_one_line(fmt::format("{}:{}:{}: {}", where.file, where.line, where.column, problem));
}

}  // namespace

InputError::InputError(const SourceLocation& where, const std::string& problem)
    : std::runtime_error(describe(where, problem)), where_(where) {}

}  // namespace drillstrand
