/// Ranges outside of which a value is a slip of the pen: a wrong unit, a lost exponent. Orders of
/// magnitude beyond anything drilled, and far from where arithmetic fails.
#pragma once

#include "input/range.hpp"

namespace drillstrand::plausible {

inline constexpr Range length{.low = 1e-6, .high = 1e6};              // m
inline constexpr Range length_or_none{.low = 0, .high = 1e6};         // m
inline constexpr Range coordinate{.low = -1e6, .high = 1e6};          // m
inline constexpr Range diameter{.low = 1e-6, .high = 1e3};            // m
inline constexpr Range diameter_or_none{.low = 0, .high = 1e3};       // m
inline constexpr Range density{.low = 1e-6, .high = 1e6};             // kg/m3
inline constexpr Range linear_density{.low = 1e-9, .high = 1e9};      // kg/m
inline constexpr Range viscosity{.low = 0, .high = 1e6};              // Pa s
inline constexpr Range elasticity{.low = 1e3, .high = 1e15};          // Pa, also strength
inline constexpr Range stiffness{.low = 1e-9, .high = 1e18};          // N or N m2
inline constexpr Range inertia{.low = 1e-15, .high = 1e9};            // kg m
inline constexpr Range curvature{.low = -1e3, .high = 1e3};           // 1/m
inline constexpr Range bend{.low = -0.8, .high = 0.8};                // rad
inline constexpr Range toolface{.low = -6.3, .high = 6.3};            // rad: a turn either way
inline constexpr Range unbalance{.low = 0, .high = 1e3};              // kg m
inline constexpr Range acceleration{.low = 0, .high = 1e3};           // m/s2
inline constexpr Range load{.low = -1e12, .high = 1e12};              // N or N m
inline constexpr Range load_or_none{.low = 0, .high = 1e12};          // N or N m
inline constexpr Range largest_load{.low = 1e-9, .high = 1e12};       // N, N m or W
inline constexpr Range proportional{.low = 1e-9, .high = 1e12};       // N m s
inline constexpr Range drive_inertia{.low = 0, .high = 1e9};          // kg m2
inline constexpr Range bit_inertia{.low = 0, .high = 1e6};            // kg m2
inline constexpr Range rock_strength{.low = 1, .high = 1e12};         // Pa
inline constexpr Range cutter_inclination{.low = 1e-6, .high = 1e6};  // 1
inline constexpr Range decay{.low = 0, .high = 1e5};                  // rad/s
inline constexpr Range rotation{.low = -1e5, .high = 1e5};            // rad/s
inline constexpr Range slow_rotation{.low = 1e-9, .high = 1e5};       // rad/s
inline constexpr Range speed_or_none{.low = 0, .high = 1e6};          // m/s
inline constexpr Range speed{.low = -1e6, .high = 1e6};               // m/s
inline constexpr Range feed{.low = 1e-9, .high = 1e6};                // m/s
inline constexpr Range block_mass{.low = 1e-3, .high = 1e9};          // kg
inline constexpr Range line_stiffness{.low = 1e-3, .high = 1e15};     // N/m
inline constexpr Range gain{.low = 0, .high = 1e6};                   // m/s over an error
inline constexpr Range wall_stiffness{.low = 1e-3, .high = 1e15};     // Pa
inline constexpr Range wall_damping{.low = 0, .high = 1e15};          // Pa s
inline constexpr Range friction{.low = 0, .high = 1e3};               // 1
inline constexpr Range creep{.low = 0, .high = 1};                    // 1
inline constexpr Range drag_coefficient{.low = 0, .high = 1e3};       // 1
inline constexpr Range damping{.low = 0, .high = 1e12};               // N s/m
inline constexpr Range delay{.low = 0, .high = 1e3};                  // s
inline constexpr Range instant{.low = -1e12, .high = 1e12};           // s
inline constexpr Range duration{.low = 1e-9, .high = 1e9};            // s
inline constexpr Range duration_or_none{.low = 0, .high = 1e9};       // s
inline constexpr Range slope{.low = 1, .high = 20};                   // 1, of an S-N curve
inline constexpr Range factor{.low = 1e-6, .high = 1e6};              // 1
inline constexpr Range factor_or_none{.low = 0, .high = 1e6};         // 1
inline constexpr Range yield_stress{.low = 0, .high = 1e6};           // Pa
inline constexpr Range consistency{.low = 1e-9, .high = 1e6};         // Pa s^n
inline constexpr Range flow_index{.low = 0.1, .high = 1};             // 1
inline constexpr Range flow_rate{.low = 0, .high = 1e3};              // m3/s
inline constexpr Range area_or_none{.low = 0, .high = 1e3};           // m2

}  // namespace drillstrand::plausible
