#include "drillstrand/measured.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <optional>

#include "drillstrand/units.hpp"
#include "input/delimited_table.hpp"
#include "input/text_file.hpp"

namespace drillstrand {

namespace {

std::vector<double> read_column(const DelimitedTable& table, std::size_t column,
                                const Dimension& dimension) {
    const double factor = table.column_factor(column, dimension, 1);
    std::vector<double> values;
    for (std::size_t row = 0; row < table.rows(); ++row)
        values.push_back(factor * table.number(row, column));
    return values;
}

std::vector<double> read_optional(const DelimitedTable& table, const char* name,
                                  const Dimension& dimension) {
    const std::optional<std::size_t> column = table.find_column(name);
    return column ? read_column(table, *column, dimension) : std::vector<double>();
}

void require_ascending(const DelimitedTable& table, std::size_t column,
                       const std::vector<double>& times) {
    for (std::size_t row = 1; row < times.size(); ++row)
        if (times[row] <= times[row - 1])
            throw InputError(table.where(row, column),
                             fmt::format("time is {} after {}; expected ascending times",
                                         table.text(row, column), table.text(row - 1, column)));
}

}  // namespace

MeasuredChannels read_measured(const std::filesystem::path& path) {
    const DelimitedTable table(read_text_file(path, {path.string()}), path.string());
    const std::size_t time = table.require_column("time");
    MeasuredChannels channels;
    channels.time = read_column(table, time, dimension::time);
    channels.hook_load = read_optional(table, "hook_load", dimension::force);
    channels.torque = read_optional(table, "torque", dimension::moment);
    require_ascending(table, time, channels.time);
    if (channels.hook_load.empty() && channels.torque.empty())
        throw InputError({path.string(), 1, 1},
                         "nothing to compare; expected a column hook_load or torque, as in "
                         "time[s],hook_load[kN],torque[kN m]");
    return channels;
}

}  // namespace drillstrand
