/// Signals that a run minds.
#pragma once

namespace drillstrand::program {

/// From now on SIGINT, SIGTERM and SIGHUP ask the run to stop (another one, half a second later or
/// more, ends the program at once), and a file that grows past a limit is an error of the write
/// rather than the end of the program.
void watch_signals();

[[nodiscard]] bool stop_requested();

}  // namespace drillstrand::program
