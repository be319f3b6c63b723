#include "drillstrand/version.hpp"

#include "drillstrand_version.hpp"

namespace drillstrand {

std::string version() {
    return DRILLSTRAND_VERSION;
}

std::string commit() {
    return DRILLSTRAND_COMMIT;
}

}  // namespace drillstrand
