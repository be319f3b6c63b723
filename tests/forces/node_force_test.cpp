// The momentum rates of the step loop against plain code, one node at a time, that shares nothing
// with it but the equations: rod, weight, contact, both friction laws, drag, damping.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "drillstrand/hydraulics.hpp"
#include "drillstrand/scene.hpp"
#include "rod/report.hpp"
#include "rod/strand.hpp"
#include "support/annular_flow.hpp"
#include "support/plain_wall.hpp"

namespace drillstrand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A string of two pipes that rubs along a bent well; N = 40 leaves a block partly filled.
Case rubbing_string(const ContactCase& contact, std::optional<FluidCase> fluid) {
    Case input;
    WellCase well;
    for (int i = 0; i <= 8; ++i) {
        const double depth = 10.0 * i;
        well.survey.push_back({depth, 0.3 + 0.05 * i * (i % 3), 0.4 - 0.03 * i});
    }
    well.sections = {{35.3, 0.24}, {1e4, 0.21}};  // no node in the shoulder
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
    input.damping.internal = {3, 0.2};
    input.damping.external = {7, 0.9};
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
        const double sideways = scene.lateral_mass[k];
        Vector6 inertia;
        inertia << scene.mesh.node[k].polar_inertia, scene.inertia[k], scene.inertia[k],
            scene.mesh.node[k].mass, sideways, sideways;
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
    const test::PlainWall wall = test::plain_wall(scene, x);
    const WellCrossSection& section = wall.section;
    const double pipe = scene.mesh.node[node].outer_radius;
    const double hole = section.radius;
    const double eccentricity = (section.axis - x).norm();
    const Vector3d r = (section.axis - x).normalized();
    const Vector3d l = section.direction;
    const Vector3d t = r.cross(l);
    const double depth = eccentricity + pipe - hole;
    if (depth > 0) {
        result.touches = true;
        const Vector3d inward = r + wall.lean * l;
        double normal = wall.firmness * scene.normal_stiffness[node] * depth -
                        wall.damping * scene.normal_damping[node] * velocity.dot(inward);
        if (!scene.contact.tension) normal = std::max(normal, 0.0);
        const Vector3d rub = plain_friction(test::contact_at(scene, wall), spring, normal, l, t);
        result.force = normal * inward + rub -
                       0.5 * wall.firming * scene.normal_stiffness[node] * depth * depth * l;
        result.couple = pipe * rub.dot(t) * l;
    }
    if (!scene.fluid) return result;
    const test::Annulus annulus = {pipe, hole, eccentricity};
    const double v_r = velocity.dot(r);
    const double v_t = velocity.dot(t);
    const Eigen::Vector4d motion(v_r, velocity.dot(l), v_t, spin.dot(l));
    test::Stirring stirring{std::hypot(v_r, v_t), motion[1], motion[3], v_t};
    if (scene.features.flowing_mud) {
        const Hydraulics flow = hydraulics_of(scene, mud_motion(scene));
        stirring.pumped = flow.annulus_speed[node];
        stirring.pumped_shear = flow.annulus_shear[node];
        result.force += flow.axial_load[node] * l;
    }
    const Eigen::Vector4d drag = test::textbook_drag(*scene.fluid, annulus, stirring) * motion;
    // v^2 grad M / 2
    const double pushed_in =
        0.5 * (v_r * v_r + v_t * v_t) * test::lateral_fluid_slope(*scene.fluid, annulus);
    result.force -= (drag[0] + pushed_in) * r + drag[1] * l + drag[2] * t;
    result.couple -= drag[3] * l;
    return result;
}

/// Inertia of a node whose fluid goes along sideways, in body axes.
Vector6 inertia_at(const Scene& scene, std::size_t node, const Vector3d& position) {
    const SectionProperties& section = scene.mesh.node[node];
    const WellCrossSection around =
        scene.well->project(position, scene.well->find_arc(position, 0));
    double sideways = section.mass;
    if (scene.fluid) {
        sideways += test::lateral_fluid(
            *scene.fluid, {section.outer_radius, around.radius, (around.axis - position).norm()},
            section.outer_area - section.metal_area);
    }
    Vector6 inertia;
    inertia << section.polar_inertia, scene.inertia[node], scene.inertia[node], section.mass,
        sideways, sideways;
    return inertia;
}

Vector6 six_of(const DampingPair& damping) {
    Vector6 six;
    six << Vector3d::Constant(damping.rotation), Vector3d::Constant(damping.translation);
    return six;
}

/// Momentum rates of all nodes in body axes, with unloaded ends.
std::vector<Vector6> plain_rates(const Scene& scene, const State& state, int& touching) {
    const std::size_t nodes = state.momentum.size();
    const std::vector<Pose> pose = poses_of(scene, state);
    const StringMesh& mesh = scene.mesh;
    std::vector<Vector6> velocity;
    for (std::size_t k = 0; k < nodes; ++k) {
        velocity.push_back(state.momentum[k].cwiseQuotient(inertia_at(scene, k, pose[k].position)));
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
    const Vector6 internal = six_of(scene.damping.internal);
    const Vector6 external = six_of(scene.damping.external);
    std::vector<Vector6> rates;
    for (std::size_t k = 0; k < nodes; ++k) {
        const double h = mesh.length.front();
        const double cell = mesh.cell[k];
        Vector6 rate = Vector6::Zero();
        if (k + 1 < nodes) {
            const Segment& s = segments[k];
            rate += (s.stress + h / 2 * s.turned) / cell;
            rate -= (h / 2) / cell * internal.cwiseProduct(s.strain_rate);
        }
        if (k > 0) {
            const Segment& s = segments[k - 1];
            rate -= (s.stress - h / 2 * s.turned) / cell;
            rate -= (h / 2) / cell * internal.cwiseProduct(s.strain_rate);
        }
        rate -= external.cwiseProduct(velocity[k]);
        const Vector3d w = velocity[k].head<3>();
        rate.head<3>() += state.momentum[k].head<3>().cross(w) +
                          state.momentum[k].tail<3>().cross(velocity[k].tail<3>());
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
    segment_pass(model, table, rate, work, wall, 0, blocks);
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

FluidCase papers_mud() {
    FluidCase fluid = mud();
    fluid.regime = FlowRegime::laminar;
    fluid.contact_drag = false;
    fluid.added_mass = false;
    return fluid;
}

TEST(NodeForce, OfADryWellIsThatOfPlainCode) {
    expect_equal_rates(rubbing_string(wall(), std::nullopt));
}

/// Casing that narrows, and an open hole of another wall.
WellCase varied_well(WellCase well) {
    WellSectionCase casing{.to = 33, .diameter = 0.25};
    casing.end_diameter = 0.22;
    casing.static_friction = {0.2, 0.4};
    casing.dynamic_friction = {0.1, 0.3};
    WellSectionCase open{.to = 1e4, .diameter = 0.21};
    open.normal_stiffness = 3e6;
    well.sections = {casing, open};
    return well;
}

TEST(NodeForce, OfAWallThatVariesAlongTheWellIsThatOfPlainCode) {
    for (const bool in_mud : {false, true}) {
        for (const bool with_restitution : {false, true}) {
            ContactCase contact = wall();
            if (with_restitution) contact.restitution = 0.4;
            Case input = rubbing_string(contact, std::nullopt);
            if (in_mud) input.fluid = mud();
            // its coefficients are those of the middle of an arc
            if (in_mud) input.fluid->regime = FlowRegime::laminar;
            input.well = varied_well(*input.well);
            expect_equal_rates(input);
        }
    }
}

TEST(NodeForce, InMudIsThatOfPlainCode) {
    expect_equal_rates(rubbing_string(wall(), mud()));
}

TEST(NodeForce, InMudInMotionIsThatOfPlainCode) {
    FluidCase fluid = mud();
    fluid.viscosity = 0.4;
    fluid.flow_index = 0.6;
    fluid.yield_stress = 4;
    expect_equal_rates(rubbing_string(wall(), fluid));
    fluid.flow_rate = 0.03;
    fluid.nozzle_area = 5e-4;
    expect_equal_rates(rubbing_string(wall(), fluid));
    fluid.added_mass = false;
    fluid.regime = FlowRegime::laminar;
    expect_equal_rates(rubbing_string(wall(), fluid));
}

TEST(NodeForce, InThePapersMudIsThatOfPlainCode) {
    expect_equal_rates(rubbing_string(wall(), papers_mud()));
}

TEST(NodeForce, InLaminarMudThatDragsInContactIsThatOfPlainCode) {
    FluidCase fluid = papers_mud();
    fluid.contact_drag = true;
    expect_equal_rates(rubbing_string(wall(), fluid));
}

TEST(NodeForce, InMudWithoutMassIsThatOfPlainCode) {
    FluidCase fluid = mud();
    fluid.added_mass = false;
    expect_equal_rates(rubbing_string(wall(), fluid));
}

TEST(NodeForce, InMudWithoutDragIsThatOfPlainCode) {
    FluidCase fluid = mud();
    fluid.drag = false;
    expect_equal_rates(rubbing_string(wall(), fluid));
}

TEST(NodeForce, InMudWithoutViscosityAroundAnEmptyPipeIsThatOfPlainCode) {
    FluidCase fluid = mud();
    fluid.viscosity = 0;
    fluid.inside = InsideOfPipe::empty;
    expect_equal_rates(rubbing_string(wall(), fluid));
}

TEST(NodeForce, WithThePapersAxialDragIsThatOfPlainCode) {
    FluidCase fluid = papers_mud();
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
