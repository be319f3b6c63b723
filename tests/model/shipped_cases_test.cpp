/// The cases under cases/ as a user finds them: they read, and string and well fit each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "drillstrand/case.hpp"
#include "drillstrand/drill_string.hpp"
#include "drillstrand/well.hpp"

namespace drillstrand {
namespace {

const std::filesystem::path cases = std::filesystem::path(DRILLSTRAND_SOURCE_DIR) / "cases";

double string_length(const Case& input) {
    double length = 0;
    for (const Component& component : input.string.components)
        length += component.length;
    return length;
}

class ShippedCase : public testing::TestWithParam<std::string> {};

TEST_P(ShippedCase, HasAWellLongerAndWiderThanItsString) {
    const Case input = read_case(cases / (GetParam() + ".toml"));
    ASSERT_TRUE(input.well);
    const Well well(*input.well);
    EXPECT_GE(well.measured_depth_end() - well.measured_depth_start(), string_length(input));
    double depth = well.measured_depth_start();
    for (const Component& component : input.string.components) {
        const double end = depth + component.length;
        for (const WellArc& arc : well.arcs()) {
            const bool overlaps =
                arc.measured_depth_start < end && depth < arc.measured_depth_start + arc.length;
            if (overlaps) {
                EXPECT_GT(2 * arc.radius, component.outer_diameter) << component.name;
            }
        }
        depth = end;
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, ShippedCase,
                         testing::Values("vertical_20kN", "vertical_50kN", "vertical_100kN",
                                         "horizontal_350kN", "horizontal_500kN", "horizontal_1MN",
                                         "well1", "well2", "well2_drilling", "well3", "well1_paper",
                                         "well2_paper", "well2_drilling_paper", "well3_paper",
                                         "torque_drag", "pumped_mud"),
                         [](const auto& instance) { return instance.param; });

TEST(ShippedCases, HaveThePaperLengthsAndMeshes) {
    struct Expected {
        const char* name;
        double length;
        int segments;
    };
    for (const auto& [name, length, segments] : {Expected{"cantilever", 24, 64},
                                                 {"vertical_50kN", 1000, 200},
                                                 {"well1", 515, 86},
                                                 {"well2", 2254, 322},
                                                 {"well2_drilling", 2254, 322},
                                                 {"well3", 1911, 294},
                                                 {"well1_paper", 515, 86},
                                                 {"well2_paper", 2254, 322},
                                                 {"well2_drilling_paper", 2254, 322},
                                                 {"well3_paper", 1911, 294}}) {
        const Case input = read_case(cases / (std::string(name) + ".toml"));
        EXPECT_NEAR(string_length(input), length, 1e-9) << name;
        EXPECT_EQ(input.mesh.segments, segments) << name;
    }
}

/// The paper's fluid is in creeping flow, leaves nodes in contact alone and does not move along
/// with the string; its springs keep what they hold.
void expect_the_forms_of_the_paper(const Case& input) {
    ASSERT_TRUE(input.fluid);
    EXPECT_EQ(input.fluid->regime, FlowRegime::laminar);
    EXPECT_FALSE(input.fluid->contact_drag);
    EXPECT_FALSE(input.fluid->added_mass);
    EXPECT_EQ(input.contact.rolling_creep, 0);
    EXPECT_EQ(input.contact.static_friction.axial, 0.6);
    EXPECT_EQ(input.contact.dynamic_friction.azimuthal, 0.42);
    EXPECT_EQ(input.damping.internal.translation, 1e-2);
    EXPECT_EQ(input.initial.state, InitialState::coaxial);
}

TEST(ShippedCases, BucklingInAWellHasTheFormsOfThePaper) {
    for (const char* name : {"vertical_20kN", "vertical_50kN", "vertical_100kN", "horizontal_350kN",
                             "horizontal_500kN", "horizontal_1MN"}) {
        SCOPED_TRACE(name);
        expect_the_forms_of_the_paper(read_case(cases / (std::string(name) + ".toml")));
    }
}

// Springs: section 4.1 and the captions of figures 23, 25 and 24 (Pa, Pa s, Pa).
TEST(ShippedCases, OfThePaperHaveItsSpringsAndTheOthersStiffOnes) {
    struct Expected {
        std::string name;
        double normal_stiffness;
        double normal_damping;
        double tangential_stiffness;
    };
    for (const auto& [name, stiffness, damping, tangential] : {Expected{"well1", 1e4, 1e4, 0.5e4},
                                                               {"well2", 1e5, 1e5, 1e3},
                                                               {"well2_drilling", 1e6, 1e6, 10},
                                                               {"well3", 1e6, 1e6, 10}}) {
        SCOPED_TRACE(name);
        const Case paper = read_case(cases / (name + "_paper.toml"));
        expect_the_forms_of_the_paper(paper);
        EXPECT_EQ(paper.fluid->axial_drag, AxialDrag::concentric);
        EXPECT_EQ(paper.contact.normal_stiffness, stiffness);
        EXPECT_EQ(paper.contact.normal_damping, damping);
        EXPECT_EQ(paper.contact.tangential_stiffness, tangential);

        const Case shipped = read_case(cases / (name + ".toml"));
        EXPECT_EQ(shipped.initial.state, InitialState::equilibrium);
        EXPECT_EQ(shipped.fluid->regime, FlowRegime::inertial);
        EXPECT_TRUE(shipped.fluid->contact_drag);
        EXPECT_TRUE(shipped.fluid->added_mass);
        EXPECT_EQ(shipped.contact.normal_stiffness, 1e7);
        EXPECT_EQ(shipped.contact.tangential_stiffness, 1e6);
        // to be compared at the same times
        EXPECT_EQ(shipped.run.duration, paper.run.duration);
        for (double time = 0; time <= paper.run.duration; time += 0.5) {
            EXPECT_EQ(shipped.head.rotation(time), paper.head.rotation(time)) << time;
            EXPECT_EQ(shipped.bit.weight(time), paper.bit.weight(time)) << time;
            EXPECT_EQ(shipped.bit.torque(time), paper.bit.torque(time)) << time;
        }
    }
}

TEST(ShippedCases, WellsHaveTheShapesOfThePaper) {
    const auto well_of = [](const char* name) { return *read_case(cases / name).well; };
    const auto steepest = [](const WellCase& well) {
        double inclination = 0;
        for (const SurveyStation& station : well.survey)
            inclination = std::max(inclination, station.inclination);
        return inclination;
    };
    const double degree = 0.017453292519943295;
    EXPECT_LT(steepest(well_of("well1.toml")), 8 * degree);
    EXPECT_LT(steepest(well_of("well2.toml")), 8 * degree);

    // Doglegs of more than 1.5 degrees per 30 m in four places, at least 300 m apart.
    const WellCase well2 = well_of("well2.toml");
    const std::vector<double> severities = dogleg_severities(well2.survey);
    int doglegs = 0;
    double last = -1000;
    for (std::size_t k = 0; k < severities.size(); ++k) {
        if (severities[k] < 1.5 * degree / 30) continue;
        if (well2.survey[k].measured_depth - last > 300) ++doglegs;
        last = well2.survey[k].measured_depth;
    }
    EXPECT_EQ(doglegs, 4);

    // More than half of the well within 5 degrees of the horizontal.
    double level = 0;
    const WellCase well3 = well_of("well3.toml");
    for (std::size_t k = 0; k + 1 < well3.survey.size(); ++k)
        if (well3.survey[k].inclination > 85 * degree)
            level += well3.survey[k + 1].measured_depth - well3.survey[k].measured_depth;
    EXPECT_GT(level, 0.5 * 1911);
}

}  // namespace
}  // namespace drillstrand
