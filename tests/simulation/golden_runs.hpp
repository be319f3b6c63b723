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
    {"cantilever",          {2,   "3939af7dee0327ef"}, {0.005, "954ccc2e0a13c5e0"}},
    {"vertical_20kN",       {6,   "ce0add9123983c0e"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_50kN",       {6,   "e1a5a958d8b4cb18"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_100kN",      {6,   "8e78df394b1ba052"}, {0.002, "7ad2cc090b213df5"}},
    {"vertical_resolved",   {0.5, "9a3063602ab27517"}, {0.0005, "48cba3c5ff5e1e08"}},
    {"horizontal_350kN",    {6,   "3afbeddd7905a2f7"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_500kN",    {6,   "aefc7fcfc2b6065f"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_1MN",      {6,   "3dae4aa8bb28a3b3"}, {0.002, "5267fd9119a99d90"}},
    {"horizontal_resolved", {0.5, "793a808bb5fb670c"}, {0.0005, "95d9d160863026f0"}},
    {"well1",               {3,   "e1fd30f91b11330d"}, {0.002, "115149cd310a4dee"}},
    {"well2",               {3,   "1107730d73f76057"}, {0.002, "81ef2e209faf65c6"}},
    {"well2_drilling",      {3,   "1107730d73f76057"}, {0.002, "81ef2e209faf65c6"}},
    {"well3",               {3,   "1f0b25af5f0be34a"}, {0.002, "95958e20163e7a2e"}},
    {"well1_paper",           {3,   "12812196c1ac8be3"}, {0.002, "28660448a9fc3e9a"}},
    {"well2_paper",           {3,   "7534b40d93c92d2"}, {0.002, "b73bdd10ac321b59"}},
    {"well2_drilling_paper",  {3,   "1491c61ad6077eb2"}, {0.002, "b73bdd10ac321b59"}},
    {"well3_paper",           {3,   "5da03f42016b5071"}, {0.002, "5e8d85a342d0c376"}},
    {"torque_drag",         {3,   "4084471e5befae23"}, {0.002, "fc0a6fe77b27d901"}},
    {"buckling_heavy",      {1,   "cca82838ce800a38"}, {0.002, "5df6ce279330db8d"}},
    {"buckling_weightless", {1,   "a13816260f4ce1d9"}, {0.002, "649bea5db9c93fe4"}},
};
// clang-format on

}  // namespace drillstrand::test
