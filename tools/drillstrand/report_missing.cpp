/// drillstrand report in a build that has no plotting library for its pages.
#include "commands.hpp"

namespace drillstrand::program {

int report(const ReportOptions& /*options*/) {
    throw UsageError(
        "report: this build has no report; in the folder of its source type npm ci --prefix "
        "tools/report, then build it with -D DRILLSTRAND_REPORT=ON");
}

}  // namespace drillstrand::program
