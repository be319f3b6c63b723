#include "drillstrand/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include "input/dimension_names.hpp"
#include "input/wording.hpp"

namespace drillstrand {

namespace {

struct Unit {
    std::string_view symbol;
    double factor;  // to SI
    Dimension dimension;
    bool prefixable = false;
};

struct Prefix {
    std::string_view symbol;
    double factor;
};

// Definitions, all exact: inch, pound and US gallon of 1959 / 231 cubic inches, standard gravity.
constexpr double inch = 0.0254;
constexpr double foot = 0.3048;
constexpr double survey_foot = 1200.0 / 3937;  // of the United States, until 2022
constexpr double pound = 0.45359237;
constexpr double standard_gravity = 9.80665;
constexpr double pound_force = pound * standard_gravity;
constexpr double horsepower = 550 * foot * pound_force;
constexpr double gallon = 0.003785411784;
constexpr double turn = 2 * std::numbers::pi;

constexpr Dimension mass{1, 0, 0};
constexpr Dimension volume{0, 3, 0};

constexpr std::array units{
    Unit{"m", 1, dimension::length, true},
    Unit{"in", inch, dimension::length},
    Unit{"inch", inch, dimension::length},
    Unit{"ft", foot, dimension::length},
    Unit{"kft", 1000 * foot, dimension::length},
    Unit{"ftUS", survey_foot, dimension::length},
    Unit{"N", 1, dimension::force, true},
    Unit{"kdaN", 1e4, dimension::force},
    Unit{"lbf", pound_force, dimension::force},
    Unit{"klbf", 1000 * pound_force, dimension::force},
    Unit{"kip", 1000 * pound_force, dimension::force},
    Unit{"tonf", 2000 * pound_force, dimension::force},
    Unit{"kgf", standard_gravity, dimension::force},
    Unit{"tf", 1000 * standard_gravity, dimension::force},
    Unit{"J", 1, dimension::moment, true},
    Unit{"W", 1, dimension::power, true},
    Unit{"hp", horsepower, dimension::power},
    Unit{"Pa", 1, dimension::pressure, true},
    Unit{"bar", 1e5, dimension::pressure, true},
    Unit{"psi", pound_force / (inch * inch), dimension::pressure},
    Unit{"ksi", 1000 * (pound_force / (inch * inch)), dimension::pressure},
    Unit{"Mpsi", 1e6 * (pound_force / (inch * inch)), dimension::pressure},
    Unit{"atm", 101325, dimension::pressure},
    Unit{"g", 1e-3, mass, true},
    Unit{"lb", pound, mass},
    Unit{"lbm", pound, mass},
    Unit{"klb", 1000 * pound, mass},
    Unit{"t", 1000, mass},
    Unit{"sg", 1000, dimension::density},
    Unit{"SG", 1000, dimension::density},
    Unit{"ppg", pound / gallon, dimension::density},
    Unit{"pcf", pound / (foot * foot * foot), dimension::density},
    Unit{"ppf", pound / foot, dimension::linear_density},
    Unit{"gal", gallon, volume},
    Unit{"gpm", gallon / 60, dimension::flow_rate},
    Unit{"L", 1e-3, volume, true},
    Unit{"l", 1e-3, volume, true},
    Unit{"P", 0.1, dimension::viscosity, true},
    Unit{"s", 1, dimension::time, true},
    Unit{"min", 60, dimension::time},
    Unit{"h", 3600, dimension::time},
    Unit{"Hz", turn, dimension::frequency, true},
    Unit{"rpm", turn / 60, dimension::frequency},
    Unit{"RPM", turn / 60, dimension::frequency},
    Unit{"rad", 1, dimension::angle, true},
    Unit{"deg", turn / 360, dimension::angle},
    Unit{"°", turn / 360, dimension::angle},
};

constexpr std::array prefixes{
    Prefix{"k", 1e3},  Prefix{"M", 1e6},  Prefix{"G", 1e9},  Prefix{"m", 1e-3}, Prefix{"c", 1e-2},
    Prefix{"u", 1e-6}, Prefix{"µ", 1e-6}, Prefix{"μ", 1e-6}, Prefix{"n", 1e-9}, Prefix{"d", 1e-1},
    Prefix{"da", 1e1}, Prefix{"h", 1e2},  Prefix{"T", 1e12},
};

/// What the message for an unknown symbol chooses from: units, and the prefixed ones in use.
const std::vector<std::string_view>& suggestions() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> all{"kN",  "MN", "mm", "cm",  "km",   "kg",  "kPa", "MPa",
                                          "GPa", "cP", "ms", "kHz", "mrad", "mPa", "daN", "kJ"};
        for (const Unit& unit : units)
            all.push_back(unit.symbol);
        return all;
    }();
    return names;
}

/// A unit, or a product of units: its factor to SI and its dimension.
struct Factor {
    double value = 1;
    Dimension dimension;

    void multiply(const Factor& other, int exponent) {
        for (int k = 0; k < exponent; ++k)
            value *= other.value;
        for (int k = 0; k > exponent; --k)
            value /= other.value;
        dimension.mass += exponent * other.dimension.mass;
        dimension.length += exponent * other.dimension.length;
        dimension.time += exponent * other.dimension.time;
    }
};

std::optional<Factor> find_symbol(std::string_view symbol) {
    for (const Unit& unit : units) {
        if (unit.symbol == symbol) return Factor{unit.factor, unit.dimension};
    }
    for (const Prefix& prefix : prefixes) {
        if (!symbol.starts_with(prefix.symbol)) continue;
        const std::string_view rest = symbol.substr(prefix.symbol.size());
        for (const Unit& unit : units) {
            if (unit.prefixable && unit.symbol == rest) {
                return Factor{prefix.factor * unit.factor, unit.dimension};
            }
        }
    }
    return std::nullopt;
}

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_space(text.back()))
        text.remove_suffix(1);
    return text;
}

/// Reads "factor, factor / factor ..." where a factor is a number, a symbol with an exponent, or a
/// number and a symbol (the 30 m of deg/30m). A slash divides by the one factor after it.
class UnitParser {
  public:
    UnitParser(std::string_view text, const Dimension& expected)
        : text_(text), rest_(text), expected_(expected) {}

    Factor parse() {
        Factor product;
        int sign = 1;
        skip_spaces();
        if (!rest_.empty() && is_digit(rest_.front()) && !rest_.starts_with("1/")) {
            fail(fmt::format("unit {} starts with a number", in_quotes(text_)));
        }
        while (!rest_.empty()) {
            product.multiply(factor(), sign);
            sign = separator();
        }
        if (dangling_) fail(fmt::format("unit {} ends with an operator", in_quotes(text_)));
        return product;
    }

  private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw std::invalid_argument(
            fmt::format("{}; expected {}", problem, describe_dimension(expected_)));
    }

    void skip_spaces() {
        while (!rest_.empty() && is_space(rest_.front()))
            rest_.remove_prefix(1);
    }

    bool take(std::string_view mark) {
        if (!rest_.starts_with(mark)) return false;
        rest_.remove_prefix(mark.size());
        return true;
    }

    /// Consumes what stands between two factors; the exponent sign of the next one.
    int separator() {
        skip_spaces();
        const bool divides = take("/");
        dangling_ = divides || take("*") || take("·") || take("-");
        skip_spaces();
        return divides ? -1 : 1;
    }

    Factor factor() {
        Factor result;
        const bool has_number = is_digit(rest_.front());
        if (has_number) {
            result.value = number();
            skip_spaces();
        }
        if (!has_number || starts_symbol()) {
            const Factor unit = symbol();
            result.multiply(unit, exponent());
        }
        return result;
    }

    double number() {
        double value = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value,
                                                  std::chars_format::fixed);
        if (error != std::errc() || !(value > 0)) {
            fail(fmt::format("number in unit {} is not positive and finite", in_quotes(text_)));
        }
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return value;
    }

    static bool is_symbol_character(char c) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
        return letter || static_cast<unsigned char>(c) >= 0x80U;
    }

    [[nodiscard]] bool starts_symbol() const {
        return !rest_.empty() && is_symbol_character(rest_.front()) && !rest_.starts_with("·");
    }

    Factor symbol() {
        std::size_t length = 0;
        while (length < rest_.size() && is_symbol_character(rest_[length]) &&
               !rest_.substr(length).starts_with("·")) {
            ++length;
        }
        if (length == 0) {
            fail(fmt::format("cannot read the unit {} from {} on", in_quotes(text_),
                             in_quotes(rest_)));
        }
        const std::string_view name = rest_.substr(0, length);
        const std::optional<Factor> found = find_symbol(name);
        if (!found) fail_unknown(name);
        rest_.remove_prefix(length);
        return *found;
    }

    [[noreturn]] void fail_unknown(std::string_view name) const {
        const std::string_view near = nearest_name(name, suggestions());
        if (near.empty()) fail(fmt::format("unknown unit {}", in_quotes(name)));
        throw std::invalid_argument(
            fmt::format("unknown unit {}; did you mean {}?", in_quotes(name), in_quotes(near)));
    }

    /// "^2", "^-1", "2", "-1" or nothing.
    int exponent() {
        const bool marked = take("^") || take("**");
        const bool negative = rest_.size() > 1 && rest_[0] == '-' && is_digit(rest_[1]);
        if (negative) rest_.remove_prefix(1);
        if (rest_.empty() || !is_digit(rest_.front())) {
            if (marked) fail(fmt::format("unit {} has no exponent after ^", in_quotes(text_)));
            return 1;
        }
        const int value = rest_.front() - '0';
        rest_.remove_prefix(1);
        if (!rest_.empty() && (is_digit(rest_.front()) || rest_.front() == '.')) {
            fail(fmt::format("exponent in unit {} is not a single digit", in_quotes(text_)));
        }
        return negative ? -value : value;
    }

    std::string_view text_;
    std::string_view rest_;
    Dimension expected_;
    bool dangling_ = false;
};

/// Two units of mass where force was meant are common enough to name the cure.
std::string pound_hint(const Dimension& given, const Dimension& expected) {
    const bool mass_for_force = given.mass == expected.mass && given.mass == 1 &&
                                expected.length == given.length + 1 &&
                                expected.time == given.time - 2;
    return mass_for_force ? " (a pound of force is lbf, a kilogram of force kgf)" : "";
}

struct LeadingNumber {
    double value = 0;
    std::size_t characters = 0;
};

/// Length of the decimal digits at the start.
std::size_t count_digits(std::string_view text) {
    std::size_t count = 0;
    while (count < text.size() && is_digit(text[count]))
        ++count;
    return count;
}

/// Reads "5/8", as pipe and bit sizes have it; no characters where there is none.
LeadingNumber leading_fraction(std::string_view text) {
    const std::size_t upper = count_digits(text);
    if (upper == 0 || upper > 3 || upper >= text.size() || text[upper] != '/') return {};
    const std::size_t lower = count_digits(text.substr(upper + 1));
    if (lower == 0 || lower > 3) return {};
    int numerator = 0;
    int denominator = 0;
    std::from_chars(text.data(), text.data() + upper, numerator);
    std::from_chars(text.data() + upper + 1, text.data() + upper + 1 + lower, denominator);
    if (denominator == 0) return {};
    return {static_cast<double>(numerator) / denominator, upper + 1 + lower};
}

/// Reads "9.625", "5/8", "9 5/8" or "9-5/8".
LeadingNumber leading_number(std::string_view text, const Dimension& expected) {
    const LeadingNumber fraction = leading_fraction(text);
    if (fraction.characters > 0) return fraction;

    const std::size_t sign = text.starts_with("+") ? 1 : 0;
    const std::string_view unsigned_text = text.substr(sign);
    double value = 0;
    const auto [end, error] =
        std::from_chars(unsigned_text.data(), unsigned_text.data() + unsigned_text.size(), value);
    if (error == std::errc::invalid_argument || unsigned_text.starts_with(sign ? "-" : "+")) {
        throw std::invalid_argument(fmt::format("{} does not start with a number; expected {}",
                                                in_quotes(text), describe_dimension(expected)));
    }
    if (error == std::errc::result_out_of_range || !std::isfinite(value)) {
        throw std::invalid_argument(
            fmt::format("{} is not a finite number; expected a finite one", in_quotes(text)));
    }
    const auto characters = static_cast<std::size_t>(end - text.data());
    const bool whole_number = count_digits(text) == characters;
    if (whole_number && characters < text.size() &&
        (text[characters] == ' ' || text[characters] == '-')) {
        const LeadingNumber part = leading_fraction(text.substr(characters + 1));
        if (part.characters > 0) {
            return {value + part.value, characters + 1 + part.characters};
        }
    }
    return {value, characters};
}

}  // namespace

double unit_factor(std::string_view unit, const Dimension& expected) {
    const std::string_view text = trimmed(unit);
    const Factor factor = UnitParser(text, expected).parse();
    if (factor.dimension == expected) return factor.value;
    if (text.empty()) {
        throw std::invalid_argument(
            fmt::format("no unit; expected {}", describe_dimension(expected)));
    }
    throw std::invalid_argument(
        fmt::format("{} is {}; expected {}{}", text, dimension_noun(factor.dimension),
                    describe_dimension(expected), pound_hint(factor.dimension, expected)));
}

double parse_quantity(std::string_view text, const Dimension& expected) {
    const std::string_view whole = trimmed(text);
    const LeadingNumber number = leading_number(whole, expected);
    const std::string_view unit = trimmed(whole.substr(number.characters));
    if (unit.empty() && !(expected == dimension::none)) {
        throw std::invalid_argument(
            fmt::format("{} has no unit; expected {}, or a number without quotes in SI",
                        in_quotes(text), describe_dimension(expected)));
    }
    const double value = number.value * unit_factor(unit, expected);
    if (!std::isfinite(value)) {
        throw std::invalid_argument(
            fmt::format("{} is too large; expected a finite number", in_quotes(text)));
    }
    return value;
}

}  // namespace drillstrand
