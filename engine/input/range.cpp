#include "input/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace drillstrand {

bool Range::contains(double value) const {
    const bool high_enough = low_open ? value > low : value >= low;
    const bool low_enough = high_open ? value < high : value <= high;
    return high_enough && low_enough;
}

std::string Range::describe() const {
    const bool bounded_below = std::isfinite(low);
    const bool bounded_above = std::isfinite(high);
    const std::string below = fmt::format("{} {}", low_open ? "more than" : "at least", low);
    const std::string above = fmt::format("{} {}", high_open ? "less than" : "at most", high);
    if (bounded_below && bounded_above) {
        if (!low_open && !high_open) return fmt::format("{} to {}", low, high);
        return fmt::format("{} and {}", below, above);
    }
    if (bounded_below) return below;
    return bounded_above ? above : "a finite number";
}

}  // namespace drillstrand
