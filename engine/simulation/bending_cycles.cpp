#include "drillstrand/bending_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace drillstrand {

namespace {

constexpr double resolution = 1e6;  // Pa: smaller ranges do steel no harm

/// Directions of the fibres across the section: any other lies within 22.5 degrees of one of them,
/// or of its opposite.
constexpr double half = std::numbers::sqrt2 / 2;
constexpr std::array<std::array<double, 2>, 4> directions = {
    {{1, 0}, {half, half}, {0, 1}, {-half, half}}};

}  // namespace

BendingCycles::BendingCycles(const StringMesh& mesh, const StringCase& string,
                             const CyclesCase& settings)
    : slope_(settings.slope),
      fibres_(mesh.segment.size() * directions.size(),
              RainflowCounter(settings.slope, resolution)) {
    for (std::size_t k = 0; k < mesh.segment.size(); ++k)
        places_.push_back({mesh.segment_s[k], mesh.segment[k].section_modulus});
    double end = 0;
    for (const Component& component : string.components)
        parts_.push_back({component.name, end += component.length});
}

/// A moment about d1 bends the fibre on the side of d2, one about d2 that on the side of -d1.
void BendingCycles::add(const BendingRecord& record) {
    auto fibre = fibres_.begin();
    for (std::size_t k = 0; k < places_.size(); ++k) {
        const Eigen::Vector2d stress = record.moment[k] / places_[k].modulus;
        for (const auto& [d1, d2] : directions)
            (fibre++)->add(d2 * stress[0] - d1 * stress[1]);
    }
}

const RainflowCounter& BendingCycles::worst_of(std::size_t segment) const {
    const auto first = fibres_.begin() + static_cast<std::ptrdiff_t>(segment * directions.size());
    return *std::max_element(
        first, first + directions.size(),
        [](const RainflowCounter& a, const RainflowCounter& b) { return a.damage() < b.damage(); });
}

SegmentCycles BendingCycles::segments() const {
    SegmentCycles all;
    for (std::size_t k = 0; k < places_.size(); ++k) {
        const CycleCount count = worst_of(k).count();
        all.cycles.push_back(count.cycles);
        all.largest_range.push_back(count.largest_range);
        all.equivalent_range.push_back(count.equivalent_range);
    }
    return all;
}

std::vector<std::string> BendingCycles::findings() const {
    std::vector<std::string> lines;
    std::size_t segment = 0;
    for (const Part& part : parts_) {
        std::size_t worst = segment;
        double most = 0;
        for (; segment < places_.size() && places_[segment].s < part.end; ++segment) {
            const double damage = worst_of(segment).damage();
            if (damage <= most) continue;
            most = damage;
            worst = segment;
        }
        if (most == 0) continue;
        const CycleCount count = worst_of(worst).count();
        lines.push_back(fmt::format(
            "cycles: {}: worst bending {:.5g} m from the head: {:.6g} cycles, the largest of "
            "{:.4g} "
            "MPa, as harmful as so many of {:.4g} MPa (S-N slope {:.3g})",
            part.name.empty() ? "a component" : part.name, places_[worst].s, count.cycles,
            1e-6 * count.largest_range, 1e-6 * count.equivalent_range, slope_));
    }
    return lines;
}

SavedState BendingCycles::save() const {
    SavedRow row{
        "bending_cycles", "of each fibre: 1, then 1, Pa^m, Pa, 1, 1, Pa, and Pa of turns", {}};
    for (const RainflowCounter& fibre : fibres_) {
        const std::vector<double> saved = fibre.save();
        row.values.push_back(static_cast<double>(saved.size()));
        row.values.insert(row.values.end(), saved.begin(), saved.end());
    }
    return {row};
}

void BendingCycles::restore(const SavedState& saved) {
    const auto row = std::find_if(saved.begin(), saved.end(), [](const SavedRow& candidate) {
        return candidate.name == "bending_cycles";
    });
    const auto refuse = [] {
        throw std::invalid_argument("the saved summary has no row bending_cycles of this string");
    };
    if (row == saved.end()) refuse();
    std::vector<RainflowCounter> restored = fibres_;
    auto value = row->values.begin();
    for (RainflowCounter& fibre : restored) {
        if (value == row->values.end()) refuse();
        const double count = *value++;
        if (!(count >= 0 && count <= static_cast<double>(row->values.end() - value))) refuse();
        const auto end = value + static_cast<std::ptrdiff_t>(count);
        fibre.restore({value, end});
        value = end;
    }
    if (value != row->values.end()) refuse();
    fibres_ = std::move(restored);
}

}  // namespace drillstrand
