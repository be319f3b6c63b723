/// drillstrand calibrate: friction and block weight from measured points.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "case_of.hpp"
#include "commands.hpp"
#include "drillstrand/calibration.hpp"
#include "drillstrand/new_file.hpp"
#include "output.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

double unit_of(MeasuredLoad load) {
    return load == MeasuredLoad::torque ? kilonewton_metre() : kilonewton();
}

std::string words_of(MeasuredLoad load) {
    switch (load) {
        case MeasuredLoad::pick_up:
            return "pick up (kN)";
        case MeasuredLoad::slack_off:
            return "slack off (kN)";
        case MeasuredLoad::rotating:
            return "rotating (kN)";
        default:
            return "torque (kN m)";
    }
}

void print_numbers(const Calibration& found) {
    fmt::print("  {:<24} {:>10} {:>10}\n", "", "fitted", "+-");
    for (const FittedNumber& friction : found.friction)
        fmt::print("  {:<24} {:>10.4f} {:>10.4f}\n", "friction, " + friction.name, friction.value,
                   friction.deviation);
    if (found.hook_load_scatter > 0)
        fmt::print("  {:<24} {:>10.2f} {:>10.2f}\n", "block weight (kN)",
                   found.block_weight.value / kilonewton(),
                   found.block_weight.deviation / kilonewton());
    fmt::print("  what is left, root mean square: hook loads {:.3g} kN, torques {:.3g} kN m\n\n",
               found.hook_load_scatter / kilonewton(), found.torque_scatter / kilonewton_metre());
}

void print_points(const std::vector<MeasuredPoint>& points, const Calibration& found) {
    fmt::print("  {:>12}  {:<15} {:>10} {:>10} {:>10}\n", "bit at (m)", "", "measured", "fitted",
               "left");
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double unit = unit_of(points[i].load);
        fmt::print("  {:>12.1f}  {:<15} {:>10.2f} {:>10.2f} {:>10.2f}\n", points[i].bit_depth,
                   words_of(points[i].load), points[i].value / unit, found.fitted[i] / unit,
                   (points[i].value - found.fitted[i]) / unit);
    }
}

std::string table_text(const std::vector<MeasuredPoint>& points, const Calibration& found) {
    std::string text = "bit_depth[m],load,measured[N or N m],fitted[N or N m]\n";
    for (std::size_t i = 0; i < points.size(); ++i)
        text += fmt::format("{:.10g},{},{:.10g},{:.10g}\n", points[i].bit_depth,
                            measured_load_name(points[i].load), points[i].value, found.fitted[i]);
    return text;
}

}  // namespace

int calibrate(const CalibrateOptions& options) {
    const Case input = case_of(options.case_path, options.overrides);
    std::vector<InputFile> inputs = inputs_of(input);
    inputs.push_back({options.points, "the measured points"});
    const OutputRules rules{options.overwrite, inputs};
    require_output("--csv", options.table, rules);
    const std::vector<MeasuredPoint> points = read_measured_points(options.points);
    const Calibration found = calibrate(input, points, input.run.threads);
    if (!options.table.empty()) {
        NewFile file(options.table, rules.existing());
        file.write(table_text(points, found));
        file.take_name();
    }
    fmt::print("{}: {} points of {}\n", input.path.string(), points.size(),
               options.points.string());
    print_numbers(found);
    print_points(points, found);
    return done;
}

}  // namespace drillstrand::program
