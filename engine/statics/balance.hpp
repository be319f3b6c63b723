/// Balance of forces of a whole string: what is out of balance at each node, and how it changes
/// with the nodes.
#pragma once

#include <limits>
#include <vector>

#include "drillstrand/equilibrium.hpp"
#include "drillstrand/hydraulics.hpp"
#include "drillstrand/scene.hpp"
#include "rod/bit.hpp"
#include "rod/head.hpp"
#include "statics/bit_load.hpp"
#include "statics/block_tridiagonal.hpp"
#include "statics/rod_state.hpp"
#include "statics/wall_load.hpp"

namespace drillstrand {

/// What acts on a string besides its own stresses.
struct LoadCase {
    double weight = 1;    ///< factor of the buoyed weight
    double friction = 1;  ///< factor of the friction
    /// Walls are no stiffer than this (Pa): on the way to stiff ones.
    double stiffest_wall = std::numeric_limits<double>::infinity();
    SteadyMotion motion;
    BitLoadCase bit;
    MudMotion mud;  ///< as the balance was built with
};

/// Forces (N) and couples (N m) out of balance on each node that moves, and the energy of those
/// that have a potential.
struct Imbalance {
    NodeMotion force;       ///< sum of all loads
    NodeMotion loose;       ///< of these, the loads without a potential
    double energy = 0;      ///< strain, walls, weight and dead forces (J)
    double energy_sum = 0;  ///< sum of the magnitudes of its parts (J)

    /// What rounding alone leaves out of balance (README.md, "Rounding"): per node (N, N m), and of
    /// the energy (J).
    struct Rounding {
        double force = 0;
        double couple = 0;
    };
    std::vector<Rounding> rounding;
    double energy_rounding = 0;

    /// Whether nothing is left out of balance but what rounding leaves.
    [[nodiscard]] bool is_rounding() const;
    /// Energies that differ by less than this differ by rounding (J).
    [[nodiscard]] double least_energy_change() const;
};

/// Wall on a node, per length as reports show it.
struct WallReport {
    Eigen::Vector3d force;  ///< normal and friction (N/m)
    double normal;          ///< N/m
};

class Balance {
  public:
    Balance(const Scene& scene, const LoadCase& loads);

    [[nodiscard]] const LoadCase& loads() const { return loads_; }
    [[nodiscard]] RodSegment segment(const RodState& state, std::size_t k) const;
    void set_loads(const LoadCase& loads) { loads_ = loads; }

    /// From now on friction is what it is at this state, as dead forces, until it is set free.
    void hold_friction(const RodState& state);
    void free_friction() { held_friction_.clear(); }

    [[nodiscard]] Imbalance imbalance(const RodState& state);
    /// Minus the derivative of the forces by the motion of the nodes.
    void stiffness(const RodState& state, BlockTridiagonal& matrix);
    /// The same of the wall's force on one node alone.
    [[nodiscard]] Matrix6 wall_stiffness(const RodState& state, std::size_t node);

    [[nodiscard]] BitLoad bit(const RodState& state);
    /// What holds and turns the head (Head::hook_load, Head::surface_torque).
    [[nodiscard]] double hook_load(const RodState& state) const;
    [[nodiscard]] double surface_torque(const RodState& state) const;
    /// What the rock does to the bit, as SeriesRecord has it.
    [[nodiscard]] double weight_on_bit() const;
    [[nodiscard]] double bit_torque() const;
    [[nodiscard]] std::vector<WallReport> walls(const RodState& state);

  private:
    [[nodiscard]] const WellArc* arc(std::size_t node, const Eigen::Vector3d& position);
    [[nodiscard]] FrictionShares friction(std::size_t node, const WellArc& arc) const;
    [[nodiscard]] WallSite site(const RodState& state, std::size_t node);
    /// Force of mud in motion on a node (N), and its derivative by the node's position.
    [[nodiscard]] Eigen::Vector3d mud_force(const RodState& state, std::size_t node);
    [[nodiscard]] Eigen::Matrix3d mud_tangent(const RodState& state, std::size_t node);
    void add_rounding(const RodState& state, std::size_t segment, double pull,
                      const WallLoad& touch, Imbalance& sum) const;
    [[nodiscard]] double wall_stiffness(std::size_t node, const WallLoad& touch) const;
    static Matrix6 tilt_of(const RodState& state);
    void pin_head(const RodState& state, BlockTridiagonal& matrix) const;

    const Scene& scene_;
    Head head_;
    Bit bit_;
    LoadCase loads_;
    std::vector<double> mud_;             ///< per node, down the well (N); empty: at rest
    std::size_t first_;                   ///< node that moves
    std::vector<Vector6> held_friction_;  ///< per node (N, N m); empty: as the state has it
    std::vector<std::size_t> arc_;        ///< per node, where it was last
};

}  // namespace drillstrand
