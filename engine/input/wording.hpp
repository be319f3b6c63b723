/// Pieces of error messages.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace drillstrand {

/// The text in quotes, shortened where it is long.
std::string in_quotes(std::string_view text);

/// The text on one line: control characters become spaces.
std::string on_one_line(std::string_view text);

/// The text with its letters A to Z in lower case.
std::string lower_case(std::string_view text);

/// "a, b, c".
std::string listed(std::span<const std::string_view> names);

/// The candidate that differs from `name` by the fewest edits, case counting little, or else one
/// that `name` is a part of; empty where none is close enough to be what was meant.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace drillstrand
