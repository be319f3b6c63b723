/// Which drillstrand this is.
#pragma once

#include <string>

namespace drillstrand {

/// "0.1.0"
std::string version();

/// Abbreviated git commit the library was built from, with "-dirty" where files differed from it;
/// "unknown" where it was not built from a git checkout.
std::string commit();

}  // namespace drillstrand
