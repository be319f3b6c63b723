/// The energy balance of a run: what the string stores must change by the work done on it less
/// what it dissipates.
#pragma once

#include "drillstrand/records.hpp"

namespace drillstrand {

/// Follows the energy accounts of a run, record by record.
class EnergyAudit {
  public:
    void add(const EnergyAccount& account);

    /// (change of stored energy + dissipation - work) over the run so far, divided by the largest
    /// of |work|, dissipation and the swing (largest less smallest) of the stored energy. Positive
    /// where energy appeared from nowhere; 0 where no energy moved.
    [[nodiscard]] double residual() const;

  private:
    bool empty_ = true;
    EnergyAccount first_;
    EnergyAccount last_;
    double least_stored_ = 0;
    double most_stored_ = 0;
    double most_work_ = 0;
    double most_dissipation_ = 0;
};

}  // namespace drillstrand
