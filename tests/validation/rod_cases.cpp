#include "validation/rod_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace drillstrand::test {

namespace {

std::string steel_pipe(double length, double inner, double outer, double mass) {
    return fmt::format(R"(
[[string.component]]
length = {:.17g}
inner_diameter = {}
outer_diameter = {}
linear_density = {}
youngs_modulus = "200 GPa"
poisson_ratio = 0.0
)",
                       length, inner, outer, mass);
}

}  // namespace

std::string table_2_pipe(double length) {
    return steel_pipe(length, 0.1155, 0.1397, 34.2277);
}

std::string table_3_pipe(double length) {
    return steel_pipe(length, 0.12, 0.14, 31.8557);
}

std::string table_4_pipe(double length) {
    return steel_pipe(length, 0.2266, 0.2445, 52.0925);
}

std::string section_component(const Section& s, const std::string& more) {
    return fmt::format(R"(
[[string.component]]
length = {:.17g}
linear_density = {:.17g}
inertia = {:.17g}
polar_inertia = {:.17g}
bending_stiffness = {:.17g}
torsional_stiffness = {:.17g}
axial_stiffness = {:.17g}
shear_stiffness = {:.17g}
)",
                       s.length, s.mass, s.inertia, 2 * s.inertia, s.bending, s.torsional, s.axial,
                       s.shear) +
           more + "\n";
}

std::string mesh_and_run(IntegratorKind integrator, int segments, bool segment_inertia,
                         double duration) {
    return fmt::format(R"(
[mesh]
segments = {}
segment_inertia = {}
[run]
integrator = "{}"
duration = {:.17g}
stress_limit = 0
threads = 1
)",
                       segments, segment_inertia,
                       integrator == IntegratorKind::leapfrog ? "leapfrog" : "dormand-prince",
                       duration);
}

double stretch_by_cubics(const std::vector<HangingPart>& parts, double h) {
    double stretch = -parts.back().weight * h * h / (12 * parts.back().stiffness);
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const HangingPart& upper = parts[i - 1];
        const HangingPart& lower = parts[i];
        stretch += (lower.weight - upper.weight) * h * h / 24 *
                   (1 / upper.stiffness + 1 / lower.stiffness);
    }
    return stretch;
}

std::string list(const Eigen::Vector3d& v) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

Eigen::Vector3d tip_at_rest(const std::string& toml, double rest) {
    const Run result = run(toml + "\n[output]\ninterval = 1\nprofile_interval = 0\n");
    double moved = 0;
    for (const SeriesRecord& record : result.series)
        moved = std::max({moved, record.energy.elastic, record.energy.work});
    EXPECT_LT(result.last().energy.kinetic, rest * rest * moved) << "not yet at rest";
    return result.last().bit_position;
}

}  // namespace drillstrand::test
