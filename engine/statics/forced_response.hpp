/// Steady vibration of a string under a harmonic load: engine/statics/README.md, "Modes".
#pragma once

#include "drillstrand/modes.hpp"
#include "statics/mode_shape.hpp"

namespace drillstrand {

/// The string about its static state, as a harmonic load meets it.
struct ShakenString {
    const Scene& scene;
    const RodState& state;
    const VibrationMatrices& matrices;
};

/// `rotation_rate` in rad/s.
ForcedResponse forced_response(const ShakenString& string, const Excitation& excitation,
                               double rotation_rate);

}  // namespace drillstrand
