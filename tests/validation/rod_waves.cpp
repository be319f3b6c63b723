// Axial and torsional waves in a straight string, against d'Alembert's solutions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "validation/rod_cases.hpp"

namespace drillstrand {
namespace {

using namespace test;

using RodWaves = BothIntegrators;
INSTANTIATE_TEST_SUITE_P(By, RodWaves, both_integrators, integrator_name);

/// Times at which a signal passes its level upward, by linear interpolation.
std::vector<double> upward_passages(const std::vector<double>& time,
                                    const std::vector<double>& value, double level) {
    std::vector<double> result;
    for (std::size_t i = 1; i < time.size(); ++i) {
        if (value[i - 1] >= level || value[i] < level) continue;
        const double fraction = (level - value[i - 1]) / (value[i] - value[i - 1]);
        result.push_back(time[i - 1] + fraction * (time[i] - time[i - 1]));
    }
    return result;
}

/// After a sudden load on its free end, the end of a clamped rod goes to and fro between zero and
/// twice its displacement at rest, at constant speed and with the period 4 L/c.
void expect_triangle_wave(const std::vector<double>& time, const std::vector<double>& value,
                          double at_rest, double period) {
    // dispersion rounds the corners
    double worst = 0;
    for (std::size_t i = 0; i < time.size(); ++i) {
        const double phase = std::fmod(time[i] / period, 1.0);
        const double exact = 2 * at_rest * (phase < 0.5 ? 2 * phase : 2 - 2 * phase);
        worst = std::max(worst, std::abs(value[i] - exact));
    }
    EXPECT_LT(worst, 0.02 * 2 * at_rest);
    const std::vector<double> passages = upward_passages(time, value, at_rest);
    ASSERT_EQ(passages.size(), 4U);
    EXPECT_NEAR((passages[3] - passages[0]) / (3 * period), 1, 1e-3);
}

std::string four_periods(IntegratorKind integrator, double period) {
    return mesh_and_run(integrator, 96, false, 4 * period) +
           fmt::format("[output]\ninterval = {:.17g}\n", period / 100);
}

TEST_P(RodWaves, SuddenAxialForceMovesTheFreeEndInATriangleWave) {
    // closed form: twice F L/EA, 4 L/c with c = 5323.7677 m/s
    const double force = 1e5;
    const double period = 0.01803234197268937;
    const test::Run result =
        run("gravity = 0\n" + table_2_pipe() + four_periods(integrator(), period) +
            fmt::format("[head]\ndirection = [1, 0, 0]\n"
                        "[bit]\nforce = [{}, 0, 0]\n",
                        force));
    std::vector<double> time;
    std::vector<double> stretch;
    for (const SeriesRecord& record : result.series) {
        time.push_back(record.time);
        stretch.push_back(record.bit_position.x() - 24);
        // a push along the axis moves nothing across it
        EXPECT_EQ(record.bit_position.y(), 0);
        EXPECT_EQ(record.bit_position.z(), 0);
    }
    expect_triangle_wave(time, stretch, force * 24 / table_2_axial_stiffness, period);
}

TEST_P(RodWaves, SuddenTorqueTurnsTheFreeEndInATriangleWave) {
    // closed form: twice M L/GJ, 4 L/c with c = 3764.4723 m/s; GJ = EI where nu = 0
    const double moment = 1e3;
    const double period = 4 * 24 / 3764.4723;
    const test::Run result =
        run("gravity = 0\n" + table_2_pipe() + four_periods(integrator(), period) +
            fmt::format("profile_interval = {:.17g}\n[head]\ndirection = [1, 0, 0]\n"
                        "[bit]\nmoment = [{}, 0, 0]\n",
                        period / 100, moment));
    std::vector<double> time;
    std::vector<double> turn;
    for (const Profile& profile : result.profiles) {
        time.push_back(profile.time);
        turn.push_back(0);
        for (const Vector6& stress : profile.stress) {
            turn.back() += stress[0] / table_2_bending_stiffness * 24 /
                           static_cast<double>(profile.stress.size());
        }
    }
    expect_triangle_wave(time, turn, moment * 24 / table_2_bending_stiffness, period);
}

/// Casing of table 4, 515 m long, without friction and weight, for ten seconds.
test::Run well_1_string(IntegratorKind integrator, const std::string& loads) {
    return run("gravity = 0\n" + table_4_pipe() + mesh_and_run(integrator, 86, true, 10) +
               "[output]\ninterval = 0.002\nprofile_interval = 0\n" + loads);
}

/// Least and largest value of a component of the head's stress from a time on.
struct Range {
    double least = 1e300;
    double most = -1e300;
};
Range head_range(const test::Run& run, Eigen::Index component, double from) {
    Range range;
    for (const SeriesRecord& record : run.series) {
        if (record.time < from) continue;
        range.least = std::min(range.least, record.head_stress[component]);
        range.most = std::max(range.most, record.head_stress[component]);
    }
    return range;
}

TEST_P(RodWaves, RampsOfWeightAndTorqueReachTheTopAsSumsOfTheirReflections) {
    // closed form (d'Alembert): load at the top 2 sum (-1)^k F(t - (2k + 1) L/c); ramps of 5 s to
    // 10 kN m and 65 kN
    const test::Run result = well_1_string(integrator(),
                                           "[bit]\nmoment = [[0, [0, 0, 0]], [5, [-10000, 0, 0]]]\n"
                                           "weight = [[0, 0], [5, 65000]]\n");
    struct Instant {
        double time;
        double torque;
        double weight;
    };
    const Instant exact[] = {
        {0.5, 1155.4650347710563, 5310.741549818665}, {1, 2266.802447843415, 12723.146125453337},
        {2, 3955.872378301303, 26553.70774909333},    {3, 5777.32517385528, 38169.438376360005},
        {4, 8088.255243397392, 53107.41549818664},    {5, 10178.547204446022, 63728.89859782401},
        {6, 9600.814687060489, 66271.10140217602}};
    for (const Instant& instant : exact) {
        const SeriesRecord& record =
            result.series.at(static_cast<std::size_t>(std::lround(instant.time / 0.002)));
        EXPECT_NEAR(-record.head_stress[0], instant.torque, 30) << instant.time << " s";
        EXPECT_NEAR(-record.head_stress[3], instant.weight, 150) << instant.time << " s";
    }
    const Range torque = head_range(result, 0, 5);
    EXPECT_NEAR(-torque.most, 9600.814687060472, 20);
    EXPECT_NEAR(-torque.least, 10399.18531293952, 20);
    const Range force = head_range(result, 3, 5);
    EXPECT_NEAR(-force.most, 63728.89859782378, 100);
    EXPECT_NEAR(-force.least, 66271.10140217622, 100);
}

TEST_P(RodWaves, SpinUpOfTheTopDriveLeavesTheTorqueRingingByItsDAlembertAmplitude) {
    // closed form (d'Alembert): rigid drive, 2 s ramp to 1.83 Hz
    const test::Run result =
        well_1_string(integrator(), "[head]\nrotation = [[0, 0], [2, \"1.83 Hz\"]]\n");
    // twist is negative where the head runs ahead; dispersion overshoots the corners by 1 %
    const Range all = head_range(result, 0, 0);
    EXPECT_NEAR(-all.least, 4284.935768568532, 60);
    EXPECT_NEAR(-all.most, -3957.6660872506986, 60);
    const Range ringing = head_range(result, 0, 2);
    EXPECT_NEAR(-ringing.least, 3957.6660872506986, 60);
    EXPECT_NEAR(-ringing.most, -3957.6660872506986, 60);
}

}  // namespace
}  // namespace drillstrand
