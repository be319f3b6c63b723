/// Strings and wells that the tests of statics share.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "drillstrand/case.hpp"
#include "support/dice.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {

/// The pipes of tables 2 and 3 of Galasso, Santelli, Zambetti, Giusteri (2024).
inline const std::string table_2_pipe = R"(
[string]
shear_coefficient = 1.0
[[string.component]]
length = 24
inner_diameter = 0.1155
outer_diameter = 0.1397
linear_density = 34.2277
youngs_modulus = "200 GPa"
poisson_ratio = 0.0
)";
inline constexpr double table_2_bending_stiffness = 1992118.251;  // N m2
inline constexpr double table_2_shear_stiffness = 485049339.344;  // N: E A / 2

inline std::string table_3_pipe(double length) {
    return fmt::format(R"(
[string]
shear_coefficient = 1.0
[[string.component]]
length = {:.17g}
inner_diameter = 0.12
outer_diameter = 0.14
linear_density = 31.8557
youngs_modulus = "200 GPa"
poisson_ratio = 0.0
)",
                       length);
}
inline constexpr double table_3_bending_stiffness = 1735729.9411083623;  // N m2

/// A rod given by its stiffnesses, with a thickness for the wall to touch.
struct Stiffness {
    double length, bending, torsional, axial, shear;
};
inline std::string rod(const Stiffness& s, const std::string& more = "") {
    return fmt::format(R"(
[[string.component]]
length = {:.17g}
outer_diameter = 0.1
linear_density = 1
inertia = 1e-6
bending_stiffness = {:.17g}
torsional_stiffness = {:.17g}
axial_stiffness = {:.17g}
shear_stiffness = {:.17g}
{}
)",
                       s.length, s.bending, s.torsional, s.axial, s.shear, more);
}

inline std::string mesh(int segments) {
    return fmt::format("[run]\nduration = 1\n[mesh]\nsegments = {}\n", segments);
}

/// A well of one diameter through stations of measured depth (m), inclination and azimuth (rad).
inline WellCase well_through(std::vector<SurveyStation> survey, double diameter) {
    return {std::move(survey), {{1e9, diameter}}};
}

}  // namespace drillstrand::test
