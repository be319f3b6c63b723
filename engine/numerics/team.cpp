#include "numerics/team.hpp"

#include <algorithm>

namespace drillstrand {

bool Team::waits_too_long(double start, double now, double waited) const {
    const double all = waited_ + waited;
    return all > most_waiting && all > bearable_share * (time_ + now - start);
}

void Team::worked(double start, double now, double waited) {
    const bool fails = waits_too_long(start, now, waited);
    time_ += now - start;
    waited_ += waited;
    if (fails) {
        alone_until_ = now + pause_;
        pause_ = std::min(2 * pause_, longest_pause);
    } else if (time_ > window) {
        pause_ = shortest_pause;
    }
    if (fails || time_ > window) time_ = waited_ = 0;
}

}  // namespace drillstrand
