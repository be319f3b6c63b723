/// Parts of schedules of vectors in the axes (d3, d1, d2).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

#include "drillstrand/schedule.hpp"

namespace drillstrand {

/// The schedule of a function that is linear in the values.
template <class Result, class Value, class Function>
Schedule<Result> mapped(const Schedule<Value>& schedule, const Function& function) {
    std::vector<Result> values;
    values.reserve(schedule.values().size());
    for (const Value& value : schedule.values())
        values.push_back(function(value));
    return {schedule.times(), std::move(values)};
}

/// The part about or along d3.
inline Schedule<double> part_of_d3(const Schedule<Eigen::Vector3d>& schedule) {
    return mapped<double>(schedule, [](const Eigen::Vector3d& value) { return value[0]; });
}

/// Whether there is no other part.
inline bool is_axial(const Schedule<Eigen::Vector3d>& schedule) {
    return std::all_of(schedule.values().begin(), schedule.values().end(),
                       [](const Eigen::Vector3d& value) { return value.tail<2>().isZero(0); });
}

}  // namespace drillstrand
