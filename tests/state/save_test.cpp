// A state that is saved and taken up again: every kind of field, and rows that do not fit.
#include "state/save.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <limits>
#include <string>

#include "state/rows.hpp"

namespace drillstrand {

/// One field of each kind.
struct Kinds {
    double number = 0;
    std::int64_t whole = 0;
    Eigen::Vector3d three = Eigen::Vector3d::Zero();
    Eigen::Vector4d four = Eigen::Vector4d::Zero();
    std::vector<double> list;
};
template <>
inline constexpr auto field_list<Kinds> = std::to_array<Field<Kinds>>({
    {&Kinds::number, "number", "m", "test"},
    {&Kinds::whole, "whole", "1", "test"},
    {&Kinds::three, "three", "N", "test"},
    {&Kinds::four, "four", "1", "test"},
    {&Kinds::list, "list", "J", "test"},
});

namespace {

using testing::HasSubstr;

struct TrialState {
    Kinds kinds;
    Table<StrandRow> rod;
    Table<WallRow> wall;

    template <class Self, class Visit>
    static void parts(Self& self, Visit&& visit) {
        visit("kinds", self.kinds);
        visit("rod", self.rod);
        visit("wall", self.wall);
    }
};

TrialState empty_state() {
    TrialState state;
    state.kinds.list.resize(4);
    state.rod = Table<StrandRow>(18);
    state.wall = Table<WallRow>(18);
    return state;
}

/// Numbers that no two entries share, padding after the last included.
template <class Row>
void number(Table<Row>& table, double next) {
    for (std::size_t line = 0; line < Table<Row>::lines; ++line)
        for (std::size_t entry = 0; entry < (table.blocks() + 1) * block_size; ++entry)
            table.line(line)[entry] = next += 0.1;
}

TrialState some_state() {
    TrialState state = empty_state();
    state.kinds = {0.1, -9007199254740992, {1, -0.0, 1e-300}, {4, 3, 2, 1}, {5, 6, 7, 8}};
    number(state.rod, 100);
    number(state.wall, 200);
    return state;
}

SavedRow& row(SavedState& saved, const std::string& name) {
    for (SavedRow& one : saved)
        if (one.name == name) return one;
    throw std::out_of_range(name);
}

std::string refusal(const SavedState& saved) {
    TrialState state = empty_state();
    try {
        restore(state, saved);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "taken";
}

TEST(SavedState, GivesEveryKindOfFieldBackBitForBit) {
    const TrialState before = some_state();
    TrialState after = empty_state();
    restore(after, save(before));
    EXPECT_EQ(after.kinds.number, 0.1);
    EXPECT_EQ(after.kinds.whole, -9007199254740992);
    EXPECT_EQ(after.kinds.three, before.kinds.three);
    EXPECT_TRUE(std::signbit(after.kinds.three[1]));
    EXPECT_EQ(after.kinds.four, before.kinds.four);
    EXPECT_EQ(after.kinds.list, before.kinds.list);
}

TEST(SavedState, GivesKeptRowsBackPaddingAfterThemIncludedAndLeavesOthersAlone) {
    const TrialState before = some_state();
    TrialState after = empty_state();
    restore(after, save(before));
    for (const RowInfo<WallRow>& info : row_list<WallRow>)
        for (std::size_t i = 0; i < info.width; ++i)
            for (std::size_t entry = 0; entry < 48; ++entry)
                EXPECT_EQ(after.wall.row(info.row, i)[entry],
                          info.keep == Keep::kept ? before.wall.row(info.row, i)[entry] : 0)
                    << info.name;
    for (std::size_t line = 0; line < Table<StrandRow>::lines; ++line)
        for (std::size_t entry = 0; entry < 48; ++entry)
            EXPECT_EQ(after.rod.line(line)[entry], before.rod.line(line)[entry]);
}

TEST(SavedState, NamesItsRowsByPartAndRowWithTheirUnits) {
    SavedState saved = save(some_state());
    EXPECT_EQ(row(saved, "kinds/three").unit, "N");
    EXPECT_EQ(row(saved, "kinds/three").values.size(), 3U);
    EXPECT_EQ(row(saved, "rod/moment").unit, "N m");
    EXPECT_EQ(row(saved, "rod/moment").values.size(), 3U * 48);
    EXPECT_EQ(row(saved, "wall/depth").values.size(), 48U);
    EXPECT_THROW(row(saved, "wall/tangent"), std::out_of_range);  // derived
}

TEST(SavedState, OfNothingIsTakenUpByNothing) {
    TrialState nothing;
    SavedState saved = save(nothing);
    EXPECT_EQ(row(saved, "kinds/list").values.size(), 0U);
    EXPECT_THROW(row(saved, "rod/moment"), std::out_of_range);
    restore(nothing, saved);
    EXPECT_THAT(refusal(saved), HasSubstr("the saved row kinds/list has another length"));
}

TEST(SavedState, WithARowMissingIsRefusedByItsName) {
    for (const char* name : {"kinds/number", "kinds/list", "rod/force", "wall/slid"}) {
        SavedState saved = save(some_state());
        std::erase_if(saved, [&](const SavedRow& one) { return one.name == name; });
        EXPECT_EQ(refusal(saved), std::string("the saved state has no row ") + name);
    }
}

TEST(SavedState, WithARowThatNoStateHasIsRefusedByItsName) {
    SavedState saved = save(some_state());
    saved.push_back({"rod/colour", "1", {1}});
    EXPECT_EQ(refusal(saved), "the saved state has an unknown row rod/colour");
}

TEST(SavedState, WithARowOfAnotherLengthIsRefusedByItsName) {
    for (const char* name :
         {"kinds/number", "kinds/whole", "kinds/three", "kinds/four", "kinds/list", "rod/force"}) {
        SavedState longer = save(some_state());
        row(longer, name).values.push_back(1);
        EXPECT_EQ(refusal(longer), "the saved row " + std::string(name) + " has another length");
        SavedState shorter = save(some_state());
        row(shorter, name).values.pop_back();
        EXPECT_EQ(refusal(shorter), "the saved row " + std::string(name) + " has another length");
    }
}

TEST(SavedState, WithACountThatIsNoWholeNumberIsRefused) {
    for (const double value : {0.5, 1e16, -1e16, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
        SavedState saved = save(some_state());
        row(saved, "kinds/whole").values = {value};
        EXPECT_EQ(refusal(saved), "the saved row kinds/whole is not a whole number") << value;
    }
}

}  // namespace
}  // namespace drillstrand
