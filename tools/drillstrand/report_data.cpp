#include "report_data.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "printable.hpp"

namespace drillstrand::program {

std::string json_text(std::string_view text) {
    std::string out = "\"";
    while (!text.empty()) {
        const Character character = first_character(text);
        const char32_t code = character.code;
        // Markup must not end the element of the page that holds the JSON.
        if (!character.sound)
            out += "\\ufffd";
        else if (is_control(character) || code == '<' || code == '>' || code == '&')
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
        else if (code == '"' || code == '\\')
            (out += '\\') += text.front();
        else
            out += text.substr(0, character.bytes);
        text.remove_prefix(character.bytes);
    }
    return out + '"';
}

std::string json_number(double value) {
    return std::isfinite(value) ? fmt::format("{:.17g}", value) : "null";
}

std::string json_list(const std::vector<std::string>& values) {
    return fmt::format("[{}]", fmt::join(values, ","));
}

std::string json_object(const std::vector<std::pair<std::string, std::string>>& members) {
    std::string out;
    for (const auto& [name, value] : members)
        out += fmt::format("{}{}:{}", out.empty() ? "" : ",", json_text(name), value);
    return "{" + out + "}";
}

template <class Stored>
void ArrayBlock::append(const std::string& name, const char* type,
                        const std::vector<double>& values, Shape shape) {
    static_assert(std::endian::native == std::endian::little, "browsers read little-endian arrays");
    bytes_.resize((bytes_.size() + 7) / 8 * 8);  // arrays in a browser start at multiples of 8
    const std::size_t offset = bytes_.size();
    bytes_.resize(offset + values.size() * sizeof(Stored));
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto stored = static_cast<Stored>(values[k]);
        std::memcpy(bytes_.data() + offset + k * sizeof(Stored), &stored, sizeof(Stored));
    }
    if (shape.empty()) shape = {values.size()};
    entries_.emplace_back(name, fmt::format(R"({{"type":"{}","shape":[{}],"offset":{}}})", type,
                                            fmt::join(shape, ","), offset));
}

void ArrayBlock::add(const std::string& name, const std::vector<double>& values, Shape shape) {
    append<float>(name, "f32", values, std::move(shape));
}

void ArrayBlock::add_exact(const std::string& name, const std::vector<double>& values) {
    append<double>(name, "f64", values, {});
}

std::string ArrayBlock::json() const {
    return json_object(entries_);
}

/// RFC 4648, section 4.
std::string ArrayBlock::base64() const {
    constexpr std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes_.size() + 2) / 3 * 4);
    for (std::size_t k = 0; k < bytes_.size(); k += 3) {
        const std::size_t there = std::min<std::size_t>(3, bytes_.size() - k);
        unsigned group = 0;
        for (std::size_t i = 0; i < 3; ++i)
            group = group << 8 | (i < there ? static_cast<unsigned char>(bytes_[k + i]) : 0U);
        for (std::size_t i = 0; i < 4; ++i)
            out += i <= there ? alphabet[group >> (18 - 6 * i) & 63U] : '=';
    }
    return out;
}

}  // namespace drillstrand::program
