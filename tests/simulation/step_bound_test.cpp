// The leapfrog's steps against its stability bound: strings of which each of the bounds governs
// one, below it and beyond it.
#include "drillstrand/step_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/simulation.hpp"

namespace drillstrand::test {
namespace {

using Eigen::Vector3d;

/// A rod of 40 segments of 1 m and 1 kg, clamped at its head; the bit is hit in all directions.
Case struck_rod() {
    Case input;
    input.gravity = 0;
    Component rod;
    rod.length = 40;
    rod.linear_density = 1;
    rod.inertia = 1;
    rod.polar_inertia = 1;
    rod.axial_stiffness = 100;
    rod.shear_stiffness = 100;
    rod.bending_stiffness = 100;
    rod.torsional_stiffness = 100;
    input.string.components = {rod};
    input.mesh.segments = 40;
    const double small = 1e-3;
    input.bit.force = VectorSchedule({0.1, 0.11}, {small * Vector3d(1, 2, 3), Vector3d::Zero()});
    input.bit.moment = VectorSchedule({0.1, 0.11}, {small * Vector3d(1, 2, 3), Vector3d::Zero()});
    input.run.integrator = IntegratorKind::leapfrog;
    return input;
}

/// How much the energy of the rod grows within so many steps after it was hit; infinite where the
/// run fails.
double growth(const Case& input, double cfl, std::int64_t steps) {
    const Scene scene = build_scene(input);
    IntegratorOptions options;
    options.cfl = cfl;
    options.stress_limit = 0;
    const auto integrator = make_integrator(scene, options);
    const auto energy = [&] { return integrator->series().energy.stored(); };
    const double step = cfl * step_bound(scene, IntegratorKind::leapfrog).step;
    constexpr double hit = 0.12;  // just after: what turns grows no more once it goes round
    constexpr int records = 20;
    try {
        integrator->advance(hit, 1'000'000);
        const double before = energy();
        double most = 0;
        for (int i = 1; i <= records; ++i) {
            const double later = hit + i * static_cast<double>(steps) / records * step;
            integrator->advance(later, steps);
            if (!std::isfinite(energy())) return INFINITY;
            most = std::max(most, energy());
        }
        return most / before;
    } catch (const SimulationError&) {
        return INFINITY;
    }
}

struct Governed {
    std::string name;
    std::string process;
    void (*stiffen)(Component&);
};

const Governed governed[] = {
    {"AxialWaves", "axial waves", [](Component& rod) { rod.axial_stiffness = 1e5; }},
    {"TorsionalWaves", "torsional waves", [](Component& rod) { rod.torsional_stiffness = 1e5; }},
    {"Zigzags", "bending of neighbouring nodes",
     [](Component& rod) {
         rod.shear_stiffness = 1e5;
         rod.inertia = rod.polar_inertia = 100;
         rod.bending_stiffness = 1000;
     }},
    {"Bending", "bending of neighbouring nodes",
     [](Component& rod) { rod.bending_stiffness = 1e5; }},
    {"TurningAsFastAsAxialWaves", "axial waves",
     [](Component& rod) {
         rod.shear_stiffness = 1e5;
         rod.inertia = 1e-5;
         rod.polar_inertia = 1;
         rod.bending_stiffness = 0.3;
     }},
};

class StepBoundOf : public testing::TestWithParam<Governed> {
  protected:
    static Case rod() {
        Case input = struck_rod();
        GetParam().stiffen(input.string.components[0]);
        return input;
    }
};
INSTANTIATE_TEST_SUITE_P(Leapfrog, StepBoundOf, testing::ValuesIn(governed),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(StepBoundOf, NamesTheProcessThatSetsIt) {
    EXPECT_EQ(step_bound(build_scene(rod()), IntegratorKind::leapfrog).process, GetParam().process);
}

TEST_P(StepBoundOf, KeepsAStruckRodForTwentyThousandSteps) {
    EXPECT_LT(growth(rod(), 0.9, 20'000), 1.5);
}

TEST_P(StepBoundOf, IsSharp) {
    EXPECT_GT(growth(rod(), 1.1, 2'000), 1e6);
}

TEST_P(StepBoundOf, CountsKelvinVoigtDamping) {
    Case input = rod();
    const double rate = step_bound(build_scene(input), IntegratorKind::leapfrog).rate;
    for (const double ratio : {0.2, 5.0}) {
        input.damping.kelvin_voigt = ratio / rate;
        EXPECT_LT(growth(input, 0.9, 20'000), 1.5) << ratio;
        EXPECT_GT(growth(input, 1.15, 2'000), 1e6) << ratio;
    }
}

/// A string of one to four random parts, of any number of segments, with a free or a driven head.
Case random_rod(std::mt19937& random) {
    const auto between = [&](double low, double high) {
        return low * std::pow(high / low, std::uniform_real_distribution(0.0, 1.0)(random));
    };
    Case input = struck_rod();
    const Component model = input.string.components[0];
    input.string.components.clear();
    const int parts = std::uniform_int_distribution(1, 4)(random);
    for (int i = 0; i < parts; ++i) {
        Component part = model;
        part.length = between(1, 20);
        part.linear_density = between(0.3, 3);
        part.inertia = between(1e-2, 1);
        part.polar_inertia = between(1e-2, 1);
        part.axial_stiffness = between(10, 1e4);
        part.shear_stiffness = between(10, 1e4);
        part.bending_stiffness = between(10, 1e4);
        part.torsional_stiffness = between(10, 1e4);
        input.string.components.push_back(part);
    }
    input.mesh.segments = std::uniform_int_distribution(1, 40)(random);
    if (std::bernoulli_distribution()(random)) input.head.motion = HeadMotion::free;
    return input;
}

TEST(StepBound, HoldsForRandomStringsOfSeveralComponents) {
    std::mt19937 random(20'240'501);
    for (int i = 0; i < 200; ++i) {
        const Case input = random_rod(random);
        EXPECT_LT(growth(input, 0.99, 2'000), 10)
            << "string " << i << " of " << input.mesh.segments << " segments";
    }
}

}  // namespace
}  // namespace drillstrand::test
