#include <gmock/gmock.h>

#include <numbers>

#include "report_units.hpp"

namespace drillstrand::program {
namespace {

/// NIST Special Publication 811: a foot is 0.3048 m, a pound of force 4.4482216152605 N.
TEST(PageUnits, ConvertByTheirDefinitions) {
    constexpr double foot = 0.3048;
    constexpr double pound_force = 4.4482216152605;
    EXPECT_DOUBLE_EQ(page_unit::length.field, foot);
    EXPECT_DOUBLE_EQ(page_unit::small_length.field, foot / 12);
    EXPECT_DOUBLE_EQ(page_unit::force.field, 1000 * pound_force);
    EXPECT_DOUBLE_EQ(page_unit::moment.field, 1000 * foot * pound_force);
    EXPECT_DOUBLE_EQ(page_unit::energy.field, 1000 * foot * pound_force);
    EXPECT_DOUBLE_EQ(page_unit::side_force.field, pound_force / foot);
    EXPECT_DOUBLE_EQ(page_unit::stress.field, 1000 * 144 * pound_force / (foot * foot));
    EXPECT_DOUBLE_EQ(page_unit::rotation.field, std::numbers::pi / 30);
}

TEST(PageUnits, ReachTheScriptWithNameAndFactor) {
    EXPECT_THAT(units_json(), testing::HasSubstr(
                                  R"("length":{"si":["m",1],"field":["ft",0.30480000000000002]})"));
}

}  // namespace
}  // namespace drillstrand::program
