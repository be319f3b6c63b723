/// Damaged files end in an error of the input or, where the damage does no harm, in a case:
/// never in another exception.
#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <string>

#include "drillstrand/error.hpp"
#include "input/trial_case.hpp"

namespace drillstrand {
namespace {

/// Reads the case; the message of the error must be one line.
void expect_case_or_input_error(const TrialFolder& folder, const std::string& damage) {
    SCOPED_TRACE(damage);
    try {
        static_cast<void>(folder.read("case.toml"));
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

/// Changes some bytes to others.
std::string damaged(std::string text, std::mt19937& random) {
    std::uniform_int_distribution<std::size_t> place(0, text.size() - 1);
    std::uniform_int_distribution<int> byte(0, 255);
    std::uniform_int_distribution<int> count(1, 3);
    for (int k = count(random); k > 0; --k)
        text[place(random)] = static_cast<char>(byte(random));
    return text;
}

TEST(Robustness, TruncatedCasesAreCasesOrInputErrors) {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    for (std::size_t length = 0; length <= trial_case.size(); ++length) {
        folder.write("case.toml", trial_case.substr(0, length));
        expect_case_or_input_error(folder, std::to_string(length));
    }
}

TEST(Robustness, CasesWithFlippedBytesAreCasesOrInputErrors) {
    TrialFolder folder;
    folder.write("survey.csv", trial_survey);
    std::mt19937 random(20240229);
    for (int trial = 0; trial < 1000; ++trial) {
        const std::string text = damaged(trial_case, random);
        folder.write("case.toml", text);
        expect_case_or_input_error(folder, text);
    }
}

TEST(Robustness, SurveysWithFlippedBytesAreCasesOrInputErrors) {
    TrialFolder folder;
    folder.write("case.toml", trial_case);
    std::mt19937 random(20240301);
    for (int trial = 0; trial < 500; ++trial) {
        const std::string text = damaged(trial_survey, random);
        folder.write("survey.csv", text);
        expect_case_or_input_error(folder, text);
    }
}

TEST(Robustness, DeepNestingIsAnInputError) {
    TrialFolder folder;
    folder.write("case.toml", "title = " + std::string(100000, '['));
    EXPECT_THROW(static_cast<void>(folder.read("case.toml")), InputError);
}

TEST(Robustness, FilesThatCannotBeReadAreNamed) {
    TrialFolder folder;
    EXPECT_EQ(folder.message("absent.toml"),
              "absent.toml: cannot read \"absent.toml\": No such file or directory; expected an "
              "existing, readable file");
    EXPECT_EQ(folder.message("."), ".: cannot read \".\": it is a directory; expected a file");
}

}  // namespace
}  // namespace drillstrand
