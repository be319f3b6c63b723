#include "input/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "input/delimited_table.hpp"
#include "input/plausible.hpp"
#include "input/text_file.hpp"

namespace drillstrand {

namespace {

constexpr double degree = std::numbers::pi / 180;

// Turning by pi between two stations leaves the plane of the arc undefined; nearer than this the
// arc's radius is lost in rounding.
constexpr double least_distance_from_reversal = 1e-6;  // rad

constexpr std::size_t most_stations = 1'000'000;

// Inclinations of 180 degrees written in radians exceed pi by rounding.
constexpr double inclination_rounding = 1e-12;  // rad

/// Angle between the directions of two stations (rad), accurate for small angles too.
double dogleg(const SurveyStation& a, const SurveyStation& b) {
    const double tilt = std::sin(0.5 * (b.inclination - a.inclination));
    const double turn = std::sin(0.5 * (b.azimuth - a.azimuth));
    const double square =
        tilt * tilt + std::sin(a.inclination) * std::sin(b.inclination) * turn * turn;
    return 2 * std::asin(std::sqrt(std::clamp(square, 0.0, 1.0)));
}

class SurveyReader {
  public:
    explicit SurveyReader(const DelimitedTable& table)
        : table_(table),
          depth_(column("md", dimension::length, 1)),
          inclination_(column("inclination", dimension::angle, degree)),
          azimuth_(column("azimuth", dimension::angle, degree)) {}

    [[nodiscard]] std::vector<SurveyStation> stations() const {
        std::vector<SurveyStation> result;
        for (std::size_t row = 0; row < table_.rows(); ++row) {
            const SurveyStation next = station(row);
            if (!result.empty()) check_step(result.back(), next, row);
            result.push_back(next);
        }
        return result;
    }

  private:
    struct Column {
        std::size_t index;
        double factor;
    };

    [[nodiscard]] Column column(const char* name, const Dimension& dimension,
                                double standard) const {
        const std::size_t index = table_.require_column(name);
        return {index, table_.column_factor(index, dimension, standard)};
    }

    [[nodiscard]] double read(std::size_t row, const Column& column) const {
        const double value = table_.number(row, column.index) * column.factor;
        if (!std::isfinite(value)) {
            throw InputError(table_.where(row, column.index),
                             fmt::format("{} is too large; expected a finite number in SI",
                                         table_.text(row, column.index)));
        }
        return value;
    }

    [[nodiscard]] SurveyStation station(std::size_t row) const {
        SurveyStation result{read(row, depth_), read(row, inclination_), read(row, azimuth_)};
        if (!plausible::coordinate.contains(result.measured_depth))
            throw InputError(table_.where(row, depth_.index),
                             fmt::format("md is {}; expected {} m", table_.text(row, depth_.index),
                                         plausible::coordinate.describe()));
        if (result.inclination < 0 ||
            result.inclination > std::numbers::pi + inclination_rounding) {
            throw InputError(table_.where(row, inclination_.index),
                             fmt::format("inclination is {}; expected 0 to 180 degrees",
                                         table_.text(row, inclination_.index)));
        }
        result.inclination = std::min(result.inclination, std::numbers::pi);
        return result;
    }

    void check_step(const SurveyStation& last, const SurveyStation& next, std::size_t row) const {
        if (next.measured_depth <= last.measured_depth) {
            throw InputError(
                table_.where(row, depth_.index),
                fmt::format("md is {} after {}; expected ascending measured depths",
                            table_.text(row, depth_.index), table_.text(row - 1, depth_.index)));
        }
        if (dogleg(last, next) > std::numbers::pi - least_distance_from_reversal) {
            throw InputError(table_.where(row, inclination_.index),
                             "the well turns back by 180 degrees from the station before; expected "
                             "a smaller dogleg, which defines an arc");
        }
    }

    const DelimitedTable& table_;
    Column depth_;
    Column inclination_;
    Column azimuth_;
};

}  // namespace

std::vector<SurveyStation> read_survey(const std::filesystem::path& path,
                                       const SourceLocation& asked_at) {
    const DelimitedTable table(read_text_file(path, asked_at), path.string());
    if (table.rows() > most_stations)
        throw InputError({path.string(), 1, 1},
                         fmt::format("the survey has {} stations; expected at most {}",
                                     table.rows(), most_stations));
    std::vector<SurveyStation> stations = SurveyReader(table).stations();
    if (stations.size() < 2) {
        throw InputError(
            {path.string(), 1, 1},
            fmt::format("the survey has {} stations; expected at least two", stations.size()));
    }
    return stations;
}

}  // namespace drillstrand
