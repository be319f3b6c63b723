#include "statics/forced_response.hpp"

#include <Eigen/Geometry>

namespace drillstrand {

namespace {

using Complex = std::complex<double>;
using Eigen::Vector3cd;
using Eigen::Vector3d;

/// Loads on the nodes that move. An eccentric mass pulls by U W^2 (d1 cos W t + d2 sin W t).
ComplexMotion load_of(const ShakenString& string, const Excitation& excitation,
                      double rotation_rate) {
    const RodState& state = string.state;
    const std::size_t rows = string.matrices.rows();
    const std::size_t first = state.position.size() - rows;
    ComplexMotion load(rows, ComplexMotion::value_type::Zero());
    const std::vector<double>& unbalance = string.scene.mesh.unbalance;
    for (std::size_t k = 0; excitation.unbalance && k < rows && !unbalance.empty(); ++k) {
        const Vector3d& d1 = state.material[first + k];
        const Vector3d d2 = state.director[first + k].cross(d1);
        const double pull = unbalance[first + k] * rotation_rate * rotation_rate;
        load[k].head<3>() += pull * (d1.cast<Complex>() - Complex(0, 1) * d2);
    }
    const Vector3d& axis = state.director.back();
    load.back().head<3>() += excitation.bit_force * axis;
    load.back().tail<3>() += excitation.bit_torque * axis;
    return load;
}

void add_node(const ShakenString& string, const ComplexMotion& motion, std::size_t node,
              ForcedResponse& response) {
    const std::size_t first = string.state.position.size() - motion.size();
    if (node < first) {
        response.displacement.push_back(0);
        response.twist.push_back(0);
        response.side_force.push_back(0);
        return;
    }
    const ComplexMotion::value_type& q = motion[node - first];
    const Vector3cd push = (string.matrices.walls[node] * q).head<3>();
    response.displacement.push_back(largest_of_period(q.head<3>()));
    response.twist.push_back(std::abs((string.state.director[node].transpose() * q.tail<3>())(0)));
    response.side_force.push_back(largest_of_period(push));
    if (response.side_force.back() > string.matrices.pressing[node]) response.lifts_off = 1;
}

void add_segment(const ShakenString& string, const ComplexMotion& motion, std::size_t k,
                 ForcedResponse& response) {
    const SectionProperties& section = string.scene.mesh.segment[k];
    const SegmentStrainAmplitude strain = strain_amplitude(string.scene, string.state, motion, k);
    response.bending_moment.push_back(section.bending_stiffness *
                                      largest_of_period(strain.bending));
    response.torque.push_back(section.torsional_stiffness * std::abs(strain.twist));
    response.axial_force.push_back(section.axial_stiffness * std::abs(strain.stretch));
}

}  // namespace

ForcedResponse forced_response(const ShakenString& string, const Excitation& excitation,
                               double rotation_rate) {
    ForcedResponse response;
    response.rotation_rate = rotation_rate;
    response.frequency = excitation.order * rotation_rate;
    const ComplexMotion motion =
        ComplexBlockFactors(string.matrices.dynamic_stiffness(response.frequency, rotation_rate))
            .solve(load_of(string, excitation, rotation_rate));
    for (std::size_t node = 0; node < string.state.position.size(); ++node)
        add_node(string, motion, node, response);
    for (std::size_t k = 0; k < string.state.twist.size(); ++k)
        add_segment(string, motion, k, response);
    return response;
}

}  // namespace drillstrand
