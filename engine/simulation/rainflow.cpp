#include "drillstrand/rainflow.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drillstrand {

namespace {

// what save() puts before the turns
constexpr std::size_t numbers = 6;

}  // namespace

void RainflowCounter::add(double value) {
    if (empty_) {
        empty_ = false;
        extreme_ = value;
        return;
    }
    if (way_ == 0) {
        if (std::abs(value - extreme_) <= resolution_) return;
        turn_at(extreme_);
        way_ = std::copysign(1.0, value - extreme_);
        extreme_ = value;
    } else if (way_ * (value - extreme_) > 0) {
        extreme_ = value;
    } else if (way_ * (extreme_ - value) > resolution_) {
        turn_at(extreme_);
        way_ = -way_;
        extreme_ = value;
    }
}

/// X is the range that ends at the turn, Y the one before it (ASTM E1049-85, 5.4.4).
void RainflowCounter::turn_at(double value) {
    turns_.push_back(value);
    while (turns_.size() >= 3) {
        const auto last = turns_.end() - 1;
        const double x = std::abs(last[0] - last[-1]);
        const double y = std::abs(last[-1] - last[-2]);
        if (x + resolution_ < y) break;
        if (turns_.size() == 3) {
            close(y, 0.5);
            turns_.erase(turns_.begin());
        } else {
            close(y, 1);
            // of turns that count as equal the farther one stays
            const double farther = x < y ? last[-2] : last[0];
            turns_.erase(last - 1, turns_.end());
            turns_.back() = farther;
        }
    }
}

void RainflowCounter::close(double range, double cycles) {
    closed_.cycles += cycles;
    closed_.damage += cycles * std::pow(range, slope_);
    closed_.largest = std::max(closed_.largest, range);
}

RainflowCounter::Sum RainflowCounter::total() const {
    RainflowCounter ended = *this;
    if (way_ != 0) ended.turn_at(extreme_);
    for (std::size_t i = 1; i < ended.turns_.size(); ++i)
        ended.close(std::abs(ended.turns_[i] - ended.turns_[i - 1]), 0.5);
    return ended.closed_;
}

CycleCount RainflowCounter::count() const {
    const Sum sum = total();
    if (sum.cycles == 0) return {};
    return {sum.cycles, sum.largest, std::pow(sum.damage / sum.cycles, 1 / slope_)};
}

double RainflowCounter::damage() const {
    return total().damage;
}

std::vector<double> RainflowCounter::save() const {
    std::vector<double> saved{closed_.cycles,     closed_.damage, closed_.largest,
                              empty_ ? 1.0 : 0.0, way_,           extreme_};
    saved.insert(saved.end(), turns_.begin(), turns_.end());
    return saved;
}

void RainflowCounter::restore(const std::vector<double>& saved) {
    if (saved.size() < numbers)
        throw std::invalid_argument("a saved rainflow count has less than its numbers");
    closed_ = {saved[0], saved[1], saved[2]};
    empty_ = saved[3] != 0;
    way_ = saved[4];
    extreme_ = saved[5];
    turns_.assign(saved.begin() + numbers, saved.end());
}

}  // namespace drillstrand
