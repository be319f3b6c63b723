#include "input/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>

#include "input/delimited_table.hpp"
#include "input/plausible.hpp"
#include "input/station_source.hpp"
#include "input/text_file.hpp"
#include "input/witsml.hpp"
#include "input/witsml_trajectory.hpp"
#include "input/written.hpp"

namespace drillstrand {

namespace {

constexpr double degree = std::numbers::pi / 180;

// Turning by pi between two stations leaves the plane of the arc undefined; nearer than this the
// arc's radius is lost in rounding.
constexpr double least_distance_from_reversal = 1e-6;  // rad

constexpr std::size_t most_stations = 1'000'000;

// Inclinations of 180 degrees written in radians exceed pi by rounding.
constexpr double inclination_rounding = 1e-12;  // rad

constexpr std::array<std::string_view, 12> depth_names{
    "md",    "measureddepth", "measdepth", "measured",       "mdepth", "mdrkb",
    "mdrte", "mdrt",          "mdkb",      "alongholedepth", "ahd",    "mdbrt"};
// also of what may be a vertical depth
constexpr std::array<std::string_view, 3> bare_depth_names{"depth", "dept", "surveydepth"};
constexpr std::array<std::string_view, 7> inclination_names{
    "inclination", "inclin", "incl", "inc", "deviation", "drift", "holeinclination"};
constexpr std::array<std::string_view, 8> azimuth_names{
    "azimuth", "azim", "azi", "az", "azm", "azimuthgrid", "azimuthtrue", "holeazimuth"};

constexpr std::array known_columns{
    KnownColumn{"md", dimension::length, depth_names, bare_depth_names},
    KnownColumn{"inclination", dimension::angle, inclination_names, {}},
    KnownColumn{"azimuth", dimension::angle, azimuth_names, {}},
};

/// Angle between the directions of two stations (rad), accurate for small angles too.
double dogleg(const SurveyStation& a, const SurveyStation& b) {
    const double tilt = std::sin(0.5 * (b.inclination - a.inclination));
    const double turn = std::sin(0.5 * (b.azimuth - a.azimuth));
    const double square =
        tilt * tilt + std::sin(a.inclination) * std::sin(b.inclination) * turn * turn;
    return 2 * std::asin(std::sqrt(std::clamp(square, 0.0, 1.0)));
}

bool turns_back(const SurveyStation& a, const SurveyStation& b) {
    return dogleg(a, b) > std::numbers::pi - least_distance_from_reversal;
}

/// Rows of a table.
class TableStations : public StationSource {
  public:
    TableStations(std::string text, std::string file)
        : table_(known_columns, std::move(text), std::move(file)) {
        const std::array standard{1.0, degree, degree};
        for (std::size_t k = 0; k < known_columns.size(); ++k) {
            index_[k] = table_.require_column(known_columns[k].name);
            factor_[k] = table_.column_factor(index_[k], known_columns[k].dimension, standard[k]);
        }
        refuse_depths_in_feet_beside();
    }

    [[nodiscard]] std::size_t count() const override { return table_.rows(); }
    [[nodiscard]] double value(std::size_t row, Part part) const override {
        const double value = table_.number(row, index_[part]) * factor_[part];
        if (!std::isfinite(value)) {
            throw InputError(
                where(row, part),
                fmt::format("{} is too large; expected a finite number in SI", text(row, part)));
        }
        return value;
    }
    [[nodiscard]] std::string text(std::size_t row, Part part) const override {
        return table_.text(row, index_[part]);
    }
    [[nodiscard]] std::string depth_unit(std::size_t) const override {
        const std::string& unit = table_.columns()[index_[measured_depth]].unit;
        return unit.empty() ? "m" : unit;
    }
    [[nodiscard]] SourceLocation where(std::size_t row, Part part) const override {
        return table_.where(row, index_[part]);
    }

  private:
    /// Depths without a unit are in metres, but hardly so beside other lengths in feet.
    void refuse_depths_in_feet_beside() const {
        const DelimitedTable::Column& depth = table_.columns()[index_[measured_depth]];
        if (!depth.unit.empty()) return;
        for (const DelimitedTable::Column& other : table_.columns()) {
            const std::optional<std::string> unit = known_unit(other.unit, dimension::length);
            if (!unit || unit_factor(*unit, dimension::length) == 1) continue;
            throw InputError(depth.where,
                             fmt::format("column md has no unit beside {} in {}; expected one, as "
                                         "in md[m] or md[{}]",
                                         other.name, *unit, *unit));
        }
    }

    DelimitedTable table_;
    std::array<std::size_t, 3> index_{};
    std::array<double, 3> factor_{};
};

class SurveyReader {
  public:
    explicit SurveyReader(const StationSource& source) : source_(source) {}

    [[nodiscard]] std::vector<SurveyStation> stations() const {
        std::vector<SurveyStation> result;
        for (std::size_t row = 0; row < source_.count(); ++row) {
            const SurveyStation next = station(row);
            if (!result.empty()) check_step(result.back(), next, row);
            result.push_back(next);
        }
        return result;
    }

  private:
    [[nodiscard]] SurveyStation station(std::size_t row) const {
        SurveyStation result{source_.value(row, StationSource::measured_depth),
                             source_.value(row, StationSource::inclination),
                             source_.value(row, StationSource::azimuth)};
        if (!plausible::coordinate.contains(result.measured_depth))
            throw InputError(source_.where(row, StationSource::measured_depth),
                             fmt::format("md is {}; expected {} m", depth_text(row),
                                         plausible::coordinate.describe()));
        if (result.inclination < 0 ||
            result.inclination > std::numbers::pi + inclination_rounding) {
            throw InputError(source_.where(row, StationSource::inclination),
                             fmt::format("inclination is {}; expected 0 to 180 degrees",
                                         source_.text(row, StationSource::inclination)));
        }
        result.inclination = std::min(result.inclination, std::numbers::pi);
        return result;
    }

    [[nodiscard]] std::string depth_text(std::size_t row) const {
        return fmt::format("{} {}", source_.text(row, StationSource::measured_depth),
                           source_.depth_unit(row));
    }

    void check_step(const SurveyStation& last, const SurveyStation& next, std::size_t row) const {
        if (next.measured_depth <= last.measured_depth) {
            throw InputError(source_.where(row, StationSource::measured_depth),
                             fmt::format("md is {} after {}; expected ascending measured depths",
                                         depth_text(row), depth_text(row - 1)));
        }
        if (turns_back(last, next)) {
            throw InputError(source_.where(row, StationSource::inclination),
                             "the well turns back by 180 degrees from the station before; expected "
                             "a smaller dogleg, which defines an arc");
        }
    }

    const StationSource& source_;
};

std::unique_ptr<StationSource> open_source(const std::filesystem::path& path,
                                           const SourceLocation& asked_at) {
    if (is_witsml(path)) return open_trajectory(path, asked_at);
    return std::make_unique<TableStations>(read_text_file(path, asked_at), path.string());
}

}  // namespace

Survey read_survey(const std::filesystem::path& path, const SourceLocation& asked_at) {
    const std::unique_ptr<StationSource> source = open_source(path, asked_at);
    if (source->count() > most_stations)
        throw InputError({path.string(), 1, 1},
                         fmt::format("the survey has {} stations; expected at most {}",
                                     source->count(), most_stations));
    Survey survey;
    survey.stations = SurveyReader(*source).stations();
    if (survey.stations.size() < 2) {
        throw InputError({path.string(), 1, 1},
                         fmt::format("the survey has {} stations; expected at least two",
                                     survey.stations.size()));
    }
    WrittenLengths::note_unit(source->depth_unit(0));
    survey.start = source->where(0, StationSource::measured_depth);
    survey.start_depth =
        fmt::format("{} {}", source->text(0, StationSource::measured_depth), source->depth_unit(0));
    return survey;
}

void tie_in(Survey& survey, TieIn above) {
    if (above == TieIn::start) return;
    const SurveyStation& first = survey.stations.front();
    const SurveyStation surface{0, 0, first.azimuth};
    if (turns_back(surface, first))
        throw InputError(survey.start,
                         "the well goes up at its first station; expected well.tie_in = \"start\", "
                         "as a vertical start would turn back by 180 degrees");
    survey.stations.insert(survey.stations.begin(), surface);
}

}  // namespace drillstrand
