/// Quantities with units, as case files and table headers write them: "65 kN", "19.5 lb/ft".
#pragma once

#include <string>
#include <string_view>

namespace drillstrand {

/// Powers of the base dimensions. Angles and counts have none; rates of turning are 1/s.
struct Dimension {
    int mass = 0;
    int length = 0;
    int time = 0;
    bool operator==(const Dimension&) const = default;
};

/// Dimensions that case files use.
namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension angle{};
inline constexpr Dimension length{0, 1, 0};
inline constexpr Dimension time{0, 0, 1};
inline constexpr Dimension frequency{0, 0, -1};  ///< "Hz" and "rpm" convert to rad/s
inline constexpr Dimension speed{0, 1, -1};
inline constexpr Dimension acceleration{0, 1, -2};
inline constexpr Dimension force{1, 1, -2};
inline constexpr Dimension moment{1, 2, -2};
inline constexpr Dimension moment_of_inertia{1, 2, 0};
inline constexpr Dimension stiffness{1, 0, -2};
inline constexpr Dimension mass{1, 0, 0};
inline constexpr Dimension power{1, 2, -3};
inline constexpr Dimension pressure{1, -1, -2};  ///< also stiffness per length
inline constexpr Dimension viscosity{1, -1, -1};
inline constexpr Dimension density{1, -3, 0};
inline constexpr Dimension area{0, 2, 0};
inline constexpr Dimension flow_rate{0, 3, -1};
inline constexpr Dimension linear_density{1, -1, 0};
inline constexpr Dimension curvature{0, -1, 0};
inline constexpr Dimension bending_stiffness{1, 3, -2};
inline constexpr Dimension inertia_per_length{1, 1, 0};
}  // namespace dimension

/// Value of "NUMBER UNIT" in SI. Throws std::invalid_argument whose text says what is wrong and
/// what would be right (unknown unit, with the nearest known one; wrong dimension).
double parse_quantity(std::string_view text, const Dimension& expected);

/// Factor that turns a number in `unit` into SI. Throws like parse_quantity.
double unit_factor(std::string_view unit, const Dimension& expected);

}  // namespace drillstrand
