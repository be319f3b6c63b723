/// The units of a page: each quantity in SI and in the field's units, by the engine's table.
#pragma once

#include <string>

#include "drillstrand/units.hpp"

namespace drillstrand::program {

/// A unit of SI and one of the field, with their factors to SI.
struct UnitPair {
    UnitPair(const char* si_unit, const char* field_unit, const Dimension& dimension)
        : si_name(si_unit),
          si(unit_factor(si_unit, dimension)),
          field_name(field_unit),
          field(unit_factor(field_unit, dimension)) {}

    const char* si_name;
    double si;
    const char* field_name;
    double field;
};

namespace page_unit {
inline const UnitPair time{"s", "s", dimension::time};
inline const UnitPair step{"ms", "ms", dimension::time};
inline const UnitPair length{"m", "ft", dimension::length};
inline const UnitPair small_length{"mm", "in", dimension::length};  ///< diameters, offsets
inline const UnitPair force{"kN", "klbf", dimension::force};
inline const UnitPair moment{"kN m", "kft lbf", dimension::moment};
inline const UnitPair energy{"kJ", "kft lbf", dimension::moment};
inline const UnitPair side_force{"kN/m", "lbf/ft", {1, 0, -2}};
inline const UnitPair stress{"MPa", "ksi", dimension::pressure};
inline const UnitPair rotation{"rpm", "rpm", dimension::frequency};
inline const UnitPair mass{"t", "klb", {1, 0, 0}};
}  // namespace page_unit

/// JSON of {QUANTITY: {si: [NAME, FACTOR TO SI], field: [NAME, FACTOR TO SI]}} for the page's
/// script, units.js.
std::string units_json();

}  // namespace drillstrand::program
