/// How far the time steps of a run are from exact ones, and steps that keep to a tolerance.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// Kinetic energy of the momenta and strain energy of the stresses of a profile (J), or of the
/// difference of two.
double rod_energy(const Scene& scene, const Profile& profile);
double rod_energy_between(const Scene& scene, const Profile& one, const Profile& other);

/// Energy of a stretch that only rounding errors show (J).
double negligible_energy(const Scene& scene);

/// When a run samples its time error, and by how much it shortens its steps where a tolerance is
/// set. What it found is state: TimeError (state/rows.hpp).
class TimeErrorControl {
  public:
    /// Steps of the run that a sample repeats, and repeats in halves.
    static constexpr std::int64_t window = 16;

    /// `tolerance`: largest time error of a window (relative); 0: watch only. Energies below
    /// `negligible` (J) are rounding errors.
    TimeErrorControl(double tolerance, double negligible)
        : tolerance_(tolerance), negligible_(negligible) {}

    /// A sample ahead of the steps to come, taken after `steps` steps at `time` (s): energy of the
    /// rod after a window in steps half as long, and of its difference from that in the steps of
    /// the run. Where it misses the tolerance the steps become shorter, and the next sample is due
    /// at once.
    void add(TimeError& found, std::int64_t steps, double time, double energy,
             double difference) const;
    /// A sample that could not be taken.
    void skip(TimeError& found, std::int64_t steps) const { found.due = next_due(steps); }

    /// A sentence where the tolerance was missed.
    [[nodiscard]] std::optional<std::string> warning(const TimeError& found) const;

  private:
    [[nodiscard]] std::int64_t next_due(std::int64_t steps) const;

    double tolerance_;
    double negligible_;  ///< J
};

}  // namespace drillstrand
