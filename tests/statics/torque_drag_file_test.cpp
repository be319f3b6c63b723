/// Files of torque and drag: what is written is read back.
#include "drillstrand/torque_drag_file.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "drillstrand/error.hpp"

namespace drillstrand {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

/// Values that tell their dataset and place.
TorqueDragCurve made_up_curve(TorqueDragMotion motion, double first) {
    TorqueDragCurve curve;
    curve.motion = motion;
    double value = first;
    for (const TorqueDragDataset& entry : torque_drag_depth_datasets())
        entry.assign(curve, entry.integer ? std::vector<double>{-1, 2}
                                          : std::vector<double>{++value, ++value});
    for (const TorqueDragDataset& entry : torque_drag_profile_datasets())
        entry.assign(curve, entry.integer ? std::vector<double>{0, 1, 2}
                                          : std::vector<double>{++value, ++value, ++value});
    return curve;
}

TorqueDragResult made_up_result() {
    TorqueDragResult result;
    result.header.title = "Made up";
    result.header.case_text = "title = \"Made up\"\n";
    result.study.bit_depth = {100, 200};
    result.study.node_s = {0, 10, 20, 30};
    result.study.segment_s = {5, 15, 25};
    result.study.measured_depth = {175, 185, 195};
    result.header.node_s = result.study.node_s;
    result.header.segment_s = result.study.segment_s;
    result.study.curves = {made_up_curve(TorqueDragMotion::tripping_out, 1000),
                           made_up_curve(TorqueDragMotion::drilling, 2000)};
    return result;
}

class TorqueDragFile : public testing::Test {
  protected:
    TorqueDragFile() {
        std::string name = (fs::temp_directory_path() / "drillstrand-test-XXXXXX").string();
        if (mkdtemp(name.data()) != nullptr) folder_ = name;
    }
    ~TorqueDragFile() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::string text(const std::string& name) const {
        std::ostringstream stream;
        stream << std::ifstream(path(name)).rdbuf();
        return stream.str();
    }

  private:
    fs::path folder_;
};

TEST_F(TorqueDragFile, GivesBackWhatWasWritten) {
    const TorqueDragResult written = made_up_result();
    write_torque_drag(path("out.h5"), written);
    EXPECT_TRUE(holds_torque_drag(path("out.h5")));
    const TorqueDragResult read = read_torque_drag(path("out.h5"));
    EXPECT_EQ(read.header.title, "Made up");
    EXPECT_EQ(read.header.case_text, written.header.case_text);
    EXPECT_EQ(read.header.node_s, written.header.node_s);
    EXPECT_EQ(read.study.bit_depth, written.study.bit_depth);
    EXPECT_EQ(read.study.measured_depth, written.study.measured_depth);
    ASSERT_EQ(read.study.curves.size(), 2U);
    for (std::size_t m = 0; m < 2; ++m) {
        EXPECT_EQ(read.study.curves[m].motion, written.study.curves[m].motion);
        for (const auto* table : {&torque_drag_depth_datasets(), &torque_drag_profile_datasets()})
            for (const TorqueDragDataset& entry : *table)
                EXPECT_EQ(entry.values(read.study.curves[m]), entry.values(written.study.curves[m]))
                    << entry.name;
    }
}

TEST_F(TorqueDragFile, KeepsWhatIsMissing) {
    TorqueDragResult result = made_up_result();
    result.study.curves[0].hook_load = {std::numeric_limits<double>::quiet_NaN(), 5};
    write_torque_drag(path("out.h5"), result);
    const TorqueDragResult read = read_torque_drag(path("out.h5"));
    EXPECT_THAT(read.study.curves[0].hook_load, ElementsAre(IsNan(), 5));
    write_torque_drag_table(path("out.csv"), result.study);
    EXPECT_THAT(text("out.csv"), HasSubstr("\n100,nan,"));
}

TEST_F(TorqueDragFile, EveryDatasetHasUnitsAndADescription) {
    for (const auto* table : {&torque_drag_depth_datasets(), &torque_drag_profile_datasets()})
        for (const TorqueDragDataset& entry : *table) {
            EXPECT_FALSE(entry.units.empty()) << entry.name;
            EXPECT_FALSE(entry.description.empty()) << entry.name;
        }
}

TEST_F(TorqueDragFile, EveryDatasetIsListedInTheReadme) {
    std::ostringstream readme;
    readme << std::ifstream(DRILLSTRAND_SOURCE_DIR "/engine/results/README.md").rdbuf();
    const auto expect_row = [&](const TorqueDragDataset& entry, const std::string& group,
                                const std::string& shape) {
        EXPECT_THAT(readme.str(), HasSubstr("| `" + group + entry.name + "` | " + shape + " | " +
                                            entry.units + " | " + entry.description + " |"));
    };
    for (const TorqueDragDataset& entry : torque_drag_depth_datasets())
        expect_row(entry, "", "D");
    for (const TorqueDragDataset& entry : torque_drag_profile_datasets())
        expect_row(entry, "profile/", "N");
}

TEST_F(TorqueDragFile, TablesHaveAColumnForEveryMotionAndQuantity) {
    const TorqueDragResult result = made_up_result();
    write_torque_drag_table(path("out.csv"), result.study);
    EXPECT_EQ(text("out.csv"),
              "bit_depth[m],"
              "tripping_out_hook_load[N],tripping_out_surface_torque[N m],"
              "tripping_out_neutral_point[m],tripping_out_buckling,"
              "tripping_out_soft_hook_load[N],tripping_out_soft_surface_torque[N m],"
              "tripping_out_standpipe_pressure[Pa],tripping_out_bit_pressure[Pa],"
              "tripping_out_equivalent_density[kg/m3],tripping_out_mud_force[N],"
              "drilling_hook_load[N],drilling_surface_torque[N m],"
              "drilling_neutral_point[m],drilling_buckling,"
              "drilling_soft_hook_load[N],drilling_soft_surface_torque[N m],"
              "drilling_standpipe_pressure[Pa],drilling_bit_pressure[Pa],"
              "drilling_equivalent_density[kg/m3],drilling_mud_force[N]\n"
              "100,1001,1003,1005,-1,1007,1009,1011,1013,1015,1017,"
              "2001,2003,2005,-1,2007,2009,2011,2013,2015,2017\n"
              "200,1002,1004,1006,2,1008,1010,1012,1014,1016,1018,"
              "2002,2004,2006,2,2008,2010,2012,2014,2016,2018\n");
    write_torque_drag_profile_table(path("profile.csv"), result.study);
    EXPECT_THAT(text("profile.csv"), testing::StartsWith("measured_depth[m],"
                                                         "tripping_out_tension[N],"
                                                         "tripping_out_torque[N m],"
                                                         "tripping_out_side_force[N/m],"));
    EXPECT_THAT(text("profile.csv"), HasSubstr("\n185,1020,1023,1026,"));
}

TEST_F(TorqueDragFile, SomethingElseIsRefused) {
    std::ofstream(path("text.h5")) << "no result";
    EXPECT_THROW(static_cast<void>(holds_torque_drag(path("text.h5"))), ResultError);
    EXPECT_THROW(static_cast<void>(read_torque_drag(path("none.h5"))), ResultError);
    EXPECT_THROW(write_torque_drag_table(path("no/such/folder.csv"), made_up_result().study),
                 ResultError);
}

}  // namespace
}  // namespace drillstrand
