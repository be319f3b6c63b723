/// Tables of columns separated by commas, semicolons or tabs, with units in the header, as in
/// "md[ft],inclination[deg]".
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/units.hpp"
#include "input/header_names.hpp"
#include "input/range.hpp"

namespace drillstrand {

/// Names are compared without regard to case. Blank lines and lines that start with # are skipped;
/// fields may be quoted; a byte order mark and carriage returns are ignored. The separator is what
/// parts the header into most columns. Beside semicolons and tabs numbers may have decimal commas.
class DelimitedTable {
  public:
    struct Column {
        std::string name;  ///< lower case, without the unit
        std::string unit;  ///< empty where the header gives none
        SourceLocation where;
    };

    /// Throws InputError where `text` is not a table: not text, empty, ragged, a column twice, more
    /// than 1000 columns. `file` stands in messages.
    DelimitedTable(std::string text, std::string file)
        : DelimitedTable({}, std::move(text), std::move(file)) {}
    /// A table of which only the `known` columns are wanted, by any of their names. The header is
    /// the first line that has them all, and a line of units may follow it. Also throws where none
    /// of the first lines has them, or two columns mean the same.
    DelimitedTable(std::span<const KnownColumn> known, std::string text, std::string file);
    // fields point into the text
    DelimitedTable(const DelimitedTable&) = delete;
    DelimitedTable& operator=(const DelimitedTable&) = delete;

    [[nodiscard]] std::size_t rows() const { return fields_.size() / columns_.size(); }
    [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
    [[nodiscard]] std::optional<std::size_t> find_column(std::string_view name) const;
    /// Throws InputError at the header where there is no such column.
    [[nodiscard]] std::size_t require_column(std::string_view name) const;
    /// Factor to SI of the header's unit, or `standard` where it has none.
    [[nodiscard]] double column_factor(std::size_t column, const Dimension& dimension,
                                       double standard) const;

    [[nodiscard]] std::string text(std::size_t row, std::size_t column) const;
    [[nodiscard]] SourceLocation where(std::size_t row, std::size_t column) const;
    /// The row itself: its first field.
    [[nodiscard]] SourceLocation where(std::size_t row) const { return where(row, 0); }
    /// Throws InputError where the field is not a finite number.
    [[nodiscard]] double number(std::size_t row, std::size_t column) const;

  private:
    struct Field {
        std::string_view written;  // in quotes where it is so in the file
        std::uint32_t line = 0;
        std::uint32_t column = 0;  // counted in characters
    };

    /// A line that may be the header, split at one separator.
    struct Header {
        std::vector<Field> fields;
        char separator = ',';
        std::vector<std::vector<std::size_t>> known;  ///< places of each known column
        std::size_t count = 0;                        ///< of known columns that are there
    };

    void read_line(std::string_view line, std::size_t number);
    [[nodiscard]] std::vector<Field> split(std::string_view line, std::size_t number) const;
    void look_for_header(std::string_view line, std::size_t number);
    [[nodiscard]] Header header_of(std::string_view line, std::size_t number, char separator);
    void find_known(Header& header) const;
    void set_header(const Header& header);
    void name_known_columns(const Header& header);
    void refuse_doubles() const;
    [[nodiscard]] Column read_header_field(const Field& field) const;
    /// Whether a line after the header is its second one, as in "Measured" over "Depth".
    [[nodiscard]] bool continues_header(const std::vector<Field>& fields) const;
    /// Whether it is a line of units, which are then those of the columns.
    [[nodiscard]] bool take_units(const std::vector<Field>& fields);
    void take_unit(Column& column, const Field& field, const std::string& unit) const;
    void add_row(const std::vector<Field>& fields, std::size_t end_column);
    void find_decimal_marks();
    [[nodiscard]] std::string with_decimal_point(std::size_t row, std::size_t column) const;
    [[nodiscard]] const Field& field(std::size_t row, std::size_t column) const {
        return fields_[row * columns_.size() + column];
    }
    [[nodiscard]] SourceLocation place(const Field& field) const {
        return {file_, field.line, field.column};
    }

    std::span<const KnownColumn> known_;
    std::string file_;
    std::string text_;
    char separator_ = ',';
    std::vector<Column> columns_;
    std::vector<Field> fields_;    // row by row
    Header nearest_;               // of the lines without all known columns
    std::size_t lines_tried_ = 0;  // for a header
    bool after_header_ = false;    // where a line of units may stand
    bool has_decimal_point_ = false;
    bool has_decimal_comma_ = false;  // one that does not part thousands
};

}  // namespace drillstrand
