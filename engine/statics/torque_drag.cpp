#include "drillstrand/torque_drag.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "drillstrand/equilibrium.hpp"
#include "drillstrand/error.hpp"
#include "drillstrand/hydraulics.hpp"
#include "drillstrand/side_force.hpp"
#include "model/survey.hpp"
#include "statics/arc_section.hpp"
#include "statics/buckling_limits.hpp"
#include "statics/in_parallel.hpp"
#include "statics/tripped_string.hpp"

namespace drillstrand {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// What the cross section of a segment makes of its loads, and how it lies.
struct Site {
    double area = 0;             ///< of metal (m2)
    double inner_area = 0;       ///< of the bore (m2)
    double outer_area = 0;       ///< of the outer circle (m2)
    double section_modulus = 0;  ///< I / R (m3)
    BucklingLimits limits;
};

/// The string with its bit at one depth.
struct TrippedString {
    Case input;
    Scene scene;
    std::vector<double> measured_depth;  ///< middles of the segments (m)
    std::vector<Site> sites;             ///< there
};

/// One motion at one depth.
struct Answer {
    double hook_load = nan;
    double surface_torque = nan;
    double neutral_point = nan;
    double standpipe_pressure = 0;
    double bit_pressure = 0;
    double equivalent_density = 0;
    double mud_force = 0;
    BucklingState buckling = BucklingState::unknown;
    SoftLoad soft;
    TorqueDragProfile profile;
    std::optional<std::string> failure;
};

void check_fit(const Case& input, const Component& pipe, double hole_radius, double depth) {
    const double widest = 2 * touching_radius(pipe);
    if (widest <= 2 * hole_radius + input.contact.interference) return;
    throw InputError({input.path.string()},
                     fmt::format("a pipe of {:.9g} m comes to a measured depth of {:.9g} m, where "
                                 "the hole has {:.9g} m; give torque_drag.depths at which the "
                                 "string fits",
                                 widest, depth, 2 * hole_radius));
}

Site site_at(const Case& input, const Scene& scene, double s) {
    const Component& pipe = component_at(input.string, s);
    const SectionProperties section = section_properties(pipe, input.string.shear_coefficient);
    const Well& well = *scene.well;
    const double depth = well.measured_depth_start() + s;
    const WellArc& arc = well.arcs()[well.arc_at(depth)];
    const double hole_radius = well.at(depth).radius;
    check_fit(input, pipe, hole_radius, depth);
    const ArcSection axis = arc_section(arc, depth);
    const double second_moment =
        std::numbers::pi / 64 *
        (std::pow(pipe.outer_diameter, 4) - std::pow(pipe.inner_diameter, 4));
    Site site;
    site.area =
        std::numbers::pi / 4 *
        (pipe.outer_diameter * pipe.outer_diameter - pipe.inner_diameter * pipe.inner_diameter);
    site.inner_area = inner_area(section);
    site.outer_area = section.outer_area;
    site.section_modulus = second_moment / section.outer_radius;
    site.limits = buckling_limits(
        {.bending_stiffness = section.bending_stiffness,
         .weight = buoyed_weight(section, input.fluid, input.gravity),
         .clearance = std::max(hole_radius - touching_radius(pipe), 0.01 * hole_radius),
         .direction = axis.direction,
         .curvature = axis.curvature,
         .down = scene.down});
    return site;
}

TrippedString string_at(const Case& input, double bit_depth) {
    TrippedString result;
    result.input = case_at_depth(input, bit_depth);
    result.scene = build_static_scene(result.input);
    for (const double s : result.scene.mesh.segment_s) {
        result.measured_depth.push_back(result.scene.well->measured_depth_start() + s);
        result.sites.push_back(site_at(result.input, result.scene, s));
    }
    return result;
}

BucklingState buckling_state(double tension, const BucklingLimits& limits) {
    if (-tension > limits.helical) return BucklingState::helical;
    return -tension > limits.sinusoidal ? BucklingState::sinusoidal : BucklingState::none;
}

/// Axial force, bending and torsion at the outer fibre.
double von_mises_stress(double axial, double bending, double shear) {
    return std::hypot(std::abs(axial) + bending, std::numbers::sqrt3 * shear);
}

void describe_site(const Site& site, const Vector6& stress, TorqueDragProfile& profile) {
    const double bending = stress.segment<2>(1).norm() / site.section_modulus;
    const double shear = stress[0] / (2 * site.section_modulus);
    profile.tension.push_back(stress[3]);
    profile.torque.push_back(0.0 - stress[0]);  // no minus before a zero
    profile.bending_stress.push_back(bending);
    profile.von_mises_stress.push_back(von_mises_stress(stress[3] / site.area, bending, shear));
    profile.buckling.push_back(buckling_state(stress[3], site.limits));
}

void describe_stiff(const TrippedString& string, const Equilibrium& found,
                    TorqueDragProfile& profile) {
    for (std::size_t k = 0; k < string.sites.size(); ++k)
        describe_site(string.sites[k], found.profile.stress[k], profile);
    const StringMesh& mesh = string.scene.mesh;
    profile.side_force = side_force(mesh.node_s, found.profile.normal_force,
                                    string.scene.side_force_window, mesh.segment_s);
}

void describe_soft(const TrippedString& string, const SoftProfile& soft,
                   TorqueDragProfile& profile) {
    for (const Site& site : string.sites) {
        profile.sinusoidal_limit.push_back(site.limits.sinusoidal);
        profile.helical_limit.push_back(site.limits.helical);
    }
    for (const SoftLoad& load : soft.load) {
        profile.soft_tension.push_back(load.tension);
        profile.soft_torque.push_back(load.torque);
    }
    profile.soft_side_force = soft.side_force;
}

/// Pressures of the mud in motion, and the tension of the metal that they make of the effective
/// one.
void describe_mud(const TrippedString& string, const MudMotion& motion, Answer& answer) {
    const Scene& scene = string.scene;
    if (!scene.fluid) {
        const std::vector<double> none(string.sites.size(), 0);
        answer.profile.inside_pressure = answer.profile.outside_pressure = none;
        answer.profile.true_tension = answer.profile.tension;
        return;
    }
    const Hydraulics mud = hydraulics_of(scene, motion);
    answer.standpipe_pressure = mud.standpipe_pressure;
    answer.bit_pressure = mud.bit_pressure;
    answer.equivalent_density = mud.equivalent_density;
    answer.mud_force = mud.axial_force;
    for (std::size_t k = 0; k < string.sites.size(); ++k) {
        const Site& site = string.sites[k];
        const double inside = 0.5 * (mud.inside_pressure[k] + mud.inside_pressure[k + 1]);
        const double outside = 0.5 * (mud.outside_pressure[k] + mud.outside_pressure[k + 1]);
        const double momentum =
            scene.fluid->density * motion.flow_rate * motion.flow_rate / site.inner_area;
        answer.profile.inside_pressure.push_back(inside);
        answer.profile.outside_pressure.push_back(outside);
        answer.profile.true_tension.push_back(answer.profile.tension[k] + inside * site.inner_area +
                                              momentum - outside * site.outer_area);
    }
}

/// A tension somewhere along the string.
struct TensionAt {
    double measured_depth;  ///< m
    double tension;         ///< N
};

/// Where tension ends, from the head down, by linear interpolation; the last place where it does
/// not end.
double neutral_point(const std::vector<TensionAt>& string) {
    if (string.front().tension < 0) return string.front().measured_depth;
    for (std::size_t k = 1; k < string.size(); ++k) {
        const TensionAt& above = string[k - 1];
        const TensionAt& below = string[k];
        if (below.tension >= 0) continue;
        const double share = above.tension / (above.tension - below.tension);
        return above.measured_depth + share * (below.measured_depth - above.measured_depth);
    }
    return string.back().measured_depth;
}

double neutral_point(const TrippedString& string, const Answer& answer, double bit_tension) {
    const double start = string.scene.well->measured_depth_start();
    std::vector<TensionAt> tensions{{start, answer.hook_load}};
    for (std::size_t k = 0; k < string.sites.size(); ++k)
        tensions.push_back({string.measured_depth[k], answer.profile.tension[k]});
    tensions.push_back({start + string.scene.mesh.node_s.back(), bit_tension});
    return neutral_point(tensions);
}

void answer_stiff(const TrippedString& string, const Equilibrium& found, double bit_tension,
                  Answer& answer) {
    answer.hook_load = found.hook_load;
    answer.surface_torque = 0.0 + found.surface_torque;
    describe_stiff(string, found, answer.profile);
    answer.neutral_point = neutral_point(string, answer, bit_tension);
    answer.buckling =
        *std::max_element(answer.profile.buckling.begin(), answer.profile.buckling.end());
}

/// Values of a profile that no equilibrium gave.
void leave_open(TorqueDragProfile& profile) {
    const std::size_t count = profile.soft_tension.size();
    for (auto* values : {&profile.tension, &profile.torque, &profile.side_force,
                         &profile.bending_stress, &profile.von_mises_stress})
        values->assign(count, nan);
    profile.buckling.assign(count, BucklingState::unknown);
}

/// Equilibria of one string in motion, which start from equilibria of the string at rest.
class Tripping {
  public:
    explicit Tripping(const TrippedString& string) : string_(string) {}

    Answer answer(TorqueDragMotion motion) {
        const EquilibriumOptions options = tripping_options(string_.input, motion);
        const SoftString soft = soft_string(string_.input, string_.scene, options);
        const SoftProfile soft_profile =
            solve_soft_string(soft, *string_.scene.well, string_.measured_depth);
        Answer result;
        result.soft = soft_profile.at_head;
        describe_soft(string_, soft_profile, result.profile);
        try {
            answer_stiff(string_, moving(options), soft.at_bit.tension, result);
        } catch (const SimulationError& error) {
            result.failure = error.what();
            leave_open(result.profile);
        }
        describe_mud(string_, mud_motion(string_.scene, options.trip_speed), result);
        return result;
    }

  private:
    Equilibrium moving(EquilibriumOptions options) {
        options.start = options.bit_loads ? on_bottom(options) : off_bottom(options);
        return find_equilibrium(string_.scene, options);
    }

    const InitialNodes& off_bottom(EquilibriumOptions options) {
        options.motion = {};
        options.trip_speed = 0;
        options.bit_loads = false;
        if (!off_bottom_) off_bottom_ = find_equilibrium(string_.scene, options).nodes;
        return *off_bottom_;
    }

    const InitialNodes& on_bottom(EquilibriumOptions options) {
        options.motion = {};
        options.trip_speed = 0;
        if (on_bottom_) return *on_bottom_;
        try {
            on_bottom_ = find_equilibrium(string_.scene, options).nodes;
        } catch (const SimulationError&) {
            options.start = off_bottom(options);
            on_bottom_ = find_equilibrium(string_.scene, options).nodes;
        }
        return *on_bottom_;
    }

    const TrippedString& string_;
    std::optional<InitialNodes> off_bottom_;
    std::optional<InitialNodes> on_bottom_;
};

std::vector<Answer> answers_at(const Case& input, double bit_depth) {
    const TrippedString string = string_at(input, bit_depth);
    Tripping tripping(string);
    std::vector<Answer> answers;
    for (const TorqueDragMotion motion : input.torque_drag.motions)
        answers.push_back(tripping.answer(motion));
    return answers;
}

std::vector<double> depths_of(const Case& input) {
    if (!input.torque_drag.depths.empty()) return input.torque_drag.depths;
    constexpr int count = 20;
    const double length = total_length(input.string);
    std::vector<double> depths;
    for (int k = 1; k <= count; ++k)
        depths.push_back(input.well->survey.front().measured_depth + length * k / count);
    return depths;
}

void check(const Case& input) {
    const SourceLocation where{input.path.string()};
    if (!input.well)
        throw InputError(where,
                         "torque and drag need a well; add a table [well] with survey and "
                         "diameter");
    if (input.head.motion != HeadMotion::driven)
        throw InputError(where,
                         "head.motion is not \"driven\"; torque and drag need a head that clamps "
                         "the string");
    if (input.head.position && !input.head.position->isZero(0))
        throw InputError(where,
                         "head.position is not the start of the well, from where torque and drag "
                         "hang the string; leave it out");
    const Eigen::Vector3d down_hole = station_tangent(input.well->survey.front());
    constexpr double rounding = 1e-6;
    if (input.head.direction && (*input.head.direction - down_hole).norm() > rounding)
        throw InputError(where,
                         "head.direction is not that of the well at its start, along which torque "
                         "and drag hang the string; leave it out");
}

void append(TorqueDragCurve& curve, double bit_depth, Answer answer) {
    curve.hook_load.push_back(answer.hook_load);
    curve.surface_torque.push_back(answer.surface_torque);
    curve.neutral_point.push_back(answer.neutral_point);
    curve.buckling.push_back(answer.buckling);
    curve.standpipe_pressure.push_back(answer.standpipe_pressure);
    curve.bit_pressure.push_back(answer.bit_pressure);
    curve.equivalent_density.push_back(answer.equivalent_density);
    curve.mud_force.push_back(answer.mud_force);
    curve.soft_hook_load.push_back(answer.soft.tension);
    curve.soft_surface_torque.push_back(answer.soft.torque);
    if (answer.failure) curve.failures.push_back({bit_depth, *answer.failure});
    curve.profile = std::move(answer.profile);
}

}  // namespace

TorqueDrag compute_torque_drag(const Case& input, int threads) {
    check(input);
    TorqueDrag result;
    result.bit_depth = depths_of(input);
    const std::size_t count = result.bit_depth.size();
    std::vector<std::vector<Answer>> answers(count);
    for_each_in_parallel(count, threads > 0 ? threads : omp_get_num_procs(), [&](std::size_t i) {
        answers[i] = answers_at(input, result.bit_depth[i]);
        if (i + 1 == count) return;
        for (Answer& answer : answers[i])
            answer.profile = {};
    });
    const TrippedString last = string_at(input, result.bit_depth.back());
    result.node_s = last.scene.mesh.node_s;
    result.segment_s = last.scene.mesh.segment_s;
    result.measured_depth = last.measured_depth;
    for (std::size_t m = 0; m < input.torque_drag.motions.size(); ++m) {
        TorqueDragCurve& curve = result.curves.emplace_back();
        curve.motion = input.torque_drag.motions[m];
        for (std::size_t i = 0; i < count; ++i)
            append(curve, result.bit_depth[i], std::move(answers[i][m]));
    }
    return result;
}

}  // namespace drillstrand
