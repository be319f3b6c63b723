/// The mud around a pipe as textbooks write it, with the functions of the C library: creeping flow
/// (Finn and Cox 2001), correlations of turbulent flow, potential flow. What kernels are held to.
#pragma once

#include <Eigen/Core>

#include "drillstrand/case.hpp"

namespace drillstrand::test {

/// A pipe off the axis of its hole (m).
struct Annulus {
    double pipe, hole, eccentricity;

    [[nodiscard]] double clearance() const { return hole - pipe; }
};

/// Speed across the axis and along it (m/s), spin (rad/s); of the speed across, what goes around
/// the axis (m/s); mean speed (m/s) and rate of shear on the pipe (1/s) of a flow up the annulus.
struct Stirring {
    double across = 0, along = 0, spin = 0, around = 0, pumped = 0, pumped_shear = 0;
};

/// Drag per length as a matrix on (v_r, v_l, v_t, spin): N s/m2 and N s.
Eigen::Matrix4d textbook_drag(const FluidCase& fluid, const Annulus& annulus,
                              const Stirring& motion);

/// Torque per length on a cylinder that spins in a concentric one, past laminar flow (N): Bilgen
/// and Boulos (1973), C_M = 1.03 (t/R)^0.3 Re^-0.5 or 0.065 (t/R)^0.3 Re^-0.2, the larger (they
/// meet at 1e4), torque C_M pi rho w^2 R^4 / 2. Re = R w t / nu; `shift` is added to it.
double turbulent_torque(const FluidCase& fluid, const Annulus& annulus, double spin,
                        double shift = 0);

/// Added mass over the fluid that the pipe displaces, by the series of potential flow in bipolar
/// coordinates, and its slope over the eccentricity (1/m).
double potential_flow_mass(const Annulus& annulus);
double potential_flow_slope(const Annulus& annulus);

/// Fluid that moves sideways with a pipe of this bore (kg/m), and its slope over the eccentricity
/// (kg/m2); none where the case has no added mass. The film counts as for the drag.
double lateral_fluid(const FluidCase& fluid, const Annulus& annulus, double bore_area);
double lateral_fluid_slope(const FluidCase& fluid, const Annulus& annulus);

}  // namespace drillstrand::test
