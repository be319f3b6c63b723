/// Published surveys under tests/data/surveys: stations with the coordinates their source prints.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"

namespace drillstrand::test {

inline constexpr double degree = 0.017453292519943295;  ///< rad

struct PublishedSurvey {
    std::vector<SurveyStation> stations;
    std::vector<Eigen::Vector3d> positions;  ///< relative to the first station (m, NED)
};

PublishedSurvey read_published_survey(const std::string& name);

}  // namespace drillstrand::test
