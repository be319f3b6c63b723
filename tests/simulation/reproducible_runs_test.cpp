/// run.reproducible: a case gives the same bits with every instruction set and on any number of
/// threads.
#include <gtest/gtest.h>

#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

#include <bit>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/isa.hpp"
#include "drillstrand/result_layout.hpp"
#include "simulation/golden_runs.hpp"
#include "support/both_integrators.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {

void PrintTo(const GoldenRun& golden, std::ostream* stream) {
    *stream << golden.name;
}

namespace {

/// What golden hashes are made of: a dataset that is added later does not change them.
const std::set<std::string> hashed = {
    "/series/time",
    "/series/head_stress",
    "/series/bit_stress",
    "/series/head_position",
    "/series/bit_position",
    "/series/head_rotation_rate",
    "/series/kinetic_energy",
    "/series/bit_rotation_rate",
    "/series/elastic_energy",
    "/series/work",
    "/series/potential_energy",
    "/series/dissipation",
    "/series/step_size",
    "/series/time_error",
    "/series/max_penetration",
    "/series/contact_nodes",
    "/series/impacts",
    "/series/contact_changes",
    "/series/slips",
    "/profiles/time",
    "/profiles/position",
    "/profiles/director",
    "/profiles/momentum",
    "/profiles/stress",
    "/profiles/eccentricity",
    "/profiles/well_depth",
    "/profiles/contact_force",
    "/profiles/normal_force",
};

/// All numbers of a run by dataset, as bits: zeros of both signs differ.
using Bits = std::map<std::string, std::vector<std::uint64_t>>;

template <class Record>
void add_bits(const std::vector<RecordDataset<Record>>& datasets,
              const std::vector<Record>& records, Bits& bits) {
    for (const RecordDataset<Record>& dataset : datasets) {
        std::vector<double> values;
        for (const Record& record : records)
            dataset.append(record, values);
        for (const double value : values)
            bits[dataset.path].push_back(std::bit_cast<std::uint64_t>(value));
    }
}

Bits bits_of(const Case& input, Isa isa) {
    const Run done = run(input, isa);
    Bits bits;
    add_bits(series_datasets(), done.series, bits);
    add_bits(profile_datasets(), done.profiles, bits);
    return bits;
}

/// FNV-1a over the numbers of the hashed datasets, in the order of their names.
std::string hash_of(const Bits& bits) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::string& path : hashed) {
        for (const std::uint64_t number : bits.at(path)) {
            for (unsigned shift = 0; shift < 64; shift += 8) {
                hash ^= (number >> shift) & 0xffU;
                hash *= 0x100000001b3;
            }
        }
    }
    std::ostringstream text;
    text << std::hex << hash;
    return text.str();
}

void expect_same(const Bits& bits, const Bits& others) {
    ASSERT_EQ(bits.size(), others.size());
    for (const auto& [path, numbers] : bits)
        EXPECT_TRUE(numbers == others.at(path)) << path;
}

/// Why golden hashes say nothing of this build on this machine; empty where they do.
std::string why_not_golden() {
#if !defined(__GLIBC__) || !defined(__x86_64__) || defined(__clang__) || __GNUC__ != 12
    return "the hashes are of g++ 12 and glibc on x86-64";
#elif !defined(__OPTIMIZE__)
    return "the hashes are of an optimised build";
#else
    if (std::string(gnu_get_libc_version()) != "2.36") return "the hashes are of glibc 2.36";
    return __builtin_cpu_supports("fma") != 0 ? "" : "the hashes are of a processor with FMA";
#endif
}

class ReproducibleRun : public testing::TestWithParam<std::tuple<IntegratorKind, GoldenRun>> {
  protected:
    static IntegratorKind integrator() { return std::get<0>(GetParam()); }

    static auto golden() {
        const GoldenRun& golden = std::get<1>(GetParam());
        return integrator() == IntegratorKind::leapfrog ? golden.leapfrog : golden.dormand_prince;
    }

    void SetUp() override {
        if (golden().duration == 0) GTEST_SKIP() << "not a case of this integrator";
    }

    static Case shortened_case() {
        Case input = read_case(std::filesystem::path(DRILLSTRAND_SOURCE_DIR) / "cases" /
                               (std::string(std::get<1>(GetParam()).name) + ".toml"));
        input.run.integrator = integrator();
        input.run.duration = golden().duration;
        input.run.reproducible = true;
        input.run.threads = 1;
        return input;
    }
};

TEST_P(ReproducibleRun, GivesTheSameBitsWithEveryInstructionSetAndNumberOfThreads) {
    Case input = shortened_case();
    const Bits bits = bits_of(input, Isa::baseline);
    int threads = 3;
    for (const Isa isa : available_isas()) {
        SCOPED_TRACE(isa_name(isa));
        input.run.threads = threads--;
        expect_same(bits_of(input, isa), bits);
    }
}

TEST_P(ReproducibleRun, GivesTheBitsOfBefore) {
    if (const std::string reason = why_not_golden(); !reason.empty()) GTEST_SKIP() << reason;
    EXPECT_EQ(hash_of(bits_of(shortened_case(), best_isa())), golden().hash);
}

INSTANTIATE_TEST_SUITE_P(OfShippedCases, ReproducibleRun,
                         testing::Combine(testing::Values(IntegratorKind::leapfrog,
                                                          IntegratorKind::dormand_prince),
                                          testing::ValuesIn(golden_runs)),
                         [](const auto& instance) {
                             return integrator_label(std::get<0>(instance.param)) + "_" +
                                    std::get<1>(instance.param).name;
                         });

TEST(FusedKernels, RoundOtherwiseThanTheLowestLevel) {
    if (best_isa() == Isa::baseline) GTEST_SKIP() << "no other level here";
    Case input = read_case(std::filesystem::path(DRILLSTRAND_SOURCE_DIR) / "cases/well2.toml");
    input.run.duration = 0.5;
    EXPECT_NE(hash_of(bits_of(input, Isa::baseline)), hash_of(bits_of(input, Isa::avx2)));
}

}  // namespace
}  // namespace drillstrand::test
