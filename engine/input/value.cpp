#include "input/value.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "input/case_document.hpp"
#include "input/dimension_names.hpp"
#include "input/key_notes.hpp"
#include "input/plausible.hpp"
#include "input/wording.hpp"
#include "input/written.hpp"

namespace drillstrand {

namespace {

/// The value as the message shows it: itself where it is short, else its type.
std::string as_written(const toml::node& node) {
    if (const auto* text = node.as_string()) return in_quotes(text->get());
    if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
    if (const auto* real = node.as_floating_point()) return fmt::format("{}", real->get());
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    if (const auto* list = node.as_array()) return list->empty() ? "an empty list" : "a list";
    if (node.is_table()) return "a table";
    return "a date or time";
}

}  // namespace

SourceLocation locate(const toml::source_region& region) {
    const std::string file = region.path ? *region.path : std::string();
    if (is_override_source(file)) return {file, 0, 0};
    return {file, region.begin.line, region.begin.column};
}

void Value::fail(std::string_view problem) const {
    throw InputError(where(), fmt::format("{} {}", path_, problem));
}

void Value::fail_expected(std::string_view expected) const {
    fail(fmt::format("is {}; expected {}", as_written(*node_), expected));
}

std::string Value::one_of(const std::vector<std::string_view>& words) {
    std::string expected;
    for (const std::string_view word : words) {
        if (!expected.empty()) expected += " or ";
        expected += in_quotes(word);
    }
    return expected;
}

double Value::finite_number(std::string_view expected) const {
    if (!node_->is_number()) fail_expected(expected);
    const double value = node_->is_integer() ? static_cast<double>(node_->as_integer()->get())
                                             : node_->as_floating_point()->get();
    if (!std::isfinite(value)) fail_expected("a finite number");
    return value;
}

void Value::note(std::string_view type, const std::string& range) const {
    KeyNotes::type(path_, type, range);
}

std::string Value::written(const Dimension& dimension) const {
    if (const auto* text = node_->as_string()) return text->get();
    const bool has_unit = !(dimension == dimension::none);
    return has_unit ? fmt::format("{} {}", as_written(*node_), si_unit(dimension))
                    : as_written(*node_);
}

double Value::quantity(const Dimension& dimension, const Range& range) const {
    note(si_unit(dimension), range.describe());
    return read_quantity(dimension, range);
}

double Value::read_quantity(const Dimension& dimension, const Range& range) const {
    double value = 0;
    if (const auto* written = node_->as_string()) {
        try {
            value = parse_quantity(written->get(), dimension);
        } catch (const std::invalid_argument& problem) {
            throw InputError(where(), fmt::format("{}: {}", path_, problem.what()));
        }
    } else {
        value = finite_number(fmt::format("a number in SI or {}", describe_dimension(dimension)));
    }
    if (!range.contains(value))
        fail_expected(fmt::format("{} {}", range.describe(), si_unit(dimension)));
    WrittenLengths::note(value, dimension, written(dimension));
    return value;
}

double Value::number(const Range& range) const {
    note("number", range.describe());
    const double value = finite_number("a number without a unit");
    if (!range.contains(value)) fail_expected(range.describe());
    return value;
}

int Value::whole_number(int low, int high) const {
    const Range range{.low = static_cast<double>(low), .high = static_cast<double>(high)};
    note("whole number", range.describe());
    const std::string expected = fmt::format("a whole number from {} to {}", low, high);
    const double value = finite_number(expected);
    if (value != std::floor(value) || value < low || value > high) fail_expected(expected);
    return static_cast<int>(value);
}

bool Value::boolean() const {
    note("true or false");
    if (!node_->is_boolean()) fail_expected("true or false");
    return node_->as_boolean()->get();
}

template <class Element, class Read>
Schedule<Element> Value::read_points(std::string_view expected, const Read& read) const {
    std::vector<double> times;
    std::vector<Element> values;
    std::string last_time;
    for (const Value& point : elements(expected)) {
        const std::vector<Value> pair = point.elements(expected);
        if (pair.size() != 2) {
            point.fail(fmt::format("has {} entries; expected [time, value]", pair.size()));
        }
        const double time = pair[0].read_quantity(dimension::time, plausible::instant);
        if (!times.empty() && time <= times.back()) {
            pair[0].fail(fmt::format("is time {} after {}; expected ascending times",
                                     pair[0].written(dimension::time), last_time));
        }
        last_time = pair[0].written(dimension::time);
        times.push_back(time);
        values.push_back(read(pair[1]));
    }
    if (times.empty()) fail_expected(expected);
    return {std::move(times), std::move(values)};
}

std::string Value::text() const {
    note("text");
    return read_text();
}

std::string Value::read_text() const {
    if (!node_->is_string()) fail_expected("a text in quotes");
    return node_->as_string()->get();
}

std::vector<Value> Value::elements(std::string_view expected) const {
    const toml::array* list = node_->as_array();
    if (list == nullptr) fail_expected(expected);
    std::vector<Value> values;
    values.reserve(list->size());
    for (std::size_t k = 0; k < list->size(); ++k) {
        values.emplace_back((*list)[k], fmt::format("{}.{}", path_, k));
    }
    return values;
}

Eigen::Vector3d Value::vector(const Dimension& dimension, const Range& range) const {
    const bool has_unit = !(dimension == dimension::none);
    note(has_unit ? fmt::format("vector, {}", si_unit(dimension)) : "vector", range.describe());
    return read_vector(dimension, range);
}

Eigen::Vector3d Value::read_vector(const Dimension& dimension, const Range& range) const {
    const std::vector<Value> parts = elements("a list of three values");
    if (parts.size() != 3) {
        fail(fmt::format("has {} entries; expected a list of three values", parts.size()));
    }
    Eigen::Vector3d result;
    for (int k = 0; k < 3; ++k)
        result[k] = parts[static_cast<std::size_t>(k)].read_quantity(dimension, range);
    return result;
}

ScalarSchedule Value::scalar_schedule(const Dimension& dimension, const Range& range) const {
    note(fmt::format("schedule, {}", si_unit(dimension)), range.describe());
    if (!is_list()) return read_quantity(dimension, range);
    return read_points<double>("a value or a list of [time, value] pairs", [&](const Value& value) {
        return value.read_quantity(dimension, range);
    });
}

VectorSchedule Value::vector_schedule(const Dimension& dimension, const Range& range) const {
    note(fmt::format("schedule of vectors, {}", si_unit(dimension)), range.describe());
    const std::string_view expected = "[x, y, z] or a list of [time, [x, y, z]] pairs";
    const std::vector<Value> parts = elements(expected);
    if (parts.empty()) fail_expected(expected);
    if (!parts.front().is_list()) return read_vector(dimension, range);
    return read_points<Eigen::Vector3d>(
        expected, [&](const Value& value) { return value.read_vector(dimension, range); });
}

}  // namespace drillstrand
