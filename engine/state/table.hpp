/// Tables whose rows have names, units and owners: a row of one table cannot be asked of another,
/// and one table cannot be passed for another.
#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

#include "numerics/block_table.hpp"
#include "numerics/triple.hpp"

namespace drillstrand {

/// What a row has an entry for.
enum class Extent { nodes, segments };

/// Whether a run that goes on later needs the row, or whether it follows from other rows.
enum class Keep { kept, derived };

template <class Row>
struct RowInfo {
    Row row;
    std::string_view name;
    std::string_view unit;
    std::size_t width;  ///< values per entry
    Extent extent;
    Keep keep;
    std::string_view stage;  ///< who writes it
};

/// Every row of a table in the order of its enumerators: specialised beside the enumeration.
template <class Row>
inline constexpr auto row_list = 0;

/// Where each row begins, counted in values of an entry; last, how many values there are.
template <class Row>
constexpr auto row_offsets() {
    constexpr std::size_t count = row_list<Row>.size();
    std::array<std::size_t, count + 1> offset{};
    for (std::size_t i = 0; i < count; ++i) {
        if (row_list<Row>[i].row != static_cast<Row>(i)) throw "rows are listed in another order";
        offset[i + 1] = offset[i] + row_list<Row>[i].width;
    }
    return offset;
}

template <class Row>
inline constexpr auto row_offset = row_offsets<Row>();

/// A block table with one line per value of each row.
template <class Row>
class Table {
  public:
    Table() = default;
    /// All zero.
    explicit Table(std::size_t entries) : lines_(lines, entries) {}

    [[nodiscard]] std::size_t blocks() const { return lines_.blocks(); }

    [[nodiscard]] double* row(Row row, std::size_t component = 0) {
        return lines_.row(first_line(row) + component);
    }
    [[nodiscard]] const double* row(Row row, std::size_t component = 0) const {
        return lines_.row(first_line(row) + component);
    }

    /// All values of all rows, one line each, for what treats them alike.
    static constexpr std::size_t lines = row_offset<Row>.back();
    [[nodiscard]] double* line(std::size_t i) { return lines_.row(i); }
    [[nodiscard]] const double* line(std::size_t i) const { return lines_.row(i); }

    /// Three values of each entry, from `component` on, for the entries from `first` on.
    [[nodiscard]] Triples triples(Row row, std::ptrdiff_t first, std::size_t component = 0) {
        const std::size_t i = first_line(row) + component;
        return {lines_.row(i) + first, lines_.row(i + 1) + first, lines_.row(i + 2) + first};
    }
    [[nodiscard]] ConstTriples triples(Row row, std::ptrdiff_t first,
                                       std::size_t component = 0) const {
        const std::size_t i = first_line(row) + component;
        return {lines_.row(i) + first, lines_.row(i + 1) + first, lines_.row(i + 2) + first};
    }

    /// The entry is a count of any kind: kernels count with signs, models without.
    [[nodiscard]] Eigen::Vector3d vector(Row row, std::integral auto entry) const {
        return drillstrand::vector(triples(row, static_cast<std::ptrdiff_t>(entry))[0]);
    }
    void set(Row row, std::integral auto entry, const Eigen::Vector3d& value) {
        triples(row, static_cast<std::ptrdiff_t>(entry)).set(0, triple(value));
    }

    /// Sets every entry of a row, padding included.
    void fill(Row row, double value) { lines_.fill(first_line(row), value); }
    void fill(Row row, const Eigen::Vector3d& value) {
        for (std::size_t i = 0; i < 3; ++i)
            lines_.fill(first_line(row) + i, value[static_cast<Eigen::Index>(i)]);
    }

  private:
    static constexpr std::size_t first_line(Row row) {
        return row_offset<Row>[static_cast<std::size_t>(row)];
    }

    BlockTable lines_;
};

}  // namespace drillstrand
