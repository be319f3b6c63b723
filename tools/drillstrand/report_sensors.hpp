/// What sensors in the string recorded, for the page.
#pragma once

#include <string>
#include <vector>

#include "drillstrand/result_file.hpp"
#include "report_data.hpp"

namespace drillstrand::program {

/// Arrays sensors/K/... of the K-th sensor; a note where a page shows fewer records than there are.
void add_sensors(const Result& result, ArrayBlock& arrays, std::vector<std::string>& notes);

/// Name and depth (m) of each.
std::string sensors_json(const ResultHeader& header);

}  // namespace drillstrand::program
