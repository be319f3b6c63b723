/// Comma separated tables with units in the header, as in "md[ft],inclination[deg]".
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/units.hpp"
#include "input/range.hpp"

namespace drillstrand {

/// Names are compared without regard to case. Blank lines and lines that start with # are skipped;
/// fields may be quoted; a byte order mark and carriage returns are ignored.
class DelimitedTable {
  public:
    struct Column {
        std::string name;  ///< lower case, without the unit
        std::string unit;  ///< empty where the header gives none
        SourceLocation where;
    };

    /// Throws InputError where `text` is not a table: not text, empty, ragged, a column twice, more
    /// than 1000 columns. `file` stands in messages.
    DelimitedTable(std::string text, std::string file);
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

    [[nodiscard]] std::vector<Field> split(std::string_view line, std::size_t number) const;
    void set_header(const std::vector<Field>& fields);
    [[nodiscard]] Column read_header_field(const Field& field) const;
    void add_row(const std::vector<Field>& fields, std::size_t end_column);
    [[nodiscard]] const Field& field(std::size_t row, std::size_t column) const {
        return fields_[row * columns_.size() + column];
    }
    [[nodiscard]] SourceLocation place(const Field& field) const {
        return {file_, field.line, field.column};
    }

    std::string file_;
    std::string text_;
    std::vector<Column> columns_;
    std::vector<Field> fields_;  // row by row
};

}  // namespace drillstrand
