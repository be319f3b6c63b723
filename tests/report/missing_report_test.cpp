#include <gmock/gmock.h>

#include "commands.hpp"

namespace drillstrand::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(BuildWithoutReport, SaysInOneLineHowToGetIt) {
    try {
        report({});
        FAIL() << "nothing was thrown";
    } catch (const UsageError& error) {
        EXPECT_THAT(
            error.what(),
            AllOf(HasSubstr("this build has no report"), HasSubstr("npm ci --prefix tools/report"),
                  HasSubstr("-D DRILLSTRAND_REPORT=ON"), Not(HasSubstr("\n"))));
    }
}

}  // namespace
}  // namespace drillstrand::program
