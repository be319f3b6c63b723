/// The well: circular arcs through the stations of a survey (minimum curvature), and the cross
/// section of the well nearest to a point. Equations: engine/model/README.md.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "drillstrand/case.hpp"

namespace drillstrand {

/// A stretch of well of constant curvature, in one section. Straight where curvature = 0. Radius
/// and firmness of the wall are linear in sin(c s)/c, s the distance from the start.
struct WellArc {
    Eigen::Vector3d start;            ///< first point of the axis (m, north-east-down)
    Eigen::Vector3d tangent;          ///< unit, down the well, at the start
    Eigen::Vector3d normal;           ///< unit, normal to the tangent, toward the centre
    double curvature = 0;             ///< 1/m
    double length = 0;                ///< m
    double measured_depth_start = 0;  ///< m
    double radius = 0;                ///< of the hole, at the start (m)
    double widening = 0;              ///< growth of the radius (1)
    double firmness = 1;              ///< normal stiffness over that of [contact], at the start
    double firming = 0;               ///< its growth (1/m)
    std::size_t section = 0;
    Eigen::Vector3d end;          ///< last point of the axis
    Eigen::Vector3d end_tangent;  ///< unit tangent there

    /// Radius of the hole at a distance from the start (m).
    [[nodiscard]] double radius_at(double distance) const;
};

/// The cross section of the well in whose plane a point lies.
struct WellCrossSection {
    Eigen::Vector3d axis;       ///< centre of the section (m)
    Eigen::Vector3d direction;  ///< l: unit tangent, down the well
    double measured_depth = 0;  ///< m
    double radius = 0;          ///< m
};

class Well {
  public:
    /// Arcs through the stations, the first at the origin, cut where the sections do and where
    /// their diameters go over into each other (engine/model/README.md, "Sections").
    /// `normal_stiffness` is that of walls whose section has none of its own. Throws
    /// std::invalid_argument where the survey bends on a radius below the hole's, or turns back.
    explicit Well(const WellCase& well, double normal_stiffness = ContactCase{}.normal_stiffness);

    [[nodiscard]] const std::vector<WellArc>& arcs() const { return arcs_; }
    /// Whether diameter or firmness of the wall vary within an arc.
    [[nodiscard]] bool varies_along() const;
    /// Of the firmest wall.
    [[nodiscard]] double largest_firmness() const;
    /// Measured depths of the first and the last station (m).
    [[nodiscard]] double measured_depth_start() const { return measured_depth_start_; }
    [[nodiscard]] double measured_depth_end() const { return measured_depth_end_; }

    /// The arc that holds a measured depth; the first or last one outside the survey.
    [[nodiscard]] std::size_t arc_at(double measured_depth) const;

    /// Section at a measured depth; the axis goes on straight above the start and below the end.
    [[nodiscard]] WellCrossSection at(double measured_depth) const;

    /// The arc whose part of the well holds the foot of `point`, searched from arc `guess` outward
    /// one neighbour at a time: a node that moves a little finds its arc in one comparison.
    [[nodiscard]] std::size_t find_arc(const Eigen::Vector3d& point, std::size_t guess) const;

    /// Cross section of arc number `index` in whose plane `point` lies, without trigonometry but
    /// for the measured depth.
    [[nodiscard]] WellCrossSection project(const Eigen::Vector3d& point, std::size_t index) const;

  private:
    std::vector<WellArc> arcs_;  ///< with straight ones before the first and after the last station
    double measured_depth_start_;
    double measured_depth_end_;
};

/// Positions of survey stations by minimum curvature, the first at the origin (m, NED).
std::vector<Eigen::Vector3d> station_positions(const std::vector<SurveyStation>& survey);

/// Dogleg severity between consecutive stations (rad/m), one fewer than stations.
std::vector<double> dogleg_severities(const std::vector<SurveyStation>& survey);

}  // namespace drillstrand
