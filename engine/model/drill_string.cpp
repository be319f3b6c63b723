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

    /// Means from one place to another: arithmetic for what adds up along the string (mass, area,
    /// stress-free curvature), harmonic for stiffnesses, whose compliances add up, the least of
    /// yield loads. The radius is left out: it is a property of a point.
    SectionProperties mean_over(double from, double to) {
        go_to(from);
        // Compliances are counted relative to the first stiffness met, so that no digit is lost
        // where all are equal.
        const SectionProperties* first = nullptr;
        SectionProperties mean;
        SectionProperties compliance;
        double covered = 0;
        for (std::size_t i = here_; i < stretches_.property.size() && stretches_.boundary[i] < to;
             ++i) {
            const double overlap =
                std::min(to, stretches_.boundary[i + 1]) - std::max(from, stretches_.boundary[i]);
            if (overlap <= 0) continue;
            const SectionProperties& part = stretches_.property[i];
            if (!first) first = &part;
            covered += overlap;
            const double share = overlap / covered;
            add_to_mean(mean.mass, part.mass, share);
            add_to_mean(mean.inertia, part.inertia, share);
            add_to_mean(mean.polar_inertia, part.polar_inertia, share);
            add_to_mean(mean.metal_area, part.metal_area, share);
            add_to_mean(mean.outer_area, part.outer_area, share);
            add_to_mean<Eigen::Vector3d>(mean.curvature, part.curvature, share);
            for (const auto load : yield_loads)
                mean.yield.*load = std::min(mean.yield.*load, part.yield.*load);
            for (const auto stiffness : stiffnesses)
                add_to_mean(compliance.*stiffness, first->*stiffness / part.*stiffness, share);
        }
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

}  // namespace

StringMesh mesh_string(const StringCase& string, int segments) {
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
    return mesh;
}

}  // namespace drillstrand
