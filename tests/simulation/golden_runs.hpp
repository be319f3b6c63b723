/// Hashes of shipped cases, shortened, run with run.reproducible = true: of all numbers of the
/// datasets that reproducible_runs_test.cpp names. They change where the physics or the numerics
/// do; a change that should leave results alone must leave these alone.
///
/// Made by g++ 12 on x86-64 with glibc 2.36 on a processor with FMA: sine, cosine and power come
/// from the C library, whose versions for processors with and without FMA, and of other years, may
/// differ in the last digit. Elsewhere the hashes are not compared.
#pragma once

namespace drillstrand::test {

struct GoldenRun {
    const char* name;  ///< of the case
    struct {
        double duration;  ///< s
        const char* hash;
    } leapfrog, dormand_prince;
};

// clang-format off
inline constexpr GoldenRun golden_runs[] = {
    {"cantilever",          {2,   "47718dad92eed215"}, {0.005, "954ccc2e0a13c5e0"}},
    {"vertical_20kN",       {6,   "35107d78c5561a9e"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_50kN",       {6,   "c66b259f6c12b73c"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_100kN",      {6,   "b807e29f45aeb993"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_resolved",   {0.5, "1b8d3aa4d6e3a79f"}, {0.0005, "48cba3c5ff5e1e08"}},
    {"horizontal_350kN",    {6,   "4ddbe5aff732e513"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_500kN",    {6,   "ad558d7533658c9f"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_1MN",      {6,   "22fdd6a5eaa39bf4"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_resolved", {0.5, "590648b95518f7d9"}, {0.0005, "95d9d160863026f0"}},
    {"well1",               {3,   "55c139ede8834a7e"}, {0.002, "af3c53f4deaecaf1"}},
    {"well2",               {3,   "a2c9e913bc4ab62b"}, {0.002, "e9805a3c80a84fd1"}},
    {"well2_drilling",      {3,   "c8979d50545d8a21"}, {0.002, "e9805a3c80a84fd1"}},
    {"well3",               {3,   "c1ecd8b804667d56"}, {0.002, "73727d02dbc2de7b"}},
    {"torque_drag",         {3,   "ec1152bed1700015"}, {0.002, "aa655ec7e5661623"}},
    {"buckling_heavy",      {1,   "16b57a4d2300ec9c"}, {0.002, "5df6ce279330db8d"}},
    {"buckling_weightless", {1,   "a13816260f4ce1d9"}, {0.002, "649bea5db9c93fe4"}},
};
// clang-format on

}  // namespace drillstrand::test
