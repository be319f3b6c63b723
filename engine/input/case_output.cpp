#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"

namespace drillstrand {

namespace {

constexpr double most_records = 1e8;
constexpr std::size_t most_sensors = 1000;

/// Throws InputError where a run would write more records than anybody reads, or at times that
/// rounding does not tell apart. `stated`: the interval, where the case states it.
void check_records(const Table& root, const std::optional<Value>& stated, const std::string& path,
                   double interval, double duration) {
    const double records = duration / interval;
    if (interval == 0 || records <= most_records) return;
    const std::string limit = fmt::format("expected at most {:g}, an interval of at least {:.3g} s",
                                          most_records, duration / most_records);
    const Value run = *root.find("run");
    const Value lasting(*(*run.node().as_table())["duration"].node(), "run.duration");
    if (stated)
        stated->fail(fmt::format("makes {:.3g} records in {}; {}", records,
                                 lasting.written(dimension::time), limit));
    // then the duration is what the user wrote
    lasting.fail(
        fmt::format("makes {:.3g} records with {} = {:.6g} s; {}", records, path, interval, limit));
}

/// Reads the key `interval` of a table, or another.
double read_interval(const Table& root, const Table& table, std::string_view key, double standard,
                     const Range& range, double duration) {
    const double interval = table.quantity(key, dimension::time, standard, range);
    check_records(root, table.find(key), table.path_of(key), interval, duration);
    return interval;
}

CyclesCase read_cycles(const Table& root, const Table& table, double duration) {
    CyclesCase cycles;
    cycles.interval =
        read_interval(root, table, "interval", cycles.interval, plausible::duration, duration);
    cycles.slope = table.number("slope", cycles.slope, plausible::slope);
    return cycles;
}

std::string read_name(const Value& value, const std::vector<SensorCase>& others) {
    std::string name = value.text();
    if (!is_sensor_name(name))
        value.fail_expected("1 to 64 letters, digits, \"-\" and \"_\", such as \"mwd\"");
    for (const SensorCase& other : others)
        if (other.name == name) value.fail_expected("a name that no other sensor has");
    return name;
}

/// Along the string, from the head.
double read_depth(const Table& table, double string_length) {
    const Value depth = table.require("depth", "a place along the string such as \"12 m\"");
    const double from_end = depth.quantity(dimension::length, plausible::length_or_none);
    if (from_end > string_length)
        depth.fail(fmt::format("is {}; expected at most {:.6g} m, the length of the string",
                               depth.written(dimension::length), string_length));
    const bool from_the_bit =
        table.choice<bool>("measured_from", false, {{"head", false}, {"bit", true}});
    return from_the_bit ? string_length - from_end : from_end;
}

std::vector<SensorCase> read_sensors(const Table& root, const Value& list, double duration,
                                     double string_length) {
    const std::vector<Value> values = list.elements("a list of tables [[output.sensor]]");
    if (values.size() > most_sensors)
        list.fail(fmt::format("has {} sensors; expected at most {}", values.size(), most_sensors));
    std::vector<SensorCase> sensors;
    for (const Value& value : values) {
        const Table table(value, {"name", "depth", "measured_from", "radius", "interval"});
        SensorCase sensor;
        sensor.name = read_name(table.require("name", "a name such as \"mwd\""), sensors);
        sensor.depth = read_depth(table, string_length);
        sensor.radius =
            table.quantity("radius", dimension::length, sensor.radius, plausible::diameter_or_none);
        sensor.interval =
            read_interval(root, table, "interval", sensor.interval, plausible::duration, duration);
        sensors.push_back(sensor);
    }
    return sensors;
}

}  // namespace

bool is_sensor_name(const std::string& text) {
    constexpr std::size_t longest = 64;
    return !text.empty() && text.size() <= longest &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) {
               return c < 128 && (std::isalnum(c) != 0 || c == '-' || c == '_');
           });
}

OutputCase read_output(const Table& root, double duration, const StringCase& string) {
    const Table table =
        root.subtable("output", {"interval", "profile_interval", "checkpoint_interval",
                                 "side_force_window", "cycles", "sensor"});
    OutputCase output;
    output.interval =
        read_interval(root, table, "interval", output.interval, plausible::duration, duration);
    output.profile_interval =
        read_interval(root, table, "profile_interval", output.profile_interval,
                      plausible::duration_or_none, duration);
    output.checkpoint_interval =
        table.quantity("checkpoint_interval", dimension::time, output.checkpoint_interval,
                       plausible::duration_or_none);
    output.side_force_window = table.quantity("side_force_window", dimension::length,
                                              output.side_force_window, plausible::length);
    if (table.find("cycles"))
        output.cycles =
            read_cycles(root, table.subtable("cycles", {"interval", "slope"}), duration);
    if (const std::optional<Value> sensors = table.find("sensor"))
        output.sensors = read_sensors(root, *sensors, duration, total_length(string));
    return output;
}

}  // namespace drillstrand
