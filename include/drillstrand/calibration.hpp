/// Friction of a well's sections and weight of the block from hook loads and torques measured on
/// trips: engine/statics/README.md, "Calibration".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"

namespace drillstrand {

/// What a rig measures at a depth of the bit, off bottom.
enum class MeasuredLoad { pick_up, slack_off, rotating, torque };

/// The word for a load, as in the header of a table: pick_up, slack_off, rotating, torque.
std::string measured_load_name(MeasuredLoad load);

struct MeasuredPoint {
    double bit_depth = 0;  ///< measured depth (m)
    MeasuredLoad load = MeasuredLoad::rotating;
    double value = 0;  ///< N, with the block on the hook; torque: N m
};

/// Reads a CSV file with the column depth and at least one of pick_up, slack_off, rotating (hook
/// loads) and torque (rotating off bottom), with units in the header; without units they are in SI.
/// Fields that are empty or -999.25 hold nothing. Throws InputError at the field that is wrong.
std::vector<MeasuredPoint> read_measured_points(const std::filesystem::path& path);

/// A number that was fitted.
struct FittedNumber {
    std::string name;
    double value = 0;
    double deviation = 0;  ///< standard deviation, by the scatter of the points
};

struct Calibration {
    std::vector<FittedNumber> friction;  ///< of the sections that the points tell
    FittedNumber block_weight;           ///< N; value and deviation 0 where no hook load was given
    std::vector<double> fitted;          ///< of each point, in its unit
    double hook_load_scatter = 0;        ///< root of the mean square of what is left (N)
    double torque_scatter = 0;           ///< N m
    int rounds = 0;                      ///< of the fit
};

/// Least squares over stiff strings. Throws InputError where the points do not tell the numbers
/// apart, and SimulationError where a string has no equilibrium. `threads`: 0 for all cores; the
/// result does not depend on them.
Calibration calibrate(const Case& input, const std::vector<MeasuredPoint>& points, int threads = 0);

}  // namespace drillstrand
