#include "statics/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forces/contact.hpp"

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Corrections below this (of a span, or rad) leave an error of rounding after one more step.
constexpr double settled = 1e-6;
constexpr double least_bed = 1e-3;
constexpr double most_bed = 1e12;

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

/// How many times stiffer the bed has to be after a step that was not taken.
double Newton::harder(const Downhill& step) {
    switch (step.verdict) {
        case Verdict::too_far:
            return std::min(step.far, 10.0);
        case Verdict::not_firm:
            return 8;
        default:
            return 4;
    }
}

Newton::Newton(const Scene& scene, Balance& balance, int budget)
    : scene_(scene),
      balance_(balance),
      budget_(budget),
      rule_(scene.well ? StepRule::nodes : StepRule::strains),
      first_(first_moving_node(scene)),
      stiffness_(scene.mesh.node.size() - first_) {
    std::size_t arc = 0;
    for (std::size_t node = first_; node < scene.mesh.node.size(); ++node) {
        const std::size_t segment = node > 0 ? node - 1 : 0;
        const double h = scene.mesh.length[segment];
        if (!scene.well) {
            const double bending = scene.mesh.segment[segment].bending_stiffness;
            across_.emplace_back(Matrix3d::Identity());
            firmness_.push_back(scene.mesh.cell[node] * bending /
                                std::pow(scene.mesh.node_s.back(), 4));
            span_.push_back(h);
        } else {
            const Vector3d& x = scene.initial_nodes.position[node];
            arc = scene.well->find_arc(x, arc);
            const WellCrossSection section = scene.well->project(x, arc);
            // a part as wide as its hole has no clearance to measure steps by
            const double clearance = std::max(section.radius - scene.mesh.node[node].outer_radius,
                                              0.01 * section.radius);
            across_.emplace_back(Matrix3d::Identity() -
                                 section.direction * section.direction.transpose());
            // Hertz's wall as where a pipe lies
            const double wall = secant_stiffness(scene.contact.normal_law,
                                                 scene.normal_stiffness[node], 0.01 * clearance);
            firmness_.push_back(scene.mesh.cell[node] *
                                std::max(std::abs(scene.weight[node]) / clearance, 1e-4 * wall));
            span_.push_back(clearance);
        }
        // a bed across the well would take the spin of a pinned head for tilt
        turning_.push_back(node > 0 ? h * h / 12 : 0.0);
    }
}

/// One step on the bed, judged by the energy; the stiffness is that of `state`. The bed holds the
/// string across the well alone, so that a step which is too long along it is cut: the arcs of a
/// limp string that is pulled are soft until they are flat.
Newton::Downhill Newton::downhill(const RodState& state, const Imbalance& now, double bed) const {
    constexpr double too_far = 4;
    constexpr double held = 0.01;
    constexpr double least_scale = 1e-6;
    Downhill step;
    const BlockFactors factors = factors_on_bed(bed);
    if (!factors.is_positive_definite()) return step;
    const NodeMotion motion = factors.solve(now.force);
    step.far = reach(motion);
    step.verdict = Verdict::too_far;
    if (!std::isfinite(step.far) || (scene_.well && step.far > too_far)) return step;

    const Work done = work(now.force, motion, bed);
    double scale = std::min(1.0, 1 / step.far);
    take(step, state, now, motion, done, scale);
    while (step.verdict == Verdict::uphill && step.far < held && scale > least_scale) {
        scale *= 0.25;
        take(step, state, now, motion, done, scale);
    }
    return step;
}

/// The part `scale` of a motion, which does work as `done` says.
void Newton::take(Downhill& step, const RodState& state, const Imbalance& now,
                  const NodeMotion& motion, const Work& done, double scale) const {
    const double predicted = scale * done.force - 0.5 * scale * scale * (done.force - done.bed);
    step.state = stepped(state, motion, scale);
    step.imbalance = balance_.imbalance(*step.state);
    const double gain =
        now.energy - step.imbalance.energy + loose_work(now, step.imbalance, motion, scale);
    const bool in_rounding = predicted < now.least_energy_change();
    step.verdict = in_rounding || gain > 0.1 * predicted ? Verdict::taken : Verdict::uphill;
    if (scale == 1) step.size = size(motion);
    step.is_small = step.size < settled;
    step.is_as_predicted = scale == 1 && (in_rounding || gain > 0.5 * predicted);
}

SearchOutcome Newton::descend(RodState& state, double bed) {
    Imbalance now = balance_.imbalance(state);
    balance_.stiffness(state, stiffness_);
    bool firm_alone = true;  // without the bed, as far as is known at this state
    double last = std::numeric_limits<double>::infinity();  // correction without the bed
    while (!is_spent() && bed < most_bed) {
        ++iterations_;
        Downhill step = downhill(state, now, bed);
        if (step.verdict != Verdict::taken) {
            if (step.verdict == Verdict::not_firm && bed == 0) firm_alone = false;
            bed = bed > 0 ? bed * harder(step) : least_bed;
            continue;
        }
        if (step.is_small && bed > 0 && !firm_alone) return SearchOutcome::saddle;
        if (bed == 0 && step.size > 0.5 * last && now.is_rounding())
            return SearchOutcome::converged;
        last = bed == 0 ? step.size : std::numeric_limits<double>::infinity();
        state = std::move(*step.state);
        now = std::move(step.imbalance);
        balance_.stiffness(state, stiffness_);
        firm_alone = true;
        if (step.is_small && bed == 0) {
            ++iterations_;
            state = stepped(state, BlockFactors(stiffness_).solve(now.force), 1);
            return SearchOutcome::converged;
        }
        if (step.is_small || (step.is_as_predicted && bed < 10 * least_bed))
            bed = 0;
        else if (step.is_as_predicted)
            bed *= 0.1;
    }
    return SearchOutcome::failed;
}

/// A Newton step cut until the next correction by the same factors is shorter; none where it never
/// is, or where there is no step.
std::optional<Newton::Correction> Newton::corrected(const RodState& state, const Imbalance& now) {
    constexpr double least_scale = 1.0 / 256;
    const BlockFactors factors = this->factors(state);
    const NodeMotion motion = factors.solve(now.force);
    const double far = reach(motion);
    if (!std::isfinite(far)) return std::nullopt;
    const double full = size(motion);
    for (double scale = std::min(1.0, 1 / far); scale >= least_scale; scale *= 0.5) {
        RodState trial = stepped(state, motion, scale);
        Imbalance then = balance_.imbalance(trial);
        const bool is_shorter = size(factors.solve(then.force)) <= (1 - 0.25 * scale) * full;
        if (is_shorter || full <= settled)
            return Correction{std::move(trial), std::move(then), full <= settled};
    }
    return std::nullopt;
}

SearchOutcome Newton::follow(RodState& state) {
    constexpr int most = 60;
    RodState at = state;
    Imbalance now = balance_.imbalance(at);
    for (int i = 0; i < most && !is_spent(); ++i) {
        ++iterations_;
        std::optional<Correction> next = corrected(at, now);
        if (!next && !now.is_rounding()) return SearchOutcome::failed;
        if (!next) {
            state = std::move(at);
            return SearchOutcome::converged;
        }
        at = std::move(next->state);
        now = std::move(next->imbalance);
        if (!next->is_small) continue;
        ++iterations_;
        state = stepped(at, factors(at).solve(now.force), 1);
        return SearchOutcome::converged;
    }
    return SearchOutcome::failed;
}

void Newton::leave_saddle(RodState& state) {
    constexpr double push = 0.1;  // of the span
    state = stepped(state, softest_motion(state), push);
}

/// By inverse iteration from a motion without symmetry; the largest displacement is one span.
NodeMotion Newton::softest_motion(const RodState& state) {
    balance_.stiffness(state, stiffness_);
    double bed = least_bed;
    while (bed < most_bed && !factors_on_bed(bed).is_positive_definite())
        bed *= 2;
    const BlockFactors factors = factors_on_bed(bed);
    NodeMotion mode(across_.size(), Vector6::Zero());
    for (std::size_t k = 0; k < mode.size(); ++k) {
        const double s = static_cast<double>(k + 1) / static_cast<double>(mode.size());
        mode[k].head<3>() = span_[k] * Vector3d(s, 0.5 * s * s, 0.3 * s);
    }
    constexpr int rounds = 50;
    for (int i = 0; i < rounds; ++i) {
        NodeMotion pushed(mode.size(), Vector6::Zero());
        for (std::size_t k = 0; k < mode.size(); ++k)
            pushed[k].head<3>() = firmness_[k] * (across_[k] * mode[k].head<3>());
        mode = factors.solve(pushed);
        double largest = 0;
        for (std::size_t k = 0; k < mode.size(); ++k)
            largest = std::max(largest, mode[k].head<3>().norm() / span_[k]);
        for (Vector6& node : mode)
            node /= largest;
    }
    return mode;
}

BlockFactors Newton::factors(const RodState& state) {
    balance_.stiffness(state, stiffness_);
    return BlockFactors(stiffness_);
}

BlockFactors Newton::factors_on_bed(double bed) const {
    if (bed == 0) return BlockFactors(stiffness_);
    BlockTridiagonal held = stiffness_;
    for (std::size_t k = 0; k < across_.size(); ++k) {
        const Matrix3d springs = bed * firmness_[k] * across_[k];
        held.diagonal[k].topLeftCorner<3, 3>() += springs;
        held.diagonal[k].bottomRightCorner<3, 3>() += turning_[k] * springs;
    }
    return BlockFactors(held);
}

RodState Newton::stepped(const RodState& state, const NodeMotion& motion, double scale) const {
    return moved(state, scene_.mesh.length, motion, scale, rule_);
}

/// The largest part of a motion, in units of what one step may move: the clearance across the
/// well and a turn of directors across it; without a well a turn by 1 rad.
double Newton::reach(const NodeMotion& motion) const {
    constexpr double most_turn = 0.3;  // rad
    double largest = 0;
    for (std::size_t k = 0; k < motion.size(); ++k) {
        const double shift = (across_[k] * motion[k].head<3>()).norm() / span_[k];
        const double turn = (across_[k] * motion[k].tail<3>()).norm();
        largest = std::max(largest, scene_.well ? std::max(shift, turn / most_turn) : turn);
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
        const Vector3d shift = across_[k] * motion[k].head<3>();
        const Vector3d turn = across_[k] * motion[k].tail<3>();
        held += bed * firmness_[k] * (shift.squaredNorm() + turning_[k] * turn.squaredNorm());
    }
    return {dot(force, motion), held};
}

}  // namespace drillstrand
