// A run that is left and taken up again must go on as if it had never been left: to the last bit,
// with any number of threads, at any moment.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "drillstrand/simulation.hpp"
#include "support/both_integrators.hpp"
#include "support/dice.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

bool same_bits(double a, double b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// A state in which all that is kept has a part to play: contact, mud, friction, own shape,
/// damping, schedules that go on.
struct Scenario {
    std::string name;
    std::string text;
};

std::string pipe_in_well(const std::string& more) {
    return R"(
        [[string.component]]
        length = 180
        linear_density = 60.0
        outer_diameter = 0.15
        inner_diameter = 0.12
        youngs_modulus = "200 GPa"
        [fluid]
        density = 1200
        viscosity = 0.02
        [mesh]
        segments = 60
        [head]
        rotation = [[0, 0], [0.2, "2 Hz"]]
        [bit]
        weight = [[0.05, 0], [0.4, "30 kN"]]
        torque = [[0.05, 0], [0.4, "2 kN m"]]
        [contact]
        normal_stiffness = 1e6
        normal_damping = 1e4
        tangential_stiffness = 1e5
        [run]
        duration = 1
        )" +
           more;
}

/// A node that begins at 9.6 m goes over the casing shoe soon after the start.
std::vector<WellSectionCase> casing_and_open_hole() {
    WellSectionCase casing{.to = 9.6005, .diameter = 0.2};
    casing.static_friction = casing.dynamic_friction = {0.1, 0.2};
    WellSectionCase open{.to = 200, .diameter = 0.19};
    open.normal_stiffness = 2e6;
    return {casing, open};
}

Case case_of(const Scenario& scenario, IntegratorKind kind) {
    Case input = case_from(scenario.text);
    if (scenario.name != "FreeHead") {
        WellCase hole;
        hole.survey = {{0, 0.4, 0.4}, {60, 0.45, 0.35}, {120, 0.6, 0.42}, {200, 0.7, 0.5}};
        hole.sections = {{100, 0.22}, {200, 0.2}};
        if (scenario.name == "OverAShoe") hole.sections = casing_and_open_hole();
        input.well = hole;
    }
    if (scenario.name == "PapersLawDamped") input.contact.law = FrictionLaw::paper;
    if (scenario.name == "PumpedMud") {
        input.fluid->flow_index = 0.7;
        input.fluid->yield_stress = 2;
        input.fluid->flow_rate = 0.03;
    }
    if (scenario.name == "Bouncing") input.contact.restitution = 0.8;
    input.run.integrator = kind;
    if (scenario.name == "SlippingBit" && kind == IntegratorKind::leapfrog) {
        input.bit.law = BitLaw::stribeck;
        input.bit.static_torque = 300;
        input.bit.dynamic_torque = 100;
        input.bit.decay_speed = 1;
        input.bit.inertia = 2;
        input.head.drive = DriveCase{
            .control = DriveControl::tuned, .inertia = 20, .frequency = 3, .torque_limit = 2000};
        input.contact.stribeck_speed = 0.2;
    }
    if (scenario.name == "CuttingBit" && kind == IntegratorKind::leapfrog) {
        input.bit.law = BitLaw::cutting;
        input.bit.weight = {};
        input.bit.torque = {};
        input.bit.cutting = {.blades = 5,
                             .specific_energy = 2e7,
                             .wear_flat = 1e-3,
                             .contact_strength = 2e7,
                             .flat_friction = 0.5};
        input.bit.feed = ScalarSchedule(0.01);
        input.bit.off_bottom = 1e-4;
    }
    if (scenario.name == "Jar" && kind == IntegratorKind::leapfrog)
        input.string.components[0].jar =
            JarCase{.position = 60, .up_force = 2e3, .up_travel = 0.2, .delay = 0.02};
    if (scenario.name == "MovedHead") {
        input.head.tilting = {{0, 0.5, 1}, {{0, 0, 0}, {0, 0.02, -0.01}, {0, 0, 0}}};
        input.head.velocity = {{0, 0.5, 1}, {{0, 0, 0}, {0.5, 0.02, 0}, {-0.5, 0, 0.01}}};
    }
    if (scenario.name == "PinnedHead") input.head.motion = HeadMotion::pinned;
    if (scenario.name == "Hoist" && kind == IntegratorKind::leapfrog) {
        AutodrillerCase driller;
        driller.weight = DrillerLoop{20e3, 1e-6, 1};
        driller.rate = DrillerLoop{0.2, 0.5, 1};
        HoistCase& hoist = input.head.hoist.emplace();
        hoist.mass = 2e3;
        hoist.line_stiffness = 1e6;
        hoist.lines = 4;
        hoist.autodriller = driller;
        input.head.slips = {{0.3, 0.4}};
    }
    return input;
}

const std::vector<Scenario> scenarios = {
    {"Drilling", pipe_in_well("")},
    {"PapersLawDamped", pipe_in_well("[damping]\ninternal = 1\nexternal = 2\nkelvin_voigt = 1e-5\n"
                                     "[initial]\noffset = [0.01, 0, 0]\n")},
    {"SlippingBit", pipe_in_well("")},
    {"CuttingBit", pipe_in_well("")},
    {"PumpedMud", pipe_in_well("")},
    {"Jar", pipe_in_well("")},
    {"MovedHead", pipe_in_well("")},
    {"PinnedHead", pipe_in_well("")},
    {"Hoist", pipe_in_well("")},
    {"Bouncing", pipe_in_well("[initial]\noffset = [0.01, 0, 0]\n")},
    {"OverAShoe", R"(
        [[string.component]]
        length = 24
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        youngs_modulus = "200 GPa"
        [mesh]
        segments = 40
        [head]
        motion = "free"
        [initial]
        offset = [-0.03, 0, 0]
        [contact]
        normal_stiffness = 1e6
        normal_damping = 1e4
        [run]
        duration = 1
        )"},
    {"FreeHead", R"(
        [[string.component]]
        length = 24
        linear_density = 34.0
        outer_diameter = 0.14
        inner_diameter = 0.11
        youngs_modulus = "200 GPa"
        curvature = [0.01, 0.02, -0.03]
        [mesh]
        segments = 40
        [head]
        motion = "free"
        force = [[0, [0, 0, 0]], [0.1, [1000, 200, 0]]]
        moment = [10, 20, 30]
        [run]
        duration = 1
        )"},
};

void expect_same(const SavedState& a, const SavedState& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].name, b[i].name);
        ASSERT_EQ(a[i].values.size(), b[i].values.size());
        for (std::size_t k = 0; k < a[i].values.size(); ++k)
            ASSERT_TRUE(same_bits(a[i].values[k], b[i].values[k]))
                << a[i].name << ' ' << k << ": " << a[i].values[k] << " and " << b[i].values[k];
    }
}

class RestartOf : public testing::TestWithParam<std::tuple<IntegratorKind, Scenario>> {
  protected:
    RestartOf() : input_(case_of(std::get<1>(GetParam()), std::get<0>(GetParam()))) {
        if (input_.run.integrator == IntegratorKind::dormand_prince)
            step_ = scene_.well ? 0.002 : 0.0004;
    }
    [[nodiscard]] std::unique_ptr<Integrator> integrator(int threads) const {
        IntegratorOptions options = integrator_options(input_.run);
        options.threads = threads;
        return make_integrator(scene_, options);
    }
    Case input_;
    Scene scene_ = starting_scene(input_);
    double step_ = 0.05;  ///< between records (s)
};

TEST_P(RestartOf, GoesOnBitForBitWhereverItWasLeftWithAnyNumberOfThreads) {
    constexpr int records = 8;
    const auto whole = integrator(1);
    for (int k = 1; k <= records; ++k)
        whole->advance(k * step_, 1'000'000);

    Dice dice(7);
    for (int trial = 0; trial < 6; ++trial) {
        const int threads = 1 + trial % 3;
        const auto left = integrator(threads);
        const int at = static_cast<int>(dice.between(0, records));
        for (int k = 1; k <= at; ++k)
            left->advance(k * step_, 1'000'000);
        // in the middle of a course
        left->advance((at + 1) * step_, static_cast<std::int64_t>(dice.between(0, 40)));
        const SavedState saved = left->save();

        const auto resumed = integrator(4 - threads);
        resumed->restore(saved);
        expect_same(resumed->save(), saved);
        for (int k = at + 1; k <= records; ++k)
            resumed->advance(k * step_, 1'000'000);
        expect_same(resumed->save(), whole->save());
        EXPECT_EQ(resumed->series().energy.work, whole->series().energy.work);
        EXPECT_EQ(resumed->statistics().steps, whole->statistics().steps);
        EXPECT_EQ(resumed->warnings(), whole->warnings());
    }
}

TEST_P(RestartOf, ARunThatIsNotThisOneIsRefusedAndLeavesTheRunAsItWas) {
    const auto run = integrator(1);
    run->advance(step_, 1'000'000);
    const SavedState before = run->save();
    SavedState shorter = before;
    shorter.pop_back();
    EXPECT_THROW(run->restore(shorter), std::invalid_argument);
    SavedState renamed = before;
    renamed.front().name += "?";
    EXPECT_THROW(run->restore(renamed), std::invalid_argument);
    SavedState cut = before;
    cut.front().values.pop_back();
    EXPECT_THROW(run->restore(cut), std::invalid_argument);
    for (const double count : {-1.0, 1e300, std::nan("")}) {
        SavedState uncountable = before;
        for (SavedRow& row : uncountable)
            if (row.name.ends_with("/impacts")) row.values.front() = count;
        EXPECT_THROW(run->restore(uncountable), std::invalid_argument);
    }
    if (scene_.well) {
        SavedState lost = before;
        for (SavedRow& row : lost) {
            if (row.name == "wall/arc") row.values[3] = 1e9;
        }
        EXPECT_THROW(run->restore(lost), std::invalid_argument);
    }
    expect_same(run->save(), before);
}

INSTANTIATE_TEST_SUITE_P(Of, RestartOf,
                         testing::Combine(testing::Values(IntegratorKind::dormand_prince,
                                                          IntegratorKind::leapfrog),
                                          testing::ValuesIn(scenarios)),
                         [](const auto& instance) {
                             return integrator_label(std::get<0>(instance.param)) +
                                    std::get<1>(instance.param).name;
                         });

}  // namespace
}  // namespace drillstrand::test
