/// A scene: everything a run needs to know and never changes.
///
/// Node k joins segments k-1 and k; segment k joins nodes k and k+1. Integrators copy what their
/// step loop reads into padded tables of their own (engine/numerics/block_table.hpp).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/drill_string.hpp"
#include "drillstrand/records.hpp"
#include "drillstrand/well.hpp"

namespace drillstrand {

/// Damping of the rod: none, the paper's D_in and D_ex, or Kelvin-Voigt and, where given, these.
enum class Damping { none, paper, kelvin_voigt };

/// Which physics the scene names; decided once, before the first step.
struct SceneFeatures {
    bool well = false;           ///< contact and friction
    bool drag = false;           ///< annular fluid drag
    bool inertial_flow = false;  ///< of which the fluid's inertia is part
    bool flowing_mud = false;    ///< it is pumped, or its viscosity depends on the rate of shear
    bool fluid_mass = false;     ///< fluid inside and around the pipe moves sideways with it
    /// Friction, firmness or diameter of the wall vary along the well, friction with speed, or its
    /// stiffness with depth.
    bool varied_wall = false;
    Damping damping = Damping::none;
    bool curved = false;  ///< a stress-free shape that is not straight, or an eccentric mass
};

/// Nodes of a string whose beam-column segments are not stretched (engine/model/README.md, "Initial
/// nodes"); or those of an equilibrium.
struct InitialNodes {
    std::vector<Eigen::Vector3d> position;  ///< N+1 (m)
    std::vector<Eigen::Vector3d> director;  ///< N+1, d3
    std::vector<double> twist;              ///< N (1/m)
};

/// Friction coefficients of a section of the well.
struct SectionFriction {
    FrictionCoefficients fixed;  ///< static
    FrictionCoefficients slide;  ///< dynamic
};

struct Scene {
    int segments = 0;  ///< N
    StringMesh mesh;
    /// N+1, mass that moves sideways: the pipe, the fluid in it, and the fluid around it as in the
    /// middle of the hole (kg/m)
    std::vector<double> lateral_mass;
    /// N+1, rotary inertia about a diameter (kg m): rho I; for the leapfrog at least 4 k EI m/EA,
    /// at a bit with a torque at least m h^2/3; for dormand-prince with segment inertia, and for
    /// the leapfrog with strong internal damping of rotation, plus (lateral mass) h^2/12
    std::vector<double> inertia;
    std::vector<double> weight;  ///< N+1, buoyed weight (N/m)
    /// N+1, k_el (Pa) and eta_el (Pa s) of the wall at the node, per length of its cell; at the bit
    /// with the wall that it touches besides; of Hertz's wall K (Pa/m^0.5) and 0. Those of
    /// [contact]: where the well is firmer, by WellArc::firmness, the stiffness is larger by that
    /// factor, and so is a dashpot that follows from a restitution by its root. Empty without a
    /// well.
    std::vector<double> normal_stiffness;
    std::vector<double> normal_damping;
    bool local_steps = true;  ///< leapfrog: where segments are short, steps of their own
    SceneFeatures features;
    std::optional<Well> well;
    std::optional<FluidCase> fluid;
    ContactCase contact;
    std::vector<SectionFriction> section_friction;  ///< of each section of the well
    double side_force_window = 0;                   ///< m
    DampingCase damping;
    HeadCase head;
    BitCase bit;
    Eigen::Vector3d down{0, 0, 1};  ///< direction of gravity
    double gravity = 0;             ///< m/s2

    /// Initial pose of the head; d3, d1, d2 in the columns of the frame.
    Eigen::Vector3d head_position = Eigen::Vector3d::Zero();
    Eigen::Matrix3d head_frame = Eigen::Matrix3d::Identity();
    /// N, initial strains (k3, k1, k2, g3, g1, g2); the string starts at rest.
    std::vector<Vector6> initial_strain;
    /// The same shape as nodes joined by beam-columns, for integrators whose segments are not arcs.
    InitialNodes initial_nodes;
    /// What a reader of the results should know of the scene, a sentence each.
    std::vector<std::string> notes;
};

/// Builds the scene of a case. Throws InputError where string, well and mesh do not go together.
/// The string lies in the well's axis or in its own shape: starting_scene() (simulation.hpp) also
/// finds the equilibrium that a case may ask for.
Scene build_scene(const Case& input);

/// Builds the scene of a case for statics, whose rod is the leapfrog's whatever integrates runs.
Scene build_static_scene(Case input);

/// Frame (d3, d1, d2 in the columns) with the given d3: d1 is east made normal to d3, or north
/// where d3 is within 25 degrees of east or west; d2 = d3 x d1.
Eigen::Matrix3d frame_along(const Eigen::Vector3d& d3);

/// Mass of the fluid in a pipe, and of that which it displaces, per length (kg/m).
double fluid_inside(const SectionProperties& section, const FluidCase& fluid);
double fluid_displaced(const SectionProperties& section, const FluidCase& fluid);

/// Weight per length of a pipe less that of the fluid it displaces (N/m).
double buoyed_weight(const SectionProperties& section, const std::optional<FluidCase>& fluid,
                     double gravity);

}  // namespace drillstrand
