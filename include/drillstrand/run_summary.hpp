/// What a user should know of a whole run, gathered record by record.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drillstrand/bending_cycles.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/energy_audit.hpp"
#include "drillstrand/last_part.hpp"
#include "drillstrand/records.hpp"
#include "drillstrand/saved_state.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

class RunSummary {
  public:
    explicit RunSummary(const Scene& scene);
    /// Counts cycles where the case asks for them.
    RunSummary(const Scene& scene, const Case& input);

    void add(const SeriesRecord& record);
    void add(const BendingRecord& record);

    [[nodiscard]] double energy_residual() const { return audit_.residual(); }
    [[nodiscard]] double largest_penetration() const { return penetration_; }  ///< m

    /// Until when a string that is let go settles (s): axial waves go up and down it twice, and a
    /// second at least. Its time error is that of this fall and no measure of the rest of the run.
    [[nodiscard]] double settled_after() const { return settled_after_; }
    /// Largest time error until then; the largest and the median of the samples after (that of the
    /// start, where a run ends before).
    [[nodiscard]] double time_error_at_start() const { return time_error_at_start_; }
    [[nodiscard]] bool is_settled() const { return !time_errors_.empty(); }
    [[nodiscard]] double time_error_largest() const;
    [[nodiscard]] double time_error_median() const;

    /// Empty where no cycles are counted.
    [[nodiscard]] SegmentCycles cycles() const;

    /// Of the last part of the run.
    [[nodiscard]] BitConduct bit() const { return last_part_.bit(); }

    /// What the string did: how the bit turned and pressed, whirl and what the walls carry, of the
    /// last part of the run, the deepest penetration, and the cycles of bending of each component.
    /// A line each, "subject: what".
    [[nodiscard]] std::vector<std::string> findings() const;
    /// A sentence each.
    [[nodiscard]] std::vector<std::string> warnings() const;

    /// All of it as rows; restore() throws std::invalid_argument where they are of something else.
    [[nodiscard]] SavedState save() const;
    void restore(const SavedState& saved);

  private:
    std::vector<std::string> notes_;  ///< of the scene
    EnergyAudit audit_;
    double settled_after_;
    LastPart last_part_;
    std::optional<BendingCycles> cycles_;
    double penetration_ = 0;           ///< m
    double penetration_time_ = 0;      ///< s
    double penetration_depth_ = 0;     ///< m
    double helix_penetration_ = 0;     ///< m
    double relative_penetration_ = 0;  ///< of a node, divided by the clearance that it has
    double deepest_time_ = 0;          ///< of the relative one (s)
    double time_error_at_start_ = 0;
    double latest_time_error_ = 0;
    std::vector<double> time_errors_;  ///< samples after the start
};

}  // namespace drillstrand
