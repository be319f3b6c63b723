/// Measured channels beside the simulated ones.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drillstrand/measured.hpp"
#include "drillstrand/result_file.hpp"
#include "report_data.hpp"

namespace drillstrand::program {

struct ChannelStatistics {
    double mean = 0;
    double least = 0;
    double greatest = 0;
};

/// One measured channel and what the simulation says of it, over the times that both have.
struct ChannelComparison {
    std::string channel;   ///< "hook_load", "torque"
    std::string title;     ///< "Hook load", "Surface torque"
    std::string quantity;  ///< name of the page's unit: "force", "moment"
    std::size_t points = 0;
    ChannelStatistics measured;
    ChannelStatistics simulated;
    std::optional<double> correlation;  ///< Pearson's; none where one of the two is constant
};

/// Measured times plus `offset` are times of the simulation. The simulation is interpolated
/// linearly between its records. Throws UsageError where the two have fewer than two times in
/// common.
std::vector<ChannelComparison> compare(const MeasuredChannels& measured, double offset,
                                       const std::vector<SeriesRecord>& series);

/// One line per channel, for people.
void print_comparison(const std::vector<ChannelComparison>& comparison);

std::string json_of(const std::vector<ChannelComparison>& comparison);

/// Adds the measured channels, at times of the simulation.
void add_measured(const MeasuredChannels& measured, double offset, ArrayBlock& arrays,
                  std::vector<std::string>& notes);

}  // namespace drillstrand::program
