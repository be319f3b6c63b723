#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "messages.hpp"
#include "wording.hpp"

namespace drillstrand::program {

namespace {

constexpr auto bar_period = std::chrono::milliseconds(200);
constexpr auto line_period = std::chrono::seconds(10);
constexpr auto rate_window = std::chrono::seconds(10);
constexpr int bar_width = 30;

double seconds(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

}  // namespace

Progress::Progress(double begin, double duration, bool quiet)
    : duration_(duration),
      quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) == 1),
      older_{start_, begin},
      newer_(older_) {
    next_print_ = start_ + (terminal_ ? Clock::duration(bar_period) : line_period);
}

Progress::~Progress() {
    clear();
}

void Progress::update(double time) {
    const Clock::time_point now = Clock::now();
    if (quiet_ || now < next_print_) return;
    if (now - newer_.wall > rate_window) {
        older_ = newer_;
        newer_ = {now, time};
    }
    print(time);
    next_print_ = now + (terminal_ ? Clock::duration(bar_period) : line_period);
}

void Progress::clear() {
    if (!bar_shown_) return;
    say("\r\x1b[K");
    bar_shown_ = false;
}

double Progress::wall_seconds() const {
    return seconds(Clock::now() - start_);
}

double Progress::rate(const Mark& now) const {
    const double wall = seconds(now.wall - older_.wall);
    return wall > 0 ? (now.time - older_.time) / wall : 0;
}

void Progress::print(double time) {
    const double speed = rate({Clock::now(), time});
    const std::string left = speed > 0 ? duration_text((duration_ - time) / speed) : "unknown";
    const std::string text = fmt::format("{:.4g} of {:.4g} s simulated, {:.3g} s per s, {} left",
                                         time, duration_, speed, left);
    if (terminal_) {
        const double fraction = duration_ > 0 ? std::clamp(time / duration_, 0.0, 1.0) : 1.0;
        const int filled = static_cast<int>(fraction * bar_width);
        say("\r[{:#<{}}{:.<{}}] {}\x1b[K", "", filled, "", bar_width - filled, text);
        bar_shown_ = true;
    } else {
        say("drillstrand: {}\n", text);
    }
}

}  // namespace drillstrand::program
