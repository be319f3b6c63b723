/// Each kernel, in each version that the compiler makes of it, must do its arithmetic in the vector
/// registers of that version. A lost vectorisation is no wrong result, only a slow one: nothing
/// else would notice.
#include <gmock/gmock.h>

#include <ostream>
#include <regex>
#include <set>

#include "vectorisation/disassembly.hpp"

namespace drillstrand::test {
namespace {

using testing::ContainerEq;
using testing::Ge;

// Entries of a register of each version of a kernel.
const std::map<std::string, int> register_entries = {
    {"avx512", 8}, {"avx512_unfused", 8}, {"avx2", 4}, {"avx2_unfused", 4}, {"baseline", 2}};

// Arithmetic of a loop's head, tail and reduction may be scalar; 85 % of a kernel is in the loop.
constexpr double loop_share = 0.85;

struct Kernel {
    std::string name;                 ///< its source file and function
    int widest = 8;                   ///< entries that its loop can use at once
    double least_share = loop_share;  ///< of packed arithmetic
    std::size_t instances = 1;        ///< of its template
};

void PrintTo(const Kernel& kernel, std::ostream* stream) {
    *stream << kernel.name;
}

const std::vector<Kernel> kernels = {
    {"strand: segments_of_block", 8, loop_share, 2},
    {"strand: chain_segments_of_block", 4},  // three rows of a rotation and an idle one
    {"strand: nodes_of_block", 8, loop_share, 26},
    {"director_segments: segments_of_span", 8, loop_share, 6},
    {"director_nodes: nodes_of_span", 8, loop_share, 54},
    {"surroundings: advance_springs_of_block", 8, loop_share, 4},
    {"dormand_prince: block_error"},
    {"dormand_prince: stage_state", 8, 0.7},  // six scalar tails: its count is not a constant
    {"director_report: report_block", 8, loop_share},
    {"guards: read_guards"},
    {"substep_rounds: take_rounds", 8, loop_share, 4},
    // the nodes of a stretch are any number: scalar tails
    {"substeps: gather_forces", 8, 0.6, 8},
    {"substeps: answer_to_places", 8, loop_share, 2},
    {"substeps: gather_impulses", 8, 0.6, 2},
    {"substeps: share_impulses", 8, 0.6, 2},
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

std::set<std::string> levels() {
    std::set<std::string> names;
    for (const auto& [name, entries] : register_entries)
        names.insert(name);
    return names;
}

std::set<std::string> levels(const std::vector<KernelVersion>& versions) {
    std::set<std::string> names;
    for (const KernelVersion& version : versions)
        names.insert(version.level);
    return names;
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
    EXPECT_THAT(levels(versions), ContainerEq(levels()));
    EXPECT_EQ(versions.size(), kernel.instances * register_entries.size());
    for (const KernelVersion& version : versions) {
        SCOPED_TRACE(version.function);
        const VectorUse& use = version.use;
        const int entries = register_entries.at(version.level);
        EXPECT_EQ(use.widest, std::min(entries, kernel.widest)) << "entries in a register";
        EXPECT_THAT(use.packed_share(), Ge(kernel.least_share))
            << use.packed_entries << " packed and " << use.scalar_entries << " scalar operations";
        if (version.level.ends_with("_unfused")) {
            EXPECT_EQ(use.fused, 0);
        }
        EXPECT_EQ(use.calls, 0) << "a call in a vector loop takes the entries one by one";
    }
}

INSTANTIATE_TEST_SUITE_P(Kernels, Vectorisation, testing::ValuesIn(kernels),
                         [](const auto& kernel) {
                             return std::regex_replace(kernel.param.name, std::regex(": "), "_");
                         });

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
    const auto versions =
        read_kernels(OBJDUMP, SEQUENTIAL_OBJECT)["sequential_kernel: sequential_kernel"];
    EXPECT_THAT(levels(versions), ContainerEq(levels()));
    for (const KernelVersion& version : versions) {
        EXPECT_GT(version.use.scalar_entries, 0) << version.function;
        EXPECT_LT(version.use.packed_share(), 0.5) << version.function;
    }
}

}  // namespace
}  // namespace drillstrand::test
