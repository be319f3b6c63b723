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
    {"cantilever",          {2,   "e919da3067873c73"}, {0.005, "954ccc2e0a13c5e0"}},
    {"vertical_20kN",       {6,   "875103dc86d20975"}, {0.002, "ef0e45f424a225b2"}},
    {"vertical_50kN",       {6,   "63006108ef726c63"}, {0.002, "ef0e45f424a225b2"}},
    {"vertical_100kN",      {6,   "71a8347496db5857"}, {0.002, "ef0e45f424a225b2"}},
    {"vertical_resolved",   {0.5, "a2cc86640aef9587"}, {0.0005, "48cba3c5ff5e1e08"}},
    {"horizontal_350kN",    {6,   "8d9d4404dc306d1"}, {0.002, "937b516b5369ff5a"}},
    {"horizontal_500kN",    {6,   "20b08e4a9a4191ce"}, {0.002, "937b516b5369ff5a"}},
    {"horizontal_1MN",      {6,   "37914f5ceff30d2"}, {0.002, "a36ce0c93c2e8082"}},
    {"horizontal_resolved", {0.5, "4f2cace3bdaa29eb"}, {0.0005, "95d9d160863026f0"}},
    {"well1",               {3,   "b785e4a882b70d8b"}, {0.002, "2ccbba20a4b4fb35"}},
    {"well2",               {3,   "1dede25ccaae8ba0"}, {0.002, "5f4b5d6dfc7016c0"}},
    {"well2_drilling",      {3,   "2e29828ad08f6f1e"}, {0.002, "5f4b5d6dfc7016c0"}},
    {"well3",               {3,   "fc0661068e22fe77"}, {0.002, "3262d0dca6360f41"}},
    {"well1_paper",           {3,   "39e369ead84a704c"}, {0.002, "28660448a9fc3e9a"}},
    {"well2_paper",           {3,   "61b351a8bd5ba2d9"}, {0.002, "b73bdd10ac321b59"}},
    {"well2_drilling_paper",  {3,   "e005572ff77270ab"}, {0.002, "b73bdd10ac321b59"}},
    {"well3_paper",           {3,   "cd6a015d1e51f9ef"}, {0.002, "ce102024fffcf010"}},
    {"torque_drag",         {3,   "703e49caf5374db7"}, {0.002, "8f308490721489d5"}},
    {"buckling_heavy",      {1,   "18034a41a44ae606"}, {0.002, "5df6ce279330db8d"}},
    {"buckling_weightless", {1,   "69f7440f50bdd9b3"}, {0.002, "649bea5db9c93fe4"}},
};
// clang-format on

}  // namespace drillstrand::test
