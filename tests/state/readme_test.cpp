// The README of engine/state lists what a run consists of, no more and no less.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "rod/director_state.hpp"
#include "rod/strand_state.hpp"
#include "state/rows.hpp"

namespace drillstrand {
namespace {

using Lines = std::vector<std::string>;

/// Lines of a table in the README, by the heading above it.
Lines described(const std::string& heading) {
    std::ifstream readme(DRILLSTRAND_SOURCE_DIR "/engine/state/README.md");
    Lines lines;
    bool there = false;
    for (std::string line; std::getline(readme, line);) {
        if (line.starts_with('#')) there = line == "### " + heading;
        if (there && line.starts_with("| `")) lines.push_back(line);
    }
    return lines;
}

template <class Row>
void expect_described(const std::string& heading) {
    Lines lines;
    for (const RowInfo<Row>& info : row_list<Row>)
        lines.push_back(fmt::format("| `{}` | {} | {} | {} | {} | {} |", info.name, info.unit,
                                    info.width, info.extent == Extent::nodes ? "nodes" : "segments",
                                    info.keep == Keep::kept ? "kept" : "derived", info.stage));
    EXPECT_THAT(described(heading), testing::ElementsAreArray(lines)) << heading;
}

template <class Record>
std::string kind(double Record::*) {
    return "number";
}
template <class Record>
std::string kind(std::int64_t Record::*) {
    return "whole number";
}
template <class Record>
std::string kind(std::vector<double> Record::*) {
    return "list";
}
template <class Record, int size>
std::string kind(Eigen::Matrix<double, size, 1> Record::*) {
    return fmt::format("{} numbers", size);
}

template <class Record>
void expect_record_described(const std::string& heading) {
    Lines lines;
    for (const Field<Record>& field : field_list<Record>)
        lines.push_back(
            fmt::format("| `{}` | {} | {} | {} |", field.name, field.unit,
                        std::visit([](auto member) { return kind<Record>(member); }, field.member),
                        field.meaning));
    EXPECT_THAT(described(heading), testing::ElementsAreArray(lines)) << heading;
}

/// Names of parts and what they are.
template <class State>
void expect_parts_described(const std::string& heading) {
    Lines names;
    State state;
    State::parts(state, [&](const std::string& name, auto&) { names.push_back(name); });
    Lines listed;
    for (const std::string& line : described(heading))
        listed.push_back(line.substr(3, line.find('`', 3) - 3));
    EXPECT_EQ(listed, names) << heading;
}

TEST(StateReadme, ListsEveryRowAsItIs) {
    expect_described<DirectorRow>("DirectorRow");
    expect_described<StrandRow>("StrandRow");
    expect_described<WallRow>("WallRow");
}

TEST(StateReadme, ListsEveryFieldOfEveryRecordAsItIs) {
    expect_record_described<HeadState>("HeadState");
    expect_record_described<BitState>("BitState");
    expect_record_described<JarState>("JarState");
    expect_record_described<Accounts>("Accounts");
    expect_record_described<EnergyOrigin>("EnergyOrigin");
    expect_record_described<StepStatistics>("StepStatistics");
    expect_record_described<Course>("Course");
    expect_record_described<Clock>("Clock");
    expect_record_described<TimeError>("TimeError");
    expect_record_described<CoarsestSegment>("CoarsestSegment");
    expect_record_described<StagePower>("StagePower");
}

TEST(StateReadme, ListsThePartsOfBothStates) {
    expect_parts_described<DirectorState>("DirectorState");
    expect_parts_described<StrandState>("StrandState");
}

}  // namespace
}  // namespace drillstrand
