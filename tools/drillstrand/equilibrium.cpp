/// drillstrand equilibrium: the string at rest, or in steady motion against friction.
#include "drillstrand/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "case_of.hpp"
#include "commands.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/hydraulics.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/scene.hpp"
#include "messages.hpp"
#include "output.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

template <class... Parts>
void line(std::string_view name, fmt::format_string<Parts...> text, Parts&&... parts) {
    fmt::print("  {:<12} {}\n", name, fmt::format(text, std::forward<Parts>(parts)...));
}

/// Where the bit is, with which weight.
std::string bottom_text(StringMotion motion, double weight_on_bit) {
    const bool rests_off = motion == StringMotion::rest && weight_on_bit == 0;
    if (!bit_is_loaded(motion) || rests_off) return "off bottom";
    return fmt::format("on bottom, {:.6g} kN", weight_on_bit / kilonewton());
}

std::string motion_text(StringMotion word, const SteadyMotion& motion, double weight_on_bit) {
    std::string text = fmt::format("{}, {}", motion_word(word), bottom_text(word, weight_on_bit));
    // alone, a speed along the well has a direction but no size that matters
    if (motion.rotation_rate != 0)
        text += fmt::format(", {:.4g} rpm", motion.rotation_rate / revolution_per_minute());
    if (motion.rotation_rate != 0 && motion.axial_speed != 0)
        text += fmt::format(", {:.4g} m/s along the well", motion.axial_speed);
    return text;
}

/// A force or couple (N, N m) in a unit; less than a billionth is a rounding error.
double in(double unit, double value) {
    return std::abs(value) < 1e-9 ? 0.0 : value / unit;
}

std::string vector_text(double unit, const Eigen::Vector3d& v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", in(unit, v.x()), in(unit, v.y()),
                       in(unit, v.z()));
}

void print_contact(const Scene& scene, const Equilibrium& found) {
    if (!scene.well) {
        line("contact", "none, there is no well");
        return;
    }
    const std::vector<double>& side = found.profile.normal_force;
    double total = 0;
    for (std::size_t k = 0; k < side.size(); ++k)
        total += side[k] * scene.mesh.cell[k];
    line("contact", "{} of {} nodes, at most {:.4g} m into the wall", found.series.contact_nodes,
         side.size(), found.series.max_penetration);
    const auto place_of = [&](const std::vector<double>& values, auto entry) {
        return scene.mesh.node_s[static_cast<std::size_t>(entry - values.begin())];
    };
    const std::vector<double>& mean = found.profile.side_force;
    const auto worst = std::max_element(mean.begin(), mean.end());
    const auto worst_node = std::max_element(side.begin(), side.end());
    line("side force",
         "{:.6g} kN in all, at most {:.6g} kN/m over {:.4g} m, {:.5g} m from the head",
         total / kilonewton(), *worst / kilonewton_per_metre(), scene.side_force_window,
         place_of(mean, worst));
    line("", "{:.6g} kN/m on one node, {:.5g} m from the head",
         *worst_node / kilonewton_per_metre(), place_of(side, worst_node));
}

void print_mud(const Scene& scene, double trip_speed) {
    const MudMotion motion = mud_motion(scene, trip_speed);
    if (motion.is_rest()) return;
    const Hydraulics mud = hydraulics_of(scene, motion);
    line("mud", "{:.4g} MPa at the standpipe, {:.4g} MPa at the bit ({:.5g} kg/m3), lift {:.6g} kN",
         mud.standpipe_pressure / megapascal(), mud.bit_pressure / megapascal(),
         mud.equivalent_density, in(kilonewton(), -mud.axial_force));
}

void print_equilibrium(const Case& input, const Scene& scene, const Equilibrium& found,
                       const EquilibriumOptions& options, double seconds) {
    fmt::print("{}: {}\n", input.path.string(), input.title);
    line("motion", "{}",
         motion_text(input.equilibrium.motion, options.motion, found.series.weight_on_bit));
    line("hook load", "{:.9g} kN", in(kilonewton(), found.hook_load));
    line("head torque", "{:.6g} kN m", in(kilonewton_metre(), found.surface_torque));
    line("head stress", "{:.9g} kN axial, {:.6g} kN m twist, in the first segment",
         in(kilonewton(), found.series.head_stress[3]),
         in(kilonewton_metre(), found.series.head_stress[0]));
    line("bit stress", "{:.9g} kN axial, {:.6g} kN m twist, in the last segment",
         in(kilonewton(), found.series.bit_stress[3]),
         in(kilonewton_metre(), found.series.bit_stress[0]));
    line("bit load", "{} kN, {} kN m (north, east, down)",
         vector_text(kilonewton(), found.bit_force),
         vector_text(kilonewton_metre(), found.bit_couple));
    const Eigen::Vector3d& bit = found.series.bit_position;
    line("bit position", "({:.9f}, {:.9f}, {:.9f}) m", bit.x(), bit.y(), bit.z());
    print_mud(scene, options.trip_speed);
    print_contact(scene, found);
    line("search", "{} iterations in {}, {:.2g} N out of balance", found.iterations,
         duration_text(seconds), found.residual);
}

void write(const EquilibriumCommand& command, const Case& input, const Scene& scene,
           const Equilibrium& found, double seconds) {
    ResultHeader header = result_header(input, scene);
    header.integrator = "equilibrium";
    ResultWriter writer(command.output, header,
                        command.overwrite ? Existing::replace : Existing::keep);
    writer.append(found.series);
    writer.append(found.profile);
    ResultFooter footer;
    footer.status = "complete";
    footer.warnings = input.warnings;
    footer.wall_seconds = seconds;
    footer.statistics.steps = found.iterations;
    writer.close(footer);
}

}  // namespace

int equilibrium(const EquilibriumCommand& command) {
    const Case input = case_of(command.case_path, command.overrides);
    require_output("-o", command.output, {command.overwrite, inputs_of(input)});
    if (input.head.motion == HeadMotion::free)
        throw InputError({input.path.string()},
                         "head.motion = \"free\": nothing holds the string; an equilibrium needs a "
                         "held head, motion = \"driven\"");
    const Scene scene = build_static_scene(input);
    const EquilibriumOptions options = equilibrium_options(input);

    const auto start = std::chrono::steady_clock::now();
    const Equilibrium found = find_equilibrium(scene, options);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!command.output.empty()) write(command, input, scene, found, seconds);
    print_equilibrium(input, scene, found, options, seconds);
    for (const std::string& warning : found.warnings)
        say("drillstrand: warning: {}\n", warning);
    return done;
}

}  // namespace drillstrand::program
