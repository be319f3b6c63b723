// What a run says of itself, and starts that it refuses.
#include "drillstrand/run_summary.hpp"

#include <gmock/gmock.h>

#include "drillstrand/error.hpp"
#include "drillstrand/simulation.hpp"
#include "simulation/pipe_in_hole.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

RunSummary summary() {
    static const Scene scene = build_scene(pipe_in_hole(""));
    return RunSummary(scene);
}

SeriesRecord record_at(double time) {
    SeriesRecord record;
    record.time = time;
    return record;
}

TEST(RunSummary, TellsTheFallOfTheStartApartFromTheTimeErrorOfTheRun) {
    RunSummary run = summary();
    EXPECT_EQ(run.settled_after(), 1);  // axial waves need 0.05 s
    const auto add = [&](double time, double error) {
        SeriesRecord record = record_at(time);
        record.time_error = error;
        run.add(record);
    };
    add(0, 0.05);
    add(0.5, 0.3);
    for (const double time : {2.0, 3.0, 4.0, 5.0, 6.0})
        add(time, 0.001 * time);
    EXPECT_EQ(run.time_error_at_start(), 0.3);
    EXPECT_EQ(run.time_error_median(), 0.004);
    EXPECT_EQ(run.time_error_largest(), 0.006);
}

TEST(RunSummary, WarnsOfAPipeDeeperInTheWallThanItsClearance) {
    RunSummary run = summary();
    SeriesRecord record = record_at(1);
    record.max_penetration = 0.04;
    record.relative_penetration = 0.8;
    run.add(record);
    EXPECT_THAT(run.warnings(), IsEmpty());
    record.time = 2;
    record.max_penetration = 0.117;
    record.relative_penetration = 2.34;
    run.add(record);
    EXPECT_THAT(run.warnings(), ElementsAre(testing::AllOf(HasSubstr("0.117 m deep in the wall"),
                                                           HasSubstr("2.3 times its clearance"),
                                                           HasSubstr("t = 2 s"))));
    EXPECT_EQ(run.largest_penetration(), 0.117);
}

TEST(RunSummary, SaysWhereThePipeLayDeepestAndHowDeepAHelixWould) {
    RunSummary run = summary();
    EXPECT_THAT(run.findings(), IsEmpty());
    SeriesRecord record = record_at(1);
    record.max_penetration = 0.0123;
    record.relative_penetration = 0.246;
    record.penetration_depth = 43.5;
    record.helix_penetration = 2e-5;
    run.add(record);
    record.time = 2;
    record.max_penetration = 0.004;
    record.penetration_depth = 12;
    record.helix_penetration = 4e-5;
    run.add(record);
    EXPECT_THAT(run.findings().back(),
                testing::AllOf(testing::StartsWith("penetration: 12.3 mm"), HasSubstr("43.5 m"),
                               HasSubstr("t = 1 s"), HasSubstr("0.25 of the clearance"),
                               HasSubstr("0.04 mm")));
}

TEST(RunSummary, GoesOnFromWhatWasSavedAsIfItHadSeenAll) {
    RunSummary whole = summary();
    RunSummary part = summary();
    for (int k = 0; k < 40; ++k) {
        SeriesRecord record = record_at(0.1 * k);
        record.energy.kinetic = 3.0 * (k % 7);
        record.energy.work = 2.0 * k;
        record.max_penetration = 0.001 * ((k * 5) % 11);
        record.relative_penetration = record.max_penetration / 0.05;
        record.penetration_depth = 3 * k;
        record.helix_penetration = 1e-4 * (k % 5);
        record.head_rotation_rate = 10;
        record.bit_rotation_rate = 3.0 * (k % 8);
        record.bit_stress[3] = 1000.0 * (k % 5 - 3);
        record.weight_on_bit = 500;
        record.whirl = {0.1, 0.02 * (k % 9), -3, -4, 50};
        record.wall_drag = 100.0 * (k % 4);
        record.time_error = 1e-4 * (k / 3);
        whole.add(record);
        if (k == 20) {
            RunSummary later = summary();
            later.restore(part.save());
            part = later;
        }
        part.add(record);
    }
    EXPECT_EQ(part.energy_residual(), whole.energy_residual());
    EXPECT_EQ(part.largest_penetration(), whole.largest_penetration());
    EXPECT_EQ(part.time_error_median(), whole.time_error_median());
    EXPECT_EQ(part.warnings(), whole.warnings());
    EXPECT_EQ(part.findings(), whole.findings());
    EXPECT_EQ(part.findings().size(), 5U);
    EXPECT_EQ(part.bit().stick_slip_index, whole.bit().stick_slip_index);
    EXPECT_THROW(part.restore({}), std::invalid_argument);
}

std::string refusal_of(const std::string& more) {
    try {
        static_cast<void>(starting_scene(pipe_in_hole(more)));
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(Start, DeeperInTheWallThanTheClearanceIsRefused) {
    EXPECT_EQ(refusal_of("[initial]\noffset = [0.099, 0, 0]\n"), "");
    EXPECT_THAT(refusal_of("[initial]\noffset = [0.101, 0, 0]\n"),
                testing::AllOf(HasSubstr("0.051 m deep in the wall"), HasSubstr("0.05 m")));
}

TEST(Start, MayStateItsOwnLimit) {
    const std::string deep = "[initial]\noffset = [0.101, 0, 0]\npenetration_limit = ";
    EXPECT_EQ(refusal_of(deep + "0.06\n"), "");
    EXPECT_THAT(refusal_of(deep + "0.01\n"), HasSubstr("initial.penetration_limit"));
}

TEST(Run, ThatLeavesTheWellStops) {
    Case input = pipe_in_hole(
        "[head]\ndirection = [0, 0, 1]\n[bit]\nforce = [2e5, 0, 0]\n"
        "[contact]\nnormal_stiffness = 1000\nnormal_damping = 0\n"
        "[output]\ninterval = 0.01\n");
    EXPECT_THROW(static_cast<void>(run(input)), GuardError);
}

}  // namespace
}  // namespace drillstrand::test
