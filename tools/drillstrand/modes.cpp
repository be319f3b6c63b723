/// drillstrand modes: natural frequencies, critical speeds and harmonic response of the string
/// about its static state.
#include "drillstrand/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "case_of.hpp"
#include "commands.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/modes_file.hpp"
#include "drillstrand/scene.hpp"
#include "drillstrand/units.hpp"
#include "messages.hpp"
#include "output.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

double in_hertz(double frequency) {
    return frequency / hertz();
}

double in_rpm(double rate) {
    return rate / revolution_per_minute();
}

/// The numbers of "A:B" or "A:B:C".
std::vector<double> numbers_of(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (true) {
        double number = 0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number)) return {};
        numbers.push_back(number);
        if (after == end) return numbers;
        if (*after != ':') return {};
        at = after + 1;
    }
}

/// Rates in rad/s; none where no range is given.
std::vector<double> rates_of(const std::string& range) {
    if (range.empty()) return {};
    constexpr double usual_steps = 20;
    constexpr double most_steps = 10000;
    const std::vector<double> ends = numbers_of(range);
    const bool is_range = (ends.size() == 2 || ends.size() == 3) && ends[0] >= 0 &&
                          ends[1] > ends[0] && (ends.size() == 2 || ends[2] > 0);
    if (!is_range)
        throw UsageError(fmt::format(
            "--campbell {}: that is no range; write rates in rpm as FROM:TO or FROM:TO:STEP, as "
            "in 0:200:10",
            range));
    const double step = ends.size() == 3 ? ends[2] : (ends[1] - ends[0]) / usual_steps;
    // a last step that rounding makes a little too long still counts
    const double steps = std::floor((ends[1] - ends[0]) / step + 1e-9);
    if (steps > most_steps)
        throw UsageError(fmt::format("--campbell {}: more than {} rates; take a longer step", range,
                                     most_steps));
    std::vector<double> rates;
    for (double k = 0; k <= steps; ++k)
        rates.push_back((ends[0] + k * step) * revolution_per_minute());
    return rates;
}

double amplitude_of(const char* option, const std::string& text, const Dimension& dimension) {
    if (text.empty()) return 0;
    try {
        return parse_quantity(text, dimension);
    } catch (const std::invalid_argument& error) {
        throw UsageError(fmt::format("{} {}: {}", option, text, error.what()));
    }
}

/// At which the bit of a case strikes in each turn; none where it has neither blades nor cones.
std::optional<double> order_of_bit(const BitCase& bit) {
    if (bit.law == BitLaw::cutting) return bit.cutting.blades;
    if (bit.law == BitLaw::roller_cone) return bit.roller_cone.lobes;
    return std::nullopt;
}

std::vector<double> orders_of(const ModesCommand& command, const BitCase& bit) {
    std::vector<double> orders = command.orders;
    if (orders.empty()) {
        orders = {1};
        if (const auto own = order_of_bit(bit)) orders.push_back(*own);
    }
    std::sort(orders.begin(), orders.end());
    orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
    return orders;
}

/// None where no response is asked for.
std::optional<Excitation> excitation_of(const ModesCommand& command, const Case& input,
                                        const Scene& scene) {
    Excitation excitation;
    excitation.bit_force = amplitude_of("--bit-force", command.bit_force, dimension::force);
    excitation.bit_torque = amplitude_of("--bit-torque", command.bit_torque, dimension::moment);
    const bool at_bit = excitation.bit_force != 0 || excitation.bit_torque != 0;
    if (!at_bit && !command.unbalance) return std::nullopt;
    if (at_bit && command.unbalance)
        throw UsageError(
            "--unbalance, --bit-force: they shake the string at rates of their own; ask for one "
            "of them");
    if (command.unbalance && scene.mesh.unbalance.empty())
        throw InputError({input.path.string()},
                         "--unbalance: the string has none; give a component an eccentric_mass");
    excitation.unbalance = command.unbalance;
    if (at_bit)
        excitation.order = command.bit_order.value_or(order_of_bit(input.bit).value_or(1.0));
    return excitation;
}

/// What the command is about to find, from the command line and the case.
struct Study {
    EquilibriumOptions equilibrium;
    double rotation_rate = 0;
    WallGrip grip = WallGrip::sticks;
    std::vector<double> rates;
    std::vector<double> orders;
    std::optional<Excitation> excitation;

    /// Of the response.
    [[nodiscard]] std::vector<double> shaken_rates() const {
        return rates.empty() ? std::vector<double>{rotation_rate} : rates;
    }
};

Study study_of(const ModesCommand& command, const Case& input, const Scene& scene) {
    Study study;
    study.equilibrium = equilibrium_options(input);
    study.rotation_rate = command.rpm ? *command.rpm * revolution_per_minute()
                                      : std::abs(study.equilibrium.motion.rotation_rate);
    study.rates = rates_of(command.campbell);
    study.orders = orders_of(command, input.bit);
    study.excitation = excitation_of(command, input, scene);
    if (study.excitation && study.rates.empty() && study.rotation_rate == 0)
        throw UsageError(
            "the response to a harmonic load needs a string that turns; give --rpm, or a range "
            "with --campbell");
    const bool rests =
        study.equilibrium.motion.is_rest() && study.rotation_rate == 0 && study.rates.empty();
    study.grip = rests ? WallGrip::sticks : WallGrip::slides;
    return study;
}

ModesResult result_of(const ModesCommand& command, const Study& study,
                      const StringVibration& string) {
    ModesResult result;
    result.rotation_rate = study.rotation_rate;
    result.grip = study.grip;
    result.shape = string.static_shape();
    result.modes = string.modes(study.rotation_rate, command.number);
    if (!study.rates.empty()) {
        result.campbell = string.campbell(study.rates, command.number);
        for (const double order : study.orders)
            for (const CriticalSpeed& speed :
                 string.critical_speeds(order, study.rates.back(), command.number))
                result.critical_speeds.push_back(speed);
    }
    result.excitation = study.excitation;
    if (study.excitation)
        result.response = string.response(*study.excitation, study.shaken_rates());
    return result;
}

template <class... Parts>
void line(std::string_view name, fmt::format_string<Parts...> text, Parts&&... parts) {
    fmt::print("  {:<12} {}\n", name, fmt::format(text, std::forward<Parts>(parts)...));
}

void print_string(const Case& input, const Scene& scene, const Study& study,
                  const StaticShape& shape, double seconds) {
    fmt::print("{}: {}\n", input.path.string(), input.title);
    line("string", "{:.6g} m in {} segments, head {}", scene.mesh.node_s.back(), scene.segments,
         scene.head.motion == HeadMotion::pinned ? "pinned" : "clamped");
    line("static state", "{}", motion_word(input.equilibrium.motion));
    const auto touching = std::count_if(shape.side_force.begin(), shape.side_force.end(),
                                        [](double force) { return force > 0; });
    if (scene.well)
        line("contact", "{} of {} nodes; {}", touching, shape.side_force.size(),
             study.grip == WallGrip::sticks ? "they stick to the wall"
                                            : "they slide along the wall");
    line("turning", "{:.4g} rpm", in_rpm(study.rotation_rate));
    line("search", "{} in all", duration_text(seconds));
}

/// Whether a mode goes round with the rotation, against it, or to and fro.
std::string_view whirl_word(ModeKind kind, double whirl) {
    constexpr double round = 0.1;
    if (kind != ModeKind::lateral) return "";
    if (whirl > round) return "forward";
    return whirl < -round ? "backward" : "to and fro";
}

void print_modes(const std::vector<VibrationMode>& modes) {
    fmt::print("\n  {:>4}  {:>12}  {:>10}  {:<9}  {:<10}  {:>7}  {:>9}  {:>14}\n", "mode",
               "frequency Hz", "rpm", "kind", "whirl", "share %", "crossings", "bends most at m");
    for (std::size_t k = 0; k < modes.size(); ++k) {
        const VibrationMode& mode = modes[k];
        const double share = std::max({mode.lateral_share, mode.torsional_share, mode.axial_share});
        fmt::print("  {:>4}  {:>12.6g}  {:>10.5g}  {:<9}  {:<10}  {:>7.3g}  {:>9}  {:>14.5g}\n",
                   k + 1, in_hertz(mode.frequency), in_rpm(mode.frequency),
                   mode_kind_name(mode.kind), whirl_word(mode.kind, mode.whirl), 100 * share,
                   mode.crossings, mode.bending_place);
    }
}

/// "b", "f" and "l" of lateral modes backward, forward and to and fro, "t" torsional, "a" axial.
char mark_of(const CampbellPoint& point) {
    if (point.kind != ModeKind::lateral) return mode_kind_name(point.kind).front();
    const std::string_view word = whirl_word(point.kind, point.whirl);
    return word == "to and fro" ? 'l' : word.front();
}

void print_campbell(const std::vector<CampbellPoint>& points, std::size_t number) {
    fmt::print(
        "\n  {:>7}  frequencies in Hz (f forward, b backward, l lateral, t torsional, a axial)\n",
        "rpm");
    for (std::size_t i = 0; i < points.size(); i += number) {
        fmt::print("  {:>7.4g} ", in_rpm(points[i].rotation_rate));
        for (std::size_t k = i; k < i + number; ++k)
            fmt::print(" {:>8.4g}{}", in_hertz(points[k].frequency), mark_of(points[k]));
        fmt::print("\n");
    }
}

void print_critical_speeds(const StringVibration& string, const Study& study,
                           const std::vector<CriticalSpeed>& speeds) {
    const double highest = study.rates.back();
    fmt::print("\n  {:>14}  {:>10}  {:>12}  {:<9}  {}\n", "critical speed", "rpm", "frequency Hz",
               "kind", "whirl");
    for (const CriticalSpeed& speed : speeds)
        fmt::print("  {:>12.4g} x  {:>10.5g}  {:>12.6g}  {:<9}  {}\n", speed.order,
                   in_rpm(speed.rotation_rate), in_hertz(speed.order * speed.rotation_rate),
                   mode_kind_name(speed.kind), whirl_word(speed.kind, speed.whirl));
    for (const double order : study.orders)
        fmt::print("  {:>12.4g} x  {} in all below {:.4g} rpm\n", order,
                   string.count_critical_speeds(order, highest), in_rpm(highest));
}

/// The largest of some values, and where along the string it is.
struct Peak {
    double value;
    double place;
};

Peak peak_of(const std::vector<double>& values, const std::vector<double>& places) {
    const auto most = std::max_element(values.begin(), values.end());
    return {*most, places[static_cast<std::size_t>(most - values.begin())]};
}

std::string excitation_text(const Excitation& excitation) {
    if (excitation.unbalance) return "to the eccentric masses";
    return fmt::format("to {:.4g} kN and {:.4g} kN m at the bit, {:.4g} x the rate",
                       excitation.bit_force / kilonewton(),
                       excitation.bit_torque / kilonewton_metre(), excitation.order);
}

void print_response(const ModesResult& result, const StringMesh& mesh) {
    fmt::print("\n  response {}: amplitudes, and where along the string (m)\n",
               excitation_text(*result.excitation));
    fmt::print("  {:>7}  {:>9}  {:>20}  {:>20}  {:>20}  {:>20}  {:>20}\n", "rpm", "Hz",
               "displacement mm", "bending kN m", "side force kN", "torque kN m", "axial kN");
    for (const ForcedResponse& at : result.response) {
        fmt::print("  {:>7.4g}  {:>9.4g}", in_rpm(at.rotation_rate), in_hertz(at.frequency));
        const auto print = [](double unit, const Peak& peak) {
            fmt::print("  {:>10.4g} {:>9.5g}", peak.value / unit, peak.place);
        };
        print(millimetre(), peak_of(at.displacement, mesh.node_s));
        print(kilonewton_metre(), peak_of(at.bending_moment, mesh.segment_s));
        print(kilonewton(), peak_of(at.side_force, mesh.node_s));
        print(kilonewton_metre(), peak_of(at.torque, mesh.segment_s));
        print(kilonewton(), peak_of(at.axial_force, mesh.segment_s));
        fmt::print("\n");
    }
}

void print_notes(const StringVibration& string, const ModesResult& result, const Scene& scene) {
    for (const std::string& warning : string.warnings())
        say("drillstrand: warning: {}\n", warning);
    if (scene.features.curved && result.rotation_rate > 0)
        say("drillstrand: note: a string that is bent by itself, or has an eccentric mass, moves "
            "as it turns; its frequencies are those of the state in which it was found\n");
    const auto lifted =
        std::find_if(result.response.begin(), result.response.end(),
                     [](const ForcedResponse& response) { return response.lifts_off != 0; });
    if (lifted != result.response.end())
        say("drillstrand: warning: at {:.4g} rpm, to begin with, the string lifts off the wall: "
            "more "
            "than the linear response can tell\n",
            in_rpm(lifted->rotation_rate));
}

std::filesystem::path output_of(const ModesCommand& command) {
    if (!command.output.empty()) return command.output;
    return command.case_path.stem().string() + "_modes.h5";
}

void write(const std::filesystem::path& output, const ModesCommand& command, const Case& input,
           const Scene& scene, ModesResult& result) {
    result.header.title = input.title;
    result.header.case_text = input.text;
    result.header.node_s = scene.mesh.node_s;
    result.header.segment_s = scene.mesh.segment_s;
    write_modes(output, result, command.overwrite ? Existing::replace : Existing::keep);
}

void require_possible(const ModesCommand& command, const Case& input, const Scene& scene) {
    if (input.head.motion == HeadMotion::free)
        throw InputError({input.path.string()},
                         "head.motion = \"free\": nothing holds the string; modes need a held "
                         "head, motion = \"driven\" or \"pinned\"");
    const std::size_t most = StringVibration::most_modes(scene);
    if (command.number > most)
        throw UsageError(
            fmt::format("--number {}: a string of {} segments can tell {} modes; ask for fewer, or "
                        "for more segments",
                        command.number, scene.segments, most));
}

}  // namespace

int modes(const ModesCommand& command) {
    const Case input = case_of(command.case_path, command.overrides);
    const std::filesystem::path output = output_of(command);
    require_output("-o", output, {command.overwrite, inputs_of(input)});
    const Scene scene = build_static_scene(input);
    require_possible(command, input, scene);
    const Study study = study_of(command, input, scene);
    const auto start = std::chrono::steady_clock::now();
    const StringVibration string(scene, study.equilibrium, study.grip);
    ModesResult result = result_of(command, study, string);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write(output, command, input, scene, result);

    print_string(input, scene, study, result.shape, seconds);
    print_modes(result.modes);
    if (!result.campbell.empty()) {
        print_campbell(result.campbell, command.number);
        print_critical_speeds(string, study, result.critical_speeds);
    }
    if (result.excitation) print_response(result, scene.mesh);
    print_notes(string, result, scene);
    fmt::print("\n  {}\n", output.string());
    return done;
}

}  // namespace drillstrand::program
