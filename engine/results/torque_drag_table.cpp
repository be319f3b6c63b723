#include <fmt/format.h>

#include "drillstrand/new_file.hpp"
#include "drillstrand/torque_drag_file.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

struct Column {
    std::string header;
    std::vector<double> values;
};

std::vector<Column> columns_of(const TorqueDrag& study, const Column& first,
                               const std::vector<TorqueDragDataset>& table) {
    std::vector<Column> columns{first};
    for (const TorqueDragCurve& curve : study.curves)
        for (const TorqueDragDataset& entry : table) {
            const std::string units = entry.integer ? "" : fmt::format("[{}]", entry.units);
            columns.push_back({fmt::format("{}_{}{}", motion_name(curve.motion), entry.name, units),
                               entry.values(curve)});
        }
    return columns;
}

std::string text_of(const std::vector<Column>& columns) {
    std::string text;
    for (std::size_t k = 0; k < columns.size(); ++k)
        text += fmt::format("{}{}", k == 0 ? "" : ",", columns[k].header);
    text += '\n';
    for (std::size_t row = 0; row < columns.front().values.size(); ++row) {
        for (std::size_t k = 0; k < columns.size(); ++k)
            text += fmt::format("{}{:.10g}", k == 0 ? "" : ",", columns[k].values[row]);
        text += '\n';
    }
    return text;
}

void write_text(const fs::path& path, const std::string& text, Existing existing) {
    NewFile fresh(path, existing);
    fresh.write(text);
    fresh.take_name();
}

}  // namespace

void write_torque_drag_table(const fs::path& path, const TorqueDrag& study, Existing existing) {
    write_text(
        path,
        text_of(columns_of(study, {"bit_depth[m]", study.bit_depth}, torque_drag_depth_datasets())),
        existing);
}

void write_torque_drag_profile_table(const fs::path& path, const TorqueDrag& study,
                                     Existing existing) {
    write_text(path,
               text_of(columns_of(study, {"measured_depth[m]", study.measured_depth},
                                  torque_drag_profile_datasets())),
               existing);
}

}  // namespace drillstrand
