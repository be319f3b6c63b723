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
    {"cantilever",          {2,   "eca7a5865fbd6995"}, {0.005, "954ccc2e0a13c5e0"}},
    {"vertical_20kN",       {6,   "6ffdfa8066df504d"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_50kN",       {6,   "fd1ab03586744b27"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_100kN",      {6,   "dee1730c49ea506c"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_resolved",   {0.5, "d16104067436bf3b"}, {0.0005, "48cba3c5ff5e1e08"}},
    {"horizontal_350kN",    {6,   "f1788685f00a931a"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_500kN",    {6,   "53b4704c4ac4d59a"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_1MN",      {6,   "ab51176bd2d5aef9"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_resolved", {0.5, "cf462ecc49303ed6"}, {0.0005, "95d9d160863026f0"}},
    {"well1",               {3,   "1e0003412dbbd4cb"}, {0.002, "af3c53f4deaecaf1"}},
    {"well2",               {3,   "5d2747418277e6c3"}, {0.002, "e9805a3c80a84fd1"}},
    {"well2_drilling",      {3,   "b73640d16ba39222"}, {0.002, "e9805a3c80a84fd1"}},
    {"well3",               {3,   "32c7c294f47afc7c"}, {0.002, "73727d02dbc2de7b"}},
    {"torque_drag",         {3,   "328d3412c2935fcd"}, {0.002, "aa655ec7e5661623"}},
    {"buckling_heavy",      {1,   "2a68480c8884d74"}, {0.002, "5df6ce279330db8d"}},
    {"buckling_weightless", {1,   "a13816260f4ce1d9"}, {0.002, "649bea5db9c93fe4"}},
};
// clang-format on

}  // namespace drillstrand::test
