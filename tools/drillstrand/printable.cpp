#include "printable.hpp"

#include <fmt/format.h>

namespace drillstrand::program {

namespace {

constexpr bool is_between(char32_t code, char32_t first, char32_t last) {
    return code >= first && code <= last;
}

/// Bytes of the character that begins with this one; 0 where none does.
std::size_t length_of(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first <= 0xdf) return 2;
    if (first >= 0xe0 && first <= 0xef) return 3;
    if (first >= 0xf0 && first <= 0xf4) return 4;
    return 0;
}

std::string escape_of(const Character& character, unsigned char byte) {
    if (!character.sound) return fmt::format("\\x{:02x}", byte);
    if (character.code == '\n') return "\\n";
    if (character.code == '\t') return "\\t";
    const auto code = static_cast<unsigned>(character.code);
    return code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:x}}}", code);
}

}  // namespace

/// RFC 3629, section 3: no longer form than needed, no half of a pair, nothing past U+10FFFF.
Character first_character(std::string_view text) {
    constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const std::size_t length = length_of(byte(0));
    if (length == 1) return {byte(0), 1, true};
    if (length == 0 || length > text.size()) return {};
    char32_t code = byte(0) & (0x7fU >> length);
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(k) & 0xc0U) != 0x80) return {};
        code = code << 6 | (byte(k) & 0x3fU);
    }
    if (code < least[length] || code > 0x10ffff || is_between(code, 0xd800, 0xdfff)) return {};
    return {code, length, true};
}

bool is_control(const Character& character) {
    const char32_t code = character.code;
    return code < 0x20 || is_between(code, 0x7f, 0x9f) || is_between(code, 0x2028, 0x202e) ||
           is_between(code, 0x2066, 0x2069) || is_between(code, 0x200e, 0x200f) || code == 0xfeff;
}

std::string printable(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const Character character = first_character(text);
        if (character.sound && !is_control(character))
            out += text.substr(0, character.bytes);
        else
            out += escape_of(character, static_cast<unsigned char>(text.front()));
        text.remove_prefix(character.bytes);
    }
    return out;
}

}  // namespace drillstrand::program
