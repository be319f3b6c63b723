// One step of the director rod by the vector kernels against the same step written node by node,
// over random states of every kind of scene.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "model/segment_strain.hpp"
#include "rod/director_plain.hpp"
#include "rod/director_report.hpp"
#include "rod/director_steps.hpp"
#include "support/dice.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
using test::Dice;
using test::EndLoad;
using test::PlainNode;
using test::PlainRod;
using test::StepAccount;

/// Three unlike components; the joints lie inside segments.
std::string three_components(bool curved, double modulus) {
    const std::string stiffness = "youngs_modulus = " + std::to_string(modulus) + "\n";
    const auto own = [&](const std::string& curvature) {
        return curved ? "curvature = " + curvature + "\n" : std::string();
    };
    return R"(
        [[string.component]]
        length = 9.0
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        )" +
           stiffness + own("[0.01, 0.02, -0.03]") +
           R"(
        [[string.component]]
        length = 4.3
        linear_density = 150.0
        outer_diameter = 0.2
        inner_diameter = 0.07
        poisson_ratio = 0.2
        )" +
           stiffness +
           R"(
        [[string.component]]
        length = 6.1
        linear_density = 20.0
        outer_diameter = 0.09
        inner_diameter = 0.07
        )" +
           stiffness + own("[-0.02, 0.0, 0.01]") +
           R"(
        [head]
        motion = "free"
        [run]
        integrator = "leapfrog"
        duration = 1
        )";
}

struct Variant {
    std::string name;
    int segments;
    bool curved;
    bool well;
    std::string more;
    bool varied_wall = false;
    bool unbalanced = false;
    bool flowing_mud = false;
};

std::ostream& operator<<(std::ostream& out, const Variant& variant) {
    return out << variant.name;
}

/// Casing that narrows, and an open hole of another wall.
std::vector<WellSectionCase> casing_and_open_hole() {
    WellSectionCase casing{.to = 9, .diameter = 0.33};
    casing.end_diameter = 0.31;
    casing.static_friction = {0.3, 0.2};
    casing.dynamic_friction = {0.2, 0.1};
    WellSectionCase open{.to = 100, .diameter = 0.32};
    open.normal_stiffness = 2e6;
    return {casing, open};
}

Scene scene_of(const Variant& variant) {
    // in the well soft as rubber: nodes put anywhere then neither all stick nor all slide
    const double modulus = variant.well ? 1e6 : 200e9;
    Case input = test::case_from(three_components(variant.curved, modulus) + variant.more +
                                 "[mesh]\nsegments = " + std::to_string(variant.segments) + "\n");
    if (variant.unbalanced)
        for (Component& part : input.string.components)
            part.eccentric = Eccentricity{0.3 * part.length, 0.7};
    if (variant.well) {
        WellCase hole;
        hole.survey = {{0, 0.3, 0.4}, {6, 0.35, 0.35}, {14, 0.5, 0.42}, {40, 0.6, 0.5}};
        hole.sections = {{100, 0.32}};
        if (variant.varied_wall) hole.sections = casing_and_open_hole();
        input.well = hole;
    }
    if (variant.flowing_mud) {
        input.fluid->viscosity = 0.4;
        input.fluid->flow_index = 0.6;
        input.fluid->yield_stress = 4;
        input.fluid->flow_rate = 0.03;
        input.fluid->nozzle_area = 5e-4;
    }
    return build_scene(input);
}

PlainRod random_rod(const Scene& scene, Dice& dice) {
    PlainRod rod;
    const std::size_t nodes = scene.mesh.node.size();
    // in a well: some rods near the axis, the others near the wall, around it by and by
    const bool central = dice.between(0, 1) < 0.3;
    double bearing = dice.between(0, 6);
    for (std::size_t k = 0; k < nodes; ++k) {
        PlainNode node;
        const Vector3d& t0 = scene.initial_nodes.director[k];
        if (scene.features.well) {
            node.director = (t0 + dice.vector(0.03)).normalized();
            // half of the nodes in the wall, up to 2 cm, one in ten with a thin film between; all
            // of them below the mouth, where the arc is not one of 100 km and its rounding
            const double clearance = 0.16 - scene.mesh.node[k].outer_radius;
            const Vector3d level = Vector3d::UnitX().cross(t0).normalized();
            bearing += dice.between(-0.3, 0.3);
            const Vector3d aside = std::cos(bearing) * level + std::sin(bearing) * t0.cross(level);
            const double place = dice.between(0, 1);
            const double eccentricity = central       ? clearance * dice.between(0.05, 0.4)
                                        : place < 0.5 ? clearance + dice.between(1e-3, 0.02)
                                        : place < 0.6 ? clearance * dice.between(0.99, 1)
                                                      : clearance * dice.between(0.6, 0.95);
            node.position = scene.initial_nodes.position[k] + 0.3 * t0 + eccentricity * aside;
        } else if (k == 0) {
            node.director = dice.vector(1).normalized();
            node.position = dice.vector(1);
        } else {
            // stretched by up to 3 %, but not to more than some half waves of bending per segment
            const PlainNode& last = rod.node.back();
            const SegmentStiffness stiffness(scene.mesh.segment[k - 1], scene.mesh.length[k - 1]);
            const double strain = std::min(0.03, 5 / stiffness.slenderness);
            const Vector3d turn = dice.vector(std::min(0.2, std::sqrt(strain)));
            node.director = (last.director + turn).normalized();
            const Vector3d deviation = dice.vector(std::min(0.03, std::sqrt(strain)));
            const Vector3d mean = (last.director + node.director).normalized();
            node.position = last.position + scene.mesh.length[k - 1] *
                                                (1 + strain * dice.between(-1, 1)) *
                                                (mean + deviation).normalized();
        }
        const Vector3d& t = node.director;
        node.velocity = dice.vector(1);
        node.angular_velocity = dice.vector(1).cross(t);
        node.last_director = (t + dice.vector(5e-3)).normalized();
        node.material = dice.vector(1).cross(t).normalized();
        node.spin = dice.between(-5, 5);
        node.depth = dice.between(-1, 1);
        if (scene.contact.restitution && node.depth > 0)
            node.rebounds = dice.between(-1, 1) > 0 ? 1.0 : 0.0;
        const double stretch = dice.between(0, 1) * 1e3 / scene.contact.tangential_stiffness;
        node.spring = {{stretch * dice.between(-1, 1), stretch * dice.between(-1, 1)},
                       dice.between(-1, 1) > 0 ? 1.0 : 0.0};
        rod.node.push_back(node);
    }
    for (const double h : scene.mesh.length)
        rod.twist.push_back(dice.between(-1e-3, 1e-3) / h);
    return rod;
}

/// Largest difference of a quantity over the nodes, relative to the largest change of it in the
/// step.
template <class Quantity>
double relative_difference(const PlainRod& a, const PlainRod& b, const PlainRod& start,
                           const Quantity& quantity) {
    double difference = 0;
    double change = 0;
    for (std::size_t k = 0; k < a.node.size(); ++k) {
        difference = std::max(difference, (quantity(a.node[k]) - quantity(b.node[k])).norm());
        change = std::max(change, (quantity(b.node[k]) - quantity(start.node[k])).norm());
    }
    return difference / change;
}

class DirectorKernelsOn : public testing::TestWithParam<Variant> {};

TEST_P(DirectorKernelsOn, TakeTheStepWrittenNodeByNode) {
    const Scene scene = scene_of(GetParam());
    Dice dice(20240602);
    constexpr double drift_before = 0.8e-3;
    constexpr double kick = 0.9e-3;
    constexpr double drift = 5e-5;
    int impacts = 0;
    int slips = 0;
    double sticking = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const PlainRod start = random_rod(scene, dice);
        const double load = GetParam().well ? 1e2 : 1e5;
        const EndLoad head = {dice.vector(load), dice.vector(1e-3 * load)};
        const EndLoad bit = {dice.vector(load), dice.vector(1e-3 * load)};
        PlainRod expected = start;
        PlainRod found = start;
        const StepAccount plain =
            test::plain_director_step(scene, expected, head, bit, drift_before, kick, drift);
        const StepAccount kernel =
            test::kernel_director_step(scene, found, head, bit, drift_before, kick, drift);

        const auto difference = [&](const auto& quantity) {
            return relative_difference(found, expected, start, quantity);
        };
        // the kernels' added mass is a series to 1e-10
        const double rounding = scene.features.fluid_mass ? 2e-10 : 1e-11;
        EXPECT_LT(difference([](const PlainNode& n) { return n.velocity; }), rounding);
        EXPECT_LT(difference([](const PlainNode& n) { return n.angular_velocity; }), rounding);
        EXPECT_LT(difference([](const PlainNode& n) { return Vector3d(n.spin, 0, 0); }), rounding);
        // of positions far from the origin, which move by millimetres
        EXPECT_LT(difference([](const PlainNode& n) { return n.position; }), 5 * rounding);
        EXPECT_LT(difference([](const PlainNode& n) { return n.director; }), rounding);
        if (GetParam().curved) {
            EXPECT_LT(difference([](const PlainNode& n) { return n.material; }), rounding);
        }
        for (std::size_t k = 0; k < start.twist.size(); ++k) {
            EXPECT_NEAR(found.twist[k], expected.twist[k], 1e-14);
            EXPECT_EQ(found.node[k].last_director, start.node[k].director);
        }
        EXPECT_NEAR(kernel.outflow, plain.outflow, rounding * (1 + std::abs(plain.outflow)));
        EXPECT_EQ(kernel.faults, 0);
        EXPECT_EQ(kernel.impacts, plain.impacts);
        EXPECT_EQ(kernel.slips, plain.slips);
        if (!scene.features.well) continue;
        EXPECT_LT(difference([](const PlainNode& n) {
                      return Vector3d(n.spring.elongation.axial, n.spring.elongation.azimuthal, 0);
                  }),
                  rounding);
        for (std::size_t k = 0; k < start.node.size(); ++k) {
            EXPECT_EQ(found.node[k].spring.sliding, expected.node[k].spring.sliding);
            EXPECT_NEAR(found.node[k].depth, expected.node[k].depth, 1e-13);
            if (scene.contact.restitution) {
                EXPECT_EQ(found.node[k].rebounds, expected.node[k].rebounds);
            }
            EXPECT_NEAR(found.node[k].fluid_mass, expected.node[k].fluid_mass,
                        1e-9 * expected.node[k].fluid_mass);
            if (expected.node[k].depth > 0 && expected.node[k].spring.sliding < 0.5) ++sticking;
        }
        impacts += plain.impacts;
        slips += plain.slips;
    }
    if (!scene.features.well) return;
    // all of it must have happened
    EXPECT_GT(impacts, 20);
    EXPECT_GT(sticking, 20);
    if (scene.contact.law == FrictionLaw::coulomb) {
        EXPECT_GT(slips, 20);
    }
}

constexpr const char* damped = "[damping]\ninternal = 3\nexternal = 200\nkelvin_voigt = 1e-4\n";
constexpr const char* wall =
    "[contact]\nnormal_stiffness = 1e6\nnormal_damping = 1e4\ntangential_stiffness = 1e5\n";
constexpr const char* impacts =
    "[contact]\nnormal_stiffness = 1e6\nrestitution = 0.7\ntangential_stiffness = 1e5\n";
constexpr const char* hertz =
    "[contact]\nnormal_law = \"hertz\"\nnormal_stiffness = 5e6\nhunt_crossley = 0.8\n"
    "tangential_stiffness = 1e5\n";
constexpr const char* pairs =
    "[damping]\ninternal_translation = 3\ninternal_rotation = 0.3\nexternal_translation = 200\n"
    "external_rotation = 20\n";
constexpr const char* papers_mud =
    "[fluid]\ndensity = 1200\nviscosity = 0.05\nregime = \"laminar\"\ncontact_drag = false\n"
    "added_mass = false\n";
constexpr const char* laminar_mud =
    "[fluid]\ndensity = 1200\nviscosity = 0.05\nregime = \"laminar\"\nadded_mass = false\n";
constexpr const char* inertial_mud =
    "[fluid]\ndensity = 1200\nviscosity = 0.05\nadded_mass = false\n";
constexpr const char* mud = "[fluid]\ndensity = 1200\nviscosity = 0.05\n";

INSTANTIATE_TEST_SUITE_P(
    Rods, DirectorKernelsOn,
    testing::Values(
        Variant{"OneSegment", 1, false, false, ""}, Variant{"OneBlock", 15, false, false, ""},
        Variant{"LastNodeAlone", 32, false, false, ""},
        Variant{"SeveralBlocksDamped", 37, false, false, damped},
        Variant{"Unbalanced", 37, false, false, "", false, true},
        Variant{"UnbalancedInMud", 37, true, true, std::string(wall) + mud + damped, false, true},
        Variant{"Curved", 37, true, false, ""}, Variant{"CurvedDamped", 37, true, false, damped},
        Variant{"DampingInPairs", 37, false, false, pairs},
        Variant{"OnlyKelvinVoigt", 20, false, false, "[damping]\nkelvin_voigt = 1e-3\n"},
        Variant{"DryWell", 37, false, true, wall},
        Variant{"FastCreep", 37, false, true, std::string(wall) + "rolling_creep = 1\n"},
        Variant{"FastCreepByThePapersLaw", 37, false, true,
                std::string(wall) + "rolling_creep = 1\nlaw = \"paper\"\n"},
        Variant{"FrictionThatFallsWithSpeed", 37, false, true,
                std::string(wall) + "stribeck_speed = 0.5\n"},
        Variant{"PapersMud", 37, false, true, std::string(wall) + papers_mud},
        Variant{"PapersAxialDrag", 37, false, true,
                std::string(wall) + papers_mud + "axial_drag = \"concentric\"\n"},
        Variant{"LaminarMud", 37, false, true, std::string(wall) + laminar_mud},
        Variant{"InertialMud", 37, false, true, std::string(wall) + inertial_mud},
        Variant{"InertialMudWithoutViscosity", 37, false, true,
                std::string(wall) + "[fluid]\ndensity = 1200\nviscosity = 0\nadded_mass = false\n"},
        Variant{"MudWithMass", 37, false, true, std::string(wall) + mud},
        Variant{"MudWithMassButNoDrag", 37, false, true,
                std::string(wall) + "[fluid]\ndensity = 1200\ndrag = false\n"},
        Variant{"LaminarMudWithMassOfAnEmptyPipe", 37, false, true,
                std::string(wall) +
                    "[fluid]\ndensity = 1200\nviscosity = 0.05\nregime = \"laminar\"\n"
                    "inside = \"empty\"\n"},
        Variant{"MudWithMassDamped", 37, false, true, std::string(wall) + mud + pairs},
        Variant{"MudInMotion", 37, false, true, std::string(wall) + mud, false, false, true},
        Variant{"LaminarMudInMotionDamped", 37, false, true,
                std::string(wall) + laminar_mud + pairs, false, false, true},
        Variant{"EverythingInMudInMotion", 50, true, true, std::string(wall) + mud + damped, false,
                false, true},
        Variant{"Impacts", 37, false, true, impacts},
        Variant{"ImpactsInMudWithMass", 37, false, true, std::string(impacts) + mud},
        Variant{"PullingWall", 37, false, true, std::string(wall) + "tension = true\n"},
        Variant{"PapersLaw", 37, false, true,
                std::string(wall) + "law = \"paper\"\ntension = true\n"},
        Variant{"PapersLawInMud", 37, false, true,
                std::string(wall) + "law = \"paper\"\n" + papers_mud},
        Variant{
            "UnequalFriction", 37, false, true,
            std::string(wall) + "static_friction = [0.2, 0.7]\ndynamic_friction = [0.1, 0.5]\n"},
        Variant{"FrictionAroundAlone", 37, false, true,
                std::string(wall) + "static_friction = [0, 0.7]\ndynamic_friction = [0, 0.5]\n"},
        Variant{"VariedWall", 37, false, true, wall, true},
        Variant{"VariedWallByThePapersLaw", 37, false, true,
                std::string(wall) + "law = \"paper\"\n", true},
        Variant{"ImpactsOnAVariedWallInMud", 37, false, true, std::string(impacts) + laminar_mud,
                true},
        Variant{"HertzsWall", 37, false, true, hertz},
        Variant{"HertzsWallThatPulls", 37, false, true, std::string(hertz) + "tension = true\n"},
        Variant{"HertzsWallAndFrictionThatFallsWithSpeed", 37, false, true,
                std::string(hertz) + "stribeck_speed = 0.5\n" + inertial_mud},
        Variant{"HertzsVariedWall", 37, false, true, hertz, true},
        Variant{"HertzsVariedWallInMudDamped", 37, true, true,
                std::string(hertz) + laminar_mud + damped, true},
        Variant{"Everything", 50, true, true, std::string(wall) + mud + damped},
        Variant{"EverythingByThePapersLaw", 50, true, true,
                std::string(wall) + "law = \"paper\"\n" + mud + damped}),
    [](const auto& variant) { return variant.param.name; });

TEST(DirectorKernels, ReportTheEnergyWrittenSegmentBySegment) {
    Dice dice(11);
    for (const bool curved : {false, true}) {
        for (const int segments : {1, 7, 8, 9, 50}) {
            const Scene scene =
                build_scene(test::case_from(three_components(curved, 200e9) +
                                            "[mesh]\nsegments = " + std::to_string(segments)));
            const DirectorString string(scene);
            PlainRod rod = random_rod(scene, dice);
            DirectorState state = initial_state(string);
            for (std::size_t k = 0; k < rod.node.size(); ++k) {
                const auto entry = static_cast<std::ptrdiff_t>(k);
                state.rod.set(DirectorRow::position, entry, rod.node[k].position);
                state.rod.set(DirectorRow::director, entry, rod.node[k].director);
                state.rod.set(DirectorRow::last_director, entry, rod.node[k].director);
            }
            std::copy(rod.twist.begin(), rod.twist.end(), state.rod.row(DirectorRow::last_twist));
            state.head.d1 = rod.node[0].material;
            const std::vector<Eigen::Matrix3d> frames =
                material_frames(string, state.rod, rod.twist.data(), string.head.d1(state.head, 0));
            for (std::size_t k = 0; k < rod.node.size(); ++k)
                rod.node[k].material = frames[k].col(1);
            const double energy = test::plain_elastic_energy(scene, rod);
            EXPECT_NEAR(series_record(string, state).energy.elastic, energy, 1e-9 * energy);
        }
    }
}

TEST(DirectorKernels, LetANodeBesideTheAxisOfTheWellMoveAsIfThereWereNone) {
    // where the direction toward the axis is little but rounding
    Case input = test::case_from("gravity = 0\n" + three_components(false, 200e9) +
                                 "[mesh]\nsegments = 20\n");
    WellCase hole;
    hole.survey = {{0, 0.7, 0.4}, {1000, 0.7, 0.4}};
    hole.sections = {{1000, 0.32}};
    input.well = hole;
    const Scene scene = build_scene(input);
    Dice dice(3);
    for (double eccentricity = 1e-15; eccentricity < 1e-3; eccentricity *= 10) {
        const Vector3d along = scene.head_frame.col(0);
        const Vector3d aside = eccentricity * dice.vector(1).cross(along).normalized();
        const Vector3d speed = 3 * along + dice.vector(0.1);
        PlainRod rod;
        for (std::size_t k = 0; k < scene.mesh.node.size(); ++k) {
            PlainNode node;
            node.position = scene.initial_nodes.position[k] + 100 * along + aside;
            node.velocity = speed;
            node.director = node.last_director = along;
            node.angular_velocity.setZero();
            node.material = scene.head_frame.col(1);
            rod.node.push_back(node);
        }
        rod.twist.assign(scene.mesh.length.size(), 0.0);
        test::kernel_director_step(scene, rod, {}, {}, 1e-3, 1e-3, 1e-3);
        for (const PlainNode& node : rod.node) {
            // the rod's own forces: rounding of positions times its stiffness
            EXPECT_LT((node.velocity - speed).norm(), 1e-7) << eccentricity;
        }
    }
}

}  // namespace
}  // namespace drillstrand
