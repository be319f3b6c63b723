/// A case: everything a case file says, as plain validated values in SI units.
/// The keys, their defaults and their ranges are documented in engine/input/KEYS.md.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drillstrand/schedule.hpp"

namespace drillstrand {

using ScalarSchedule = Schedule<double>;
using VectorSchedule = Schedule<Eigen::Vector3d>;

/// One line of a survey.
struct SurveyStation {
    double measured_depth = 0;  ///< m along the hole
    double inclination = 0;     ///< rad from the vertical, 0..pi
    double azimuth = 0;         ///< rad clockwise from north
};

/// Friction coefficients along the well and around it.
struct FrictionCoefficients {
    double axial = 0;
    double azimuthal = 0;
};

/// A stretch of well of one kind: a casing, or the hole of one bit. What it leaves open is as the
/// contact of the case has it.
struct WellSectionCase {
    double to = 0;                            ///< measured depth of its end (m)
    double diameter = 0;                      ///< at its start (m)
    std::optional<double> end_diameter = {};  ///< where it varies, linearly (m)
    std::string name = {};
    std::optional<FrictionCoefficients> static_friction = {};
    std::optional<FrictionCoefficients> dynamic_friction = {};
    std::optional<double> normal_stiffness = {};  ///< Pa, per length
};

struct WellCase {
    std::vector<SurveyStation> survey;      ///< at least two, ascending measured depth
    std::vector<WellSectionCase> sections;  ///< ascending; the last one also holds below its end
};

enum class InsideOfPipe { fluid, empty };
enum class AxialDrag { eccentric, concentric };
enum class FlowRegime { inertial, laminar };

struct FluidCase {
    double density = 0;       ///< kg/m3
    double viscosity = 0;     ///< Pa s; of a Herschel-Bulkley fluid its consistency (Pa s^n)
    double yield_stress = 0;  ///< Pa
    double flow_index = 1;    ///< n: stress = yield + consistency rate^n
    double flow_rate = 0;     ///< pumped down the string (m3/s)
    double nozzle_area = 0;   ///< of the bit (m2); 0: no loss there
    double trip_speed = 0;    ///< of trips, in statics (m/s); 0: they move no mud
    InsideOfPipe inside = InsideOfPipe::fluid;
    bool drag = true;
    AxialDrag axial_drag = AxialDrag::eccentric;  ///< concentric: the paper
    double film = 0.01;  ///< the film never counts as thinner than this fraction of the clearance
    FlowRegime regime = FlowRegime::inertial;  ///< laminar: the paper
    double drag_coefficient = 1.0;             ///< of cross flow, inertial regime
    bool contact_drag = true;  ///< a pipe that touches the wall is dragged too; false: the paper
    bool added_mass = true;    ///< fluid moves sideways with the pipe; false: the paper

    [[nodiscard]] bool is_newtonian() const { return yield_stress == 0 && flow_index == 1; }
};

/// Tool joints of a pipe that is screwed together of pieces of one length. Its ends are joints too.
struct ToolJoints {
    double spacing = 0;         ///< length of a piece with its joint (m)
    double outer_diameter = 0;  ///< m
    double inner_diameter = 0;  ///< m
    double length = 0;          ///< of pin and box together (m); 0: joints touch, but are no steel
};

/// A place of a component that touches the wall with a diameter of its own: the blades of a
/// stabiliser, the gauge of a bit.
struct ContactPoint {
    double position = 0;              ///< from the component's upper end (m)
    double diameter = 0;              ///< m
    double length = 0;                ///< of wall that it touches (m)
    std::optional<double> stiffness;  ///< of that wall (Pa)
};

/// A kink of a component that is not stressed.
struct BentPlace {
    double position = 0;  ///< from the component's upper end (m)
    double angle = 0;     ///< rad
    double toolface = 0;  ///< of the side that it bends to: from d1 to d2 (rad)
};

/// A mass that lies beside the axis, on the side of d1.
struct Eccentricity {
    double position = 0;  ///< from the component's upper end (m)
    double moment = 0;    ///< mass times distance from the axis (kg m)
};

/// A jar: above a force its two halves slide apart, or together, until the hammer strikes.
struct JarCase {
    double position = 0;     ///< from the component's upper end (m)
    double up_force = 0;     ///< tension above which it trips (N); 0: never
    double up_travel = 0;    ///< m, from where it is latched to the blow upward
    double down_force = 0;   ///< compression above which it trips (N); 0: never
    double down_travel = 0;  ///< m, to the blow downward
    double delay = 0;        ///< for which the force must last, as the oil is metered through (s)
};

/// A stretch of pipe of one kind.
struct Component {
    std::string name;
    double length = 0;          ///< m
    double outer_diameter = 0;  ///< m; 0 where every section property is given outright
    double inner_diameter = 0;  ///< m
    double linear_density = 0;  ///< kg/m, tool joints included
    /// kg/m3, from which the displaced volume follows; unset: that follows from the diameters
    std::optional<double> material_density;
    double youngs_modulus = 0;  ///< Pa
    double poisson_ratio = 0.3;
    double yield_strength = 900e6;                        ///< Pa
    Eigen::Vector3d curvature = Eigen::Vector3d::Zero();  ///< stress-free twist, bend1, bend2 (1/m)
    std::optional<double> bending_stiffness;              ///< N m2
    std::optional<double> torsional_stiffness;            ///< N m2
    std::optional<double> axial_stiffness;                ///< N
    std::optional<double> shear_stiffness;                ///< N
    std::optional<double> inertia;                        ///< about a diameter, per length (kg m)
    std::optional<double> polar_inertia;                  ///< about the axis, per length (kg m)
    std::optional<ToolJoints> joints;
    std::optional<ContactPoint> contact;
    std::optional<BentPlace> bend;
    std::optional<Eccentricity> eccentric;
    std::optional<JarCase> jar;
    std::optional<double> element_length;  ///< largest length of segments in it (m)
};

struct StringCase {
    double shear_coefficient = 1.0;
    std::vector<Component> components;  ///< head to bit
};

/// Length of all components (m).
double total_length(const StringCase& string);

/// A stretch of string with segments of its own length.
struct MeshRefinement {
    double from = 0;            ///< along the string (m)
    double to = 0;              ///< m
    bool from_the_bit = false;  ///< places count upward from the bit
    double element_length = 0;  ///< largest (m)
};

/// Either segments of one length, or nodes where the string has its places, with segments between
/// them that are at most so long.
struct MeshCase {
    int segments = 0;            ///< of one length; 0: nodes follow the string
    double element_length = 0;   ///< where they do: largest length of a segment (m)
    int segments_per_joint = 2;  ///< between tool joints, at least
    std::vector<MeshRefinement> refine;
    bool segment_inertia = false;  ///< dormand-prince: rotary inertia of rigid pieces
};

enum class HeadMotion {
    driven,  ///< place, directions and turn are prescribed
    pinned,  ///< stays in its place and turns about d3 as prescribed, free to tilt
    free,    ///< loaded by dead forces
};

/// How a top drive makes the head follow its set rate.
enum class DriveControl {
    stiff,    ///< follows as far as its limits allow
    pi,       ///< torque = proportional e + integral of e
    tuned,    ///< PI that takes most from waves of one frequency
    matched,  ///< lets waves through as if the string went on
};

struct DriveCase {
    DriveControl control = DriveControl::stiff;
    double inertia = 0;           ///< of everything that turns, at the head (kg m2)
    double proportional = 0;      ///< N m s, control pi
    double integral = 0;          ///< N m, control pi
    double impedance_factor = 4;  ///< of the pipe's impedance to torsion, control tuned
    double frequency = 0;         ///< rad/s, control tuned
    double filter = 0;            ///< s, time over which the set rate comes back, control matched
    double torque_limit = std::numeric_limits<double>::infinity();  ///< N m
    double power_limit = std::numeric_limits<double>::infinity();   ///< W
};

/// A limit of an autodriller, and the loop that keeps it: drum speed = gain e + what it comes back
/// to.
struct DrillerLoop {
    ScalarSchedule limit;
    double gain = 0;        ///< m/s per unit of the limit
    double reset_time = 0;  ///< s over which it comes back to the speed that the drum has
};

/// Feeds the drum as fast as the most limiting of its loops allows.
struct AutodrillerCase {
    std::optional<DrillerLoop> weight;    ///< N on the bit, as the hook load tells
    std::optional<DrillerLoop> rate;      ///< m/s of the block
    std::optional<DrillerLoop> torque;    ///< N m at the surface
    std::optional<DrillerLoop> pressure;  ///< Pa, difference over the motor
    /// Hook load with the bit off bottom (N); unset: that at the start of the run.
    std::optional<double> off_bottom_load;
};

/// Block and travelling gear on the lines of a drum.
struct HoistCase {
    double mass = 0;             ///< of block and travelling gear (kg)
    double line_stiffness = 0;   ///< of one line between crown and block (N/m)
    int lines = 1;               ///< that carry the block
    ScalarSchedule block_speed;  ///< m/s along d3, as the drum feeds the lines
    /// Hook load (N) above which the brake of a drum that is not driven slips.
    std::optional<ScalarSchedule> hook_load;
    std::optional<AutodrillerCase> autodriller;  ///< feeds the drum
};

struct TimeSpan {
    double begin = 0;  ///< s
    double end = 0;    ///< s
};

struct HeadCase {
    std::optional<Eigen::Vector3d> position;   ///< m, north-east-down; unset: start of the well
    std::optional<Eigen::Vector3d> direction;  ///< unit d3; unset: the well's tangent, or down
    HeadMotion motion = HeadMotion::driven;
    VectorSchedule force;            ///< N, space frame, motion free
    VectorSchedule moment;           ///< N m, space frame, motion free
    ScalarSchedule rotation;         ///< rad/s about d3, motion driven or pinned
    VectorSchedule tilting;          ///< rad/s about d1 and d2 (0 about d3), motion driven
    VectorSchedule velocity;         ///< m/s along d3, d1, d2, motion driven
    std::optional<DriveCase> drive;  ///< not motion free; unset: the head turns just as scheduled
    std::optional<HoistCase> hoist;  ///< motion driven; unset: the head moves just as scheduled
    std::vector<TimeSpan> slips;     ///< in which slips hold the string, not the hoist
};

enum class BitDirection { well, follower };

enum class BitLaw {
    prescribed,   ///< torque as scheduled, against the head's rotation
    stribeck,     ///< friction that falls with the bit's own speed; sticks
    cutting,      ///< of blades that cut what the one before has left, and of their wear flats
    roller_cone,  ///< of cones that roll over the lobes of a bottom that is elastic
};

/// Rock and cutters of a bit, law cutting: Detournay and Defourny (1992).
struct CuttingCase {
    int blades = 6;
    double specific_energy = 0;   ///< intrinsic, of the rock (Pa)
    double inclination = 0.6;     ///< zeta: force into the rock over force along it
    double wear_flat = 0;         ///< length of the wear flats over all blades (m)
    double contact_strength = 0;  ///< the most that presses on them (Pa)
    double flat_friction = 0;     ///< their coefficient of friction times the bit's number gamma
};

/// Cones on the bottom that they leave, law roller_cone.
struct RollerConeCase {
    int lobes = 3;
    double lobe_height = 0;      ///< from valley to crest (m)
    double stiffness = 0;        ///< of rock and teeth along the well (N/m)
    double specific_energy = 0;  ///< work of the torque per volume drilled (Pa)
};

/// A mud motor between the string's end and the bit: torque = most (1 - w/w_0)^(1/alpha), w the
/// speed of the rotor in the stator.
struct MotorCase {
    double stall_torque = 0;   ///< at w = 0 (N m)
    double no_load_speed = 0;  ///< w_0 (rad/s)
    double exponent = 4.538;   ///< alpha
    double displacement = 0;   ///< mud for a turn of the rotor (m3)
};

struct BitCase {
    ScalarSchedule weight;           ///< N, compressive
    ScalarSchedule torque;           ///< N m, opposes rotation
    std::optional<double> friction;  ///< torque = friction * pi R / 4 * weight instead
    double smoothing_speed = 0;      ///< rad/s below which the torque falls linearly to zero
    BitDirection direction = BitDirection::follower;
    BitLaw law = BitLaw::prescribed;
    double static_torque = 0;   ///< N m, largest while the bit sticks, law stribeck
    double dynamic_torque = 0;  ///< N m, at high speed
    double decay_speed = 0;     ///< rad/s over which the one falls to the other; 0: at once
    double radius = 0;          ///< m; 0: that of the string's end
    double inertia = 0;         ///< of the bit itself, with a motor's rotor, about its axis (kg m2)
    double mass = 0;            ///< of the bit itself, in addition to its node's (kg)
    std::optional<MotorCase> motor;
    CuttingCase cutting;         ///< law cutting
    RollerConeCase roller_cone;  ///< law roller_cone
    ScalarSchedule feed;         ///< m/s at which the rock comes up, where the bit drills
    double off_bottom = 0;       ///< m, of the bit above the rock at the start, where it drills
    double contact_length = 0;   ///< of wall that the bit touches besides its node's own cell (m)
    VectorSchedule force;        ///< dead load, space frame (N)
    VectorSchedule dead_moment;  ///< dead couple, space frame (N m)
    VectorSchedule moment;       ///< follower couple about d3, d1, d2 (N m)

    /// Whether the rock gives way as the bit presses and turns: its weight then follows.
    [[nodiscard]] bool drills() const {
        return law == BitLaw::cutting || law == BitLaw::roller_cone;
    }
};

enum class FrictionLaw { coulomb, paper };

enum class NormalLaw {
    linear,  ///< k dr and a dashpot
    hertz,   ///< k dr^1.5 (1 + chi d(dr)/dt): Hertz's spring, Hunt and Crossley's damping
};

struct ContactCase {
    NormalLaw normal_law = NormalLaw::linear;
    double normal_stiffness = 1e7;      ///< Pa, per length; law hertz: Pa/m^0.5
    double point_stiffness = 6e8;       ///< Pa, under contact points that state none
    double normal_damping = 1e5;        ///< Pa s; unused where restitution is set
    std::optional<double> restitution;  ///< 0..1: sets the damping from each node's own mass
    double hunt_crossley = 1;           ///< chi (s/m), law hertz
    double tangential_stiffness = 1e6;  ///< Pa
    double rolling_creep = 0.005;       ///< at which friction of a rolling pipe saturates; 0: never
    FrictionCoefficients static_friction{0.6, 0.6};
    FrictionCoefficients dynamic_friction{0.42, 0.42};
    /// m/s, over which friction falls from static to dynamic; 0: as soon as a point slides
    double stribeck_speed = 0;
    FrictionLaw law = FrictionLaw::coulomb;
    bool tension = false;     ///< true: the dashpot may pull (the paper)
    double interference = 0;  ///< by which a contact point may be wider than the hole (m)
};

/// Damping of translation and of rotation.
struct DampingPair {
    double translation = 0;
    double rotation = 0;
    bool shared = false;  ///< one number for both, as in the paper

    [[nodiscard]] bool any() const { return translation > 0 || rotation > 0; }
};

struct DampingCase {
    DampingPair internal;     ///< D_in: of rates of strain (N s/m, N m s)
    DampingPair external;     ///< D_ex: of velocities (N s/m2, N s)
    double kelvin_voigt = 0;  ///< s: B = tau A
};

enum class InitialState { coaxial, stress_free, equilibrium };

struct InitialCase {
    InitialState state = InitialState::coaxial;
    /// The case does not name the state: at rest if rest is found, on the axis if not.
    bool by_default = true;
    Eigen::Vector3d curvature = Eigen::Vector3d::Zero();  ///< added uniformly: twist, bend1, bend2
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();     ///< shift of the string (m)
    std::optional<double> penetration_limit;  ///< deepest in the wall (m); unset: the clearance
};

/// What a string does while its equilibrium is sought: bit_is_loaded() says which of these are on
/// bottom.
enum class StringMotion { rest, rotating, drilling, tripping_in, tripping_out, sliding };

struct EquilibriumCase {
    StringMotion motion = StringMotion::rest;
    std::optional<double> axial_speed;  ///< m/s, down the well; unset: as the motion says
    std::optional<double> rotation;     ///< rad/s about d3; unset: as the motion says
};

/// What a string does in a study of torque and drag; each word means what it means as a
/// StringMotion.
enum class TorqueDragMotion { tripping_in, tripping_out, rotating, drilling, sliding };

/// The word for a motion in case files, tables and datasets: tripping_in, tripping_out, rotating,
/// drilling, sliding.
std::string motion_name(TorqueDragMotion motion);

struct TorqueDragCase {
    std::vector<double> depths;  ///< measured depths of the bit, ascending (m); none: even steps
    std::vector<TorqueDragMotion> motions{TorqueDragMotion::tripping_in,
                                          TorqueDragMotion::tripping_out,
                                          TorqueDragMotion::rotating, TorqueDragMotion::drilling};
    std::optional<FrictionCoefficients> friction;  ///< unset: the dynamic friction of the contact
};

enum class IntegratorKind { dormand_prince, leapfrog };

struct RunCase {
    double duration = 0;  ///< s; 0: left out, for commands that do not simulate
    IntegratorKind integrator = IntegratorKind::leapfrog;
    double cfl = 0.9;
    bool local_steps = true;  ///< leapfrog: short segments take substeps (StepPlan)
    double tolerance = 0;     ///< time error for which the leapfrog shortens its steps; 0: none
    double stress_limit = 5;  ///< multiple of yield at which the leapfrog stops; 0: none
    double absolute_tolerance = 1e-7;
    double relative_tolerance = 1e-5;
    int threads = 0;            ///< 0: as many as the string gives work, up to all cores
    bool reproducible = false;  ///< equal bits on every instruction set
};

/// Counting of cycles of bending stress (engine/simulation/README.md).
struct CyclesCase {
    double interval = 0.01;  ///< between samples (s)
    double slope = 4;        ///< m of the S-N curve N = a S^-m by which ranges are weighed
};

/// A tool in the string that records what it feels (engine/rod/README.md, "Sensors").
struct SensorCase {
    std::string name;
    double depth = 0;        ///< along the string, from the head (m)
    double radius = 0;       ///< distance of the accelerometers from the axis, along d1 (m)
    double interval = 0.01;  ///< between samples (s)
};

/// Whether a text can name a sensor, a group of the result file and a file of its own: 1 to 64
/// letters, digits, "-" and "_".
bool is_sensor_name(const std::string& text);

struct OutputCase {
    double interval = 0.1;             ///< s
    double profile_interval = 5;       ///< s; 0: first and last only
    double checkpoint_interval = 60;   ///< wall s; 0: none
    double side_force_window = 9.144;  ///< over which side force per length is stated (m)
    std::optional<CyclesCase> cycles;  ///< unset: none are counted
    std::vector<SensorCase> sensors;
};

struct Case {
    std::string title;
    double gravity = 9.80665;  ///< m/s2, along +z (down)
    std::optional<WellCase> well;
    std::optional<FluidCase> fluid;
    StringCase string;
    MeshCase mesh;
    HeadCase head;
    BitCase bit;
    ContactCase contact;
    DampingCase damping;
    InitialCase initial;
    EquilibriumCase equilibrium;
    TorqueDragCase torque_drag;
    RunCase run;
    OutputCase output;
    std::filesystem::path path;                ///< the case file
    std::vector<std::filesystem::path> files;  ///< everything that was read, the case file first
    std::string text;                          ///< the TOML as read, overrides applied
    std::vector<std::string> warnings;         ///< of numbers that no engineer means, with places
};

/// Reads and validates a case file. `overrides` are (key.path, value) pairs as in
/// `--set key.path=value`. Throws InputError with file, line and column.
Case read_case(const std::filesystem::path& path,
               const std::vector<std::pair<std::string, std::string>>& overrides = {});

/// The key of the first setting in which two cases differ, as their texts (Case::text) have it;
/// none where they ask for the same run. Settings that change no result (threads, checkpoints) do
/// not count, nor does what is in files that the cases name. Throws InputError where a text is not
/// TOML.
std::optional<std::string> first_difference(const std::string& case_text,
                                            const std::string& other_text);

/// Throws InputError where the case states no duration of the run.
void require_duration(const Case& input);

}  // namespace drillstrand
