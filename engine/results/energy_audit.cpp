#include "drillstrand/energy_audit.hpp"

#include <algorithm>
#include <cmath>

namespace drillstrand {

void EnergyAudit::add(const EnergyAccount& account) {
    const std::array<double, 5> parts = {account.kinetic, account.elastic, account.potential,
                                         account.work, account.dissipation};
    for (std::size_t k = 0; k < parts.size(); ++k) {
        Range& range = ranges_[k];
        range.least = empty_ ? parts[k] : std::min(range.least, parts[k]);
        range.most = empty_ ? parts[k] : std::max(range.most, parts[k]);
    }
    if (empty_) first_ = account;
    last_ = account;
    empty_ = false;
}

double EnergyAudit::appeared() const {
    return (last_.stored() - first_.stored()) + (last_.dissipation - first_.dissipation) -
           (last_.work - first_.work);
}

double EnergyAudit::moved() const {
    double most = 0;
    for (const Range& range : ranges_)
        most = std::max(most, range.most - range.least);
    return most;
}

double EnergyAudit::residual() const {
    constexpr double rounding = 1e-10;
    double largest = 0;
    for (const Range& range : ranges_)
        largest = std::max({largest, std::abs(range.least), std::abs(range.most)});
    return moved() <= rounding * largest ? 0 : appeared() / moved();
}

}  // namespace drillstrand
