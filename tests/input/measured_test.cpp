#include "drillstrand/measured.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "drillstrand/error.hpp"
#include "results/made_up_run.hpp"

namespace drillstrand {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Measured : public testing::Test {
  protected:
    MeasuredChannels read(const std::string& text) {
        std::ofstream(folder_ / "rig.csv") << text;
        return read_measured(folder_ / "rig.csv");
    }

    std::string error_of(const std::string& text) {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    }

    ScratchFolder folder_;
};

TEST_F(Measured, ChannelsOfARigInItsUnitsComeInSi) {
    const MeasuredChannels channels =
        read("Time[min],block[m],Hook_Load[klbf],torque[klbf ft]\n0,1,100,2\n0.5,1,110,2.5\n");
    EXPECT_THAT(channels.time, ElementsAre(0, 30));
    EXPECT_THAT(channels.hook_load,
                ElementsAre(DoubleNear(444822.16, 0.01), DoubleNear(489304.38, 0.01)));
    EXPECT_THAT(channels.torque,
                ElementsAre(DoubleNear(2711.6359, 1e-3), DoubleNear(3389.5449, 1e-3)));
}

TEST_F(Measured, AChannelMayBeMissing) {
    EXPECT_THAT(read("time[s],torque[kN m]\n0,1\n1,2\n").hook_load, IsEmpty());
    EXPECT_THAT(
        error_of("time[s],rotation[rpm]\n0,1\n"),
        HasSubstr("rig.csv:1:1: nothing to compare; expected a column hook_load or torque"));
    EXPECT_THAT(error_of("torque[kN m]\n1\n"), HasSubstr("time"));
}

TEST_F(Measured, TimesThatDoNotAscendAreNamed) {
    EXPECT_THAT(error_of("time[s],torque[kN m]\n0,1\n2,2\n1,3\n"),
                HasSubstr("rig.csv:4:1: time is 1 after 2; expected ascending times"));
}

TEST_F(Measured, AWrongUnitIsNamed) {
    EXPECT_THAT(error_of("time[s],torque[kN]\n0,1\n"), HasSubstr("rig.csv:1:"));
}

}  // namespace
}  // namespace drillstrand
