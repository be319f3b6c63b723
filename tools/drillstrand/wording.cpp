#include "wording.hpp"

#include <fmt/format.h>

#include <cmath>

namespace drillstrand::program {

std::string duration_text(double seconds) {
    if (!std::isfinite(seconds)) return "unknown";
    if (seconds < 10) return fmt::format("{:.2g} s", seconds);
    const long whole = std::lround(seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    if (whole < 48 * 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
    return fmt::format("{:.1f} days", seconds / 86400);
}

std::string count_text(double count) {
    if (count >= 1e6) return fmt::format("{:.1e}", count);
    const long whole = std::lround(count);
    if (whole < 10000) return fmt::format("{}", whole);
    return fmt::format("{} {:03}", whole / 1000, whole % 1000);
}

std::string unit_of(const std::string& units, std::size_t k) {
    if (units.find(',') == std::string::npos) return units;
    std::size_t start = 0;
    for (; k > 0; --k)
        start = units.find(',', start) + 2;
    return units.substr(start, units.find(',', start) - start);
}

std::string_view motion_word(StringMotion motion) {
    switch (motion) {
        case StringMotion::rotating:
            return "rotating";
        case StringMotion::drilling:
            return "drilling";
        case StringMotion::tripping_in:
            return "tripping in";
        case StringMotion::tripping_out:
            return "tripping out";
        case StringMotion::sliding:
            return "sliding";
        case StringMotion::rest:
            break;
    }
    return "at rest, without friction";
}

FindingText finding_text(const std::string& finding) {
    const std::size_t end = finding.find(": ");
    if (end == std::string::npos) return {"", finding};
    return {finding.substr(0, end), finding.substr(end + 2)};
}

}  // namespace drillstrand::program
