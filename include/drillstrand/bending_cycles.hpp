/// Cycles of bending stress along a rotating string (engine/simulation/README.md, "Cycles").
#pragma once

#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/drill_string.hpp"
#include "drillstrand/rainflow.hpp"
#include "drillstrand/records.hpp"
#include "drillstrand/saved_state.hpp"

namespace drillstrand {

/// Of each segment, that of its fibres which suffers most damage.
struct SegmentCycles {
    std::vector<double> cycles;
    std::vector<double> largest_range;     ///< Pa
    std::vector<double> equivalent_range;  ///< Pa, of CycleCount
};

/// Counts the cycles of bending stress of fibres of each segment that turn with it.
class BendingCycles {
  public:
    BendingCycles(const StringMesh& mesh, const StringCase& string, const CyclesCase& settings);

    void add(const BendingRecord& record);

    [[nodiscard]] SegmentCycles segments() const;
    /// A line "cycles: what" for each component that has any: its worst segment.
    [[nodiscard]] std::vector<std::string> findings() const;

    /// All of it as a row; restore() throws std::invalid_argument where there is none of this
    /// string.
    [[nodiscard]] SavedState save() const;
    void restore(const SavedState& saved);

  private:
    struct Place {
        double s = 0;        ///< of the segment's middle (m)
        double modulus = 0;  ///< of its section (m3)
    };
    struct Part {
        std::string name;
        double end = 0;  ///< m
    };

    /// The fibre of a segment that suffers most damage.
    [[nodiscard]] const RainflowCounter& worst_of(std::size_t segment) const;

    double slope_;
    std::vector<Place> places_;
    std::vector<Part> parts_;
    std::vector<RainflowCounter> fibres_;  ///< of the first segment, of the second, ...
};

}  // namespace drillstrand
