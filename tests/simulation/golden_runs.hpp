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
    {"cantilever",          {2,   "9cadce2d40f4e027"}, {0.005, "954ccc2e0a13c5e0"}},
    {"vertical_20kN",       {6,   "6fe7a049d6554402"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_50kN",       {6,   "da07d4b292c6f031"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_100kN",      {6,   "21c995bc27f881a6"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_resolved",   {0.5, "38a3515630982e97"}, {0.0005, "48cba3c5ff5e1e08"}},
    {"horizontal_350kN",    {6,   "ff37f5688cdb6fd8"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_500kN",    {6,   "2e4fe7f28512032c"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_1MN",      {6,   "f14e295ed705e5a7"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_resolved", {0.5, "730aa9cb3a7cba87"}, {0.0005, "95d9d160863026f0"}},
    {"well1",               {3,   "c7fee74edc78b6ff"}, {0.002, "115149cd310a4dee"}},
    {"well2",               {3,   "654284b6891e8220"}, {0.002, "81ef2e209faf65c6"}},
    {"well2_drilling",      {3,   "654284b6891e8220"}, {0.002, "81ef2e209faf65c6"}},
    {"well3",               {3,   "9d37092ad6630fad"}, {0.002, "95958e20163e7a2e"}},
    {"well1_paper",           {3,   "f0a57aa5e2a4f089"}, {0.002, "28660448a9fc3e9a"}},
    {"well2_paper",           {3,   "e64239e3935c1887"}, {0.002, "b73bdd10ac321b59"}},
    {"well2_drilling_paper",  {3,   "c9d0c6fc4c24b223"}, {0.002, "b73bdd10ac321b59"}},
    {"well3_paper",           {3,   "3a6a33da466e7404"}, {0.002, "5e8d85a342d0c376"}},
    {"torque_drag",         {3,   "1e91df1a5a52cda8"}, {0.002, "fc0a6fe77b27d901"}},
    {"buckling_heavy",      {1,   "16b57a4d2300ec9c"}, {0.002, "5df6ce279330db8d"}},
    {"buckling_weightless", {1,   "a13816260f4ce1d9"}, {0.002, "649bea5db9c93fe4"}},
};
// clang-format on

}  // namespace drillstrand::test
