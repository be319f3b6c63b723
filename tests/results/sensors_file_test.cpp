// Sensors and cycles in a result file: written as the run goes on, read, gone on with.
#include <gmock/gmock.h>

#include "drillstrand/error.hpp"
#include "drillstrand/result_file.hpp"
#include "results/made_up_run.hpp"

namespace drillstrand {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::size_t segments = 9;

ResultHeader header() {
    ResultHeader header = MadeUpRun(segments).header();
    header.cycles = CyclesCase{0.02, 3.5};
    header.sensors = {{"mwd", 1200.5, 0.06, 0.005}, {"near-bit_2", 1299, 0, 0.01}};
    return header;
}

/// A record that can be made again from its number.
SensorRecord sensed(int k) {
    return MadeUpRun(segments, static_cast<unsigned>(k)).sensor(k);
}

SeriesRecord sample(int k) {
    return MadeUpRun(segments, static_cast<unsigned>(k)).series(k);
}

/// Two records of the first sensor for each of the second and of the series.
void append(ResultWriter& writer, int first, int last) {
    for (int k = first; k < last; ++k) {
        writer.append(0, sensed(2 * k));
        writer.append(0, sensed(2 * k + 1));
        writer.append(1, sensed(k));
        writer.append(sample(k));
        if (k % 100 == 0) writer.flush({});
    }
}

void expect_records(const Result& result, std::size_t count) {
    ASSERT_EQ(result.sensors.size(), 2U);
    ASSERT_EQ(result.sensors[0].size(), 2 * count);
    ASSERT_EQ(result.sensors[1].size(), count);
    for (std::size_t k = 0; k < 2 * count; ++k)
        expect_same_bits(result.sensors[0][k], sensed(static_cast<int>(k)), sensor_datasets("mwd"));
}

TEST(SensorsFile, HoldsWhatTheRunRecorded) {
    const ScratchFolder folder;
    ResultFooter footer;
    footer.cycles = MadeUpRun(segments).cycles();
    {
        ResultWriter writer(folder / "out.h5", header());
        append(writer, 0, 700);
        writer.close(footer);
    }
    const Result result = read_result(folder / "out.h5");
    expect_records(result, 700);
    EXPECT_EQ(result.header.sensors[0].name, "mwd");
    EXPECT_EQ(result.header.sensors[0].depth, 1200.5);
    EXPECT_EQ(result.header.sensors[0].radius, 0.06);
    EXPECT_EQ(result.header.sensors[1].interval, 0.01);
    EXPECT_EQ(result.header.cycles->interval, 0.02);
    EXPECT_EQ(result.header.cycles->slope, 3.5);
    EXPECT_EQ(result.footer.cycles.cycles, footer.cycles.cycles);
    EXPECT_EQ(result.footer.cycles.largest_range, footer.cycles.largest_range);
    EXPECT_EQ(result.footer.cycles.equivalent_range, footer.cycles.equivalent_range);
}

TEST(SensorsFile, IsReadableWhileTheRunGoesOn) {
    const ScratchFolder folder;
    ResultWriter writer(folder / "out.h5", header());
    const Result before = read_result(folder / "out.h5");
    EXPECT_TRUE(before.sensors.at(0).empty());
    EXPECT_EQ(before.footer.cycles.cycles, std::vector<double>(segments, 0.0));
    append(writer, 0, 201);
    writer.flush({});
    expect_records(read_result(folder / "out.h5"), 201);
}

TEST(SensorsFile, IsGoneOnWithFromTheRecordsThatAreKept) {
    const ScratchFolder folder;
    {
        ResultWriter writer(folder / "out.h5", header());
        append(writer, 0, 650);
    }
    ResultWriter writer = ResultWriter::resume(folder / "out.h5", header(), 600, 0, {1200, 600});
    append(writer, 600, 800);
    writer.close({});
    expect_records(read_result(folder / "out.h5"), 800);
}

TEST(SensorsFile, WithFewerRecordsThanAreToBeKeptIsNotGoneOnWith) {
    const ScratchFolder folder;
    {
        ResultWriter writer(folder / "out.h5", header());
        append(writer, 0, 10);
    }
    try {
        ResultWriter::resume(folder / "out.h5", header(), 10, 0, {21, 10});
        FAIL();
    } catch (const ResultError& error) {
        EXPECT_THAT(error.what(), HasSubstr("/sensors/mwd/time holds 20 records, not 21"));
    }
}

// names become files of an export
TEST(SensorsFile, WithNamesThatNoCaseMayGiveIsRefused) {
    const ScratchFolder folder;
    ResultHeader bad = header();
    bad.sensors[0].name = "..";
    ResultWriter(folder / "out.h5", bad).close({});
    EXPECT_THROW(read_result(folder / "out.h5"), ResultError);
}

}  // namespace
}  // namespace drillstrand
