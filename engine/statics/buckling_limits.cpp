#include "statics/buckling_limits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drillstrand {

namespace {

/// The point between a and b where a function that is negative at a and positive at b is zero.
template <class Function>
double zero_between(double a, double b, const Function& function) {
    while (b - a > 1e-13 * b) {
        const double middle = 0.5 * (a + b);
        (function(middle) > 0 ? b : a) = middle;
    }
    return b;
}

/// The least F > 0 with F^2 = c |F kappa - w_perp|, c = factor^2 EI / r: the least root of
/// f(F) = F^4 / c^2 - |F kappa - w_perp|^2, which is negative at first, concave until its
/// inflection and convex from there. It has one root, but where it first rises to a top above 0.
double lying_limit(const LyingString& string, double factor) {
    const double c = factor * factor * string.bending_stiffness / string.clearance;
    const Eigen::Vector3d weight =
        string.weight * (string.down - string.down.dot(string.direction) * string.direction);
    const double curvature = string.curvature.norm();
    const double push = string.curvature.dot(weight);
    const auto f = [&](double force) {
        return std::pow(force, 4) / (c * c) - (force * string.curvature - weight).squaredNorm();
    };
    const auto fall = [&](double force) {
        return 2 * curvature * curvature * force - 2 * push - 4 * std::pow(force, 3) / (c * c);
    };
    const double inflection = curvature * c / std::sqrt(6.0);
    if (fall(0) < 0 && fall(inflection) > 0) {
        const double top = zero_between(0, inflection, fall);
        if (f(top) > 0) return zero_between(0, top, f);
    }
    // beyond this F the left side exceeds the right one, whatever their directions
    const double bound = curvature * c + std::sqrt(c * weight.norm());
    return zero_between(0, bound, f);
}

/// In a vertical hole, where a lying string has no limit (N).
double hanging_limit(const LyingString& string, double factor) {
    return factor * std::cbrt(string.bending_stiffness * string.weight * string.weight);
}

}  // namespace

BucklingLimits buckling_limits(const LyingString& string) {
    return {std::max(lying_limit(string, 2.0), hanging_limit(string, 1.94)),
            std::max(lying_limit(string, 2 * std::numbers::sqrt2), hanging_limit(string, 5.55))};
}

}  // namespace drillstrand
