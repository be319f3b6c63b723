/// Files of buckling modes, written and read back.
#include "drillstrand/buckling_file.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "drillstrand/error.hpp"
#include "drillstrand/version.hpp"
#include "results/made_up_run.hpp"

namespace drillstrand {
namespace {

namespace fs = std::filesystem;

/// Modes that no string has, with every value different.
BucklingResult made_up_modes(std::size_t segments, std::size_t count) {
    BucklingResult result;
    result.header = MadeUpRun(segments).header();
    result.discretisation = Discretisation::paper;
    double value = 0.1;
    const auto next = [&] { return value *= -1.01; };
    const auto strain = [&] {
        std::vector<Vector6> strains(segments);
        for (Vector6& segment : strains)
            segment = Vector6::NullaryExpr(next);
        return strains;
    };
    result.instability.emplace(Instability{next(), {}});
    for (std::size_t k = 0; k < count; ++k) {
        result.modes.push_back({next(), strain()});
        result.instability->modes.push_back({next(), strain()});
    }
    return result;
}

TEST(BucklingFile, EveryModeComesBackBitForBit) {
    const ScratchFolder folder;
    const BucklingResult written = made_up_modes(11, 5);
    write_buckling(folder / "modes.h5", written);
    EXPECT_TRUE(holds_buckling(folder / "modes.h5"));
    const BucklingResult read = read_buckling(folder / "modes.h5");
    EXPECT_EQ(read.header.title, written.header.title);
    EXPECT_EQ(read.header.case_text, written.header.case_text);
    EXPECT_EQ(read.header.node_s, written.header.node_s);
    EXPECT_EQ(read.header.segment_s, written.header.segment_s);
    EXPECT_EQ(read.discretisation, Discretisation::paper);
    EXPECT_EQ(read.version, version());
    EXPECT_EQ(read.commit, commit());
    ASSERT_EQ(read.modes.size(), written.modes.size());
    for (std::size_t k = 0; k < written.modes.size(); ++k)
        expect_same_bits(written.modes[k], read.modes[k], buckling_datasets());
    ASSERT_TRUE(read.instability);
    EXPECT_EQ(read.instability->load, written.instability->load);
    ASSERT_EQ(read.instability->modes.size(), written.instability->modes.size());
    for (std::size_t k = 0; k < written.instability->modes.size(); ++k)
        expect_same_bits(written.instability->modes[k], read.instability->modes[k],
                         instability_datasets());
}

TEST(BucklingFile, AStableStringHasALoadAndNoShapes) {
    const ScratchFolder folder;
    BucklingResult written = made_up_modes(3, 2);
    written.instability->modes.clear();
    write_buckling(folder / "modes.h5", written);
    const BucklingResult read = read_buckling(folder / "modes.h5");
    ASSERT_TRUE(read.instability);
    EXPECT_EQ(read.instability->load, written.instability->load);
    EXPECT_TRUE(read.instability->modes.empty());
}

TEST(BucklingFile, WithoutALoadThereIsNoGroupForIt) {
    const ScratchFolder folder;
    BucklingResult written = made_up_modes(3, 2);
    written.instability.reset();
    write_buckling(folder / "modes.h5", written);
    EXPECT_FALSE(read_buckling(folder / "modes.h5").instability);
}

TEST(BucklingFile, ReplacesAnOlderOneAndLeavesNothingElse) {
    const ScratchFolder folder;
    write_buckling(folder / "modes.h5", made_up_modes(3, 5));
    write_buckling(folder / "modes.h5", made_up_modes(3, 1));
    EXPECT_EQ(read_buckling(folder / "modes.h5").modes.size(), 1U);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(BucklingFile, WhereNothingCanBeWrittenNothingIsLeft) {
    const ScratchFolder folder;
    EXPECT_THROW(write_buckling(folder.path(), made_up_modes(3, 1)), ResultError);
    EXPECT_THROW(write_buckling(folder / "no/modes.h5", made_up_modes(3, 1)), ResultError);
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(BucklingFile, ARunIsNotTakenForModes) {
    const ScratchFolder folder;
    MadeUpRun run(5);
    ResultWriter(folder / "run.h5", run.header()).close(run.footer("complete"));
    EXPECT_FALSE(holds_buckling(folder / "run.h5"));
    EXPECT_THROW(read_buckling(folder / "run.h5"), ResultError);
    EXPECT_THROW(holds_buckling(folder / "no.h5"), ResultError);
}

TEST(BucklingFile, TheReadmeListsEveryDataset) {
    std::ostringstream readme;
    readme << std::ifstream(DRILLSTRAND_SOURCE_DIR "/engine/results/README.md").rdbuf();
    const auto expect_listed = [&](const auto& layout, const std::string& count) {
        for (const auto& entry : layout) {
            const std::string shape = entry.rows == Rows::one ? count : count + " x N x 6";
            EXPECT_THAT(readme.str(),
                        testing::HasSubstr("| `" + entry.path + "` | " + shape + " | " +
                                           entry.units + " | " + entry.description + " |"));
        }
    };
    expect_listed(buckling_datasets(), "M");
    expect_listed(instability_datasets(), "U");
}

}  // namespace
}  // namespace drillstrand
