/// The scalar twin of the vector kernels: the same equations as plain C++ over arrays of
/// structures, node by node, with sines and logarithms from the C library. What the vector kernels
/// are faster than, and a second opinion on what they compute.
///
/// A scene whose head is driven; the energy account is left out.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "drillstrand/scene.hpp"
#include "forces/added_mass.hpp"
#include "forces/contact.hpp"
#include "forces/fluid.hpp"
#include "forces/surroundings.hpp"
#include "forces/well_frame.hpp"
#include "integrators/step_control.hpp"
#include "model/pose.hpp"

namespace drillstrand::bench {

/// A 6-vector in body axes (d3, d1, d2).
struct Six {
    Eigen::Vector3d angular = Eigen::Vector3d::Zero();
    Eigen::Vector3d linear = Eigen::Vector3d::Zero();
};

/// Momenta of N+1 nodes and stresses of N segments, or their rates.
struct PlainState {
    std::vector<Six> momentum;
    std::vector<Six> stress;
};

/// Drag coefficients with the functions of the C library and a branch where Phi needs its series.
DragCoefficients plain_drag_coefficients(double eccentricity, double pipe, double hole);

/// The drag of the flow's inertia besides, likewise.
DragCoefficients plain_drag_with_inertia(const DragCoefficients& creeping, const FlowInertia& flow,
                                         double radius, double across, double along, double spin);

class PlainStrand {
  public:
    /// Constants of the scene; nodes lie in the arcs that hold their initial positions.
    explicit PlainStrand(const Scene& scene);

    /// Stress rates, wrenches on the nodes and poses of all nodes from the head's.
    void segments(const PlainState& state, PlainState& rate, const Pose& head);

    /// Momentum rates of nodes begin..end-1. Call segments() before.
    void nodes(const PlainState& state, PlainState& rate, std::size_t begin, std::size_t end);

    /// Friction springs of nodes begin..end-1 after the last nodes() went on for dt (s).
    void advance_springs(double dt, std::size_t begin, std::size_t end);

    /// Moves a node whose foot has left its arc of well to the arc that holds it.
    void follow_arc(std::size_t node);

    /// The fluid that moves sideways with a node where it is now.
    void follow_fluid(std::size_t node);

    /// Stress that the outside imposes at the bit.
    void set_bit_stress(const Vector6& stress);

    [[nodiscard]] const Pose& pose(std::size_t node) const { return pose_[node]; }
    [[nodiscard]] WellFrame frame_at(std::size_t node) const;
    /// Whether a node touches the wall, holds a stretched spring, has left its arc or takes fluid
    /// along.
    [[nodiscard]] bool changes(std::size_t node) const;

  private:
    struct Segment {
        double length;
        Six stiffness, compliance, unstressed;
    };
    struct Node {
        double inverse_cell, weight, pipe, normal_stiffness, normal_damping;
        double mass, inside, displaced;
        Six inverse_inertia;
    };
    struct Contact {
        std::size_t arc;
        ArcNumbers numbers;
        double end_cosine, reach;
        FrictionSpring spring;
        Tangential slip;
        double depth, normal, rolling, fluid_mass;
        FlowInertia flow;
        bool leaves;
    };

    [[nodiscard]] Six velocity(const PlainState& state, std::size_t node) const;
    [[nodiscard]] Six surroundings(std::size_t node, const Six& velocity);
    [[nodiscard]] Six damping(std::size_t node, const Six& velocity, const PlainState& rate) const;
    void enter_arc(std::size_t node, std::size_t arc);
    [[nodiscard]] AddedMass annulus_mass(std::size_t node, double eccentricity) const;

    const Scene& scene_;
    SurroundingsParameters parameters_;
    std::vector<Segment> segment_;
    std::vector<Node> node_;
    std::vector<Contact> contact_;
    std::vector<Six> wrench_on_first_;  ///< of segment k on node k; entry N is the bit's
    std::vector<Six> wrench_on_last_;   ///< of segment k - 1 on node k; entry 0 is the head's
    std::vector<Pose> pose_;
};

/// Dormand-Prince with the engine's step control.
class PlainDormandPrince {
  public:
    PlainDormandPrince(const Scene& scene, const Tolerances& tolerances);

    /// Attempts steps until so many more are accepted.
    void advance(int steps);

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] const PlainState& state() const { return state_; }
    [[nodiscard]] long attempts() const { return attempts_; }

  private:
    void evaluate(double time, PlainState& state, PlainState& rate);
    void combine(std::size_t stage, double step);
    [[nodiscard]] double error(double step) const;
    void follow_surroundings(double step);

    const Scene& scene_;
    Tolerances tolerances_;
    PlainStrand strand_;
    PlainState state_;
    PlainState trial_;
    std::array<PlainState, DormandPrinceTableau::stages> rate_;
    double time_ = 0;
    double step_;
    long attempts_ = 0;
};

/// The state of a scene at rest, with the stresses of its initial strains.
PlainState initial_state(const Scene& scene);

/// Pose of a driven head.
Pose driven_head(const Scene& scene, double time);

}  // namespace drillstrand::bench
