#include "drillstrand/step_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Stiffness over the square of the length, the largest of the segments at a node.
struct NodeStiffness {
    double axial = 0;
    double shear = 0;
    double bending = 0;
    double torsion = 0;
    double length = 0;                                          ///< of the longer segment (m)
    double shortest = std::numeric_limits<double>::infinity();  ///< length of the other (m)
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
        stiffness.shortest = std::min(stiffness.shortest, mesh.length[k]);
    }
    return stiffness;
}

/// Fastest motions of the rod near a node: those of neighbours against each other, and of cross
/// sections against the shear of the rod. `product` of rate and step is what the scheme allows for
/// a rate (1/s) and the inertia of a segment that moves with it (kg, kg m2).
template <class Product>
void offer_rod(Tightest& tightest, const Scene& scene, std::size_t node, const Product& product) {
    const NodeStiffness k = node_stiffness(scene.mesh, node);
    const SectionProperties& section = scene.mesh.node[node];
    const double inertia = scene.inertia[node];
    const double sideways = scene.lateral_mass[node];
    const auto offer = [&](double rate2, double moved, const char* process) {
        const double rate = std::sqrt(rate2);
        tightest.offer(rate, product(rate, moved * k.shortest), process);
    };
    offer(4 * k.axial / section.mass, section.mass, "axial waves");
    offer(4 * k.torsion / section.polar_inertia, section.polar_inertia, "torsional waves");
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
    offer(at_end ? swing : turning, inertia, "rotation of the cross sections against shear");
    offer(zigzag + 4 * k.bending / inertia, std::min(sideways, inertia),
          "zigzags of neighbouring nodes");
}

}  // namespace

StepBound step_bound(const Scene& scene, IntegratorKind integrator) {
    Tightest tightest;
    const bool leapfrog = integrator == IntegratorKind::leapfrog;
    for (std::size_t node = 0; node < scene.mesh.node.size(); ++node) {
        if (leapfrog) {
            // Kelvin-Voigt damping and D_in act with the velocities of the last half step; the
            // latter slows a zigzag at the rate 2 D_in / (inertia of a segment)
            const double internal =
                std::max(scene.damping.internal.translation, scene.damping.internal.rotation);
            offer_rod(tightest, scene, node, [&](double rate, double moved) {
                const double ratio =
                    0.5 * scene.damping.kelvin_voigt * rate + internal / (moved * rate);
                return leapfrog_oscillation * (std::sqrt(1 + ratio * ratio) - ratio);
            });
            continue;
        }
        offer_rod(tightest, scene, node, [&](double rate, double /*moved*/) {
            // damping beyond the critical one decays with tau omega^2
            const double decay = scene.damping.kelvin_voigt * rate;
            return decay > 1 ? dormand_prince_decay / decay : dormand_prince_oscillation;
        });
        if (!scene.features.well) continue;
        const double mass = scene.lateral_mass[node];
        tightest.offer(std::sqrt(scene.normal_stiffness[node] / mass), dormand_prince_oscillation,
                       "contact springs");
        tightest.offer(scene.normal_damping[node] / mass, dormand_prince_decay, "contact dashpots");
        tightest.offer(std::sqrt(scene.contact.tangential_stiffness / scene.mesh.node[node].mass),
                       leapfrog_oscillation, "friction springs");
    }
    return tightest.bound();
}

}  // namespace drillstrand
