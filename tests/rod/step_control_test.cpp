#include "integrators/step_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace drillstrand {
namespace {

using Tableau = DormandPrinceTableau;
using Weights = std::array<double, Tableau::stages>;

// Sums of seven products of numbers of order ten.
constexpr double rounding = 1e-13;

Weights times(const Weights& x, const Weights& y) {
    Weights result{};
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = x[i] * y[i];
    return result;
}

Weights through_a(const Weights& x) {
    Weights result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
        for (std::size_t j = 0; j < result.size(); ++j)
            result[i] += Tableau::a[i][j] * x[j];
    }
    return result;
}

double sum(const Weights& b, const Weights& x) {
    double result = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        result += b[i] * x[i];
    return result;
}

/// Elementary weights minus the values they must have for each order, as in Hairer, Norsett,
/// Wanner, Solving Ordinary Differential Equations I, table II.2.1.
std::vector<double> defects(const Weights& b, int order) {
    const Weights& c = Tableau::c;
    Weights one{};
    one.fill(1);
    const Weights c2 = times(c, c);
    const Weights c3 = times(c2, c);
    const Weights ac = through_a(c);
    const Weights ac2 = through_a(c2);
    std::vector<double> result;
    if (order == 1) result = {sum(b, one) - 1};
    if (order == 2) result = {sum(b, c) - 1. / 2};
    if (order == 3) result = {sum(b, c2) - 1. / 3, sum(b, ac) - 1. / 6};
    if (order == 4) {
        result = {sum(b, c3) - 1. / 4, sum(b, times(c, ac)) - 1. / 8, sum(b, ac2) - 1. / 12,
                  sum(b, through_a(ac)) - 1. / 24};
    }
    if (order == 5) {
        result = {sum(b, times(c2, c2)) - 1. / 5,
                  sum(b, times(c2, ac)) - 1. / 10,
                  sum(b, times(ac, ac)) - 1. / 20,
                  sum(b, times(c, ac2)) - 1. / 15,
                  sum(b, through_a(c3)) - 1. / 20,
                  sum(b, times(c, through_a(ac))) - 1. / 30,
                  sum(b, through_a(times(c, ac))) - 1. / 40,
                  sum(b, through_a(ac2)) - 1. / 60,
                  sum(b, through_a(through_a(ac))) - 1. / 120};
    }
    return result;
}

TEST(DormandPrince, EachStageStandsAtTheTimeItsRowSumsTo) {
    for (std::size_t i = 0; i < Tableau::stages; ++i) {
        double row = 0;
        for (const double a : Tableau::a[i])
            row += a;
        EXPECT_NEAR(row, Tableau::c[i], rounding);
    }
}

TEST(DormandPrince, LastStageIsTheSolutionOfTheStep) {
    EXPECT_EQ(Tableau::a.back(), Tableau::b);
}

TEST(DormandPrince, SolutionMeetsAllConditionsOfOrderFiveAndTheEstimateThoseOfOrderFour) {
    for (int order = 1; order <= 5; ++order) {
        for (const double defect : defects(Tableau::b, order))
            EXPECT_NEAR(defect, 0, rounding) << "order " << order;
    }
    for (int order = 1; order <= 4; ++order) {
        for (const double defect : defects(Tableau::b_star, order))
            EXPECT_NEAR(defect, 0, rounding) << "order " << order;
    }
    // the estimate must differ at order 5, or it would see no error
    double largest = 0;
    for (const double defect : defects(Tableau::b_star, 5))
        largest = std::max(largest, std::abs(defect));
    EXPECT_GT(largest, 1e-4);
}

/// y' = y cos t, y(0) = 1, whose solution is exp(sin t).
double slope(double t, double y) {
    return y * std::cos(t);
}
double solution(double t) {
    return std::exp(std::sin(t));
}

struct Step {
    double value;
    double error;  ///< estimate
};

Step one_step(double t, double y, double dt) {
    Weights k{};
    double stage = y;
    for (std::size_t i = 0; i < Tableau::stages; ++i) {
        stage = y;
        for (std::size_t j = 0; j < i; ++j)
            stage += dt * Tableau::a[i][j] * k[j];
        k[i] = slope(t + Tableau::c[i] * dt, stage);
    }
    return {stage, dt * sum(Tableau::error_weights(), k)};
}

double error_with_steps(int steps) {
    const double dt = 2.0 / steps;
    double y = 1;
    for (int i = 0; i < steps; ++i)
        y = one_step(i * dt, y, dt).value;
    return std::abs(y - solution(2.0));
}

TEST(DormandPrince, ConvergesAtOrderFiveOnAScalarEquation) {
    for (const int steps : {20, 40, 80}) {
        const double order = std::log2(error_with_steps(steps) / error_with_steps(2 * steps));
        EXPECT_NEAR(order, 5, 0.4) << steps << " steps";
    }
}

TEST(DormandPrince, ErrorEstimateOfOneStepShrinksWithItsFifthPower) {
    // dt stands in front of the sum of (b - b*) K: without it the power would be four
    const double ratio =
        one_step(0.5, solution(0.5), 0.02).error / one_step(0.5, solution(0.5), 0.01).error;
    EXPECT_NEAR(std::log2(std::abs(ratio)), 5, 0.1);
}

TEST(StepControl, NormIsTheRootMeanSquareOfErrorsInUnitsOfTheTolerance) {
    const Tolerances tolerances{1e-7, 1e-5};
    // values 0, 1 and -100: tolerances 1e-7, 1.01e-5 and 1.0001e-3
    const double sum_of_squares = scaled_error_squared(3e-7, 0, tolerances) +
                                  scaled_error_squared(-1.01e-5, 1, tolerances) +
                                  scaled_error_squared(2.0002e-3, -100, tolerances);
    EXPECT_NEAR(sum_of_squares, 9 + 1 + 4, 1e-12);
    EXPECT_NEAR(error_norm(sum_of_squares, 3), std::sqrt(14. / 3), 1e-12);
}

TEST(StepControl, NextStepWouldHaveNineTenthsOfTheAllowedErrorToThePowerOfAFifth) {
    EXPECT_NEAR(step_factor(1.0), 0.9, 1e-15);
    EXPECT_NEAR(step_factor(32.0), 0.45, 1e-15);
    EXPECT_NEAR(step_factor(std::pow(0.75, 5)), 1.2, 1e-15);
}

TEST(StepControl, StepNeverGrowsByMoreThanAHalfNorShrinksBelowAHundredth) {
    EXPECT_EQ(step_factor(0.0), 1.5);
    EXPECT_EQ(step_factor(1e-30), 1.5);
    EXPECT_EQ(step_factor(1e30), 0.01);
    EXPECT_EQ(step_factor(std::numeric_limits<double>::infinity()), 0.01);
    EXPECT_EQ(step_factor(std::numeric_limits<double>::quiet_NaN()), 0.01);
}

/// Error at the end of y' = y cos t with adaptive steps, and how many steps were taken.
struct AdaptiveRun {
    double error;
    int steps;
};

AdaptiveRun adaptive(double tolerance) {
    const Tolerances tolerances{tolerance, tolerance};
    double t = 0;
    double y = 1;
    double dt = 0.1;
    int steps = 0;
    while (t < 10) {
        const double step = std::min(dt, 10 - t);
        const Step result = one_step(t, y, step);
        const double error =
            error_norm(scaled_error_squared(result.error, result.value, tolerances), 1);
        dt = step * step_factor(error);
        if (error >= 1) continue;
        t += step;
        y = result.value;
        ++steps;
    }
    return {std::abs(y - solution(10)), steps};
}

TEST(StepControl, ToleranceSetsTheErrorAndTheNumberOfSteps) {
    const AdaptiveRun coarse = adaptive(1e-6);
    const AdaptiveRun fine = adaptive(1e-11);
    EXPECT_LT(coarse.error, 1e-5);
    EXPECT_LT(fine.error, 1e-10);
    // five decades at order five: ten times the steps
    EXPECT_NEAR(static_cast<double>(fine.steps) / coarse.steps, 10, 1.5);
}

}  // namespace
}  // namespace drillstrand
