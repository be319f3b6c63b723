/// Static equilibrium of a string: Newton's method on the rod of the leapfrog, at rest or with
/// Coulomb friction that opposes a steady motion. Theory: engine/statics/README.md.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

/// Steady motion of the whole string, which friction opposes. Only its direction matters, but for
/// the torque at the bit, which vanishes with the rotation (BitCase::smoothing_speed).
struct SteadyMotion {
    double axial_speed = 0;    ///< m/s, down the well
    double rotation_rate = 0;  ///< rad/s about d3

    [[nodiscard]] bool is_rest() const { return axial_speed == 0 && rotation_rate == 0; }
};

/// The motion of a word of the case file; `rotation_rate` (rad/s) where the string rotates, and a
/// speed along the well of 1 m/s where it moves.
SteadyMotion steady_motion(StringMotion motion, double rotation_rate);

/// Whether the bit is on bottom, loaded as the case says: where the string drills, slides into the
/// hole, or rests. Where it is tripped, or rotates without drilling, it is off bottom: nothing acts
/// on the bit.
bool bit_is_loaded(StringMotion motion);

struct EquilibriumOptions {
    SteadyMotion motion;
    /// Of a string that is tripped, down the well (m/s): it pushes mud aside, and the pump stands
    /// still. 0: it pushes none, and the pump runs.
    double trip_speed = 0;
    bool bit_loads = true;  ///< false: nothing acts on the bit
    /// Schedules of loads are read at this time (s); their end by default.
    double load_time = std::numeric_limits<double>::infinity();
    /// Nodes to start from: those of a neighbouring equilibrium (N+1 nodes, N twists). Without them
    /// the scene's initial nodes.
    std::optional<InitialNodes> start;
    int max_iterations = 2000;  ///< of Newton's method, all load steps together
};

/// The options that a case asks for in its table [equilibrium].
EquilibriumOptions equilibrium_options(const Case& input);

struct Equilibrium {
    InitialNodes nodes;
    SeriesRecord series;  ///< time 0; energies relative to the scene's initial nodes
    Profile profile;      ///< contact_force includes the friction

    /// Force along -d3 that holds the head (N): the buoyed weight below it, half a cell of the head
    /// itself included, less what walls and bit carry.
    double hook_load = 0;
    /// Couple about d3 that the drive exerts on the head (N m); positive where it drives a positive
    /// rotation.
    double surface_torque = 0;
    Eigen::Vector3d bit_force = Eigen::Vector3d::Zero();   ///< on the bit, space frame (N)
    Eigen::Vector3d bit_couple = Eigen::Vector3d::Zero();  ///< on the bit, space frame (N m)

    int iterations = 0;   ///< of Newton's method
    double residual = 0;  ///< largest force out of balance on a node (N)
    bool stable = true;   ///< whether no small displacement lowers the energy
    /// What a user should know, a sentence each: buckling points that were passed, an equilibrium
    /// that is not stable.
    std::vector<std::string> warnings;
};

/// The equilibrium of a scene. Throws SimulationError where none is found, std::invalid_argument
/// where the head is free (nothing holds the string).
Equilibrium find_equilibrium(const Scene& scene, const EquilibriumOptions& options = {});

/// As find_equilibrium(), but its nodes alone.
InitialNodes equilibrium_nodes(const Scene& scene, const EquilibriumOptions& options = {});

}  // namespace drillstrand
