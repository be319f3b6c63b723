#include "drillstrand/torque_drag.hpp"

#include <omp.h>

#include <algorithm>

#include "drillstrand/error.hpp"
#include "model/survey.hpp"
#include "statics/in_parallel.hpp"
#include "statics/lock_up.hpp"
#include "statics/tripping.hpp"

namespace drillstrand {

namespace {

std::vector<TrippingAnswer> answers_at(const Case& input, double bit_depth) {
    const TrippedString string = string_at(input, bit_depth);
    Tripping tripping(string);
    std::vector<TrippingAnswer> answers;
    for (const TorqueDragMotion motion : input.torque_drag.motions)
        answers.push_back(tripping.answer(motion));
    return answers;
}

std::vector<double> depths_of(const Case& input) {
    if (!input.torque_drag.depths.empty()) return input.torque_drag.depths;
    constexpr int count = 20;
    const double length = total_length(input.string);
    std::vector<double> depths;
    for (int k = 1; k <= count; ++k)
        depths.push_back(input.well->survey.front().measured_depth + length * k / count);
    return depths;
}

void check(const Case& input) {
    const SourceLocation where{input.path.string()};
    if (!input.well)
        throw InputError(where,
                         "torque and drag need a well; add a table [well] with survey and "
                         "diameter");
    if (input.head.motion != HeadMotion::driven)
        throw InputError(where,
                         "head.motion is not \"driven\"; torque and drag need a head that clamps "
                         "the string");
    if (input.head.position && !input.head.position->isZero(0))
        throw InputError(where,
                         "head.position is not the start of the well, from where torque and drag "
                         "hang the string; leave it out");
    const Eigen::Vector3d down_hole = station_tangent(input.well->survey.front());
    constexpr double rounding = 1e-6;
    if (input.head.direction && (*input.head.direction - down_hole).norm() > rounding)
        throw InputError(where,
                         "head.direction is not that of the well at its start, along which torque "
                         "and drag hang the string; leave it out");
}

void append(TorqueDragCurve& curve, double bit_depth, TrippingAnswer answer) {
    curve.hook_load.push_back(answer.hook_load);
    curve.surface_torque.push_back(answer.surface_torque);
    curve.neutral_point.push_back(answer.neutral_point);
    curve.buckling.push_back(answer.buckling);
    curve.standpipe_pressure.push_back(answer.standpipe_pressure);
    curve.bit_pressure.push_back(answer.bit_pressure);
    curve.equivalent_density.push_back(answer.equivalent_density);
    curve.mud_force.push_back(answer.mud_force);
    curve.soft_hook_load.push_back(answer.soft.tension);
    curve.soft_surface_torque.push_back(answer.soft.torque);
    if (answer.failure) curve.failures.push_back({bit_depth, *answer.failure});
    curve.profile = std::move(answer.profile);
}

void find_limits(const Case& input, const std::vector<double>& bit_depth, TorqueDragCurve& curve) {
    curve.lock_up_depth = lock_up_depth(input, bit_depth, curve);
    if (curve.motion == TorqueDragMotion::sliding)
        curve.largest_weight = largest_weight(input, bit_depth.back());
}

}  // namespace

TorqueDrag compute_torque_drag(const Case& input, int threads) {
    check(input);
    TorqueDrag result;
    result.bit_depth = depths_of(input);
    const std::size_t count = result.bit_depth.size();
    std::vector<std::vector<TrippingAnswer>> answers(count);
    const int team = threads > 0 ? threads : omp_get_num_procs();
    for_each_in_parallel(count, team, [&](std::size_t i) {
        answers[i] = answers_at(input, result.bit_depth[i]);
        if (i + 1 == count) return;
        for (TrippingAnswer& answer : answers[i])
            answer.profile = {};
    });
    const TrippedString last = string_at(input, result.bit_depth.back());
    result.node_s = last.scene.mesh.node_s;
    result.segment_s = last.scene.mesh.segment_s;
    result.measured_depth = last.measured_depth;
    for (std::size_t m = 0; m < input.torque_drag.motions.size(); ++m) {
        TorqueDragCurve& curve = result.curves.emplace_back();
        curve.motion = input.torque_drag.motions[m];
        for (std::size_t i = 0; i < count; ++i)
            append(curve, result.bit_depth[i], std::move(answers[i][m]));
    }
    for_each_in_parallel(result.curves.size(), team, [&](std::size_t m) {
        find_limits(input, result.bit_depth, result.curves[m]);
    });
    return result;
}

}  // namespace drillstrand
