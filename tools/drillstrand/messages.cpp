#include "messages.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace drillstrand::program {

void open_missing_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
        // the lowest free number, which is this one; without a null device, something that
        // refuses to be written
        if (::open("/dev/null", O_RDWR) < 0) static_cast<void>(::open("/", O_RDONLY));
    }
}

void write_message(std::string_view text) noexcept {
    while (!text.empty()) {
        const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

int finish_standard_output() {
    errno = 0;
    const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
    const int error = errno != 0 ? errno : EIO;
    return failed && error != EPIPE ? error : 0;
}

}  // namespace drillstrand::program
