#include "drillstrand/step_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "forces/contact.hpp"
#include "rod/bit.hpp"
#include "rod/segment_rates.hpp"

namespace drillstrand {

namespace {

// Stability of the schemes: an oscillation of rate omega allows steps up to this over omega, a
// decay likewise. Dormand-Prince 5(4): on the imaginary and on the negative real axis.
constexpr double leapfrog_oscillation = 2.0;
constexpr double dormand_prince_oscillation = 1.0;
constexpr double dormand_prince_decay = 3.3;

/// Collects the tightest of many bounds.
class Tightest {
  public:
    void offer(double rate, double product, const char* process) {
        const double step = product / rate;
        if (!(step < bound_.step)) return;
        bound_ = {step, rate, process};
    }
    [[nodiscard]] const StepBound& bound() const { return bound_; }

  private:
    StepBound bound_{std::numeric_limits<double>::infinity(), 0, "none"};
};

/// Product of rate (1/s) and step that Dormand-Prince allows. Damping beyond the critical one
/// decays with tau omega^2.
double dormand_prince_product(const DampingCase& damping, double rate) {
    const double decay = damping.kelvin_voigt * rate;
    return decay > 1 ? dormand_prince_decay / decay : dormand_prince_oscillation;
}

/// Product of rate and step that the leapfrog allows for a rate (1/s) and the inertia of a segment
/// that moves with it (kg, kg m2). Kelvin-Voigt damping and D_in act with the velocities of the
/// last half step; the latter slows a zigzag at the rate 2 D_in / (inertia of a segment).
double leapfrog_product(const DampingCase& damping, double rate, double moved) {
    const double internal = std::max(damping.internal.translation, damping.internal.rotation);
    const double ratio = 0.5 * damping.kelvin_voigt * rate + internal / (moved * rate);
    return leapfrog_oscillation * (std::sqrt(1 + ratio * ratio) - ratio);
}

/// Stiffness over the square of the length, the largest of the segments at a node.
struct NodeStiffness {
    double axial = 0;
    double shear = 0;
    double bending = 0;
    double torsion = 0;
    double length = 0;  ///< of the longer segment (m)
};

NodeStiffness node_stiffness(const StringMesh& mesh, std::size_t node) {
    NodeStiffness stiffness;
    const std::size_t segments = mesh.length.size();
    for (std::size_t k = node == 0 ? 0 : node - 1; k < std::min(node + 1, segments); ++k) {
        const SectionProperties& s = mesh.segment[k];
        const double h2 = mesh.length[k] * mesh.length[k];
        stiffness.axial = std::max(stiffness.axial, s.axial_stiffness / h2);
        stiffness.shear = std::max(stiffness.shear, s.shear_stiffness / h2);
        stiffness.bending = std::max(stiffness.bending, s.bending_stiffness / h2);
        stiffness.torsion = std::max(stiffness.torsion, s.torsional_stiffness / h2);
        stiffness.length = std::max(stiffness.length, mesh.length[k]);
    }
    return stiffness;
}

/// Fastest motions of the strand near a node: those of neighbours against each other, and of cross
/// sections against the shear of the rod.
void offer_strand(Tightest& tightest, const Scene& scene, std::size_t node) {
    const NodeStiffness k = node_stiffness(scene.mesh, node);
    const SectionProperties& section = scene.mesh.node[node];
    const double inertia = scene.inertia[node];
    const double sideways = scene.lateral_mass[node];
    const auto offer = [&](double rate2, const char* process) {
        const double rate = std::sqrt(rate2);
        tightest.offer(rate, dormand_prince_product(scene.damping, rate), process);
    };
    offer(4 * k.axial / section.mass, "axial waves");
    offer(4 * k.torsion / section.polar_inertia, "torsional waves");
    // Inside a rod the fastest motions are cross sections that turn together, kGA/I, or nodes that
    // zigzag, 4 kGA/(m h^2). At an end, with half a cell, a mode of both is faster. With s their
    // sum, p their product, a long rod's end swings at s - p/s: q^k times the end's, |q| < 1; one
    // segment alone at s.
    const auto segments = static_cast<double>(scene.segments);
    const bool at_end = node == 0 || node + 1 == scene.mesh.node.size();
    const double turning = k.shear * k.length * k.length / inertia;
    const double zigzag = 4 * k.shear / sideways;
    const double both = turning + zigzag;
    const double swing = both - (1 - 1 / segments) * turning * zigzag / both;
    offer(at_end ? swing : turning, "rotation of the cross sections against shear");
    offer(zigzag + 4 * k.bending / inertia, "zigzags of neighbouring nodes");
}

/// The firmest wall of the well, and friction, as steps see them; nothing without a well.
class HoldingWall {
  public:
    explicit HoldingWall(const Scene& scene)
        : scene_(scene), firmness_(scene.well ? scene.well->largest_firmness() : 0) {}

    [[nodiscard]] double firmness() const { return firmness_; }
    /// Square of the rate at which it throws a node back (1/s2).
    [[nodiscard]] double rate2(std::size_t node) const {
        return stiffness(node) / scene_.lateral_mass[node];
    }
    /// Square of the rate of a node that it holds and friction drags, at most (1/s2).
    [[nodiscard]] double touching_rate2(std::size_t node) const {
        if (!scene_.well) return 0;
        const SectionProperties& section = scene_.mesh.node[node];
        const double radius2 = section.outer_radius * section.outer_radius;
        return std::max(rate2(node) + rubbing() / scene_.lateral_mass[node],
                        rubbing() * radius2 / section.polar_inertia);
    }
    /// Whether it throws a node back within a step (s): what a step cannot tell would give energy.
    [[nodiscard]] bool is_beyond(std::size_t node, double step) const {
        if (!scene_.well) return false;
        const double holding = stiffness(node) + rubbing();
        return scene_.mesh.cell[node] * holding * step * step > mass_at_hand(node, step);
    }

  private:
    /// Of its spring (Pa). Hertz's wall is as stiff as the node is deep: here where a fast impact
    /// takes it, (2/5) K dr^2.5 = m v^2/2.
    [[nodiscard]] double stiffness(std::size_t node) const {
        constexpr double fast = 10;  // m/s
        const NormalLaw law = scene_.contact.normal_law;
        const double own = firmness_ * scene_.normal_stiffness[node];
        if (law == NormalLaw::linear) return own;
        const double depth = std::pow(1.25 * scene_.lateral_mass[node] * fast * fast / own, 0.4);
        return tangent_stiffness(law, own, depth);
    }
    /// A surface that is held moves by the node's own motion and by its spin: (u + R s)^2 is at
    /// most 2 u^2 + 2 R^2 s^2 (Pa).
    [[nodiscard]] double rubbing() const { return 2 * scene_.contact.tangential_stiffness; }
    /// Mass that a force on a node moves within a step (kg): that of an endless beam, 2 m (EI
    /// dt^2/m)^1/4, or a fourth of it at an end.
    [[nodiscard]] double mass_at_hand(std::size_t node, double step) const {
        const double mass = scene_.lateral_mass[node];
        const bool at_end = node == 0 || node + 1 == scene_.mesh.node.size();
        const double reach =
            std::pow(scene_.mesh.node[node].bending_stiffness * step * step / mass, 0.25);
        return mass * std::max(scene_.mesh.cell[node], (at_end ? 0.5 : 2.0) * reach);
    }

    const Scene& scene_;
    double firmness_;
};

StepBound dormand_prince_bound(const Scene& scene) {
    const HoldingWall wall(scene);
    Tightest tightest;
    for (std::size_t node = 0; node < scene.mesh.node.size(); ++node) {
        offer_strand(tightest, scene, node);
        if (!scene.features.well) continue;
        const double mass = scene.lateral_mass[node];
        const double firmer_damping = scene.contact.restitution ? std::sqrt(wall.firmness()) : 1.0;
        tightest.offer(std::sqrt(wall.rate2(node)), dormand_prince_oscillation, "contact springs");
        tightest.offer(firmer_damping * scene.normal_damping[node] / mass, dormand_prince_decay,
                       "contact dashpots");
        tightest.offer(std::sqrt(scene.contact.tangential_stiffness / scene.mesh.node[node].mass),
                       leapfrog_oscillation, "friction springs");
    }
    return tightest.bound();
}

/// The least inertias of the nodes at a segment, of its length (kg, kg m2).
struct MovedInertia {
    double along;
    double about;
    double across;  ///< of mass and rotary inertia, the lesser

    MovedInertia(const Scene& scene, std::size_t segment) {
        const double h = scene.mesh.length[segment];
        const auto least = [&](const auto& of) {
            return h * std::min(of(segment), of(segment + 1));
        };
        along = least([&](std::size_t node) { return scene.mesh.node[node].mass; });
        about = least([&](std::size_t node) { return scene.mesh.node[node].polar_inertia; });
        across = least([&](std::size_t node) {
            return std::min(scene.lateral_mass[node], scene.inertia[node]);
        });
    }
};

/// A segment as the leapfrog's step sees it.
struct MovingSegment {
    SegmentRates rates;
    MovedInertia moved;
};

std::vector<MovingSegment> moving_segments(const Scene& scene) {
    std::vector<MovingSegment> segments;
    const std::vector<ExpectedLoad> loads = expected_loads(scene);
    segments.reserve(loads.size());
    for (std::size_t k = 0; k < loads.size(); ++k)
        segments.push_back({segment_rates(scene, k, loads[k]), MovedInertia(scene, k)});
    if (scene.bit.drills()) {
        // the rock is a spring on the bit's cell, which at an end is less than half a segment; it
        // lets go and takes hold between two steps, which gives energy unless they tell it well
        const SectionProperties& bit = scene.mesh.node.back();
        const double rock = rock_stiffness(scene);
        double& rate = segments.back().rates.axial;
        rate = std::hypot(rate, 2 * std::sqrt(rock / (bit.mass * scene.mesh.cell.back())));
    }
    return segments;
}

/// What bounds the leapfrog's step.
struct LeapfrogBounds {
    Tightest axial;
    Tightest torsional;
    Tightest any;

    void offer(const DampingCase& damping, const MovingSegment& segment) {
        const auto& [rates, moved] = segment;
        const auto to = [&](Tightest& tightest, double rate, double inertia, const char* process) {
            tightest.offer(rate, leapfrog_product(damping, rate, inertia), process);
        };
        to(axial, rates.axial, moved.along, "axial waves");
        to(torsional, rates.torsional, moved.about, "torsional waves");
        to(any, rates.any, moved.across, "bending of neighbouring nodes");
    }
    [[nodiscard]] double step() const {
        return std::min({axial.bound().step, torsional.bound().step, any.bound().step});
    }
};

/// The bound of the segments that are in none of the stretches.
StepBound leapfrog_bound(const DampingCase& damping, const std::vector<MovingSegment>& segments,
                         const std::vector<FineStretch>& stretches) {
    LeapfrogBounds bounds;
    auto stretch = stretches.begin();
    for (std::size_t k = 0; k < segments.size(); ++k) {
        while (stretch != stretches.end() && stretch->end <= k)
            ++stretch;
        if (stretch != stretches.end() && stretch->first <= k) continue;
        bounds.offer(damping, segments[k]);
    }
    const double step = bounds.step();
    // nodes of pipes turn as fast as axial waves but for end effects: the waves give the name
    constexpr double as_fast = 1.05;
    for (const Tightest* waves : {&bounds.axial, &bounds.torsional})
        if (waves->bound().step < as_fast * step)
            return {step, waves->bound().rate, waves->bound().process};
    return bounds.any.bound();
}

/// What a segment allows by itself (s): with the damping, and without.
struct SegmentStep {
    double damped;
    double free;
};

std::vector<SegmentStep> own_steps(const DampingCase& damping,
                                   const std::vector<MovingSegment>& segments) {
    std::vector<SegmentStep> steps;
    steps.reserve(segments.size());
    for (const MovingSegment& segment : segments) {
        LeapfrogBounds bounds;
        bounds.offer(damping, segment);
        steps.push_back({bounds.step(), leapfrog_oscillation / fastest(segment.rates)});
    }
    return steps;
}

/// The segments whose own step is below that of the string, and one more on each side of them, so
/// that neighbours at the ends of a stretch are alike.
std::vector<FineStretch> stretches_below(const std::vector<SegmentStep>& steps,
                                         const HoldingWall& wall, double step) {
    std::vector<FineStretch> stretches;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (steps[k].damped >= step) continue;
        const std::size_t first = k > 0 ? k - 1 : 0;
        const std::size_t end = std::min(k + 2, steps.size());
        if (stretches.empty() || stretches.back().end < first)
            stretches.push_back({first, end, std::numeric_limits<double>::infinity(), 1});
        stretches.back().end = end;
    }
    for (FineStretch& stretch : stretches) {
        for (std::size_t k = stretch.first; k < stretch.end; ++k)
            stretch.free_step = std::min(stretch.free_step, steps[k].free);
        double touching2 = 0;
        for (std::size_t k = stretch.first; k <= stretch.end; ++k)
            touching2 = std::max(touching2, wall.touching_rate2(k));
        const double free2 = std::pow(leapfrog_oscillation / stretch.free_step, 2);
        stretch.free_step = leapfrog_oscillation / std::sqrt(free2 + touching2);
    }
    return stretches;
}

/// Whether a stretch reaches an end with a motion or a spring of its own. Substeps know a head that
/// is free or moves as scheduled, not one that yields, and the bit's load over a step, not the rock
/// that a bit presses as it moves.
bool reaches_an_end_of_its_own(const FineStretch& stretch, const Scene& scene) {
    const HeadCase& head = scene.head;
    const bool head_yields = head.drive || head.hoist || head.motion == HeadMotion::pinned;
    return (stretch.first == 0 && head_yields) ||
           (stretch.end == scene.mesh.length.size() && scene.bit.drills());
}

/// Whether a jar slides in a stretch. Substeps have all segments hold along their axes.
bool holds_a_jar(const FineStretch& stretch, const Scene& scene) {
    const auto& jar = scene.mesh.jar;
    return jar && stretch.first <= jar->segment && jar->segment < stretch.end;
}

/// Rounds in single precision err by kappa 6e-8 of the forces, kappa up to 0.86 p^2.
bool takes_too_many(const FineStretch& stretch) {
    constexpr int most_substeps = 48;
    return stretch.substeps > most_substeps;
}

/// Work for a second of the run, in steps of one node.
double work(const StepPlan& plan, std::size_t nodes) {
    auto work = static_cast<double>(nodes);
    for (const FineStretch& stretch : plan.stretches)
        work += stretch.work();
    return work / plan.bound.step;
}

}  // namespace

double FineStretch::work() const {
    // measured with contact and mud: what a node takes for its forces, and for each substep
    constexpr double forces = 0.8;
    constexpr double substep = 0.06;
    return static_cast<double>(end - first + 1) * (forces + substep * substeps);
}

StepPlan step_plan(const Scene& scene) {
    const std::vector<MovingSegment> segments = moving_segments(scene);
    const double tau = scene.damping.kelvin_voigt;
    StepPlan best{leapfrog_bound(scene.damping, segments, {}), {}, tau};
    // D_in drags what is nearer to the bit, which no substeps of the rod can tell
    if (!scene.local_steps || scene.damping.internal.any()) return best;
    constexpr double worthwhile = 0.75;
    constexpr double finer = 1.19;  // four tries for each doubling of the step
    const std::vector<SegmentStep> steps = own_steps(scene.damping, segments);
    const HoldingWall wall(scene);
    const std::size_t nodes = segments.size() + 1;
    double least_work = worthwhile * work(best, nodes);
    const double longest = std::max_element(steps.begin(), steps.end(), [](auto& a, auto& b) {
                               return a.damped < b.damped;
                           })->damped;
    for (double step = best.bound.step; step <= longest; step *= finer) {
        std::vector<FineStretch> stretches = stretches_below(steps, wall, step);
        if (stretches.empty()) continue;
        const StepBound bound = leapfrog_bound(scene.damping, segments, stretches);
        StepPlan plan{bound, std::move(stretches), tau};
        if (!std::isfinite(plan.bound.step)) break;  // no segment is left
        const double step_without_damping = plan.undamped(plan.bound.step);
        const auto tells_walls = [&](const FineStretch& stretch) {
            if (reaches_an_end_of_its_own(stretch, scene) || holds_a_jar(stretch, scene))
                return false;
            for (std::size_t k = stretch.first; k <= stretch.end; ++k)
                if (wall.is_beyond(k, step_without_damping)) return false;
            return true;
        };
        if (!std::all_of(plan.stretches.begin(), plan.stretches.end(), tells_walls)) break;
        for (FineStretch& stretch : plan.stretches)
            stretch.substeps = substeps_in(stretch, step_without_damping);
        if (std::any_of(plan.stretches.begin(), plan.stretches.end(), takes_too_many)) break;
        if (work(plan, nodes) >= least_work) continue;
        least_work = work(plan, nodes);
        best = std::move(plan);
    }
    return best;
}

StepBound step_bound(const Scene& scene, IntegratorKind integrator) {
    return integrator == IntegratorKind::leapfrog ? step_plan(scene).bound
                                                  : dormand_prince_bound(scene);
}

std::vector<double> segment_steps(const Scene& scene) {
    std::vector<double> steps;
    for (const SegmentStep& step : own_steps(scene.damping, moving_segments(scene)))
        steps.push_back(step.damped);
    return steps;
}

}  // namespace drillstrand
