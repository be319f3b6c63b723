#include "statics/bit_load.hpp"

#include <Eigen/Geometry>
#include <optional>

#include "statics/skew.hpp"
#include "statics/well_section.hpp"

namespace drillstrand {

using Eigen::Vector3d;

BitLoad bit_load(const Bit& bit, const BitLoadCase& loads, const SegmentEnd& node,
                 const WellArc* arc) {
    const Vector3d& t = node.director;
    std::optional<WellSection> well;
    if (arc != nullptr) well = well_section(node.position, *arc);
    BitMotion motion{{}, well ? well->l : t, bit.steady_rate(loads.rotation_rate, loads.time)};
    motion.frame << t, node.material, t.cross(node.material);
    const EndLoad full = bit.load(motion, loads.time);

    BitLoad result;
    result.dead_force = loads.factor * bit.loads().force(loads.time);
    result.load << loads.factor * full.force, loads.factor * full.couple;
    const double weight = loads.factor * bit.loads().weight(loads.time);
    if (bit.loads().direction == BitDirection::follower || !well)
        result.tangent.topRightCorner<3, 3>() = weight * skew(t);
    else
        result.tangent.topLeftCorner<3, 3>() = -weight * well->l_by_position();
    // couples but the dead one turn with the section
    const Vector3d turning =
        result.load.tail<3>() - loads.factor * bit.loads().dead_moment(loads.time);
    result.tangent.bottomRightCorner<3, 3>() = -skew(turning);
    return result;
}

bool bit_is_conservative(const Bit& bit, const BitLoadCase& loads) {
    if (loads.factor == 0) return true;
    const BitCase& given = bit.loads();
    const bool follows = given.direction == BitDirection::follower && given.weight(loads.time) != 0;
    const bool turns = bit.loads().motor || loads.rotation_rate != 0;
    const bool torque = turns && bit.full_torque(loads.time) != 0;
    return !follows && !torque && given.moment(loads.time).isZero(0) &&
           given.dead_moment(loads.time).isZero(0);
}

}  // namespace drillstrand
