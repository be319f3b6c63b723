/// Strings and small tools that the validation of the free rod shares.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "support/both_integrators.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {

/// The paper's pipes (Galasso, Santelli, Zambetti, Giusteri 2024), tables 2 to 4, of a given
/// length; shear coefficient 1.
std::string table_2_pipe(double length = 24);
std::string table_3_pipe(double length);
std::string table_4_pipe(double length = 515);

/// What the pipe of table 2 is made of.
inline constexpr double table_2_bending_stiffness = 1992118.251;  // N m2
inline constexpr double table_2_axial_stiffness = 970098678.7;    // N

/// A string of one component given by its section alone; `inertia` about a diameter, that about the
/// axis is twice as large.
struct Section {
    double length;
    double mass;
    double inertia;
    double bending;
    double torsional;
    double axial;
    double shear;
};
std::string section_component(const Section& section, const std::string& more = "");

/// [mesh] and [run] tables. Validation goes where no pipe would last: no stress limit.
std::string mesh_and_run(IntegratorKind integrator, int segments, bool segment_inertia,
                         double duration);

/// A part of a string that hangs: its weight (N/m) and EA (N).
struct HangingPart {
    double weight;
    double stiffness;
};

/// By how much (m) the leapfrog's string of such parts, joined at nodes of a mesh of segments of
/// length h (m), stretches more than exactly. Cubics move (q_2 - q_1) h/24 of the weight from the
/// node above a joint to the one below it, and q h/12 from the bit to the node above it:
/// engine/model/README.md, "Lumping".
double stretch_by_cubics(const std::vector<HangingPart>& parts, double h);

/// Lists of numbers as TOML has them.
std::string list(const Eigen::Vector3d& v);

/// Position of the bit at the end of a run that must have come to rest by then: less kinetic energy
/// than the square of `rest` (relative, of amplitudes) times the energy that was put in.
Eigen::Vector3d tip_at_rest(const std::string& toml, double rest = 1e-6);

}  // namespace drillstrand::test
