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
    {"cantilever",          {2,   "26253e48017a5783"}, {0.005, "954ccc2e0a13c5e0"}},
    {"vertical_20kN",       {6,   "219c651a47d615d5"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_50kN",       {6,   "3597bb99a0e1dda5"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_100kN",      {6,   "fc7fe5a265d76e7e"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_resolved",   {0.5, "14488e4d977126f2"}, {0.0005, "48cba3c5ff5e1e08"}},
    {"horizontal_350kN",    {6,   "86ab900d2d4d85b7"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_500kN",    {6,   "8ebce4c1d7ac2373"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_1MN",      {6,   "9989342c74c39725"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_resolved", {0.5, "db5fca234b0a78be"}, {0.0005, "95d9d160863026f0"}},
    {"well1",               {3,   "e8cec95512a4ac22"}, {0.002, "115149cd310a4dee"}},
    {"well2",               {3,   "a9f4120cea1f7d3a"}, {0.002, "81ef2e209faf65c6"}},
    {"well2_drilling",      {3,   "a9f4120cea1f7d3a"}, {0.002, "81ef2e209faf65c6"}},
    {"well3",               {3,   "a81a4c58dc3f8eb0"}, {0.002, "95958e20163e7a2e"}},
    {"well1_paper",           {3,   "a1ebeb9f30f1481e"}, {0.002, "28660448a9fc3e9a"}},
    {"well2_paper",           {3,   "b5276672f3d564c4"}, {0.002, "b73bdd10ac321b59"}},
    {"well2_drilling_paper",  {3,   "1a65a8a39a77f0ce"}, {0.002, "b73bdd10ac321b59"}},
    {"well3_paper",           {3,   "8984a1647b6557a9"}, {0.002, "5e8d85a342d0c376"}},
    {"torque_drag",         {3,   "4cda78186b87bdab"}, {0.002, "fc0a6fe77b27d901"}},
    {"buckling_heavy",      {1,   "cca82838ce800a38"}, {0.002, "5df6ce279330db8d"}},
    {"buckling_weightless", {1,   "a13816260f4ce1d9"}, {0.002, "649bea5db9c93fe4"}},
};
// clang-format on

}  // namespace drillstrand::test
