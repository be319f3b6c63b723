/// What is no regular file, or no sensible one, is refused at once.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <string>

#include "drillstrand/error.hpp"
#include "drillstrand/measured.hpp"
#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

/// The trial case beside some files of other kinds.
class OtherFiles : public testing::Test {
  protected:
    OtherFiles() {
        folder_.write("survey.csv", trial_survey);
        folder_.write("case.toml", trial_case);
    }

    /// The messages where a case is asked for, a survey, a component table and measured channels.
    void expect_refusal(const std::string& name, const std::string& why) {
        const std::string words = "cannot read \"" + name + "\": " + why;
        EXPECT_EQ(folder_.message(name), name + ": " + words);
        EXPECT_EQ(folder_.message("case.toml", {{"well.survey", name}}),
                  "--set well.survey: " + words);
        folder_.write("case.toml", with_component_file(trial_case, name));
        EXPECT_EQ(folder_.message("case.toml"), "case.toml:12:14: " + words);
        folder_.write("case.toml", trial_case);
        try {
            static_cast<void>(read_measured(folder_.path(name)));
            ADD_FAILURE() << name << " was read";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
        }
    }

    TrialFolder folder_;
};

TEST_F(OtherFiles, APipeIsNotWaitedFor) {
    ASSERT_EQ(::mkfifo(folder_.path("pipe").c_str(), 0600), 0);
    expect_refusal("pipe", "it is a pipe; expected a file");
}

TEST_F(OtherFiles, ADeviceIsNotReadForEver) {
    std::filesystem::create_symlink("/dev/zero", folder_.path("zero"));
    expect_refusal("zero", "it is a device; expected a file");
}

TEST_F(OtherFiles, ASocketIsNotOpened) {
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = folder_.path("socket").string();
    ASSERT_LT(path.size(), sizeof(address.sun_path));
    std::memcpy(address.sun_path, path.c_str(), path.size());
    ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    expect_refusal("socket", "it is a socket; expected a file");
    ::close(socket);
}

TEST_F(OtherFiles, ALinkToItselfIsNamed) {
    std::filesystem::create_symlink("loop", folder_.path("loop"));
    expect_refusal("loop",
                   "Too many levels of symbolic links; expected an existing, readable file");
}

TEST_F(OtherFiles, AHugeFileIsNotReadAtAll) {
    folder_.write("huge", "");
    std::filesystem::resize_file(folder_.path("huge"), std::uintmax_t{1} << 40U);
    expect_refusal("huge", "larger than 64 MiB; expected a text file");
}

TEST_F(OtherFiles, ATableOfOneEndlessLineIsRefusedAtItsFirstColumnTooMany) {
    std::string header = "md,inclination,azimuth";
    for (int k = 0; k < 1'000'000; ++k)
        header += ",a";
    folder_.write("survey.csv", header);
    EXPECT_EQ(folder_.message("case.toml"),
              "survey.csv:1:2018: the line has more fields; expected at most 1000 columns");
}

TEST_F(OtherFiles, KeysNestedWithoutEndAreRefused) {
    std::string path = "a";
    for (int k = 0; k < 500'000; ++k)
        path += ".a";
    const std::string refusal = "a path of too many keys; expected at most 16, joined by dots";
    folder_.write("case.toml",
                  "title = \"...................\" # ...................\n" + path + " = 1\n");
    EXPECT_EQ(folder_.message("case.toml"), "case.toml:2:1: " + refusal);
    folder_.write("case.toml", "[\"a.b\"." + path + "]\n");
    EXPECT_EQ(folder_.message("case.toml"), "case.toml:1:1: " + refusal);
    folder_.write("case.toml", trial_case);
    EXPECT_EQ(folder_.message("case.toml", {{path, "1"}}), "--set " + path + ": " + refusal);
    EXPECT_EQ(folder_.read("case.toml", {{"title", "and so on ......................"}}).title,
              "and so on ......................");
}

}  // namespace
}  // namespace drillstrand
