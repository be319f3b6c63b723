/// A short pipe in a straight hole: what the validation of contact, friction and drag shares.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "support/both_integrators.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {

/// The pipe of the paper's table 3 in its hole: 0.14 m by 0.12 m, 31.8557 kg/m, 0.22 m.
inline constexpr double pipe_mass = 31.8557;  // kg/m
inline constexpr double pipe_radius = 0.07;   // m
inline constexpr double hole_radius = 0.11;   // m
inline constexpr double clearance = hole_radius - pipe_radius;
inline constexpr double pipe_length = 10;  // m
inline constexpr double spin_inertia =     // rho Ip (kg m): m (D^2 + d^2) / 8
    pipe_mass * (0.14 * 0.14 + 0.12 * 0.12) / 8;

/// Down a straight well of the given inclination (rad) and azimuth north, and toward its low side.
Eigen::Vector3d down_the_well(double inclination);
Eigen::Vector3d low_side(double inclination);

/// Ten metres of that pipe, one segment, both ends free, at rest on the axis of the well. One
/// segment under equal loads at both ends moves as a rigid body. No fluid; g = 9.81 m/s2.
Case short_pipe(IntegratorKind integrator, double inclination);

/// How deep a load (N/m) presses the pipe into the wall (m).
double depth_under(double load, const ContactCase& contact);

/// Lays the pipe on the low side of the well, in the wall as deep as its weight presses it.
void lay_down(Case& input, double inclination);

/// Dead load (N/m) and couple (N) per length as functions of time, sampled every `step` (s) up to
/// `end`, half of them at each end.
void load(Case& input, double end, double step, const std::function<Eigen::Vector3d(double)>& force,
          const std::function<Eigen::Vector3d(double)>& couple);

/// 515 m of casing, 52.0925 kg/m, that hang in a vertical hole of 0.3111 m full of a fluid and come
/// to rest within 8 s.
Case hanging_casing(IntegratorKind integrator, const FluidCase& fluid);

/// Pushes a pipe at rest to the East within 0.1 s, to a momentum per length (kg/s).
void push_east(Case& input, double momentum);

/// A pipe without weight and friction that a push of 0.1 s sends from the axis of a vertical well
/// to the East at this speed (m/s); both ends reach the wall in the same step.
Case thrown_pipe(IntegratorKind integrator, double speed);

/// Speed of such a pipe toward East, d1 (m/s).
double speed_east(const Profile& profile);

/// From 0 to 1 without corners between two times.
double smooth_step(double time, double begin, double end);

/// Spin of the pipe at its head (rad/s).
double spin(const Profile& profile);

/// A weightless pipe in a vertical well, which a load that goes around carries along the
/// wall: a turn a second from 2 s on, until 4 s.
Case pipe_carried_around(IntegratorKind integrator, const ContactCase& contact);

/// Angles around the well and about the pipe's own axis, over the last second of such a run (rad).
struct Rolling {
    double whirled = 0;
    double spun = 0;
};
Rolling rolled_around(const Run& run);

/// Whirl over spin of a pipe that rolls around the well as deep in the wall as that load presses
/// it.
double pure_rolling(const ContactCase& contact);

}  // namespace drillstrand::test
