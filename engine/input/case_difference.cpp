#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <map>
#include <sstream>
#include <string>

#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"

namespace drillstrand {

namespace {

/// Settings of the machine, which change no result.
constexpr std::array free_keys = {"run.threads", "output.checkpoint_interval"};

using Values = std::map<std::string, std::string>;

void flatten(const toml::node& node, const std::string& path, Values& values) {
    if (const toml::table* table = node.as_table()) {
        for (const auto& [key, value] : *table)
            flatten(value,
                    path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()),
                    values);
    } else if (const toml::array* array = node.as_array()) {
        for (std::size_t i = 0; i < array->size(); ++i)
            flatten(*array->get(i), fmt::format("{}[{}]", path, i), values);
    } else {
        std::ostringstream text;
        text.precision(17);
        if (const auto number = node.value_exact<double>())
            text << *number;
        else
            node.visit([&](const auto& value) { text << value; });
        values[path] = text.str();
    }
}

Values values_of(const std::string& case_text) {
    Values values;
    try {
        flatten(toml::parse(case_text), "", values);
    } catch (const toml::parse_error& error) {
        throw InputError({},
                         fmt::format("the text of a case is not TOML: {}", error.description()));
    }
    for (const char* key : free_keys)
        values.erase(key);
    return values;
}

}  // namespace

std::optional<std::string> first_difference(const std::string& case_text,
                                            const std::string& other_text) {
    const Values one = values_of(case_text);
    const Values other = values_of(other_text);
    for (const auto& [key, value] : one) {
        const auto found = other.find(key);
        if (found == other.end() || found->second != value) return key;
    }
    for (const auto& [key, value] : other) {
        if (!one.contains(key)) return key;
    }
    return std::nullopt;
}

}  // namespace drillstrand
