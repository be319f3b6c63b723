/// Names of columns and units as people write them: "MD_ft", "Measured Depth (m)", "Azi [°]".
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drillstrand/units.hpp"

namespace drillstrand {

/// A column that a table is asked for. Names are in lower case, without spaces or underscores.
struct KnownColumn {
    std::string_view name;  ///< by which the program knows it
    Dimension dimension;
    std::span<const std::string_view> names;      ///< that mean it
    std::span<const std::string_view> fallbacks;  ///< that mean it where none of the names is there
};

/// One field of a header, taken apart.
struct HeaderField {
    std::string name;   ///< lower case, without the unit
    std::string unit;   ///< empty where there is none
    char unclosed = 0;  ///< the bracket that should end it and does not
};

/// NAME[UNIT] or NAME (UNIT). A word in brackets that says what north is (grid, true, magnetic)
/// is no unit.
HeaderField split_header(std::string_view text);

/// The unit of a header that means `column` by one of `names`, also of NAME_UNIT ("" where it has
/// none); none where it means something else.
std::optional<std::string> unit_if_named(const HeaderField& field, const KnownColumn& column,
                                         std::span<const std::string_view> names);

/// The unit that people mean by a word, as units.hpp writes it: "ft" for "Feet", "deg" for "°";
/// none where it is no unit of this dimension.
std::optional<std::string> known_unit(std::string_view word, const Dimension& dimension);

/// A unit in a field of its own, with or without brackets.
std::string_view without_brackets(std::string_view text);

}  // namespace drillstrand
