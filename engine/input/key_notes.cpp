#include "input/key_notes.hpp"

#include <algorithm>

namespace drillstrand {

namespace {

thread_local KeyNotes* current = nullptr;

bool is_number(std::string_view name) {
    return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The path without the numbers of list entries.
std::string without_numbers(std::string_view path) {
    std::string result;
    while (!path.empty()) {
        const std::size_t length = std::min(path.find('.'), path.size());
        const std::string_view name = path.substr(0, length);
        path.remove_prefix(std::min(length + 1, path.size()));
        if (is_number(name)) continue;
        if (!result.empty()) result += '.';
        result += name;
    }
    return result;
}

}  // namespace

KeyNotes::KeyNotes() {
    current = this;
}

KeyNotes::~KeyNotes() {
    current = nullptr;
}

KeyNote& KeyNotes::of(std::string_view path) {
    return notes_[without_numbers(path)];
}

void KeyNotes::known(std::string_view path) {
    if (current != nullptr) current->of(path);
}

void KeyNotes::type(std::string_view path, std::string_view type, const std::string& range) {
    if (current == nullptr) return;
    KeyNote& note = current->of(path);
    note.types.emplace(type);
    if (!range.empty()) note.ranges.insert(range);
}

void KeyNotes::standard(std::string_view path, const std::string& value) {
    if (current != nullptr) current->of(path).standards.insert(value);
}

void KeyNotes::required(std::string_view path) {
    if (current != nullptr) current->of(path).required = true;
}

}  // namespace drillstrand
