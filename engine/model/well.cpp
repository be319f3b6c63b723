#include "drillstrand/well.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "model/hole_wall.hpp"
#include "model/survey.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;

// Length of the straight arcs above the first and below the last station (m): longer than any
// string, and short enough that rounding of distances from their far end stays below 1e-10 m.
constexpr double extension = 1e5;

// Tangents closer than this (rad) are equal to rounding: the arc between them is straight.
constexpr double straight_angle = 8 * std::numeric_limits<double>::epsilon();

/// Direction of the centre of the arc that leaves along `from` and arrives along `to`.
Vector3d normal_toward_centre(const Vector3d& from, const Vector3d& to) {
    const Vector3d turn = to - from;
    return (turn - turn.dot(from) * from).normalized();
}

Vector3d point_on(const WellArc& arc, double distance) {
    const double half_angle = 0.5 * arc.curvature * distance;
    const double ratio = sine_ratio(half_angle);
    return arc.start + distance * sine_ratio(2 * half_angle) * arc.tangent +
           distance * half_angle * ratio * ratio * arc.normal;
}

Vector3d tangent_on(const WellArc& arc, double distance) {
    const double angle = arc.curvature * distance;
    return std::cos(angle) * arc.tangent + std::sin(angle) * arc.normal;
}

WellArc straight_arc(const Vector3d& start, const Vector3d& tangent, double measured_depth) {
    WellArc arc;
    arc.start = start;
    arc.tangent = tangent;
    arc.normal = tangent.unitOrthogonal();
    arc.length = extension;
    arc.measured_depth_start = measured_depth;
    arc.end = start + extension * tangent;
    arc.end_tangent = tangent;
    return arc;
}

WellArc arc_between(const SurveyStation& upper, const SurveyStation& lower, const Vector3d& start) {
    WellArc arc;
    arc.start = start;
    arc.tangent = station_tangent(upper);
    arc.end_tangent = station_tangent(lower);
    arc.length = lower.measured_depth - upper.measured_depth;
    arc.measured_depth_start = upper.measured_depth;
    const double angle = angle_between(arc.tangent, arc.end_tangent);
    if (angle < straight_angle) {
        arc.normal = arc.tangent.unitOrthogonal();
    } else {
        arc.normal = normal_toward_centre(arc.tangent, arc.end_tangent);
        arc.curvature = angle / arc.length;
    }
    arc.end = start + arc_displacement(arc.tangent, arc.end_tangent, arc.length);
    return arc;
}

/// The arcs of the survey with their straight extensions, still without a radius. The end of an arc
/// and the start of the next are the same numbers: find_arc() relies on it.
std::vector<WellArc> arcs_through(const std::vector<SurveyStation>& survey) {
    std::vector<WellArc> arcs;
    const Vector3d origin = Vector3d::Zero();
    const Vector3d first_tangent = station_tangent(survey.front());
    arcs.push_back(straight_arc(origin - extension * first_tangent, first_tangent,
                                survey.front().measured_depth - extension));
    arcs.back().end = origin;
    for (std::size_t k = 1; k < survey.size(); ++k)
        arcs.push_back(arc_between(survey[k - 1], survey[k], arcs.back().end));
    arcs.push_back(
        straight_arc(arcs.back().end, arcs.back().end_tangent, survey.back().measured_depth));
    return arcs;
}

double measured_depth_end_of(const WellArc& arc) {
    return arc.measured_depth_start + arc.length;
}

/// Cuts `arc` at a measured depth inside it; what lies above the cut is returned, `arc` keeps the
/// rest.
WellArc cut_off_above(WellArc& arc, double measured_depth) {
    WellArc above = arc;
    above.length = measured_depth - arc.measured_depth_start;
    above.end = point_on(arc, above.length);
    above.end_tangent = tangent_on(arc, above.length);
    const Vector3d centre_direction = std::cos(arc.curvature * above.length) * arc.normal -
                                      std::sin(arc.curvature * above.length) * arc.tangent;
    arc.length -= above.length;
    arc.measured_depth_start = measured_depth;
    arc.start = above.end;
    arc.tangent = above.end_tangent;
    arc.normal = centre_direction;
    return above;
}

/// sin(c s)/c at the end of an arc, in which its wall is linear.
double reach_of(const WellArc& arc) {
    return arc.length * sine_ratio(arc.curvature * arc.length);
}

void set_wall(WellArc& arc, const HoleWall& wall) {
    const double start = arc.measured_depth_start;
    arc.section = wall.section;
    arc.radius = 0.5 * wall.diameter_at(start);
    arc.firmness = wall.firmness_at(start);
    if (!wall.varies()) return;
    const double end = measured_depth_end_of(arc);
    arc.widening = (0.5 * wall.diameter_at(end) - arc.radius) / reach_of(arc);
    arc.firming = (wall.firmness_at(end) - arc.firmness) / reach_of(arc);
}

/// Adds an arc that lies in one wall; where that varies, in pieces in which sin(c s)/c is near s.
void add_arc(std::vector<WellArc>& arcs, WellArc arc, const HoleWall& wall) {
    constexpr double most_angle = 0.25;
    if (wall.varies() && arc.curvature * arc.length > most_angle) {
        add_arc(arcs, cut_off_above(arc, arc.measured_depth_start + 0.5 * arc.length), wall);
        add_arc(arcs, arc, wall);
        return;
    }
    set_wall(arc, wall);
    arcs.push_back(arc);
}

/// Gives each arc its wall, cutting it where one ends.
std::vector<WellArc> with_walls(const std::vector<WellArc>& arcs,
                                const std::vector<HoleWall>& walls) {
    std::vector<WellArc> result;
    auto wall = walls.begin();
    for (WellArc arc : arcs) {
        for (; wall->to < measured_depth_end_of(arc); ++wall)
            if (wall->to > arc.measured_depth_start)
                add_arc(result, cut_off_above(arc, wall->to), *wall);
        add_arc(result, arc, *wall);
    }
    return result;
}

/// Opposite tangents have no arc between them, and the section through a point is unique only
/// where the hole is narrower than its bend.
void check_bends(const std::vector<WellArc>& arcs) {
    for (const WellArc& arc : arcs) {
        const bool turns_back = (arc.tangent + arc.end_tangent).norm() < 1e-6;
        const double radius = std::max(arc.radius, arc.radius_at(arc.length));
        if (turns_back || arc.curvature * radius >= 1.0)
            throw std::invalid_argument(fmt::format(
                "the survey turns too sharply below a measured depth of {:g} m; a well bends by "
                "less than half a turn between stations and on a radius wider than its own",
                arc.measured_depth_start));
    }
}

}  // namespace

double WellArc::radius_at(double distance) const {
    return radius + widening * distance * sine_ratio(curvature * distance);
}

Well::Well(const WellCase& well, double normal_stiffness)
    : arcs_(with_walls(
          arcs_through(well.survey),
          hole_walls(well.sections, well.survey.front().measured_depth, normal_stiffness))),
      measured_depth_start_(well.survey.front().measured_depth),
      measured_depth_end_(well.survey.back().measured_depth) {
    check_bends(arcs_);
}

bool Well::varies_along() const {
    return std::any_of(arcs_.begin(), arcs_.end(),
                       [](const WellArc& arc) { return arc.widening != 0 || arc.firming != 0; });
}

double Well::largest_firmness() const {
    double largest = 0;
    for (const WellArc& arc : arcs_)
        largest = std::max(largest, arc.firmness);
    return largest;
}

std::size_t Well::arc_at(double measured_depth) const {
    const auto next = std::upper_bound(
        arcs_.begin() + 1, arcs_.end(), measured_depth,
        [](double depth, const WellArc& arc) { return depth < arc.measured_depth_start; });
    return static_cast<std::size_t>(next - arcs_.begin()) - 1;
}

WellCrossSection Well::at(double measured_depth) const {
    const WellArc& arc = arcs_[arc_at(measured_depth)];
    const double distance = measured_depth - arc.measured_depth_start;
    return {point_on(arc, distance), tangent_on(arc, distance), measured_depth,
            arc.radius_at(distance)};
}

std::size_t Well::find_arc(const Vector3d& point, std::size_t guess) const {
    const auto above_start = [&](std::size_t k) {
        return (point - arcs_[k].start).dot(arcs_[k].tangent) < 0;
    };
    const auto below_end = [&](std::size_t k) {
        return (point - arcs_[k].end).dot(arcs_[k].end_tangent) > 0;
    };
    // Neighbours share the plane of their joint to the last digit, so a walk never turns back.
    std::size_t arc = guess;
    while (arc > 0 && above_start(arc))
        --arc;
    if (arc < guess) return arc;
    while (arc + 1 < arcs_.size() && below_end(arc))
        ++arc;
    return arc;
}

WellCrossSection Well::project(const Vector3d& point, std::size_t index) const {
    const WellArc& arc = arcs_[index];
    const Vector3d offset = point - arc.start;
    const double a = offset.dot(arc.tangent);
    const double e = offset.dot(arc.normal);
    const double c = arc.curvature;
    const double q = 1.0 - e * c;
    const double r = std::sqrt(a * a * c * c + q * q);
    const double toward_centre = e + (c * (a * a + e * e) - 2.0 * e) / (r + 1.0);
    WellCrossSection section;
    section.axis = arc.start + (a * arc.tangent + toward_centre * arc.normal) / r;
    section.direction = (q * arc.tangent + a * c * arc.normal) / r;
    section.measured_depth = arc.measured_depth_start + (c > 0 ? std::atan2(a * c, q) / c : a);
    section.radius = arc.radius + arc.widening * a / r;
    return section;
}

}  // namespace drillstrand
