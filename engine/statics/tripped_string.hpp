/// The string of a case on its way down the well: cut or lengthened at its top.
#pragma once

#include "drillstrand/case.hpp"
#include "drillstrand/equilibrium.hpp"
#include "drillstrand/scene.hpp"
#include "statics/soft_string.hpp"

namespace drillstrand {

/// The case with its bit at a measured depth (m) and its head at the start of the well, at rest on
/// the well's axis; its segments keep their length as nearly as a whole number of them allows, and
/// friction is that of the study.
Case case_at_depth(const Case& input, double bit_depth);

/// The component at an arc length from the head (m); the lower one at a joint.
const Component& component_at(const StringCase& string, double s);

/// How the string of a case at a depth moves in a study.
EquilibriumOptions tripping_options(const Case& at_depth, TorqueDragMotion motion);

/// The same string without stiffness. `scene` is that of the case.
SoftString soft_string(const Case& at_depth, const Scene& scene, const EquilibriumOptions& options);

}  // namespace drillstrand
