#include "statics/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Corrections below this (of a span, or rad) leave an error of rounding after one more step.
constexpr double settled = 1e-6;
constexpr double least_bed = 1e-3;
constexpr double most_bed = 1e12;
// Energies that differ by less than this part of the sum of their parts differ by rounding.
constexpr double rounding = 1e-12;

double dot(const NodeMotion& a, const NodeMotion& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += a[k].dot(b[k]);
    return sum;
}

/// Work of the loads without a potential over a step, by the mean of both ends.
double loose_work(const Imbalance& before, const Imbalance& after, const NodeMotion& motion,
                  double scale) {
    return 0.5 * scale * (dot(before.loose, motion) + dot(after.loose, motion));
}

}  // namespace

Newton::Newton(const Scene& scene, Balance& balance, int budget)
    : scene_(scene),
      balance_(balance),
      budget_(budget),
      rule_(scene.well ? StepRule::nodes : StepRule::strains),
      stiffness_(scene.mesh.length.size()) {
    const std::size_t segments = scene.mesh.length.size();
    const double whole = scene.mesh.node_s.back();
    std::size_t arc = 0;
    for (std::size_t node = 1; node <= segments; ++node) {
        const double cell = scene.mesh.cell[node];
        if (!scene.well) {
            const double bending = scene.mesh.segment[node - 1].bending_stiffness;
            bed_.emplace_back(cell * bending / std::pow(whole, 4) * Matrix3d::Identity());
            across_.emplace_back(Matrix3d::Zero());
            span_.push_back(scene.mesh.length[node - 1]);
            continue;
        }
        const Vector3d& x = scene.initial_nodes.position[node];
        arc = scene.well->find_arc(x, arc);
        const WellCrossSection section = scene.well->project(x, arc);
        const double clearance = section.radius - scene.mesh.node[node].outer_radius;
        const double firmness =
            std::max(std::abs(scene.weight[node]) / clearance, 1e-4 * scene.normal_stiffness[node]);
        across_.emplace_back(Matrix3d::Identity() -
                             section.direction * section.direction.transpose());
        bed_.emplace_back(cell * firmness * across_.back());
        span_.push_back(clearance);
    }
}

SearchOutcome Newton::descend(RodState& state, double bed) {
    Imbalance now = balance_.imbalance(state);
    balance_.stiffness(state, stiffness_);
    bool firm_alone = true;  // as far as is known at this state
    while (!is_spent()) {
        ++iterations_;
        const BlockFactors factors = factors_on_bed(bed);
        if (!factors.is_positive_definite()) {
            if (bed == 0) firm_alone = false;
            bed = std::max(8 * bed, least_bed);
            if (bed > most_bed) return SearchOutcome::failed;
            continue;
        }
        const NodeMotion motion = factors.solve(now.force);
        const double far = reach(motion);
        if (!std::isfinite(far)) return SearchOutcome::failed;
        constexpr double too_far = 4;
        if (scene_.well && far > too_far && bed < most_bed) {
            bed = std::max(bed, least_bed) * std::min(far, 10.0);
            continue;
        }
        const double scale = std::min(1.0, 1 / far);
        const Work done = work(now.force, motion, bed);
        const double predicted = scale * done.force - 0.5 * scale * scale * (done.force - done.bed);
        RodState trial = stepped(state, motion, scale);
        Imbalance then = balance_.imbalance(trial);
        const double gain = now.energy - then.energy + loose_work(now, then, motion, scale);
        const bool in_rounding = predicted < rounding * now.energy_sum;
        if (!in_rounding && !(gain > 0.1 * predicted)) {
            bed = std::max(4 * bed, least_bed);
            if (bed > most_bed) return SearchOutcome::failed;
            continue;
        }
        const bool small = scale == 1 && size(motion) < settled;
        if (small && bed > 0 && !firm_alone) return SearchOutcome::saddle;
        state = std::move(trial);
        now = std::move(then);
        balance_.stiffness(state, stiffness_);
        firm_alone = true;
        if (small && bed == 0) {
            // the last correction, to rounding
            ++iterations_;
            state = stepped(state, factors_on_bed(0).solve(now.force), 1);
            return SearchOutcome::converged;
        }
        if (small || (scale == 1 && (in_rounding || gain > 0.5 * predicted)))
            bed = small || bed < 10 * least_bed ? 0 : 0.1 * bed;
    }
    return SearchOutcome::failed;
}

SearchOutcome Newton::follow(RodState& state) {
    constexpr int most = 60;
    constexpr double least_scale = 1.0 / 256;
    RodState at = state;
    Imbalance now = balance_.imbalance(at);
    for (int i = 0; i < most && !is_spent(); ++i) {
        ++iterations_;
        const BlockFactors factors = this->factors(at);
        const NodeMotion motion = factors.solve(now.force);
        const double far = reach(motion);
        if (!std::isfinite(far)) return SearchOutcome::failed;
        const double full = size(motion);
        double scale = std::min(1.0, 1 / far);
        RodState trial = stepped(at, motion, scale);
        Imbalance then = balance_.imbalance(trial);
        while (full > settled && !(size(factors.solve(then.force)) <= (1 - 0.25 * scale) * full)) {
            scale *= 0.5;
            if (scale < least_scale) return SearchOutcome::failed;
            trial = stepped(at, motion, scale);
            then = balance_.imbalance(trial);
        }
        at = std::move(trial);
        now = std::move(then);
        if (full > settled) continue;
        ++iterations_;
        state = stepped(at, this->factors(at).solve(now.force), 1);
        return SearchOutcome::converged;
    }
    return SearchOutcome::failed;
}

void Newton::leave_saddle(RodState& state) {
    balance_.stiffness(state, stiffness_);
    double bed = least_bed;
    while (bed < most_bed && !factors_on_bed(bed).is_positive_definite())
        bed *= 2;
    const BlockFactors factors = factors_on_bed(bed);
    // inverse iteration from a motion without symmetry
    NodeMotion mode(bed_.size(), Vector6::Zero());
    for (std::size_t k = 0; k < mode.size(); ++k) {
        const double s = static_cast<double>(k + 1) / static_cast<double>(mode.size());
        mode[k].head<3>() = span_[k] * Vector3d(s, 0.5 * s * s, 0.3 * s);
    }
    constexpr int rounds = 50;
    for (int i = 0; i < rounds; ++i) {
        NodeMotion pushed(mode.size(), Vector6::Zero());
        for (std::size_t k = 0; k < mode.size(); ++k)
            pushed[k].head<3>() = bed_[k] * mode[k].head<3>();
        mode = factors.solve(pushed);
        double largest = 0;
        for (std::size_t k = 0; k < mode.size(); ++k)
            largest = std::max(largest, mode[k].head<3>().norm() / span_[k]);
        for (Vector6& node : mode)
            node /= largest;
    }
    constexpr double push = 0.1;  // of the span
    state = stepped(state, mode, push);
}

BlockFactors Newton::factors(const RodState& state) {
    balance_.stiffness(state, stiffness_);
    return BlockFactors(stiffness_);
}

BlockFactors Newton::factors_on_bed(double bed) const {
    if (bed == 0) return BlockFactors(stiffness_);
    BlockTridiagonal held = stiffness_;
    for (std::size_t k = 0; k < bed_.size(); ++k)
        held.diagonal[k].topLeftCorner<3, 3>() += bed * bed_[k];
    return BlockFactors(held);
}

RodState Newton::stepped(const RodState& state, const NodeMotion& motion, double scale) const {
    return moved(state, scene_.mesh.length, motion, scale, rule_);
}

/// The largest part of a motion, in units of what one step may move: the clearance across the
/// well, and a turn of directors by 1 rad.
double Newton::reach(const NodeMotion& motion) const {
    double largest = 0;
    for (std::size_t k = 0; k < motion.size(); ++k) {
        const double shift = (across_[k] * motion[k].head<3>()).norm() / span_[k];
        const double turn = motion[k].tail<3>().norm();
        largest = std::max(largest, shift);
        if (!scene_.well) largest = std::max(largest, turn);
        if (!std::isfinite(shift + turn)) return std::numeric_limits<double>::infinity();
    }
    return largest;
}

double Newton::size(const NodeMotion& motion) const {
    double sum = 0;
    for (std::size_t k = 0; k < motion.size(); ++k)
        sum += motion[k].head<3>().squaredNorm() / (span_[k] * span_[k]) +
               motion[k].tail<3>().squaredNorm();
    return std::sqrt(sum / static_cast<double>(motion.size()));
}

Newton::Work Newton::work(const NodeMotion& force, const NodeMotion& motion, double bed) const {
    double held = 0;
    for (std::size_t k = 0; k < motion.size(); ++k) {
        const Vector3d shift = motion[k].head<3>();
        held += bed * shift.dot(bed_[k] * shift);
    }
    return {dot(force, motion), held};
}

}  // namespace drillstrand
