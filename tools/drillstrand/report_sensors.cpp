#include "report_sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report_string.hpp"

namespace drillstrand::program {

namespace {

constexpr std::size_t most_values = 400000;  // of all sensors
constexpr std::size_t channels = 8;

void add_sensor(const std::string& path, const std::vector<SensorRecord>& records,
                const std::vector<std::size_t>& picks, ArrayBlock& arrays) {
    const auto values_of = [&](auto&& value) {
        std::vector<double> values;
        for (const std::size_t k : picks)
            values.push_back(value(records[k]));
        return values;
    };
    arrays.add_exact(path + "time", values_of([](const auto& r) { return r.time; }));
    const auto add = [&](const char* name, auto&& value) {
        arrays.add(path + name, values_of(value));
    };
    add("axial", [](const auto& r) { return r.acceleration[0]; });
    add("along_d1", [](const auto& r) { return r.acceleration[1]; });
    add("along_d2", [](const auto& r) { return r.acceleration[2]; });
    add("rotation", [](const auto& r) { return r.rotation_rate; });
    add("bending_1", [](const auto& r) { return r.bending_moment[0]; });
    add("bending_2", [](const auto& r) { return r.bending_moment[1]; });
    add("torque", [](const auto& r) { return r.torque; });
    add("tension", [](const auto& r) { return r.tension; });
}

}  // namespace

void add_sensors(const Result& result, ArrayBlock& arrays, std::vector<std::string>& notes) {
    const std::size_t count = result.sensors.size();
    if (count == 0) return;
    const std::size_t most = std::max<std::size_t>(2, most_values / (channels * count));
    bool thinned = false;
    for (std::size_t k = 0; k < count; ++k) {
        const std::vector<std::size_t> picks = pick_evenly(result.sensors[k].size(), most);
        add_sensor(fmt::format("sensors/{}/", k), result.sensors[k], picks, arrays);
        thinned = thinned || picks.size() < result.sensors[k].size();
    }
    if (thinned)
        notes.push_back("Records of sensors are drawn evenly picked, to keep this page small.");
}

std::string sensors_json(const ResultHeader& header) {
    std::vector<std::string> list;
    for (const SensorCase& sensor : header.sensors)
        list.push_back(
            json_object({{"name", json_text(sensor.name)}, {"depth", json_number(sensor.depth)}}));
    return json_list(list);
}

}  // namespace drillstrand::program
