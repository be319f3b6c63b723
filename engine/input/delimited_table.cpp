#include "input/delimited_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
constexpr std::string_view digits = "0123456789";
constexpr std::size_t most_columns = 1000;
constexpr std::array separators{',', ';', '\t'};

// Lines among which the header of a table with known columns is.
constexpr std::size_t most_lines_before_rows = 500;

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Position of the separator that ends the field at `begin`, or the end of the line.
std::size_t field_end(std::string_view line, std::size_t begin, char separator) {
    bool inside_quotes = false;
    std::size_t end = begin;
    for (; end < line.size() && (inside_quotes || line[end] != separator); ++end) {
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

/// Digits, one mark (. or ,) and digits, maybe with a sign: its mark; 0 for anything else.
char decimal_mark(std::string_view text) {
    if (text.empty()) return 0;
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    const std::size_t mark = text.find_first_not_of(digits);
    if (mark == 0 || mark >= text.size() - 1) return 0;
    if (text[mark] != '.' && text[mark] != ',') return 0;
    if (text.find_first_not_of(digits, mark + 1) != std::string_view::npos) return 0;
    return text[mark];
}

/// Whether the comma of "1,234" may part thousands; in "0,125" or "12,5" it cannot.
bool may_part_thousands(std::string_view text) {
    const std::size_t first = text.find_first_of(digits);
    const std::size_t comma = text.find(',');
    return text[first] != '0' && comma - first <= 3 && text.size() - comma == 4;
}

/// Places of the fields that mean `column` by one of `names`.
std::vector<std::size_t> named(const std::vector<HeaderField>& fields, const KnownColumn& column,
                               std::span<const std::string_view> names) {
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < fields.size(); ++k)
        if (unit_if_named(fields[k], column, names)) places.push_back(k);
    return places;
}

}  // namespace

DelimitedTable::DelimitedTable(std::span<const KnownColumn> known, std::string text,
                               std::string file)
    : known_(known), file_(std::move(file)), text_(std::move(text)) {
    std::string_view rest = text_;
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    for (std::size_t number = 1; !rest.empty(); ++number) {
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, length);
        rest.remove_prefix(std::min(length + 1, rest.size()));
        read_line(line, number);
    }
    if (columns_.empty() && !nearest_.fields.empty()) set_header(nearest_);
    if (columns_.empty()) {
        throw InputError({file_, 1, 1}, "the table is empty; expected a header and rows");
    }
    if (separator_ != ',') find_decimal_marks();
}

void DelimitedTable::read_line(std::string_view line, std::size_t number) {
    const std::size_t valid = valid_text_prefix(line);
    if (valid < line.size()) {
        throw InputError({file_, number, count_characters(line.substr(0, valid)) + 1},
                         "not text; expected a table in UTF-8, columns separated by commas");
    }
    if (line.find_first_not_of(" \t\r,;") == std::string_view::npos) return;
    if (trimmed(line).starts_with('#')) return;
    if (columns_.empty()) {
        look_for_header(line, number);
        return;
    }
    const std::vector<Field> fields = split(line, number);
    if (after_header_ && continues_header(fields)) return;
    if (std::exchange(after_header_, false) && take_units(fields)) return;
    add_row(fields, count_characters(line) + 1);
}

std::vector<DelimitedTable::Field> DelimitedTable::split(std::string_view line,
                                                         std::size_t number) const {
    std::vector<Field> fields;
    std::size_t counted = 0;  // bytes
    std::size_t column = 1;   // of the byte after them
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = field_end(line, begin, separator_);
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

void DelimitedTable::look_for_header(std::string_view line, std::size_t number) {
    if (++lines_tried_ > most_lines_before_rows) return;
    // inches in a line of prose
    const bool has_open_quote = std::count(line.begin(), line.end(), '"') % 2 != 0;
    if (!known_.empty() && has_open_quote) return;
    Header best;
    for (const char separator : separators) {
        Header header = header_of(line, number, separator);
        const auto rank = [](const Header& of) { return std::pair(of.count, of.fields.size()); };
        if (best.fields.empty() || rank(header) > rank(best)) best = std::move(header);
    }
    if (best.count == known_.size()) {
        set_header(best);
    } else if (nearest_.fields.empty() || best.count > nearest_.count) {
        nearest_ = std::move(best);
    }
}

DelimitedTable::Header DelimitedTable::header_of(std::string_view line, std::size_t number,
                                                 char separator) {
    separator_ = separator;
    Header header{split(line, number), separator, {}, 0};
    find_known(header);
    return header;
}

void DelimitedTable::find_known(Header& header) const {
    if (known_.empty()) return;
    std::vector<HeaderField> fields;
    for (const Field& field : header.fields)
        fields.push_back(split_header(unquoted(field.written)));
    for (const KnownColumn& column : known_) {
        std::vector<std::size_t> places = named(fields, column, column.names);
        if (places.empty()) places = named(fields, column, column.fallbacks);
        if (!places.empty()) ++header.count;
        header.known.push_back(std::move(places));
    }
}

void DelimitedTable::set_header(const Header& header) {
    separator_ = header.separator;
    for (const Field& field : header.fields)
        columns_.push_back(read_header_field(field));
    if (known_.empty()) {
        refuse_doubles();
    } else {
        name_known_columns(header);
    }
    after_header_ = !known_.empty();
}

void DelimitedTable::name_known_columns(const Header& header) {
    for (std::size_t k = 0; k < known_.size(); ++k) {
        const KnownColumn& known = known_[k];
        const std::vector<std::size_t>& places = header.known[k];
        if (places.empty()) continue;
        const Field& field = header.fields[places.front()];
        const std::string content = unquoted(field.written);
        if (places.size() > 1) {
            const Field& other = header.fields[places[1]];
            throw InputError(place(other), fmt::format("column {} is the {}, as {} is; expected it "
                                                       "once",
                                                       in_quotes(unquoted(other.written)),
                                                       known.name, in_quotes(content)));
        }
        const HeaderField parts = split_header(content);
        if (parts.unclosed != 0)
            throw InputError(place(field),
                             fmt::format("header {} does not end with {}; expected NAME[UNIT]",
                                         in_quotes(content), parts.unclosed));
        std::optional<std::string> unit = unit_if_named(parts, known, known.names);
        if (!unit) unit = unit_if_named(parts, known, known.fallbacks);
        Column& column = columns_[places.front()];
        column.name = known.name;
        column.unit = known_unit(*unit, known.dimension).value_or(*unit);
    }
}

void DelimitedTable::refuse_doubles() const {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
        const std::string& name = columns_[k].name;
        if (!name.empty() && *find_column(name) < k)
            throw InputError(
                columns_[k].where,
                fmt::format("column {} is there twice; expected it once", in_quotes(name)));
    }
}

DelimitedTable::Column DelimitedTable::read_header_field(const Field& field) const {
    const std::string content = unquoted(field.written);
    HeaderField parts = split_header(content);
    if (parts.unclosed != 0 && known_.empty())
        throw InputError(place(field),
                         fmt::format("header {} does not end with {}; expected NAME[UNIT]",
                                     in_quotes(content), parts.unclosed));
    return {std::move(parts.name), std::move(parts.unit), place(field)};
}

bool DelimitedTable::continues_header(const std::vector<Field>& fields) const {
    return std::any_of(known_.begin(), known_.end(), [&](const KnownColumn& known) {
        const std::size_t column = require_column(known.name);
        if (column >= fields.size()) return false;
        const HeaderField field = split_header(unquoted(fields[column].written));
        return unit_if_named(field, known, known.names) ||
               unit_if_named(field, known, known.fallbacks);
    });
}

bool DelimitedTable::take_units(const std::vector<Field>& fields) {
    std::vector<std::string> units;
    bool any = false;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
        units.emplace_back(k < fields.size() ? without_brackets(unquoted(fields[k].written)) : "");
        for (const KnownColumn& known : known_) {
            if (known.name != columns_[k].name) continue;
            if (const auto unit = known_unit(units[k], known.dimension)) {
                units[k] = *unit;
                any = true;
            }
        }
    }
    for (std::size_t k = 0; any && k < columns_.size(); ++k)
        if (!units[k].empty()) take_unit(columns_[k], fields[k], units[k]);
    return any;
}

void DelimitedTable::take_unit(Column& column, const Field& field, const std::string& unit) const {
    for (const KnownColumn& known : known_) {
        if (known.name != column.name || column.unit.empty() || column.unit == unit) continue;
        throw InputError(place(field),
                         fmt::format("{} is in {} here and in {} in the header; "
                                     "expected one unit",
                                     column.name, in_quotes(unit), in_quotes(column.unit)));
    }
    column.unit = unit;
    column.where = place(field);
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
    const std::string_view cure =
        columns_.size() == 1 ? "; columns are parted by commas, semicolons or tabs" : "";
    throw InputError(columns_.front().where,
                     fmt::format("missing column {}; expected it beside {}{}", in_quotes(name),
                                 on_one_line(listed(names)), cure));
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

void DelimitedTable::find_decimal_marks() {
    for (const Field& field : fields_) {
        std::string_view written = field.written;
        if (written.size() > 1 && written.front() == '"')
            written = written.substr(1, written.size() - 2);
        const char mark = decimal_mark(written);
        has_decimal_point_ = has_decimal_point_ || mark == '.';
        has_decimal_comma_ = has_decimal_comma_ || (mark == ',' && !may_part_thousands(written));
    }
}

std::string DelimitedTable::with_decimal_point(std::size_t row, std::size_t column) const {
    std::string written = text(row, column);
    if (separator_ == ',' || decimal_mark(written) != ',') return written;
    const auto refuse = [&](const char* why) {
        throw InputError(where(row, column),
                         fmt::format("{} is {}, {}; expected decimal points", columns_[column].name,
                                     in_quotes(written), why));
    };
    if (has_decimal_point_) refuse("while other numbers have decimal points");
    if (!has_decimal_comma_) refuse("whose comma may be a decimal one or part thousands");
    written[written.find(',')] = '.';
    return written;
}

double DelimitedTable::number(std::size_t row, std::size_t column) const {
    const std::string written = with_decimal_point(row, column);
    std::string_view rest = written;
    if (rest.starts_with('+')) rest.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    const bool whole = end == rest.data() + rest.size();
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
