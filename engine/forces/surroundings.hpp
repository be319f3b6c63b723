/// What each node knows of the well around it, in the layout of the step loop.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "drillstrand/scene.hpp"
#include "forces/contact.hpp"
#include "forces/well_frame.hpp"
#include "numerics/block_table.hpp"

namespace drillstrand {

/// Constants of the surroundings that all nodes share.
struct SurroundingsParameters {
    double least_normal = 0;  ///< 0, or minus infinity where the dashpot may pull (N/m)
    FrictionParameters friction{};
    double viscosity = 0;  ///< Pa s
    double film = 0;
    bool eccentric_axial_drag = true;
};

SurroundingsParameters surroundings_parameters(const Scene& scene);

/// Contact of one node as reports show it.
struct NodeContact {
    double eccentricity = 0;                          ///< m
    double well_depth = 0;                            ///< measured depth of its section (m)
    double penetration = 0;                           ///< m; 0 in the open hole
    double normal_force = 0;                          ///< N/m
    double spring_energy = 0;                         ///< of normal and friction springs (J/m)
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< wall on pipe, space frame (N/m)
};

/// Per-node state of contact and friction, and the arc of well each node is in.
class Surroundings {
  public:
    /// One line per array: name, meaning, unit, who writes it.
    enum Row : std::size_t {
        start_x,           // first point of the arc's axis (m); refresh_arcs
        start_y,           //
        start_z,           //
        tangent_x,         // its unit tangent; refresh_arcs
        tangent_y,         //
        tangent_z,         //
        normal_x,          // its unit normal, toward the centre; refresh_arcs
        normal_y,          //
        normal_z,          //
        curvature,         // of the arc (1/m); refresh_arcs
        hole,              // radius of the hole (m); refresh_arcs
        end_cosine,        // cosine of the arc's total angle; refresh_arcs
        reach,             // its sine / curvature (m); refresh_arcs
        concentric_axial,  // axial drag coefficient where it is concentric, else 0; refresh_arcs
        pipe,              // outer radius of the pipe (m); constant
        stiffness,         // k_el (Pa); constant
        damping,           // eta_el (Pa s); constant
        elongation_axial,  // friction spring along l (m); advance_springs
        elongation_azimuthal,  // friction spring along t (m); advance_springs
        sliding,               // 1 where the surface point slides, else 0; advance_springs
        depth,                 // penetration (m); node kernel
        normal,                // normal force (N/m); node kernel
        slip_axial,            // velocity of the surface point along l (m/s); node kernel
        slip_azimuthal,        // velocity of the surface point along t (m/s); node kernel
        leaves,                // 1 where the foot has left the arc, else 0; node kernel
        rows
    };

    /// Empty without a well. Nodes start in the arcs that hold `position`, with slack springs.
    Surroundings(const Scene& scene, const std::vector<Eigen::Vector3d>& position);

    [[nodiscard]] bool empty() const { return well_ == nullptr; }
    [[nodiscard]] double* row(Row row) { return table_.row(row); }
    [[nodiscard]] const double* row(Row row) const { return table_.row(row); }
    [[nodiscard]] const SurroundingsParameters& parameters() const { return parameters_; }

    /// Whether a node of a block touches the wall, still holds a stretched spring or has left its
    /// arc: whether there is anything to follow at the end of a step.
    [[nodiscard]] bool changes(std::size_t block) const;

    /// Friction springs of a block after the surface points slipped for dt (s).
    void advance_springs(double dt, std::size_t block);

    /// Moves the nodes of a span whose foot has left their arc (row `leaves`) to the arc that
    /// holds it. `position(k)` gives the node's position.
    template <class Position>
    void refresh_arcs(BlockSpan span, const Position& position) {
        const std::size_t end = std::min(span.end * block_size, arc_.size());
        for (std::size_t k = span.begin * block_size; k < end; ++k) {
            if (table_.row(leaves)[k] > 0.5) enter_arc(k, well_->find_arc(position(k), arc_[k]));
        }
    }

    /// Contact of a node at `position`, with the normal force of the last node kernel. Everything
    /// is zero without a well.
    [[nodiscard]] NodeContact contact(std::size_t node, const Eigen::Vector3d& position) const;

    [[nodiscard]] ArcNumbers arc_numbers(std::size_t node) const;

  private:
    void enter_arc(std::size_t node, std::size_t arc);

    const Well* well_ = nullptr;
    SurroundingsParameters parameters_;
    BlockTable table_;
    std::vector<std::size_t> arc_;
};

}  // namespace drillstrand
