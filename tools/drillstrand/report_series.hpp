/// The series of a run, for the pictures of a page over time.
#pragma once

#include <string>
#include <vector>

#include "drillstrand/result_file.hpp"
#include "report_data.hpp"

namespace drillstrand::program {

/// Records at one interval, from the first on: what spectra need. (The last record of a run may
/// follow sooner.)
struct UniformSeries {
    double start = 0;     ///< s
    double interval = 0;  ///< s
    std::size_t count = 0;
    std::size_t stride = 1;  ///< every so many-th record
};

UniformSeries uniform_part(const std::vector<SeriesRecord>& series);

/// Adds the arrays of the series, and to `notes` what was left out to keep the page small.
void add_series(const Result& result, ArrayBlock& arrays, std::vector<std::string>& notes);

}  // namespace drillstrand::program
