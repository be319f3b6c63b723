#include "drillstrand/error.hpp"

#include <fmt/format.h>

namespace drillstrand {

namespace {

std::string describe(const SourceLocation& where, const std::string& problem) {
    if (where.line == 0) return fmt::format("{}: {}", where.file, problem);
    return fmt::format("{}:{}:{}: {}", where.file, where.line, where.column, problem);
}

}  // namespace

InputError::InputError(const SourceLocation& where, const std::string& problem)
    : std::runtime_error(describe(where, problem)), where_(where) {}

}  // namespace drillstrand
