/// The small bends that a drilled hole has and a planned one has not, added to a survey:
/// engine/model/README.md, "Tortuosity".
#pragma once

#include <cstdint>
#include <vector>

#include "drillstrand/case.hpp"
#include "input/value.hpp"

namespace drillstrand {

enum class TortuosityModel { sine, helical, random };

struct Tortuosity {
    TortuosityModel model = TortuosityModel::sine;
    double build = 0;   ///< amplitude in the vertical plane (rad)
    double turn = 0;    ///< amplitude across it (rad)
    double period = 0;  ///< m
    std::uint64_t seed = 0;
    double from = 0;  ///< measured depths between which the hole is tortuous (m)
    double to = 0;
};

/// The table well.tortuosity. Throws InputError where something is wrong.
Tortuosity read_tortuosity(const Value& value, const std::vector<SurveyStation>& survey);

/// The survey with stations every twelfth of a period (random: every period) besides its own, all
/// tilted by the tortuosity.
std::vector<SurveyStation> with_tortuosity(const std::vector<SurveyStation>& survey,
                                           const Tortuosity& tortuosity);

}  // namespace drillstrand
