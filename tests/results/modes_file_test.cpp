/// Files of modes of vibration, written and read back.
#include "drillstrand/modes_file.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "drillstrand/error.hpp"
#include "drillstrand/version.hpp"
#include "results/made_up_run.hpp"

namespace drillstrand {
namespace {

/// Vibrations that no string has, with every value different.
ModesResult made_up_modes(std::size_t segments) {
    ModesResult result;
    result.header = MadeUpRun(segments).header();
    double value = 0.1;
    const auto next = [&] { return value *= -1.01; };
    const auto numbers = [&](std::size_t count) {
        std::vector<double> list(count);
        std::generate(list.begin(), list.end(), next);
        return list;
    };
    const auto vectors = [&] {
        std::vector<Eigen::Vector3d> list(segments + 1);
        for (Eigen::Vector3d& vector : list)
            vector = Eigen::Vector3d::NullaryExpr(next);
        return list;
    };
    result.rotation_rate = next();
    result.grip = WallGrip::slides;
    result.shape = {vectors(), vectors(), numbers(segments + 1)};
    for (const ModeKind kind : {ModeKind::lateral, ModeKind::torsional, ModeKind::axial}) {
        result.modes.push_back({next(), kind, next(), next(), next(), next(), 7, next(), vectors(),
                                vectors(), vectors(), vectors()});
        result.campbell.push_back({next(), next(), kind, next()});
        result.critical_speeds.push_back({next(), next(), kind, next()});
        result.response.push_back({next(), next(), 1, numbers(segments + 1), numbers(segments + 1),
                                   numbers(segments + 1), numbers(segments), numbers(segments),
                                   numbers(segments)});
    }
    result.excitation = Excitation{next(), true, next(), next()};
    return result;
}

template <class Record>
void expect_same_lists(const std::vector<Record>& written, const std::vector<Record>& read,
                       const std::vector<RecordDataset<Record>>& layout) {
    ASSERT_EQ(written.size(), read.size());
    for (std::size_t k = 0; k < written.size(); ++k)
        expect_same_bits(written[k], read[k], layout);
}

TEST(ModesFile, EverythingComesBackBitForBit) {
    const ScratchFolder folder;
    const ModesResult written = made_up_modes(11);
    write_modes(folder / "modes.h5", written);
    EXPECT_TRUE(holds_modes(folder / "modes.h5"));
    const ModesResult read = read_modes(folder / "modes.h5");
    EXPECT_EQ(read.header.title, written.header.title);
    EXPECT_EQ(read.header.case_text, written.header.case_text);
    EXPECT_EQ(read.header.node_s, written.header.node_s);
    EXPECT_EQ(read.header.segment_s, written.header.segment_s);
    EXPECT_EQ(read.version, version());
    EXPECT_EQ(read.commit, commit());
    EXPECT_EQ(read.rotation_rate, written.rotation_rate);
    EXPECT_EQ(read.grip, WallGrip::slides);
    expect_same_bits(written.shape, read.shape, static_shape_datasets());
    expect_same_lists(written.modes, read.modes, mode_datasets());
    expect_same_lists(written.campbell, read.campbell, campbell_datasets());
    expect_same_lists(written.critical_speeds, read.critical_speeds, critical_speed_datasets());
    expect_same_lists(written.response, read.response, response_datasets());
    ASSERT_TRUE(read.excitation);
    EXPECT_EQ(read.excitation->order, written.excitation->order);
    EXPECT_TRUE(read.excitation->unbalance);
    EXPECT_EQ(read.excitation->bit_force, written.excitation->bit_force);
    EXPECT_EQ(read.excitation->bit_torque, written.excitation->bit_torque);
}

TEST(ModesFile, WhatWasNotAskedForIsNotThere) {
    const ScratchFolder folder;
    ModesResult written = made_up_modes(3);
    written.campbell.clear();
    written.critical_speeds.clear();
    written.response.clear();
    written.excitation.reset();
    write_modes(folder / "modes.h5", written);
    const ModesResult read = read_modes(folder / "modes.h5");
    EXPECT_EQ(read.modes.size(), 3U);
    EXPECT_TRUE(read.campbell.empty());
    EXPECT_TRUE(read.critical_speeds.empty());
    EXPECT_TRUE(read.response.empty());
    EXPECT_FALSE(read.excitation);
}

TEST(ModesFile, AKindOfModeThatThereIsNotIsRefused) {
    const ScratchFolder folder;
    ModesResult written = made_up_modes(3);
    written.modes[1].kind = static_cast<ModeKind>(7);
    write_modes(folder / "modes.h5", written);
    EXPECT_THROW(read_modes(folder / "modes.h5"), ResultError);
}

TEST(ModesFile, ARunIsNotTakenForModes) {
    const ScratchFolder folder;
    MadeUpRun run(5);
    ResultWriter(folder / "run.h5", run.header()).close(run.footer("complete"));
    EXPECT_FALSE(holds_modes(folder / "run.h5"));
    EXPECT_THROW(read_modes(folder / "run.h5"), ResultError);
}

TEST(ModesFile, TheReadmeListsEveryDataset) {
    std::ostringstream readme;
    readme << std::ifstream(DRILLSTRAND_SOURCE_DIR "/engine/results/README.md").rdbuf();
    const auto expect_listed = [&](const auto& layout, const std::string& count) {
        for (const auto& entry : layout) {
            std::string shape = count;
            if (entry.rows != Rows::one) shape += shape.empty() ? "" : " x ";
            if (entry.rows == Rows::nodes) shape += "N+1";
            if (entry.rows == Rows::segments) shape += "N";
            if (entry.components > 1) shape += " x " + std::to_string(entry.components);
            EXPECT_THAT(readme.str(),
                        testing::HasSubstr("| `" + entry.path + "` | " + shape + " | " +
                                           entry.units + " | " + entry.description + " |"));
        }
    };
    expect_listed(static_shape_datasets(), "");
    expect_listed(mode_datasets(), "M");
    expect_listed(campbell_datasets(), "C");
    expect_listed(critical_speed_datasets(), "K");
    expect_listed(response_datasets(), "R");
}

}  // namespace
}  // namespace drillstrand
