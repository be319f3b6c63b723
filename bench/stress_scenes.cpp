#include "stress_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace drillstrand::bench {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double inch = 0.0254;
constexpr double degree = pi / 180;
constexpr double rpm = 2 * pi / 60;
constexpr double steel_density = 7850;  // kg/m3
constexpr double survey_step = 30;      // m
// N per m of hole diameter: 40 kN per inch, twice what bits are run with
constexpr double most_weight_per_hole = 40e3 / inch;

struct Pipe {
    const char* name;
    double outer;  ///< in
    double inner;  ///< in
};

// API sizes: drill pipe and casing from 2 3/8 to 20 in, heavy-weight pipe, drill collars
constexpr Pipe pipes[] = {{"2 3/8 in pipe", 2.375, 1.815},
                          {"2 7/8 in pipe", 2.875, 2.151},
                          {"3 1/2 in pipe", 3.5, 2.764},
                          {"4 in pipe", 4, 3.34},
                          {"4 1/2 in pipe", 4.5, 3.826},
                          {"5 in pipe", 5, 4.276},
                          {"5 1/2 in pipe", 5.5, 4.778},
                          {"6 5/8 in pipe", 6.625, 5.965},
                          {"7 in casing", 7, 6.184},
                          {"9 5/8 in casing", 9.625, 8.681},
                          {"13 3/8 in casing", 13.375, 12.347},
                          {"20 in casing", 20, 18.73}};
constexpr Pipe heavy_pipes[] = {
    {"3 1/2 in heavy pipe", 3.5, 2.063}, {"5 in heavy pipe", 5, 3},
    {"3 1/8 in collar", 3.125, 1.25},    {"4 3/4 in collar", 4.75, 2.25},
    {"6 1/2 in collar", 6.5, 2.8125},    {"8 in collar", 8, 2.8125},
    {"9 1/2 in collar", 9.5, 3}};

class Draw {
  public:
    Draw(unsigned seed, int index) {
        std::seed_seq sequence{seed, static_cast<unsigned>(index)};
        random_.seed(sequence);
    }
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    double log_uniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    bool chance(double probability) { return uniform(0, 1) < probability; }

  private:
    std::mt19937 random_;
};

Component component_of(const Pipe& pipe, double length) {
    Component component;
    component.name = pipe.name;
    component.length = length;
    component.outer_diameter = pipe.outer * inch;
    component.inner_diameter = pipe.inner * inch;
    component.linear_density =
        steel_density * pi / 4 * inch * inch * (pipe.outer * pipe.outer - pipe.inner * pipe.inner);
    component.youngs_modulus = 206e9;
    return component;
}

/// Pipe on top, up to four heavier components of similar diameter below.
std::vector<Component> draw_string(Draw& draw, double length) {
    const Pipe& main = pipes[draw.whole(0, static_cast<int>(std::size(pipes)) - 1)];
    std::vector<Component> lower;
    double left = length;
    const int heavier = draw.whole(0, 4);
    for (int i = 0; i < heavier; ++i) {
        const Pipe& pipe = heavy_pipes[draw.whole(0, static_cast<int>(std::size(heavy_pipes)) - 1)];
        if (pipe.outer > 1.7 * main.outer || pipe.outer < 0.6 * main.outer) continue;
        const double part = std::min(draw.uniform(9, 150), 0.3 * left);
        lower.push_back(component_of(pipe, part));
        left -= part;
    }
    std::vector<Component> string;
    if (draw.chance(0.3)) {  // a tapered string
        const Pipe* above = &main + (&main == std::end(pipes) - 1 ? 0 : 1);
        const double part = draw.uniform(0.2, 0.6) * left;
        if (above->outer < 1.35 * main.outer) {
            string.push_back(component_of(*above, part));
            left -= part;
        }
    }
    string.push_back(component_of(main, left));
    string.insert(string.end(), lower.begin(), lower.end());
    if (draw.chance(0.1)) {  // a bent one near the bit
        string.back().curvature = {0, draw.uniform(-0.01, 0.01), draw.uniform(-0.01, 0.01)};
    }
    return string;
}

/// Stretches of hold and of build, drop and turn; in between a little tortuosity.
std::vector<SurveyStation> draw_survey(Draw& draw, double depth) {
    const double worst = draw.uniform(0.5, 15) * degree / survey_step;  // severest dogleg (rad/m)
    const double tortuosity = draw.uniform(0, 1.5) * degree / survey_step;
    SurveyStation station{0, draw.chance(0.7) ? 0 : draw.uniform(0, 60) * degree,
                          draw.uniform(0, 2 * pi)};
    std::vector<SurveyStation> survey{station};
    double stretch_end = draw.uniform(0, 0.3) * depth;
    double build = 0;  // rad/m
    double turn = 0;   // rad/m
    while (station.measured_depth < depth) {
        const double step = std::min(survey_step, depth - station.measured_depth + 1);
        if (station.measured_depth >= stretch_end) {
            const bool curved = build == 0 && turn == 0;
            const double severity = curved ? worst * draw.uniform(0.3, 1) : 0;
            const double way = draw.uniform(-0.5, 1) * pi / 2;
            build = severity * std::cos(way);
            turn = severity * std::sin(way);
            // a bend goes on for up to 90 degrees
            stretch_end = station.measured_depth +
                          (curved ? std::max(survey_step, draw.uniform(0.1, 1.5) / severity)
                                  : draw.uniform(0.02, 0.4) * depth);
        }
        const double sine = std::max(std::sin(station.inclination), 0.1);
        double change = (build + tortuosity * draw.uniform(-0.5, 0.5)) * step;
        double sideways = (turn + tortuosity * draw.uniform(-0.5, 0.5)) * step / sine;
        if (station.inclination + change > 95 * degree) {
            change = std::min(0.0, 95 * degree - station.inclination);
            build = 0;
        }
        station.measured_depth += step;
        station.inclination = std::max(0.0, station.inclination + change);
        station.azimuth += std::clamp(sideways, -worst * step / sine, worst * step / sine);
        survey.push_back(station);
    }
    return survey;
}

/// Largest outer diameter of the string below a depth, where it can get within the run.
double widest_below(const std::vector<Component>& string, double depth) {
    constexpr double travel = 60;  // m
    double from = 0;
    double widest = 0;
    for (const Component& component : string) {
        if (from + component.length > depth - travel)
            widest = std::max(widest, component.outer_diameter);
        from += component.length;
    }
    return widest;
}

/// One to three diameters, narrower with depth.
std::vector<WellSectionCase> draw_sections(Draw& draw, const std::vector<Component>& string,
                                           double depth) {
    std::vector<WellSectionCase> sections;
    const int count = draw.whole(1, 3);
    double least = 0;
    for (int i = count - 1; i >= 0; --i) {
        const double from = depth * i / count;
        const double hole = widest_below(string, from) * draw.uniform(1.15, 1.7);
        least = std::max({least, hole, widest_below(string, from) + 0.5 * inch});
        sections.insert(sections.begin(), {depth * (i + 1) / count, least});
        least += 0.2 * inch;
    }
    return sections;
}

/// A schedule that goes from 0 to a value.
ScalarSchedule ramp(double start, double time, double value) {
    return ScalarSchedule({start, start + time}, {0.0, value});
}

double bending_stiffness(const Component& c) {
    return c.youngs_modulus * pi / 64 *
           (std::pow(c.outer_diameter, 4) - std::pow(c.inner_diameter, 4));
}

double axial_yield(const Component& c) {
    return c.yield_strength * pi / 4 *
           (std::pow(c.outer_diameter, 2) - std::pow(c.inner_diameter, 2));
}

/// Weight along the well, of the string in its fluid (N).
double hanging_weight(const Case& input) {
    double sum = 0;
    double from = 0;
    std::size_t station = 0;
    for (const Component& c : input.string.components) {
        const double metal =
            pi / 4 * (std::pow(c.outer_diameter, 2) - std::pow(c.inner_diameter, 2));
        const double displaced = !input.fluid ? 0
                                 : input.fluid->inside == InsideOfPipe::fluid
                                     ? metal
                                     : pi / 4 * std::pow(c.outer_diameter, 2);
        const double weight =
            (c.linear_density - (input.fluid ? input.fluid->density : 0) * displaced) *
            input.gravity;
        for (double s = from; s < from + c.length; s += 1) {
            while (station + 1 < input.well->survey.size() &&
                   input.well->survey[station + 1].measured_depth < s) {
                ++station;
            }
            sum += weight * std::cos(input.well->survey[station].inclination);
        }
        from += c.length;
    }
    return sum;
}

void draw_fluid(Draw& draw, Case& input) {
    FluidCase fluid;
    fluid.density = draw.uniform(900, 2200);
    fluid.viscosity = draw.uniform(0, 0.1);
    fluid.inside = draw.chance(0.15) ? InsideOfPipe::empty : InsideOfPipe::fluid;
    fluid.drag = !draw.chance(0.1);
    fluid.axial_drag = draw.chance(0.2) ? AxialDrag::concentric : AxialDrag::eccentric;
    input.fluid = fluid;
}

void draw_contact(Draw& draw, ContactCase& contact) {
    contact.normal_stiffness = draw.log_uniform(1e4, 1e9);
    contact.tangential_stiffness = draw.log_uniform(1e4, 1e9);
    contact.normal_damping = draw.log_uniform(1e2, 1e8);
    if (draw.chance(0.3)) contact.restitution = draw.uniform(0, 1);
    const double axial = draw.uniform(0, 0.8);
    const double azimuthal = draw.chance(0.3) ? draw.uniform(0, 0.8) : axial;
    const double dynamic = draw.uniform(0.5, 1);
    contact.static_friction = {axial, azimuthal};
    contact.dynamic_friction = {dynamic * axial, dynamic * azimuthal};
}

void draw_damping(Draw& draw, DampingCase& damping) {
    const auto paper = [](double number) { return DampingPair{number, number}; };
    if (draw.chance(0.5)) damping.internal = paper(draw.log_uniform(1e-3, 10));
    if (draw.chance(0.2)) damping.external = paper(draw.log_uniform(1e-2, 10));
    if (draw.chance(0.2)) damping.kelvin_voigt = draw.log_uniform(1e-6, 1e-3);
}

/// Rotation, weight and torque on bit; a free head hangs in the balance and is turned by a pulse.
void draw_loads(Draw& draw, Case& input) {
    const double hole = input.well->sections.back().diameter;
    double bearable = most_weight_per_hole * hole;
    for (const Component& c : input.string.components)
        bearable = std::min(bearable, 0.5 * axial_yield(c));
    const double weight = draw.chance(0.15) ? 0 : std::min(draw.uniform(0, 500e3), bearable);
    const double start = draw.uniform(0, 8);
    const double time = draw.uniform(0.5, 4);
    input.bit.weight = ramp(start, time, weight);
    input.bit.direction = draw.chance(0.5) ? BitDirection::well : BitDirection::follower;
    input.bit.smoothing_speed = 1 * rpm;
    const double grip = draw.chance(0.3) ? 0 : draw.uniform(0, 0.5);
    if (draw.chance(0.5)) {
        input.bit.friction = grip;
    } else {
        input.bit.torque = ramp(start, time, grip * hole / 3 * weight);
    }
    const double begin = draw.uniform(0, 3);
    const double over = draw.uniform(0.5, 4);
    if (draw.chance(0.1)) {
        const double kick = draw.uniform(0, 5e3);
        input.head.motion = HeadMotion::free;
        const double pull = hanging_weight(input);
        const SurveyStation& top = input.well->survey.front();
        const Eigen::Vector3d down(std::sin(top.inclination) * std::cos(top.azimuth),
                                   std::sin(top.inclination) * std::sin(top.azimuth),
                                   std::cos(top.inclination));
        input.head.force = VectorSchedule(
            {start, start + time},
            {Eigen::Vector3d(-pull * down), Eigen::Vector3d(-(pull - weight) * down)});
        input.head.moment =
            VectorSchedule({begin, begin + 0.5, begin + 1},
                           {Eigen::Vector3d::Zero(), kick * down, Eigen::Vector3d::Zero()});
    } else {
        const double speed = draw.chance(0.15) ? 0 : draw.uniform(0, 300) * rpm;
        input.head.rotation = ramp(begin, over, speed);
    }
}

/// Segments of 5 to 10 m; shorter where four of them would not span the helix that the weight on
/// bit makes of a component, or that a tenth of the string's weight makes, which friction and the
/// start can put on any part of it.
int draw_segments(Draw& draw, const Case& input, double length) {
    double element = draw.uniform(5, 10);
    const double compression =
        std::max(input.bit.weight.values().back(), 0.1 * std::abs(hanging_weight(input)));
    for (const Component& c : input.string.components) {
        const double pitch = std::sqrt(8 * pi * pi * bending_stiffness(c) / compression);
        element = std::min(element, pitch / 4);
    }
    return std::max(4, static_cast<int>(std::round(length / element)));
}

/// Tool joints on drill pipe, as far as the hole has room for them.
void add_tool_joints(Draw& draw, std::vector<Component>& string, double narrowest) {
    for (Component& component : string) {
        const bool is_casing = component.outer_diameter > 6.8 * inch;
        const bool is_thick = component.inner_diameter < 0.7 * component.outer_diameter;
        const double most = std::min(component.outer_diameter + 1.6 * inch, 0.97 * narrowest);
        if (is_casing || is_thick || component.length < 30 || most < component.outer_diameter)
            continue;
        ToolJoints joints;
        joints.spacing = draw.uniform(9, 14);
        joints.outer_diameter = draw.uniform(component.outer_diameter, most);
        joints.inner_diameter = component.inner_diameter;
        joints.length = draw.uniform(0.3, 0.6);
        component.linear_density *= draw.uniform(1.05, 1.25);
        component.joints = joints;
    }
}

/// Takes a piece off the string's lower end.
Component cut_off(std::vector<Component>& string, double length, const char* name) {
    Component piece = string.back();
    piece.name = name;
    piece.length = length;
    piece.joints.reset();
    string.back().length -= length;
    return piece;
}

/// Bit, stabilisers and perhaps a bend and an unbalance at the lower end.
void add_assembly(Draw& draw, std::vector<Component>& string, double hole) {
    std::vector<Component> lower;
    Component bit = cut_off(string, draw.uniform(0.3, 1), "bit");
    bit.contact = ContactPoint{bit.length, hole, draw.uniform(0.1, 0.3), {}};
    lower.push_back(bit);
    const int stabilisers = draw.whole(0, 3);
    for (int i = 0; i < stabilisers && string.back().length > 40; ++i) {
        Component body = cut_off(string, draw.uniform(3, 12), "body");
        if (draw.chance(0.2))
            body.bend = BentPlace{draw.uniform(0, body.length), draw.uniform(0, 2) * degree,
                                  draw.uniform(0, 2 * pi)};
        if (draw.chance(0.3))
            body.eccentric = Eccentricity{draw.uniform(0, body.length), draw.uniform(0, 2)};
        Component stabiliser = cut_off(string, draw.uniform(1, 2), "stabiliser");
        const double blade = std::max(stabiliser.outer_diameter, draw.uniform(0.93, 1) * hole);
        stabiliser.contact =
            ContactPoint{draw.uniform(0, stabiliser.length), blade, draw.uniform(0.2, 0.6), {}};
        lower.push_back(body);
        lower.push_back(stabiliser);
    }
    string.insert(string.end(), lower.rbegin(), lower.rend());
}

void draw_walls(Draw& draw, std::vector<WellSectionCase>& sections) {
    for (WellSectionCase& section : sections) {
        const double sticking = draw.uniform(0.1, 0.6);
        section.static_friction = {sticking, sticking};
        const double sliding = sticking * draw.uniform(0.6, 1);
        section.dynamic_friction = {sliding, sliding};
        if (draw.chance(0.3)) section.normal_stiffness = draw.log_uniform(1e6, 1e9);
    }
}

/// Bits that stick and slip under the weight of the scene, or that cut their way down.
void draw_bit_law(Draw& draw, Case& input) {
    BitCase& bit = input.bit;
    if (draw.chance(0.3)) return;
    const double hole = input.well->sections.back().diameter;
    const double weight = bit.weight.values().back();
    bit.friction.reset();
    bit.torque = {};
    bit.inertia = draw.chance(0.5) ? draw.log_uniform(0.1, 100) : 0;
    if (draw.chance(0.5)) {
        bit.law = BitLaw::stribeck;
        bit.static_torque = draw.uniform(0, 1) * hole / 3 * std::max(weight, 1e4);
        bit.dynamic_torque = draw.uniform(0.3, 1) * bit.static_torque;
        bit.decay_speed = draw.chance(0.3) ? 0 : draw.log_uniform(0.1, 10);
        return;
    }
    bit.law = BitLaw::cutting;
    bit.weight = {};
    bit.cutting.blades = draw.whole(3, 12);
    bit.cutting.specific_energy = draw.log_uniform(5e6, 3e8);
    bit.cutting.inclination = draw.uniform(0.5, 0.9);
    bit.cutting.wear_flat = draw.chance(0.5) ? draw.log_uniform(1e-4, 5e-3) : 0;
    bit.cutting.contact_strength = draw.uniform(0.3, 1) * bit.cutting.specific_energy;
    bit.cutting.flat_friction = draw.uniform(0, 1);
    bit.feed = ramp(draw.uniform(0, 8), draw.uniform(0.5, 4), draw.log_uniform(1e-4, 1e-2));
    bit.off_bottom = draw.chance(0.5) ? draw.log_uniform(1e-4, 1e-1) : 0;
}

DriveCase draw_drive(Draw& draw) {
    constexpr DriveControl controls[] = {DriveControl::stiff, DriveControl::pi, DriveControl::tuned,
                                         DriveControl::matched};
    DriveCase drive;
    drive.control = controls[draw.whole(0, 3)];
    drive.inertia = draw.log_uniform(100, 5000);
    drive.proportional = draw.log_uniform(100, 5e4);
    drive.integral = draw.chance(0.7) ? draw.log_uniform(100, 1e5) : 0;
    drive.impedance_factor = draw.uniform(1, 8);
    drive.frequency = draw.log_uniform(0.3, 5);
    drive.filter = draw.chance(0.7) ? draw.log_uniform(0.3, 10) : 0;
    if (draw.chance(0.5)) drive.torque_limit = draw.log_uniform(5e3, 1e5);
    if (draw.chance(0.3)) drive.power_limit = draw.log_uniform(1e5, 1e6);
    return drive;
}

/// Cones in place of blades.
void roll_cones(Draw& draw, BitCase& bit) {
    bit.law = BitLaw::roller_cone;
    bit.friction = draw.uniform(0, 0.6);
    bit.roller_cone.lobe_height = draw.chance(0.8) ? draw.log_uniform(1e-4, 2e-2) : 0;
    bit.roller_cone.stiffness = draw.log_uniform(1e6, 2e8);
    bit.roller_cone.specific_energy = draw.log_uniform(2e7, 1e9);
}

MotorCase draw_motor(Draw& draw) {
    MotorCase motor;
    motor.stall_torque = draw.log_uniform(1e3, 3e4);
    motor.no_load_speed = draw.uniform(5, 30);
    motor.exponent = draw.uniform(1, 8);
    motor.displacement = draw.log_uniform(3e-3, 5e-2);
    return motor;
}

/// Loops that feed a drum; one over the pressure only where a motor is.
AutodrillerCase draw_autodriller(Draw& draw, bool has_motor) {
    const auto loop = [&](double limit, double fastest) {
        return DrillerLoop{limit, fastest / limit, draw.log_uniform(1, 30)};
    };
    AutodrillerCase autodriller;
    autodriller.weight = loop(draw.log_uniform(5e3, 2e5), draw.log_uniform(0.01, 0.2));
    if (draw.chance(0.5)) autodriller.rate = loop(draw.log_uniform(1e-3, 0.05), 0.05);
    if (draw.chance(0.3)) autodriller.torque = loop(draw.log_uniform(3e3, 5e4), 0.05);
    if (has_motor && draw.chance(0.5))
        autodriller.pressure = loop(draw.log_uniform(5e5, 5e6), 0.05);
    return autodriller;
}

/// A hoist that stands, pays out what its brake does not hold, or is fed by an autodriller.
HoistCase draw_hoist(Draw& draw, Case& input) {
    HoistCase hoist;
    hoist.mass = draw.log_uniform(3e3, 5e4);
    hoist.lines = draw.whole(4, 14);
    hoist.line_stiffness = draw.log_uniform(2e5, 1e7);
    if (input.bit.drills() && draw.chance(0.8)) {
        hoist.autodriller = draw_autodriller(draw, input.bit.motor.has_value());
        input.bit.feed = {};
    } else if (draw.chance(0.3)) {
        hoist.hook_load = ScalarSchedule(0.9 * std::abs(hanging_weight(input)));
    }
    return hoist;
}

JarCase draw_jar(Draw& draw, double length) {
    JarCase jar;
    jar.position = draw.uniform(0.1, 0.9) * length;
    jar.up_force = draw.log_uniform(2e4, 8e5);
    jar.up_travel = draw.uniform(0.1, 0.3);
    jar.down_force = draw.log_uniform(2e4, 4e5);
    jar.down_travel = draw.uniform(0.1, 0.3);
    jar.delay = draw.chance(0.5) ? draw.uniform(0, 5) : 0;
    return jar;
}

/// What a rig adds: cones, a motor, a jar, a hoist or a head that tilts, a wall as Hertz has it.
void draw_machines(Draw& draw, Case& input) {
    BitCase& bit = input.bit;
    if (bit.law == BitLaw::cutting && draw.chance(0.4)) roll_cones(draw, bit);
    if (draw.chance(0.3)) bit.mass = draw.uniform(20, 500);
    if (draw.chance(0.3)) {
        bit.motor = draw_motor(draw);
        bit.inertia = draw.log_uniform(1, 100);
    }
    if (input.head.motion == HeadMotion::driven && draw.chance(0.4))
        input.head.hoist = draw_hoist(draw, input);
    else if (input.head.motion == HeadMotion::driven && draw.chance(0.2))
        input.head.motion = HeadMotion::pinned;
    if (draw.chance(0.2)) {
        auto& string = input.string.components;
        Component& jarred =
            string[static_cast<std::size_t>(draw.whole(0, static_cast<int>(string.size()) - 1))];
        jarred.jar = draw_jar(draw, jarred.length);
    }
    if (draw.chance(0.2)) {
        ContactCase& contact = input.contact;
        contact.normal_law = NormalLaw::hertz;
        contact.normal_stiffness = draw.log_uniform(1e8, 1e11);
        contact.hunt_crossley = draw.chance(0.3) ? 0 : draw.uniform(0, 3);
        contact.restitution.reset();
    }
}

void draw_moving_mud(Draw& draw, FluidCase& fluid) {
    fluid.viscosity = draw.log_uniform(0.01, 2);
    fluid.flow_index = draw.uniform(0.3, 1);
    fluid.yield_stress = draw.chance(0.5) ? draw.uniform(0, 15) : 0;
    const bool pumped = fluid.inside == InsideOfPipe::fluid && fluid.drag;
    if (pumped && draw.chance(0.7)) fluid.flow_rate = draw.uniform(0, 0.06);
}

}  // namespace

Case stress_scene(unsigned seed, int index, double duration) {
    Draw draw(seed, index);
    Case input;
    input.title = fmt::format("stress scene {} of seed {}", index, seed);
    const double length = draw.log_uniform(100, 8000);
    input.string.components = draw_string(draw, length);
    WellCase well;
    const double depth = length + 100;
    well.survey = draw_survey(draw, depth);
    well.sections = draw_sections(draw, input.string.components, depth);
    input.well = well;
    if (draw.chance(0.7)) draw_fluid(draw, input);
    draw_contact(draw, input.contact);
    draw_damping(draw, input.damping);
    draw_loads(draw, input);
    input.mesh.segments = draw_segments(draw, input, length);
    input.run.integrator = IntegratorKind::leapfrog;
    input.run.duration = duration;
    return input;
}

Case assembly_scene(unsigned seed, int index, double duration) {
    Case input = stress_scene(seed, index, duration);
    Draw draw(seed + 1, index);
    const double hole = input.well->sections.back().diameter;
    input.mesh.element_length = total_length(input.string) / input.mesh.segments;
    input.mesh.segments = 0;
    add_tool_joints(draw, input.string.components, hole);
    add_assembly(draw, input.string.components, hole);
    draw_walls(draw, input.well->sections);
    return input;
}

Case driven_scene(unsigned seed, int index, double duration) {
    Case input = stress_scene(seed, index, duration);
    Draw draw(seed + 2, index);
    draw_bit_law(draw, input);
    if (input.head.motion == HeadMotion::driven && draw.chance(0.7))
        input.head.drive = draw_drive(draw);
    if (draw.chance(0.5)) input.contact.stribeck_speed = draw.log_uniform(0.01, 1);
    if (input.fluid && draw.chance(0.5)) draw_moving_mud(draw, *input.fluid);
    Draw machines(seed + 3, index);
    draw_machines(machines, input);
    return input;
}

}  // namespace drillstrand::bench
