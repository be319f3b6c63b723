#include "input/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace drillstrand {

namespace {

/// As people write it: 1e6, not 1e+06.
std::string written(double value) {
    std::string text = fmt::format("{:.6g}", value);
    const std::size_t exponent = text.find('e');
    if (exponent == std::string::npos) return text;
    std::size_t digits = exponent + 1;
    if (text[digits] == '+') text.erase(digits, 1);
    if (text[digits] == '-') ++digits;
    if (text[digits] == '0') text.erase(digits, 1);
    return text;
}

}  // namespace

bool Range::contains(double value) const {
    const bool high_enough = low_open ? value > low : value >= low;
    const bool low_enough = high_open ? value < high : value <= high;
    return high_enough && low_enough;
}

std::string Range::describe() const {
    const bool bounded_below = std::isfinite(low);
    const bool bounded_above = std::isfinite(high);
    const std::string below =
        fmt::format("{} {}", low_open ? "more than" : "at least", written(low));
    const std::string above =
        fmt::format("{} {}", high_open ? "less than" : "at most", written(high));
    if (bounded_below && bounded_above) {
        if (!low_open && !high_open) return fmt::format("{} to {}", written(low), written(high));
        return fmt::format("{} and {}", below, above);
    }
    if (bounded_below) return below;
    return bounded_above ? above : "a finite number";
}

}  // namespace drillstrand
