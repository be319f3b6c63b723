#include "input/utf8.hpp"

#include <algorithm>

namespace drillstrand {

namespace {

bool is_continuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// Bytes of a character by its first byte; 0 where no character starts so.
std::size_t character_length(char first) {
    const auto code = static_cast<unsigned char>(first);
    if (code == 0) return 0;
    if (code < 0x80U) return 1;
    if (code >= 0xC2U && code < 0xE0U) return 2;
    if (code >= 0xE0U && code < 0xF0U) return 3;
    return code >= 0xF0U && code < 0xF5U ? 4 : 0;
}

}  // namespace

std::size_t count_characters(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return !is_continuation(c); }));
}

std::size_t valid_text_prefix(std::string_view text) {
    std::size_t position = 0;
    while (position < text.size()) {
        const std::size_t length = character_length(text[position]);
        if (length == 0 || position + length > text.size()) break;
        const std::string_view rest = text.substr(position + 1, length - 1);
        if (!std::all_of(rest.begin(), rest.end(), is_continuation)) break;
        position += length;
    }
    return position;
}

}  // namespace drillstrand
