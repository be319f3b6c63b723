#include "statics/bit_load.hpp"

#include <Eigen/Geometry>
#include <optional>

#include "forces/bit.hpp"
#include "statics/skew.hpp"
#include "statics/well_section.hpp"

namespace drillstrand {

using Eigen::Vector3d;

BitLoad bit_load(const Scene& scene, const BitLoadCase& loads, const SegmentEnd& bit,
                 const WellArc* arc) {
    BitMotion motion;
    const Vector3d& t = bit.director;
    motion.frame << t, bit.material, t.cross(bit.material);
    std::optional<WellSection> well;
    if (arc != nullptr) well = well_section(bit.position, *arc);
    motion.well_direction = well ? well->l : t;
    motion.rotation_rate = loads.rotation_rate;
    motion.radius = scene.mesh.node.back().outer_radius;
    const Vector6 stress = bit_stress(scene.bit, motion, loads.time);

    BitLoad result;
    result.dead_force = loads.factor * scene.bit.force(loads.time);
    result.load << loads.factor * (motion.frame * stress.tail<3>()),
        loads.factor * (motion.frame * stress.head<3>());
    const double weight = loads.factor * scene.bit.weight(loads.time);
    if (scene.bit.direction == BitDirection::follower || !well)
        result.tangent.topRightCorner<3, 3>() = weight * skew(t);
    else
        result.tangent.topLeftCorner<3, 3>() = -weight * well->l_by_position();
    // couples but the dead one turn with the section
    const Vector3d turning =
        result.load.tail<3>() - loads.factor * scene.bit.dead_moment(loads.time);
    result.tangent.bottomRightCorner<3, 3>() = -skew(turning);
    return result;
}

bool bit_is_conservative(const Scene& scene, const BitLoadCase& loads) {
    if (loads.factor == 0) return true;
    const BitCase& bit = scene.bit;
    const bool follows = bit.direction == BitDirection::follower && bit.weight(loads.time) != 0;
    const bool torque = loads.rotation_rate != 0 &&
                        bit_torque(bit, scene.mesh.node.back().outer_radius, loads.time) != 0;
    return !follows && !torque && bit.moment(loads.time).isZero(0) &&
           bit.dead_moment(loads.time).isZero(0);
}

}  // namespace drillstrand
