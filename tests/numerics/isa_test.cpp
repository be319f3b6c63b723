#include "drillstrand/isa.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace drillstrand {
namespace {

TEST(InstructionSets, AreFoundByTheirNames) {
    for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512})
        EXPECT_EQ(isa_from_name(isa_name(isa)), isa);
    EXPECT_EQ(isa_name(Isa::avx2), "avx2");
    EXPECT_EQ(isa_from_name("sse9"), std::nullopt);
}

TEST(InstructionSets, AreAvailableUpToTheBestOne) {
    const std::vector<Isa> isas = available_isas();
    EXPECT_EQ(isas.front(), Isa::baseline);
    EXPECT_EQ(isas.back(), best_isa());
    EXPECT_TRUE(std::is_sorted(isas.begin(), isas.end()));
}

}  // namespace
}  // namespace drillstrand
