// What is said of a string whose nodes go around the well: shares, rates, place and energies of
// motions that are set by hand.
#include "rod/whirl.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "drillstrand/scene.hpp"
#include "rod/report.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;
constexpr double pipe_radius = 0.07;  // m
constexpr double hole_radius = 0.11;  // m
constexpr double clearance = hole_radius - pipe_radius;
constexpr std::size_t nodes = 21;
constexpr double cell = 5;  // m
constexpr double length = 100;
constexpr double first_depth = 200;  // measured depth of the head (m)

/// Down a well that leans by 0.7 toward azimuth 0.4, and a direction across it.
const Vector3d down(std::sin(0.7) * std::cos(0.4), std::sin(0.7) * std::sin(0.4), std::cos(0.7));
const Vector3d across = down.cross(Vector3d::UnitY()).normalized();

Case pipe_in_straight_well() {
    Case input;
    WellCase well;
    well.survey = {{first_depth, 0.7, 0.4}, {first_depth + 2 * length, 0.7, 0.4}};
    well.sections = {{1000, 2 * hole_radius}};
    input.well = well;
    Component pipe;
    pipe.length = length;
    pipe.outer_diameter = 2 * pipe_radius;
    pipe.inner_diameter = 0.12;
    pipe.linear_density = 31.8557;
    pipe.youngs_modulus = 200e9;
    input.string.components = {pipe};
    input.mesh.segments = nodes - 1;
    return input;
}

/// A pipe on the axis of the well that does not move, and what is made of it.
class Pipe {
  public:
    Pipe() {
        for (std::size_t k = 0; k < nodes; ++k)
            position_.emplace_back(scene_.head_position + cell * static_cast<double>(k) * down);
        velocity_.resize(nodes, {Vector3d::Zero(), 0});
    }

    void spin(double rate) {
        for (NodeVelocity& velocity : velocity_)
            velocity.spin = rate;
    }

    /// Nodes `first` to `last` go around the axis at a rate, each at its own place on the circle,
    /// while they sink.
    void turn(std::size_t first, std::size_t last, double eccentricity, double rate) {
        for (std::size_t k = first; k <= last; ++k) {
            const Eigen::AngleAxisd place(0.9 * static_cast<double>(k), down);
            const Vector3d aside = eccentricity * (place * across);
            position_[k] += aside;
            velocity_[k].linear = (rate * down).cross(aside) + 0.3 * down;
        }
    }

    [[nodiscard]] Whirl whirl() const { return whirl_of(scene_, contacts(), velocity_); }
    [[nodiscard]] std::vector<double> rates() const { return whirl_rates(contacts(), velocity_); }
    [[nodiscard]] double energy() const { return rotation_energy(scene_, velocity_); }
    [[nodiscard]] std::vector<NodeContact> contacts() const {
        const Surroundings surroundings(scene_);
        return contacts_of(surroundings, surroundings.wall_at(position_), position_);
    }
    [[nodiscard]] const Scene& scene() const { return scene_; }

  private:
    Scene scene_ = build_scene(pipe_in_straight_well());
    std::vector<Vector3d> position_;
    std::vector<NodeVelocity> velocity_;
};

void expect_no_whirl(const Pipe& pipe) {
    const Whirl whirl = pipe.whirl();
    EXPECT_EQ(whirl.forward, 0);
    EXPECT_EQ(whirl.backward, 0);
    EXPECT_EQ(whirl.rate, 0);
    EXPECT_EQ(whirl.rolling_rate, 0);
    EXPECT_EQ(whirl.depth, 0);
}

TEST(Whirl, PipeThatRollsAlongTheWallGoesAroundBackwardAtTheRollingRate) {
    for (const double spin : {12.0, -12.0}) {
        Pipe pipe;
        pipe.spin(spin);
        pipe.turn(5, 8, clearance, -spin * pipe_radius / clearance);
        const Whirl whirl = pipe.whirl();
        EXPECT_NEAR(whirl.backward, 4 * cell / length, 1e-12);
        EXPECT_EQ(whirl.forward, 0);
        EXPECT_NEAR(whirl.rate, -12 * 0.07 / 0.04, 1e-9);
        EXPECT_NEAR(whirl.rolling_rate, -12 * 0.07 / 0.04, 1e-12);
        EXPECT_NEAR(whirl.depth, first_depth + 6.5 * cell, 1e-9);
    }
}

TEST(Whirl, DeepInASoftWallThePipeRollsOnTheCircleThatItGoesAround) {
    Pipe pipe;
    pipe.spin(12);
    const double eccentricity = 3 * clearance;
    pipe.turn(0, 20, eccentricity, -12 * pipe_radius / eccentricity);  // no slip: v_t = -R s
    EXPECT_NEAR(pipe.whirl().rate, -7, 1e-9);
    EXPECT_NEAR(pipe.whirl().rolling_rate, -7, 1e-9);
}

TEST(Whirl, ForwardAndBackwardPartsAreToldApartAndTheirRateIsTheMean) {
    Pipe pipe;
    pipe.spin(10);
    pipe.turn(2, 7, 0.8 * clearance, 4);
    // cells of 1, 13/12 and 5/12
    pipe.turn(18, 20, 0.6 * clearance, -7);
    const Whirl whirl = pipe.whirl();
    EXPECT_NEAR(whirl.forward, 6 * cell / length, 1e-12);
    EXPECT_NEAR(whirl.backward, 2.5 * cell / length, 1e-12);
    EXPECT_NEAR(whirl.rate, (6 * 4.0 - 2.5 * 7) / 8.5, 1e-9);
    EXPECT_NEAR(whirl.rolling_rate, -17.5, 1e-9);
    const double moment = 6 * 4.5 + 18 + 13. / 12 * 19 + 5. / 12 * 20;
    EXPECT_NEAR(whirl.depth, first_depth + cell * moment / 8.5, 1e-9);
    for (std::size_t k = 0; k <= 20; ++k) {
        const double expected = k >= 18 ? -7 : k >= 2 && k <= 7 ? 4 : 0;
        EXPECT_NEAR(pipe.rates()[k], expected, 1e-9) << "node " << k;
    }
}

TEST(Whirl, AsksForEccentricityForASpinAndForAWayAroundTheWell) {
    Pipe standing;
    standing.turn(0, 20, clearance, 5);
    expect_no_whirl(standing);
    Pipe lying;
    lying.spin(10);
    lying.turn(0, 20, clearance, 0);
    expect_no_whirl(lying);
    Pipe drifting;
    drifting.spin(10);
    drifting.turn(0, 20, clearance, 0.99);
    expect_no_whirl(drifting);
    Pipe near_the_axis;
    near_the_axis.spin(10);
    near_the_axis.turn(0, 20, 0.49 * clearance, -20);
    expect_no_whirl(near_the_axis);
    Pipe just_so;
    just_so.spin(10);
    just_so.turn(0, 20, 0.51 * clearance, 1.01);
    EXPECT_NEAR(just_so.whirl().forward, 1, 1e-12);
}

TEST(Whirl, EnergyOfRotationIsThatOfSpinAlone) {
    Pipe pipe;
    pipe.spin(-6);
    pipe.turn(0, 20, clearance, 30);
    const double polar_inertia = 31.8557 * (0.14 * 0.14 + 0.12 * 0.12) / 8;  // m (D^2 + d^2) / 8
    EXPECT_NEAR(pipe.energy(), 0.5 * length * polar_inertia * 36, 1e-9);
}

// --- what presses and rubs

std::vector<double> pushed(double compression) {
    return std::vector<double>(nodes - 1, -compression);
}

TEST(Penetration, OfAHelixIsTheClearanceTimesQOverOneLessQ) {
    const Pipe pipe;
    const double stiffness = 1e7;  // the default wall
    const double bending = 200e9 * M_PI / 64 * (std::pow(0.14, 4) - std::pow(0.12, 4));
    for (const double q : {1e-4, 0.1, 0.5, 0.9}) {
        const double load = std::sqrt(4 * q * bending * stiffness);
        EXPECT_NEAR(helix_penetration(pipe.scene(), pipe.contacts(), pushed(load)),
                    clearance * q / (1 - q), 1e-9 * clearance);
    }
    // no helix stays in a wall that gives way
    const double most = 10 * clearance;
    EXPECT_NEAR(helix_penetration(pipe.scene(), pipe.contacts(), pushed(1e9)), most, 1e-12);
}

TEST(Penetration, OfAHelixInHertzsWallIsThatOfItsSideForce) {
    const Pipe pipe;
    Scene scene = pipe.scene();
    constexpr double stiffness = 1e9;  // Pa/m^0.5
    scene.contact.normal_law = NormalLaw::hertz;
    scene.normal_stiffness.assign(nodes, stiffness);
    const double bending = 200e9 * M_PI / 64 * (std::pow(0.14, 4) - std::pow(0.12, 4));
    for (const double load : {1e3, 1e5, 1e7}) {
        const double depth = helix_penetration(scene, pipe.contacts(), pushed(load));
        const double side_force = load * load * (clearance + depth) / (4 * bending);
        EXPECT_NEAR(stiffness * std::pow(depth, 1.5), side_force, 1e-9 * side_force) << load;
    }
    EXPECT_NEAR(helix_penetration(scene, pipe.contacts(), pushed(1e9)), 10 * clearance, 1e-12);
}

TEST(Penetration, OfAHelixNeedsACompression) {
    const Pipe pipe;
    EXPECT_EQ(helix_penetration(pipe.scene(), pipe.contacts(), pushed(-1e6)), 0);
    EXPECT_EQ(helix_penetration(pipe.scene(), pipe.contacts(), pushed(0)), 0);
}

TEST(WallDrag, IsTheSumOverCellsAndItsDepthTheMeanWeightedBySize) {
    const Pipe pipe;
    std::vector<double> friction(nodes, 0.0);
    std::vector<double> depth;
    for (const NodeContact& contact : pipe.contacts())
        depth.push_back(contact.well_depth);
    EXPECT_EQ(wall_drag(pipe.scene(), friction, depth).depth, 0);
    friction[4] = 300;
    friction[20] = -240;
    const WallDrag drag = wall_drag(pipe.scene(), friction, depth);
    EXPECT_NEAR(drag.force, 1500 - 500, 1e-9);  // on a cell and on 5/12 of one
    EXPECT_NEAR(drag.depth, first_depth + (1500 * 20 + 500 * 100) / 2000.0, 1e-9);
}

}  // namespace
}  // namespace drillstrand
