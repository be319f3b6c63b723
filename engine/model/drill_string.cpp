#include "drillstrand/drill_string.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace drillstrand {

SectionProperties section_properties(const Component& component, double shear_coefficient) {
    constexpr double pi = std::numbers::pi;
    const double outer2 = component.outer_diameter * component.outer_diameter;
    const double inner2 = component.inner_diameter * component.inner_diameter;
    const double area = pi / 4 * (outer2 - inner2);
    const double gyration2 = (outer2 + inner2) / 16;  // second moment of area / area
    const double shear_modulus = component.youngs_modulus / (2 * (1 + component.poisson_ratio));

    SectionProperties section;
    section.mass = component.linear_density;
    section.inertia = component.inertia.value_or(section.mass * gyration2);
    section.polar_inertia = component.polar_inertia.value_or(2 * section.inertia);
    section.axial_stiffness = component.axial_stiffness.value_or(component.youngs_modulus * area);
    section.shear_stiffness =
        component.shear_stiffness.value_or(shear_coefficient * shear_modulus * area);
    section.bending_stiffness =
        component.bending_stiffness.value_or(component.youngs_modulus * area * gyration2);
    section.torsional_stiffness =
        component.torsional_stiffness.value_or(shear_modulus * area * 2 * gyration2);
    section.metal_area = area;
    section.outer_area = pi / 4 * outer2;
    section.outer_radius = component.outer_diameter / 2;
    section.curvature = component.curvature;
    if (section.outer_radius > 0) {
        const double section_modulus = area * gyration2 / section.outer_radius;
        section.yield = {component.yield_strength * area,
                         component.yield_strength * section_modulus,
                         component.yield_strength * 2 * section_modulus / std::numbers::sqrt3};
    }
    return section;
}

namespace {

/// The string as stretches of constant properties along the arc length.
struct Stretches {
    std::vector<double> boundary;             ///< one more than stretches, from 0 to the length (m)
    std::vector<SectionProperties> property;  ///< of each stretch
};

Stretches stretches_of(const StringCase& string) {
    Stretches stretches;
    stretches.boundary.push_back(0.0);
    for (const Component& component : string.components) {
        stretches.boundary.push_back(stretches.boundary.back() + component.length);
        stretches.property.push_back(section_properties(component, string.shear_coefficient));
    }
    return stretches;
}

/// What a node has of the string around it.
constexpr std::array lumped{&SectionProperties::mass, &SectionProperties::inertia,
                            &SectionProperties::polar_inertia, &SectionProperties::metal_area,
                            &SectionProperties::outer_area};

constexpr std::array stiffnesses{
    &SectionProperties::axial_stiffness, &SectionProperties::shear_stiffness,
    &SectionProperties::bending_stiffness, &SectionProperties::torsional_stiffness};

constexpr std::array yield_loads{&YieldLoads::axial, &YieldLoads::bending, &YieldLoads::torsion};

/// Running mean. Equal values give exactly that value, whatever their weights.
template <typename Value>
void add_to_mean(Value& mean, const Value& value, double share) {
    mean += (value - mean) * share;
}

/// Walks down the string's stretches with places that never go up again.
class Walk {
  public:
    explicit Walk(const Stretches& stretches) : stretches_(stretches) {}

    /// Calls visit(properties, begin, end) for each stretch between two places (m).
    template <class Visit>
    void over(double from, double to, const Visit& visit) {
        go_to(from);
        for (std::size_t i = here_; i < stretches_.property.size() && stretches_.boundary[i] < to;
             ++i) {
            const double begin = std::max(from, stretches_.boundary[i]);
            const double end = std::min(to, stretches_.boundary[i + 1]);
            if (end > begin) visit(stretches_.property[i], begin, end);
        }
    }

    /// Means from one place to another: arithmetic for what adds up along the string (mass, area,
    /// stress-free curvature), harmonic for stiffnesses, whose compliances add up, the least of
    /// yield loads. The radius is left out: it is a property of a point.
    SectionProperties mean_over(double from, double to) {
        // Compliances are counted relative to the first stiffness met, so that no digit is lost
        // where all are equal.
        const SectionProperties* first = nullptr;
        SectionProperties mean;
        SectionProperties compliance;
        double covered = 0;
        over(from, to, [&](const SectionProperties& part, double begin, double end) {
            if (!first) first = &part;
            covered += end - begin;
            const double share = (end - begin) / covered;
            for (const auto property : lumped)
                add_to_mean(mean.*property, part.*property, share);
            add_to_mean<Eigen::Vector3d>(mean.curvature, part.curvature, share);
            for (const auto load : yield_loads)
                mean.yield.*load = std::min(mean.yield.*load, part.yield.*load);
            for (const auto stiffness : stiffnesses)
                add_to_mean(compliance.*stiffness, first->*stiffness / part.*stiffness, share);
        });
        for (const auto stiffness : stiffnesses)
            mean.*stiffness = first->*stiffness / compliance.*stiffness;
        return mean;
    }

    /// Outer radius at a point; the larger of the two at a joint, the last component's at the bit.
    double radius_at(double s) {
        const double length = stretches_.boundary.back();
        const double rounding = 1e-12 * length;
        if (s >= length - rounding) return stretches_.property.back().outer_radius;
        go_to(s - rounding);
        double radius = 0;
        for (std::size_t i = here_;
             i < stretches_.property.size() && stretches_.boundary[i] <= s + rounding; ++i)
            radius = std::max(radius, stretches_.property[i].outer_radius);
        return radius;
    }

  private:
    /// The first stretch that does not end above.
    void go_to(double s) {
        while (here_ + 1 < stretches_.property.size() && stretches_.boundary[here_ + 1] < s)
            ++here_;
    }

    const Stretches& stretches_;
    std::size_t here_ = 0;
};

/// Integrals, from its start to the fraction x of its length, of the cubics on a segment that have
/// the value 1 or the slope 1 (per length of the segment) at one of its ends and are 0 otherwise.
struct CubicIntegrals {
    double first, first_slope;
    double last, last_slope;

    explicit CubicIntegrals(double x)
        : first(x - x * x * x * (1 - x / 2)),
          first_slope(x * x * (0.5 - x * (2.0 / 3 - x / 4))),
          last(x * x * x * (1 - x / 2)),
          last_slope(x * x * x * (x / 4 - 1.0 / 3)) {}
    CubicIntegrals(double from, double to) : CubicIntegrals(to) {
        const CubicIntegrals before(from);
        first -= before.first;
        first_slope -= before.first_slope;
        last -= before.last;
        last_slope -= before.last_slope;
    }
};

/// Lumps the string at its nodes as the cubics through them do, whose slopes are differences of the
/// nodes' own places: engine/model/README.md, "Lumping".
class CubicLumping {
  public:
    CubicLumping(std::size_t segments, bool head_is_free)
        : node_(segments + 1), head_is_free_(head_is_free) {}

    /// A stretch of uniform properties, between two fractions of a segment.
    void add(std::size_t segment, const SectionProperties& part, double from, double to) {
        CubicIntegrals weight(from, to);
        const bool first_is_end = segment == 0;
        const bool last_is_end = segment + 2 == node_.size();
        double turned = 0;  // load that slopes at an end move from the first to the last node
        if (first_is_end && head_is_free_) turned += weight.first_slope;
        if (last_is_end) turned += weight.last_slope;
        node_[segment].add(part, weight.first - turned);
        node_[segment + 1].add(part, weight.last + turned);
        if (!first_is_end) node_[segment].add_couple(part, weight.first_slope);
        if (!last_is_end) node_[segment + 1].add_couple(part, weight.last_slope);
    }

    /// Sets what is lumped, per length of the cell, of the nodes of a mesh.
    void lump(std::vector<SectionProperties>& nodes) const {
        for (const auto property : lumped) {
            for (std::size_t k = 0; k < nodes.size(); ++k)
                nodes[k].*property = node_[k].mean.*property;
            for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
                const double moved = shift(k, property);
                nodes[k - 1].*property -= moved / node_[k - 1].weight;
                nodes[k + 1].*property += moved / node_[k + 1].weight;
            }
        }
    }

  private:
    using Property = double SectionProperties::*;

    struct Node {
        double weight = 0;  ///< in lengths of a segment
        SectionProperties mean;
        const SectionProperties* reference = nullptr;
        SectionProperties couple;  ///< of what differs from the reference

        void add(const SectionProperties& part, double share) {
            weight += share;
            for (const auto property : lumped)
                add_to_mean(mean.*property, part.*property, share / weight);
        }
        void add_couple(const SectionProperties& part, double share) {
            if (!reference) reference = &part;
            for (const auto property : lumped)
                couple.*property += share * (part.*property - reference->*property);
        }
    };

    /// What the couple on a node moves from the node before to the node after it. A node keeps a
    /// quarter of its own at least: a mass that vanished would be too fast for any step.
    [[nodiscard]] double shift(std::size_t node, Property property) const {
        constexpr double most = 3.0 / 8;  // to either neighbour
        const auto own = [&](const Node& at) { return at.weight * at.mean.*property; };
        return std::clamp(node_[node].couple.*property / 2, -most * own(node_[node + 1]),
                          most * own(node_[node - 1]));
    }

    std::vector<Node> node_;
    bool head_is_free_;
};

/// Cells (m) of a uniform string on segments of the length h: a load on a free end's node is shared
/// with its neighbour.
std::vector<double> cubic_cells(std::size_t segments, double h, bool head_is_free) {
    std::vector<double> cell(segments + 1, h);
    cell.front() = cell.back() = h / 2;
    const auto share = [&](double& end, double& neighbour) {
        end -= h / 12;
        neighbour += h / 12;
    };
    share(cell[segments], cell[segments - 1]);
    if (head_is_free) share(cell[0], cell[1]);
    return cell;
}

/// Replaces cells, and what nodes have of the string, by those of the cubics.
void lump_on_cubics(StringMesh& mesh, const Stretches& stretches, bool head_is_free) {
    const std::size_t segments = mesh.length.size();
    CubicLumping lumping(segments, head_is_free);
    Walk walk(stretches);
    for (std::size_t k = 0; k < segments; ++k) {
        const double start = mesh.node_s[k];
        const double h = mesh.node_s[k + 1] - start;
        walk.over(start, mesh.node_s[k + 1],
                  [&](const SectionProperties& part, double begin, double end) {
                      lumping.add(k, part, (begin - start) / h, (end - start) / h);
                  });
    }
    lumping.lump(mesh.node);
    mesh.cell = cubic_cells(segments, mesh.length.front(), head_is_free);
}

}  // namespace

StringMesh mesh_string(const StringCase& string, int segments, Lumping lumping) {
    const Stretches stretches = stretches_of(string);
    const double total = stretches.boundary.back();
    const auto arc_length = [&](double position) { return total * (position / segments); };

    StringMesh mesh;
    const auto count = static_cast<std::size_t>(segments);
    for (auto* row : {&mesh.node_s, &mesh.segment_s, &mesh.length, &mesh.cell})
        row->reserve(count + 1);
    mesh.node.reserve(count + 1);
    mesh.segment.reserve(count);
    Walk cells(stretches);
    Walk nodes(stretches);
    for (int k = 0; k <= segments; ++k) {
        const double from = arc_length(std::max(0.0, k - 0.5));
        const double to = arc_length(std::min<double>(segments, k + 0.5));
        const double s = arc_length(k);
        mesh.node_s.push_back(s);
        mesh.cell.push_back(to - from);
        mesh.node.push_back(cells.mean_over(from, to));
        mesh.node.back().outer_radius = nodes.radius_at(s);
    }
    Walk whole(stretches);
    Walk middles(stretches);
    for (int k = 0; k < segments; ++k) {
        const double middle = arc_length(k + 0.5);
        mesh.segment_s.push_back(middle);
        mesh.length.push_back(total / segments);
        mesh.segment.push_back(whole.mean_over(arc_length(k), arc_length(k + 1)));
        mesh.segment.back().outer_radius = middles.radius_at(middle);
    }
    if (lumping != Lumping::cells)
        lump_on_cubics(mesh, stretches, lumping == Lumping::cubic_free_head);
    return mesh;
}

}  // namespace drillstrand
