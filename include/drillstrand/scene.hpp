/// A scene: everything a run needs to know and never changes, laid out for the step loop.
///
/// One line per array: name, meaning, unit, where it lives. Node k joins segments k-1 and k;
/// segment k joins nodes k and k+1. Arrays are padded to whole blocks (numerics/block_array.hpp);
/// padding holds harmless values, so that kernels run over whole blocks.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "drillstrand/block_array.hpp"
#include "drillstrand/case.hpp"
#include "drillstrand/drill_string.hpp"
#include "drillstrand/well.hpp"

namespace drillstrand {

/// Which physics the scene names; decided once, before the first step.
struct SceneFeatures {
    bool well = false;      ///< contact, friction
    bool drag = false;      ///< annular fluid drag
    bool friction = false;  ///< any friction coefficient above zero
    bool damping = false;   ///< the paper's D_in or D_ex
};

/// Per-segment constants of the rod.
struct SegmentArrays {
    BlockArray length;     ///< h (m)
    BlockArray torsion;    ///< GJ (N m2)
    BlockArray bending;    ///< EI (N m2)
    BlockArray axial;      ///< EA (N)
    BlockArray shear;      ///< k G A (N)
    BlockArray twist0;     ///< stress-free k3 (1/m)
    BlockArray bending10;  ///< stress-free k1 (1/m)
    BlockArray bending20;  ///< stress-free k2 (1/m)
};

/// Per-node constants of the rod and of its surroundings.
struct NodeArrays {
    BlockArray cell;            ///< length of the node's cell (m)
    BlockArray mass;            ///< m (kg/m)
    BlockArray inertia;         ///< rho I, with the segment inertia where it is on (kg m)
    BlockArray polar_inertia;   ///< rho Ip (kg m)
    BlockArray weight;          ///< buoyed weight (N/m)
    BlockArray radius;          ///< outer radius of the pipe (m)
    BlockArray normal_damping;  ///< eta_el (Pa s)
};

struct Scene {
    int segments = 0;  ///< N
    StringMesh mesh;
    SegmentArrays segment;
    NodeArrays node;
    SceneFeatures features;
    std::optional<Well> well;
    std::optional<FluidCase> fluid;
    ContactCase contact;
    DampingCase damping;
    HeadCase head;
    BitCase bit;
    double bit_radius = 0;          ///< outer radius of the last component (m)
    Eigen::Vector3d down{0, 0, 1};  ///< direction of gravity
    bool segment_inertia = false;

    /// Initial pose of the head: d3, d1, d2 in the columns.
    Eigen::Matrix3d head_frame = Eigen::Matrix3d::Identity();
    Eigen::Vector3d head_position = Eigen::Vector3d::Zero();
    /// Initial strains of the segments, (k3, k1, k2, g3, g1, g2); the string starts at rest.
    std::vector<Eigen::Matrix<double, 6, 1>> initial_strain;
};

/// Builds the scene of a case. Throws InputError where string, well and mesh do not go together.
Scene build_scene(const Case& input);

}  // namespace drillstrand
