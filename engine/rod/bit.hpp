/// The bit: weight, torque and the dead and follower loads of a case, on the rod and as work, and
/// the law of the rock on it (engine/rod/README.md, "Bit and rock"). Its own constants and its
/// state (BitState and RockState, state/rows.hpp).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

#include "drillstrand/case.hpp"
#include "drillstrand/records.hpp"
#include "drillstrand/scene.hpp"
#include "rod/cutting.hpp"
#include "rod/director.hpp"
#include "rod/end.hpp"
#include "rod/motor.hpp"
#include "rod/roller_cone.hpp"
#include "state/rows.hpp"

namespace drillstrand {

/// What the load at the bit depends on.
struct BitMotion {
    Eigen::Matrix3d frame;           ///< d3, d1, d2 in the columns
    Eigen::Vector3d well_direction;  ///< down the well at the bit; d3 where there is none
    double opposed_rate;             ///< whose sense the torque opposes (Head::opposed_rate, rad/s)
};

/// Radius of the bit (m).
double bit_radius(const Scene& scene);

/// What a bit that drills presses like a spring (N/m); 0 by other laws.
double rock_stiffness(const Scene& scene);

class Bit {
  public:
    explicit Bit(const Scene& scene);
    /// A bit of that radius (m) on the node of that number.
    Bit(BitCase loads, double radius, std::size_t node = 0)
        : node_(node), radius_(radius), loads_(std::move(loads)) {}

    [[nodiscard]] const BitCase& loads() const { return loads_; }
    /// Whether the bit's own rate tells the torque, by the law or since a motor turns it.
    [[nodiscard]] bool turns_by_itself() const {
        return loads_.law != BitLaw::prescribed || motor_;
    }
    /// Whether the rock gives way as the bit presses and turns.
    [[nodiscard]] bool drills() const { return loads_.drills(); }

    /// Torque that opposes rotation at a steady rate of full speed (N m): the schedule's, or
    /// mu_b (pi R / 4) times the weight (paper eq. 15).
    [[nodiscard]] double full_torque(double time) const;
    /// The same at a rate, with its sense (N m): positive where it opposes a positive rate. Of a
    /// law with friction: at a steady rate, 0 at rest; a motor passes on no more than it has.
    [[nodiscard]] double torque(double opposed_rate, double time) const;
    /// Rate of the bit (rad/s) while the string's end turns steadily: a motor adds its own.
    [[nodiscard]] double steady_rate(double string_rate, double time) const;

    /// Stress that the outside imposes at the bit, in body axes (paper eqs. 13-14).
    [[nodiscard]] Vector6 stress(const BitMotion& motion, double time) const;
    /// The same in the space frame, as a load.
    [[nodiscard]] EndLoad load(const BitMotion& motion, double time) const;

    // ---- on directors; `well_direction` as in BitMotion

    [[nodiscard]] BitState start(const Eigen::Vector3d& d1) const {
        BitState bit;
        bit.d1 = d1;
        bit.sticks = turns_by_itself() ? 1 : 0;
        return bit;
    }
    [[nodiscard]] RockState start_on_rock() const;
    /// What the rock presses against the bit with (N).
    [[nodiscard]] double weight(const RockState& rock, double time) const;
    /// Depth that the bit cuts in a turn (m); 0 by a law that does not tell.
    [[nodiscard]] double depth_of_cut(const RockState& rock) const;

    /// Rate of the bit (rad/s) at a spin of the string's end.
    [[nodiscard]] double rate(const BitState& bit, double spin) const {
        return motor_ ? bit.rotor_speed : spin;
    }
    /// Difference of pressure over the motor (Pa) in the last step; 0 without one.
    [[nodiscard]] double motor_pressure(const BitState& bit) const {
        return motor_ ? motor_->pressure(bit.rotor_torque) : 0.0;
    }
    /// The same in the step before one, whoever takes part in that.
    [[nodiscard]] static double last_motor_pressure(const BitState& bit, const DirectorStep& step) {
        return step.number % 2 == 0 ? bit.odd_pressure : bit.even_pressure;
    }

    /// The load as a ghost segment behind the last.
    void load(const BitState& bit, const RockState& rock, Table<SegmentRow>& segments,
              const Table<DirectorRow>& rod, const Eigen::Vector3d& well_direction,
              double opposed_rate, double time) const;
    /// The rock's answer to the bit's motion in a step, by the law: velocity and spin of `next` so
    /// far are those which the answer of the step before leaves.
    void resist(BitState& bit, RockState& rock, const Table<DirectorRow>& rod,
                Table<DirectorRow>& next, const Eigen::Vector3d& well_direction,
                const DirectorStep& step) const;
    /// The end of a step: the work at the bit, its frame, the rock that it cut, and the padding
    /// node beyond it, which goes along so that the ghost segment stays without strain.
    void finish(BitState& bit, RockState& rock, const Table<SegmentRow>& segments,
                const Table<DirectorRow>& rod, Table<DirectorRow>& next,
                const Eigen::Vector3d& well_direction, const DirectorStep& step) const;

  private:
    /// As stress(), without the torque of the rock.
    [[nodiscard]] Vector6 stress_of_schedules(const BitMotion& motion, double time) const;
    /// Calls `use` with the law of the rock that is drilled; `otherwise` where there is none.
    template <class Use, class Result>
    [[nodiscard]] Result of_rock(const Use& use, Result otherwise) const {
        return drilling_ ? std::visit(use, *drilling_) : otherwise;
    }
    /// Friction at a speed (rad/s, positive; N m): law stribeck, or the full torque as scheduled.
    [[nodiscard]] double friction(double speed, double time) const;
    /// The largest speed (rad/s) that friction leaves of a free one in a step of `mobility` = time
    /// over inertia; 0 where it leaves none.
    [[nodiscard]] double speed_left(double free_speed, double mobility, double time) const;
    /// What turns on the rock, before and after a step.
    struct Turning {
        double before;    ///< rad/s
        double free;      ///< rad/s, were there no rock
        double mobility;  ///< time over inertia (1/(N m))
    };
    /// The spin that a law leaves of a free one.
    [[nodiscard]] double spin_left(const BitState& bit, const RockState& rock,
                                   const Turning& turning, double time) const;
    /// The rock's answer to what turns on it; returns the spin that it leaves.
    double turn_on_rock(BitState& bit, const RockState& rock, const Turning& turning,
                        double time) const;
    /// The same of a motor's rotor, which the string's end holds: the spin of that.
    double turn_rotor(BitState& bit, const RockState& rock, const Turning& end,
                      const DirectorStep& step) const;
    /// Presses the wear flats against the rock: as much as stops them, and no more than it bears.
    void press_flats(BitState& bit, RockState& rock, const Table<DirectorRow>& rod,
                     Table<DirectorRow>& next, const Eigen::Vector3d& down,
                     const DirectorStep& step) const;
    /// Unit vector that weight acts against, at a director.
    [[nodiscard]] Eigen::Vector3d down(const Eigen::Vector3d& director,
                                       const Eigen::Vector3d& well_direction) const {
        return loads_.direction == BitDirection::follower ? director : well_direction;
    }

    std::size_t node_;
    double radius_;                ///< m
    double inertia_ = 0;           ///< of its node, which turns with it (kg m2)
    double mass_ = 0;              ///< of its node's cell (kg)
    bool material_turns_ = false;  ///< rows of the string hold a direction that turns with it
    BitCase loads_;
    std::optional<std::variant<Cutting, RollerCone>> drilling_;
    std::optional<Motor> motor_;
};

}  // namespace drillstrand
