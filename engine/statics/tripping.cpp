#include "statics/tripping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drillstrand/error.hpp"
#include "drillstrand/hydraulics.hpp"
#include "drillstrand/side_force.hpp"
#include "statics/arc_section.hpp"

namespace drillstrand {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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
void describe_mud(const TrippedString& string, const MudMotion& motion, TrippingAnswer& answer) {
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

double neutral_point(const TrippedString& string, const TrippingAnswer& answer,
                     double bit_tension) {
    const double start = string.scene.well->measured_depth_start();
    std::vector<TensionAt> tensions{{start, answer.hook_load}};
    for (std::size_t k = 0; k < string.sites.size(); ++k)
        tensions.push_back({string.measured_depth[k], answer.profile.tension[k]});
    tensions.push_back({start + string.scene.mesh.node_s.back(), bit_tension});
    return neutral_point(tensions);
}

void answer_stiff(const TrippedString& string, const Equilibrium& found, double bit_tension,
                  TrippingAnswer& answer) {
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

}  // namespace

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

TrippingAnswer Tripping::answer(TorqueDragMotion motion) {
    const EquilibriumOptions options = tripping_options(string_.input, motion);
    const SoftString soft = soft_string(string_.input, string_.scene, options);
    const SoftProfile soft_profile =
        solve_soft_string(soft, *string_.scene.well, string_.measured_depth);
    TrippingAnswer result;
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

SoftLoad Tripping::soft_at_head(TorqueDragMotion motion) const {
    const EquilibriumOptions options = tripping_options(string_.input, motion);
    const SoftString soft = soft_string(string_.input, string_.scene, options);
    return solve_soft_string(soft, *string_.scene.well, {}).at_head;
}

Equilibrium Tripping::moving(EquilibriumOptions options) {
    options.start = options.bit_loads ? on_bottom(options) : off_bottom(options);
    return find_equilibrium(string_.scene, options);
}

const InitialNodes& Tripping::off_bottom(EquilibriumOptions options) {
    options.motion = {};
    options.trip_speed = 0;
    options.bit_loads = false;
    if (!off_bottom_) off_bottom_ = find_equilibrium(string_.scene, options).nodes;
    return *off_bottom_;
}

const InitialNodes& Tripping::on_bottom(EquilibriumOptions options) {
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

}  // namespace drillstrand
