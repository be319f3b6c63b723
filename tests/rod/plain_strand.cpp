#include "rod/plain_strand.hpp"

#include <Eigen/Geometry>
#include <unsupported/Eigen/MatrixFunctions>

namespace drillstrand::test {

namespace {

using Eigen::Vector3d;

Eigen::Matrix3d cross_matrix(const Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

Vector6 joined(const Vector3d& angular, const Vector3d& linear) {
    Vector6 v;
    v << angular, linear;
    return v;
}

Vector6 stiffness(const Scene& scene, std::size_t segment) {
    const SectionProperties& s = scene.mesh.segment[segment];
    Vector6 a;
    a << s.torsional_stiffness, s.bending_stiffness, s.bending_stiffness, s.axial_stiffness,
        s.shear_stiffness, s.shear_stiffness;
    return a;
}

Vector6 strain(const Scene& scene, std::size_t segment, const Vector6& stress) {
    return plain_strain_change(scene, segment, stress) +
           joined(scene.mesh.segment[segment].curvature, Vector3d::UnitX());
}

/// (k x m + g x n, k x n).
Vector6 internal_product(const Vector6& strain, const Vector6& stress) {
    const Vector3d k = strain.head<3>();
    const Vector3d g = strain.tail<3>();
    const Vector3d m = stress.head<3>();
    const Vector3d n = stress.tail<3>();
    return joined(k.cross(m) + g.cross(n), k.cross(n));
}

}  // namespace

Vector6 plain_velocity(const Scene& scene, std::size_t node, const Vector6& momentum) {
    const SectionProperties& s = scene.mesh.node[node];
    Vector6 inertia;
    inertia << s.polar_inertia, scene.inertia[node], scene.inertia[node], s.mass, s.mass, s.mass;
    return momentum.cwiseQuotient(inertia);
}

Vector6 plain_strain_change(const Scene& scene, std::size_t segment, const Vector6& stress) {
    return stress.cwiseQuotient(stiffness(scene, segment));
}

std::vector<Pose> plain_poses(const Scene& scene, const Pose& head,
                              const std::vector<Vector6>& stress) {
    std::vector<Pose> poses{head};
    for (std::size_t k = 0; k < stress.size(); ++k) {
        const Vector6 u = strain(scene, k, stress[k]);
        Eigen::Matrix4d screw = Eigen::Matrix4d::Zero();
        screw.topLeftCorner<3, 3>() = cross_matrix(u.head<3>());
        screw.topRightCorner<3, 1>() = u.tail<3>();
        const Eigen::Matrix4d turned = scene.mesh.length[k] * screw;
        const Eigen::Matrix4d step = turned.exp();
        const Pose& last = poses.back();
        poses.push_back({last.frame * step.topLeftCorner<3, 3>(),
                         last.position + last.frame * step.topRightCorner<3, 1>()});
    }
    return poses;
}

PlainRates plain_rates(const Scene& scene, const Pose& head, const PlainState& state,
                       const EndStress& ends) {
    const std::size_t segments = state.stress.size();
    PlainRates result;
    const std::vector<Pose> poses = plain_poses(scene, head, state.stress);

    // compatibility: k' = w' + k x w, g' = v' + k x v + g x w
    std::vector<Vector6> strain_rate;
    for (std::size_t j = 0; j < segments; ++j) {
        const Vector6 v_a = plain_velocity(scene, j, state.momentum[j]);
        const Vector6 v_b = plain_velocity(scene, j + 1, state.momentum[j + 1]);
        const Vector6 mean = (v_a + v_b) / 2;
        const Vector6 u = strain(scene, j, state.stress[j]);
        const Vector3d k = u.head<3>();
        const Vector3d g = u.tail<3>();
        const Vector3d w = mean.head<3>();
        const Vector3d v = mean.tail<3>();
        strain_rate.emplace_back((v_b - v_a) / scene.mesh.length[j] +
                                 joined(k.cross(w), k.cross(v) + g.cross(w)));
        result.rate.stress.emplace_back(stiffness(scene, j).cwiseProduct(strain_rate.back()));
    }

    for (std::size_t i = 0; i <= segments; ++i) {
        const double cell = scene.mesh.cell[i];
        const Vector6 before = i > 0 ? state.stress[i - 1] : ends.head;
        const Vector6 after = i < segments ? state.stress[i] : ends.bit;
        // each neighbour's product over its half of the cell
        Vector6 product = Vector6::Zero();
        Vector6 neighbours_strain_rate = Vector6::Zero();
        const auto add_neighbour = [&](std::size_t j) {
            const double share = scene.mesh.length[j] / 2 / cell;
            product += share * internal_product(strain(scene, j, state.stress[j]), state.stress[j]);
            neighbours_strain_rate += share * strain_rate[j];
        };
        if (i > 0) add_neighbour(i - 1);
        if (i < segments) add_neighbour(i);

        const Vector6 velocity = plain_velocity(scene, i, state.momentum[i]);
        const Vector3d w = velocity.head<3>();
        const Vector3d pi = state.momentum[i].head<3>();
        const Vector3d p = state.momentum[i].tail<3>();
        const Vector3d v = velocity.tail<3>();
        const Vector6 inertial = joined(pi.cross(w) + p.cross(v), p.cross(w));
        const Vector6 weight =
            joined(Vector3d::Zero(), scene.weight[i] * (poses[i].frame.transpose() * scene.down));
        const DampingPair& external = scene.damping.external;
        const DampingPair& internal = scene.damping.internal;
        const Vector6 damping = -joined(external.rotation * w, external.translation * v) -
                                joined(internal.rotation * neighbours_strain_rate.head<3>(),
                                       internal.translation * neighbours_strain_rate.tail<3>());
        result.rate.momentum.emplace_back((after - before) / cell + product + inertial + weight +
                                          damping);
        if (i > 0 || scene.head.motion == HeadMotion::free) {
            result.damping_power += cell * damping.dot(velocity);
        }
    }
    return result;
}

}  // namespace drillstrand::test
