#include "validation/contact_pipe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace drillstrand::test {

using Eigen::Vector3d;

Vector3d down_the_well(double inclination) {
    return {std::sin(inclination), 0, std::cos(inclination)};
}

Vector3d low_side(double inclination) {
    return {-std::cos(inclination), 0, std::sin(inclination)};
}

Case short_pipe(IntegratorKind integrator, double inclination) {
    Case input;
    input.gravity = 9.81;
    WellCase well;
    well.survey = {{0, inclination, 0}, {1000, inclination, 0}};
    well.sections = {{1000, 2 * hole_radius}};
    input.well = well;
    Component pipe;
    pipe.length = pipe_length;
    pipe.outer_diameter = 2 * pipe_radius;
    pipe.inner_diameter = 0.12;
    pipe.linear_density = pipe_mass;
    pipe.youngs_modulus = 200e9;
    pipe.poisson_ratio = 0;
    input.string.components = {pipe};
    input.mesh.segments = 1;
    input.mesh.segment_inertia = true;
    input.head.motion = HeadMotion::free;
    input.run.integrator = integrator;
    input.run.duration = 1;
    input.run.threads = 1;
    input.output.interval = 1;
    return input;
}

double depth_under(double load, const ContactCase& contact) {
    const double depth = load / contact.normal_stiffness;
    return contact.normal_law == NormalLaw::hertz ? std::pow(depth, 2.0 / 3) : depth;
}

void lay_down(Case& input, double inclination) {
    const double press = pipe_mass * input.gravity * std::sin(inclination);
    input.initial.offset = (clearance + depth_under(press, input.contact)) * low_side(inclination);
}

void load(Case& input, double end, double step, const std::function<Vector3d(double)>& force,
          const std::function<Vector3d(double)>& couple) {
    std::vector<double> times;
    std::vector<Vector3d> forces;
    std::vector<Vector3d> couples;
    const int count = static_cast<int>(std::lround(end / step));
    for (int i = 0; i <= count; ++i) {
        times.push_back(i * step);
        forces.emplace_back(pipe_length / 2 * force(times.back()));
        couples.emplace_back(pipe_length / 2 * couple(times.back()));
    }
    input.head.force = input.bit.force = VectorSchedule(times, forces);
    input.head.moment = input.bit.dead_moment = VectorSchedule(times, couples);
}

Case hanging_casing(IntegratorKind integrator, const FluidCase& fluid) {
    Case input;
    input.gravity = 9.81;
    input.well = WellCase{{{0, 0, 0}, {520, 0, 0}}, {{520, 0.3111}}};
    input.fluid = fluid;
    Component casing;
    casing.length = 515;
    casing.outer_diameter = 0.2445;
    casing.inner_diameter = 0.2266;
    casing.linear_density = 52.0925;
    casing.youngs_modulus = 200e9;
    casing.poisson_ratio = 0;
    input.string.components = {casing};
    input.mesh.segments = 10;
    input.mesh.segment_inertia = true;
    input.damping.external = {600, 600};  // brings the string to rest within seconds
    input.run.integrator = integrator;
    input.run.duration = 8;
    input.run.threads = 1;
    input.output.interval = 0.5;
    return input;
}

void push_east(Case& input, double momentum) {
    const double peak = momentum / 0.05;
    load(
        input, 0.1, 0.05,
        [peak](double t) { return Vector3d(0, std::abs(t - 0.05) < 1e-6 ? peak : 0, 0); },
        [](double) { return Vector3d(Vector3d::Zero()); });
}

Case thrown_pipe(IntegratorKind integrator, double speed) {
    Case input = short_pipe(integrator, 0);
    input.gravity = 0;
    input.contact.static_friction = input.contact.dynamic_friction = {0, 0};
    push_east(input, pipe_mass * speed);
    input.run.cfl = 1e-3;  // the leapfrog takes the wall to first order in its step
    input.run.absolute_tolerance = 1e-9;
    input.run.relative_tolerance = 1e-7;
    input.run.duration = 0.25;
    input.output.profile_interval = 0.01;
    return input;
}

double speed_east(const Profile& profile) {
    return profile.momentum.front()[4] / pipe_mass;
}

double smooth_step(double time, double begin, double end) {
    const double part = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
    return 0.5 * (1 - std::cos(std::numbers::pi * part));
}

double spin(const Profile& profile) {
    return profile.momentum.front()[0] / spin_inertia;
}

namespace {
constexpr double press = 300;  // N/m, of the load that goes around
}

double pure_rolling(const ContactCase& contact) {
    return -pipe_radius / (clearance + depth_under(press, contact));
}

Case pipe_carried_around(IntegratorKind integrator, const ContactCase& contact) {
    Case input = short_pipe(integrator, 0);
    input.gravity = 0;
    input.contact = contact;
    input.initial.offset = (clearance + depth_under(press, contact)) * Vector3d::UnitX();
    const auto angle = [](double t) {  // without corners
        constexpr double speed = 2 * std::numbers::pi;
        const double part = std::min(t, 2.0);
        const double rising =
            0.5 * (part - std::sin(std::numbers::pi * part / 2) * 2 / std::numbers::pi);
        return speed * (rising + std::max(t - 2, 0.0));
    };
    load(
        input, 4, 0.005,
        [angle](double t) {
            return Vector3d(press * Vector3d(std::cos(angle(t)), std::sin(angle(t)), 0));
        },
        [](double /*time*/) { return Vector3d(Vector3d::Zero()); });
    input.run.duration = 4;
    input.output.profile_interval = 0.002;
    return input;
}

Rolling rolled_around(const Run& run) {
    constexpr std::size_t samples = 500;
    Rolling rolling;
    for (std::size_t i = run.profiles.size() - samples; i < run.profiles.size(); ++i) {
        const Profile& now = run.profiles[i];
        const Profile& before = run.profiles[i - 1];
        const Vector3d& a = before.position.front();
        const Vector3d& b = now.position.front();
        rolling.whirled += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
        rolling.spun += 0.5 * (spin(now) + spin(before)) * (now.time - before.time);
    }
    return rolling;
}

}  // namespace drillstrand::test
