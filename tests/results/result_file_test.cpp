#include "drillstrand/result_file.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "drillstrand/error.hpp"
#include "drillstrand/version.hpp"
#include "results/made_up_run.hpp"

namespace drillstrand {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

template <class Action>
std::string error_of(Action&& action) {
    try {
        action();
    } catch (const ResultError& error) {
        return error.what();
    }
    return "no error";
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    return names;
}

TEST(ResultFile, EveryDatasetComesBackBitForBit) {
    const ScratchFolder folder;
    MadeUpRun run(37);
    const ResultHeader header = run.header();
    const ResultFooter footer = run.footer("complete");
    std::vector<SeriesRecord> series;
    std::vector<Profile> profiles;
    ResultWriter writer(folder / "out.h5", header);
    // More samples than a chunk holds, and flushes that leave chunks partly filled.
    for (int k = 0; k < 5000; ++k) {
        series.push_back(run.series(0.1 * k));
        writer.append(series.back());
        if (k % 500 == 0) {
            profiles.push_back(run.profile(0.1 * k));
            writer.append(profiles.back());
        }
        if (k % 1300 == 0) writer.flush(run.footer("running"));
    }
    writer.close(footer);

    const Result result = read_result(folder / "out.h5");
    expect_same_bits(header, result.header, mesh_datasets());
    expect_same_bits(header, result.header, string_datasets());
    ASSERT_TRUE(result.header.well);
    for (const auto& entry : well_datasets())
        EXPECT_EQ(entry.values(*result.header.well), entry.values(*header.well)) << entry.path;
    expect_same_walls(*result.header.well, *header.well);
    ASSERT_EQ(result.series.size(), series.size());
    for (std::size_t k = 0; k < series.size(); ++k)
        expect_same_bits(series[k], result.series[k], series_datasets());
    ASSERT_EQ(result.profiles.size(), profiles.size());
    for (std::size_t k = 0; k < profiles.size(); ++k)
        expect_same_bits(profiles[k], result.profiles[k], profile_datasets());

    EXPECT_EQ(result.header.title, header.title);
    EXPECT_EQ(result.header.case_text, header.case_text);
    EXPECT_EQ(result.header.integrator, header.integrator);
    EXPECT_EQ(result.header.threads, header.threads);
    EXPECT_EQ(result.header.isa, header.isa);
    EXPECT_EQ(result.version, version());
    EXPECT_EQ(result.commit, commit());
    EXPECT_EQ(result.footer.status, "complete");
    EXPECT_EQ(result.footer.wall_seconds, footer.wall_seconds);
    EXPECT_EQ(result.footer.energy_residual, footer.energy_residual);
    EXPECT_EQ(result.footer.stick_slip_index, footer.stick_slip_index);
    EXPECT_EQ(result.footer.stuck_share, footer.stuck_share);
    EXPECT_EQ(result.footer.unloaded_share, footer.unloaded_share);
    EXPECT_EQ(result.footer.warnings, footer.warnings);
    EXPECT_EQ(result.footer.findings, footer.findings);
    EXPECT_EQ(result.footer.statistics.steps, footer.statistics.steps);
    EXPECT_EQ(result.footer.statistics.rejected, footer.statistics.rejected);
    EXPECT_EQ(result.footer.statistics.evaluations, footer.statistics.evaluations);
    EXPECT_EQ(result.footer.statistics.smallest_step, footer.statistics.smallest_step);
    EXPECT_EQ(result.footer.statistics.largest_step, footer.statistics.largest_step);
}

TEST(ResultFile, IsReadableWhileItIsWritten) {
    const ScratchFolder folder;
    MadeUpRun run(5);
    ResultWriter writer(folder / "out.h5", run.header());
    EXPECT_EQ(read_result(folder / "out.h5").series.size(), 0U);
    writer.append(run.series(0));
    writer.append(run.profile(0));
    writer.flush(run.footer("running"));
    const Result result = read_result(folder / "out.h5");
    EXPECT_EQ(result.footer.status, "running");
    EXPECT_EQ(result.footer.statistics.steps, run.footer("").statistics.steps);
    EXPECT_EQ(result.series.size(), 1U);
    EXPECT_EQ(result.profiles.size(), 1U);
}

TEST(ResultFile, AWriterThatIsDroppedLeavesWhatWasAppended) {
    const ScratchFolder folder;
    MadeUpRun run(5);
    {
        ResultWriter writer(folder / "out.h5", run.header());
        writer.append(run.series(0));
    }
    const Result result = read_result(folder / "out.h5");
    EXPECT_EQ(result.series.size(), 1U);
    EXPECT_EQ(result.footer.status, "running");
}

TEST(ResultFile, StartsSmallWhateverItsChunks) {
    const ScratchFolder folder;
    MadeUpRun run(300);
    ResultHeader header = run.header();
    header.case_text = "title = \"Pozzo\"\n";
    ResultWriter writer(folder / "out.h5", header);
    writer.append(run.series(0));
    writer.close(run.footer("complete"));
    // a chunk of 512 numbers for each component of a series, two of them for its tables
    std::size_t chunks = 2 * series_datasets().size();
    for (const auto& entry : series_datasets())
        chunks += entry.components;
    EXPECT_LT(fs::file_size(folder / "out.h5"), chunks * 4096);
}

TEST(ResultFile, ReplacesAnOlderResultAndLeavesNothingElse) {
    const ScratchFolder folder;
    MadeUpRun run(5);
    ResultWriter(folder / "out.h5", run.header()).append(run.series(0));
    ResultWriter(folder / "out.h5", run.header()).close(run.footer("complete"));
    EXPECT_EQ(read_result(folder / "out.h5").series.size(), 0U);
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("out.h5"));
}

TEST(ResultFile, FollowsALinkToTheFileItNames) {
    const ScratchFolder folder;
    MadeUpRun run(5);
    std::ofstream(folder / "elsewhere.h5") << "older";
    fs::create_symlink("elsewhere.h5", folder / "out.h5");
    ResultWriter(folder / "out.h5", run.header()).close(run.footer("complete"));
    EXPECT_TRUE(fs::is_symlink(folder / "out.h5"));
    EXPECT_EQ(read_result(folder / "elsewhere.h5").footer.status, "complete");
}

TEST(ResultFile, AFolderOrADeviceCannotBeWritten) {
    const ScratchFolder folder;
    MadeUpRun run(5);
    EXPECT_EQ(error_of([&] { ResultWriter(folder.path(), run.header()); }),
              folder.path().string() + ": cannot write: Is a directory");
    EXPECT_EQ(error_of([&] { ResultWriter("/dev/full", run.header()); }),
              "/dev/full: cannot write: not a regular file");
    EXPECT_EQ(error_of([&] { ResultWriter(folder / "no/out.h5", run.header()); }),
              (folder / "no/out.h5").string() + ": cannot write: No such file or directory");
}

TEST(ResultFile, AFileThatMayNotBeWrittenStaysAsItWas) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
    const ScratchFolder folder;
    MadeUpRun run(5);
    ResultWriter(folder / "out.h5", run.header()).close(run.footer("complete"));
    fs::permissions(folder / "out.h5", fs::perms::owner_read);
    EXPECT_THAT(error_of([&] { ResultWriter(folder / "out.h5", run.header()); }),
                EndsWith(": cannot write: Permission denied"));
    EXPECT_EQ(read_result(folder / "out.h5").footer.status, "complete");
}

TEST(ResultFile, ReadingSomethingElseSaysSo) {
    const ScratchFolder folder;
    EXPECT_EQ(error_of([&] { read_result(folder / "no.h5"); }),
              (folder / "no.h5").string() + ": cannot read: No such file or directory");
    std::ofstream(folder / "text.h5") << "title = \"not a result\"\n";
    EXPECT_THAT(error_of([&] { read_result(folder / "text.h5"); }),
                AllOf(StartsWith((folder / "text.h5").string()), HasSubstr("not a result file")));
    EXPECT_THAT(error_of([&] { read_result(folder.path()); }), HasSubstr("Is a directory"));
}

TEST(ResultFile, ACutOffFileIsAnErrorAndNoCrash) {
    const ScratchFolder folder;
    MadeUpRun run(20);
    ResultWriter writer(folder / "out.h5", run.header());
    for (int k = 0; k < 50; ++k) {
        writer.append(run.series(k));
        writer.append(run.profile(k));
    }
    writer.close(run.footer("complete"));
    fs::resize_file(folder / "out.h5", fs::file_size(folder / "out.h5") / 2);
    EXPECT_THAT(error_of([&] { read_result(folder / "out.h5"); }),
                AllOf(HasSubstr("cannot read"), testing::Not(HasSubstr("\n"))));
}

/// The shape as the README writes it.
template <class Record>
std::string shape_text(const RecordDataset<Record>& entry, const std::string& records) {
    std::vector<std::string> extents;
    if (!records.empty()) extents.push_back(records);
    if (entry.rows == Rows::nodes) extents.push_back("(N+1)");
    if (entry.rows == Rows::segments) extents.push_back("N");
    if (entry.components > 1) extents.push_back(std::to_string(entry.components));
    std::string text;
    for (const std::string& extent : extents)
        text += (text.empty() ? "" : " x ") + extent;
    return text;
}

template <class Record>
void expect_described(const std::string& readme, const std::vector<RecordDataset<Record>>& layout,
                      const std::string& records) {
    for (const auto& entry : layout)
        EXPECT_THAT(readme, HasSubstr("| `" + entry.path + "` | " + shape_text(entry, records) +
                                      " | " + entry.units + " | " + entry.description + " |"));
}

TEST(ResultFile, TheReadmeListsEveryDataset) {
    const std::string readme = text_of(DRILLSTRAND_SOURCE_DIR "/engine/results/README.md");
    expect_described(readme, mesh_datasets(), "");
    expect_described(readme, string_datasets(), "");
    for (const auto& entry : well_datasets())
        EXPECT_THAT(readme, HasSubstr("| `" + entry.path + "` | " + entry.extent +
                                      (entry.components > 1 ? " x 3" : "") + " | " + entry.units +
                                      " | " + entry.description + " |"));
    expect_described(readme, series_datasets(), "T");
    expect_described(readme, profile_datasets(), "P");
    expect_described(readme, sensor_datasets("NAME"), "K");
    expect_described(readme, cycle_datasets(), "");
}

TEST(ResultFile, HasNoWellAndNoStringWhereTheHeaderHasNone) {
    const ScratchFolder folder;
    ResultHeader header = MadeUpRun(3).header();
    header.well.reset();
    header.outer_radius.clear();
    ResultWriter(folder / "out.h5", header).close({});
    const Result result = read_result(folder / "out.h5");
    EXPECT_FALSE(result.header.well);
    EXPECT_TRUE(result.header.outer_radius.empty());
    EXPECT_TRUE(result.header.yield_torque.empty());
    EXPECT_EQ(result.header.node_s, header.node_s);
}

TEST(ResultFile, OtherProgramsFindEveryDatasetWithUnitsAndDescription) {
    const std::string python = "/usr/bin/python3";
    if (std::system((python + " -c 'import h5py' 2>/dev/null").c_str()) != 0)
        GTEST_SKIP() << "h5py is not installed";
    const ScratchFolder folder;
    MadeUpRun run(7);
    ResultWriter writer(folder / "out.h5", run.header());
    for (int k = 0; k < 4; ++k)
        writer.append(run.series(k));
    for (int k = 0; k < 2; ++k)
        writer.append(run.profile(k));
    writer.flush(run.footer("running"));
    // The script runs while the writer has the file open.
    const std::string command = python +
                                " '" DRILLSTRAND_SOURCE_DIR "/tests/results/open_with_h5py.py' " +
                                (folder / "out.h5").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace drillstrand
