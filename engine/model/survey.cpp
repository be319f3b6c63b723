#include "model/survey.hpp"

#include <algorithm>
#include <cmath>

#include "drillstrand/well.hpp"

namespace drillstrand {

Eigen::Vector3d station_tangent(const SurveyStation& station) {
    const double lateral = std::sin(station.inclination);
    return Eigen::Vector3d(lateral * std::cos(station.azimuth), lateral * std::sin(station.azimuth),
                           std::cos(station.inclination))
        .normalized();
}

double angle_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return 2.0 * std::asin(std::min(1.0, 0.5 * (to - from).norm()));
}

double sine_ratio(double x) {
    return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x;
}

Eigen::Vector3d arc_displacement(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                 double length) {
    const double half_angle = 0.5 * angle_between(from, to);
    return length * sine_ratio(half_angle) * (from + to).normalized();
}

std::vector<Eigen::Vector3d> station_positions(const std::vector<SurveyStation>& survey) {
    std::vector<Eigen::Vector3d> positions{Eigen::Vector3d::Zero()};
    positions.reserve(survey.size());
    for (std::size_t k = 1; k < survey.size(); ++k) {
        const double length = survey[k].measured_depth - survey[k - 1].measured_depth;
        const Eigen::Vector3d next =
            positions.back() +
            arc_displacement(station_tangent(survey[k - 1]), station_tangent(survey[k]), length);
        positions.push_back(next);
    }
    return positions;
}

std::vector<double> dogleg_severities(const std::vector<SurveyStation>& survey) {
    std::vector<double> severities;
    severities.reserve(survey.size());
    for (std::size_t k = 1; k < survey.size(); ++k) {
        const double length = survey[k].measured_depth - survey[k - 1].measured_depth;
        severities.push_back(
            angle_between(station_tangent(survey[k - 1]), station_tangent(survey[k])) / length);
    }
    return severities;
}

}  // namespace drillstrand
