/// How the blocks of a string are cut into spans.
#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/block_table.hpp"

namespace drillstrand {
namespace {

TEST(BlockSpans, FollowEachOtherFromTheFirstBlockToTheLast) {
    for (std::size_t blocks = 1; blocks <= 300; ++blocks) {
        std::size_t next = 0;
        for (const BlockSpan span : equal_spans(blocks)) {
            EXPECT_EQ(span.begin, next) << blocks << " blocks";
            EXPECT_GT(span.end, span.begin) << blocks << " blocks";
            next = span.end;
        }
        EXPECT_EQ(next, blocks);
    }
}

TEST(BlockSpans, AreEquallyLongButForOneBlockAndNeverTooLong) {
    for (std::size_t blocks = 1; blocks <= 300; ++blocks) {
        std::size_t least = blocks;
        std::size_t most = 0;
        for (const BlockSpan span : equal_spans(blocks)) {
            least = std::min(least, span.end - span.begin);
            most = std::max(most, span.end - span.begin);
        }
        EXPECT_LE(most - least, 1) << blocks << " blocks";
        EXPECT_LE(most, most_blocks_at_once) << blocks << " blocks";
    }
}

TEST(BlockSpans, GiveTwoThreadsHalfTheStringEach) {
    for (std::size_t blocks = 2; blocks <= 300; ++blocks) {
        const auto spans = equal_spans(blocks);
        ASSERT_EQ(spans.size() % 2, 0) << blocks << " blocks";
        EXPECT_EQ(spans[spans.size() / 2].begin, blocks / 2);
    }
}

}  // namespace
}  // namespace drillstrand
