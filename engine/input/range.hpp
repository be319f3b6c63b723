/// Ranges of admissible values.
#pragma once

#include <limits>
#include <string>

namespace drillstrand {

struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;   ///< low itself is outside
    bool high_open = false;  ///< high itself is outside

    [[nodiscard]] bool contains(double value) const;

    /// "more than 0", "0 to 1": what an error message says was expected.
    [[nodiscard]] std::string describe() const;
};

inline constexpr Range any_value{};
inline constexpr Range positive{.low = 0, .low_open = true};
inline constexpr Range not_negative{.low = 0};

}  // namespace drillstrand
