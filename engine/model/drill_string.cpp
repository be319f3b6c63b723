#include "drillstrand/drill_string.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "model/cubic_lumping.hpp"
#include "model/mesh_layout.hpp"
#include "model/string_layout.hpp"

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
    if (component.material_density || component.joints) {
        section.metal_area =
            component.linear_density / component.material_density.value_or(steel_density);
        section.outer_area = section.metal_area + pi / 4 * inner2;
    }
    section.outer_radius = component.outer_diameter / 2;
    section.flow_radius = section.outer_radius;
    section.curvature = component.curvature;
    if (section.outer_radius > 0) {
        section.section_modulus = area * gyration2 / section.outer_radius;
        section.yield = {
            component.yield_strength * area, component.yield_strength * section.section_modulus,
            component.yield_strength * 2 * section.section_modulus / std::numbers::sqrt3};
    }
    return section;
}

double touching_radius(const Component& component) {
    const double joints = component.joints ? component.joints->outer_diameter : 0;
    return std::max(component.outer_diameter, joints) / 2;
}

namespace {

constexpr std::array stiffnesses{
    &SectionProperties::axial_stiffness, &SectionProperties::shear_stiffness,
    &SectionProperties::bending_stiffness, &SectionProperties::torsional_stiffness};

constexpr std::array yield_loads{&YieldLoads::axial, &YieldLoads::bending, &YieldLoads::torsion};

/// Walks down the string's stretches with places that never go up again.
class Walk {
  public:
    explicit Walk(const StringLayout& layout) : layout_(layout) {}

    /// Calls visit(properties, begin, end) for each stretch between two places (m).
    template <class Visit>
    void over(double from, double to, const Visit& visit) {
        go_to(from);
        for (std::size_t i = here_; i < layout_.property.size() && layout_.boundary[i] < to; ++i) {
            const double begin = std::max(from, layout_.boundary[i]);
            const double end = std::min(to, layout_.boundary[i + 1]);
            if (end > begin) visit(layout_.property[i], begin, end);
        }
    }

    /// Means from one place to another: arithmetic for what adds up along the string (mass, area,
    /// stress-free curvature), harmonic for stiffnesses, whose compliances add up, the least of
    /// yield loads and section moduli. The radius is left out: it is a property of a point.
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
            for (const auto property : lumped_properties)
                add_to_mean(mean.*property, part.*property, share);
            add_to_mean<Eigen::Vector3d>(mean.curvature, part.curvature, share);
            mean.section_modulus = std::min(mean.section_modulus, part.section_modulus);
            for (const auto load : yield_loads)
                mean.yield.*load = std::min(mean.yield.*load, part.yield.*load);
            for (const auto stiffness : stiffnesses)
                add_to_mean(compliance.*stiffness, first->*stiffness / part.*stiffness, share);
        });
        for (const auto stiffness : stiffnesses)
            mean.*stiffness = first->*stiffness / compliance.*stiffness;
        return mean;
    }

    /// Of the stretches at a point, the larger where two meet, the last at the bit.
    template <class Value>
    double largest_at(double s, const Value& value) {
        const double length = layout_.length();
        const double rounding = 1e-12 * length;
        if (s >= length - rounding) return value(layout_.property.size() - 1);
        go_to(s - rounding);
        double most = 0;
        for (std::size_t i = here_;
             i < layout_.property.size() && layout_.boundary[i] <= s + rounding; ++i)
            most = std::max(most, value(i));
        return most;
    }

  private:
    /// The first stretch that does not end above.
    void go_to(double s) {
        while (here_ + 1 < layout_.property.size() && layout_.boundary[here_ + 1] < s)
            ++here_;
    }

    const StringLayout& layout_;
    std::size_t here_ = 0;
};

/// Replaces cells, and what nodes have of the string, by those of the cubics.
void lump_on_cubics(StringMesh& mesh, const StringLayout& layout, bool head_is_free) {
    CubicLumping lumping(mesh.length, head_is_free);
    Walk walk(layout);
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const double start = mesh.node_s[k];
        const double h = mesh.node_s[k + 1] - start;
        walk.over(start, mesh.node_s[k + 1],
                  [&](const SectionProperties& part, double begin, double end) {
                      lumping.add(k, part, (begin - start) / h, (end - start) / h);
                  });
    }
    lumping.lump(mesh.cell, mesh.node);
}

/// Segments between nodes. On a mesh of `segments` of one length all have that, to the last bit.
void add_segments(StringMesh& mesh, const StringLayout& layout, int segments) {
    const std::vector<double>& s = mesh.node_s;
    Walk whole(layout);
    Walk middles(layout);
    for (std::size_t k = 0; k + 1 < s.size(); ++k) {
        const double middle = segments > 0
                                  ? layout.length() * ((static_cast<double>(k) + 0.5) / segments)
                                  : 0.5 * (s[k] + s[k + 1]);
        mesh.segment_s.push_back(middle);
        mesh.length.push_back(segments > 0 ? layout.length() / segments : s[k + 1] - s[k]);
        mesh.segment.push_back(whole.mean_over(s[k], s[k + 1]));
        SectionProperties& segment = mesh.segment.back();
        segment.outer_radius = middles.largest_at(
            middle, [&](std::size_t i) { return layout.property[i].outer_radius; });
        segment.flow_radius = segment.outer_radius;
    }
}

/// Nodes with what lies around them, from the middle of one segment to the middle of the next. On a
/// mesh of one length tool joints are everywhere: it has no nodes at them.
void add_nodes(StringMesh& mesh, const StringLayout& layout, bool joints_everywhere) {
    const std::size_t last = mesh.length.size();
    Walk cells(layout);
    Walk nodes(layout);
    Walk flows(layout);
    const auto radius = [&](std::size_t i) {
        const double pipe = layout.property[i].outer_radius;
        return joints_everywhere ? std::max(pipe, layout.joint_radius[i]) : pipe;
    };
    for (std::size_t k = 0; k <= last; ++k) {
        const double s = mesh.node_s[k];
        const double from = k > 0 ? mesh.segment_s[k - 1] : 0;
        const double to = k < last ? mesh.segment_s[k] : layout.length();
        mesh.cell.push_back(to - from);
        mesh.node.push_back(cells.mean_over(from, to));
        mesh.node.back().outer_radius = nodes.largest_at(s, radius);
        mesh.node.back().flow_radius =
            flows.largest_at(s, [&](std::size_t i) { return layout.property[i].flow_radius; });
    }
}

/// Nodes at tool joints and contact points have their radius.
void touch_at_places(StringMesh& mesh, const StringLayout& layout) {
    const double rounding = place_rounding * layout.length();
    mesh.touches_at_a_point.assign(mesh.node_s.size(), false);
    std::size_t k = 0;
    for (const TouchingPlace& place : layout.places) {
        while (k + 1 < mesh.node_s.size() && mesh.node_s[k] < place.s - rounding)
            ++k;
        if (std::abs(mesh.node_s[k] - place.s) > rounding) {
            if (place.contact) mesh.lost.push_back(place.s);
            continue;
        }
        double& radius = mesh.node[k].outer_radius;
        radius = std::max(radius, place.radius);
        mesh.touches_at_a_point[k] = place.radius > mesh.node[k].flow_radius;
        if (place.contact) mesh.contact.push_back({k, *place.contact});
    }
}

/// Shares a kink between the segments above and below it: each turns by a half, which leads to the
/// same lines beyond them. On a mesh without a node there the segment has all of it.
void bend_at_kinks(StringMesh& mesh, const StringLayout& layout) {
    const double rounding = place_rounding * layout.length();
    const std::size_t last = mesh.length.size();
    for (const Kink& kink : layout.kinks) {
        const auto node = static_cast<std::size_t>(
            std::lower_bound(mesh.node_s.begin(), mesh.node_s.end(), kink.s - rounding) -
            mesh.node_s.begin());
        const bool at_node = std::abs(mesh.node_s[node] - kink.s) <= rounding;
        const Eigen::Vector3d turn =
            kink.angle * Eigen::Vector3d(0, -std::sin(kink.toolface), std::cos(kink.toolface));
        const auto bend = [&](std::size_t segment, double share) {
            mesh.segment[segment].curvature += share / mesh.length[segment] * turn;
        };
        if (at_node && node > 0 && node < last) {
            bend(node - 1, 0.5);
            bend(node, 0.5);
        } else {
            bend(std::min(node > 0 ? node - 1 : 0, last - 1), 1);
        }
    }
}

/// Gives eccentric masses to the nearest nodes.
void unbalance_nodes(StringMesh& mesh, const StringLayout& layout) {
    if (layout.eccentric.empty()) return;
    mesh.unbalance.assign(mesh.node_s.size(), 0.0);
    for (const EccentricPlace& mass : layout.eccentric) {
        const auto below = std::lower_bound(mesh.segment_s.begin(), mesh.segment_s.end(), mass.s);
        mesh.unbalance[static_cast<std::size_t>(below - mesh.segment_s.begin())] += mass.moment;
    }
}

}  // namespace

std::size_t StringMesh::segment_at(double s) const {
    const auto beyond = std::upper_bound(node_s.begin() + 1, node_s.end() - 1, s);
    return static_cast<std::size_t>(beyond - node_s.begin()) - 1;
}

StringMesh mesh_string(const StringCase& string, const MeshCase& mesh_case, Lumping lumping) {
    const StringLayout layout(string);
    StringMesh mesh;
    mesh.node_s = node_places(string, layout, mesh_case);
    const std::size_t nodes = mesh.node_s.size();
    for (auto* row : {&mesh.segment_s, &mesh.length, &mesh.cell})
        row->reserve(nodes);
    mesh.node.reserve(nodes);
    mesh.segment.reserve(nodes);
    const bool is_uniform = mesh_case.segments > 0;
    add_segments(mesh, layout, mesh_case.segments);
    add_nodes(mesh, layout, is_uniform);
    if (lumping != Lumping::cells)
        lump_on_cubics(mesh, layout, lumping == Lumping::cubic_free_head);
    touch_at_places(mesh, layout);
    bend_at_kinks(mesh, layout);
    unbalance_nodes(mesh, layout);
    if (layout.jar) mesh.jar = {mesh.segment_at(layout.jar->s), layout.jar->law};
    return mesh;
}

}  // namespace drillstrand
