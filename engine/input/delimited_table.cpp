#include "input/delimited_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "input/utf8.hpp"
#include "input/wording.hpp"

namespace drillstrand {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view blanks = " \t\r";
constexpr std::size_t most_columns = 1000;

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

/// Position of the comma that ends the field at `begin`, or the end of the line.
std::size_t field_end(std::string_view line, std::size_t begin) {
    bool inside_quotes = false;
    std::size_t end = begin;
    for (; end < line.size() && (inside_quotes || line[end] != ','); ++end) {
        if (line[end] == '"') inside_quotes = !inside_quotes;
    }
    return end;
}

/// Content of a field that may be in quotes, doubled quotes inside.
std::string unquoted(std::string_view field) {
    if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
    std::string content;
    for (std::size_t k = 1; k + 1 < field.size(); ++k) {
        content += field[k];
        if (field[k] == '"' && field[k + 1] == '"') ++k;
    }
    return content;
}

}  // namespace

DelimitedTable::DelimitedTable(std::string text, std::string file)
    : file_(std::move(file)), text_(std::move(text)) {
    std::string_view rest = text_;
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    for (std::size_t number = 1; !rest.empty(); ++number) {
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, length);
        rest.remove_prefix(std::min(length + 1, rest.size()));

        const std::size_t valid = valid_text_prefix(line);
        if (valid < line.size()) {
            throw InputError({file_, number, count_characters(line.substr(0, valid)) + 1},
                             "not text; expected a table in UTF-8, columns separated by commas");
        }
        if (line.find_first_not_of(" \t\r,") == std::string_view::npos) continue;
        if (trimmed(line).starts_with('#')) continue;

        if (columns_.empty()) {
            set_header(split(line, number));
        } else {
            add_row(split(line, number), count_characters(line) + 1);
        }
    }
    if (columns_.empty()) {
        throw InputError({file_, 1, 1}, "the table is empty; expected a header and rows");
    }
}

std::vector<DelimitedTable::Field> DelimitedTable::split(std::string_view line,
                                                         std::size_t number) const {
    std::vector<Field> fields;
    std::size_t counted = 0;  // bytes
    std::size_t column = 1;   // of the byte after them
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = field_end(line, begin);
        const std::string_view whole = line.substr(begin, end - begin);
        const std::size_t indent = std::min(whole.find_first_not_of(blanks), whole.size());
        column += count_characters(line.substr(counted, begin + indent - counted));
        counted = begin + indent;
        const std::string_view content = trimmed(whole);
        if (std::count(content.begin(), content.end(), '"') % 2 != 0) {
            throw InputError({file_, number, column},
                             fmt::format("{} has an open quote; expected a closing one on the line",
                                         in_quotes(content)));
        }
        // what the file can hold fits
        fields.push_back(
            {content, static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(column)});
        if (fields.size() > most_columns)
            throw InputError(
                place(fields.back()),
                fmt::format("the line has more fields; expected at most {} columns", most_columns));
        begin = end + 1;
    }
    while (!columns_.empty() && fields.size() > columns_.size() && fields.back().written.empty()) {
        fields.pop_back();
    }
    return fields;
}

void DelimitedTable::set_header(const std::vector<Field>& fields) {
    if (fields.size() == 1 && fields.front().written.find_first_of(";\t") != std::string::npos) {
        throw InputError(place(fields.front()),
                         "the header has no commas; expected columns separated by commas");
    }
    for (const Field& field : fields) {
        Column column = read_header_field(field);
        if (!column.name.empty() && find_column(column.name)) {
            throw InputError(column.where, fmt::format("column {} is there twice; expected it once",
                                                       in_quotes(column.name)));
        }
        columns_.push_back(std::move(column));
    }
}

DelimitedTable::Column DelimitedTable::read_header_field(const Field& field) const {
    const std::string content = unquoted(field.written);
    const std::string_view text = content;
    const std::size_t open = text.find_first_of("[(");
    if (open == std::string_view::npos) return {lower_case(text), "", place(field)};
    const char closing = text[open] == '[' ? ']' : ')';
    if (text.back() != closing) {
        throw InputError(place(field),
                         fmt::format("header {} does not end with {}; expected NAME[UNIT]",
                                     in_quotes(text), closing));
    }
    const std::string_view unit = text.substr(open + 1, text.size() - open - 2);
    return {lower_case(trimmed(text.substr(0, open))), std::string(trimmed(unit)), place(field)};
}

void DelimitedTable::add_row(const std::vector<Field>& fields, std::size_t end_column) {
    if (fields.size() != columns_.size()) {
        const SourceLocation where = fields.size() > columns_.size()
                                         ? place(fields[columns_.size()])
                                         : SourceLocation{file_, fields.front().line, end_column};
        throw InputError(where, fmt::format("the row has {} fields; expected {} as in the header",
                                            fields.size(), columns_.size()));
    }
    fields_.insert(fields_.end(), fields.begin(), fields.end());
}

std::optional<std::size_t> DelimitedTable::find_column(std::string_view name) const {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
        if (columns_[k].name == name) return k;
    }
    return std::nullopt;
}

std::size_t DelimitedTable::require_column(std::string_view name) const {
    const std::optional<std::size_t> column = find_column(name);
    if (column) return *column;
    constexpr std::size_t enough = 20;
    std::vector<std::string_view> names;
    for (const Column& known : columns_) {
        if (names.size() == enough) {
            names.emplace_back("...");
            break;
        }
        names.push_back(known.name);
    }
    throw InputError(columns_.front().where,
                     fmt::format("missing column {}; expected it beside {}", in_quotes(name),
                                 on_one_line(listed(names))));
}

double DelimitedTable::column_factor(std::size_t column, const Dimension& dimension,
                                     double standard) const {
    const Column& header = columns_[column];
    if (header.unit.empty()) return standard;
    try {
        return unit_factor(header.unit, dimension);
    } catch (const std::invalid_argument& problem) {
        throw InputError(header.where, fmt::format("column {}: {}", header.name, problem.what()));
    }
}

std::string DelimitedTable::text(std::size_t row, std::size_t column) const {
    return unquoted(field(row, column).written);
}

SourceLocation DelimitedTable::where(std::size_t row, std::size_t column) const {
    return place(field(row, column));
}

double DelimitedTable::number(std::size_t row, std::size_t column) const {
    const std::string written = text(row, column);
    std::string_view digits = written;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = end == digits.data() + digits.size();
    const bool misplaced_sign = written.starts_with("+-");
    const std::string& name = columns_[column].name;
    if (error == std::errc::invalid_argument || !whole || misplaced_sign) {
        throw InputError(where(row, column),
                         fmt::format("{} is {}; expected a number (the unit goes into the header)",
                                     name, in_quotes(written)));
    }
    if (error != std::errc() || !std::isfinite(value)) {
        throw InputError(where(row, column), fmt::format("{} is {}; expected a finite number", name,
                                                         in_quotes(written)));
    }
    return value;
}

}  // namespace drillstrand
