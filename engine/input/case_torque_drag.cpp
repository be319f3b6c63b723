#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"
#include "input/written.hpp"

namespace drillstrand {

namespace {

constexpr const char* some_depths =
    "a list of measured depths, or a table { from = ..., to = ..., step = ... }";

constexpr double most_depths = 10'000;

/// A measured depth of the bit: below the start of the well and not below its end.
double read_depth(const Value& value, const WellCase& well) {
    const double start = well.survey.front().measured_depth;
    const double end = well.survey.back().measured_depth;
    const double depth = value.quantity(dimension::length, plausible::coordinate);
    // depths in feet differ from those of the survey by rounding
    constexpr double rounding = 1e-9;
    if (depth > start && depth <= end * (1 + rounding)) return depth;
    value.fail(fmt::format(
        "is {}; expected more than {}, where the well starts, and at most {}, where its "
        "survey ends",
        length_text(depth), length_text(start), length_text(end)));
}

/// The depths between two, and those two; the last step may be shorter.
std::vector<double> read_steps(const Value& value, const WellCase& well) {
    const Table table(value, {"from", "to", "step"});
    const Value to = table.require("to", "the last depth");
    const Value step = table.require("step", "the distance of the depths");
    const double first = read_depth(table.require("from", "the first depth"), well);
    const double last = read_depth(to, well);
    const double distance = step.quantity(dimension::length, plausible::length);
    if (last < first)
        to.fail(fmt::format("is {}; expected at least from, {}", length_text(last),
                            length_text(first)));
    const double steps = (last - first) / distance;
    if (steps > most_depths)
        step.fail(fmt::format("makes {:.0f} depths; expected at most {:.0f}", steps, most_depths));
    constexpr double rounding = 1e-9;
    const auto count = static_cast<std::size_t>(std::ceil(steps * (1 - rounding)));
    std::vector<double> depths(count);
    for (std::size_t k = 0; k < count; ++k)
        depths[k] = first + static_cast<double>(k) * distance;
    depths.push_back(last);
    return depths;
}

std::vector<double> read_list(const Value& value, const WellCase& well) {
    std::vector<double> depths;
    const std::vector<Value> entries = value.elements(some_depths);
    if (static_cast<double>(entries.size()) > most_depths)
        value.fail(
            fmt::format("has {} depths; expected at most {:.0f}", entries.size(), most_depths));
    for (const Value& entry : entries) {
        const double depth = read_depth(entry, well);
        if (!depths.empty() && depth <= depths.back())
            entry.fail(fmt::format("is {}; expected more than {}, the depth before it",
                                   length_text(depth), length_text(depths.back())));
        depths.push_back(depth);
    }
    if (depths.empty()) value.fail(fmt::format("is empty; expected {}", some_depths));
    return depths;
}

std::vector<double> read_depths(const Value& value, const WellCase& well, const StringInput& string,
                                double interference) {
    const bool steps = value.node().is_table();
    std::vector<double> depths = steps ? read_steps(value, well) : read_list(value, well);
    const std::vector<Value> entries = steps ? std::vector<Value>{} : value.elements(some_depths);
    for (std::size_t k = 0; k < depths.size(); ++k)
        check_fit_at(well, string, interference, depths[k],
                     steps ? value.where() : entries[k].where());
    return depths;
}

TorqueDragMotion read_motion(const Value& value) {
    using Motion = TorqueDragMotion;
    return value.choice<Motion>({{"tripping_in", Motion::tripping_in},
                                 {"tripping_out", Motion::tripping_out},
                                 {"rotating", Motion::rotating},
                                 {"drilling", Motion::drilling},
                                 {"sliding", Motion::sliding}});
}

std::vector<TorqueDragMotion> read_motions(const Value& value) {
    std::vector<TorqueDragMotion> motions;
    constexpr const char* expected = R"(a list of motions such as ["rotating", "sliding"])";
    for (const Value& entry : value.elements(expected)) {
        const TorqueDragMotion motion = read_motion(entry);
        if (std::find(motions.begin(), motions.end(), motion) != motions.end())
            entry.fail("is there twice; expected each motion once");
        motions.push_back(motion);
    }
    if (motions.empty()) value.fail(fmt::format("is empty; expected {}", expected));
    return motions;
}

}  // namespace

TorqueDragCase read_torque_drag(const Table& root, const std::optional<WellCase>& well,
                                const StringInput& string, double interference) {
    const Table table = root.subtable("torque_drag", {"depths", "motions", "friction"});
    TorqueDragCase torque_drag;
    if (root.find("torque_drag") && !well)
        table.fail("torque_drag needs a well; expected a table [well] with survey and diameter");
    if (const std::optional<Value> depths = table.find("depths"))
        torque_drag.depths = read_depths(*depths, *well, string, interference);
    if (const std::optional<Value> motions = table.find("motions"))
        torque_drag.motions = read_motions(*motions);
    if (const std::optional<Value> friction = table.find("friction"))
        torque_drag.friction = read_friction(*friction);
    return torque_drag;
}

std::string motion_name(TorqueDragMotion motion) {
    switch (motion) {
        case TorqueDragMotion::tripping_in:
            return "tripping_in";
        case TorqueDragMotion::tripping_out:
            return "tripping_out";
        case TorqueDragMotion::rotating:
            return "rotating";
        case TorqueDragMotion::drilling:
            return "drilling";
        case TorqueDragMotion::sliding:
            return "sliding";
    }
    throw std::invalid_argument("motion_name: no such motion");
}

}  // namespace drillstrand
