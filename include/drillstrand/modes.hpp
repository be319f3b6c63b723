/// Small vibrations of a string about its static state: natural frequencies and shapes, at rest and
/// turning, critical speeds, and the response to harmonic loads. Theory: engine/statics/README.md,
/// "Modes".
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drillstrand/equilibrium.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

/// What most of a mode's kinetic energy is in.
enum class ModeKind : std::int64_t { lateral, torsional, axial };

/// "lateral", "torsional", "axial".
std::string_view mode_kind_name(ModeKind kind);

/// A free vibration: displacements and turns u = Re(q exp(i w t)) about the static state. The
/// largest displacement is 1 m, of a torsional mode the largest turn 1 rad.
struct VibrationMode {
    double frequency = 0;  ///< w (rad/s)
    ModeKind kind = ModeKind::lateral;
    /// Shares of the kinetic energy.
    double lateral_share = 0;
    double torsional_share = 0;
    double axial_share = 0;
    /// 1: its nodes go round on circles with the positive rotation, -1: against it, 0: to and fro.
    double whirl = 0;
    std::int64_t crossings = 0;  ///< places where the string rests, the ends left out
    double bending_place = 0;    ///< along the string, of the largest bending moment (m)
    std::vector<Eigen::Vector3d> displacement;        ///< nodes, t = 0 (m)
    std::vector<Eigen::Vector3d> turn;                ///< nodes, t = 0 (rad)
    std::vector<Eigen::Vector3d> later_displacement;  ///< nodes, a quarter of a period later (m)
    std::vector<Eigen::Vector3d> later_turn;          ///< nodes, a quarter of a period later (rad)
};

/// A mode of a string that turns: one point of the Campbell diagram.
struct CampbellPoint {
    double rotation_rate = 0;  ///< of the string (rad/s)
    double frequency = 0;      ///< of the mode (rad/s)
    ModeKind kind = ModeKind::lateral;
    double whirl = 0;  ///< as VibrationMode has it
};

/// A rate of turning at which an order of it meets a natural frequency.
struct CriticalSpeed {
    double order = 1;          ///< frequency over rate of turning
    double rotation_rate = 0;  ///< of the string (rad/s)
    ModeKind kind = ModeKind::lateral;
    double whirl = 0;  ///< as VibrationMode has it
};

/// What shakes a string, at an order of its rate of turning.
struct Excitation {
    double order = 1;
    bool unbalance = false;  ///< eccentric masses of the string; of order 1
    double bit_force = 0;    ///< amplitude along the bit's axis (N)
    double bit_torque = 0;   ///< amplitude about it (N m)
};

/// Amplitudes of the steady vibration under an excitation: largest values of a period.
struct ForcedResponse {
    double rotation_rate = 0;  ///< of the string (rad/s)
    double frequency = 0;      ///< of the vibration (rad/s)
    /// 1 where the wall would have to pull somewhere: the string lifts off, and the linear response
    /// does not hold.
    std::int64_t lifts_off = 0;
    std::vector<double> displacement;    ///< nodes (m)
    std::vector<double> twist;           ///< nodes, about the axis (rad)
    std::vector<double> side_force;      ///< nodes, of the wall on what touches it (N)
    std::vector<double> bending_moment;  ///< segments, means (N m)
    std::vector<double> torque;          ///< segments (N m)
    std::vector<double> axial_force;     ///< segments (N)
};

/// How nodes that touch the wall hold on to it.
enum class WallGrip {
    slides,  ///< friction is what it is in the static state: of a string that turns
    sticks   ///< friction springs hold them along the well and around it
};

/// What a string vibrates about.
struct StaticShape {
    std::vector<Eigen::Vector3d> position;  ///< nodes, north-east-down (m)
    std::vector<Eigen::Vector3d> director;  ///< nodes, d3
    std::vector<double> side_force;         ///< nodes, of the wall on what touches it (N)
};

class StringVibration {
  public:
    /// Finds the static state. Throws as find_equilibrium() does, and SimulationError where that
    /// state is not stable. The scene must live as long as this.
    StringVibration(const Scene& scene, const EquilibriumOptions& equilibrium, WallGrip grip);
    ~StringVibration();
    StringVibration(const StringVibration&) = delete;
    StringVibration& operator=(const StringVibration&) = delete;

    [[nodiscard]] const StaticShape& static_shape() const;
    /// What a user should know of the static state, a sentence each.
    [[nodiscard]] const std::vector<std::string>& warnings() const;
    /// How many modes a mesh can be asked for: half of its unknowns.
    static std::size_t most_modes(const Scene& scene);

    /// The lowest modes without damping, by ascending frequency, of a string that turns at that
    /// rate (rad/s).
    [[nodiscard]] std::vector<VibrationMode> modes(double rotation_rate, std::size_t count) const;

    /// The lowest `count` modes at each rate (rad/s), rate by rate. `threads` = 0: all cores.
    [[nodiscard]] std::vector<CampbellPoint> campbell(const std::vector<double>& rotation_rates,
                                                      std::size_t count, int threads = 0) const;

    /// The lowest critical speeds of an order (> 0) up to a rate (rad/s), at most `count`; those
    /// of backward whirl too.
    [[nodiscard]] std::vector<CriticalSpeed> critical_speeds(double order, double highest_rate,
                                                             std::size_t count) const;
    /// How many there are up to that rate.
    [[nodiscard]] std::size_t count_critical_speeds(double order, double highest_rate) const;

    /// The response at each rate (rad/s), with the damping of the case.
    [[nodiscard]] std::vector<ForcedResponse> response(const Excitation& excitation,
                                                       const std::vector<double>& rotation_rates,
                                                       int threads = 0) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace drillstrand
