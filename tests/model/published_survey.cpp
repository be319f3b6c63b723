#include "model/published_survey.hpp"

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace drillstrand::test {

namespace {

std::array<double, 6> parse_row(const std::string& line) {
    std::istringstream cells(line);
    std::array<double, 6> row{};
    for (double& value : row) {
        std::string cell;
        std::getline(cells, cell, ',');
        value = std::stod(cell);
    }
    return row;
}

}  // namespace

PublishedSurvey read_published_survey(const std::string& name) {
    const std::string path = std::string(DRILLSTRAND_SOURCE_DIR) + "/tests/data/surveys/" + name;
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot open " + path);
    PublishedSurvey survey;
    bool header_seen = false;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        if (!header_seen) {
            header_seen = true;
            continue;
        }
        const auto [md, inclination, azimuth, north, east, tvd] = parse_row(line);
        survey.stations.push_back({md, inclination * degree, azimuth * degree});
        survey.positions.emplace_back(north, east, tvd);
    }
    const Eigen::Vector3d origin = survey.positions.front();
    for (Eigen::Vector3d& position : survey.positions)
        position -= origin;
    return survey;
}

}  // namespace drillstrand::test
