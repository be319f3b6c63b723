// A run that cannot go on says where and when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "drillstrand/error.hpp"
#include "support/run_case.hpp"

namespace drillstrand::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Case pipe_in_well() {
    Case input;
    WellCase well;
    well.survey = {{0, 0.5, 0}, {100, 0.5, 0}};
    well.sections = {{100, 0.2}};
    input.well = well;
    Component pipe;
    pipe.length = 60;
    pipe.outer_diameter = 0.14;
    pipe.inner_diameter = 0.12;
    pipe.linear_density = 31.8557;
    pipe.youngs_modulus = 200e9;
    input.string.components = {pipe};
    input.mesh.segments = 40;
    input.mesh.segment_inertia = true;
    input.run.integrator = IntegratorKind::dormand_prince;
    input.run.duration = 1;
    input.run.threads = 1;
    return input;
}

std::string failure_of(const Case& input) {
    try {
        run(input);
    } catch (const SimulationError& error) {
        return error.what();
    }
    return "no failure";
}

TEST(Failure, OfAnAbsurdlyStiffWallIsAnErrorWithTimeAndPlace) {
    Case input = pipe_in_well();
    input.contact.normal_stiffness = 1e300;
    EXPECT_THAT(failure_of(input), AllOf(HasSubstr("t = 0.1"), HasSubstr("between nodes"),
                                         HasSubstr("along the string")));
}

TEST(Failure, OfANumberThatIsNotFiniteIsNoticed) {
    Case input = pipe_in_well();
    input.bit.force = Eigen::Vector3d(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    EXPECT_THAT(failure_of(input), AllOf(HasSubstr("t = 0.000000 s"), HasSubstr("nodes 32 and 40"),
                                         HasSubstr("60.0 m along the string")));
}

TEST(Failure, OnSeveralThreadsIsTheSameError) {
    Case input = pipe_in_well();
    input.bit.force = Eigen::Vector3d(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    const std::string alone = failure_of(input);
    input.run.threads = 3;
    EXPECT_EQ(failure_of(input), alone);
}

TEST(Failure, LeavesTheRecordsBeforeIt) {
    Case input = pipe_in_well();
    // the load runs away after 0.1 s
    input.bit.force =
        VectorSchedule({0.1, 0.11}, {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e300, 0, 0)});
    input.output.interval = 0.02;
    const Scene scene = build_scene(input);
    const auto integrator = make_integrator(scene, {});
    struct Counter : Observer {
        int records = 0;
        void on_series(const SeriesRecord& record) override {
            EXPECT_TRUE(std::isfinite(record.bit_position.norm()));
            ++records;
        }
        void on_profile(const Profile& /*profile*/) override {}
        bool on_progress(double /*time*/, const StepStatistics& /*statistics*/) override {
            return true;
        }
    } counter;
    EXPECT_THROW(simulate(*integrator, {1.0, 0.02, 0, 0, {}}, counter), SimulationError);
    EXPECT_EQ(counter.records, 6);
}

}  // namespace
}  // namespace drillstrand::test
