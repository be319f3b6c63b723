/// What each node knows of the well around it, in the layout of the step loop.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "drillstrand/isa.hpp"
#include "drillstrand/scene.hpp"
#include "forces/apparent_viscosity.hpp"
#include "forces/contact.hpp"
#include "forces/well_frame.hpp"
#include "numerics/block_table.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// Constants of the surroundings that all nodes share.
struct SurroundingsParameters {
    double least_normal = 0;  ///< 0, or minus infinity where the dashpot may pull (N/m)
    double restitution = -1;  ///< that a case asks for; -1 where spring and dashpot tell
    NormalLaw normal_law = NormalLaw::linear;
    double hunt_crossley = 0;  ///< chi, law hertz (s/m)
    /// Friction, firmness or diameter vary along the well, friction with speed, or stiffness with
    /// depth.
    bool varied_wall = false;
    FrictionParameters friction{};
    double density = 0;    ///< kg/m3
    double viscosity = 0;  ///< Pa s
    Thinning thinning{};   ///< of mud that flows
    double film = 0;
    double drag_coefficient = 0;  ///< of cross flow; 0 where the flow has no inertia
    bool inertial_flow = false;
    bool contact_drag = true;  ///< also where the pipe touches
    bool eccentric_axial_drag = true;
};

SurroundingsParameters surroundings_parameters(const Scene& scene);

/// Contact of one node as reports show it.
struct NodeContact {
    double eccentricity = 0;                           ///< m
    double clearance = 0;                              ///< of what touches, 0 at least (m)
    double room = 0;                                   ///< of the pipe's body in the hole (m)
    double firmness = 1;                               ///< of the wall (WellArc::firmness)
    double well_depth = 0;                             ///< measured depth of its section (m)
    double penetration = 0;                            ///< m; 0 in the open hole
    double normal_force = 0;                           ///< N/m
    double axial_friction = 0;                         ///< wall on pipe, down the well (N/m)
    double spring_energy = 0;                          ///< of normal and friction springs (J/m)
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< wall on pipe, space frame (N/m)
    Eigen::Vector3d around = Eigen::Vector3d::Zero();  ///< unit vector t of the well frame
};

/// The well and the wall as all steps of a run see them. What changes from step to step is a table
/// of WallRow, which the caller holds.
class Surroundings {
  public:
    enum Row : std::size_t {
        pipe,       // radius that touches the wall (m)
        body,       // radius around which mud flows (m)
        stiffness,  // k_el of a wall of firmness 1 (Pa; law hertz: K, Pa/m^0.5)
        damping,    // eta_el (Pa s)
        inside,     // fluid in the pipe that moves sideways with it (kg/m)
        displaced,  // fluid that the pipe displaces, rho pi R^2, where it has an added mass (kg/m)
        mud_load,   // of mud in motion on the node, down the well (N/m), here and below as it
        mud_speed,  // lies at the start; mean speed of what is pumped, up the annulus (m/s)
        mud_shear,  // its rate of shear on the pipe (1/s)
        axial_thinning,  // rates at the wall over those of a Newtonian fluid, sliding
        spin_thinning,   // and turning
        rows
    };

    /// Empty without a well.
    explicit Surroundings(const Scene& scene, Level level = {});

    [[nodiscard]] bool empty() const { return well_ == nullptr; }
    [[nodiscard]] const double* row(Row row) const { return constants_.row(row); }
    [[nodiscard]] const SurroundingsParameters& parameters() const { return parameters_; }

    /// Nodes in the arcs that hold `position`, with slack springs. No table without a well.
    [[nodiscard]] Table<WallRow> wall_at(const std::vector<Eigen::Vector3d>& position) const;

    /// Fills the rows that follow from the arcs of the nodes, of a restored table. Throws
    /// std::invalid_argument where the well has no such arc.
    void derive(Table<WallRow>& wall) const;

    /// Whether a node of a block touches the wall, still holds a stretched spring or has left its
    /// arc: whether there is anything to follow at the end of a step.
    [[nodiscard]] bool changes(const Table<WallRow>& wall, std::size_t block) const;

    /// Mass of the fluid that moves sideways with a node at `position` (kg/m).
    [[nodiscard]] double fluid_mass(const Table<WallRow>& wall, std::size_t node,
                                    const Eigen::Vector3d& position) const;

    /// Friction springs of a block after the surface points slipped for dt (s).
    void advance_springs(Table<WallRow>& wall, double dt, std::size_t block) const;

    /// Moves the nodes of a span whose foot has left their arc (row `leaves`) to the arc that
    /// holds it. `position(k)` gives the node's position.
    template <class Position>
    void refresh_arcs(Table<WallRow>& wall, BlockSpan span, const Position& position) const {
        const std::size_t end = std::min(span.end * block_size, nodes_);
        for (std::size_t k = span.begin * block_size; k < end; ++k) {
            if (wall.row(WallRow::leaves)[k] > 0.5)
                enter_arc(wall, k, well_->find_arc(position(k), arc(wall, k)));
        }
    }

    /// The fluid that moves sideways with the nodes of a span.
    template <class Position>
    void refresh_fluid_mass(Table<WallRow>& wall, BlockSpan span, const Position& position) const {
        const std::size_t end = std::min(span.end * block_size, nodes_);
        for (std::size_t k = span.begin * block_size; k < end; ++k)
            wall.row(WallRow::fluid_mass)[k] = fluid_mass(wall, k, position(k));
    }

    /// Contact of a node at `position`, with the normal force of the last node kernel. Everything
    /// is zero without a well.
    [[nodiscard]] NodeContact contact(const Table<WallRow>& wall, std::size_t node,
                                      const Eigen::Vector3d& position) const;

    /// Down the well at a node; `elsewhere` where there is no well.
    [[nodiscard]] Eigen::Vector3d direction(const Table<WallRow>& wall, std::size_t node,
                                            const Eigen::Vector3d& position,
                                            const Eigen::Vector3d& elsewhere) const;

  private:
    void set_mud_in_motion(const Scene& scene);
    [[nodiscard]] std::size_t arc(const Table<WallRow>& wall, std::size_t node) const {
        return static_cast<std::size_t>(wall.row(WallRow::arc)[node]);
    }
    void enter_arc(Table<WallRow>& wall, std::size_t node, std::size_t arc) const;
    void meet_wall(Table<WallRow>& wall, std::size_t node, const WellArc& arc) const;
    void meet_flow(Table<WallRow>& wall, std::size_t node, const WellArc& arc) const;

    Level level_;
    const Well* well_ = nullptr;
    std::vector<SectionFriction> section_friction_;
    std::size_t nodes_ = 0;
    SurroundingsParameters parameters_;
    BlockTable constants_;
};

}  // namespace drillstrand
