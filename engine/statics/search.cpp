#include "statics/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "drillstrand/error.hpp"
#include "forces/contact.hpp"

namespace drillstrand {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

LoadCase full_loads(const Scene& scene, const EquilibriumOptions& options) {
    LoadCase loads;
    loads.mud = mud_motion(scene, options.trip_speed);
    loads.motion = options.motion;
    loads.friction = options.motion.is_rest() ? 0.0 : 1.0;
    loads.bit = {options.load_time, options.motion.rotation_rate, options.bit_loads ? 1.0 : 0.0};
    return loads;
}

}  // namespace

EquilibriumSearch::EquilibriumSearch(const Scene& scene, const EquilibriumOptions& options)
    : scene_(scene),
      options_(options),
      full_(full_loads(scene, options)),
      conservative_(bit_is_conservative(Bit(scene), full_.bit)),
      balance_(scene, full_),
      newton_(scene, balance_, options.max_iterations),
      state_(options.start.value_or(scene.initial_nodes), scene.head_frame.col(1),
             scene.mesh.length) {}

void EquilibriumSearch::run() {
    if (scene_.well)
        settle_in_well();
    else
        settle_free();
    refuse_folded_segments();
}

/// A segment that bears more than a half wave of its own is no beam-column any more.
void EquilibriumSearch::refuse_folded_segments() const {
    constexpr double half_wave = std::numbers::pi * std::numbers::pi;
    for (std::size_t k = 0; k < state_.twist.size(); ++k) {
        const RodSegment segment = balance_.segment(state_, k);
        const double load = segment_load(segment);
        if (load > -half_wave) continue;
        const double unit = segment.section->bending_stiffness / (segment.length * segment.length);
        throw SimulationError(
            fmt::format("a segment of {:.3g} m, {:.1f} m along the string, carries a compression "
                        "of {:.3g} N, but {:.3g} N buckle it between its nodes; use a finer mesh",
                        segment.length, scene_.mesh.segment_s[k], -load * unit, half_wave * unit));
    }
}

LoadCase EquilibriumSearch::loads_at(Stage stage, double factor) const {
    LoadCase loads = full_;
    const double bit = full_.bit.factor;
    loads.weight = stage == Stage::weight ? factor : 1.0;
    loads.bit.factor = stage == Stage::weight ? 0.0 : stage == Stage::bit ? factor * bit : bit;
    loads.friction = stage == Stage::friction ? factor * full_.friction : 0.0;
    return loads;
}

/// In a well: downhill from the start without friction, then friction.
void EquilibriumSearch::settle_in_well() {
    const bool moving = full_.friction > 0;
    if (moving && options_.start && settle_moving_at_once()) return;
    settle_at_rest();
    if (moving) settle_moving();
}

/// Stiffnesses on the way to the walls' own (k_el or K), from one into which the weight sinks by a
/// tenth of the clearance. Contacts that come and go change little where the wall is soft. None is
/// so soft that a string which weighs next to nothing leaves the well by its own stiffness.
std::vector<double> EquilibriumSearch::wall_stiffnesses() const {
    const double stiff =
        scene_.well->largest_firmness() *
        *std::max_element(scene_.normal_stiffness.begin(), scene_.normal_stiffness.end());
    double soft = 1e-4 * stiff;
    for (std::size_t k = 1; k < scene_.weight.size(); ++k) {
        const double tenth = 0.1 * newton_.clearance(k);
        const double per_stiffness = secant_stiffness(scene_.contact.normal_law, 1, tenth);
        soft =
            std::max(soft, 10 * std::abs(scene_.weight[k]) / newton_.clearance(k) / per_stiffness);
    }
    constexpr double ratio = 10;
    std::vector<double> stiffnesses;
    for (double k = soft; k < stiff / 2; k *= ratio)
        stiffnesses.push_back(k);
    stiffnesses.push_back(infinity);
    return stiffnesses;
}

void EquilibriumSearch::settle_at_rest() {
    LoadCase loads = loads_at(Stage::bit, 1);
    const bool warm = options_.start.has_value();
    const std::vector<double> walls = warm ? std::vector{infinity} : wall_stiffnesses();
    double bed = warm ? 0 : 1;
    for (const double wall : walls) {
        loads.stiffest_wall = wall;
        balance_.set_loads(loads);
        const SearchOutcome outcome = newton_.descend(state_, bed);
        if (outcome == SearchOutcome::failed) fail();
        bed = 0;
        if (wall < infinity || outcome == SearchOutcome::converged) continue;
        look_for_buckling();
        fall_to_stable();
    }
}

/// All loads and friction at once; false, and nothing changed, where that finds nothing.
bool EquilibriumSearch::settle_moving_at_once() {
    balance_.set_loads(full_);
    return newton_.follow(state_) == SearchOutcome::converged;
}

/// Friction from a state without. Where Newton's method does not find it at once, friction is held
/// at what the state has, which leaves a problem with an energy, and held anew at its solution.
void EquilibriumSearch::settle_moving() {
    constexpr int rounds = 40;
    for (int i = 0; i < rounds; ++i) {
        if (settle_moving_at_once()) return;
        balance_.hold_friction(state_);
        const SearchOutcome outcome = newton_.descend(state_, 0);
        balance_.free_friction();
        if (outcome != SearchOutcome::converged) break;
    }
    fail();
}

/// Without a well: the weight, then the load at the bit.
void EquilibriumSearch::settle_free() {
    const bool warm = options_.start.has_value();
    balance_.set_loads(full_);
    if (!warm || newton_.follow(state_) != SearchOutcome::converged) {
        put_on(Stage::weight);
        put_on(Stage::bit);
    }
    stable_ = is_sound(newton_.factors(state_));
    if (stable_ || !conservative_) return;
    fall_to_stable();
}

/// Raises the loads of a stage in steps as large as Newton's method takes.
void EquilibriumSearch::put_on(Stage stage) {
    constexpr double least_step = 1e-4;
    double factor = 0;
    double step = 1;
    bool sound = true;
    while (factor < 1) {
        const double next = std::min(1.0, factor + step);
        balance_.set_loads(loads_at(stage, next));
        if (newton_.follow(state_) != SearchOutcome::converged) {
            step *= 0.5;
            if (step < least_step) fail();
            continue;
        }
        if (stage != Stage::friction) {
            const bool was_sound = sound;
            sound = is_sound(newton_.factors(state_));
            if (was_sound && !sound) report_buckling(stage, state_, factor, next);
            balance_.set_loads(loads_at(stage, next));
        }
        factor = next;
        step *= 2;
    }
}

/// Whether the stiffness is that of a string which has not buckled: positive definite, or, with
/// loads that have no potential, of positive determinant.
bool EquilibriumSearch::is_sound(const BlockFactors& factors) const {
    return conservative_ ? factors.is_positive_definite() : factors.determinant_sign() > 0;
}

/// Finds the load between two factors, at the first of which the string is sound, at which it
/// ceases to be, and says so.
void EquilibriumSearch::report_buckling(Stage stage, RodState state, double sound, double unsound) {
    constexpr double fine = 1e-9;
    while (unsound - sound > fine * unsound) {
        const double middle = 0.5 * (sound + unsound);
        balance_.set_loads(loads_at(stage, middle));
        if (newton_.follow(state) != SearchOutcome::converged) break;
        (is_sound(newton_.factors(state)) ? sound : unsound) = middle;
    }
    warnings_.push_back(
        fmt::format("the string buckles at {:.9g} times its {}; the equilibrium found lies beyond",
                    unsound, stage == Stage::weight ? "weight" : "load at the bit"));
}

/// After a descent that ended on a saddle: where the loads made it one.
void EquilibriumSearch::look_for_buckling() {
    for (const Stage stage : {Stage::bit, Stage::weight}) {
        balance_.set_loads(loads_at(stage, 0));
        RodState state = state_;
        if (newton_.follow(state) != SearchOutcome::converged) break;
        if (!is_sound(newton_.factors(state))) continue;
        report_buckling(stage, state, 0, 1);
        break;
    }
    balance_.set_loads(loads_at(Stage::bit, 1));
}

/// From a state that is not stable downhill to one that is, or from which nothing falls further: a
/// column that has bent to one side may turn to any other, and rounding decides whether it is firm.
void EquilibriumSearch::fall_to_stable() {
    constexpr int tries = 5;
    Imbalance saddle = balance_.imbalance(state_);
    for (int i = 0; i < tries; ++i) {
        newton_.leave_saddle(state_);
        const SearchOutcome outcome = newton_.descend(state_, 1);
        if (outcome == SearchOutcome::failed) fail();
        const Imbalance now = balance_.imbalance(state_);
        stable_ = outcome == SearchOutcome::converged ||
                  saddle.energy - now.energy < now.least_energy_change();
        if (stable_) return;
        saddle = now;
    }
    warnings_.emplace_back("the equilibrium found is not stable");
}

double EquilibriumSearch::residual() {
    double largest = 0;
    for (const Vector6& force : balance_.imbalance(state_).force)
        largest = std::max(largest, force.head<3>().norm());
    return largest;
}

void EquilibriumSearch::fail() {
    const NodeMotion force = balance_.imbalance(state_).force;
    const auto worst =
        std::max_element(force.begin(), force.end(), [](const auto& a, const auto& b) {
            return a.template head<3>().norm() < b.template head<3>().norm();
        });
    const auto node = static_cast<std::size_t>(worst - force.begin()) + first_moving_node(scene_);
    throw SimulationError(
        fmt::format("no equilibrium found in {} iterations: {:.3g} N remain out of balance near "
                    "node {}, {:.1f} "
                    "m along the string; a string that flutters or whirls has none",
                    newton_.iterations(), worst->head<3>().norm(), node, scene_.mesh.node_s[node]));
}

}  // namespace drillstrand
