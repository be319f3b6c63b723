/// A quantity prescribed in time: piecewise linear between points, constant outside them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace drillstrand {

/// Value is double or Eigen::Vector3d. A default-constructed schedule is zero at all times.
template <class Value>
class Schedule {
  public:
    Schedule() requires std::is_arithmetic_v<Value> : Schedule(Value(0)) {}
    Schedule() : Schedule(Value(Value::Zero())) {}

    /// The same value at all times. (Implicit: a number in a case file is a schedule.)
    Schedule(const Value& constant) : times_{0.0}, values_{constant} {}

    /// Points in strictly ascending time (s); at least one.
    Schedule(std::vector<double> times, std::vector<Value> values)
        : times_(std::move(times)), values_(std::move(values)) {}

    [[nodiscard]] const std::vector<double>& times() const { return times_; }
    [[nodiscard]] const std::vector<Value>& values() const { return values_; }

    [[nodiscard]] Value operator()(double time) const {
        if (time <= times_.front()) return values_.front();
        if (time >= times_.back()) return values_.back();
        const std::size_t k = interval(time);
        const double fraction = (time - times_[k]) / (times_[k + 1] - times_[k]);
        return Value(values_[k] + fraction * (values_[k + 1] - values_[k]));
    }

    /// Integral from time 0 to `time` (value x s), exact.
    [[nodiscard]] Value integral(double time) const {
        return Value(primitive(time) - primitive(0.0));
    }

  private:
    [[nodiscard]] std::size_t interval(double time) const {
        return static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) -
                                        times_.begin()) -
               1;
    }

    /// Integral from the first point to `time`; negative span before it.
    [[nodiscard]] Value primitive(double time) const {
        if (time <= times_.front()) return Value((time - times_.front()) * values_.front());
        Value sum = Value(0.0 * values_.front());
        for (std::size_t k = 0; k + 1 < times_.size() && times_[k] < time; ++k) {
            const double end = std::min(time, times_[k + 1]);
            sum = Value(sum + 0.5 * (end - times_[k]) * (values_[k] + (*this)(end)));
        }
        if (time > times_.back()) sum = Value(sum + (time - times_.back()) * values_.back());
        return sum;
    }

    std::vector<double> times_;
    std::vector<Value> values_;
};

}  // namespace drillstrand
