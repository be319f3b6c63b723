/// Pressure loss of a Herschel-Bulkley fluid in a pipe and in the slot that stands for an annulus:
/// engine/forces/README.md, "Mud in motion". SI units.
#pragma once

#include "drillstrand/case.hpp"

namespace drillstrand {

/// Shear stress = yield + consistency rate^index.
struct Rheology {
    double yield = 0;        ///< Pa
    double consistency = 0;  ///< Pa s^n
    double index = 1;        ///< n

    /// Rate of shear at a stress (1/s); 0 up to the yield stress.
    [[nodiscard]] double rate(double stress) const;
};

Rheology rheology_of(const FluidCase& fluid);

enum class Duct {
    pipe,  ///< width: its inner diameter
    slot   ///< between walls at a distance, width: that distance
};

/// Rate of shear that a Newtonian fluid of the same mean speed has at the wall, 8 U/D or 6 U/t
/// (1/s), where the wall bears a stress (Pa): the exact integral over the laminar profile.
double newtonian_rate(const Rheology& mud, Duct duct, double wall_stress);

/// The inverse: stress at the wall of laminar flow (Pa), to rounding.
double laminar_stress(const Rheology& mud, Duct duct, double newtonian_rate);

/// A flow at its wall.
struct WallFlow {
    double stress = 0;    ///< Pa, with the sign of the speed
    double rate = 0;      ///< of shear of a laminar layer under that stress (1/s), likewise
    double reynolds = 0;  ///< 8 rho U^2 over the stress of laminar flow
    bool laminar = true;  ///< Reynolds number below that of the transition
};

/// Laminar, transitional or turbulent flow of mean speed (m/s), by the friction factors of API RP
/// 13D. Odd in the speed.
WallFlow wall_flow(const Rheology& mud, double density, Duct duct, double width, double speed);

/// Loss of pressure per length (Pa/m) of a flow whose wall bears a stress (Pa).
double pressure_gradient(Duct duct, double width, double wall_stress);

}  // namespace drillstrand
