/// The string along its arc length: stretches of constant properties, and places of its own.
#pragma once

#include <optional>
#include <vector>

#include "drillstrand/drill_string.hpp"

namespace drillstrand {

/// What touches the wall at a place, with a radius other than its surroundings'.
struct TouchingPlace {
    double s = 0;       ///< m
    double radius = 0;  ///< m
    /// Of the wall that it touches (N/m), where that is not the cell's.
    std::optional<ContactPoint> contact;
};

struct Kink {
    double s = 0;  ///< m
    double angle = 0;
    double toolface = 0;
};

struct EccentricPlace {
    double s = 0;       ///< m
    double moment = 0;  ///< kg m
};

struct JarPlace {
    double s = 0;  ///< m
    JarCase law;
};

/// The string as stretches of constant properties along the arc length, from 0 to its length.
struct StringLayout {
    explicit StringLayout(const StringCase& string);

    std::vector<double> boundary;             ///< one more than stretches (m)
    std::vector<SectionProperties> property;  ///< of each stretch
    std::vector<double> joint_radius;         ///< of the component's tool joints, or 0 (m)
    std::vector<double> component_boundary;   ///< one more than components (m)
    std::vector<TouchingPlace> places;        ///< tool joints and contact points, ascending
    std::vector<Kink> kinks;                  ///< ascending
    std::vector<EccentricPlace> eccentric;    ///< ascending
    std::optional<JarPlace> jar;

    [[nodiscard]] double length() const { return boundary.back(); }

  private:
    void add(double length, const SectionProperties& section, double radius_of_joints);
    void add_pipe(const Component& component, double shear_coefficient);
};

/// Places that differ by less than this part of the length of the string are one.
inline constexpr double place_rounding = 1e-9;

/// Pieces of a pipe with tool joints: as many as its length has room for, at least one.
int pieces_of(const Component& component);

/// The pipe between tool joints, and the joints: linear densities that give that of the component.
/// Throws std::invalid_argument where the joints would weigh as much as the pipe.
Component pipe_body(const Component& component);
Component tool_joint(const Component& component);

}  // namespace drillstrand
