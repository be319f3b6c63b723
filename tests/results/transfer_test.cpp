/// Results that go through a pipe from the process that reads to the one that shows.
#include "transfer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "results/made_up_run.hpp"

namespace drillstrand::program {
namespace {

template <class Value>
Value through_a_pipe(Value value) {
    std::array<int, 2> ends = {};
    if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    std::thread sender([&] {
        Sender pipe(ends[1]);
        transfer(pipe, value);
        pipe.flush();
        ::close(ends[1]);
    });
    Value received;
    Receiver pipe(ends[0]);
    transfer(pipe, received);
    sender.join();
    ::close(ends[0]);
    return received;
}

TEST(Transfer, EverythingOfARunComesThrough) {
    MadeUpRun run(37);
    Result sent;
    sent.header = run.header();
    sent.footer = run.footer("failed: \n");
    sent.version = "1.2.3";
    sent.commit = "abc";
    for (int k = 0; k < 700; ++k)
        sent.series.push_back(run.series(k));
    for (int k = 0; k < 20; ++k)
        sent.profiles.push_back(run.profile(k));
    sent.header.cycles = CyclesCase{0.02, 3};
    sent.header.sensors = {{"mwd", 1200.5, 0.06, 0.005}, {"bit", 1300, 0, 0.01}};
    sent.footer.cycles = run.cycles();
    sent.sensors = {{run.sensor(0), run.sensor(0.005)}, {}};
    const Result got = through_a_pipe(sent);
    EXPECT_EQ(got.header.cycles->slope, 3);
    EXPECT_EQ(got.header.sensors.at(1).depth, 1300);
    EXPECT_EQ(got.footer.cycles.largest_range, sent.footer.cycles.largest_range);
    ASSERT_EQ(got.sensors.at(0).size(), 2U);
    expect_same_bits(got.sensors[0][1], sent.sensors[0][1], sensor_datasets("mwd"));
    EXPECT_TRUE(got.sensors.at(1).empty());
    EXPECT_EQ(got.header.title, sent.header.title);
    EXPECT_EQ(got.header.case_text, sent.header.case_text);
    EXPECT_EQ(got.header.integrator, sent.header.integrator);
    EXPECT_EQ(got.header.threads, sent.header.threads);
    EXPECT_EQ(got.version, "1.2.3");
    EXPECT_EQ(got.commit, "abc");
    EXPECT_EQ(got.footer.status, sent.footer.status);
    EXPECT_EQ(got.footer.wall_seconds, sent.footer.wall_seconds);
    EXPECT_EQ(got.footer.energy_residual, sent.footer.energy_residual);
    EXPECT_EQ(got.footer.stick_slip_index, sent.footer.stick_slip_index);
    EXPECT_EQ(got.footer.stuck_share, sent.footer.stuck_share);
    EXPECT_EQ(got.footer.unloaded_share, sent.footer.unloaded_share);
    EXPECT_EQ(got.footer.warnings, sent.footer.warnings);
    EXPECT_EQ(got.footer.findings, sent.footer.findings);
    EXPECT_EQ(got.footer.statistics.steps, sent.footer.statistics.steps);
    EXPECT_EQ(got.footer.statistics.rejected, sent.footer.statistics.rejected);
    EXPECT_EQ(got.footer.statistics.evaluations, sent.footer.statistics.evaluations);
    EXPECT_EQ(got.footer.statistics.smallest_step, sent.footer.statistics.smallest_step);
    EXPECT_EQ(got.footer.statistics.largest_step, sent.footer.statistics.largest_step);
    EXPECT_EQ(got.footer.statistics.time_error, sent.footer.statistics.time_error);
    expect_same_bits(got.header, sent.header, mesh_datasets());
    expect_same_bits(got.header, sent.header, string_datasets());
    for (const auto& entry : well_datasets())
        EXPECT_EQ(entry.values(*got.header.well), entry.values(*sent.header.well)) << entry.path;
    expect_same_walls(*got.header.well, *sent.header.well);
    ASSERT_EQ(got.series.size(), sent.series.size());
    for (std::size_t k = 0; k < got.series.size(); ++k)
        expect_same_bits(got.series[k], sent.series[k], series_datasets());
    ASSERT_EQ(got.profiles.size(), sent.profiles.size());
    for (std::size_t k = 0; k < got.profiles.size(); ++k)
        expect_same_bits(got.profiles[k], sent.profiles[k], profile_datasets());
}

TEST(Transfer, ARunWithoutAWellOrRecordsComesThrough) {
    Result sent;
    sent.header.node_s = {0, 1};
    const Result got = through_a_pipe(sent);
    EXPECT_FALSE(got.header.well);
    EXPECT_EQ(got.header.node_s, sent.header.node_s);
    EXPECT_TRUE(got.series.empty());
    EXPECT_TRUE(got.header.mass.empty());
}

TEST(Transfer, EveryBucklingModeComesThrough) {
    BucklingResult sent;
    sent.header = MadeUpRun(4).header();
    sent.discretisation = Discretisation::paper;
    sent.modes = {{5, {4, Vector6::LinSpaced(1, 6)}}, {7, {4, Vector6::LinSpaced(7, 12)}}};
    sent.instability = Instability{9, {{-8, {4, Vector6::LinSpaced(13, 18)}}}};
    const BucklingResult got = through_a_pipe(sent);
    EXPECT_EQ(got.discretisation, Discretisation::paper);
    ASSERT_EQ(got.modes.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k)
        expect_same_bits(got.modes[k], sent.modes[k], buckling_datasets());
    ASSERT_TRUE(got.instability);
    EXPECT_EQ(got.instability->load, 9);
    ASSERT_EQ(got.instability->modes.size(), 1U);
    expect_same_bits(got.instability->modes[0], sent.instability->modes[0], instability_datasets());
}

TEST(Transfer, EveryMotionOfTorqueAndDragComesThrough) {
    TorqueDragResult sent;
    sent.study.bit_depth = {1, 2};
    sent.study.measured_depth = {3, 4, 5};
    TorqueDragCurve curve;
    curve.motion = TorqueDragMotion::drilling;
    for (const auto* table : {&torque_drag_depth_datasets(), &torque_drag_profile_datasets()})
        for (const TorqueDragDataset& entry : *table)
            entry.assign(curve, {-1, 2});
    sent.study.curves = {curve};
    const TorqueDragResult got = through_a_pipe(sent);
    EXPECT_EQ(got.study.bit_depth, sent.study.bit_depth);
    EXPECT_EQ(got.study.measured_depth, sent.study.measured_depth);
    ASSERT_EQ(got.study.curves.size(), 1U);
    EXPECT_EQ(got.study.curves[0].motion, TorqueDragMotion::drilling);
    for (const auto* table : {&torque_drag_depth_datasets(), &torque_drag_profile_datasets()})
        for (const TorqueDragDataset& entry : *table)
            EXPECT_EQ(entry.values(got.study.curves[0]), entry.values(curve)) << entry.name;
}

TEST(Transfer, EveryModeOfVibrationComesThrough) {
    ModesResult sent;
    sent.header = MadeUpRun(1).header();
    sent.rotation_rate = 3;
    sent.grip = WallGrip::slides;
    sent.shape = {{2, Eigen::Vector3d(1, 2, 3)}, {2, Eigen::Vector3d(4, 5, 6)}, {7, 8}};
    const std::vector<Eigen::Vector3d> motion(2, Eigen::Vector3d(7, 8, 9));
    sent.modes = {{1, ModeKind::axial, 0.1, 0.2, 0.7, -1, 4, 5, motion, motion, motion, motion}};
    sent.campbell = {{1, 2, ModeKind::torsional, 0.5}};
    sent.critical_speeds = {{6, 2, ModeKind::axial, -0.5}};
    sent.excitation = Excitation{3, true, 4, 5};
    sent.response = {{1, 2, 1, {3, 4}, {5, 6}, {7, 8}, {9}, {10}, {11}}};
    const ModesResult got = through_a_pipe(sent);
    EXPECT_EQ(got.rotation_rate, 3);
    EXPECT_EQ(got.grip, WallGrip::slides);
    expect_same_bits(got.shape, sent.shape, static_shape_datasets());
    ASSERT_EQ(got.modes.size(), 1U);
    expect_same_bits(got.modes[0], sent.modes[0], mode_datasets());
    ASSERT_EQ(got.campbell.size(), 1U);
    expect_same_bits(got.campbell[0], sent.campbell[0], campbell_datasets());
    ASSERT_EQ(got.critical_speeds.size(), 1U);
    expect_same_bits(got.critical_speeds[0], sent.critical_speeds[0], critical_speed_datasets());
    ASSERT_TRUE(got.excitation);
    EXPECT_EQ(got.excitation->order, 3);
    EXPECT_TRUE(got.excitation->unbalance);
    EXPECT_EQ(got.excitation->bit_force, 4);
    EXPECT_EQ(got.excitation->bit_torque, 5);
    ASSERT_EQ(got.response.size(), 1U);
    expect_same_bits(got.response[0], sent.response[0], response_datasets());
}

/// A list that claims more than follows: what reads it neither waits nor takes memory for it.
TEST(Transfer, EveryRowOfACheckpointComesThrough) {
    Checkpoint sent;
    sent.header = MadeUpRun(3).header();
    sent.version = "1.2.3";
    sent.commit = "abc";
    sent.time = 0.25;
    sent.wall_seconds = 7;
    sent.series = 11;
    sent.profiles = 2;
    sent.state = {{"rod/position", "m", {1, 2, 3}}, {"bit/turns", "1", {}}};
    sent.summary = {{"largest", "m", {0.5}}};
    sent.scene = {{"mesh/node_s", "m", {0, 1}}};
    const Checkpoint got = through_a_pipe(sent);
    EXPECT_EQ(got.header.case_text, sent.header.case_text);
    EXPECT_EQ(got.version, "1.2.3");
    EXPECT_EQ(got.commit, "abc");
    EXPECT_EQ(got.time, 0.25);
    EXPECT_EQ(got.wall_seconds, 7);
    EXPECT_EQ(got.series, 11U);
    EXPECT_EQ(got.profiles, 2U);
    ASSERT_EQ(got.state.size(), 2U);
    EXPECT_EQ(got.state[0].name, "rod/position");
    EXPECT_EQ(got.state[0].unit, "m");
    EXPECT_EQ(got.state[0].values, sent.state[0].values);
    EXPECT_EQ(got.state[1].name, "bit/turns");
    EXPECT_TRUE(got.state[1].values.empty());
    ASSERT_EQ(got.summary.size(), 1U);
    EXPECT_EQ(got.summary[0].values, sent.summary[0].values);
    ASSERT_EQ(got.scene.size(), 1U);
    EXPECT_EQ(got.scene[0].values, sent.scene[0].values);
}

TEST(Transfer, AListThatEndsEarlyIsAnError) {
    std::array<int, 2> ends = {};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const std::uint64_t claimed = std::uint64_t{1} << 60;
    ASSERT_EQ(::write(ends[1], &claimed, sizeof claimed), static_cast<ssize_t>(sizeof claimed));
    ::close(ends[1]);
    Receiver pipe(ends[0]);
    std::vector<double> values;
    EXPECT_THROW(transfer(pipe, values), BrokenPipe);
    ::close(ends[0]);
}

}  // namespace
}  // namespace drillstrand::program
