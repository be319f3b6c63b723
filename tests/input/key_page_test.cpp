/// engine/input/KEYS.md says of every key what the readers know of it, and of no other.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "input/key_notes.hpp"
#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

const std::string short_pipe = R"([[string.component]]
length = 10
outer_diameter = 0.1
linear_density = 20
youngs_modulus = 2e11
[mesh]
segments = 5
)";

/// Together these ask for every key.
const std::vector<std::string> asking{R"(title = "Pipe in a well"
gravity = 9.8
[well]
survey = "survey.csv"
section = [{name = "casing", from = 0, to = 300, diameter = 0.4, static_friction = 0.3, dynamic_friction = 0.2}, {to = 520, diameter = [0.35, 0.3], normal_stiffness = 1e6}]
tortuosity = {model = "random", amplitude = 0.01, period = 30, seed = 2, from = 10, to = 500}
[fluid]
density = 1000
viscosity = 1e-3
inside = "fluid"
drag = true
regime = "inertial"
drag_coefficient = 1
contact_drag = true
axial_drag = "eccentric"
film = 0.01
added_mass = false
[string]
shear_coefficient = 1
[[string.component]]
name = "pipe"
length = 500
outer_diameter = 0.1
inner_diameter = 0.08
density = 7850
youngs_modulus = 2e11
poisson_ratio = 0.3
yield_strength = 9e8
curvature = [0, 0, 0]
bending_stiffness = 1
torsional_stiffness = 1
axial_stiffness = 1
shear_stiffness = 1
inertia = 1
polar_inertia = 1
material_density = 7850
joint_length = 10
tool_joint_outer_diameter = 0.12
tool_joint_inner_diameter = 0.07
tool_joint_length = 0.4
contact_diameter = 0.15
contact_length = 0.3
contact_position = 5
contact_stiffness = 1e9
bend = 0.01
bend_position = 5
toolface = 0
eccentric_mass = 0.1
eccentric_mass_position = 5
element_length = 5
[mesh]
element_length = 10
segments_per_joint = 2
refine = [{from = 0, to = 10, measured_from = "bit", element_length = 1}]
segment_inertia = true
[head]
position = [0, 0, 0]
direction = [0, 0, 1]
motion = "driven"
rotation = 1
[bit]
weight = 1
friction = 1
smoothing_speed = 1
direction = "well"
contact_length = 1
force = [0, 0, 0]
dead_moment = [0, 0, 0]
moment = [0, 0, 0]
[contact]
restitution = 0.5
normal_stiffness = 1e7
point_stiffness = 1e9
tangential_stiffness = 1e7
rolling_creep = 0.005
law = "coulomb"
stribeck_speed = 0
tension = false
interference = 0
static_friction = 0.6
dynamic_friction = 0.4
[damping]
internal = 0
external = 0
kelvin_voigt = 0
[initial]
state = "coaxial"
curvature = [0, 0, 0]
offset = [0, 0, 0]
penetration_limit = 0.1
[equilibrium]
motion = "rotating"
axial_speed = 1
rotation = 1
[torque_drag]
depths = {from = 100, to = 500, step = 100}
motions = ["rotating"]
friction = 0.2
[run]
duration = 1
integrator = "leapfrog"
cfl = 0.9
local_steps = true
tolerance = 0.01
stress_limit = 5
absolute_tolerance = 1e-7
relative_tolerance = 1e-5
threads = 1
reproducible = false
[output]
interval = 1
profile_interval = 1
checkpoint_interval = 1
side_force_window = 9
cycles = {interval = 0.02, slope = 3}
sensor = [{name = "mwd", depth = 12, measured_from = "bit", radius = 0.05, interval = 0.1}]
)",
                                      R"([well]
survey = "deep.csv"
tie_in = "vertical"
diameter = 0.3
[fluid]
density = 1000
consistency = 0.5
flow_index = 0.7
yield_stress = 5
flow_rate = 0.03
nozzle_area = 5e-4
trip_speed = 0.5
[string]
components = "string.csv"
[mesh]
segments = 5
[head]
motion = "free"
force = [1, 0, 0]
moment = [1, 0, 0]
[bit]
torque = 1
[contact]
normal_damping = 1
[damping]
internal_translation = 1
internal_rotation = 1
external_translation = 1
external_rotation = 1
[torque_drag]
depths = [100, 200]
)",
                                      short_pipe + R"([head.drive]
control = "pi"
inertia = 2000
proportional = 1000
integral = 100
torque_limit = 4e4
power_limit = 1e6
[bit]
law = "stribeck"
static_torque = 8000
dynamic_torque = 6000
decay_speed = 1
inertia = 1
)",
                                      short_pipe + R"([bit]
law = "cutting"
feed = 0.001
off_bottom = 1
[bit.cutting]
blades = 6
specific_energy = 6e7
inclination = 0.6
wear_flat = 1e-3
contact_strength = 6e7
flat_friction = 0.5
)",
                                      R"([[string.component]]
length = 10
outer_diameter = 0.1
linear_density = 20
youngs_modulus = 2e11
[string.component.jar]
position = 3
up_force = 4e5
up_travel = 0.2
down_force = 2e5
down_travel = 0.1
delay = 30
[mesh]
segments = 5
)",
                                      short_pipe + R"([head.drive]
control = "tuned"
impedance_factor = 4
frequency = 1
)",
                                      short_pipe + R"([head.drive]
control = "matched"
filter = 2
[head.hoist]
mass = 1e4
line_stiffness = 1e6
lines = 8
hook_load = 1e5
)",
                                      R"([[string.component]]
length = 10
outer_diameter = 0.1
linear_density = 20
youngs_modulus = 2e11
[mesh]
segments = 5
[head]
operations = ["wait 1 s"]
ramp_time = 1
[head.hoist]
mass = 1e4
line_stiffness = 1e6
)",
                                      R"([[string.component]]
length = 10
outer_diameter = 0.1
linear_density = 20
youngs_modulus = 2e11
[mesh]
segments = 5
[head]
angular_velocity = [1, 0, 0]
velocity = [0, 0, 0]
[head.hoist]
mass = 1e4
line_stiffness = 1e6
block_speed = 0.1
)",
                                      R"([[string.component]]
length = 10
outer_diameter = 0.1
linear_density = 20
youngs_modulus = 2e11
[mesh]
segments = 5
[head.hoist]
mass = 1e4
line_stiffness = 1e6
[head.hoist.autodriller]
weight = 1e5
weight_gain = 1e-6
weight_reset = 10
rate = 0.01
rate_gain = 1
rate_reset = 10
torque = 1e4
torque_gain = 1e-5
torque_reset = 10
off_bottom_load = 1e6
)"};

std::map<std::string, KeyNote> notes_of_readers() {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    folder.write("deep.csv", "md,inclination,azimuth\n20,0,0\n520,3,60\n");
    folder.write("string.csv",
                 "length,outer_diameter,linear_density,youngs_modulus\n9,0.1,29,2e11\n");
    std::map<std::string, KeyNote> all;
    for (const std::string& text : asking) {
        folder.write("case.toml", text);
        const KeyNotes notes;
        static_cast<void>(folder.read("case.toml"));
        for (const auto& [path, note] : notes.notes()) {
            KeyNote& known = all[path];
            known.types.insert(note.types.begin(), note.types.end());
            known.ranges.insert(note.ranges.begin(), note.ranges.end());
            known.standards.insert(note.standards.begin(), note.standards.end());
            known.required = known.required || note.required;
        }
    }
    return all;
}

struct Line {
    std::string type;
    std::string standard;
    std::string range;
};

std::string without(const std::string& text, char unwanted) {
    std::string result;
    for (const char c : text)
        if (c != unwanted) result += c;
    return result;
}

std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(' ');
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, '|');)
        cells.push_back(trimmed(without(cell, '`')));
    return cells;
}

/// "well." of a heading with `[well]`, "string.component." of one with `[[string.component]]`.
std::string prefix_of(const std::string& heading) {
    const std::size_t begin = heading.find_first_not_of("# `[");
    if (heading.find('[') == std::string::npos) return "";
    return heading.substr(begin, heading.find(']') - begin) + ".";
}

std::map<std::string, Line> lines_of_page() {
    std::ifstream page(DRILLSTRAND_SOURCE_DIR "/engine/input/KEYS.md");
    std::map<std::string, Line> lines;
    std::string prefix;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("## ")) prefix = prefix_of(line);
        if (!line.starts_with("| `")) continue;
        const std::vector<std::string> cells = cells_of(line);
        EXPECT_EQ(cells.size(), 6U) << line;
        EXPECT_TRUE(
            lines.try_emplace(prefix + cells.at(1), Line{cells.at(2), cells.at(3), cells.at(4)})
                .second)
            << line << " is there twice";
    }
    return lines;
}

/// Tables with a heading of their own.
bool has_heading(const std::string& path) {
    static const std::set<std::string> tables{
        "",        "well",    "fluid",   "string",      "mesh",        "head", "bit",
        "contact", "damping", "initial", "equilibrium", "torque_drag", "run",  "output"};
    return tables.contains(path);
}

std::set<std::string> parts_of(const std::string& text, const std::string& separator) {
    std::set<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find(separator, begin)) != std::string::npos;
         begin = end + separator.size())
        parts.insert(text.substr(begin, end - begin));
    parts.insert(text.substr(begin));
    return parts;
}

TEST(KeyPage, HasTheKeysThatTheReadersKnowAndNoOthers) {
    const auto notes = notes_of_readers();
    const auto lines = lines_of_page();
    for (const auto& [path, note] : notes)
        EXPECT_TRUE(has_heading(path) || lines.contains(path)) << path << " is not on the page";
    for (const auto& [path, line] : lines)
        EXPECT_TRUE(notes.contains(path)) << path << " is on the page, unknown to the readers";
}

TEST(KeyPage, HasTheirTypesAndRanges) {
    const auto notes = notes_of_readers();
    for (const auto& [path, line] : lines_of_page()) {
        SCOPED_TRACE(path);
        ASSERT_TRUE(notes.contains(path));
        const KeyNote& note = notes.at(path);
        EXPECT_FALSE(note.types.empty()) << "the cases of this test leave it out";
        std::set<std::string> types = parts_of(line.type, " or ");
        if (line.type == "true or false") types = {line.type};
        EXPECT_EQ(types, note.types);
        EXPECT_LE(note.ranges.size(), 2U);
        for (const std::string& range : note.ranges) {
            // a step of depths and the like have their own line
            EXPECT_EQ(line.range.substr(0, line.range.find(';')), range);
        }
        if (note.ranges.empty()) {
            EXPECT_EQ(line.range, "");
        }
    }
}

TEST(KeyPage, HasTheirDefaults) {
    const auto notes = notes_of_readers();
    for (const auto& [path, line] : lines_of_page()) {
        SCOPED_TRACE(path);
        ASSERT_TRUE(notes.contains(path));
        const KeyNote& note = notes.at(path);
        EXPECT_EQ(note.required, line.standard.starts_with("required"));
        for (const std::string& standard : note.standards) {
            char* end = nullptr;
            const double value = std::strtod(standard.c_str(), &end);
            if (*end == '\0')
                EXPECT_NEAR(std::stod(line.standard), value, 1e-5 * std::abs(value));
            else
                EXPECT_NE(line.standard.find(standard), std::string::npos) << standard;
        }
        const bool states_a_number = !line.standard.empty() && std::isdigit(line.standard[0]) != 0;
        if (note.standards.empty() && path != "torque_drag.depths") {
            EXPECT_FALSE(states_a_number);
        }
    }
}

}  // namespace
}  // namespace drillstrand
