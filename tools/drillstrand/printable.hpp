/// Text that somebody else wrote, for a terminal or a page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace drillstrand::program {

/// One character of UTF-8.
struct Character {
    char32_t code = 0;
    std::size_t bytes = 1;  ///< how many it takes in the text
    bool sound = false;     ///< false: a byte that is no UTF-8
};

/// The first character of a text that is not empty.
Character first_character(std::string_view text);

/// Whether it acts on a terminal or page rather than being seen: control characters, and those that
/// turn the direction of writing.
bool is_control(const Character& character);

/// One line that a terminal shows and does not obey: control characters and bytes that are no
/// UTF-8 appear as \n, \x1b, \u{202e}.
std::string printable(std::string_view text);

}  // namespace drillstrand::program
