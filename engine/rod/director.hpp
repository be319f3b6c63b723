/// The rod on directors: nodes with a position, a unit director t = d3, an angular velocity normal
/// to it and a spin about it; segments with stretch, shear, bending and twist between them.
/// Equations: engine/rod/README.md, "Director rod".
///
/// A pipe is circular, so no material frame has to spin along. One step of the leapfrog is one pass
/// over the segments and one over the nodes; the rod of the last whole step is read, that of the
/// next is written, so that neighbours never see a half-finished step.
#pragma once

#include <cstddef>

#include "drillstrand/isa.hpp"
#include "drillstrand/scene.hpp"
#include "forces/surroundings.hpp"
#include "model/segment_strain.hpp"
#include "numerics/block_table.hpp"
#include "rod/end.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// Constants of the rod in the layout of the step loop.
class DirectorConstants {
  public:
    enum Row : std::size_t {
        length,              // segment, h (m)
        inverse_length,      // segment, 1 / h (1/m); 0 in the padding
        twisting,            // segment, 1 / GJ (1/(N m2))
        bent_twisting,       // segment, what bending adds to it (1/(N m2))
        bending,             // segment, EI / h2 (N)
        axial,               // segment, EA (N)
        deviation,           // segment, 12 k EI / h2 (N)
        bending_share,       // segment, k
        slenderness,         // segment, EA h2 / EI
        twist0,              // segment, stress-free twist (1/m)
        bend10,              // segment, stress-free curvature about d1 (1/m)
        bend20,              // segment, stress-free curvature about d2 (1/m)
        inverse_cell,        // node, 1 / length of its cell (1/m)
        mobile_cell,         // node, length of its cell (m); 0 where its motion is prescribed
        tilting_cell,        // node, length of its cell (m); 0 where its director's is
        mass,                // node, m (kg/m)
        inverse_mass,        // node, 1 / m
        polar,               // node, rho Ip (kg m)
        inverse_polar,       // node, 1 / (rho Ip)
        transverse,          // node, rotary inertia across the axis (kg m)
        inverse_transverse,  // node, its inverse
        weight,              // node, buoyed weight (N/m)
        unbalance,           // node, eccentric mass times distance over its cell (kg)
        rows
    };

    explicit DirectorConstants(const Scene& scene);

    [[nodiscard]] const double* row(Row row) const { return table_.row(row); }

  private:
    BlockTable table_;
};

/// The stiffnesses of segments, from an entry on.
struct StiffnessRows {
    StiffnessRows(const DirectorConstants& c, std::ptrdiff_t first)
        : axial(c.row(DirectorConstants::axial) + first),
          bending(c.row(DirectorConstants::bending) + first),
          deviation(c.row(DirectorConstants::deviation) + first),
          bending_share(c.row(DirectorConstants::bending_share) + first),
          slenderness(c.row(DirectorConstants::slenderness) + first),
          twisting(c.row(DirectorConstants::twisting) + first),
          bent_twisting(c.row(DirectorConstants::bent_twisting) + first) {}
    const double *axial, *bending, *deviation, *bending_share, *slenderness, *twisting,
        *bent_twisting;

    DRILLSTRAND_INLINE SegmentStiffness operator[](std::size_t k) const {
        return {axial[k],       bending[k],  deviation[k],    bending_share[k],
                slenderness[k], twisting[k], bent_twisting[k]};
    }
};

/// What segments hand to nodes, written anew each step.
enum class SegmentRow {
    twist,
    pull,
    last_pull,
    torque,
    last_torque,
    first_lean,
    last_lean,
    first_couple,
    last_couple,
    viscous_pull,
    viscous_couple,
    viscous_torque,
    viscous_lean,
    drag_force,
    drag_couple
};
// clang-format off
template <>
inline constexpr auto row_list<SegmentRow> = std::to_array<RowInfo<SegmentRow>>({
    {SegmentRow::twist,          "twist",          "1/m", 1, Extent::segments, Keep::derived, "of the frames, at the whole step, stress-free twist included"},
    {SegmentRow::pull,           "pull",           "N",   3, Extent::segments, Keep::derived, "n: force on the first node"},
    {SegmentRow::last_pull,      "last_pull",      "N",   3, Extent::segments, Keep::derived, "its reaction on the last, with its sign turned: n but for substeps"},
    {SegmentRow::torque,         "torque",         "N m", 1, Extent::segments, Keep::derived, "about the first director, on the first node"},
    {SegmentRow::last_torque,    "last_torque",    "N m", 1, Extent::segments, Keep::derived, "its reaction on the last, about the last director, with its sign turned"},
    {SegmentRow::first_lean,     "first_lean",     "N m", 3, Extent::segments, Keep::derived, "- dV/dt of the first director: couple t x lean"},
    {SegmentRow::last_lean,      "last_lean",      "N m", 3, Extent::segments, Keep::derived, "- dV/dt of the last"},
    {SegmentRow::first_couple,   "first_couple",   "N m", 3, Extent::segments, Keep::derived, "curved: own-shape couple on the first node"},
    {SegmentRow::last_couple,    "last_couple",    "N m", 3, Extent::segments, Keep::derived, "curved: and on the last"},
    {SegmentRow::viscous_pull,   "viscous_pull",   "N",   3, Extent::segments, Keep::derived, "Kelvin-Voigt: as pull"},
    {SegmentRow::viscous_couple, "viscous_couple", "N m", 3, Extent::segments, Keep::derived, "Kelvin-Voigt: as couple"},
    {SegmentRow::viscous_torque, "viscous_torque", "N m", 1, Extent::segments, Keep::derived, "Kelvin-Voigt: as torque"},
    {SegmentRow::viscous_lean,   "viscous_lean",   "N m", 3, Extent::segments, Keep::derived, "Kelvin-Voigt: couple of shear on each node"},
    {SegmentRow::drag_force,     "drag_force",     "N/m", 3, Extent::segments, Keep::derived, "D_in times the rate of stretch and shear"},
    {SegmentRow::drag_couple,    "drag_couple",    "N",   3, Extent::segments, Keep::derived, "D_in times the rate of bending and twist"},
});
// clang-format on

/// Everything about the rod and its surroundings that does not change in a run.
struct DirectorModel {
    DirectorConstants constants;
    Surroundings surroundings;
    Level level;
    SceneFeatures features;
    DampingPair internal_damping;  ///< D_in
    DampingPair external_damping;  ///< D_ex
    double kelvin_voigt = 0;       ///< tau (s)
    Eigen::Vector3d down{0, 0, 1};
    std::size_t segments = 0;

    explicit DirectorModel(const Scene& scene, Level level = {});
};

/// Stresses of the segments of a span at a whole step. `drift` is the time since the step
/// before, over which the spins of the state have twisted the segments (s).
void director_segments(const DirectorModel& model, const Table<DirectorRow>& rod,
                       Table<SegmentRow>& segments, BlockSpan span, double drift);

/// Force and couple of the outside on an end of the rod, as a ghost segment beyond it would exert
/// them: entry -1 before the head, N behind the bit. `director` is that of the end.
void write_end_load(Table<SegmentRow>& segments, std::ptrdiff_t ghost, const EndLoad& load,
                    const Eigen::Vector3d& director);

/// What one step of a span of nodes did, besides moving them.
struct NodeStep {
    double outflow = 0;  ///< energy given to surroundings and damping (J)
    double impacts = 0;  ///< nodes that came into contact
    double slips = 0;    ///< nodes in contact that began to slide
    double leavers = 0;  ///< nodes whose foot has left its arc of the well
    double faults = 0;   ///< nodes whose velocity is not a number
};

/// Moves the nodes of a span: forces act on velocities for `kick` (s), velocities on poses for
/// `drift` (s). Reads `rod`, writes `next`. Segments of this span and the one before its first must
/// be up to date; friction springs in `wall` advance with the step.
NodeStep director_nodes(const DirectorModel& model, const Table<DirectorRow>& rod,
                        Table<DirectorRow>& next, const Table<SegmentRow>& segments,
                        Table<WallRow>& wall, BlockSpan span, double kick, double drift);

}  // namespace drillstrand
