/// Hydraulics: pressures of the mud that is pumped through a string, or pushed aside by it, and the
/// forces that it exerts along the string. Theory: engine/forces/README.md, "Mud in motion".
#pragma once

#include <vector>

#include "drillstrand/scene.hpp"

namespace drillstrand {

/// What moves the mud.
struct MudMotion {
    double flow_rate = 0;    ///< pumped down the string (m3/s)
    double axial_speed = 0;  ///< of a string whose end is closed, down the well (m/s)

    [[nodiscard]] bool is_rest() const { return flow_rate == 0 && axial_speed == 0; }
};

/// What moves the mud of a scene: its pump, or, where the string is tripped with a speed (m/s, down
/// the well), that alone.
MudMotion mud_motion(const Scene& scene, double trip_speed = 0);

/// One value per node of the string as it lies at the start.
struct Hydraulics {
    std::vector<double> pipe_radius;       ///< of the annulus inside (m)
    std::vector<double> hole_radius;       ///< and outside (m)
    std::vector<double> inside_gradient;   ///< loss of pressure down the string (Pa/m)
    std::vector<double> annulus_gradient;  ///< loss of pressure up the annulus (Pa/m)
    std::vector<double> annulus_speed;     ///< mean, up the annulus (m/s)
    std::vector<double> annulus_shear;     ///< rate at the wall of the pipe (1/s)
    std::vector<double> inside_pressure;   ///< above that of the atmosphere, hydrostatic too (Pa)
    std::vector<double> outside_pressure;  ///< likewise, in the annulus (Pa)
    /// Force on the string down the well (N/m): that of the flow in the annulus, and of the jets at
    /// the bit on its node.
    std::vector<double> axial_load;

    double axial_force = 0;         ///< sum of these loads (N)
    double inside_loss = 0;         ///< along the whole string (Pa)
    double annulus_loss = 0;        ///< Pa
    double bit_loss = 0;            ///< in the nozzles (Pa)
    double jet_force = 0;           ///< reaction of the nozzles' jets, up (N)
    double standpipe_pressure = 0;  ///< Pa
    double bit_pressure = 0;        ///< in the annulus at the bit (Pa)
    /// Of a fluid at rest with that pressure (kg/m3); that of the mud where the bit is no deeper
    /// than the head.
    double equivalent_density = 0;
    double turbulent_inside = 0;   ///< part of the length of the string
    double turbulent_annulus = 0;  ///< likewise
};

/// Losses of the concentric annulus. The scene needs a well and a fluid; throws
/// std::invalid_argument where it has none.
Hydraulics hydraulics_of(const Scene& scene, const MudMotion& motion);

/// Forces of moving mud on the nodes, down the well (N/m); empty where it is at rest.
std::vector<double> mud_loads(const Scene& scene, const MudMotion& motion);

/// Area inside a pipe (m2).
double inner_area(const SectionProperties& section);

}  // namespace drillstrand
