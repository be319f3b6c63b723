#include "input/witsml_trajectory.hpp"

#include <algorithm>
#include <array>

#include "input/witsml.hpp"

namespace drillstrand {

namespace {

class TrajectoryStations : public StationSource {
  public:
    TrajectoryStations(const std::filesystem::path& path, const SourceLocation& asked_at)
        : file_(path, asked_at, "trajectory") {
        for (const pugi::xml_node node : file_.children(file_.object(), "trajectoryStation"))
            stations_.push_back(read_station(node));
        std::stable_sort(stations_.begin(), stations_.end(),
                         [](const Station& left, const Station& right) {
                             return left.value[measured_depth] < right.value[measured_depth];
                         });
    }

    [[nodiscard]] std::size_t count() const override { return stations_.size(); }
    [[nodiscard]] double value(std::size_t row, Part part) const override {
        return stations_[row].value[part];
    }
    [[nodiscard]] std::string text(std::size_t row, Part part) const override {
        return content_of(stations_[row].element[part]);
    }
    [[nodiscard]] std::string depth_unit(std::size_t row) const override {
        return stations_[row].element[measured_depth].attribute("uom").value();
    }
    [[nodiscard]] SourceLocation where(std::size_t row, Part part) const override {
        return file_.where(stations_[row].element[part]);
    }

  private:
    struct Station {
        std::array<pugi::xml_node, 3> element;
        std::array<double, 3> value;
    };

    [[nodiscard]] Station read_station(pugi::xml_node node) const {
        constexpr std::array names{"md", "incl", "azi"};
        constexpr std::array dimensions{dimension::length, dimension::angle, dimension::angle};
        Station station{};
        for (std::size_t k = 0; k < names.size(); ++k) {
            station.element[k] = file_.require(node, names[k]);
            station.value[k] = file_.quantity(station.element[k], dimensions[k]);
        }
        return station;
    }

    WitsmlFile file_;
    std::vector<Station> stations_;
};

}  // namespace

std::unique_ptr<StationSource> open_trajectory(const std::filesystem::path& path,
                                               const SourceLocation& asked_at) {
    return std::make_unique<TrajectoryStations>(path, asked_at);
}

}  // namespace drillstrand
