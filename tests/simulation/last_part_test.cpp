// What a run says of the whirl of its string and of the weight that does not arrive, from records
// made by hand.
#include "drillstrand/last_part.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "simulation/pipe_in_hole.hpp"

namespace drillstrand::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A pipe in a hole whose loads change until `loads_end` (s).
Scene scene_with(double loads_end, bool in_well = true) {
    Case input = in_well ? pipe_in_hole() : plain_pipe();
    input.bit.weight = ScalarSchedule({0, loads_end}, {0, 65e3});
    return build_scene(input);
}

/// Records every 0.1 s until 30 s of a string that rotates, each completed by `fill`.
LastPart part_of(const Scene& scene, const std::function<void(SeriesRecord&)>& fill) {
    LastPart part(scene, 1);
    for (int k = 0; k <= 300; ++k) {
        SeriesRecord record;
        record.time = 0.1 * k;
        record.head_rotation_rate = 11.5;
        record.weight_on_bit = 65e3;
        record.hook_load = 220e3;
        record.energy.rotation = 20e3;
        record.energy.kinetic = 20e3;
        fill(record);
        part.add(record);
    }
    return part;
}

/// What the part says of a subject; empty where it says nothing.
std::string finding(const LastPart& part, const std::string& subject) {
    for (const std::string& line : part.findings())
        if (line.starts_with(subject + ": ")) return line;
    return "";
}

void roll(SeriesRecord& record) {
    record.whirl = {0.02, 0.9, -40, -41, 260};
    record.energy.kinetic = 50e3;
}

TEST(LastPart, IsTheLastThirdOfTheRunAfterTheLastPointOfItsSchedules) {
    const auto late = [](SeriesRecord& record) {
        if (record.time > 19.95) roll(record);
    };
    EXPECT_THAT(finding(part_of(scene_with(18), late), "whirl"),
                AllOf(HasSubstr("in the last 10 s:"), HasSubstr("90 % of the string backward"),
                      HasSubstr("2 % forward"), HasSubstr("-40 rad/s"), HasSubstr("-41 rad/s"),
                      HasSubstr("260 m"), HasSubstr("50 kJ, 2.5 times that of rotation")));
    const auto later = [](SeriesRecord& record) {
        if (record.time > 24.95) roll(record);
    };
    EXPECT_THAT(finding(part_of(scene_with(18), later), "whirl"), HasSubstr("45 % of the string"));
    EXPECT_THAT(finding(part_of(scene_with(24.99), later), "whirl"),
                AllOf(HasSubstr("in the last 5 s:"), HasSubstr("90 % of the string")));
}

TEST(LastPart, MeansOfRateAndDepthAreThoseOfWhatWhirls) {
    const LastPart part = part_of(scene_with(18), [](SeriesRecord& record) {
        const bool even = std::lround(10 * record.time) % 2 == 0;  // 51 of 101 records
        record.whirl = even ? Whirl{0, 0.8, -30, -41, 100} : Whirl{0, 0.2, -10, -41, 300};
    });
    // (51 0.8 30 + 50 0.2 10) / (51 0.8 + 50 0.2), and likewise 100 and 300
    EXPECT_THAT(finding(part, "whirl"),
                AllOf(HasSubstr("at -26.1 rad/s"), HasSubstr("at 139.4 m")));
}

TEST(LastPart, WarnsOfAStringThatRollsBackwardAndSaysWhatWouldTellWhetherItIsReal) {
    EXPECT_THAT(part_of(scene_with(18), roll).warnings(),
                ElementsAre(AllOf(HasSubstr("90 % of the string rolls in backward whirl"),
                                  HasSubstr("0.98 of the rate without slip"), HasSubstr("260 m"),
                                  HasSubstr("mesh.segments"), HasSubstr("run.cfl"),
                                  HasSubstr("fluid.added_mass"), Not(HasSubstr("\n")))));
    const LastPart slower = part_of(scene_with(18), [](SeriesRecord& record) {
        record.whirl = {0, 0.4, -20, -41, 260};
    });
    EXPECT_THAT(slower.warnings(), ElementsAre(HasSubstr("40 % of the string slides")));
}

TEST(LastPart, AStringThatSwingsOrWhirlsForwardOrLittleIsNoReasonToWarn) {
    for (const Whirl& whirl :
         {Whirl{0.5, 0.45, 1, -41, 260}, Whirl{0.9, 0, 8, -41, 260}, Whirl{0, 0.28, -40, -41, 260}})
        EXPECT_THAT(
            part_of(scene_with(18), [&](SeriesRecord& record) { record.whirl = whirl; }).warnings(),
            IsEmpty());
}

TEST(LastPart, WarnsOfWeightThatTheWallsTakeFromARotatingStringUnderConstantLoads) {
    const auto drag = [](double force, double rotation) {
        return [=](SeriesRecord& record) {
            record.wall_drag = force;
            record.drag_depth = 306;
            record.head_rotation_rate = rotation;
        };
    };
    const LastPart locked = part_of(scene_with(18), drag(29.25e3, 11.5));
    EXPECT_THAT(
        finding(locked, "walls"),
        AllOf(HasSubstr("29.25 kN down the well"), HasSubstr("306 m"),
              HasSubstr("weight on bit 65 kN (0.45 of it)"), HasSubstr("hook load 220 kN")));
    EXPECT_THAT(locked.warnings(),
                ElementsAre(AllOf(HasSubstr("weight does not arrive"), HasSubstr("down the well"),
                                  HasSubstr("29.25 kN"), HasSubstr("0.45 times the weight on bit"),
                                  HasSubstr("306 m"))));
    EXPECT_THAT(part_of(scene_with(18), drag(-29.25e3, -11.5)).warnings(),
                ElementsAre(HasSubstr("up the well")));
    EXPECT_THAT(part_of(scene_with(18), drag(12e3, 11.5)).warnings(), IsEmpty());
    EXPECT_THAT(part_of(scene_with(18), drag(29.25e3, 0)).warnings(), IsEmpty());
    const LastPart changing = part_of(scene_with(40), drag(29.25e3, 11.5));
    EXPECT_THAT(finding(changing, "walls"),
                HasSubstr("in the last 10 s, before loads are constant"));
    EXPECT_THAT(changing.warnings(), IsEmpty());
}

TEST(LastPart, FrictionThatIsLittleBesideTheHookLoadIsNoLock) {
    const LastPart light = part_of(scene_with(18), [](SeriesRecord& record) {
        record.weight_on_bit = 10e3;
        record.wall_drag = 4e3;
        record.hook_load = 220e3;
    });
    EXPECT_THAT(light.warnings(), IsEmpty());  // 0.4 of the weight on bit, 0.018 of the hook load
}

/// A bit whose rate swings about 6 rad/s with an amplitude, three times until 30 s.
std::function<void(SeriesRecord&)> swing(double amplitude) {
    return [=](SeriesRecord& record) {
        record.head_rotation_rate = 6;
        record.bit_rotation_rate =
            6 + amplitude * std::sin(2 * std::numbers::pi * record.time / 10);
    };
}

TEST(LastPart, StickSlipIndexOfASineIsItsAmplitudeOverItsMean) {
    for (const auto& [amplitude, word] : std::vector<std::pair<double, std::string>>{
             {2, "low"}, {4.2, "moderate"}, {6.6, "full stick-slip"}}) {
        const LastPart part = part_of(scene_with(18), swing(amplitude));
        // 10 s, of which the last record is one of the first again; the sine's top is at a record
        EXPECT_NEAR(part.bit().stick_slip_index, amplitude / 6, 2e-3 * amplitude);
        EXPECT_THAT(finding(part, "stick-slip"), HasSubstr("(" + word + ")"));
    }
}

TEST(LastPart, ABitIsStuckWhereItStandsOrTurnsBack) {
    // below 0.1 rad/s: sin < - 5.9 / 8, 0.2362 of the time, 23 of 101 records
    const LastPart part = part_of(scene_with(18), swing(8));
    EXPECT_NEAR(part.bit().stuck, 0.2362, 0.01);
    EXPECT_THAT(finding(part, "stick-slip"), HasSubstr("stuck for 23 % of the time"));
    const LastPart mirrored = part_of(scene_with(18), [](SeriesRecord& record) {
        swing(8)(record);
        record.head_rotation_rate *= -1;
        record.bit_rotation_rate *= -1;
    });
    EXPECT_EQ(mirrored.bit().stuck, part.bit().stuck);
    EXPECT_EQ(mirrored.bit().stick_slip_index, part.bit().stick_slip_index);
    const LastPart standing = part_of(scene_with(18), [](SeriesRecord&) {});
    EXPECT_EQ(standing.bit().stuck, 1);
    EXPECT_THAT(finding(standing, "stick-slip"), HasSubstr("the bit hardly turns"));
}

TEST(LastPart, ABitBouncesWhereTheStringAboveItIsNotCompressed) {
    const auto press = [](double mean) {
        return [=](SeriesRecord& record) {
            record.bit_stress[3] = -mean - 80e3 * std::sin(2 * std::numbers::pi * record.time / 10);
        };
    };
    const LastPart bouncing = part_of(scene_with(18), press(40e3));
    EXPECT_NEAR(bouncing.bit().unloaded, 1.0 / 3, 0.02);  // sin <= - 1/2
    EXPECT_THAT(finding(bouncing, "bounce"), HasSubstr("-40 to 120 kN"));
    EXPECT_EQ(part_of(scene_with(18), press(81e3)).bit().unloaded, 0);
    const LastPart off_bottom = part_of(scene_with(18), [&](SeriesRecord& record) {
        press(0)(record);
        record.weight_on_bit = 0;
    });
    EXPECT_EQ(off_bottom.bit().unloaded, 0);
    EXPECT_EQ(finding(off_bottom, "bounce"), "");
}

TEST(LastPart, SaysNothingOfWallsWithoutAWellNorOfARunThatHasHardlyBegun) {
    const LastPart in_the_open = part_of(scene_with(18, false), roll);
    EXPECT_EQ(finding(in_the_open, "whirl"), "");
    EXPECT_EQ(finding(in_the_open, "walls"), "");
    EXPECT_NE(finding(in_the_open, "stick-slip"), "");
    LastPart young(scene_with(18), 1);
    for (const double time : {0.0, 0.5, 1.0}) {
        SeriesRecord record;
        record.time = time;
        roll(record);
        young.add(record);
    }
    EXPECT_THAT(young.findings(), IsEmpty());
    EXPECT_THAT(young.warnings(), IsEmpty());
}

}  // namespace
}  // namespace drillstrand::test
