/// Loads of a string lumped at its nodes as the cubics through them do.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "drillstrand/drill_string.hpp"

namespace drillstrand {

/// What a node has of the string around it.
inline constexpr std::array lumped_properties{
    &SectionProperties::mass, &SectionProperties::inertia, &SectionProperties::polar_inertia,
    &SectionProperties::metal_area, &SectionProperties::outer_area};

/// Running mean. Equal values give exactly that value, whatever their weights.
template <typename Value>
void add_to_mean(Value& mean, const Value& value, double share) {
    mean += (value - mean) * share;
}

/// Lumps the string at its nodes as the cubics through them do, whose slopes are differences of the
/// nodes' own places: engine/model/README.md, "Lumping".
class CubicLumping {
  public:
    /// `length` of the segments (m).
    CubicLumping(const std::vector<double>& length, bool head_is_free);

    /// A stretch of uniform properties, between two fractions of a segment.
    void add(std::size_t segment, const SectionProperties& part, double from, double to);

    /// Cells (m), and what is lumped, per length of the cell, of the nodes of a mesh.
    void lump(std::vector<double>& cells, std::vector<SectionProperties>& nodes) const;

  private:
    using Property = double SectionProperties::*;

    struct Node {
        double weight = 0;  ///< m
        SectionProperties mean;
        const SectionProperties* reference = nullptr;
        SectionProperties couple;  ///< of what differs from the reference (m2 times it)

        void add(const SectionProperties& part, double share);
        void add_couple(const SectionProperties& part, double share);
    };

    /// What a couple of 1 on a node that is no end does to the node before, itself and the node
    /// after (1/m): as the slope there is a difference of their places.
    struct Shares {
        double before, own, after;
    };
    [[nodiscard]] Shares shares(std::size_t node) const;
    [[nodiscard]] double moved_part(std::size_t node, double couple, double before, double own,
                                    double after) const;

    std::vector<double> length_;
    std::vector<Node> node_;
    bool head_is_free_;
};

}  // namespace drillstrand
