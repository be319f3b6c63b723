/// drillstrand torque-drag: hook load and surface torque against the depth of the bit.
#include "drillstrand/torque_drag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "case_of.hpp"
#include "commands.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/torque_drag_file.hpp"
#include "messages.hpp"
#include "output.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

template <class... Parts>
void line(std::string_view name, fmt::format_string<Parts...> text, Parts&&... parts) {
    fmt::print("  {:<9} {}\n", name, fmt::format(text, std::forward<Parts>(parts)...));
}

/// The word for a motion as people write it.
std::string motion_words(TorqueDragMotion motion) {
    if (motion == TorqueDragMotion::rotating) return "rotating off bottom";
    std::string words = motion_name(motion);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

std::string number(double value, double unit, int decimals) {
    if (!std::isfinite(value)) return "-";
    // no minus before a zero
    const double shown = std::abs(value / unit) < 0.5 * std::pow(10, -decimals) ? 0 : value / unit;
    return fmt::format("{:.{}f}", shown, decimals);
}

std::string mark(BucklingState state) {
    if (state == BucklingState::sinusoidal) return "s";
    return state == BucklingState::helical ? "h" : " ";
}

void print_friction(const Case& input) {
    const auto print = [](const FrictionCoefficients& friction, const std::string& where) {
        line("friction", "{:.4g} along the well, {:.4g} around it{}", friction.axial,
             friction.azimuthal, where);
    };
    const FrictionCoefficients& usual = input.contact.dynamic_friction;
    const std::vector<WellSectionCase>& sections = input.well->sections;
    const bool own =
        std::any_of(sections.begin(), sections.end(),
                    [](const WellSectionCase& section) { return section.dynamic_friction; });
    if (input.torque_drag.friction || !own)
        return print(input.torque_drag.friction.value_or(usual), "");
    for (const WellSectionCase& section : sections)
        print(section.dynamic_friction.value_or(usual), fmt::format(", to {:.6g} m", section.to));
}

void print_case(const Case& input, const TorqueDrag& study) {
    fmt::print("{}: {}\n", input.path.string(), input.title);
    line("string", "cut or lengthened at its top; {} segments of {:.4g} m at the last depth",
         study.segment_s.size(), study.node_s.back() / static_cast<double>(study.segment_s.size()));
    print_friction(input);
    line("bit", "on bottom, {:.6g} kN, where it drills or slides; else off bottom",
         input.bit.weight.values().back() / kilonewton());
    fmt::print("\n");
}

/// A quantity of every curve against the depth of the bit, that of the soft string beside it.
struct Quantity {
    std::string_view name;
    std::string_view unit_name;
    double unit;
    int decimals;
    bool marked;  ///< with the state of buckling
    std::vector<double> TorqueDragCurve::*stiff;
    std::vector<double> TorqueDragCurve::*soft;

    /// One of its values; a hook that would have to push a string down holds none.
    [[nodiscard]] std::string text(double value, TorqueDragMotion motion) const {
        const bool pushes = marked && value < 0 && goes_by_its_weight(motion);
        return pushes ? "locked" : number(value, unit, decimals);
    }
};

const Quantity hook_load{"hook load",
                         "kN",
                         kilonewton(),
                         2,
                         true,
                         &TorqueDragCurve::hook_load,
                         &TorqueDragCurve::soft_hook_load};
const Quantity surface_torque{"surface torque",
                              "kN m",
                              kilonewton_metre(),
                              3,
                              false,
                              &TorqueDragCurve::surface_torque,
                              &TorqueDragCurve::soft_surface_torque};

void print_table(const TorqueDrag& study, const std::vector<const TorqueDragCurve*>& curves,
                 const Quantity& quantity) {
    fmt::print("  {} ({})\n  {:>13}", quantity.name, quantity.unit_name, "");
    for (const TorqueDragCurve* curve : curves)
        fmt::print("  {:^21}", motion_words(curve->motion));
    fmt::print("\n  {:>13}", "bit depth (m)");
    for (std::size_t k = 0; k < curves.size(); ++k)
        fmt::print("  {:>9}   {:>9}", "stiff", "soft");
    fmt::print("\n");
    for (std::size_t i = 0; i < study.bit_depth.size(); ++i) {
        fmt::print("  {:>13.2f}", study.bit_depth[i]);
        for (const TorqueDragCurve* curve : curves)
            fmt::print("  {:>9} {} {:>9}",
                       quantity.text((curve->*quantity.stiff)[i], curve->motion),
                       quantity.marked ? mark(curve->buckling[i]) : " ",
                       quantity.text((curve->*quantity.soft)[i], curve->motion));
        fmt::print("\n");
    }
    fmt::print("\n");
}

/// Pressures and forces of mud that is pumped or pushed aside.
void print_mud(const Case& input, const TorqueDrag& study) {
    if (!input.fluid || (input.fluid->flow_rate == 0 && input.fluid->trip_speed == 0)) return;
    fmt::print("  mud: standpipe (MPa), at the bit (MPa), equivalent density (kg/m3), lift (kN)\n");
    fmt::print("  {:>13}", "");
    for (const TorqueDragCurve& curve : study.curves)
        fmt::print("  {:^32}", motion_words(curve.motion));
    fmt::print("\n  {:>13}\n", "bit depth (m)");
    for (std::size_t i = 0; i < study.bit_depth.size(); ++i) {
        fmt::print("  {:>13.2f}", study.bit_depth[i]);
        for (const TorqueDragCurve& curve : study.curves)
            fmt::print("  {:>7} {:>7} {:>8} {:>7}",
                       number(curve.standpipe_pressure[i], megapascal(), 3),
                       number(curve.bit_pressure[i], megapascal(), 3),
                       number(curve.equivalent_density[i], 1, 1),
                       number(-curve.mud_force[i], kilonewton(), 2));
        fmt::print("\n");
    }
    fmt::print("\n");
}

std::vector<const TorqueDragCurve*> all_of(const TorqueDrag& study) {
    std::vector<const TorqueDragCurve*> curves;
    for (const TorqueDragCurve& curve : study.curves)
        curves.push_back(&curve);
    return curves;
}

/// The motions with a torque.
std::vector<const TorqueDragCurve*> turning_of(const TorqueDrag& study) {
    std::vector<const TorqueDragCurve*> curves = all_of(study);
    std::erase_if(curves, [](const TorqueDragCurve* curve) {
        return curve->motion != TorqueDragMotion::rotating &&
               curve->motion != TorqueDragMotion::drilling;
    });
    return curves;
}

bool is_buckled(BucklingState state) {
    return state == BucklingState::sinusoidal || state == BucklingState::helical;
}

void print_legend(const TorqueDrag& study) {
    const bool buckled =
        std::any_of(study.curves.begin(), study.curves.end(), [](const TorqueDragCurve& curve) {
            return std::any_of(curve.buckling.begin(), curve.buckling.end(), is_buckled);
        });
    if (buckled)
        fmt::print("  s, h: somewhere compression is past the sinusoidal, the helical limit\n\n");
    const bool locked =
        std::any_of(study.curves.begin(), study.curves.end(), [](const TorqueDragCurve& curve) {
            return goes_by_its_weight(curve.motion) &&
                   std::any_of(curve.hook_load.begin(), curve.hook_load.end(),
                               [](double load) { return load < 0; });
        });
    if (locked) fmt::print("  locked: only a push from above would take the string down\n\n");
}

std::string largest_text(const std::vector<double>& values, const std::vector<double>& depths,
                         double unit, int decimals) {
    const auto largest = std::max_element(values.begin(), values.end());
    if (!std::isfinite(*largest)) return fmt::format("{:>9} {:>9}", "-", "-");
    const double depth = depths[static_cast<std::size_t>(largest - values.begin())];
    return fmt::format("{:>9} {:>9.1f}", number(*largest, unit, decimals), depth);
}

/// How much of the string is past each limit.
std::string buckling_text(const TorqueDrag& study, const TorqueDragProfile& profile) {
    if (profile.buckling.front() == BucklingState::unknown) return "-";
    const double segment = study.node_s.back() / static_cast<double>(study.segment_s.size());
    std::array<double, 3> length{};
    for (const BucklingState state : profile.buckling)
        length[static_cast<std::size_t>(state)] += segment;
    std::string text;
    if (length[1] > 0) text = fmt::format("sinusoidal over {:.4g} m", length[1]);
    if (length[2] > 0)
        text += fmt::format("{}helical over {:.4g} m", text.empty() ? "" : ", ", length[2]);
    return text.empty() ? "none" : text;
}

void print_last_depth(const TorqueDrag& study) {
    fmt::print(
        "  with the bit at {:.2f} m: where tension ends, going down; the largest values and "
        "their measured depths; compression past its limits\n",
        study.bit_depth.back());
    fmt::print("  {:<19}  {:>11}  {:>19}  {:>19}  {:>19}  {}\n", "", "neutral", "side force",
               "bending stress", "von Mises stress", "");
    fmt::print("  {:<19}  {:>11}", "", "point (m)");
    for (const std::string_view unit : {"(kN/m)", "(MPa)", "(MPa)"})
        fmt::print("  {:>9} {:>9}", unit, "at (m)");
    fmt::print("  {}\n", "buckling");
    for (const TorqueDragCurve& curve : study.curves) {
        const TorqueDragProfile& profile = curve.profile;
        fmt::print("  {:<19}  {:>11}", motion_words(curve.motion),
                   number(curve.neutral_point.back(), 1, 2));
        fmt::print("  {}", largest_text(profile.side_force, study.measured_depth,
                                        kilonewton_per_metre(), 3));
        fmt::print("  {}",
                   largest_text(profile.bending_stress, study.measured_depth, megapascal(), 1));
        fmt::print("  {}",
                   largest_text(profile.von_mises_stress, study.measured_depth, megapascal(), 1));
        fmt::print("  {}\n", buckling_text(study, profile));
    }
}

/// How deep the string gets by its own weight, and how much of that the bit.
void print_limits(const Case& input, const TorqueDrag& study) {
    for (const TorqueDragCurve& curve : study.curves) {
        const bool slides = curve.motion == TorqueDragMotion::sliding;
        const std::string with = slides
                                     ? fmt::format(" with {:.4g} kN on the bit",
                                                   input.bit.weight.values().back() / kilonewton())
                                     : "";
        if (std::isfinite(curve.lock_up_depth))
            fmt::print(
                "  {}: cannot go below {:.1f} m{}: friction bears all of the string's weight\n",
                motion_words(curve.motion), curve.lock_up_depth, with);
        if (std::isfinite(curve.largest_weight))
            fmt::print(
                "  {}: at most {:.4g} kN reach the bit at {:.2f} m, with nothing on the hook\n",
                motion_words(curve.motion), curve.largest_weight / kilonewton(),
                study.bit_depth.back());
    }
    fmt::print("\n");
}

void print_failures(const TorqueDrag& study) {
    for (const TorqueDragCurve& curve : study.curves) {
        if (curve.failures.empty()) continue;
        const TorqueDragFailure& first = curve.failures.front();
        say("drillstrand: warning: {}: no equilibrium of the stiff string at {} of {} "
            "depths, - above and NaN in files; the first, at {:.6g} m: {}\n",
            motion_words(curve.motion), curve.failures.size(), study.bit_depth.size(),
            first.bit_depth, first.reason);
    }
}

bool found_something(const TorqueDrag& study) {
    return std::any_of(study.curves.begin(), study.curves.end(), [&](const TorqueDragCurve& curve) {
        return curve.failures.size() < study.bit_depth.size();
    });
}

void require_outputs(const TorqueDragCommand& command, const OutputRules& rules) {
    require_output("-o", command.output, rules);
    require_output("--csv", command.table, rules);
    require_output("--profile-csv", command.profile_table, rules);
    require_different("-o", command.output, "--csv", command.table);
    require_different("-o", command.output, "--profile-csv", command.profile_table);
    require_different("--csv", command.table, "--profile-csv", command.profile_table);
}

void write_files(const TorqueDragCommand& command, const Case& input, const TorqueDrag& study) {
    const Existing existing = command.overwrite ? Existing::replace : Existing::keep;
    if (!command.table.empty()) write_torque_drag_table(command.table, study, existing);
    if (!command.profile_table.empty())
        write_torque_drag_profile_table(command.profile_table, study, existing);
    if (command.output.empty()) return;
    TorqueDragResult result;
    result.header.title = input.title;
    result.header.case_text = input.text;
    result.header.node_s = study.node_s;
    result.header.segment_s = study.segment_s;
    result.study = study;
    write_torque_drag(command.output, result, existing);
}

}  // namespace

int torque_drag(const TorqueDragCommand& command) {
    const Case input = case_of(command.case_path, command.overrides);
    require_outputs(command, {command.overwrite, inputs_of(input)});
    const TorqueDrag study = compute_torque_drag(input, input.run.threads);
    write_files(command, input, study);
    print_case(input, study);
    print_table(study, all_of(study), hook_load);
    if (!turning_of(study).empty()) print_table(study, turning_of(study), surface_torque);
    print_legend(study);
    print_mud(input, study);
    print_last_depth(study);
    print_limits(input, study);
    print_failures(study);
    return found_something(study) ? done : simulation_failed;
}

}  // namespace drillstrand::program
