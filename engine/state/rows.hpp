/// Everything that a run changes, one line each: the rows of nodes and segments, the two ends, the
/// accounts and the clock. A run is its constants, this state and scratch space; a checkpoint is
/// the lines marked `kept` (engine/state/README.md).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/saved_state.hpp"
#include "state/fields.hpp"
#include "state/table.hpp"

namespace drillstrand {

// ------------------------------------------------------------------ rod

/// The rod of the leapfrog. Positions and directors belong to whole steps, velocities to the half
/// step before; vectors are in the space frame.
enum class DirectorRow {
    position,
    velocity,
    director,
    angular_velocity,
    last_director,
    spin,
    material,
    last_twist
};
// clang-format off
template <>
inline constexpr auto row_list<DirectorRow> = std::to_array<RowInfo<DirectorRow>>({
    {DirectorRow::position,         "position",         "m",     3, Extent::nodes,    Keep::kept, "director_nodes: x"},
    {DirectorRow::velocity,         "velocity",         "m/s",   3, Extent::nodes,    Keep::kept, "director_nodes: v"},
    {DirectorRow::director,         "director",         "1",     3, Extent::nodes,    Keep::kept, "director_nodes: t, unit"},
    {DirectorRow::angular_velocity, "angular_velocity", "rad/s", 3, Extent::nodes,    Keep::kept, "director_nodes: Om, normal to t"},
    {DirectorRow::last_director,    "last_director",    "1",     3, Extent::nodes,    Keep::kept, "director_nodes: t of the step before"},
    {DirectorRow::spin,             "spin",             "rad/s", 1, Extent::nodes,    Keep::kept, "director_nodes: s = w . t"},
    {DirectorRow::material,         "material",         "1",     3, Extent::nodes,    Keep::kept, "director_nodes: d1, followed only where a stress-free shape is curved"},
    {DirectorRow::last_twist,       "last_twist",       "1/m",   1, Extent::segments, Keep::kept, "director_nodes: tau of the step before, stress-free twist included"},
});
// clang-format on

/// The rod of dormand-prince, or its rate: momenta per length and stresses in body axes (d3, d1,
/// d2).
enum class StrandRow { angular_momentum, linear_momentum, moment, force };
// clang-format off
template <>
inline constexpr auto row_list<StrandRow> = std::to_array<RowInfo<StrandRow>>({
    {StrandRow::angular_momentum, "angular_momentum", "kg m/s", 3, Extent::nodes,    Keep::kept, "stage_state: Pi"},
    {StrandRow::linear_momentum,  "linear_momentum",  "kg/s",   3, Extent::nodes,    Keep::kept, "stage_state: p"},
    {StrandRow::moment,           "moment",           "N m",    3, Extent::segments, Keep::kept, "stage_state: m"},
    {StrandRow::force,            "force",            "N",      3, Extent::segments, Keep::kept, "stage_state: n"},
});
// clang-format on

// ------------------------------------------------------------------ wall

/// The well around each node: the arc that it is in, and its contact with the wall. Both
/// integrators.
enum class WallRow {
    arc,
    start,
    tangent,
    normal_to_axis,
    curvature,
    hole,
    stiffness,
    damping,
    hole_start,
    widening,
    stiffness_start,
    stiffening,
    static_axial,
    static_azimuthal,
    dynamic_axial,
    dynamic_azimuthal,
    end_cosine,
    reach,
    concentric_axial,
    cross_flow,
    swirl,
    swirl_reynolds,
    stream,
    fluid_mass,
    elongation_axial,
    elongation_azimuthal,
    sliding,
    depth,
    normal,
    slip_axial,
    slip_azimuthal,
    rolling,
    leaves,
    rebounds,
    touched,
    slid
};
// clang-format off
template <>
inline constexpr auto row_list<WallRow> = std::to_array<RowInfo<WallRow>>({
    {WallRow::arc,                  "arc",                  "1",    1, Extent::nodes, Keep::kept,    "enter_arc: number of the arc of well"},
    {WallRow::start,                "start",                "m",    3, Extent::nodes, Keep::derived, "enter_arc: first point of its axis"},
    {WallRow::tangent,              "tangent",              "1",    3, Extent::nodes, Keep::derived, "enter_arc: its unit tangent there"},
    {WallRow::normal_to_axis,       "normal_to_axis",       "1",    3, Extent::nodes, Keep::derived, "enter_arc: its unit normal there, toward the centre"},
    {WallRow::curvature,            "curvature",            "1/m",  1, Extent::nodes, Keep::derived, "enter_arc: of the arc"},
    {WallRow::hole,                 "hole",                 "m",    1, Extent::nodes, Keep::kept,    "enter_arc, node kernels where it varies: radius of the hole"},
    {WallRow::stiffness,            "stiffness",            "Pa",   1, Extent::nodes, Keep::kept,    "enter_arc, node kernels where it varies: k_el"},
    {WallRow::damping,              "damping",              "Pa s", 1, Extent::nodes, Keep::derived, "enter_arc: eta_el"},
    {WallRow::hole_start,           "hole_start",           "m",    1, Extent::nodes, Keep::derived, "enter_arc: radius of the hole at the arc's first point"},
    {WallRow::widening,             "widening",             "1",    1, Extent::nodes, Keep::derived, "enter_arc: growth of the radius along the arc"},
    {WallRow::stiffness_start,      "stiffness_start",      "Pa",   1, Extent::nodes, Keep::derived, "enter_arc: k_el at the arc's first point"},
    {WallRow::stiffening,           "stiffening",           "Pa/m", 1, Extent::nodes, Keep::derived, "enter_arc: its growth along the arc"},
    {WallRow::static_axial,         "static_axial",         "1",    1, Extent::nodes, Keep::derived, "enter_arc: friction coefficient of the section, sticking, along l"},
    {WallRow::static_azimuthal,     "static_azimuthal",     "1",    1, Extent::nodes, Keep::derived, "enter_arc: likewise along t"},
    {WallRow::dynamic_axial,        "dynamic_axial",        "1",    1, Extent::nodes, Keep::derived, "enter_arc: sliding, along l"},
    {WallRow::dynamic_azimuthal,    "dynamic_azimuthal",    "1",    1, Extent::nodes, Keep::derived, "enter_arc: sliding, along t"},
    {WallRow::end_cosine,           "end_cosine",           "1",    1, Extent::nodes, Keep::derived, "enter_arc: cosine of the arc's total angle"},
    {WallRow::reach,                "reach",                "m",    1, Extent::nodes, Keep::derived, "enter_arc: its sine / curvature"},
    {WallRow::concentric_axial,     "concentric_axial",     "1",    1, Extent::nodes, Keep::derived, "enter_arc: axial drag coefficient where it is concentric, else 0"},
    {WallRow::cross_flow,           "cross_flow",           "N s2/m3", 1, Extent::nodes, Keep::derived, "enter_arc: inertial drag across, over speed squared"},
    {WallRow::swirl,                "swirl",                "kg m", 1, Extent::nodes, Keep::derived, "enter_arc: inertial couple against spin, over spin squared and its coefficient"},
    {WallRow::swirl_reynolds,       "swirl_reynolds",       "s",    1, Extent::nodes, Keep::derived, "enter_arc: Reynolds number of the rotation over the spin"},
    {WallRow::stream,               "stream",               "kg/m^1.75 s^-0.25", 1, Extent::nodes, Keep::derived, "enter_arc: inertial drag along, over speed^1.75"},
    {WallRow::fluid_mass,           "fluid_mass",           "kg/m", 1, Extent::nodes, Keep::kept,    "leapfrog: node kernel, dormand-prince: accept; fluid that moves sideways with the pipe"},
    {WallRow::elongation_axial,     "elongation_axial",     "m",    1, Extent::nodes, Keep::kept,    "friction: spring along l"},
    {WallRow::elongation_azimuthal, "elongation_azimuthal", "m",    1, Extent::nodes, Keep::kept,    "friction: spring along t"},
    {WallRow::sliding,              "sliding",              "1",    1, Extent::nodes, Keep::kept,    "friction: 1 where the surface point slides, else 0"},
    {WallRow::depth,                "depth",                "m",    1, Extent::nodes, Keep::kept,    "node kernels: penetration, negative in the open hole"},
    {WallRow::normal,               "normal",               "N/m",  1, Extent::nodes, Keep::kept,    "node kernels: normal force"},
    {WallRow::slip_axial,           "slip_axial",           "m/s",  1, Extent::nodes, Keep::kept,    "strand's node kernel: velocity of the surface point along l"},
    {WallRow::slip_azimuthal,       "slip_azimuthal",       "m/s",  1, Extent::nodes, Keep::kept,    "strand's node kernel: velocity of the surface point along t"},
    {WallRow::rolling,              "rolling",              "m/s",  1, Extent::nodes, Keep::kept,    "strand's node kernel: speed of the contact along the wall"},
    {WallRow::leaves,               "leaves",               "1",    1, Extent::nodes, Keep::kept,    "node kernels: 1 where the foot has left the arc, else 0"},
    {WallRow::rebounds,             "rebounds",             "1",    1, Extent::nodes, Keep::kept,    "director_nodes: 1 where an impact sent the node back and it is still in the wall, else 0"},
    {WallRow::touched,              "touched",              "1",    1, Extent::nodes, Keep::kept,    "dormand-prince: 1 where the node touched after the last step"},
    {WallRow::slid,                 "slid",                 "1",    1, Extent::nodes, Keep::kept,    "dormand-prince: 1 where the node slid after the last step"},
});
// clang-format on

// ------------------------------------------------------------------ ends

/// The head (rod/head.hpp).
struct HeadState {
    Eigen::Vector3d d1 = Eigen::Vector3d::Zero();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector4d quaternion = Eigen::Vector4d::Zero();
    double angle = 0;
    double lag = 0;
    double drive_torque = 0;
    double stretch = 0;
    double off_bottom_load = 0;
    Eigen::Vector4d resets = Eigen::Vector4d::Zero();
    double work = 0;
};
// clang-format off
template <>
inline constexpr auto field_list<HeadState> = std::to_array<Field<HeadState>>({
    {&HeadState::d1,         "d1",         "1", "leapfrog, head that tilts: a direction that goes along with its section"},
    {&HeadState::position,   "position",   "m", "dormand-prince, head that moves: x"},
    {&HeadState::quaternion, "quaternion", "1", "dormand-prince, head that moves or tilts: frame, (x, y, z, w)"},
    {&HeadState::angle,      "angle",      "rad", "drive: turn about d3 since the start"},
    {&HeadState::lag,        "lag",        "rad", "drive: integral of set rate less rate, as its control counts it"},
    {&HeadState::drive_torque, "drive_torque", "N m", "drive: of the motor, mean over the last step"},
    {&HeadState::stretch,    "stretch",    "m", "hoist: of its lines by what they carry; negative: slack"},
    {&HeadState::off_bottom_load, "off_bottom_load", "N", "autodriller: hook load with the bit off bottom"},
    {&HeadState::resets,     "resets",     "m/s", "autodriller: drum speed to which each loop comes back: weight, rate, torque, pressure"},
    {&HeadState::work,       "work",       "J", "done by the outside on the rod at its head"},
});
// clang-format on

/// The bit (rod/bit.hpp).
struct BitState {
    Eigen::Vector3d d1 = Eigen::Vector3d::Zero();
    double torque = 0;
    double sticks = 0;
    double rotor_speed = 0;
    double rotor_torque = 0;
    double even_pressure = 0;
    double odd_pressure = 0;
    double work = 0;
};
// clang-format off
template <>
inline constexpr auto field_list<BitState> = std::to_array<Field<BitState>>({
    {&BitState::d1,   "d1",   "1", "leapfrog: a direction that goes along with its section"},
    {&BitState::torque, "torque", "N m", "bit law: of the rock against a positive rotation, in the last step"},
    {&BitState::sticks, "sticks", "1", "bit law: 1 where the bit stands still on the rock, else 0"},
    {&BitState::rotor_speed, "rotor_speed", "rad/s", "mud motor: of rotor and bit"},
    {&BitState::rotor_torque, "rotor_torque", "N m", "mud motor: on the rotor, in the last step"},
    {&BitState::even_pressure, "even_pressure", "Pa", "mud motor: difference over it in the last even step, for the head to read"},
    {&BitState::odd_pressure, "odd_pressure", "Pa", "mud motor: likewise in the last odd one"},
    {&BitState::work, "work", "J", "done by the outside on the rod at its bit"},
});
// clang-format on

/// The rock under a bit that cuts it, all angles alike from blade to blade.
struct RockState {
    double depth = 0;
    double way = 0;
    double place = 0;
    double beyond = 0;
    double last_surface = 0;
    double flat_weight = 0;
    double bottom = 0;
    double turn = 0;
    std::vector<double> surface = {0.0};
};
// clang-format off
template <>
inline constexpr auto field_list<RockState> = std::to_array<Field<RockState>>({
    {&RockState::depth, "depth", "m", "bit law: of the blades below the bottom at the start"},
    {&RockState::way, "way", "1", "bit law: 1 where it turned on, -1 where back; 0 without rock"},
    {&RockState::place, "place", "1", "bit law: number of the last place that a blade passed, or of where it turned back"},
    {&RockState::beyond, "beyond", "1", "bit law: what the blades are beyond it, in places"},
    {&RockState::last_surface, "last_surface", "m", "bit law: depth of the rock there before it was cut"},
    {&RockState::flat_weight, "flat_weight", "N", "bit law: on the wear flats in the last step"},
    {&RockState::bottom, "bottom", "m", "roller cones: depth of the bottom, its lobes in the mean"},
    {&RockState::turn, "turn", "rad", "roller cones: of the bit past a crest, from lobe to lobe"},
    {&RockState::surface, "surface", "m", "bit law: depth of the rock at places from blade to blade; one number without rock"},
});
// clang-format on

// ------------------------------------------------------------------ jar

/// A jar in the string (rod/jar.hpp).
struct JarState {
    double released = 0;
    double overpulled = 0;
    double slide = 0;
    double blows = 0;
    double work = 0;
};
// clang-format off
template <>
inline constexpr auto field_list<JarState> = std::to_array<Field<JarState>>({
    {&JarState::released, "released", "1", "jar: 1 where its halves slide, 0 where they are latched"},
    {&JarState::overpulled, "overpulled", "s", "jar: for how long the force has been above its limit; negative: below"},
    {&JarState::slide, "slide", "m", "jar: of its halves apart, from where they latch"},
    {&JarState::blows, "blows", "1", "jar: of the hammer since the start"},
    {&JarState::work, "work", "J", "jar: taken from the rod by tripping and latching"},
});
// clang-format on

// ------------------------------------------------------------------ accounts

/// What happened to stretches of nodes that one thread takes, each in its own entry: sums do not
/// depend on the number of threads.
struct Accounts {
    std::vector<double> outflow;
    std::vector<double> impacts;
    std::vector<double> slips;

    Accounts() = default;
    explicit Accounts(std::size_t stretches)
        : outflow(stretches), impacts(stretches), slips(stretches) {}

    /// Takes entries over from other accounts: `first` to the one before `end`.
    void take(const Accounts& other, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            outflow[i] = other.outflow[i];
            impacts[i] = other.impacts[i];
            slips[i] = other.slips[i];
        }
    }

    /// Whether impacts and slips are counts, that a record can hold.
    [[nodiscard]] bool are_counts() const {
        double sum = 0;
        for (const auto* counts : {&impacts, &slips}) {
            for (const double count : *counts) {
                if (!(count >= 0)) return false;
                sum += count;
            }
        }
        return sum <= largest_whole_number;
    }
};
// clang-format off
template <>
inline constexpr auto field_list<Accounts> = std::to_array<Field<Accounts>>({
    {&Accounts::outflow, "outflow", "J", "energy given to surroundings and damping"},
    {&Accounts::impacts, "impacts", "1", "nodes that came into contact"},
    {&Accounts::slips,   "slips",   "1", "nodes in contact that began to slide"},
});
// clang-format on

/// Energies of the first instant, from which records count.
struct EnergyOrigin {
    double head = 0;
    double potential = 0;
    double springs = 0;
    double half_steps = 0;
};
// clang-format off
template <>
inline constexpr auto field_list<EnergyOrigin> = std::to_array<Field<EnergyOrigin>>({
    {&EnergyOrigin::head,      "head",      "J", "start: kinetic energy of a driven head's node"},
    {&EnergyOrigin::potential, "potential", "J", "start: of weight"},
    {&EnergyOrigin::springs,   "springs",   "J", "start: of the springs of the wall"},
    {&EnergyOrigin::half_steps, "half_steps", "J", "leapfrog, first step: what its first half kick gives"},
});
// clang-format on

// clang-format off
template <>
inline constexpr auto field_list<StepStatistics> = std::to_array<Field<StepStatistics>>({
    {&StepStatistics::steps,         "steps",         "1", "accepted"},
    {&StepStatistics::rejected,      "rejected",      "1", "step control"},
    {&StepStatistics::evaluations,   "evaluations",   "1", "of the right-hand side"},
    {&StepStatistics::smallest_step, "smallest_step", "s", "not counting those cut short to meet a record"},
    {&StepStatistics::largest_step,  "largest_step",  "s", "likewise"},
});
// clang-format on

// ------------------------------------------------------------------ clocks

/// The clock of the leapfrog: equal steps that meet the end of a course exactly, also where they
/// are taken in several pieces.
struct Course {
    double start = 0;
    double end = 0;
    std::int64_t steps = 0;
    std::int64_t done = 0;

    [[nodiscard]] double step() const { return (end - start) / static_cast<double>(steps); }
    [[nodiscard]] double time(std::int64_t taken) const {
        return taken == steps ? end : start + static_cast<double>(taken) * step();
    }
};
// clang-format off
template <>
inline constexpr auto field_list<Course> = std::to_array<Field<Course>>({
    {&Course::start, "start", "s", "leapfrog"},
    {&Course::end,   "end",   "s", "leapfrog"},
    {&Course::steps, "steps", "1", "leapfrog: from start to end"},
    {&Course::done,  "done",  "1", "leapfrog: of these, taken"},
});
// clang-format on

struct Clock {
    double time = 0;
    double last_step = 0;
    double proposed_step = 0;
};
// clang-format off
template <>
inline constexpr auto field_list<Clock> = std::to_array<Field<Clock>>({
    {&Clock::time,          "time",          "s", "of the last whole step"},
    {&Clock::last_step,     "last_step",     "s", "length of the last step"},
    {&Clock::proposed_step, "proposed_step", "s", "dormand-prince: step control"},
});
// clang-format on

/// The sampled time error of a leapfrog run (integrators/time_error.hpp).
struct TimeError {
    std::int64_t due = 0;
    double scale = 0;
    double factor = 1;
    double latest = 0;
    double largest = 0;
    double largest_time = 0;
    std::int64_t missed = 0;
};
// clang-format off
template <>
inline constexpr auto field_list<TimeError> = std::to_array<Field<TimeError>>({
    {&TimeError::due,          "due",          "1", "steps of the run before the next sample"},
    {&TimeError::scale,        "scale",        "J", "largest energy so far"},
    {&TimeError::factor,       "factor",       "1", "of the longest stable step"},
    {&TimeError::latest,       "latest",       "1", "relative error of the latest sample"},
    {&TimeError::largest,      "largest",      "1", "of the largest"},
    {&TimeError::largest_time, "largest_time", "s", "when that was"},
    {&TimeError::missed,       "missed",       "1", "1 where the tolerance was missed"},
});
// clang-format on

/// The coarsest segment for its buckle that a run has met (integrators/guards.hpp).
struct CoarsestSegment {
    double coarseness = 0;
    std::int64_t segment = 0;
    double time = 0;
};
// clang-format off
template <>
inline constexpr auto field_list<CoarsestSegment> = std::to_array<Field<CoarsestSegment>>({
    {&CoarsestSegment::coarseness, "coarseness", "1", "guards: (h / helical pitch)^2"},
    {&CoarsestSegment::segment,    "segment",    "1", "guards: its number"},
    {&CoarsestSegment::time,       "time",       "s", "guards: when it was met"},
});
// clang-format on

}  // namespace drillstrand
