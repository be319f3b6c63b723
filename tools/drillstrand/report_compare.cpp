#include "report_compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "commands.hpp"
#include "report_series.hpp"
#include "report_string.hpp"

namespace drillstrand::program {

namespace {

constexpr std::size_t most_points = 20000;

/// Two channels at the same times.
struct Pairs {
    std::vector<double> measured;
    std::vector<double> simulated;
};

ChannelStatistics statistics_of(const std::vector<double>& values) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return {sum / static_cast<double>(values.size()), *least, *greatest};
}

std::optional<double> correlation_of(const Pairs& pairs) {
    const double x_mean = statistics_of(pairs.measured).mean;
    const double y_mean = statistics_of(pairs.simulated).mean;
    double xx = 0;
    double yy = 0;
    double xy = 0;
    for (std::size_t k = 0; k < pairs.measured.size(); ++k) {
        const double x = pairs.measured[k] - x_mean;
        const double y = pairs.simulated[k] - y_mean;
        xx += x * x;
        yy += y * y;
        xy += x * y;
    }
    if (xx <= 0 || yy <= 0) return std::nullopt;
    return xy / std::sqrt(xx * yy);
}

template <class Value>
Pairs pair_up(const std::vector<double>& times, const std::vector<double>& values, double offset,
              const std::vector<SeriesRecord>& series, Value&& simulated) {
    Pairs pairs;
    std::size_t k = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double time = times[i] + offset;
        if (time < series.front().time || time > series.back().time) continue;
        while (k + 2 < series.size() && series[k + 1].time < time)
            ++k;
        const SeriesRecord& before = series[k];
        const SeriesRecord& after = series[k + 1];
        const double share = (time - before.time) / (after.time - before.time);
        pairs.measured.push_back(values[i]);
        pairs.simulated.push_back((1 - share) * simulated(before) + share * simulated(after));
    }
    return pairs;
}

ChannelComparison comparison_of(const char* channel, const char* title, const char* quantity,
                                const Pairs& pairs) {
    if (pairs.measured.size() < 2)
        throw UsageError(
            "--compare: measured and simulated times overlap at fewer than two measured times; "
            "shift the measured clock with --offset, as in --offset \"-30 s\"");
    return {channel,
            title,
            quantity,
            pairs.measured.size(),
            statistics_of(pairs.measured),
            statistics_of(pairs.simulated),
            correlation_of(pairs)};
}

std::string json_of(const ChannelStatistics& statistics) {
    return json_object({{"mean", json_number(statistics.mean)},
                        {"least", json_number(statistics.least)},
                        {"greatest", json_number(statistics.greatest)}});
}

std::string in_kilo(const ChannelStatistics& statistics) {
    return fmt::format("mean {:.5g}, range {:.5g} to {:.5g}", statistics.mean / 1000,
                       statistics.least / 1000, statistics.greatest / 1000);
}

}  // namespace

std::vector<ChannelComparison> compare(const MeasuredChannels& measured, double offset,
                                       const std::vector<SeriesRecord>& series) {
    if (series.size() < 2)
        throw UsageError("--compare: the result has fewer than two records; nothing to compare");
    std::vector<ChannelComparison> comparison;
    const auto add = [&](const char* channel, const char* title, const char* quantity,
                         const std::vector<double>& values, auto simulated) {
        if (values.empty()) return;
        comparison.push_back(comparison_of(
            channel, title, quantity, pair_up(measured.time, values, offset, series, simulated)));
    };
    add("hook_load", "Hook load", "force", measured.hook_load,
        [](const SeriesRecord& record) { return record.hook_load; });
    add("torque", "Surface torque", "moment", measured.torque,
        [](const SeriesRecord& record) { return record.surface_torque; });
    return comparison;
}

void print_comparison(const std::vector<ChannelComparison>& comparison) {
    for (const ChannelComparison& channel : comparison) {
        fmt::print("{} ({}), {} points\n", channel.title,
                   channel.quantity == "force" ? "kN" : "kN m", channel.points);
        fmt::print("  measured     {}\n", in_kilo(channel.measured));
        fmt::print("  simulated    {}\n", in_kilo(channel.simulated));
        fmt::print("  correlation  {}\n", channel.correlation
                                              ? fmt::format("{:.4f}", *channel.correlation)
                                              : "none: one of the two is constant");
    }
}

std::string json_of(const std::vector<ChannelComparison>& comparison) {
    std::vector<std::string> channels;
    for (const ChannelComparison& channel : comparison)
        channels.push_back(json_object(
            {{"channel", json_text(channel.channel)},
             {"title", json_text(channel.title)},
             {"quantity", json_text(channel.quantity)},
             {"points", std::to_string(channel.points)},
             {"measured", json_of(channel.measured)},
             {"simulated", json_of(channel.simulated)},
             {"difference", json_number(channel.simulated.mean - channel.measured.mean)},
             {"correlation", channel.correlation ? json_number(*channel.correlation) : "null"}}));
    return json_list(channels);
}

void add_measured(const MeasuredChannels& measured, double offset, ArrayBlock& arrays,
                  std::vector<std::string>& notes) {
    const auto picks = pick_evenly(measured.time.size(), most_points);
    const auto add = [&](const char* name, const std::vector<double>& values) {
        if (values.empty()) return;
        std::vector<double> picked;
        for (const std::size_t k : picks)
            picked.push_back(values[k]);
        arrays.add(name, picked);
    };
    std::vector<double> times;
    for (const std::size_t k : picks)
        times.push_back(measured.time[k] + offset);
    arrays.add_exact("measured/time", times);
    add("measured/hook_load", measured.hook_load);
    add("measured/torque", measured.torque);
    if (picks.size() < measured.time.size())
        notes.push_back(
            fmt::format("{} of {} measured points are drawn, evenly picked; the "
                        "numbers of the comparison are those of all.",
                        picks.size(), measured.time.size()));
}

}  // namespace drillstrand::program
