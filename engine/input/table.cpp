#include "input/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "input/key_notes.hpp"
#include "input/wording.hpp"

namespace drillstrand {

namespace {

const toml::table& as_table(const Value& value) {
    const toml::table* table = value.node().as_table();
    if (table == nullptr) value.fail_expected(fmt::format("a table [{}]", value.path()));
    return *table;
}

auto place(const toml::key& key) {
    return std::make_tuple(key.source().begin.line, key.source().begin.column);
}

}  // namespace

Table::Table(const toml::table& table, std::string path,
             std::initializer_list<std::string_view> known)
    : Table(table, std::move(path), std::span(known.begin(), known.size())) {}

Table::Table(const Value& value, std::initializer_list<std::string_view> known)
    : Table(value, std::span(known.begin(), known.size())) {}

Table::Table(const Value& value, std::span<const std::string_view> known)
    : Table(as_table(value), value.path(), known) {}

Table::Table(const toml::table& table, std::string path, std::span<const std::string_view> known)
    : table_(&table), path_(std::move(path)) {
    for (const std::string_view key : known)
        KeyNotes::known(path_of(key));
    KeyNotes::type(path_, "table");
    refuse_unknown(known);
}

void Table::fail(const std::string& problem) const {
    throw InputError(where(), problem);
}

void Table::refuse_unknown(std::span<const std::string_view> known) const {
    const toml::key* first = nullptr;
    for (auto&& [key, node] : *table_) {
        const bool is_known = std::find(known.begin(), known.end(), key.str()) != known.end();
        if (!is_known && (first == nullptr || place(key) < place(*first))) first = &key;
    }
    if (first == nullptr) return;
    const std::string_view near = nearest_name(first->str(), known);
    const std::string cure = near.empty() ? fmt::format("known here: {}", listed(known))
                                          : fmt::format("did you mean {}?", in_quotes(near));
    throw InputError(locate(first->source()),
                     fmt::format("unknown key {}; {}", in_quotes(path_of(first->str())), cure));
}

std::string Table::path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

std::optional<Value> Table::find(std::string_view key) const {
    const toml::node* node = table_->get(key);
    if (node == nullptr) return std::nullopt;
    return Value(*node, path_of(key));
}

std::optional<Value> Table::find(std::string_view key, const std::string& standard) const {
    KeyNotes::standard(path_of(key), standard);
    return find(key);
}

Value Table::require(std::string_view key, std::string_view meaning) const {
    KeyNotes::required(path_of(key));
    std::optional<Value> value = find(key);
    if (!value) fail(fmt::format("missing key {}; expected {}", in_quotes(path_of(key)), meaning));
    return *value;
}

Table Table::subtable(std::string_view key, std::initializer_list<std::string_view> known) const {
    static const toml::table empty;
    const std::optional<Value> value = find(key);
    return value ? Table(*value, known) : Table(empty, path_of(key), known);
}

void Table::refuse_both(std::string_view first, std::string_view second) const {
    if (!find(first)) return;
    if (const std::optional<Value> value = find(second)) {
        value->fail(fmt::format("excludes {}; expected one of the two", path_of(first)));
    }
}

double Table::quantity(std::string_view key, const Dimension& dimension, double standard,
                       const Range& range) const {
    const std::optional<Value> value = find(key, fmt::format("{}", standard));
    return value ? value->quantity(dimension, range) : standard;
}

double Table::number(std::string_view key, double standard, const Range& range) const {
    const std::optional<Value> value = find(key, fmt::format("{}", standard));
    return value ? value->number(range) : standard;
}

int Table::whole_number(std::string_view key, int standard, int low, int high) const {
    const std::optional<Value> value = find(key, fmt::format("{}", standard));
    return value ? value->whole_number(low, high) : standard;
}

bool Table::boolean(std::string_view key, bool standard) const {
    const std::optional<Value> value = find(key, standard ? "true" : "false");
    return value ? value->boolean() : standard;
}

Eigen::Vector3d Table::vector(std::string_view key, const Dimension& dimension,
                              const Range& range) const {
    const std::optional<Value> value = find(key, "0");
    return value ? value->vector(dimension, range) : Eigen::Vector3d::Zero();
}

ScalarSchedule Table::scalar_schedule(std::string_view key, const Dimension& dimension,
                                      const Range& range) const {
    const std::optional<Value> value = find(key, "0");
    return value ? value->scalar_schedule(dimension, range) : ScalarSchedule();
}

VectorSchedule Table::vector_schedule(std::string_view key, const Dimension& dimension,
                                      const Range& range) const {
    const std::optional<Value> value = find(key, "0");
    return value ? value->vector_schedule(dimension, range) : VectorSchedule();
}

}  // namespace drillstrand
