#include "input/written.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace drillstrand {

namespace {

thread_local WrittenLengths* current = nullptr;

bool ends_with_unit(std::string_view text, std::string_view unit) {
    if (!text.ends_with(unit)) return false;
    const std::string_view before = text.substr(0, text.size() - unit.size());
    return !before.empty() &&
           std::string_view("0123456789. ").find(before.back()) != std::string_view::npos;
}

}  // namespace

WrittenLengths::WrittenLengths() : outer_(current) {
    current = this;
}

WrittenLengths::~WrittenLengths() {
    current = outer_;
}

void WrittenLengths::note(double value, const Dimension& dimension, std::string_view text) {
    // nothing has no unit: it may be the default of another length
    if (current == nullptr || !(dimension == dimension::length) || value == 0) return;
    current->texts_.try_emplace(value, text);
    if (ends_with_unit(text, "m")) note_unit("m");
    if (ends_with_unit(text, "ft")) note_unit("ft");
}

void WrittenLengths::note_unit(std::string_view unit) {
    if (current == nullptr) return;
    if (unit == "m") ++current->in_metres_;
    if (unit == "ft") ++current->in_feet_;
}

std::string length_text(double metres) {
    if (current != nullptr) {
        const auto found = current->texts_.find(metres);
        if (found != current->texts_.end()) return found->second;
        if (current->in_feet_ > current->in_metres_)
            return fmt::format("{:.9g} ft", metres / unit_factor("ft", dimension::length));
    }
    return fmt::format("{:.9g} m", metres);
}

std::pair<double, std::string_view> number_and_unit(std::string_view text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return {0, ""};
    std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
    unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
    // "9 5/8 in"
    if (!unit.empty() && unit.front() >= '0' && unit.front() <= '9') return {number, ""};
    return {number, unit};
}

}  // namespace drillstrand
