/// Comma separated tables with units in the header, as in "md[ft],inclination[deg]".
#pragma once

#include <cstddef>
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

    /// Throws InputError where `text` is not a table: not text, empty, no rows, ragged, a column
    /// twice. `file` stands in messages.
    DelimitedTable(const std::string& text, std::string file);

    [[nodiscard]] std::size_t rows() const { return rows_.size(); }
    [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
    [[nodiscard]] std::optional<std::size_t> find_column(std::string_view name) const;
    /// Throws InputError at the header where there is no such column.
    [[nodiscard]] std::size_t require_column(std::string_view name) const;
    /// Factor to SI of the header's unit, or `standard` where it has none.
    [[nodiscard]] double column_factor(std::size_t column, const Dimension& dimension,
                                       double standard) const;

    [[nodiscard]] const std::string& text(std::size_t row, std::size_t column) const;
    [[nodiscard]] SourceLocation where(std::size_t row, std::size_t column) const;
    /// The row itself: its first field.
    [[nodiscard]] SourceLocation where(std::size_t row) const { return where(row, 0); }
    /// Throws InputError where the field is not a finite number.
    [[nodiscard]] double number(std::size_t row, std::size_t column) const;

  private:
    struct Field {
        std::string text;
        std::size_t line = 0;
        std::size_t column = 0;  // counted in characters
    };

    [[nodiscard]] std::vector<Field> split(std::string_view line, std::size_t number) const;
    void set_header(const std::vector<Field>& fields);
    [[nodiscard]] Column read_header_field(const Field& field) const;
    void add_row(std::vector<Field> fields, std::size_t end_column);
    [[nodiscard]] SourceLocation place(const Field& field) const {
        return {file_, field.line, field.column};
    }

    std::string file_;
    std::vector<Column> columns_;
    std::vector<std::vector<Field>> rows_;
};

}  // namespace drillstrand
