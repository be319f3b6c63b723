#include "input/header_names.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

#include "input/wording.hpp"

namespace drillstrand {

namespace {

constexpr std::string_view separators = " \t_-.,";

/// Units in words that units.cpp does not know, in lower case.
constexpr std::array<std::pair<std::string_view, std::string_view>, 16> words{{
    {"feet", "ft"},
    {"foot", "ft"},
    {"usft", "ftUS"},
    {"ftus", "ftUS"},
    {"metre", "m"},
    {"metres", "m"},
    {"meter", "m"},
    {"meters", "m"},
    {"mtr", "m"},
    {"degree", "deg"},
    {"degrees", "deg"},
    {"degs", "deg"},
    {"dega", "deg"},
    {"º", "deg"},  // the ordinal sign, which keyboards have where others have the degree
    {"radian", "rad"},
    {"radians", "rad"},
}};

constexpr std::array<std::string_view, 5> norths{"grid", "true", "magnetic", "gn", "tn"};

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

bool is_unit(std::string_view word, const Dimension& dimension) {
    try {
        static_cast<void>(unit_factor(word, dimension));
        return true;
    } catch (const std::invalid_argument&) {
        return false;
    }
}

/// The text without separators, and where its last word begins in it.
struct Joined {
    std::string text;
    std::size_t last_word = 0;
};

Joined joined(std::string_view name) {
    Joined result;
    bool separated = true;
    for (const char c : name) {
        if (separators.find(c) != std::string_view::npos) {
            separated = true;
            continue;
        }
        if (separated) result.last_word = result.text.size();
        separated = false;
        result.text += c;
    }
    return result;
}

bool contains(std::span<const std::string_view> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

HeaderField split_header(std::string_view text) {
    HeaderField field;
    const std::size_t first = text.find_first_of("[(");
    field.name = lower_case(trimmed(text.substr(0, first)));
    std::string_view rest = first == std::string_view::npos ? "" : text.substr(first);
    while (!rest.empty()) {
        const char closing = rest.front() == '[' ? ']' : ')';
        const std::size_t end = rest.find(closing);
        const std::size_t next = std::min(rest.find_first_of("[(", 1), rest.size());
        if (end == std::string_view::npos || !trimmed(rest.substr(end + 1, next - end - 1)).empty())
            field.unclosed = closing;
        const std::string_view content = trimmed(rest.substr(1, std::min(end, next) - 1));
        if (!contains(norths, lower_case(content))) field.unit = content;
        rest.remove_prefix(next);
    }
    return field;
}

std::optional<std::string> unit_if_named(const HeaderField& field, const KnownColumn& column,
                                         std::span<const std::string_view> names) {
    const Joined name = joined(field.name);
    if (contains(names, name.text)) return field.unit;
    const std::string_view text = name.text;
    if (!field.unit.empty() || !contains(names, text.substr(0, name.last_word)))
        return std::nullopt;
    return known_unit(text.substr(name.last_word), column.dimension);
}

std::optional<std::string> known_unit(std::string_view word, const Dimension& dimension) {
    // "1" starts units such as 1/m
    if (word.empty() || (word.front() >= '0' && word.front() <= '9')) return std::nullopt;
    if (is_unit(word, dimension)) return std::string(word);
    std::string lower = lower_case(word);
    for (const auto& [spoken, unit] : words)
        if (spoken == lower) lower = unit;
    if (is_unit(lower, dimension)) return lower;
    return std::nullopt;
}

std::string_view without_brackets(std::string_view text) {
    const bool in_brackets = text.size() > 1 && ((text.front() == '[' && text.back() == ']') ||
                                                 (text.front() == '(' && text.back() == ')'));
    return trimmed(in_brackets ? text.substr(1, text.size() - 2) : text);
}

}  // namespace drillstrand
