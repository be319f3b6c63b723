/// The rod on directors: nodes with a position, a unit director t = d3, an angular velocity normal
/// to it and a spin about it; segments with stretch, shear, bending and twist between them.
/// Equations: engine/rod/README.md, "Director rod".
///
/// A pipe is circular, so no material frame has to spin along. One step of the leapfrog is one pass
/// over the segments and one over the nodes; the state of the last whole step is read, that of the
/// next is written, so that neighbours never see a half-finished step.
#pragma once

#include <cstddef>

#include "drillstrand/scene.hpp"
#include "forces/surroundings.hpp"
#include "numerics/block_table.hpp"

namespace drillstrand {

/// Rows of the state of the nodes. Positions and directors belong to whole steps, velocities to the
/// half step before; vectors in the space frame take three rows.
enum DirectorRow : std::size_t {
    position = 0,          ///< x (m)
    velocity = 3,          ///< v (m/s)
    director = 6,          ///< t, unit
    angular_velocity = 9,  ///< Om, normal to t (rad/s)
    last_director = 12,    ///< t of the step before
    spin = 15,             ///< s = w . t (rad/s)
    material = 16,  ///< d1, normal to t; carried only where a curved stress-free shape needs it
    director_rows = 19
};

/// Constants of the rod in the layout of the step loop.
class DirectorConstants {
  public:
    enum Row : std::size_t {
        length,              // segment, h (m)
        inverse_length,      // segment, 1 / h (1/m); 0 in the padding
        torsion,             // segment, GJ (N m2)
        bending,             // segment, EI (N m2)
        axial,               // segment, EA (N)
        shear,               // segment, k G A (N)
        twist0,              // segment, stress-free twist (1/m)
        bend10,              // segment, stress-free curvature about d1 (1/m)
        bend20,              // segment, stress-free curvature about d2 (1/m)
        inverse_cell,        // node, 1 / length of its cell (1/m)
        mobile_cell,         // node, length of its cell (m); 0 where its motion is prescribed
        mass,                // node, m (kg/m)
        inverse_mass,        // node, 1 / m
        polar,               // node, rho Ip (kg m)
        inverse_polar,       // node, 1 / (rho Ip)
        transverse,          // node, rotary inertia across the axis (kg m)
        inverse_transverse,  // node, its inverse
        weight,              // node, buoyed weight (N/m)
        rows
    };

    explicit DirectorConstants(const Scene& scene);

    [[nodiscard]] const double* row(Row row) const { return table_.row(row); }

  private:
    BlockTable table_;
};

/// What segments hand to nodes; `twist` is state, the rest is written anew each step.
struct SegmentRow {
    enum Row : std::size_t {
        twist = 0,            // tau (1/m), without the stress-free twist
        pull = 1,             // 3 rows, n: force on the first node, its reaction on the last (N)
        couple = 4,           // 3 rows, on the first node, its reaction on the last (N m)
        torque = 7,           // about the directors (N m)
        lean = 8,             // 3 rows, h W: force on the directors of both nodes (N m)
        first_couple = 11,    // 3 rows, own-shape couples on the first node (N m)
        last_couple = 14,     // 3 rows, and on the last (N m)
        viscous_pull = 17,    // 3 rows, as pull, of Kelvin-Voigt damping (N)
        viscous_couple = 20,  // 3 rows, as couple (N m)
        viscous_torque = 23,  // as torque (N m)
        drag_force = 24,      // 3 rows, D_in times the rate of stretch and shear (N/m)
        drag_couple = 27,     // 3 rows, D_in times the rate of bending and twist (N)
        viscous_lean = 30,    // 3 rows, couple of Kelvin-Voigt shear on each node (N m)
        rows = 33
    };
};

/// Damping of the rod: none, the paper's D_in and D_ex, or these and Kelvin-Voigt.
enum class Damping { none, paper, kelvin_voigt };

/// Which parts of the rod's kernels a scene needs.
struct DirectorFeatures {
    Damping damping = Damping::none;
    bool curved = false;  ///< a stress-free shape that is not straight
};

/// Everything about the rod that does not change in a run.
struct DirectorModel {
    DirectorConstants constants;
    SceneFeatures scene_features;
    DirectorFeatures features;
    double internal_damping = 0;  ///< D_in
    double external_damping = 0;  ///< D_ex
    double kelvin_voigt = 0;      ///< tau (s)
    Eigen::Vector3d down{0, 0, 1};
    std::size_t segments = 0;

    explicit DirectorModel(const Scene& scene);
};

/// Stresses of the segments of a span at a whole step. `drift` is the time since the step
/// before, over which the spins of the state have twisted the segments (s).
void director_segments(const DirectorModel& model, const BlockTable& state, BlockTable& segments,
                       BlockSpan span, double drift);

/// What one step of a span of nodes did, besides moving them.
struct NodeStep {
    double outflow = 0;  ///< energy given to surroundings and damping (J)
    double impacts = 0;  ///< nodes that came into contact
    double slips = 0;    ///< nodes in contact that began to slide
    double leavers = 0;  ///< nodes whose foot has left its arc of the well
    double faults = 0;   ///< nodes whose velocity is not a number
};

/// Moves the nodes of a span: forces act on velocities for `kick` (s), velocities on poses for
/// `drift` (s). Reads `state`, writes `next`. Segments of this span and the one before its first
/// must be up to date; friction springs advance with the step.
NodeStep director_nodes(const DirectorModel& model, const BlockTable& state, BlockTable& next,
                        const BlockTable& segments, Surroundings& surroundings, BlockSpan span,
                        double kick, double drift);

}  // namespace drillstrand
