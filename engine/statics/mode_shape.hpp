/// What a mode of vibration looks like: its kind, its sense of turning, its places.
#pragma once

#include <complex>

#include "drillstrand/modes.hpp"
#include "drillstrand/scene.hpp"
#include "statics/block_tridiagonal.hpp"
#include "statics/rod_state.hpp"
#include "statics/vibration_matrices.hpp"

namespace drillstrand {

/// q of u = Re(q exp(i w t)), for each node that moves.
using ComplexMotion = NodeVectors<std::complex<double>>;

/// Shares of the kinetic energy, and how much of it goes round.
struct ModeCharacter {
    double lateral = 0;
    double torsional = 0;
    double axial = 0;
    double whirl = 0;

    [[nodiscard]] ModeKind kind() const;
};

ModeCharacter mode_character(const RodState& state, const VibrationMatrices& matrices,
                             const ComplexMotion& motion);

/// The whole mode, scaled. `frequency` in rad/s.
VibrationMode described_mode(const Scene& scene, const RodState& state,
                             const VibrationMatrices& matrices, double frequency,
                             const ComplexMotion& motion);

/// The largest length of Re(v exp(i w t)) in a period: half of the long axis of its ellipse.
double largest_of_period(const Eigen::Vector3cd& v);

/// Mean strains of a segment in a motion: bending across its axis (1/m), twist (1/m), stretch.
struct SegmentStrainAmplitude {
    Eigen::Vector3cd bending;
    std::complex<double> twist;
    std::complex<double> stretch;
};

/// Of segment k; the head is at rest where it is clamped.
SegmentStrainAmplitude strain_amplitude(const Scene& scene, const RodState& state,
                                        const ComplexMotion& motion, std::size_t k);

}  // namespace drillstrand
