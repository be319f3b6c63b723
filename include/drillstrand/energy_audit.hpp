/// The energy balance of a run: what the string stores must change by the work done on it less
/// what it dissipates.
#pragma once

#include <array>

#include "drillstrand/records.hpp"
#include "drillstrand/saved_state.hpp"

namespace drillstrand {

/// Follows the energy accounts of a run, record by record.
class EnergyAudit {
  public:
    void add(const EnergyAccount& account);

    /// Change of stored energy + dissipation - work over the run so far (J); positive where energy
    /// appeared from nowhere.
    [[nodiscard]] double appeared() const;

    /// The energy that moved: the largest swing (largest less smallest value) of kinetic, elastic
    /// or potential energy, work or dissipation (J). What springs of the wall held at the start
    /// swings too, from them into dashpots and friction, and is no measure of the rest: it does not
    /// count.
    [[nodiscard]] double moved() const;

    /// What appeared, divided by what moved; 0 where no energy moved but by rounding (1e-9 of the
    /// largest energy), as in a string that stays at rest.
    [[nodiscard]] double residual() const;

    /// The audit as rows, and one that goes on from them. Throws std::invalid_argument where the
    /// rows are of something else.
    [[nodiscard]] SavedState save() const;
    void restore(const SavedState& saved);

  private:
    /// Least and largest value of a part of the account.
    struct Range {
        double least = 0;
        double most = 0;
    };

    bool empty_ = true;
    EnergyAccount first_;
    EnergyAccount last_;
    std::array<Range, 5> ranges_;  ///< kinetic, elastic, potential, work, dissipation
};

}  // namespace drillstrand
