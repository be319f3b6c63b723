#include "statics/vibration_matrices.hpp"

#include <complex>
#include <limits>

#include "forces/annulus.hpp"
#include "forces/fluid.hpp"
#include "forces/surroundings.hpp"
#include "rod/report.hpp"
#include "statics/rod_segment.hpp"
#include "statics/skew.hpp"
#include "statics/well_section.hpp"

namespace drillstrand {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d along(const Vector3d& axis) {
    return axis * axis.transpose();
}

Matrix3d across(const Vector3d& axis) {
    return Matrix3d::Identity() - along(axis);
}

Matrix6 on_both(const Matrix3d& displacement, const Matrix3d& turn) {
    Matrix6 block = Matrix6::Zero();
    block.topLeftCorner<3, 3>() = displacement;
    block.bottomRightCorner<3, 3>() = turn;
    return block;
}

/// Loads without a potential leave K a little unsymmetric.
void symmetrise(BlockTridiagonal& matrix) {
    for (std::size_t k = 0; k < matrix.rows(); ++k) {
        matrix.diagonal[k] = 0.5 * (matrix.diagonal[k] + matrix.diagonal[k].transpose()).eval();
        if (k == 0) continue;
        matrix.upper[k - 1] = 0.5 * (matrix.upper[k - 1] + matrix.lower[k].transpose()).eval();
        matrix.lower[k] = matrix.upper[k - 1].transpose();
    }
}

/// A segment between its nodes as it would be straight and without stress.
RodSegment straightened(const Scene& scene, const RodState& state, std::size_t k,
                        SectionProperties& section) {
    section = scene.mesh.segment[k];
    section.curvature.setZero();
    const Vector3d e = (state.position[k + 1] - state.position[k]).normalized();
    const Vector3d d1 = across(e) * state.material[k];
    const double h = scene.mesh.length[k];
    return {h, &section, {Vector3d::Zero(), e, d1.normalized()}, {h * e, e, d1.normalized()}, 0};
}

/// Fills the matrices of one string.
class Assembly {
  public:
    Assembly(const Scene& scene, Balance& balance, const RodState& state)
        : scene_(scene),
          balance_(balance),
          state_(state),
          surroundings_(scene),
          wall_(surroundings_.wall_at(state.position)),
          first_(first_moving_node(scene)) {}

    [[nodiscard]] VibrationMatrices matrices(WallGrip grip) {
        const std::size_t rows = state_.position.size() - first_;
        VibrationMatrices result(rows);
        balance_.hold_friction(state_);
        balance_.stiffness(state_, result.stiffness);
        symmetrise(result.stiffness);
        for (std::size_t k = 0; k < rows; ++k) {
            result.mass[k] = mass(first_ + k);
            result.gyroscopic[k] = gyroscopic(first_ + k);
            result.damping.diagonal[k] = outer_damping(first_ + k);
        }
        add_walls(result);
        if (grip == WallGrip::sticks) add_friction_springs(result.stiffness);
        if (scene_.damping.kelvin_voigt > 0) add_inner_damping(result);
        if (first_ == 0) pin_head(result);
        return result;
    }

  private:
    /// The fluid that goes along sideways, and the rotary inertias of the sections.
    [[nodiscard]] Matrix6 mass(std::size_t node) const {
        const SectionProperties& section = scene_.mesh.node[node];
        const Vector3d& t = state_.director[node];
        const double sideways = section.mass + fluid_mass_at(wall_, node);
        return scene_.mesh.cell[node] *
               on_both(sideways * across(t) + section.mass * along(t),
                       section.inertia * across(t) + section.polar_inertia * along(t));
    }

    [[nodiscard]] Matrix6 gyroscopic(std::size_t node) const {
        const double spin_inertia = scene_.mesh.cell[node] * scene_.mesh.node[node].polar_inertia;
        return on_both(Matrix3d::Zero(), -spin_inertia * skew(state_.director[node]));
    }

    [[nodiscard]] const WellArc& arc_at(std::size_t node) const {
        return scene_.well->arcs()[static_cast<std::size_t>(wall_.row(WallRow::arc)[node])];
    }

    [[nodiscard]] WellSection section_at(std::size_t node) const {
        return well_section(state_.position[node], arc_at(node));
    }

    /// The walls' springs as `stiffness` has them, and those it lacks.
    void add_walls(VibrationMatrices& matrices) {
        matrices.walls.assign(state_.position.size(), Matrix6::Zero());
        matrices.pressing.assign(state_.position.size(), 0.0);
        if (!scene_.well) return;
        const std::vector<WallReport> walls = balance_.walls(state_);
        for (std::size_t node = 1; node < state_.position.size(); ++node) {
            matrices.walls[node] = balance_.wall_stiffness(state_, node);
            matrices.pressing[node] = scene_.mesh.cell[node] * walls[node].normal;
            if (is_held_all_around(node)) hold_all_around(matrices, node);
        }
    }

    [[nodiscard]] bool is_held_all_around(std::size_t node) const {
        const WellArc& arc = arc_at(node);
        return along_arc(section_at(node).frame, arc.radius, arc.widening).value <=
               scene_.mesh.node[node].outer_radius;
    }

    /// Exactly on the axis, the direction toward it is none, on which the wall's tangent is built.
    void hold_all_around(VibrationMatrices& matrices, std::size_t node) const {
        matrices.pressing[node] = std::numeric_limits<double>::infinity();
        const WellSection s = section_at(node);
        if (s.eccentricity > 0) return;
        const WellArc& arc = arc_at(node);
        const double stiffness = along_arc(s.frame, arc.firmness, arc.firming).value *
                                 scene_.normal_stiffness[node] * scene_.mesh.cell[node];
        const Matrix6 spring = on_both(stiffness * across(s.l), Matrix3d::Zero());
        matrices.walls[node] += spring;
        matrices.stiffness.diagonal[node - first_] += spring;
    }

    /// The case's external damping, and mud that creeps.
    [[nodiscard]] Matrix6 outer_damping(std::size_t node) const {
        const DampingPair& external = scene_.damping.external;
        Matrix6 damping = on_both(external.translation * Matrix3d::Identity(),
                                  external.rotation * Matrix3d::Identity());
        if (scene_.features.drag && scene_.fluid->is_newtonian()) damping += creeping_drag(node);
        return scene_.mesh.cell[node] * damping;
    }

    [[nodiscard]] Matrix6 creeping_drag(std::size_t node) const {
        const WellSection s = section_at(node);
        const FluidCase& fluid = *scene_.fluid;
        const double hole = along_arc(s.frame, arc_at(node).radius, arc_at(node).widening).value;
        const double pipe = flow_radius(scene_.mesh.node[node].flow_radius, hole);
        const Annulus annulus(film_eccentricity(s.eccentricity, pipe, hole, fluid.film), pipe,
                              hole);
        const DragCoefficients drag =
            around_wall(scaled(drag_coefficients(annulus), fluid.viscosity), s.eccentricity, pipe,
                        hole, fluid.film, fluid.contact_drag ? 1.0 : 0.0);
        return on_both(drag.around * across(s.l) + (drag.radial - drag.around) * along(s.r) +
                           drag.axial * along(s.l),
                       drag.spin * along(state_.director[node]));
    }

    /// A point of the surface that sticks, along the well and around it.
    void add_friction_springs(BlockTridiagonal& stiffness) {
        if (!scene_.well) return;
        const std::vector<WallReport> walls = balance_.walls(state_);
        for (std::size_t node = first_; node < walls.size(); ++node) {
            if (walls[node].normal == 0) continue;
            const WellSection s = section_at(node);
            const FrictionCoefficients& friction =
                scene_.section_friction[arc_at(node).section].fixed;
            const double spring = scene_.contact.tangential_stiffness * scene_.mesh.cell[node];
            Vector6 axial, around;
            axial << s.l, Vector3d::Zero();
            around << s.t, scene_.mesh.node[node].outer_radius * state_.director[node];
            Matrix6& block = stiffness.diagonal[node - first_];
            if (friction.axial > 0) block += spring * axial * axial.transpose();
            if (friction.azimuthal > 0) block += spring * around * around.transpose();
        }
    }

    /// Kelvin-Voigt: the stiffness of straight segments times tau, on the rates that the turning
    /// sections see.
    void add_inner_damping(VibrationMatrices& matrices) const {
        for (std::size_t k = 0; k + 1 < state_.position.size(); ++k) {
            SectionProperties section;
            const RodSegment segment = straightened(scene_, state_, k, section);
            const double tau = scene_.damping.kelvin_voigt;
            SegmentTangent d = segment_tangent(segment);
            for (Matrix6* block : {&d.aa, &d.ab, &d.ba, &d.bb})
                *block *= -tau;
            add_segment(matrices.damping, d, k);
            const Matrix3d quarter = skew(segment.a.director);
            const Matrix6 turned = on_both(quarter, quarter);
            for (Matrix6* block : {&d.aa, &d.ab, &d.ba, &d.bb})
                *block *= turned;
            add_segment(matrices.carried_round, d, k);
        }
    }

    void add_segment(BlockTridiagonal& matrix, const SegmentTangent& d, std::size_t k) const {
        const std::size_t b = k + 1 - first_;
        matrix.diagonal[b] += d.bb;
        if (k < first_) return;
        matrix.diagonal[b - 1] += d.aa;
        matrix.upper[b - 1] += d.ab;
        matrix.lower[b] += d.ba;
    }

    /// A pinned head moves by its tilt alone.
    void pin_head(VibrationMatrices& matrices) const {
        const Matrix6 tilt = on_both(Matrix3d::Zero(), across(state_.director.front()));
        for (Matrix6* block : {&matrices.mass.front(), &matrices.gyroscopic.front()})
            *block = (tilt * *block * tilt).eval();
        for (BlockTridiagonal* matrix : {&matrices.damping, &matrices.carried_round}) {
            matrix->diagonal[0] = (tilt * matrix->diagonal[0] * tilt).eval();
            matrix->upper[0] = (tilt * matrix->upper[0]).eval();
            matrix->lower[1] = (matrix->lower[1] * tilt).eval();
        }
    }

    const Scene& scene_;
    Balance& balance_;
    const RodState& state_;
    Surroundings surroundings_;
    Table<WallRow> wall_;
    std::size_t first_;
};

}  // namespace

ComplexBlockTridiagonal VibrationMatrices::dynamic_stiffness(double frequency,
                                                             double rotation_rate) const {
    const std::complex<double> velocity(0, frequency);
    ComplexBlockTridiagonal result(rows());
    const auto sum = [&](const Matrix6& k, const Matrix6& c, const Matrix6& s) {
        return Block<std::complex<double>>(k.cast<std::complex<double>>() +
                                           velocity * c.cast<std::complex<double>>() -
                                           rotation_rate * s);
    };
    for (std::size_t k = 0; k < rows(); ++k) {
        result.diagonal[k] =
            sum(stiffness.diagonal[k] - frequency * frequency * mass[k],
                damping.diagonal[k] + rotation_rate * gyroscopic[k], carried_round.diagonal[k]);
        result.upper[k] = sum(stiffness.upper[k], damping.upper[k], carried_round.upper[k]);
        result.lower[k] = sum(stiffness.lower[k], damping.lower[k], carried_round.lower[k]);
    }
    return result;
}

VibrationMatrices vibration_matrices(const Scene& scene, Balance& balance, const RodState& state,
                                     WallGrip grip) {
    return Assembly(scene, balance, state).matrices(grip);
}

}  // namespace drillstrand
