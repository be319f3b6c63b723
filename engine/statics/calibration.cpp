#include "drillstrand/calibration.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "drillstrand/error.hpp"
#include "statics/in_parallel.hpp"
#include "statics/tripping.hpp"

namespace drillstrand {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TorqueDragMotion motion_of(MeasuredLoad load) {
    switch (load) {
        case MeasuredLoad::pick_up:
            return TorqueDragMotion::tripping_out;
        case MeasuredLoad::slack_off:
            return TorqueDragMotion::tripping_in;
        default:
            return TorqueDragMotion::rotating;
    }
}

/// Loads at the head: of the stiff string, or of the soft one.
struct HeadLoads {
    double hook_load = 0;
    double torque = 0;
};
enum class StringModel { stiff, soft };

/// Friction of the sections that the points tell, and the block's weight, as unknowns.
class Fit {
  public:
    Fit(const Case& input, const std::vector<MeasuredPoint>& points, int threads)
        : input_(input), points_(points), threads_(threads) {
        double deepest = 0;
        for (const MeasuredPoint& point : points)
            deepest = std::max(deepest, point.bit_depth);
        double start = input.well->survey.front().measured_depth;
        for (std::size_t k = 0; k < input.well->sections.size(); ++k) {
            if (start < deepest) sections_.push_back(k);
            start = input.well->sections[k].to;
        }
        for (const MeasuredPoint& point : points)
            if (point.load != MeasuredLoad::torque) weighs_ = true;
        leave_out_untold();
    }

    [[nodiscard]] Eigen::Index unknowns() const { return frictions() + (weighs_ ? 1 : 0); }
    [[nodiscard]] Eigen::Index frictions() const {
        return static_cast<Eigen::Index>(sections_.size());
    }
    /// Numbers of the sections whose friction is sought.
    [[nodiscard]] const std::vector<std::size_t>& sections() const { return sections_; }
    [[nodiscard]] bool weighs() const { return weighs_; }

    [[nodiscard]] VectorXd start() const {
        VectorXd unknown = VectorXd::Constant(unknowns(), usual_friction);
        if (weighs_) unknown[unknowns() - 1] = 0;
        return unknown;
    }

    /// What the points would be.
    [[nodiscard]] VectorXd predicted(const VectorXd& unknown, StringModel model) const {
        const Case guess = with_friction(unknown);
        std::map<double, std::vector<std::size_t>> at_depth;
        for (std::size_t i = 0; i < points_.size(); ++i)
            at_depth[points_[i].bit_depth].push_back(i);
        const std::vector<std::pair<double, std::vector<std::size_t>>> depths(at_depth.begin(),
                                                                              at_depth.end());
        VectorXd values(static_cast<Eigen::Index>(points_.size()));
        for_each_in_parallel(depths.size(), threads_, [&](std::size_t k) {
            const auto& [depth, which] = depths[k];
            const TrippedString string = string_at(guess, depth);
            Tripping tripping(string);
            std::map<TorqueDragMotion, HeadLoads> of_motion;
            for (const std::size_t i : which) {
                const TorqueDragMotion motion = motion_of(points_[i].load);
                if (!of_motion.contains(motion))
                    of_motion[motion] = loads_of(tripping, depth, motion, model);
                const HeadLoads& loads = of_motion[motion];
                const bool turns = points_[i].load == MeasuredLoad::torque;
                values[static_cast<Eigen::Index>(i)] =
                    turns ? loads.torque : loads.hook_load + block_weight(unknown);
            }
        });
        return values;
    }

    /// How the points follow the unknowns, by the soft string.
    [[nodiscard]] MatrixXd slopes(const VectorXd& unknown) const {
        constexpr double step = 1e-3;
        MatrixXd result = MatrixXd::Zero(static_cast<Eigen::Index>(points_.size()), unknowns());
        const VectorXd here = predicted(unknown, StringModel::soft);
        for (Eigen::Index j = 0; j < frictions(); ++j) {
            VectorXd more = unknown;
            more[j] += step;
            result.col(j) = (predicted(more, StringModel::soft) - here) / step;
        }
        if (weighs_)
            for (std::size_t i = 0; i < points_.size(); ++i)
                if (points_[i].load != MeasuredLoad::torque)
                    result(static_cast<Eigen::Index>(i), unknowns() - 1) = 1;
        return result;
    }

  private:
    static constexpr double usual_friction = 0.25;

    /// In a section where the string hardly touches, as in a vertical one, friction stays as the
    /// case has it: there a coefficient of 1 changes no reading by a thousandth.
    void leave_out_untold() {
        constexpr double least = 1e-3;
        const MatrixXd slopes_at_start = slopes(start());
        std::vector<std::size_t> told;
        for (std::size_t j = 0; j < sections_.size(); ++j)
            for (std::size_t i = 0; i < points_.size(); ++i)
                if (std::abs(slopes_at_start(static_cast<Eigen::Index>(i),
                                             static_cast<Eigen::Index>(j))) >
                    least * std::abs(points_[i].value)) {
                    told.push_back(sections_[j]);
                    break;
                }
        sections_ = told;
    }

    [[nodiscard]] double block_weight(const VectorXd& unknown) const {
        return weighs_ ? unknown[unknowns() - 1] : 0.0;
    }

    [[nodiscard]] Case with_friction(const VectorXd& unknown) const {
        Case guess = input_;
        guess.torque_drag.friction.reset();
        for (std::size_t k = 0; k < sections_.size(); ++k) {
            const double friction = unknown[static_cast<Eigen::Index>(k)];
            WellSectionCase& section = guess.well->sections[sections_[k]];
            section.static_friction = section.dynamic_friction = {friction, friction};
        }
        return guess;
    }

    static HeadLoads loads_of(Tripping& tripping, double bit_depth, TorqueDragMotion motion,
                              StringModel model) {
        if (model == StringModel::soft) {
            const SoftLoad head = tripping.soft_at_head(motion);
            return {head.tension, head.torque};
        }
        const TrippingAnswer answer = tripping.answer(motion);
        if (answer.failure)
            throw SimulationError(
                fmt::format("no equilibrium of the string with its bit at {:.6g} m: {}", bit_depth,
                            *answer.failure));
        return {answer.hook_load, answer.surface_torque};
    }

    const Case& input_;
    const std::vector<MeasuredPoint>& points_;
    int threads_;
    std::vector<std::size_t> sections_;
    bool weighs_ = false;
};

/// Root of the mean square of what is left of the points of one kind.
double scatter(const std::vector<MeasuredPoint>& points, const VectorXd& left, bool torque) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if ((points[i].load == MeasuredLoad::torque) != torque) continue;
        sum += std::pow(left[static_cast<Eigen::Index>(i)], 2);
        ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : 0;
}

/// Weights of the points: one over the scatter of their kind, hook loads or torques, which the fit
/// finds as it goes on; at first a fiftieth of their size.
VectorXd weights(const std::vector<MeasuredPoint>& points, const VectorXd& left,
                 const VectorXd& measured, int round) {
    const VectorXd sized = 0.02 * measured;
    const auto of = [&](bool torque) {
        const double size = scatter(points, sized, torque);
        const double found = scatter(points, left, torque);
        constexpr double exact = 1e-4;  // data without noise do not outweigh the others
        return 1 / std::max({round == 0 ? size : found, exact * size, 1e-9});
    };
    const double hook = of(false);
    const double torque = of(true);
    VectorXd result(measured.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        result[static_cast<Eigen::Index>(i)] =
            points[i].load == MeasuredLoad::torque ? torque : hook;
    return result;
}

void check(const Case& input, const std::vector<MeasuredPoint>& points) {
    if (!input.well)
        throw InputError({input.path.string()},
                         "calibration needs a well; add a table [well] with survey and diameter");
    const double start = input.well->survey.front().measured_depth;
    const double end = input.well->survey.back().measured_depth;
    for (const MeasuredPoint& point : points)
        if (!(point.bit_depth > start && point.bit_depth <= end * (1 + 1e-9)))
            throw InputError({input.path.string()},
                             fmt::format("a point at {:.6g} m lies outside of the surveyed well, "
                                         "{:.6g} to {:.6g} m",
                                         point.bit_depth, start, end));
}

std::string section_name(const WellSectionCase& section) {
    return section.name.empty() ? fmt::format("to {:.6g} m", section.to) : section.name;
}

}  // namespace

Calibration calibrate(const Case& input, const std::vector<MeasuredPoint>& points, int threads) {
    check(input, points);
    const Fit fit(input, points, threads > 0 ? threads : omp_get_num_procs());
    const auto count = static_cast<Eigen::Index>(points.size());
    constexpr const char* untold =
        "the points do not tell friction and block weight apart; expected pick_up and slack_off, "
        "or "
        "torque, at depths in each section";
    if (fit.frictions() == 0) throw InputError({input.path.string()}, untold);
    if (count < fit.unknowns())
        throw InputError({input.path.string()},
                         fmt::format("{} points do not tell {} numbers apart; expected more points",
                                     count, fit.unknowns()));
    VectorXd measured(count);
    for (Eigen::Index i = 0; i < count; ++i)
        measured[i] = points[static_cast<std::size_t>(i)].value;

    Calibration result;
    VectorXd unknown = fit.start();
    VectorXd left = measured - fit.predicted(unknown, StringModel::stiff);
    MatrixXd weighted;
    VectorXd weight;
    constexpr int most_rounds = 20;
    constexpr double close = 1e-5;  // of a friction coefficient
    const Eigen::Index frictions = fit.frictions();
    for (double change = 1; change > close && result.rounds < most_rounds; ++result.rounds) {
        weight = weights(points, left, measured, result.rounds);
        weighted = weight.asDiagonal() * fit.slopes(unknown);
        const Eigen::ColPivHouseholderQR<MatrixXd> solver(weighted);
        if (solver.rank() < fit.unknowns()) throw InputError({input.path.string()}, untold);
        VectorXd next = unknown + solver.solve(VectorXd(weight.asDiagonal() * left));
        next.head(frictions) = next.head(frictions).cwiseMax(0).cwiseMin(2);
        change = (next - unknown).head(frictions).cwiseAbs().maxCoeff();
        unknown = next;
        left = measured - fit.predicted(unknown, StringModel::stiff);
    }

    const double spare = std::max<double>(1, static_cast<double>(count - fit.unknowns()));
    const double variance = (weight.asDiagonal() * left).squaredNorm() / spare;
    const MatrixXd covariance = variance * (weighted.transpose() * weighted).inverse();
    const auto fitted = [&](Eigen::Index j, std::string name) {
        return FittedNumber{std::move(name), unknown[j], std::sqrt(covariance(j, j))};
    };
    for (Eigen::Index j = 0; j < frictions; ++j)
        result.friction.push_back(fitted(
            j, section_name(input.well->sections[fit.sections()[static_cast<std::size_t>(j)]])));
    if (fit.weighs()) result.block_weight = fitted(frictions, "block");
    const VectorXd values = measured - left;
    result.fitted.assign(values.begin(), values.end());
    result.hook_load_scatter = scatter(points, left, false);
    result.torque_scatter = scatter(points, left, true);
    return result;
}

}  // namespace drillstrand
