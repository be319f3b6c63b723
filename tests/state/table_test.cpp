// Tables whose rows are typed: what they hold where, and what the compiler refuses.
#include "state/table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <type_traits>

#include "rod/director.hpp"
#include "rod/strand.hpp"
#include "state/rows.hpp"

namespace drillstrand {
namespace {

// ------------------------------------------------------------------ one table for another

using Rod = Table<DirectorRow>;
using Segments = Table<SegmentRow>;
using Wall = Table<WallRow>;
using Strand = Table<StrandRow>;

static_assert(std::is_invocable_v<decltype(director_nodes), const DirectorModel&, const Rod&, Rod&,
                                  const Segments&, Wall&, BlockSpan, double, double>);
static_assert(!std::is_invocable_v<decltype(director_nodes), const DirectorModel&, const Segments&,
                                   Rod&, const Segments&, Wall&, BlockSpan, double, double>);
static_assert(!std::is_invocable_v<decltype(director_nodes), const DirectorModel&, const Rod&,
                                   Segments&, const Segments&, Wall&, BlockSpan, double, double>);
static_assert(!std::is_invocable_v<decltype(director_nodes), const DirectorModel&, const Rod&, Rod&,
                                   const Rod&, Wall&, BlockSpan, double, double>);
static_assert(!std::is_invocable_v<decltype(director_nodes), const DirectorModel&, const Rod&, Rod&,
                                   const Segments&, Segments&, BlockSpan, double, double>);
static_assert(std::is_invocable_v<decltype(director_segments), const DirectorModel&, const Rod&,
                                  Segments&, BlockSpan, double>);
static_assert(!std::is_invocable_v<decltype(director_segments), const DirectorModel&,
                                   const Segments&, Rod&, BlockSpan, double>);
static_assert(
    std::is_invocable_v<decltype(segment_pass), const StrandModel&, const Strand&, Strand&,
                        StrandWorkspace&, const Wall&, std::size_t, std::size_t>);
static_assert(!std::is_invocable_v<decltype(segment_pass), const StrandModel&, const Rod&, Strand&,
                                   StrandWorkspace&, const Wall&, std::size_t, std::size_t>);
static_assert(
    !std::is_invocable_v<decltype(segment_pass), const StrandModel&, const Strand&, Strand&,
                         StrandWorkspace&, const Rod&, std::size_t, std::size_t>);
// a table that is only read cannot be written
static_assert(!std::is_invocable_v<decltype(director_segments), const DirectorModel&, const Rod&,
                                   const Segments&, BlockSpan, double>);

template <class Rows, class Row>
concept HasRow = requires(Rows& table, Row row) {
    table.row(row);
};
template <class Rows, class Row>
concept HasVector = requires(Rows& table, Row row) {
    table.vector(row, std::size_t{});
};

static_assert(HasRow<Rod, DirectorRow> && HasVector<Rod, DirectorRow>);
static_assert(!HasRow<Rod, SegmentRow> && !HasVector<Rod, SegmentRow>);
static_assert(!HasRow<Rod, WallRow> && !HasRow<Wall, DirectorRow> && !HasRow<Strand, DirectorRow>);
static_assert(!HasRow<Rod, int> && !HasRow<Rod, std::size_t>);
static_assert(!std::is_convertible_v<Rod, Wall> && !std::is_convertible_v<Segments, Rod>);
static_assert(!std::is_convertible_v<std::size_t, Rod>);

// ------------------------------------------------------------------ what is where

template <class Row>
void expect_rows_in_order_without_gaps() {
    std::size_t values = 0;
    std::set<std::string_view> names;
    for (const RowInfo<Row>& info : row_list<Row>) {
        EXPECT_EQ(row_offset<Row>[static_cast<std::size_t>(info.row)], values) << info.name;
        EXPECT_GE(info.width, 1U) << info.name;
        EXPECT_TRUE(names.insert(info.name).second) << info.name;
        EXPECT_FALSE(info.unit.empty()) << info.name;
        EXPECT_FALSE(info.stage.empty()) << info.name;
        values += info.width;
    }
    EXPECT_EQ(Table<Row>::lines, values);
}

TEST(Table, RowsFollowOneAnotherWithoutGaps) {
    expect_rows_in_order_without_gaps<DirectorRow>();
    expect_rows_in_order_without_gaps<SegmentRow>();
    expect_rows_in_order_without_gaps<StrandRow>();
    expect_rows_in_order_without_gaps<WallRow>();
}

TEST(Table, IsZeroAtFirst) {
    const Rod rod(20);
    for (std::size_t line = 0; line < Rod::lines; ++line)
        for (std::size_t entry = 0; entry < rod.blocks() * block_size; ++entry)
            EXPECT_EQ(rod.line(line)[entry], 0);
}

TEST(Table, VectorsStandInThreeNeighbouringLines) {
    Rod rod(20);
    rod.set(DirectorRow::director, 17, {1, 2, 3});
    EXPECT_EQ(rod.vector(DirectorRow::director, 17), Eigen::Vector3d(1, 2, 3));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(rod.row(DirectorRow::director, i)[17], static_cast<double>(i + 1));
        EXPECT_EQ(rod.line(6 + i)[17], static_cast<double>(i + 1));  // after position, velocity
    }
    EXPECT_EQ(rod.vector(DirectorRow::velocity, 17).norm(), 0);
    EXPECT_EQ(rod.vector(DirectorRow::director, 16).norm(), 0);
}

TEST(Table, FillsARowAndNoOther) {
    Rod rod(20);
    rod.fill(DirectorRow::spin, 5);
    rod.fill(DirectorRow::material, {1, 2, 3});
    EXPECT_EQ(rod.row(DirectorRow::spin)[-1], 5);
    EXPECT_EQ(rod.row(DirectorRow::spin)[32], 5);
    EXPECT_EQ(rod.vector(DirectorRow::material, 19), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(rod.row(DirectorRow::last_director, 2)[19], 0);
    EXPECT_EQ(rod.row(DirectorRow::last_twist)[19], 0);
}

TEST(Table, CopiesDoNotShareTheirNumbers) {
    Rod rod(3);
    const Rod before = rod;
    rod.row(DirectorRow::spin)[1] = 7;
    EXPECT_EQ(before.row(DirectorRow::spin)[1], 0);
}

}  // namespace
}  // namespace drillstrand
