#include "plain_strand.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "rod/bit.hpp"
#include "rod/report.hpp"
#include "rod/strand.hpp"

namespace drillstrand::bench {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Tableau = DormandPrinceTableau;

namespace {

Six six(const Vector6& v) {
    return {v.head<3>(), v.tail<3>()};
}

/// exp(h k^) and h T(h k) g.
Pose segment_step(double h, const Vector3d& curvature, const Vector3d& stretch) {
    const Vector3d turn = h * curvature;
    const double angle2 = turn.squaredNorm();
    const double angle = std::sqrt(angle2);
    double sine = 1 - angle2 / 6;
    double cosine = 0.5 - angle2 / 24;
    double difference = 1.0 / 6 - angle2 / 120;
    if (angle > 1e-3) {
        sine = std::sin(angle) / angle;
        cosine = (1 - std::cos(angle)) / angle2;
        difference = (1 - sine) / angle2;
    }
    const Vector3d once = turn.cross(stretch);
    const Vector3d twice = turn.cross(once);
    Matrix3d w;
    w << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
    return {Matrix3d::Identity() + sine * w + cosine * w * w,
            h * (stretch + cosine * once + difference * twice)};
}

}  // namespace

DragCoefficients plain_drag_coefficients(double eccentricity, double pipe, double hole) {
    constexpr double pi = std::numbers::pi;
    const double e2 = eccentricity * eccentricity;
    const double pipe2 = pipe * pipe;
    const double hole2 = hole * hole;
    const double q = 2 * pipe * hole;
    const double t = std::sqrt((hole - pipe - eccentricity) * (hole + pipe - eccentricity) *
                               (hole - pipe + eccentricity) * (hole + pipe + eccentricity));
    const double sinh_d = t / q;
    const double cosh_d = std::sqrt(1 + sinh_d * sinh_d);
    const double d = std::asinh(sinh_d);
    double phi = d * cosh_d - sinh_d;
    if (d < 0.5) {
        double term = d * d * d / 3;
        phi = 0;
        for (int n = 1; n < 8; ++n) {
            phi += term;
            term *= d * d * (n + 1) / (n * (2.0 * n + 2) * (2.0 * n + 3));
        }
    }
    const double scale = 4 * pi / (q * phi + e2 * d);
    return {4 * pi * cosh_d / phi, 2 * pi / d, scale * (pipe2 + hole2),
            -scale * pipe2 * eccentricity, scale * pipe2 * (hole2 * phi / sinh_d + e2)};
}

DragCoefficients plain_drag_with_inertia(const DragCoefficients& creeping, const FlowInertia& flow,
                                         double radius, double across, double along, double spin) {
    const double reynolds = flow.swirl_reynolds * std::abs(spin) + 1;
    const double coefficient =
        std::max(1.03 / std::sqrt(reynolds), 0.065 * std::pow(reynolds, -0.2));
    const double swirl = flow.swirl * std::abs(spin) * coefficient;
    const double stream = flow.stream * std::pow(std::hypot(along, radius * spin), 0.75);
    return {creeping.radial + flow.cross * across, std::hypot(creeping.axial, stream),
            creeping.around + flow.cross * across, creeping.cross,
            std::hypot(creeping.spin, swirl)};
}

PlainStrand::PlainStrand(const Scene& scene)
    : scene_(scene), parameters_(surroundings_parameters(scene)) {
    const StringMesh& mesh = scene.mesh;
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const Vector6 stiffness = stiffness_of(mesh.segment[k]);
        segment_.push_back({mesh.length[k], six(stiffness), six(stiffness.cwiseInverse()),
                            six(stress_free_strain(mesh.segment[k]))});
    }
    for (std::size_t k = 0; k < mesh.cell.size(); ++k) {
        const SectionProperties& s = mesh.node[k];
        const double transverse = 1 / scene.inertia[k];
        node_.push_back(
            {1 / mesh.cell[k],
             scene.weight[k],
             s.outer_radius,
             scene.well ? scene.normal_stiffness[k] : 0.0,
             scene.well ? scene.normal_damping[k] : 0.0,
             s.mass,
             scene.features.fluid_mass ? fluid_inside(s, *scene.fluid) : 0.0,
             scene.features.fluid_mass ? fluid_displaced(s, *scene.fluid) : 0.0,
             {{1 / s.polar_inertia, transverse, transverse}, Vector3d::Constant(1 / s.mass)}});
    }
    wrench_on_first_.resize(node_.size());
    wrench_on_last_.resize(node_.size());
    pose_ = poses_from_strains({scene.head_frame, scene.head_position}, mesh.length,
                               scene.initial_strain);
    if (!scene.well) return;
    contact_.resize(node_.size());
    std::size_t guess = scene.well->arc_at(scene.well->measured_depth_start());
    for (std::size_t k = 0; k < node_.size(); ++k) {
        guess = scene.well->find_arc(pose_[k].position, guess);
        enter_arc(k, guess);
        follow_fluid(k);
    }
}

void PlainStrand::enter_arc(std::size_t node, std::size_t arc) {
    const WellArc& a = scene_.well->arcs()[arc];
    const double angle = a.curvature * a.length;
    Contact& c = contact_[node];
    c.arc = arc;
    c.numbers = {triple(a.start), triple(a.tangent), triple(a.normal), a.curvature, a.radius};
    c.end_cosine = std::cos(angle);
    c.reach = angle < 1e-8 ? a.length : std::sin(angle) / a.curvature;
    if (parameters_.inertial_flow) {
        c.flow = flow_inertia(parameters_.density, parameters_.viscosity,
                              parameters_.drag_coefficient, node_[node].pipe, a.radius);
    }
}

AddedMass PlainStrand::annulus_mass(std::size_t node, double eccentricity) const {
    const Node& n = node_[node];
    const double hole = contact_[node].numbers.radius;
    const double at = film_eccentricity(eccentricity, n.pipe, hole, parameters_.film);
    const AddedMass added = added_mass({at, n.pipe, hole});
    return {n.displaced * added.coefficient, at < eccentricity ? 0.0 : n.displaced * added.slope};
}

void PlainStrand::follow_fluid(std::size_t node) {
    if (!scene_.features.fluid_mass) return;
    contact_[node].fluid_mass =
        node_[node].inside + annulus_mass(node, frame_at(node).eccentricity).coefficient;
}

Six PlainStrand::velocity(const PlainState& state, std::size_t node) const {
    const Six& inverse = node_[node].inverse_inertia;
    const Six& momentum = state.momentum[node];
    Six v{inverse.angular.cwiseProduct(momentum.angular),
          inverse.linear.cwiseProduct(momentum.linear)};
    if (scene_.features.fluid_mass)
        v.linear.tail<2>() =
            momentum.linear.tail<2>() / (node_[node].mass + contact_[node].fluid_mass);
    return v;
}

void PlainStrand::segments(const PlainState& state, PlainState& rate, const Pose& head) {
    pose_[0] = head;
    for (std::size_t k = 0; k < segment_.size(); ++k) {
        const Segment& s = segment_[k];
        const Six& stress = state.stress[k];
        const Vector3d curvature =
            s.compliance.angular.cwiseProduct(stress.angular) + s.unstressed.angular;
        const Vector3d stretch =
            s.compliance.linear.cwiseProduct(stress.linear) + s.unstressed.linear;
        const Six a = velocity(state, k);
        const Six b = velocity(state, k + 1);
        const Vector3d w = (a.angular + b.angular) / 2;
        const Vector3d v = (a.linear + b.linear) / 2;
        rate.stress[k].angular = s.stiffness.angular.cwiseProduct(
            (b.angular - a.angular) / s.length + curvature.cross(w));
        rate.stress[k].linear = s.stiffness.linear.cwiseProduct(
            (b.linear - a.linear) / s.length + curvature.cross(v) + stretch.cross(w));

        const Vector3d couple =
            s.length / 2 * (curvature.cross(stress.angular) + stretch.cross(stress.linear));
        const Vector3d push = s.length / 2 * curvature.cross(stress.linear);
        wrench_on_first_[k] = {stress.angular + couple, stress.linear + push};
        wrench_on_last_[k + 1] = {stress.angular - couple, stress.linear - push};

        const Pose step = segment_step(s.length, curvature, stretch);
        pose_[k + 1].position = pose_[k].position + pose_[k].frame * step.position;
        pose_[k + 1].frame = pose_[k].frame * step.frame;
    }
}

void PlainStrand::nodes(const PlainState& state, PlainState& rate, std::size_t begin,
                        std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
        const Node& n = node_[k];
        const Six v = velocity(state, k);
        const Six& momentum = state.momentum[k];
        Six& result = rate.momentum[k];
        result.angular =
            n.inverse_cell * (wrench_on_first_[k].angular - wrench_on_last_[k].angular) +
            momentum.angular.cross(v.angular);
        if (scene_.features.fluid_mass) result.angular += momentum.linear.cross(v.linear);
        result.linear = n.inverse_cell * (wrench_on_first_[k].linear - wrench_on_last_[k].linear) +
                        momentum.linear.cross(v.angular) +
                        n.weight * (pose_[k].frame.transpose() * scene_.down);
        if (scene_.features.well) {
            const Six outside = surroundings(k, v);
            result.angular += outside.angular;
            result.linear += outside.linear;
        }
        if (scene_.features.damping != Damping::none) {
            const Six loss = damping(k, v, rate);
            result.angular -= loss.angular;
            result.linear -= loss.linear;
        }
    }
}

WellFrame PlainStrand::frame_at(std::size_t node) const {
    return well_frame(triple(pose_[node].position), contact_[node].numbers);
}

/// Contact, friction and fluid on a node, in body axes.
Six PlainStrand::surroundings(std::size_t node, const Six& velocity) {
    const Node& n = node_[node];
    Contact& c = contact_[node];
    const WellFrame frame = frame_at(node);
    const Matrix3d to_body = pose_[node].frame.transpose();
    const Vector3d r = to_body * vector(frame.r);
    const Vector3d l = to_body * vector(frame.l);
    const Vector3d t = r.cross(l);
    const double v_r = velocity.linear.dot(r);
    const double v_l = velocity.linear.dot(l);
    const double v_t = velocity.linear.dot(t);
    const double w_l = velocity.angular.dot(l);
    const double hole = c.numbers.radius;
    const SurroundingsParameters& p = parameters_;

    c.leaves = foot_leaves(frame, c.end_cosine, c.reach);
    c.depth = penetration(frame.eccentricity, hole, n.pipe);
    c.slip = slip_velocity(v_l, p.friction.cone() * v_t, w_l, n.pipe);
    c.rolling = rolling_speed(v_t, frame.eccentricity, hole);
    c.normal = 0;
    double force_r = 0;
    Tangential rub{0, 0};
    double couple = 0;
    if (c.depth > 0) {
        c.normal = normal_force(c.depth, v_r, n.normal_stiffness, n.normal_damping, p.least_normal);
        rub = friction_force(c.spring, c.normal, p.friction);
        force_r = c.normal;
        couple = n.pipe * rub.azimuthal;
    }
    if (scene_.features.drag && (c.depth <= 0 || p.contact_drag)) {
        const double eccentricity = film_eccentricity(frame.eccentricity, n.pipe, hole, p.film);
        DragCoefficients drag = plain_drag_coefficients(eccentricity, n.pipe, hole);
        if (!p.eccentric_axial_drag) drag.axial = concentric_axial_drag(n.pipe, hole);
        drag = scaled(drag, p.viscosity);
        if (p.inertial_flow) {
            drag = plain_drag_with_inertia(drag, c.flow, n.pipe, std::hypot(v_r, v_t), v_l, w_l);
        }
        if (p.contact_drag) {
            const double clearance = hole - n.pipe;
            const double left = (clearance - frame.eccentricity) / (p.film * clearance);
            const double shear = std::clamp(left, 0.0, 1.0);
            drag.axial *= shear;
            drag.cross *= shear;
            drag.spin *= shear;
        }
        force_r -= drag.radial * v_r;
        rub.axial -= drag.axial * v_l;
        rub.azimuthal -= drag.around * v_t + drag.cross * w_l;
        couple -= drag.cross * v_t + drag.spin * w_l;
    }
    if (scene_.features.fluid_mass)
        force_r -= 0.5 * (v_r * v_r + v_t * v_t) * annulus_mass(node, frame.eccentricity).slope;
    return {couple * l, force_r * r + rub.axial * l + rub.azimuthal * t};
}

/// D_ex V + D_in dU/dt.
Six PlainStrand::damping(std::size_t node, const Six& velocity, const PlainState& rate) const {
    const DampingCase& d = scene_.damping;
    Six loss{d.external.rotation * velocity.angular, d.external.translation * velocity.linear};
    const auto add = [&](std::size_t k) {
        const double share = node_[node].inverse_cell * segment_[k].length / 2;
        const Six& compliance = segment_[k].compliance;
        loss.angular +=
            share * d.internal.rotation * compliance.angular.cwiseProduct(rate.stress[k].angular);
        loss.linear +=
            share * d.internal.translation * compliance.linear.cwiseProduct(rate.stress[k].linear);
    };
    if (node > 0) add(node - 1);
    if (node < segment_.size()) add(node);
    return loss;
}

bool PlainStrand::changes(std::size_t node) const {
    if (contact_.empty()) return false;
    const Contact& c = contact_[node];
    return scene_.features.fluid_mass || c.depth > 0 || c.leaves ||
           c.spring.elongation.axial != 0 || c.spring.elongation.azimuthal != 0;
}

void PlainStrand::advance_springs(double dt, std::size_t begin, std::size_t end) {
    const FrictionParameters& friction = parameters_.friction;
    for (std::size_t k = begin; k < end; ++k) {
        Contact& c = contact_[k];
        const Tangential slip = {dt * c.slip.axial, dt * c.slip.azimuthal};
        if (friction.law == FrictionLaw::coulomb) {
            c.spring = coulomb_spring(c.spring, slip, dt * c.rolling, c.normal, c.depth, friction);
        } else {
            c.spring = paper_spring(c.spring, slip, dt * c.rolling,
                                    node_[k].normal_stiffness * c.depth, c.depth, friction);
        }
    }
}

void PlainStrand::follow_arc(std::size_t node) {
    if (!contact_[node].leaves) return;
    enter_arc(node, scene_.well->find_arc(pose_[node].position, contact_[node].arc));
}

void PlainStrand::set_bit_stress(const Vector6& stress) {
    wrench_on_first_.back() = six(stress);
}

PlainState initial_state(const Scene& scene) {
    PlainState state{std::vector<Six>(scene.mesh.node.size()), {}};
    for (std::size_t k = 0; k < scene.mesh.segment.size(); ++k) {
        const SectionProperties& s = scene.mesh.segment[k];
        state.stress.push_back(
            six(stiffness_of(s).cwiseProduct(scene.initial_strain[k] - stress_free_strain(s))));
    }
    return state;
}

Pose driven_head(const Scene& scene, double time) {
    const Eigen::AngleAxisd turn(scene.head.rotation.integral(time), Vector3d::UnitX());
    return {scene.head_frame * turn.toRotationMatrix(), scene.head_position};
}

PlainDormandPrince::PlainDormandPrince(const Scene& scene, const Tolerances& tolerances)
    : scene_(scene), tolerances_(tolerances), strand_(scene), state_(initial_state(scene)) {
    trial_ = state_;
    rate_.fill(state_);
    step_ = 1.0;
    for (std::size_t k = 0; k < scene.inertia.size(); ++k) {
        const auto& segment = scene.mesh.segment[std::min(k, scene.mesh.segment.size() - 1)];
        step_ = std::min(step_, 0.01 * std::sqrt(scene.inertia[k] / segment.shear_stiffness));
    }
    evaluate(0, state_, rate_[0]);
}

void PlainDormandPrince::evaluate(double time, PlainState& state, PlainState& rate) {
    const std::size_t bit = state.stress.size();
    const double spin = scene_.head.rotation(time);
    state.momentum[0] = {{scene_.mesh.node.front().polar_inertia * spin, 0, 0}, Vector3d::Zero()};
    strand_.segments(state, rate, driven_head(scene_, time));
    const Matrix3d& frame = strand_.pose(bit).frame;
    strand_.set_bit_stress(Bit(scene_).stress(
        {frame, scene_.well ? vector(strand_.frame_at(bit).l) : frame.col(0), spin}, time));
    strand_.nodes(state, rate, 0, bit + 1);
    rate.momentum[0] = {};
}

void PlainDormandPrince::combine(std::size_t stage, double step) {
    const auto sum = [&](auto member) {
        for (std::size_t k = 0; k < (trial_.*member).size(); ++k) {
            Six total = (state_.*member)[k];
            for (std::size_t i = 0; i < stage; ++i) {
                const double weight = step * Tableau::a[stage][i];
                total.angular += weight * (rate_[i].*member)[k].angular;
                total.linear += weight * (rate_[i].*member)[k].linear;
            }
            (trial_.*member)[k] = total;
        }
    };
    sum(&PlainState::momentum);
    sum(&PlainState::stress);
}

double PlainDormandPrince::error(double step) const {
    constexpr std::array<double, 7> weight = Tableau::error_weights();
    double squares = 0;
    const auto add = [&](auto member, auto part) {
        for (std::size_t k = 0; k < (state_.*member).size(); ++k) {
            Vector3d error = Vector3d::Zero();
            for (std::size_t i = 0; i < weight.size(); ++i)
                error += weight[i] * (rate_[i].*member)[k].*part;
            for (Eigen::Index j = 0; j < 3; ++j) {
                squares += scaled_error_squared(step * error[j], ((state_.*member)[k].*part)[j],
                                                tolerances_);
            }
        }
    };
    add(&PlainState::momentum, &Six::angular);
    add(&PlainState::momentum, &Six::linear);
    add(&PlainState::stress, &Six::angular);
    add(&PlainState::stress, &Six::linear);
    return error_norm(squares, 12 * state_.stress.size());
}

void PlainDormandPrince::follow_surroundings(double step) {
    for (std::size_t k = 0; k < state_.momentum.size(); ++k) {
        if (!strand_.changes(k)) continue;
        strand_.advance_springs(step, k, k + 1);
        strand_.follow_arc(k);
        strand_.follow_fluid(k);
        strand_.nodes(trial_, rate_.back(), k, k + 1);
    }
    rate_.back().momentum[0] = {};
}

void PlainDormandPrince::advance(int steps) {
    while (steps > 0) {
        const double step = step_;
        for (std::size_t stage = 1; stage < Tableau::stages; ++stage) {
            combine(stage, step);
            evaluate(time_ + Tableau::c[stage] * step, trial_, rate_[stage]);
        }
        const double norm = error(step);
        step_ = step * step_factor(norm);
        ++attempts_;
        if (!(norm < 1.0)) continue;
        follow_surroundings(step);
        std::swap(state_, trial_);
        std::swap(rate_.front(), rate_.back());
        time_ += step;
        --steps;
    }
}

}  // namespace drillstrand::bench
