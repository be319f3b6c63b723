/// The hoist: engine/rod/README.md, "Hoist".
#pragma once

#include <optional>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/scene.hpp"
#include "rod/autodriller.hpp"
#include "rod/end.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// What the string does to the block.
struct HoistLoad {
    double pull;    ///< N, along d3: of the first segment, with the weight of the head's cell
    double torque;  ///< N m, that the drive exerts on the head
};

class Hoist {
  public:
    /// Of a scene whose head has one.
    explicit Hoist(const Scene& scene);

    /// The start: the lines are stretched by what hangs on them (N), the bit is off bottom.
    void hang(HeadState& head, double pull) const;
    /// Takes the speed of the block (m/s along d3) through a step, and the lines with it.
    double advance(HeadState& head, double speed, const HoistLoad& load,
                   const DirectorStep& step) const;
    /// The speed after a kick (s) alone, in a step of that length (s).
    [[nodiscard]] double kicked(const HeadState& head, double speed, double pull, double time,
                                double kick, double step) const;
    /// N, of one line.
    [[nodiscard]] double dead_line_tension(const HeadState& head, double time) const;

  private:
    [[nodiscard]] bool is_in_slips(double time) const;
    /// N, of all lines.
    [[nodiscard]] double tension(const HeadState& head) const;
    /// Line that the drum feeds in a step, as a way of the block (m).
    double fed(HeadState& head, double speed, const HoistLoad& load,
               const DirectorStep& step) const;

    double weight_;     ///< of block and travelling gear along d3 (N)
    double inertia_;    ///< of these and of the head's cell (kg)
    double stiffness_;  ///< of all lines (N/m)
    double lines_;
    ScalarSchedule block_speed_;
    std::optional<ScalarSchedule> brake_;  ///< hook load at which it slips (N)
    std::optional<Autodriller> autodriller_;
    std::vector<TimeSpan> slips_;
};

}  // namespace drillstrand
