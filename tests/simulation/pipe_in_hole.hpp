/// A plain pipe of 60 m, alone or in a straight hole: what tests of a run's summary share.
#pragma once

#include <string>

#include "support/run_case.hpp"

namespace drillstrand::test {

inline Case plain_pipe(const std::string& more = "") {
    return case_from(R"(
        [[string.component]]
        length = 60
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        youngs_modulus = "200 GPa"
        [mesh]
        segments = 12
        [run]
        duration = 1
        )" + more);
}

/// The same in a vertical hole, with 50 mm of clearance.
inline Case pipe_in_hole(const std::string& more = "") {
    Case input = plain_pipe(more);
    WellCase hole;
    hole.survey = {{0, 0, 0}, {100, 0, 0}};
    hole.sections = {{100, 0.24}};
    input.well = hole;
    return input;
}

}  // namespace drillstrand::test
