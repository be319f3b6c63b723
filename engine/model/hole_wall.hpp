/// The wall of the hole along the well, from the sections of a case: engine/model/README.md,
/// "Sections".
#pragma once

#include <cstddef>
#include <vector>

#include "drillstrand/case.hpp"

namespace drillstrand {

/// A stretch of wall whose diameter and firmness go linearly from those at its start to those at
/// its end. Firmness is the normal stiffness over that of [contact].
struct HoleWall {
    std::size_t section;
    double from, to;  ///< measured depths (m)
    double diameter_from, diameter_to;
    double firmness_from, firmness_to;

    [[nodiscard]] bool varies() const {
        return diameter_from != diameter_to || firmness_from != firmness_to;
    }
    [[nodiscard]] double diameter_at(double measured_depth) const {
        return diameter_from + share(measured_depth) * (diameter_to - diameter_from);
    }
    [[nodiscard]] double firmness_at(double measured_depth) const {
        return firmness_from + share(measured_depth) * (firmness_to - firmness_from);
    }

  private:
    [[nodiscard]] double share(double measured_depth) const {
        return varies() ? (measured_depth - from) / (to - from) : 0.0;
    }
};

/// The walls of the sections, without gaps. The first begins at `start`, the measured depth of the
/// well's first station, and holds above it too; the last has no end. `normal_stiffness` (Pa) is
/// that of [contact].
std::vector<HoleWall> hole_walls(const std::vector<WellSectionCase>& sections, double start,
                                 double normal_stiffness);

}  // namespace drillstrand
