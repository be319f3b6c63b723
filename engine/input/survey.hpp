/// Surveys: measured depth, inclination and azimuth of the stations, from a table or from WITSML.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"

namespace drillstrand {

/// The stations of a file, as they are, in SI.
struct Survey {
    std::vector<SurveyStation> stations;  ///< at least two, ascending measured depth
    SourceLocation start;                 ///< of the first station's measured depth
    std::string start_depth;              ///< that depth as it is written, with its unit
};

/// What there is of the well above a first station that lies below the surface.
enum class TieIn {
    vertical,  ///< a station at 0 where the well is vertical; it bends evenly from there on
    start,     ///< nothing: the well starts at the station
};

/// Throws InputError at the field where the file is wrong, at `asked_at` (the key that names the
/// file) where it cannot be read. Files that end with .xml are WITSML.
Survey read_survey(const std::filesystem::path& path, const SourceLocation& asked_at);

/// Adds what the tie-in says to a survey that starts below 0. Throws InputError where the well
/// would turn back by 180 degrees.
void tie_in(Survey& survey, TieIn above);

}  // namespace drillstrand
