/// `--set key.path=value` changes a case as if the file said so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

using testing::ElementsAre;

class OverriddenCase : public testing::Test {
  protected:
    OverriddenCase() {
        folder_.write("survey.csv", trial_survey);
        folder_.write("case.toml", trial_case);
    }
    [[nodiscard]] Case read(const Overrides& overrides) const {
        return folder_.read("case.toml", overrides);
    }
    [[nodiscard]] std::string message(const std::string& path, const std::string& value) const {
        return folder_.message("case.toml", {{path, value}});
    }

    TrialFolder folder_;
};

TEST_F(OverriddenCase, ValuesAreReadAsTomlElseAsText) {
    const Case changed = read({{"run.duration", "7"},
                               {"title", "Well \"7\" \\ north"},
                               {"bit.weight", "[[0, 0], [1, \"5 kN\"]]"},
                               {"bit.torque", "1 kN m"},
                               {"fluid.drag", "false"}});
    EXPECT_EQ(changed.run.duration, 7);
    EXPECT_EQ(changed.title, "Well \"7\" \\ north");
    EXPECT_THAT(changed.bit.weight.values(), ElementsAre(0, 5000));
    EXPECT_EQ(changed.bit.torque(0), 1000);
    EXPECT_FALSE(changed.fluid->drag);
}

TEST_F(OverriddenCase, KeysAndTablesThatTheFileLeavesOutAreAdded) {
    const Case changed = read({{"contact.law", "paper"}, {"mesh.segment_inertia", "true"}});
    EXPECT_EQ(changed.contact.law, FrictionLaw::paper);
    EXPECT_EQ(changed.mesh.segment_inertia, true);
}

TEST_F(OverriddenCase, EntriesOfListsAreReachedByNumber) {
    const Case changed =
        read({{"string.component.1.length", "50"}, {"head.rotation.1.1", "2 rad/s"}});
    EXPECT_EQ(changed.string.components[0].length, 400);
    EXPECT_EQ(changed.string.components[1].length, 50);
    EXPECT_THAT(changed.head.rotation.values(), ElementsAre(0, 2));
}

TEST_F(OverriddenCase, LaterOnesWin) {
    EXPECT_EQ(read({{"run.duration", "7"}, {"run.duration", "8"}}).run.duration, 8);
}

TEST_F(OverriddenCase, TheKeptTextReadsAsTheSameCase) {
    EXPECT_EQ(read({}).text, trial_case);
    const Case changed = read({{"run.absolute_tolerance", "3.3e-9"}, {"bit.weight", "1 kN"}});
    folder_.write("again.toml", changed.text);
    const Case again = folder_.read("again.toml");
    EXPECT_EQ(again.run.absolute_tolerance, 3.3e-9);
    EXPECT_EQ(again.bit.weight(0), 1000);
    EXPECT_EQ(again.string.components[1].linear_density,
              changed.string.components[1].linear_density);
}

TEST_F(OverriddenCase, MistakesAreLocatedAtTheOverride) {
    EXPECT_EQ(message("bit.wieght", "5"),
              R"(--set bit.wieght: unknown key "bit.wieght"; did you mean "weight"?)");
    EXPECT_EQ(message("run.duration", "5 kN"),
              "--set run.duration: run.duration: kN is a force; expected a time such as s, min, h");
    EXPECT_EQ(message("run.duration", "-5"),
              "--set run.duration: run.duration is -5; expected 1e-9 to 1e9 s");
    EXPECT_EQ(message("bits.weight", "5"),
              R"(--set bits.weight: unknown key "bits"; did you mean "bit"?)");
    EXPECT_EQ(message("run.duration.end", "5"),
              "--set run.duration.end: run.duration is a value; expected a table or a list to set "
              "a part of");
    EXPECT_EQ(message("string.component.2.length", "5"),
              "--set string.component.2.length: string.component has no entry \"2\"; expected a "
              "number below its 2 entries");
    EXPECT_EQ(message("string.component.1.lenght", "5"),
              "--set string.component.1.lenght: unknown key \"string.component.1.lenght\"; did you "
              "mean \"length\"?");
    EXPECT_EQ(message("run..duration", "5"),
              "--set run..duration: \"run..duration\" is not a key path; expected keys joined by "
              "dots, as in run.duration or string.component.0.length");
    EXPECT_EQ(message("title", "two\nlines"),
              "--set title: the value has a line break; expected one line");
    EXPECT_EQ(message("well.survey", "nowhere.csv"),
              "--set well.survey: cannot read \"nowhere.csv\": No such file or directory; expected "
              "an existing, readable file");
}

}  // namespace
}  // namespace drillstrand
