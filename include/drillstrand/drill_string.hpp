/// The string: pipe components, and their properties mapped to the mesh.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "drillstrand/case.hpp"

namespace drillstrand {

/// What a pipe with tool joints is made of where it does not say (kg/m3).
inline constexpr double steel_density = 7850;

/// The loads of which each alone brings the outer fibre of a pipe to yield (von Mises). Infinite
/// where a component gives no diameters.
struct YieldLoads {
    double axial = std::numeric_limits<double>::infinity();    ///< N
    double bending = std::numeric_limits<double>::infinity();  ///< N m
    double torsion = std::numeric_limits<double>::infinity();  ///< N m
};

/// What the rod needs to know of a cross section.
struct SectionProperties {
    double mass = 0;                 ///< kg/m
    double inertia = 0;              ///< rho I about a diameter (kg m)
    double polar_inertia = 0;        ///< rho Ip about the axis (kg m)
    double axial_stiffness = 0;      ///< EA (N)
    double shear_stiffness = 0;      ///< k G A (N)
    double bending_stiffness = 0;    ///< E I (N m2)
    double torsional_stiffness = 0;  ///< G J (N m2)
    double metal_area = 0;           ///< m2
    double outer_area = 0;           ///< area of the outer circle (m2)
    /// I/r of the outer fibre (m3), of a segment that of its weakest pipe; infinite without
    /// diameters
    double section_modulus = std::numeric_limits<double>::infinity();
    double outer_radius = 0;  ///< m; of a node, the radius that touches the wall
    double flow_radius = 0;   ///< m; of a node, the pipe around which mud flows
    Eigen::Vector3d curvature = Eigen::Vector3d::Zero();  ///< stress-free twist, bend1, bend2 (1/m)
    YieldLoads yield;
};

/// Properties of a pipe, G = E / (2 (1 + nu)), rho I = m I / A, polar ones twice those about a
/// diameter; each value the component gives outright replaces the computed one (a given inertia
/// also sets the polar one, unless that is given too). Where the density of the material is known,
/// what the pipe displaces follows from its mass. Of a pipe with tool joints: between them, but for
/// mass and areas, which are means with them.
SectionProperties section_properties(const Component& component, double shear_coefficient);

/// How the string is lumped at the nodes of its mesh, which carry mass, weight and contact.
enum class Lumping {
    cells,               ///< each node has its cell of the string: of second order, the paper's
    cubic_clamped_head,  ///< as cubics between the nodes do: of fourth order
    cubic_free_head      ///< the same where the head is free to move and to turn
};

/// The string on a mesh of N segments. What nodes have of the string is given per length of their
/// cells, and its sums are exact. With Lumping::cells they are means from the middle of one segment
/// to the middle of the next; how cubics lump tells engine/model/README.md. Compliances of a
/// segment are means over it, so that uniform stress gives the exact stretch, twist and turn; its
/// yield loads are those of its weakest part.
struct StringMesh {
    /// A node that stands for a contact point.
    struct Contact {
        std::size_t node;
        ContactPoint point;
    };

    /// The segment in which a jar slides.
    struct Jar {
        std::size_t segment;
        JarCase law;
    };

    std::vector<double> node_s;     ///< N+1, arc length from the head (m)
    std::vector<double> segment_s;  ///< N, middle of the segment (m)
    std::vector<double> length;     ///< N, of the segment (m)
    std::vector<double> cell;  ///< N+1, length whose loads the node carries (m): h inside; at an
                               ///< end h/2, or of cubics 5/12 h where it is free, with 13/12 h next
    std::vector<SectionProperties> segment;  ///< N: stiffnesses and curvature are the ones to use
    std::vector<SectionProperties> node;     ///< N+1: mass, inertias, areas; radii at the node
    std::vector<Contact> contact;            ///< ascending
    /// N+1, whether the node touches the wall with a tool joint or a contact point: the pipe beside
    /// it then need not touch
    std::vector<bool> touches_at_a_point;
    std::vector<double> lost;       ///< contact points without a node (m), ascending
    std::vector<double> unbalance;  ///< N+1, eccentric mass times distance (kg m); empty: none
    std::optional<Jar> jar;

    /// The segment that holds a place along the string (m).
    [[nodiscard]] std::size_t segment_at(double s) const;
};

/// The string on a mesh of at least one segment (engine/model/README.md, "Mesh"). Outer radii are
/// those of the component at the node or at the middle of the segment: the larger where two meet,
/// the last component's at the bit; those of tool joints and contact points where a node is at one,
/// and on a mesh of one length those of tool joints wherever the pipe has any. Throws
/// std::invalid_argument where string and mesh do not go together.
StringMesh mesh_string(const StringCase& string, const MeshCase& mesh, Lumping lumping);

/// The largest radius with which a component touches the wall: of its tool joints, or its own (m).
/// Contact points are not counted.
double touching_radius(const Component& component);

}  // namespace drillstrand
