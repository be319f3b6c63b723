#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "drillstrand/calibration.hpp"
#include "drillstrand/units.hpp"
#include "input/delimited_table.hpp"
#include "input/text_file.hpp"

namespace drillstrand {

namespace {

constexpr std::array loads{MeasuredLoad::pick_up, MeasuredLoad::slack_off, MeasuredLoad::rotating,
                           MeasuredLoad::torque};
constexpr std::string_view no_value = "-999.25";  // of LAS files

/// A column of one load.
struct LoadColumn {
    MeasuredLoad load;
    std::size_t column;
    double factor;
};

std::vector<LoadColumn> load_columns(const DelimitedTable& table) {
    std::vector<LoadColumn> columns;
    for (const MeasuredLoad load : loads) {
        const auto column = table.find_column(measured_load_name(load));
        if (!column) continue;
        const Dimension& dimension =
            load == MeasuredLoad::torque ? dimension::moment : dimension::force;
        columns.push_back({load, *column, table.column_factor(*column, dimension, 1)});
    }
    return columns;
}

}  // namespace

std::string measured_load_name(MeasuredLoad load) {
    switch (load) {
        case MeasuredLoad::pick_up:
            return "pick_up";
        case MeasuredLoad::slack_off:
            return "slack_off";
        case MeasuredLoad::rotating:
            return "rotating";
        case MeasuredLoad::torque:
            return "torque";
    }
    throw std::invalid_argument("measured_load_name: no such load");
}

std::vector<MeasuredPoint> read_measured_points(const std::filesystem::path& path) {
    const DelimitedTable table(read_text_file(path, {path.string()}), path.string());
    const std::size_t depth = table.require_column("depth");
    const double to_metres = table.column_factor(depth, dimension::length, 1);
    const std::vector<LoadColumn> columns = load_columns(table);
    if (columns.empty())
        throw InputError({path.string(), 1, 1},
                         "nothing to fit to; expected a column pick_up, slack_off, rotating or "
                         "torque, as in depth[m],pick_up[kN],slack_off[kN],torque[kN m]");
    std::vector<MeasuredPoint> points;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double bit_depth = to_metres * table.number(row, depth);
        for (const auto& [load, column, factor] : columns) {
            const std::string text = table.text(row, column);
            if (text.empty() || text == no_value) continue;
            points.push_back({bit_depth, load, factor * table.number(row, column)});
        }
    }
    return points;
}

}  // namespace drillstrand
