/// Hashes of shipped cases, shortened, run with run.reproducible = true: of all numbers of the
/// datasets that reproducible_runs_test.cpp names. They change where the physics or the numerics
/// do; a change that should leave results alone must leave these alone.
///
/// Made by g++ 12 on x86-64 with glibc 2.36 on a processor with FMA: sine, cosine and power come
/// from the C library, whose versions for processors with and without FMA, and of other years, may
/// differ in the last digit. Elsewhere the hashes are not compared. Cases that only the leapfrog
/// runs have no hash of the other.
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
    {"cantilever",          {2,   "bbbb79e5b17a7dfa"}, {0.005, "954ccc2e0a13c5e0"}},
    {"vertical_20kN",       {6,   "de5d11c48b22d81f"}, {0.002, "ef0e45f424a225b2"}},
    {"vertical_50kN",       {6,   "ad4ae8feb82d7768"}, {0.002, "ef0e45f424a225b2"}},
    {"vertical_100kN",      {6,   "75367c38ce2b2e98"}, {0.002, "ef0e45f424a225b2"}},
    {"vertical_resolved",   {0.5, "c0a42049512b5718"}, {0.0005, "8be9a9fb59e930ed"}},
    {"horizontal_350kN",    {6,   "8c064a05cb62a8e4"}, {0.002, "937b516b5369ff5a"}},
    {"horizontal_500kN",    {6,   "8b4e5d4c16f93551"}, {0.002, "937b516b5369ff5a"}},
    {"horizontal_1MN",      {6,   "c211afd9df03a014"}, {0.002, "a36ce0c93c2e8082"}},
    {"horizontal_resolved", {0.5, "49f1169e4932676b"}, {0.0005, "5384416e0bc4fa64"}},
    {"well1",               {3,   "1ef2735338f3c8e0"}, {0.002, "2ccbba20a4b4fb35"}},
    {"well2",               {3,   "e0df8b7466c1e630"}, {0.002, "5f4b5d6dfc7016c0"}},
    {"well2_drilling",      {3,   "fb74e7c430a42400"}, {0.002, "5f4b5d6dfc7016c0"}},
    {"well3",               {3,   "f41b08aba5cf90f8"}, {0.002, "3262d0dca6360f41"}},
    {"well1_paper",           {3,   "483c0bcc7f6da02b"}, {0.002, "28660448a9fc3e9a"}},
    {"well2_paper",           {3,   "d53d97e483f12f4e"}, {0.002, "b73bdd10ac321b59"}},
    {"well2_drilling_paper",  {3,   "660558224b79ea74"}, {0.002, "b73bdd10ac321b59"}},
    {"well3_paper",           {3,   "7a8bf1c5b0838987"}, {0.002, "ce102024fffcf010"}},
    {"startup_field",       {8,   "7ac1065a30829c82"}, {0, ""}},
    {"whirl",               {1,   "ba349c935d6797d9"}, {0, ""}},
    {"stick_slip",          {3,   "1a29da15cf13db7f"}, {0, ""}},
    {"stick_slip_matched_drive", {3, "a9602a13e3181ff1"}, {0, ""}},
    {"connection",          {3,   "bfbf76915bdf7395"}, {0, ""}},
    {"torque_drag",         {3,   "de3d2947d2773c0a"}, {0.002, "b5bb571286ef63cb"}},
    {"pumped_mud",          {3,   "cf0ecd476c409dfd"}, {0.002, "ee67279f41523ca0"}},
    {"field_units",         {0.05, "9cfeb0fdf7284d9"}, {0.0001, "5f42f4bc3a941bef"}},
    {"buckling_heavy",      {1,   "18034a41a44ae606"}, {0.002, "5df6ce279330db8d"}},
    {"buckling_weightless", {1,   "69f7440f50bdd9b3"}, {0.002, "649bea5db9c93fe4"}},
};
// clang-format on

}  // namespace drillstrand::test
