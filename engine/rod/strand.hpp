/// The strand equations on the staggered grid: right-hand side of momenta and stresses.
/// Equations (paper 1-6) and their discrete form: engine/rod/README.md.
///
/// One evaluation has two passes over blocks with a barrier between them, because a node needs the
/// segments on both sides and its pose needs every segment before it:
///     segment_pass   stress rates, wrenches on the two end nodes, pose within the block
///     node_pass      pose, weight, surroundings, momentum rates
#pragma once

#include <cstddef>
#include <vector>

#include "drillstrand/isa.hpp"
#include "drillstrand/scene.hpp"
#include "forces/surroundings.hpp"
#include "model/pose.hpp"
#include "numerics/block_table.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// Constants of the rod in the layout of the step loop.
class StrandConstants {
  public:
    enum Row : std::size_t {
        half_length,         // segment, h / 2 (m)
        length,              // segment, h (m)
        inverse_length,      // segment, 1 / h (1/m)
        torsion,             // segment, GJ (N m2)
        bending,             // segment, EI (N m2)
        axial,               // segment, EA (N)
        shear,               // segment, k G A (N)
        torsion_compliance,  // segment, 1 / GJ
        bending_compliance,  // segment, 1 / EI
        axial_compliance,    // segment, 1 / EA
        shear_compliance,    // segment, 1 / (k G A)
        twist0,              // segment, stress-free k3 (1/m)
        bend10,              // segment, stress-free k1 (1/m)
        bend20,              // segment, stress-free k2 (1/m)
        inverse_cell,        // node, 1 / length of its cell (1/m)
        mobile_cell,         // node, length of its cell (m); 0 where its motion is prescribed
        mass,                // node, m (kg/m)
        inverse_mass,        // node, 1 / m (m/kg)
        inverse_polar,       // node, 1 / (rho Ip)
        inverse_transverse,  // node, 1 / (rho I)
        weight,              // node, buoyed weight (N/m)
        rows
    };

    explicit StrandConstants(const Scene& scene);

    [[nodiscard]] const double* row(Row row) const { return table_.row(row); }

  private:
    BlockTable table_;
};

/// What the two passes hand to each other.
enum class StrandWorkRow { wrench_on_first, wrench_on_last, local_rotation, local_position };
// clang-format off
template <>
inline constexpr auto row_list<StrandWorkRow> = std::to_array<RowInfo<StrandWorkRow>>({
    {StrandWorkRow::wrench_on_first, "wrench_on_first", "N m, N", 6, Extent::segments, Keep::derived, "segment_pass: on its first node, S + h/2 ad (per cell length)"},
    {StrandWorkRow::wrench_on_last,  "wrench_on_last",  "N m, N", 6, Extent::segments, Keep::derived, "segment_pass: on its last node, S - h/2 ad"},
    {StrandWorkRow::local_rotation,  "local_rotation",  "1",      9, Extent::nodes,    Keep::derived, "segment_pass: turn since the first node of the block, row-major"},
    {StrandWorkRow::local_position,  "local_position",  "m",      3, Extent::nodes,    Keep::derived, "segment_pass: displacement since then, in that node's frame"},
});
// clang-format on

/// The same, and what both passes tell the energy account.
struct StrandWorkspace {
    explicit StrandWorkspace(std::size_t nodes)
        : table(nodes),
          block_step(table.blocks()),
          segment_power(table.blocks()),
          power(table.blocks()) {}

    Table<StrandWorkRow> table;
    std::vector<SegmentPose> block_step;  ///< pose from a block's first node to the next block's
    std::vector<double> segment_power;    ///< per block, of Kelvin-Voigt damping on the rod (W)
    std::vector<double> power;            ///< per block, of all damping and surroundings (W)
};

/// Everything about the rod and its surroundings that does not change in a run.
struct StrandModel {
    StrandConstants constants;
    Surroundings surroundings;
    Level level;
    SceneFeatures features;
    DampingPair internal_damping;  ///< D_in
    DampingPair external_damping;  ///< D_ex
    double kelvin_voigt = 0;       ///< tau (s)
    Eigen::Vector3d down{0, 0, 1};
    std::size_t segments = 0;

    explicit StrandModel(const Scene& scene, Level level = {});
};

/// Stress rates of the segments of blocks begin..end-1, their wrenches and block-local poses.
/// Momenta of all nodes must be up to date. Of the wall it is the fluid that moves along.
void segment_pass(const StrandModel& model, const Table<StrandRow>& state, Table<StrandRow>& rate,
                  StrandWorkspace& work, const Table<WallRow>& wall, std::size_t begin,
                  std::size_t end);

/// Stress that the outside imposes at an end of the rod, in body axes: the wrench of a ghost
/// segment of no length. To be set between the two passes.
void set_head_wrench(StrandWorkspace& work, const Vector6& stress);
void set_bit_wrench(StrandWorkspace& work, std::size_t segments, const Vector6& stress);

/// Wrench of the first segment on the head, in body axes.
Vector6 wrench_on_head(const StrandWorkspace& work);

/// Pose of the first node of each block begin..end-1, and of the node after them, from the head's.
/// Every caller computes the whole chain up to `end`, in the same order.
void chain_blocks(const Pose& head, const StrandWorkspace& work, std::vector<Pose>& block_start,
                  std::size_t end);

/// Momentum rates of the nodes of blocks begin..end-1. Wrenches of all segments must be up to
/// date, block_start of these blocks too. Writes the contact rows of `wall`.
void node_pass(const StrandModel& model, const Table<StrandRow>& state, Table<StrandRow>& rate,
               StrandWorkspace& work, const std::vector<Pose>& block_start, Table<WallRow>& wall,
               std::size_t begin, std::size_t end);

/// Pose of one node, from the last segment_pass and the pose of its block's first node.
Pose node_pose(const StrandWorkspace& work, const std::vector<Pose>& block_start, std::size_t node);

/// Momentum (per length) or stress of one node or segment, in the order of the table.
Vector6 momentum_of(const Table<StrandRow>& state, std::size_t node);
Vector6 stress_of(const Table<StrandRow>& state, std::size_t segment);
void set_momentum(Table<StrandRow>& state, std::size_t node, const Vector6& momentum);
void set_stress(Table<StrandRow>& state, std::size_t segment, const Vector6& stress);

}  // namespace drillstrand
