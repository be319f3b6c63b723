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
    {"cantilever",          {2,   "eb784c8f3af2b782"}, {0.005, "954ccc2e0a13c5e0"}},
    {"vertical_20kN",       {6,   "7281b4540e7dc8bc"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_50kN",       {6,   "b2b0bc29fc0edf33"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_100kN",      {6,   "e7ee72e56c6bf53a"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_resolved",   {0.5, "64995d18855e1965"}, {0.0005, "48cba3c5ff5e1e08"}},
    {"horizontal_350kN",    {6,   "6fd86afd8eed2c0b"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_500kN",    {6,   "3cddb698387c9bf"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_1MN",      {6,   "b0a2e1403300b95e"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_resolved", {0.5, "987d6957b84b2337"}, {0.0005, "95d9d160863026f0"}},
    {"well1",               {3,   "3b8de9e5c057f96b"}, {0.002, "115149cd310a4dee"}},
    {"well2",               {3,   "8f1ea0da8743f422"}, {0.002, "81ef2e209faf65c6"}},
    {"well2_drilling",      {3,   "e874ed2503693526"}, {0.002, "81ef2e209faf65c6"}},
    {"well3",               {3,   "bf94ab9196a1518"}, {0.002, "95958e20163e7a2e"}},
    {"well1_paper",           {3,   "8116d672b459256b"}, {0.002, "28660448a9fc3e9a"}},
    {"well2_paper",           {3,   "56aeee7d77147e52"}, {0.002, "b73bdd10ac321b59"}},
    {"well2_drilling_paper",  {3,   "a46d7e8608ec18e1"}, {0.002, "b73bdd10ac321b59"}},
    {"well3_paper",           {3,   "485d400f2e664592"}, {0.002, "5e8d85a342d0c376"}},
    {"torque_drag",         {3,   "ac356955b0cfcd26"}, {0.002, "fc0a6fe77b27d901"}},
    {"buckling_heavy",      {1,   "18034a41a44ae606"}, {0.002, "5df6ce279330db8d"}},
    {"buckling_weightless", {1,   "69f7440f50bdd9b3"}, {0.002, "649bea5db9c93fe4"}},
};
// clang-format on

}  // namespace drillstrand::test
