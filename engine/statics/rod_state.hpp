/// Configuration of the director rod, and finite moves of it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "statics/rod_segment.hpp"

namespace drillstrand {

/// The first node that moves: that after a clamped head, or a pinned head, which tilts.
inline std::size_t first_moving_node(const Scene& scene) {
    return scene.head.motion == HeadMotion::pinned ? 0 : 1;
}

/// Displacement (m) and rotation vector (rad), space frame, of each node that moves.
using NodeMotion = std::vector<Vector6>;

struct RodState {
    std::vector<Eigen::Vector3d> position;  ///< N+1 (m)
    std::vector<Eigen::Vector3d> director;  ///< N+1, t
    std::vector<Eigen::Vector3d> material;  ///< N+1, d1
    std::vector<double> twist;              ///< N (1/m)

    /// Nodes with the frames that the twist of the segments gives them, from the head on.
    RodState(const InitialNodes& nodes, const Eigen::Vector3d& head_d1,
             const std::vector<double>& length);

    [[nodiscard]] InitialNodes nodes() const { return {position, director, twist}; }
    [[nodiscard]] SegmentEnd end(std::size_t node) const {
        return {position[node], director[node], material[node]};
    }
};

/// How the positions of a step follow.
enum class StepRule {
    nodes,   ///< each node moves by its displacement
    strains  ///< the strains of the segments change by as much as the motion says to first order
};

/// The state after `scale` times a motion. Directors turn exactly, twist takes the area that they
/// sweep; both step rules agree to first order.
RodState moved(const RodState& state, const std::vector<double>& length, const NodeMotion& motion,
               double scale, StepRule rule);

}  // namespace drillstrand
