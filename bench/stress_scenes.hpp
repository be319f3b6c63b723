/// Random drilling scenes over the ranges that engineers use, for the stability stress test.
#pragma once

#include "drillstrand/case.hpp"

namespace drillstrand::bench {

/// Scene number `index` of a seed: always the same one, on every machine with the same standard
/// library. Strings of one to five components in wells of one to three diameters; what is drawn and
/// from which range is said in bench/README.md.
Case stress_scene(unsigned seed, int index, double duration);

/// The same scene as a rig has it: pipe with tool joints, a bit as wide as its hole, stabilisers,
/// perhaps a bent motor and an eccentric mass, on a mesh that follows the string, in casing and
/// open hole of their own friction.
Case assembly_scene(unsigned seed, int index, double duration);

/// The first scene with what excites itself: a bit that sticks, cuts or rolls on cones, a motor, a
/// top drive, a hoist with its autodriller, a jar, friction that falls with speed, mud that yields,
/// thins and is pumped.
Case driven_scene(unsigned seed, int index, double duration);

}  // namespace drillstrand::bench
