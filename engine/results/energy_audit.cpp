#include "drillstrand/energy_audit.hpp"

#include <algorithm>
#include <cmath>

namespace drillstrand {

void EnergyAudit::add(const EnergyAccount& account) {
    const double stored = account.stored();
    if (empty_) {
        first_ = account;
        least_stored_ = most_stored_ = stored;
        empty_ = false;
    }
    last_ = account;
    least_stored_ = std::min(least_stored_, stored);
    most_stored_ = std::max(most_stored_, stored);
    most_work_ = std::max(most_work_, std::abs(account.work - first_.work));
    most_dissipation_ =
        std::max(most_dissipation_, std::abs(account.dissipation - first_.dissipation));
}

double EnergyAudit::residual() const {
    const double scale = std::max({most_work_, most_dissipation_, most_stored_ - least_stored_});
    if (scale == 0) return 0;
    const double appeared = (last_.stored() - first_.stored()) +
                            (last_.dissipation - first_.dissipation) - (last_.work - first_.work);
    return appeared / scale;
}

}  // namespace drillstrand
