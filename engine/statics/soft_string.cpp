#include "statics/soft_string.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "statics/arc_section.hpp"
#include "statics/wall_load.hpp"

namespace drillstrand {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A length of string of one kind in one arc of the well.
struct Piece {
    const SoftStretch& stretch;
    const SoftMud& mud;
    const WellArc& arc;
    FrictionShares friction;
    Vector3d down;

    /// Force of the wall on the string, normal to it (N/m).
    [[nodiscard]] double side_force(const ArcSection& section, double tension) const {
        const Vector3d weight = stretch.weight * down;
        const Vector3d across = weight - weight.dot(section.direction) * section.direction;
        return (tension * section.curvature + across).norm();
    }

    [[nodiscard]] double side_force(double depth, double tension) const {
        return side_force(arc_section(arc, depth), tension);
    }

    /// Growth of tension and torque per length toward the head.
    [[nodiscard]] Vector2d growth(double depth, const Vector2d& load) const {
        const ArcSection section = arc_section(arc, depth);
        const double side = side_force(section, load[0]);
        return {
            stretch.weight * down.dot(section.direction) + mud.at(depth) - friction.axial * side,
            friction.azimuthal * stretch.radius * side};
    }

    /// The load one step of length h further up.
    [[nodiscard]] Vector2d step_up(double depth, const Vector2d& load, double h) const {
        const Vector2d k1 = growth(depth, load);
        const Vector2d k2 = growth(depth - h / 2, load + h / 2 * k1);
        const Vector2d k3 = growth(depth - h / 2, load + h / 2 * k2);
        const Vector2d k4 = growth(depth - h, load + h * k3);
        return load + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
};

/// Measured depths between which nothing jumps, from the bit up.
std::vector<double> joints(const SoftString& string, const Well& well,
                           const std::vector<double>& depths) {
    const double head = string.stretches.front().from;
    const double bit = string.stretches.back().to;
    std::vector<double> all = depths;
    for (const SoftStretch& stretch : string.stretches)
        all.push_back(stretch.from);
    for (const WellArc& arc : well.arcs())
        if (arc.measured_depth_start > head && arc.measured_depth_start < bit)
            all.push_back(arc.measured_depth_start);
    all.push_back(bit);
    std::sort(all.begin(), all.end(), std::greater<>());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

Piece piece_at(const SoftString& string, const Well& well, double depth) {
    const auto stretch =
        std::find_if(string.stretches.begin(), string.stretches.end() - 1,
                     [&](const SoftStretch& candidate) { return depth < candidate.to; });
    const WellArc& arc = well.arcs()[well.arc_at(depth)];
    return {*stretch, string.mud, arc,
            friction_shares(string.friction[arc.section], string.motion, stretch->radius),
            string.down};
}

}  // namespace

double SoftMud::at(double measured_depth) const {
    if (depth.empty()) return 0;
    const auto below = std::upper_bound(depth.begin(), depth.end(), measured_depth);
    if (below == depth.begin()) return load.front();
    if (below == depth.end()) return load.back();
    const auto k = static_cast<std::size_t>(below - depth.begin());
    const double share = (measured_depth - depth[k - 1]) / (depth[k] - depth[k - 1]);
    return load[k - 1] + share * (load[k] - load[k - 1]);
}

SoftProfile solve_soft_string(const SoftString& string, const Well& well,
                              const std::vector<double>& depths, double step) {
    const std::vector<double> ends = joints(string, well, depths);
    SoftProfile profile;
    Vector2d load(string.at_bit.tension, string.at_bit.torque);
    auto wanted = depths.rbegin();
    const auto report = [&](const Piece& piece, double depth) {
        for (; wanted != depths.rend() && *wanted == depth; ++wanted) {
            profile.load.push_back({load[0], load[1]});
            profile.side_force.push_back(piece.side_force(depth, load[0]));
        }
    };
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double length = ends[i] - ends[i + 1];
        const Piece piece = piece_at(string, well, ends[i] - length / 2);
        report(piece, ends[i]);
        const double steps = std::ceil(length / step);
        for (double k = 0; k < steps; ++k)
            load = piece.step_up(ends[i] - length * (k / steps), load, length / steps);
        if (i + 2 == ends.size()) report(piece, ends[i + 1]);
    }
    std::reverse(profile.load.begin(), profile.load.end());
    std::reverse(profile.side_force.begin(), profile.side_force.end());
    profile.at_head = {load[0], load[1]};
    return profile;
}

}  // namespace drillstrand
