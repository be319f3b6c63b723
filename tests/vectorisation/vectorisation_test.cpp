/// Each kernel, in each version that the compiler makes of it, must do its arithmetic in the vector
/// registers of that version. A lost vectorisation is no wrong result, only a slow one: nothing
/// else would notice.
#include <gmock/gmock.h>

#include <set>

#include "vectorisation/disassembly.hpp"

namespace drillstrand::test {
namespace {

using testing::Ge;

// Entries of a register of each version of a kernel.
const std::map<std::string, int> register_entries = {
    {"arch_x86_64_v4", 8}, {"arch_x86_64_v3", 4}, {"default", 2}};

// Arithmetic of a loop's head, tail and reduction may be scalar; 85 % of a kernel is in the loop.
constexpr double loop_share = 0.85;

struct Kernel {
    const char* name;
    int widest = 8;                   ///< entries that its loop can use at once
    double least_share = loop_share;  ///< of packed arithmetic
};

const std::vector<Kernel> kernels = {
    {"segments_of_block"},
    {"chain_segments_of_block", 4},  // three rows of a rotation and an idle one
    {"free_nodes"},
    {"damped_nodes"},
    {"nodes_in_well"},
    {"damped_nodes_in_well"},
    {"nodes_in_mud"},
    {"damped_nodes_in_mud"},
    {"advance_coulomb_springs"},
    {"advance_paper_springs"},
    {"block_error"},
    {"stage_state", 8, 0.7},  // its count is not known to the compiler: six scalar tails
};

/// Why there is nothing to look at in this build; empty where there is.
std::string why_not() {
#if !defined(DRILLSTRAND_DISPATCH)
    return "kernels are compiled for one instruction set (DRILLSTRAND_DISPATCH is off)";
#elif !defined(__x86_64__)
    return "the versions of the kernels are for x86-64";
#elif !defined(__GNUC__) || defined(__clang__)
    return "only g++ makes the versions of the kernels";
#elif !defined(__OPTIMIZE__)
    return "this build is not optimised";
#else
    return "";
#endif
}

class Vectorisation : public testing::TestWithParam<Kernel> {
  protected:
    void SetUp() override {
        if (const std::string reason = why_not(); !reason.empty()) GTEST_SKIP() << reason;
    }
};

TEST_P(Vectorisation, KeepsTheKernelInVectorRegisters) {
    const Kernel kernel = GetParam();
    const auto versions = read_kernels(OBJDUMP, KERNEL_OBJECTS)[kernel.name];
    for (const auto& [version, entries] : register_entries) {
        SCOPED_TRACE(version);
        ASSERT_TRUE(versions.contains(version)) << "the object files have no such version";
        const VectorUse& use = versions.at(version);
        EXPECT_EQ(use.widest, std::min(entries, kernel.widest)) << "entries in a register";
        EXPECT_THAT(use.packed_share(), Ge(kernel.least_share))
            << use.packed_entries << " packed and " << use.scalar_entries << " scalar operations";
        EXPECT_EQ(use.calls, 0) << "a call in a vector loop takes the entries one by one";
    }
}

INSTANTIATE_TEST_SUITE_P(Kernels, Vectorisation, testing::ValuesIn(kernels),
                         [](const auto& kernel) { return kernel.param.name; });

class ObjectFiles : public Vectorisation {};

TEST_F(ObjectFiles, HoldNoKernelThatIsNotWatched) {
    std::set<std::string> found;
    for (const auto& [name, versions] : read_kernels(OBJDUMP, KERNEL_OBJECTS))
        found.insert(name);
    std::set<std::string> watched;
    for (const Kernel& kernel : kernels)
        watched.insert(kernel.name);
    EXPECT_EQ(found, watched);
}

TEST_F(ObjectFiles, ShowALostVectorisation) {
    const auto versions = read_kernels(OBJDUMP, SEQUENTIAL_OBJECT)["sequential_kernel"];
    ASSERT_EQ(versions.size(), register_entries.size());
    for (const auto& [version, use] : versions) {
        EXPECT_GT(use.scalar_entries, 0) << version;
        EXPECT_LT(use.packed_share(), 0.5) << version;
    }
}

}  // namespace
}  // namespace drillstrand::test
