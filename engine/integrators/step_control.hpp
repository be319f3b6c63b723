/// The Dormand-Prince 5(4) pair and its step control: engine/integrators/README.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace drillstrand {

/// Butcher tableau (paper table 1, with a41 = 44/45: each row sums to its c). The last stage is the
/// first one of the next step.
struct DormandPrinceTableau {
    static constexpr std::size_t stages = 7;
    static constexpr std::array<double, stages> c = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
    static constexpr std::array<std::array<double, stages>, stages> a = {{
        {},
        {1. / 5},
        {3. / 40, 9. / 40},
        {44. / 45, -56. / 15, 32. / 9},
        {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
        {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
        {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84},
    }};
    /// Weights of the fifth-order solution, which is carried on.
    static constexpr std::array<double, stages> b = {
        35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84, 0};
    /// Weights of the fourth-order solution, for the error estimate.
    static constexpr std::array<double, stages> b_star = {
        5179. / 57600, 0, 7571. / 16695, 393. / 640, -92097. / 339200, 187. / 2100, 1. / 40};

    /// b - b*.
    static constexpr std::array<double, stages> error_weights() {
        std::array<double, stages> e{};
        for (std::size_t i = 0; i < stages; ++i)
            e[i] = b[i] - b_star[i];
        return e;
    }
};

struct Tolerances {
    double absolute = 1e-7;
    double relative = 1e-5;
};

/// Contribution of one entry to the sum of squares of the error norm. `error` is dt times the sum
/// of (b - b*) K (the paper's print lacks dt).
constexpr double scaled_error_squared(double error, double value, const Tolerances& tolerances) {
    const double magnitude = value < 0 ? -value : value;
    const double ratio = error / (tolerances.absolute + tolerances.relative * magnitude);
    return ratio * ratio;
}

/// Root mean square of the scaled errors of `count` entries; a step is accepted below 1.
inline double error_norm(double sum_of_squares, std::size_t count) {
    return std::sqrt(sum_of_squares / static_cast<double>(count));
}

/// Factor from one step size to the next: 0.9 e^(-1/5) between 0.01 and 1.5. Where the estimate is
/// not a number, the step is cut to the least.
inline double step_factor(double error) {
    constexpr double least = 0.01;
    constexpr double most = 1.5;
    if (!std::isfinite(error)) return least;
    if (error == 0.0) return most;
    return std::clamp(0.9 * std::pow(error, -0.2), least, most);
}

}  // namespace drillstrand
