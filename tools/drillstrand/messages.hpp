/// The three standard streams: what is said to a person, and what must not fail for it.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace drillstrand::program {

/// Opens the null device in place of standard streams that the caller closed. To be called before
/// anything else: the next file to be opened would take their numbers, and messages would go into
/// it.
void open_missing_streams();

/// Writes to the error stream. A message that cannot be written is dropped: it never fails.
void write_message(std::string_view text) noexcept;

template <class... Parts>
void say(fmt::format_string<Parts...> text, Parts&&... parts) noexcept {
    try {
        fmt::memory_buffer line;
        fmt::format_to(std::back_inserter(line), text, std::forward<Parts>(parts)...);
        write_message({line.data(), line.size()});
    } catch (...) {
        // without memory for it there is no message
    }
}

/// Brings the standard output to its end. Returns the error of the system (as errno) where it did
/// not take everything, 0 otherwise. A reader who closed the pipe has had enough, which is no
/// error.
int finish_standard_output();

}  // namespace drillstrand::program
