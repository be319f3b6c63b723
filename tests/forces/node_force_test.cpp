// The momentum rates of the step loop against plain code, one node at a time, that shares nothing
// with it but the equations: rod, weight, contact, both friction laws, drag, damping.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "drillstrand/scene.hpp"
#include "rod/report.hpp"
#include "rod/strand.hpp"

namespace drillstrand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

/// A string of two pipes that rubs along a bent well; N = 40 leaves a block partly filled.
Case rubbing_string(const ContactCase& contact, std::optional<FluidCase> fluid) {
    Case input;
    WellCase well;
    for (int i = 0; i <= 8; ++i) {
        const double depth = 10.0 * i;
        well.survey.push_back({depth, 0.3 + 0.05 * i * (i % 3), 0.4 - 0.03 * i});
    }
    well.sections = {{35, 0.24}, {1e4, 0.21}};
    input.well = well;
    input.fluid = std::move(fluid);
    Component pipe;
    pipe.length = 50;
    pipe.outer_diameter = 0.14;
    pipe.inner_diameter = 0.12;
    pipe.linear_density = 31.8557;
    pipe.youngs_modulus = 200e9;
    Component collar = pipe;
    collar.length = 20;
    collar.outer_diameter = 0.17;
    collar.linear_density = 100;
    input.string.components = {pipe, collar};
    input.mesh.segments = 40;
    input.mesh.segment_inertia = true;
    input.head.motion = HeadMotion::free;
    input.contact = contact;
    input.damping.internal = 3;
    input.damping.external = 7;
    return input;
}

/// A state of the string in the layout of the step loop, and the springs of its nodes.
struct State {
    Pose head;
    std::vector<Vector6> momentum;
    std::vector<Vector6> strain;
    std::vector<FrictionSpring> spring;
};

Matrix3d hat(const Vector3d& v) {
    Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

std::vector<Pose> poses_of(const Scene& scene, const State& state) {
    std::vector<Pose> poses = {state.head};
    for (std::size_t k = 0; k < state.strain.size(); ++k) {
        const Vector3d w = scene.mesh.length[k] * state.strain[k].head<3>();
        const double angle = w.norm();
        const Matrix3d hat_w = hat(w);
        const Matrix3d turn = Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
        const Matrix3d spread = Matrix3d::Identity() +
                                (1 - std::cos(angle)) / (angle * angle) * hat_w +
                                (angle - std::sin(angle)) / std::pow(angle, 3) * hat_w * hat_w;
        const Pose& pose = poses.back();
        poses.push_back(
            {pose.frame * turn, pose.position + pose.frame * (scene.mesh.length[k] * spread *
                                                              state.strain[k].tail<3>())});
    }
    return poses;
}

/// A string somewhere in the well, some of its nodes in the wall, moving and spinning.
State random_state(const Scene& scene, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    State state;
    const Vector3d aside = 0.04 * Vector3d(unit(random), unit(random), 0);
    const Matrix3d turn = Eigen::AngleAxisd(3 * unit(random), Vector3d::UnitX()).toRotationMatrix();
    state.head = {scene.head_frame * turn, scene.head_position + aside};
    // the initial strains refer to a head that is not turned
    const auto turned = [&](const Vector3d& v) { return Vector3d(turn.transpose() * v); };
    for (const Vector6& initial : scene.initial_strain) {
        Vector6 strain;
        strain << turned(initial.head<3>()), turned(initial.tail<3>());
        for (Eigen::Index i = 0; i < 3; ++i)
            strain[i] += 1e-3 * unit(random);
        for (Eigen::Index i = 3; i < 6; ++i)
            strain[i] += 1e-4 * unit(random);
        state.strain.push_back(strain);
    }
    for (std::size_t k = 0; k < scene.mesh.cell.size(); ++k) {
        Vector6 velocity;
        for (Eigen::Index i = 0; i < 6; ++i)
            velocity[i] = (i == 0 ? 10 : i < 3 ? 0.1 : 0.5) * unit(random);
        const double m = scene.mesh.node[k].mass;
        Vector6 inertia;
        inertia << scene.mesh.node[k].polar_inertia, scene.inertia[k], scene.inertia[k], m, m, m;
        state.momentum.push_back(inertia.cwiseProduct(velocity));
        state.spring.push_back(
            {{1e-3 * unit(random), 1e-3 * unit(random)}, unit(random) > 0 ? 1.0 : 0.0});
    }
    return state;
}

/// Wrench per length on a node (couple first) in the space frame, with its frame.
struct Surface {
    Vector3d force = Vector3d::Zero();
    Vector3d couple = Vector3d::Zero();
    bool touches = false;
};

/// Coulomb's limit of the held spring, or the paper's bare springs.
Vector3d plain_friction(const ContactCase& contact, const FrictionSpring& spring, double normal,
                        const Vector3d& l, const Vector3d& t) {
    Eigen::Vector2d force = -contact.tangential_stiffness *
                            Eigen::Vector2d(spring.elongation.axial, spring.elongation.azimuthal);
    const FrictionCoefficients& mu =
        spring.sliding > 0 ? contact.dynamic_friction : contact.static_friction;
    if (mu.axial == 0) force[0] = 0;
    if (mu.azimuthal == 0) force[1] = 0;
    if (contact.law == FrictionLaw::coulomb) {
        const double a = mu.axial > 0 ? force[0] / (mu.axial * normal) : 0;
        const double b = mu.azimuthal > 0 ? force[1] / (mu.azimuthal * normal) : 0;
        const double excess = std::hypot(a, b);
        if (normal <= 0) {
            force.setZero();
        } else if (excess > 1) {
            force /= excess;
        }
    }
    return force[0] * l + force[1] * t;
}

Surface plain_surroundings(const Scene& scene, std::size_t node, const Vector3d& x,
                           const Vector3d& velocity, const Vector3d& spin,
                           const FrictionSpring& spring) {
    Surface result;
    const WellCrossSection section = scene.well->project(x, scene.well->find_arc(x, 0));
    const double pipe = scene.mesh.node[node].outer_radius;
    const double hole = section.radius;
    const double eccentricity = (section.axis - x).norm();
    const Vector3d r = (section.axis - x).normalized();
    const Vector3d l = section.direction;
    const Vector3d t = r.cross(l);
    const double depth = eccentricity + pipe - hole;
    if (depth > 0) {
        result.touches = true;
        double normal =
            scene.normal_stiffness[node] * depth - scene.normal_damping[node] * velocity.dot(r);
        if (!scene.contact.tension) normal = std::max(normal, 0.0);
        const Vector3d rub = plain_friction(scene.contact, spring, normal, l, t);
        result.force = normal * r + rub;
        result.couple = pipe * rub.dot(t) * l;
        return result;
    }
    if (!scene.features.drag) return result;
    const FluidCase& fluid = *scene.fluid;
    const double e = std::min(eccentricity, (1 - fluid.film) * (hole - pipe));
    const double h2 = hole * hole;
    const double r2 = pipe * pipe;
    const double big_t = std::sqrt(std::pow(h2 - r2 + e * e, 2) - 4 * e * e * h2);
    const double d = std::asinh(big_t / (2 * pipe * hole));
    const double phi = d * std::cosh(d) - std::sinh(d);
    const double den = 2 * pipe * hole * phi + e * e * d;
    const double mu = fluid.viscosity;
    const double v_t = velocity.dot(t);
    const double w_l = spin.dot(l);
    const double force_t = 4 * pi * mu * ((r2 + h2) * v_t - r2 * e * w_l) / den;
    const double force_r = 4 * pi * mu * std::cosh(d) / phi * velocity.dot(r);
    const double couple =
        4 * pi * mu * r2 * ((h2 * phi / std::sinh(d) + e * e) * w_l - e * v_t) / den;
    const double gap = fluid.axial_drag == AxialDrag::eccentric ? d : std::log(hole / pipe);
    result.force = -force_r * r - force_t * t - 2 * pi * mu / gap * velocity.dot(l) * l;
    result.couple = -couple * l;
    return result;
}

/// Momentum rates of all nodes in body axes, with unloaded ends.
std::vector<Vector6> plain_rates(const Scene& scene, const State& state, int& touching) {
    const std::size_t nodes = state.momentum.size();
    const std::vector<Pose> pose = poses_of(scene, state);
    const StringMesh& mesh = scene.mesh;
    std::vector<Vector6> velocity;
    for (std::size_t k = 0; k < nodes; ++k) {
        const double m = mesh.node[k].mass;
        Vector6 inertia;
        inertia << mesh.node[k].polar_inertia, scene.inertia[k], scene.inertia[k], m, m, m;
        velocity.push_back(state.momentum[k].cwiseQuotient(inertia));
    }
    // stress, -ad*_U S and dU/dt of a segment
    struct Segment {
        Vector6 stress, turned, strain_rate;
    };
    std::vector<Segment> segments;
    for (std::size_t k = 0; k + 1 < nodes; ++k) {
        const SectionProperties& s = mesh.segment[k];
        Vector6 stiffness;
        stiffness << s.torsional_stiffness, s.bending_stiffness, s.bending_stiffness,
            s.axial_stiffness, s.shear_stiffness, s.shear_stiffness;
        Vector6 rest;
        rest << s.curvature, 1, 0, 0;
        Segment segment;
        segment.stress = stiffness.cwiseProduct(state.strain[k] - rest);
        const Vector3d kappa = state.strain[k].head<3>();
        const Vector3d gamma = state.strain[k].tail<3>();
        const Vector3d m = segment.stress.head<3>();
        const Vector3d n = segment.stress.tail<3>();
        segment.turned << kappa.cross(m) + gamma.cross(n), kappa.cross(n);
        const Vector6 mean = (velocity[k] + velocity[k + 1]) / 2;
        const Vector3d w = mean.head<3>();
        const Vector3d v = mean.tail<3>();
        Vector6 carried;
        carried << kappa.cross(w), kappa.cross(v) + gamma.cross(w);
        segment.strain_rate = (velocity[k + 1] - velocity[k]) / mesh.length[k] + carried;
        segments.push_back(segment);
    }
    std::vector<Vector6> rates;
    for (std::size_t k = 0; k < nodes; ++k) {
        const double h = mesh.length.front();
        const double cell = mesh.cell[k];
        Vector6 rate = Vector6::Zero();
        if (k + 1 < nodes) {
            const Segment& s = segments[k];
            rate += (s.stress + h / 2 * s.turned) / cell;
            rate -= scene.damping.internal * (h / 2) / cell * s.strain_rate;
        }
        if (k > 0) {
            const Segment& s = segments[k - 1];
            rate -= (s.stress - h / 2 * s.turned) / cell;
            rate -= scene.damping.internal * (h / 2) / cell * s.strain_rate;
        }
        rate -= scene.damping.external * velocity[k];
        const Vector3d w = velocity[k].head<3>();
        rate.head<3>() += state.momentum[k].head<3>().cross(w);
        rate.tail<3>() += state.momentum[k].tail<3>().cross(w);

        const Matrix3d& frame = pose[k].frame;
        const Surface surface = plain_surroundings(
            scene, k, pose[k].position, frame * velocity[k].tail<3>(), frame * w, state.spring[k]);
        const Vector3d weight = scene.weight[k] * Vector3d::UnitZ();
        rate.head<3>() += frame.transpose() * surface.couple;
        rate.tail<3>() += frame.transpose() * (surface.force + weight);
        touching += surface.touches ? 1 : 0;
        rates.push_back(rate);
    }
    return rates;
}

std::vector<Vector6> kernel_rates(const Scene& scene, const State& state) {
    const std::size_t nodes = state.momentum.size();
    const StrandModel model(scene);
    StrandWorkspace work(nodes);
    Table<StrandRow> table(nodes);
    Table<StrandRow> rate(nodes);
    for (std::size_t k = 0; k < nodes; ++k) {
        set_momentum(table, k, state.momentum[k]);
        if (k + 1 == nodes) continue;
        const SectionProperties& s = scene.mesh.segment[k];
        set_stress(table, k, stiffness_of(s).cwiseProduct(state.strain[k] - stress_free_strain(s)));
    }
    std::vector<Vector3d> position;
    for (const Pose& pose : poses_of(scene, state))
        position.push_back(pose.position);
    Table<WallRow> wall = model.surroundings.wall_at(position);
    for (std::size_t k = 0; k < nodes; ++k) {
        wall.row(WallRow::elongation_axial)[k] = state.spring[k].elongation.axial;
        wall.row(WallRow::elongation_azimuthal)[k] = state.spring[k].elongation.azimuthal;
        wall.row(WallRow::sliding)[k] = state.spring[k].sliding;
    }
    const std::size_t blocks = table.blocks();
    std::vector<Pose> block_start(blocks);
    segment_pass(model, table, rate, work, 0, blocks);
    chain_blocks(state.head, work, block_start, blocks);
    set_head_wrench(work, Vector6::Zero());
    set_bit_wrench(work, nodes - 1, Vector6::Zero());
    node_pass(model, table, rate, work, block_start, wall, 0, blocks);
    std::vector<Vector6> rates;
    for (std::size_t k = 0; k < nodes; ++k)
        rates.push_back(momentum_of(rate, k));
    return rates;
}

void expect_equal_rates(const Case& input) {
    const Scene scene = build_scene(input);
    int touching = 0;
    int nodes = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const State state = random_state(scene, seed);
        const std::vector<Vector6> expected = plain_rates(scene, state, touching);
        const std::vector<Vector6> rates = kernel_rates(scene, state);
        double couples = 0;
        double forces = 0;
        for (const Vector6& rate : expected) {
            couples = std::max(couples, rate.head<3>().norm());
            forces = std::max(forces, rate.tail<3>().norm());
        }
        for (std::size_t k = 0; k < expected.size(); ++k) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", node " << k);
            // positions, some 100 m from the origin, round to 1e-14 m; springs of 1e6 Pa act there
            EXPECT_LT((rates[k] - expected[k]).head<3>().norm(), 1e-10 * couples);
            EXPECT_LT((rates[k] - expected[k]).tail<3>().norm(), 1e-10 * forces);
            ++nodes;
        }
    }
    // the states must show both the wall and the open hole
    EXPECT_GT(touching, nodes / 10);
    EXPECT_LT(touching, nodes * 9 / 10);
}

ContactCase wall() {
    ContactCase contact;
    contact.normal_stiffness = 1e6;
    contact.normal_damping = 1e4;
    contact.tangential_stiffness = 1e5;
    return contact;
}

FluidCase mud() {
    FluidCase fluid;
    fluid.density = 1200;
    fluid.viscosity = 0.05;
    return fluid;
}

TEST(NodeForce, OfADryWellIsThatOfPlainCode) {
    expect_equal_rates(rubbing_string(wall(), std::nullopt));
}

TEST(NodeForce, InMudIsThatOfPlainCode) {
    expect_equal_rates(rubbing_string(wall(), mud()));
}

TEST(NodeForce, WithThePapersAxialDragIsThatOfPlainCode) {
    FluidCase fluid = mud();
    fluid.axial_drag = AxialDrag::concentric;
    expect_equal_rates(rubbing_string(wall(), fluid));
}

TEST(NodeForce, WithAPullingDashpotIsThatOfPlainCode) {
    ContactCase contact = wall();
    contact.tension = true;
    expect_equal_rates(rubbing_string(contact, mud()));
}

TEST(NodeForce, WithThePapersLawIsThatOfPlainCode) {
    ContactCase contact = wall();
    contact.law = FrictionLaw::paper;
    contact.tension = true;
    expect_equal_rates(rubbing_string(contact, mud()));
}

TEST(NodeForce, WithRestitutionIsThatOfPlainCode) {
    ContactCase contact = wall();
    contact.restitution = 0.3;
    expect_equal_rates(rubbing_string(contact, mud()));
}

TEST(NodeForce, WithFrictionThatDependsOnDirectionIsThatOfPlainCode) {
    ContactCase contact = wall();
    contact.static_friction = {0.2, 0.7};
    contact.dynamic_friction = {0.1, 0.5};
    expect_equal_rates(rubbing_string(contact, std::nullopt));
    contact.static_friction.axial = contact.dynamic_friction.axial = 0;
    expect_equal_rates(rubbing_string(contact, std::nullopt));
}

}  // namespace
}  // namespace drillstrand
