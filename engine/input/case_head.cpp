#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "drillstrand/schedule_parts.hpp"
#include "input/case_sections.hpp"
#include "input/operations.hpp"
#include "input/plausible.hpp"

namespace drillstrand {

namespace {

constexpr Dimension rotation_damping{1, 2, -1};  // N m s

bool is_zero(const ScalarSchedule& schedule) {
    return std::all_of(schedule.values().begin(), schedule.values().end(),
                       [](double value) { return value == 0; });
}

bool is_zero(const VectorSchedule& schedule) {
    return std::all_of(schedule.values().begin(), schedule.values().end(),
                       [](const Eigen::Vector3d& value) { return value.isZero(0); });
}

void refuse_head_load(const Table& table, std::string_view key, std::string_view motion) {
    refuse_key(table, key, fmt::format("head.motion = \"{}\"", motion));
}

DriveCase read_drive(const Table& table) {
    DriveCase drive;
    drive.control = table.choice<DriveControl>("control", drive.control,
                                               {{"stiff", DriveControl::stiff},
                                                {"pi", DriveControl::pi},
                                                {"tuned", DriveControl::tuned},
                                                {"matched", DriveControl::matched}});
    drive.inertia = table.quantity("inertia", dimension::moment_of_inertia, drive.inertia,
                                   plausible::drive_inertia);
    const auto belongs_to = [&](DriveControl control, std::string_view name,
                                std::initializer_list<std::string_view> keys) {
        if (drive.control == control) return true;
        for (const std::string_view key : keys)
            refuse_key(table, key, fmt::format("head.drive.control = \"{}\"", name));
        return false;
    };
    if (belongs_to(DriveControl::pi, "pi", {"proportional", "integral"})) {
        drive.proportional =
            table.require("proportional", "a torque over a rate, such as \"2 kN m s\"")
                .quantity(rotation_damping, plausible::proportional);
        drive.integral =
            table.quantity("integral", dimension::moment, drive.integral, plausible::load_or_none);
    }
    if (belongs_to(DriveControl::tuned, "tuned", {"impedance_factor", "frequency"})) {
        drive.impedance_factor =
            table.number("impedance_factor", drive.impedance_factor, plausible::factor);
        drive.frequency = table.require("frequency", "a frequency to damp, such as \"0.2 Hz\"")
                              .quantity(dimension::frequency, plausible::slow_rotation);
    }
    if (belongs_to(DriveControl::matched, "matched", {"filter"}))
        drive.filter =
            table.quantity("filter", dimension::time, drive.filter, plausible::duration_or_none);
    if (const std::optional<Value> limit = table.find("torque_limit"))
        drive.torque_limit = limit->quantity(dimension::moment, plausible::largest_load);
    if (const std::optional<Value> limit = table.find("power_limit"))
        drive.power_limit = limit->quantity(dimension::power, plausible::largest_load);
    return drive;
}

Eigen::Vector3d read_direction(const Value& value) {
    const Eigen::Vector3d direction = value.vector(dimension::none, {.low = -1e9, .high = 1e9});
    const double length = direction.norm();
    if (length < 1e-9) value.fail("has no length; expected a vector that is not zero");
    return direction / length;
}

VectorSchedule across_d3(const VectorSchedule& schedule) {
    return mapped<Eigen::Vector3d>(schedule, [](const Eigen::Vector3d& value) {
        return Eigen::Vector3d(0, value[1], value[2]);
    });
}

/// What moves a clamped head besides its rotation.
void read_head_motion(const Table& table, HeadCase& head) {
    table.refuse_both("rotation", "angular_velocity");
    const VectorSchedule turning =
        table.vector_schedule("angular_velocity", dimension::frequency, plausible::rotation);
    head.velocity = table.vector_schedule("velocity", dimension::speed, plausible::speed);
    if (head.motion != HeadMotion::driven) {
        if (!is_zero(turning)) refuse_head_load(table, "angular_velocity", "driven");
        if (!is_zero(head.velocity)) refuse_head_load(table, "velocity", "driven");
    }
    if (!table.find("angular_velocity")) return;
    head.rotation = part_of_d3(turning);
    head.tilting = across_d3(turning);
}

/// Drive and hoist move the head about and along an axis that stays where it is.
void check_axis(const Table& table, const HeadCase& head, std::string_view machine) {
    for (const auto& [key, schedule] :
         {std::pair("angular_velocity", &head.tilting), std::pair("velocity", &head.velocity)})
        if (!is_axial(*schedule))
            table.find(key)->fail(
                fmt::format("moves the head across d3; expected none of that with {}", machine));
}

/// A limit with the gain and the time of its loop; none where it is left out.
std::optional<DrillerLoop> read_loop(const Table& table, const std::string& name,
                                     const Dimension& unit, const Dimension& gain_unit,
                                     const Range& range) {
    const std::string gain = name + "_gain";
    const std::string reset = name + "_reset";
    const std::optional<Value> limit = table.find(name);
    if (!limit) {
        for (const std::string& key : {gain, reset})
            refuse_key(table, key, "head.hoist.autodriller." + name);
        return std::nullopt;
    }
    DrillerLoop loop;
    loop.limit = limit->scalar_schedule(unit, range);
    const Value factor = table.require(gain, "a drum speed over an error");
    loop.gain = gain_unit == dimension::none ? factor.number(plausible::gain)
                                             : factor.quantity(gain_unit, plausible::gain);
    loop.reset_time = table.require(reset, "a time such as \"10 s\"")
                          .quantity(dimension::time, plausible::duration);
    return loop;
}

AutodrillerCase read_autodriller(const Table& table) {
    constexpr Dimension per_force{-1, 0, 1};
    constexpr Dimension per_moment{-1, -1, 1};
    constexpr Dimension per_pressure{-1, 2, 1};
    AutodrillerCase autodriller;
    autodriller.weight =
        read_loop(table, "weight", dimension::force, per_force, plausible::load_or_none);
    autodriller.rate =
        read_loop(table, "rate", dimension::speed, dimension::none, plausible::speed_or_none);
    autodriller.torque =
        read_loop(table, "torque", dimension::moment, per_moment, plausible::load_or_none);
    autodriller.pressure =
        read_loop(table, "pressure", dimension::pressure, per_pressure, plausible::load_or_none);
    if (const std::optional<Value> load = table.find("off_bottom_load"))
        autodriller.off_bottom_load = load->quantity(dimension::force, plausible::load_or_none);
    return autodriller;
}

HoistCase read_hoist(const Table& table) {
    constexpr int most_lines = 100;
    HoistCase hoist;
    hoist.mass = table.require("mass", "that of block and travelling gear, such as 10e3")
                     .quantity(dimension::mass, plausible::block_mass);
    hoist.line_stiffness = table.require("line_stiffness", "that of one line, such as \"1e6 N/m\"")
                               .quantity(dimension::stiffness, plausible::line_stiffness);
    hoist.lines = table.whole_number("lines", hoist.lines, 1, most_lines);
    table.refuse_both("block_speed", "hook_load");
    table.refuse_both("block_speed", "autodriller");
    table.refuse_both("hook_load", "autodriller");
    hoist.block_speed = table.scalar_schedule("block_speed", dimension::speed, plausible::speed);
    if (const std::optional<Value> brake = table.find("hook_load"))
        hoist.hook_load = brake->scalar_schedule(dimension::force, plausible::load_or_none);
    if (const std::optional<Value> driller = table.find("autodriller")) {
        hoist.autodriller = read_autodriller(table.subtable(
            "autodriller", {"weight", "weight_gain", "weight_reset", "rate", "rate_gain",
                            "rate_reset", "torque", "torque_gain", "torque_reset", "pressure",
                            "pressure_gain", "pressure_reset", "off_bottom_load"}));
        const AutodrillerCase& limits = *hoist.autodriller;
        if (!limits.weight && !limits.rate && !limits.torque && !limits.pressure)
            driller->fail("has no limit; expected weight, rate, torque or pressure");
    }
    return hoist;
}

/// What moves a clamped or pinned head and what makes it follow.
void read_machines(const Table& table, HeadCase& head) {
    if (table.find("drive")) {
        head.drive = read_drive(table.subtable(
            "drive", {"control", "inertia", "proportional", "integral", "impedance_factor",
                      "frequency", "filter", "torque_limit", "power_limit"}));
        check_axis(table, head, "head.drive");
    }
    if (!table.find("hoist")) return;
    if (head.motion != HeadMotion::driven) refuse_head_load(table, "hoist", "driven");
    check_axis(table, head, "head.hoist");
    if (!is_zero(head.velocity))
        table.find("velocity")
            ->fail("is for a head without a hoist; expected head.hoist.block_speed");
    head.hoist = read_hoist(table.subtable(
        "hoist", {"mass", "line_stiffness", "lines", "block_speed", "hook_load", "autodriller"}));
}

VectorSchedule along_d3(const ScalarSchedule& schedule) {
    return mapped<Eigen::Vector3d>(schedule,
                                   [](double value) { return Eigen::Vector3d(value, 0, 0); });
}

/// Operations in words in place of schedules.
void read_operations(const Table& table, HeadCase& head) {
    if (!table.find("operations")) return refuse_key(table, "ramp_time", "head.operations");
    if (head.motion != HeadMotion::driven) refuse_head_load(table, "operations", "driven");
    for (const std::string_view key : {"rotation", "velocity", "angular_velocity"})
        table.refuse_both("operations", key);
    const double ramp = table.quantity("ramp_time", dimension::time, 2, plausible::duration);
    const Operations operations = operations_in_words(*table.find("operations"), ramp);
    head.rotation = operations.rotation;
    head.slips = operations.slips;
    if (!head.hoist) {
        head.velocity = along_d3(operations.speed);
        return;
    }
    const HoistCase& hoist = *head.hoist;
    if (!is_zero(hoist.block_speed) || hoist.hook_load || hoist.autodriller)
        table.find("operations")
            ->fail("feeds the drum; expected no head.hoist.block_speed, hook_load or autodriller");
    head.hoist->block_speed = operations.speed;
}

}  // namespace

HeadCase read_head(const Table& root) {
    const Table table = root.subtable(
        "head", {"position", "direction", "motion", "force", "moment", "rotation",
                 "angular_velocity", "velocity", "drive", "hoist", "operations", "ramp_time"});
    HeadCase head;
    if (const std::optional<Value> position = table.find("position")) {
        head.position = position->vector(dimension::length, plausible::coordinate);
    }
    if (const std::optional<Value> direction = table.find("direction")) {
        head.direction = read_direction(*direction);
    }
    head.motion = table.choice<HeadMotion>("motion", head.motion,
                                           {{"driven", HeadMotion::driven},
                                            {"pinned", HeadMotion::pinned},
                                            {"free", HeadMotion::free}});
    head.force = table.vector_schedule("force", dimension::force, plausible::load);
    head.moment = table.vector_schedule("moment", dimension::moment, plausible::load);
    head.rotation = table.scalar_schedule("rotation", dimension::frequency, plausible::rotation);
    read_head_motion(table, head);
    if (head.motion != HeadMotion::free) {
        if (!is_zero(head.force)) refuse_head_load(table, "force", "free");
        if (!is_zero(head.moment)) refuse_head_load(table, "moment", "free");
    } else {
        if (!is_zero(head.rotation)) refuse_head_load(table, "rotation", "driven");
        refuse_head_load(table, "drive", "driven");
    }
    read_machines(table, head);
    read_operations(table, head);
    return head;
}

}  // namespace drillstrand
