#include "input/tortuosity.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "input/plausible.hpp"
#include "input/table.hpp"
#include "input/written.hpp"

namespace drillstrand {

namespace {

using Eigen::Vector3d;

constexpr double two_pi = 2 * std::numbers::pi;
constexpr Range amplitude_range{.low = 0, .high = 0.5};
constexpr double most_stations = 1e5;
constexpr int most_seed = 1'000'000'000;

double step_of(const Tortuosity& tortuosity) {
    return tortuosity.model == TortuosityModel::random ? tortuosity.period : tortuosity.period / 12;
}

// ------------------------------------------------------------------ reading

/// One amplitude for both directions, or [build, turn].
void read_amplitude(const Value& value, Tortuosity& tortuosity) {
    if (!value.is_list()) {
        tortuosity.build = tortuosity.turn = value.quantity(dimension::angle, amplitude_range);
        return;
    }
    const std::vector<Value> parts = value.elements("an angle or [build, turn]");
    if (parts.size() != 2)
        value.fail(fmt::format("has {} entries; expected an angle or [build, turn]", parts.size()));
    tortuosity.build = parts[0].quantity(dimension::angle, amplitude_range);
    tortuosity.turn = parts[1].quantity(dimension::angle, amplitude_range);
}

double read_depth(const Table& table, const char* key, double standard, double low, double high) {
    const std::optional<Value> value = table.find(key);
    if (!value) return standard;
    const double depth = value->quantity(dimension::length, plausible::coordinate);
    if (depth < low || depth > high)
        value->fail(fmt::format("is {}; expected {} to {}, in the survey", length_text(depth),
                                length_text(low), length_text(high)));
    return depth;
}

// ------------------------------------------------------------------ directions

Vector3d direction_of(const SurveyStation& station) {
    const double across = std::sin(station.inclination);
    return {across * std::cos(station.azimuth), across * std::sin(station.azimuth),
            std::cos(station.inclination)};
}

SurveyStation station_at(double depth, const Vector3d& direction, double azimuth_if_vertical) {
    constexpr double vertical = 1e-9;
    const double across = std::hypot(direction.x(), direction.y());
    const double azimuth = std::atan2(direction.y(), direction.x());
    return {depth, std::atan2(across, direction.z()),
            across < vertical ? azimuth_if_vertical : (azimuth < 0 ? azimuth + two_pi : azimuth)};
}

/// On the arc between two stations.
SurveyStation between(const SurveyStation& upper, const SurveyStation& lower, double depth) {
    constexpr double straight = 1e-9;
    const Vector3d from = direction_of(upper);
    const Vector3d to = direction_of(lower);
    const double share =
        (depth - upper.measured_depth) / (lower.measured_depth - upper.measured_depth);
    const double angle = 2 * std::asin(std::min(1.0, 0.5 * (to - from).norm()));
    if (angle < straight) return station_at(depth, from, upper.azimuth);
    const Vector3d direction =
        (std::sin((1 - share) * angle) * from + std::sin(share * angle) * to) / std::sin(angle);
    return station_at(depth, direction, upper.azimuth);
}

/// Tilted by the angle `build` to where the inclination grows and by `turn` to where the azimuth
/// does.
SurveyStation tilted(const SurveyStation& station, double build, double turn) {
    const double i = station.inclination;
    const double a = station.azimuth;
    const Vector3d up(std::cos(i) * std::cos(a), std::cos(i) * std::sin(a), -std::sin(i));
    const Vector3d right(-std::sin(a), std::cos(a), 0);
    const double angle = std::hypot(build, turn);
    if (angle == 0) return station;
    const Vector3d direction = std::cos(angle) * direction_of(station) +
                               std::sin(angle) / angle * (build * up + turn * right);
    return station_at(station.measured_depth, direction, a);
}

// ------------------------------------------------------------------ models

/// Evenly between -1 and 1: the splitmix64 of Steele, Lea and Flood (2014), number `index` of its
/// sequence. The same on every machine, unlike the distributions of the standard library.
double even(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z = seed + (index + 1) * 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    z ^= z >> 31U;
    return 2 * (static_cast<double>(z >> 11U) * 0x1p-53) - 1;
}

/// Of independent numbers for every whole period; none where the stretch begins.
double random_part(const Tortuosity& tortuosity, double periods, std::uint64_t channel) {
    const auto number = [&](double whole) {
        return whole > 0 ? even(tortuosity.seed, 2 * static_cast<std::uint64_t>(whole) + channel)
                         : 0.0;
    };
    const double whole = std::floor(periods);
    return number(whole) + (periods - whole) * (number(whole + 1) - number(whole));
}

SurveyStation tortuous(const SurveyStation& station, const Tortuosity& tortuosity) {
    const double periods = (station.measured_depth - tortuosity.from) / tortuosity.period;
    const double sine = std::sin(two_pi * periods);
    double build = sine;
    double turn = sine;
    if (tortuosity.model == TortuosityModel::helical) {
        // the hole leaves its plan within one period
        const double grown = std::min(periods, 1.0);
        build = grown * sine;
        turn = grown * std::cos(two_pi * periods);
    } else if (tortuosity.model == TortuosityModel::random) {
        build = random_part(tortuosity, periods, 0);
        turn = random_part(tortuosity, periods, 1);
    }
    return tilted(station, tortuosity.build * build, tortuosity.turn * turn);
}

}  // namespace

Tortuosity read_tortuosity(const Value& value, const std::vector<SurveyStation>& survey) {
    const Table table(value, {"model", "amplitude", "period", "seed", "from", "to"});
    const double start = survey.front().measured_depth;
    const double end = survey.back().measured_depth;
    Tortuosity tortuosity;
    tortuosity.model = table.choice<TortuosityModel>("model", tortuosity.model,
                                                     {{"sine", TortuosityModel::sine},
                                                      {"helical", TortuosityModel::helical},
                                                      {"random", TortuosityModel::random}});
    read_amplitude(table.require("amplitude", "an angle such as \"0.5 deg\", or [build, turn]"),
                   tortuosity);
    const Value period = table.require("period", "a length such as \"100 ft\"");
    tortuosity.period = period.quantity(dimension::length, plausible::length);
    tortuosity.seed = static_cast<std::uint64_t>(table.whole_number("seed", 1, 0, most_seed));
    if (tortuosity.model != TortuosityModel::random)
        if (const std::optional<Value> unused = table.find("seed"))
            unused->fail("has no effect; expected it with model = \"random\"");
    tortuosity.from = read_depth(table, "from", start, start, end);
    tortuosity.to = read_depth(table, "to", end, tortuosity.from, end);
    const double least = (end - start) / most_stations;
    if (step_of(tortuosity) < least)
        period.fail(fmt::format("is {:.9g} m; expected at least {:.9g} m in a survey of {:.9g} m",
                                tortuosity.period, least * tortuosity.period / step_of(tortuosity),
                                end - start));
    return tortuosity;
}

std::vector<SurveyStation> with_tortuosity(const std::vector<SurveyStation>& survey,
                                           const Tortuosity& tortuosity) {
    const double step = step_of(tortuosity);
    // nearer to a station of the survey than this, a station would make a spike of rounding
    const double nearest = 1e-3 * step;
    std::vector<SurveyStation> result;
    double number = 0;
    const auto next_depth = [&] { return tortuosity.from + number * step; };
    const auto add = [&](const SurveyStation& station) {
        const bool inside =
            station.measured_depth >= tortuosity.from && station.measured_depth <= tortuosity.to;
        result.push_back(inside ? tortuous(station, tortuosity) : station);
    };
    for (std::size_t k = 0; k < survey.size(); ++k) {
        for (; next_depth() < survey[k].measured_depth && next_depth() <= tortuosity.to; ++number) {
            if (k == 0 || survey[k].measured_depth - next_depth() < nearest ||
                next_depth() - survey[k - 1].measured_depth < nearest)
                continue;
            add(between(survey[k - 1], survey[k], next_depth()));
        }
        add(survey[k]);
    }
    return result;
}

}  // namespace drillstrand
