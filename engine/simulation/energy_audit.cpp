#include "drillstrand/energy_audit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drillstrand {

namespace {

// parts of the account, as add() lists them
constexpr std::size_t elastic = 1;
constexpr std::size_t dissipation = 4;
// numbers of an account, as members() lists them
constexpr std::size_t numbers = 7;

/// The account as numbers, and back.
std::array<double*, numbers> members(EnergyAccount& a) {
    return {&a.kinetic,   &a.half_steps, &a.elastic,    &a.springs,
            &a.potential, &a.work,       &a.dissipation};
}

}  // namespace

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
    for (std::size_t k = 0; k < ranges_.size(); ++k) {
        const double swing = ranges_[k].most - ranges_[k].least;
        most = std::max(most, k == elastic || k == dissipation ? swing - first_.springs : swing);
    }
    return most;
}

double EnergyAudit::residual() const {
    constexpr double rounding = 1e-9;
    double largest = 0;
    for (const Range& range : ranges_)
        largest = std::max({largest, std::abs(range.least), std::abs(range.most)});
    return moved() <= rounding * largest ? 0 : appeared() / moved();
}

SavedState EnergyAudit::save() const {
    SavedRow row{"energy_audit", "J", {empty_ ? 1.0 : 0.0}};
    EnergyAccount first = first_;
    EnergyAccount last = last_;
    for (EnergyAccount* account : {&first, &last}) {
        for (const double* value : members(*account))
            row.values.push_back(*value);
    }
    for (const Range& range : ranges_)
        row.values.insert(row.values.end(), {range.least, range.most});
    return {row};
}

void EnergyAudit::restore(const SavedState& saved) {
    const auto row = std::find_if(saved.begin(), saved.end(), [](const SavedRow& candidate) {
        return candidate.name == "energy_audit";
    });
    if (row == saved.end() || row->values.size() != 1 + 2 * numbers + 2 * ranges_.size())
        throw std::invalid_argument("the saved summary has no energy audit");
    auto value = row->values.begin();
    empty_ = *value++ != 0;
    for (EnergyAccount* account : {&first_, &last_}) {
        for (double* member : members(*account))
            *member = *value++;
    }
    for (Range& range : ranges_) {
        range.least = *value++;
        range.most = *value++;
    }
}

}  // namespace drillstrand
