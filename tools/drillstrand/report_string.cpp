#include "report_string.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "drillstrand/well.hpp"

namespace drillstrand::program {

namespace {

using Eigen::Vector3d;
using Indices = std::vector<std::size_t>;

/// Values of profiles that a page carries: 5.5 MB of single precision.
constexpr std::size_t most_values = 1375000;
constexpr std::size_t most_nodes = 800;

/// Wells that lean less than this have no high side worth the name (3 degrees).
constexpr double least_sine_of_lean = 0.0523;

/// Which profiles, nodes and segments are drawn.
struct Picks {
    Indices profiles;
    Indices nodes;
    Indices segments;
};

/// A node's place on the well's axis in the first profile, and the directions across the well:
/// toward the high side (north in a vertical well), and to the right of it seen down the hole.
/// Without a well: its first position, and north, east, down.
struct Place {
    Vector3d base;
    std::vector<Vector3d> axes;
    double clearance = 0;
    bool vertical = false;
};

template <class Value>
std::vector<Value> picked(const std::vector<Value>& values, const Indices& indices) {
    std::vector<Value> out;
    for (const std::size_t k : indices)
        out.push_back(values[k]);
    return out;
}

Picks choose(const Result& result) {
    Picks picks;
    picks.nodes = pick_evenly(result.header.node_s.size(), most_nodes);
    picks.segments = pick_evenly(result.header.segment_s.size(), most_nodes);
    const std::size_t offsets = result.header.well ? 2 : 3;
    const std::size_t per_profile = (offsets + 3) * picks.nodes.size() + 3 * picks.segments.size();
    picks.profiles =
        pick_evenly(result.profiles.size(), most_values / std::max<std::size_t>(1, per_profile));
    return picks;
}

Place place_in_well(const WellCrossSection& section, double outer_radius) {
    const Vector3d up(0, 0, -1);
    const Vector3d north(1, 0, 0);
    const Vector3d& along = section.direction;
    Place place;
    place.base = section.axis;
    place.vertical = up.cross(along).norm() < least_sine_of_lean;
    const Vector3d& toward = place.vertical ? north : up;
    const Vector3d high = (toward - toward.dot(along) * along).normalized();
    place.axes = {high, along.cross(high)};
    place.clearance = std::max(0.0, section.radius - outer_radius);
    return place;
}

/// Follows nodes through the cross sections of the well that hold them.
class Tracker {
  public:
    Tracker(const Result& result, const Picks& picks) : result_(result), nodes_(picks.nodes) {
        if (result.header.well) well_.emplace(*result.header.well);
        for (const std::size_t node : nodes_)
            places_.push_back(first_place(node));
        arcs_.resize(nodes_.size(), 0);
    }

    [[nodiscard]] const std::vector<Place>& places() const { return places_; }

    /// Position of the picked nodes along the axes of their places.
    void append_offsets(const Profile& profile, std::vector<double>& out) {
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            const Vector3d& position = profile.position[nodes_[k]];
            const Vector3d offset = position - origin(position, k);
            for (const Vector3d& axis : places_[k].axes)
                out.push_back(offset.dot(axis));
        }
    }

  private:
    [[nodiscard]] Place first_place(std::size_t node) const {
        const Vector3d& position = result_.profiles.front().position[node];
        if (!well_)
            return {position, {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, 0, false};
        const auto& radii = result_.header.outer_radius;
        const double radius = radii.empty() ? 0 : radii[node];
        return place_in_well(well_->project(position, well_->find_arc(position, 0)), radius);
    }

    [[nodiscard]] Vector3d origin(const Vector3d& position, std::size_t k) {
        if (!well_) return places_[k].base;
        arcs_[k] = well_->find_arc(position, arcs_[k]);
        return well_->project(position, arcs_[k]).axis;
    }

    const Result& result_;
    const Indices& nodes_;
    std::optional<Well> well_;
    std::vector<Place> places_;
    std::vector<std::size_t> arcs_;
};

void add_places(const std::vector<Place>& places, bool well, ArrayBlock& arrays) {
    std::vector<double> base;
    std::vector<double> axes;
    std::vector<double> clearance;
    std::vector<double> vertical;
    for (const Place& place : places) {
        base.insert(base.end(), place.base.begin(), place.base.end());
        for (const Vector3d& axis : place.axes)
            axes.insert(axes.end(), axis.begin(), axis.end());
        clearance.push_back(place.clearance);
        vertical.push_back(place.vertical ? 1 : 0);
    }
    arrays.add("view/base", base, {places.size(), 3});
    arrays.add("view/axes", axes, {places.size(), places.front().axes.size(), 3});
    if (!well) return;
    arrays.add("view/clearance", clearance);
    arrays.add("view/vertical", vertical);
}

/// An array of one value per picked profile and place: `value(profile, place)`.
template <class Value>
void add_field(const char* name, const Result& result, const Indices& profiles,
               const Indices& places, ArrayBlock& arrays, Value&& value) {
    std::vector<double> values;
    values.reserve(profiles.size() * places.size());
    for (const std::size_t profile : profiles)
        for (const std::size_t place : places)
            values.push_back(value(result.profiles[profile], place));
    arrays.add(name, values, {profiles.size(), places.size()});
}

void add_fields(const Result& result, const Picks& picks, ArrayBlock& arrays) {
    const auto segments = [&](const char* name, auto value) {
        add_field(name, result, picks.profiles, picks.segments, arrays,
                  [&](const Profile& profile, std::size_t k) { return value(profile.stress[k]); });
    };
    segments("profiles/axial", [](const Vector6& stress) { return stress[3]; });
    segments("profiles/torque", [](const Vector6& stress) { return -stress[0]; });
    segments("profiles/bending",
             [](const Vector6& stress) { return std::hypot(stress[1], stress[2]); });
    if (result.header.well) {
        add_field("profiles/side", result, picks.profiles, picks.nodes, arrays,
                  [](const Profile& profile, std::size_t k) { return profile.side_force[k]; });
        add_field("profiles/whirl", result, picks.profiles, picks.nodes, arrays,
                  [](const Profile& profile, std::size_t k) { return profile.whirl_rate[k]; });
    }
    const auto& inertia = result.header.polar_inertia;
    if (!inertia.empty())
        add_field("profiles/spin", result, picks.profiles, picks.nodes, arrays,
                  [&](const Profile& profile, std::size_t k) {
                      return profile.momentum[k][0] / inertia[k];
                  });
}

void add_offsets(const Result& result, const Picks& picks, ArrayBlock& arrays) {
    Tracker tracker(result, picks);
    std::vector<double> offsets;
    for (const std::size_t profile : picks.profiles)
        tracker.append_offsets(result.profiles[profile], offsets);
    add_places(tracker.places(), result.header.well.has_value(), arrays);
    const std::size_t components = tracker.places().front().axes.size();
    arrays.add("profiles/offset", offsets, {picks.profiles.size(), picks.nodes.size(), components});
}

void add_yield(const ResultHeader& header, const Indices& segments, ArrayBlock& arrays) {
    std::vector<double> strength;
    for (const std::size_t k : segments) {
        if (header.metal_area.empty() || !std::isfinite(header.yield_tension[k])) return;
        strength.push_back(header.yield_tension[k] / header.metal_area[k]);
    }
    arrays.add("string/yield_strength", strength);
    arrays.add("string/yield_tension", picked(header.yield_tension, segments));
    arrays.add("string/yield_bending", picked(header.yield_bending, segments));
    arrays.add("string/yield_torque", picked(header.yield_torque, segments));
}

void note(std::vector<std::string>& notes, const char* what, std::size_t shown, std::size_t count) {
    if (shown == count) return;
    notes.push_back(fmt::format("{} of {} {} are drawn, evenly picked, to keep this page small.",
                                shown, count, what));
}

}  // namespace

std::vector<std::size_t> pick_evenly(std::size_t count, std::size_t most) {
    std::vector<std::size_t> picks;
    if (count == 0) return picks;
    const std::size_t stride = (count + most - 1) / std::max<std::size_t>(1, most);
    for (std::size_t k = 0; k < count; k += stride)
        picks.push_back(k);
    if (picks.back() != count - 1) picks.push_back(count - 1);
    return picks;
}

double yield_share(const ResultHeader& header, std::size_t segment, const Vector6& stress) {
    if (header.yield_tension.empty()) return std::numeric_limits<double>::quiet_NaN();
    const double tension = std::abs(stress[3]) / header.yield_tension[segment];
    const double bending = std::hypot(stress[1], stress[2]) / header.yield_bending[segment];
    return std::hypot(tension + bending, stress[0] / header.yield_torque[segment]);
}

void add_string(const Result& result, ArrayBlock& arrays, std::vector<std::string>& notes) {
    if (result.profiles.empty()) return;
    const Picks picks = choose(result);
    std::vector<double> times;
    for (const std::size_t k : picks.profiles)
        times.push_back(result.profiles[k].time);
    arrays.add_exact("profiles/time", times);
    arrays.add_exact("mesh/node_s", picked(result.header.node_s, picks.nodes));
    arrays.add_exact("mesh/segment_s", picked(result.header.segment_s, picks.segments));
    add_yield(result.header, picks.segments, arrays);
    add_fields(result, picks, arrays);
    add_offsets(result, picks, arrays);
    note(notes, "profiles", picks.profiles.size(), result.profiles.size());
    note(notes, "nodes", picks.nodes.size(), result.header.node_s.size());
}

}  // namespace drillstrand::program
