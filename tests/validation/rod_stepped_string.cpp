// Strings of several components: waves that meet a change of section, and shapes at rest.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "drillstrand/drill_string.hpp"
#include "validation/rod_cases.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using namespace test;

using SteppedString = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, SteppedString, both_integrators, integrator_name);

Component pipe(double length) {
    Component component;
    component.length = length;
    component.outer_diameter = 0.14;
    component.inner_diameter = 0.12;
    component.linear_density = 31.8557;
    component.youngs_modulus = 200e9;
    return component;
}

Component heavy_pipe(double length) {
    Component component = pipe(length);
    component.inner_diameter = 0.08;
    component.linear_density = 75;
    return component;
}

Component collar(double length) {
    Component component = pipe(length);
    component.outer_diameter = 0.2;
    component.inner_diameter = 0.07;
    component.linear_density = 200;
    return component;
}

/// A weightless vertical string.
Case string_of(IntegratorKind integrator, const std::vector<Component>& components, int segments) {
    Case input;
    input.gravity = 0;
    input.string.components = components;
    input.mesh.segments = segments;
    input.mesh.segment_inertia = true;
    input.run.integrator = integrator;
    input.run.threads = 1;
    return input;
}

// --- a pulse of tension or torque from the bit meets the joint of collars and pipe

constexpr double pulse_duration = 0.07;  // s
constexpr double pipe_length = 600;      // m
constexpr double collar_length = 400;    // m

/// sin^4 in straight pieces, the same for the engine and for the exact solution, of height 1.
ScalarSchedule pulse() {
    std::vector<double> times;
    std::vector<double> values;
    constexpr int pieces = 200;
    for (int i = 0; i <= pieces; ++i) {
        const double part = static_cast<double>(i) / pieces;
        times.push_back(part * pulse_duration);
        values.push_back(std::pow(std::sin(pi * part), 4));
    }
    return {times, values};
}

/// Stiffness and inertia per length of one kind of wave.
struct Medium {
    double stiffness = 0;
    double inertia = 0;
    [[nodiscard]] double speed() const { return std::sqrt(stiffness / inertia); }
    [[nodiscard]] double impedance() const { return std::sqrt(stiffness * inertia); }
};

/// d'Alembert: stress at s, over the peak of the load, once the pulse has passed the joint and
/// before anything has met an end.
double exact_stress(const Medium& upper, const Medium& lower, const ScalarSchedule& load, double s,
                    double time) {
    const double sum = upper.impedance() + lower.impedance();
    const double passed = 2 * upper.impedance() / sum;
    const double returned = (upper.impedance() - lower.impedance()) / sum;
    const double at_joint = time - collar_length / lower.speed();
    if (s < pipe_length) return passed * load(at_joint - (pipe_length - s) / upper.speed());
    return load(time - (pipe_length + collar_length - s) / lower.speed()) +
           returned * load(at_joint - (s - pipe_length) / lower.speed());
}

struct WaveErrors {
    double axial = 0;    ///< largest, over the peak of the pulse
    double torsion = 0;  ///< likewise
};

WaveErrors wave_errors(IntegratorKind integrator, int segments) {
    constexpr double force = 1e5;
    constexpr double torque = 1e4;
    constexpr std::size_t axial_profile = 6;    // at 0.15 s both parts have left the joint
    constexpr std::size_t torsion_profile = 8;  // at 0.2 s, as torsion is slower
    Case input = string_of(integrator, {pipe(pipe_length), collar(collar_length)}, segments);
    const ScalarSchedule load = pulse();
    std::vector<double> push;
    std::vector<Vector3d> couple;
    for (const double value : load.values()) {
        push.push_back(-force * value);
        couple.emplace_back(torque * value, 0, 0);
    }
    input.bit.weight = ScalarSchedule(load.times(), push);
    input.bit.moment = VectorSchedule(load.times(), couple);
    input.run.duration = 0.2;
    input.output.profile_interval = 0.025;
    const SectionProperties above = section_properties(input.string.components[0], 1);
    const SectionProperties below = section_properties(input.string.components[1], 1);
    const test::Run result = run(input);

    WaveErrors worst;
    const double h = (pipe_length + collar_length) / segments;
    for (std::size_t k = 0; k < static_cast<std::size_t>(segments); ++k) {
        const double s = (static_cast<double>(k) + 0.5) * h;
        const auto miss = [&](std::size_t profile, Eigen::Index component, const Medium& upper,
                              const Medium& lower, double peak) {
            const Profile& at = result.profiles.at(profile);
            const double exact = exact_stress(upper, lower, load, s, at.time);
            return std::abs(at.stress[k][component] / peak - exact);
        };
        worst.axial =
            std::max(worst.axial, miss(axial_profile, 3, {above.axial_stiffness, above.mass},
                                       {below.axial_stiffness, below.mass}, force));
        worst.torsion =
            std::max(worst.torsion,
                     miss(torsion_profile, 0, {above.torsional_stiffness, above.polar_inertia},
                          {below.torsional_stiffness, below.polar_inertia}, torque));
    }
    return worst;
}

TEST_P(SteppedString, WavesPassAndReturnFromTheJointAsTheImpedancesSay) {
    const WaveErrors coarse = wave_errors(integrator(), 200);
    const WaveErrors fine = wave_errors(integrator(), 400);
    EXPECT_LT(fine.axial, 0.01);
    EXPECT_LT(fine.torsion, 0.01);
    // dispersion of the mesh: second order
    EXPECT_NEAR(std::log2(coarse.axial / fine.axial), 2, 0.15) << coarse.axial << " " << fine.axial;
    EXPECT_NEAR(std::log2(coarse.torsion / fine.torsion), 2, 0.15)
        << coarse.torsion << " " << fine.torsion;
}

// --- at rest

TEST_P(SteppedString, HangsAndBearsALoadWithTheStretchOfItsParts) {
    Case input = string_of(integrator(), {pipe(500), heavy_pipe(300), collar(200)}, 20);
    input.gravity = 9.81;
    input.bit.force = Vector3d(0, 0, 2e5);
    input.damping.external = {700, 700};
    input.run.duration = 10;
    // closed form: each part by half of its own weight and by all below; joints lie on nodes
    double below = 2e5;
    double depth = 0;
    std::vector<HangingPart> parts;
    for (auto part = input.string.components.rbegin(); part != input.string.components.rend();
         ++part) {
        const SectionProperties section = section_properties(*part, 1);
        const double weight = section.mass * input.gravity * part->length;
        depth += part->length * (1 + (below + weight / 2) / section.axial_stiffness);
        below += weight;
        parts.insert(parts.begin(), {section.mass * input.gravity, section.axial_stiffness});
    }
    if (is_leapfrog()) depth += stretch_by_cubics(parts, 1000.0 / input.mesh.segments);
    EXPECT_NEAR(run(input).last().bit_position.z(), depth, 1e-7);
}

TEST_P(SteppedString, StretchesByTheSumOfItsPartsWhereverTheJointsLieInTheMesh) {
    // uniform tension: compliances are averaged over a segment, so that no mesh error is left
    Case input = string_of(integrator(), {pipe(512.3), heavy_pipe(291.1), collar(196.6)}, 7);
    input.bit.force = Vector3d(0, 0, 2e5);
    input.damping.external = {700, 700};
    input.run.duration = 10;
    double depth = 0;
    for (const Component& part : input.string.components)
        depth += part.length * (1 + 2e5 / section_properties(part, 1).axial_stiffness);
    EXPECT_NEAR(run(input).last().bit_position.z(), depth, 1e-7);
}

/// A uniform vertical string on segments of given lengths (m), for which case files have no key.
Scene scene_on(const Case& input, const std::vector<double>& lengths) {
    Scene scene = build_scene(input);
    StringMesh& mesh = scene.mesh;
    double depth = 0;
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        mesh.length[k] = lengths[k];
        mesh.segment_s[k] = depth + lengths[k] / 2;
        depth += lengths[k];
        mesh.node_s[k + 1] = depth;
        scene.initial_nodes.position[k + 1] = Vector3d(0, 0, depth);
    }
    for (std::size_t k = 0; k <= lengths.size(); ++k) {
        const double above = k > 0 ? lengths[k - 1] : 0;
        const double below = k < lengths.size() ? lengths[k] : 0;
        mesh.cell[k] = (above + below) / 2;
    }
    return scene;
}

TEST_P(SteppedString, OnSegmentsOfAllLengthsHangsAsOnEqualOnes) {
    const std::vector<double> lengths = {20, 60, 35,  90, 15, 15,  140,
                                         45, 80, 100, 70, 30, 110, 190};
    Case input = string_of(integrator(), {pipe(1000)}, static_cast<int>(lengths.size()));
    input.gravity = 9.81;
    input.bit.force = Vector3d(0, 0, 2e5);
    input.damping.external = {500, 500};
    input.run.duration = 8;
    const SectionProperties section = section_properties(pipe(1000), 1);
    const double weight = section.mass * input.gravity * 1000;
    // tension in the middle of a segment is the weight below it, however long it is
    EXPECT_NEAR(run(scene_on(input, lengths), input.run, input.output).last().bit_position.z(),
                1000 * (1 + (2e5 + weight / 2) / section.axial_stiffness), 1e-7);
}

/// Deflection of the tip of a level shaft of three parts, pulled aside so little that it stays
/// straight but for a thousandth; exactly, and by the engine.
struct Deflection {
    double exact = 0;
    double found = 0;
};

Deflection stepped_cantilever(IntegratorKind integrator, double first, double second,
                              int segments) {
    constexpr double length = 24;
    constexpr double force = 20;
    Case input = string_of(
        integrator, {collar(first), heavy_pipe(second), pipe(length - first - second)}, segments);
    input.head.direction = Vector3d(1, 0, 0);
    input.bit.force = Vector3d(0, 0, force);
    input.damping.external = {150, 150};
    input.run.duration = 12;
    Deflection deflection;
    double from = 0;
    for (const Component& part : input.string.components) {
        const SectionProperties section = section_properties(part, 1);
        const double to = from + part.length;
        // bending moment force (length - s), shear force
        const double lever3 = std::pow(length - from, 3) - std::pow(length - to, 3);
        deflection.exact += force * lever3 / (3 * section.bending_stiffness) +
                            force * part.length / section.shear_stiffness;
        from = to;
    }
    deflection.found = run(input).last().bit_position.z();
    return deflection;
}

TEST_P(SteppedString, CantileverOfThreePartsBendsAsItsStiffnessesSay) {
    std::vector<double> error;
    for (const int segments : {12, 24}) {
        const Deflection d = stepped_cantilever(integrator(), 8, 6, segments);
        error.push_back(d.found / d.exact - 1);
    }
    if (is_leapfrog()) {
        // Hermite's cubics are exact under loads on nodes: what is left is the bend's own, 1e-3^2
        for (const double miss : error)
            EXPECT_LT(std::abs(miss), 1e-6);
    } else {
        EXPECT_LT(std::abs(error[1]), 1e-3);
        EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.1) << error[0] << ' ' << error[1];
    }
    // joints inside segments
    const Deflection between = stepped_cantilever(integrator(), 8.3, 5.9, 24);
    EXPECT_NEAR(between.found / between.exact, 1, 3e-3);
}

}  // namespace
}  // namespace drillstrand
