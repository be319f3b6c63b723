/// What a simulation reports: one SeriesRecord at each series time, one Profile at each profile
/// time. Every integrator fills the same records, whatever its own variables are.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace drillstrand {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Energies in J; work and dissipation since the start of the run.
struct EnergyAccount {
    double kinetic = 0;
    double rotation = 0;   ///< of spin about d3, part of `kinetic`
    double elastic = 0;    ///< strain energy of the rod and of the contact springs
    double springs = 0;    ///< of the contact springs, part of `elastic`
    double potential = 0;  ///< of the buoyed weight; 0 at the start of the run
    /// Leapfrog: by how much what it keeps, 1/2 m v- . v+ of the half steps before and after the
    /// record, exceeds `kinetic`, counted from the first step
    double half_steps = 0;
    double work = 0;         ///< done by the head, the bit and dead loads on the string
    double dissipation = 0;  ///< in damping, fluid, contact dashpots and friction

    [[nodiscard]] double stored() const { return kinetic + half_steps + elastic + potential; }
};

/// The part of the string that goes around the well's axis while it rotates, away from that axis
/// (engine/rod/README.md, "Whirl").
struct Whirl {
    double forward = 0;   ///< share of the string's length that goes around with its rotation
    double backward = 0;  ///< share that goes around against it
    double rate = 0;      ///< rad/s around the well, mean of both; negative against the rotation
    double rolling_rate = 0;  ///< rad/s, at which it would roll along the wall without slip
    double depth = 0;         ///< m, measured depth of its middle
};

/// Quantities of the whole string at one time. Stresses in the order twist moment, bending 1,
/// bending 2 (N m), axial force, shear 1, shear 2 (N).
struct SeriesRecord {
    double time = 0;                                          ///< s
    Vector6 head_stress = Vector6::Zero();                    ///< first segment
    Vector6 bit_stress = Vector6::Zero();                     ///< last segment
    Eigen::Vector3d head_position = Eigen::Vector3d::Zero();  ///< m, NED
    Eigen::Vector3d bit_position = Eigen::Vector3d::Zero();   ///< m, NED
    double head_rotation_rate = 0;                            ///< rad/s about d3
    double bit_rotation_rate = 0;                             ///< rad/s about d3
    double hook_load = 0;          ///< N, force along -d3 that holds the head
    double dead_line_tension = 0;  ///< N, of one line of the hoist; 0 without one
    double surface_torque = 0;     ///< N m, couple about d3 of the drive on the head
    double drive_torque = 0;       ///< N m, of the drive's motor, what turns its inertia included
    double weight_on_bit = 0;      ///< N, compressive force of the rock on the bit
    double bit_torque = 0;         ///< N m, of the rock against the rotation of the bit
    double depth_of_cut = 0;       ///< m that the bit cuts in a turn; 0 by a law that does not tell
    double drilled = 0;            ///< m, of the bit below the bottom at the start; where it drills
    double motor_pressure = 0;     ///< Pa, difference over the mud motor; 0 without one
    double jar_force = 0;          ///< N, tension in the jar's segment; 0 without one
    double jar_travel = 0;         ///< m, of its halves apart
    std::int64_t jar_blows = 0;    ///< of its hammer since the start of the run
    EnergyAccount energy;
    double step_size = 0;             ///< s, of the last step
    double time_error = 0;            ///< relative, of the last sample; 0 with dormand_prince
    double max_penetration = 0;       ///< m, 0 without contact
    double relative_penetration = 0;  ///< largest penetration / clearance of a node
    double penetration_depth = 0;     ///< m, measured depth of the largest penetration
    double helix_penetration = 0;     ///< m, largest that a helix of a node's compression has
    double wall_drag = 0;             ///< N, friction of the wall on the string, down the well
    double drag_depth = 0;            ///< m, measured depth of the middle of that friction
    Whirl whirl;
    std::int64_t contact_nodes = 0;

    // Events since the start of the run. A node that starts in contact has come into contact.
    std::int64_t impacts = 0;          ///< nodes that came into contact
    std::int64_t contact_changes = 0;  ///< nodes that came into or left contact
    std::int64_t slips = 0;            ///< nodes in contact that began to slide
};

/// Quantities of every node (N+1) and segment (N) at one time.
struct Profile {
    double time = 0;                        ///< s
    std::vector<Eigen::Vector3d> position;  ///< nodes, m, NED
    std::vector<Eigen::Vector3d> director;  ///< nodes, d3
    std::vector<Vector6> momentum;          ///< nodes, per length, body axes (d3, d1, d2)
    std::vector<Vector6> stress;            ///< segments, body axes
    std::vector<Eigen::Vector3d> moment;    ///< nodes, N m, body axes: twist moment, bending 1, 2
    std::vector<double> eccentricity;       ///< nodes, m; 0 without a well
    std::vector<double> well_depth;         ///< nodes, m; 0 without a well
    std::vector<double> fluid_mass;  ///< nodes, kg/m: fluid that moves sideways with the pipe
    std::vector<Eigen::Vector3d> contact_force;  ///< nodes, N/m, space frame: wall on pipe
    std::vector<double> normal_force;            ///< nodes, N/m
    std::vector<double> side_force;              ///< nodes, N/m, see side_force.hpp
    std::vector<double> whirl_rate;  ///< nodes, rad/s, with the rotation; 0 of what does not whirl
};

/// What a sensor in the string felt at one time, in axes (d3, d1, d2) that turn with it
/// (engine/rod/README.md, "Sensors").
struct SensorRecord {
    double time = 0;                                           ///< s
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();    ///< m/s2, less that of gravity
    double rotation_rate = 0;                                  ///< rad/s about d3
    Eigen::Vector2d bending_moment = Eigen::Vector2d::Zero();  ///< N m, about d1 and d2
    double torque = 0;   ///< N m, positive where what is above drives a positive rotation
    double tension = 0;  ///< N
};

/// Bending moments of the segments about their own d1 and d2 at one time.
struct BendingRecord {
    double time = 0;                      ///< s
    std::vector<Eigen::Vector2d> moment;  ///< N m
};

struct StepStatistics {
    std::int64_t steps = 0;  ///< accepted
    std::int64_t rejected = 0;
    std::int64_t evaluations = 0;  ///< of the right-hand side
    double smallest_step = 0;      ///< s; steps cut short to meet a record do not count
    double largest_step = 0;       ///< s
    double time_error = 0;         ///< largest sampled, relative; 0 with dormand_prince
};

}  // namespace drillstrand
