#include "input/wording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "input/utf8.hpp"

namespace drillstrand {

namespace {

constexpr std::size_t longest_quote = 60;  // bytes
constexpr std::size_t longest_name = 60;   // bytes that are compared
constexpr std::size_t shortest_part = 4;   // letters by which a part of a name is told
constexpr int letter_edit = 4;             // a wrong, missing or added letter
constexpr int case_edit = 1;               // the right letter in the wrong case

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

int substitution(char a, char b) {
    if (a == b) return 0;
    return lower(a) == lower(b) ? case_edit : letter_edit;
}

/// Levenshtein distance with a small weight for case; `b` of at most longest_name bytes.
int edit_distance(std::string_view a, std::string_view b) {
    std::array<int, longest_name + 1> row{};
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = static_cast<int>(j) * letter_edit;
    for (const char c : a) {
        int diagonal = row[0];
        row[0] += letter_edit;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const int replaced = diagonal + substitution(c, b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + letter_edit, row[j + 1] + letter_edit});
        }
    }
    return row[b.size()];
}

}  // namespace

std::string in_quotes(std::string_view text) {
    if (text.size() <= longest_quote) return fmt::format("\"{}\"", text);
    const std::string_view start = text.substr(0, longest_quote);
    return fmt::format("\"{}...\"", start.substr(0, valid_text_prefix(start)));
}

std::string on_one_line(std::string_view text) {
    std::string line(text);
    for (char& c : line) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20U || code == 0x7FU) c = ' ';
    }
    return line;
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = lower(c);
    return result;
}

std::string listed(std::span<const std::string_view> names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates) {
    // Longer names than any candidate's cannot be near one, and would cost a large comparison.
    if (name.size() > longest_name) return {};
    std::string_view best;
    int least = std::max(letter_edit, static_cast<int>(name.size()) * letter_edit / 2);
    for (const std::string_view candidate : candidates) {
        if (candidate.size() > longest_name) continue;
        const int distance = edit_distance(name, candidate);
        if (distance < least || (best.empty() && distance == least)) {
            least = distance;
            best = candidate;
        }
    }
    if (!best.empty() || name.size() < shortest_part) return best;
    const auto whole = std::find_if(
        candidates.begin(), candidates.end(),
        [&](std::string_view candidate) { return candidate.find(name) != std::string_view::npos; });
    return whole == candidates.end() ? best : *whole;
}

}  // namespace drillstrand
