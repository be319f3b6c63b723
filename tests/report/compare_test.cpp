/// What drillstrand report computes before a browser sees it.
#include <gmock/gmock.h>

#include <cmath>

#include "commands.hpp"
#include "report_compare.hpp"
#include "report_data.hpp"
#include "report_string.hpp"

namespace drillstrand::program {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

/// Hook load and torque that grow by 10 N and 1 N m in a second, for 10 s.
std::vector<SeriesRecord> ramp() {
    std::vector<SeriesRecord> series(11);
    for (int k = 0; k <= 10; ++k) {
        series[static_cast<std::size_t>(k)].time = k;
        series[static_cast<std::size_t>(k)].hook_load = 10 * k;
        series[static_cast<std::size_t>(k)].surface_torque = k;
    }
    return series;
}

TEST(Comparison, AShiftedAndScaledCopyIsFullyCorrelated) {
    MeasuredChannels measured;
    for (double time = 100.5; time < 110; time += 1) {
        measured.time.push_back(time);
        measured.hook_load.push_back(7 + 30 * (time - 100));
        measured.torque.push_back(5 - (time - 100));
    }
    const auto channels = compare(measured, -100, ramp());
    ASSERT_EQ(channels.size(), 2U);
    EXPECT_EQ(channels[0].points, 10U);
    EXPECT_DOUBLE_EQ(channels[0].simulated.mean, 50);
    EXPECT_DOUBLE_EQ(channels[0].simulated.least, 5);
    EXPECT_DOUBLE_EQ(channels[0].simulated.greatest, 95);
    EXPECT_DOUBLE_EQ(channels[0].measured.mean, 157);
    EXPECT_NEAR(channels[0].correlation.value(), 1, 1e-14);
    EXPECT_DOUBLE_EQ(channels[1].simulated.mean, 5);
    EXPECT_NEAR(channels[1].correlation.value(), -1, 1e-14);
}

TEST(Comparison, OnlyTimesThatBothHaveCount) {
    const MeasuredChannels measured{{-5, 0, 2, 10, 11}, {1, 2, 3, 4, 5}, {}};
    const auto channels = compare(measured, 0, ramp());
    ASSERT_EQ(channels.size(), 1U);
    EXPECT_EQ(channels[0].points, 3U);
    EXPECT_DOUBLE_EQ(channels[0].measured.mean, 3);
    EXPECT_DOUBLE_EQ(channels[0].simulated.mean, 40);
}

TEST(Comparison, AConstantChannelHasNoCorrelation) {
    const MeasuredChannels measured{{1, 2, 3}, {4, 4, 4}, {}};
    EXPECT_FALSE(compare(measured, 0, ramp())[0].correlation.has_value());
}

TEST(Comparison, ClocksWithoutCommonTimesAreRefused) {
    const MeasuredChannels measured{{100, 101}, {1, 2}, {}};
    EXPECT_THAT([&] { compare(measured, 0, ramp()); },
                ThrowsMessage<UsageError>(HasSubstr("--offset")));
}

TEST(ReportPicks, AreEvenAndKeepTheEnds) {
    EXPECT_THAT(pick_evenly(5, 10), ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(pick_evenly(8, 4), ElementsAre(0, 2, 4, 6, 7));
    EXPECT_THAT(pick_evenly(0, 4), IsEmpty());
}

// RFC 4648, section 10: "foobar" and its beginnings, here the bytes of numbers.
TEST(ReportData, ArraysComeInBase64AsBrowsersReadThem) {
    ArrayBlock block;
    block.add("a", {1.0});         // 00 00 80 3f
    block.add_exact("b", {-2.0});  // four bytes of padding, then 00 00 00 00 00 00 00 c0
    EXPECT_EQ(block.base64(), "AACAPwAAAAAAAAAAAAAAwA==");
    EXPECT_EQ(block.json(), R"({"a":{"type":"f32","shape":[1],"offset":0},)"
                            R"("b":{"type":"f64","shape":[1],"offset":8}})");
}

TEST(ReportData, TextCannotEndTheElementThatHoldsIt) {
    EXPECT_EQ(json_text("</script>\"\\\n\xc2\xb0"),
              "\"\\u003c/script\\u003e\\\"\\\\\\u000a\xc2\xb0\"");
    EXPECT_EQ(json_number(std::nan("")), "null");
}

// Pure tension, bending or torque at its yield load is yield; tension and bending add up in the
// outer fibre, torque with them as von Mises has it.
TEST(YieldShare, IsOneAtEachYieldLoad) {
    ResultHeader header;
    header.yield_tension = {100};
    header.yield_bending = {10};
    header.yield_torque = {5};
    const auto share = [&](double torque, double bending1, double bending2, double axial) {
        Vector6 stress = Vector6::Zero();
        stress.head<4>() << torque, bending1, bending2, axial;
        return yield_share(header, 0, stress);
    };
    EXPECT_DOUBLE_EQ(share(0, 0, 0, -100), 1);
    EXPECT_DOUBLE_EQ(share(0, 6, -8, 0), 1);
    EXPECT_DOUBLE_EQ(share(-5, 0, 0, 0), 1);
    EXPECT_DOUBLE_EQ(share(4, 3, 0, 300 * 0), 0.85440037453175311);
    EXPECT_DOUBLE_EQ(share(3, 1, 0, 30), 0.72111025509279786);
}

}  // namespace
}  // namespace drillstrand::program
