/// The autodriller: engine/rod/README.md, "Autodriller".
#pragma once

#include <array>
#include <optional>

#include "drillstrand/case.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// What its gauges show, in the order of its loops: weight on bit (N), speed of the block (m/s),
/// surface torque (N m), difference of pressure over the motor (Pa).
using DrillerReadings = std::array<double, 4>;

/// Loops of an autodriller, in the order of its readings.
std::array<std::optional<DrillerLoop>, 4> driller_loops(const AutodrillerCase& autodriller);

class Autodriller {
  public:
    explicit Autodriller(const AutodrillerCase& autodriller);

    /// N; none: the hook load at the start.
    [[nodiscard]] std::optional<double> off_bottom_load() const { return off_bottom_load_; }
    /// Speed at which it feeds the drum in a step (s), as the block would move (m/s, not negative).
    double drum_speed(HeadState& head, const DrillerReadings& readings, double time,
                      double step) const;

  private:
    std::array<std::optional<DrillerLoop>, 4> loops_;
    std::optional<double> off_bottom_load_;
};

}  // namespace drillstrand
