#include "read_apart.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <sys/time.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "drillstrand/error.hpp"
#include "transfer.hpp"

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;

/// What reading may take: far more than any sound file of its size does.
constexpr rlim_t seconds_of_any_file = 4;
constexpr rlim_t bytes_per_second = rlim_t{10} << 20;
constexpr std::size_t memory_of_any_file = std::size_t{256} << 20;
constexpr std::size_t memory_per_byte = 64;
/// How often the reading process looks at its memory, in its own time.
constexpr suseconds_t watch_period = 10000;  // microseconds
/// Exit codes of the reading process.
enum Ending { done_reading = 0, failed_to_send = 3, out_of_memory = 4 };
/// What stands first in the pipe.
enum Answer : std::uint8_t { error_follows = 0, value_follows = 1 };

// A signal handler can reach nothing else.
std::size_t memory_limit = 0;
std::size_t page_bytes = 4096;

/// Memory that this process occupies. Only calls that a signal handler may make; 0 where the
/// system does not tell.
std::size_t occupied_memory() {
    std::array<char, 128> text = {};
    const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0) return 0;
    const ssize_t count = ::read(file, text.data(), text.size() - 1);
    ::close(file);
    if (count <= 0) return 0;
    const char* character = text.data();
    while (*character != ' ' && *character != '\0')
        ++character;
    if (*character == ' ') ++character;
    std::size_t pages = 0;
    for (; *character >= '0' && *character <= '9'; ++character)
        pages = 10 * pages + static_cast<std::size_t>(*character - '0');
    return pages * page_bytes;
}

extern "C" void check_memory(int) {
    if (occupied_memory() > memory_limit) ::_exit(out_of_memory);
}

/// Limits time and memory of this process. The memory is watched by a clock of the process's own
/// time: a limit of the address space would also count what a sanitizer reserves.
void limit_resources(std::size_t file_bytes) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    const rlim_t seconds = seconds_of_any_file + file_bytes / bytes_per_second;
    const rlimit time{seconds, seconds + 1};
    ::setrlimit(RLIMIT_CPU, &time);

    page_bytes = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    memory_limit = occupied_memory() + memory_of_any_file + memory_per_byte * file_bytes;
    struct sigaction action = {};
    action.sa_handler = check_memory;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    ::sigaction(SIGPROF, &action, nullptr);
    const itimerval period{{0, watch_period}, {0, watch_period}};
    ::setitimer(ITIMER_PROF, &period, nullptr);
}

/// The C library and HDF5 print what they find on their way down.
void print_nothing() {
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        ::dup2(nowhere, stream);
}

Contents read_here(const fs::path& path) {
    if (holds_buckling(path)) return read_buckling(path);
    if (holds_torque_drag(path)) return read_torque_drag(path);
    if (holds_modes(path)) return read_modes(path);
    return read_result(path);
}

template <std::size_t index = 0>
Contents receive(Receiver& pipe, std::size_t which) {
    if constexpr (index < std::variant_size_v<Contents>) {
        if (which != index) return receive<index + 1>(pipe, which);
        std::variant_alternative_t<index, Contents> held;
        transfer(pipe, held);
        return held;
    } else {
        throw BrokenPipe();
    }
}

void transfer(Sender& pipe, Contents& contents) {
    pipe.value(contents.index());
    std::visit([&](auto& held) { transfer(pipe, held); }, contents);
}

void transfer(Receiver& pipe, Contents& contents) {
    std::size_t which = 0;
    pipe.value(which);
    contents = receive(pipe, which);
}

/// Reads a file and writes what it found, or why it did not, into a pipe.
template <class Value>
void read_and_send(Value (*read)(const fs::path&), const fs::path& path, Sender& pipe) {
    try {
        Value value = read(path);
        pipe.value(static_cast<std::uint8_t>(value_follows));
        transfer(pipe, value);
    } catch (const BrokenPipe&) {
        throw;
    } catch (const std::exception& error) {
        pipe.value(static_cast<std::uint8_t>(error_follows));
        pipe.list(std::string(error.what()));
    }
    pipe.flush();
}

/// The life of the reading process.
template <class Value>
[[noreturn]] void live(Value (*read)(const fs::path&), const fs::path& path, std::size_t file_bytes,
                       int pipe) {
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    print_nothing();
    limit_resources(file_bytes);
    Sender sender(pipe);
    try {
        read_and_send(read, path, sender);
    } catch (...) {
        ::_exit(failed_to_send);
    }
    ::_exit(done_reading);
}

/// A process that reads, and this process's end of the pipe to it.
class Reader {
  public:
    template <class Value>
    Reader(Value (*read)(const fs::path&), const fs::path& path, std::size_t file_bytes) {
        std::array<int, 2> ends = {};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse("make a pipe");
        std::fflush(nullptr);  // or the child could print it once more
        child_ = ::fork();
        if (child_ == 0) live(read, path, file_bytes, ends[1]);
        const int error = errno;
        ::close(ends[1]);
        pipe_ = ends[0];
        if (child_ > 0) return;
        ::close(pipe_);
        errno = error;
        refuse("start a process");
    }
    ~Reader() {
        ::close(pipe_);
        static_cast<void>(end());
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    [[nodiscard]] int pipe() const { return pipe_; }

    /// Waits for it, and says how it ended as waitpid() does.
    int end() {
        if (child_ > 0)
            while (::waitpid(child_, &status_, 0) < 0 && errno == EINTR) {
            }
        child_ = 0;
        return status_;
    }

  private:
    [[noreturn]] static void refuse(const char* what) {
        throw std::runtime_error(std::string("cannot ") + what +
                                 " to read a file: " + std::generic_category().message(errno));
    }

    pid_t child_ = 0;
    int pipe_ = -1;
    int status_ = 0;
};

/// Why the process that read ended without an answer.
std::string cause_of(int status) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return "reading it takes longer than a sound file of its size would";
    if (WIFEXITED(status) && WEXITSTATUS(status) == out_of_memory)
        return "reading it takes more memory than a sound file of its size would";
    return "damaged, so that HDF5's library fails on it";
}

std::size_t size_of(const fs::path& path) {
    std::error_code ignored;
    const std::uintmax_t bytes = fs::file_size(path, ignored);
    return ignored ? 0 : static_cast<std::size_t>(bytes);
}

/// What `read` finds in a file, called in a process of its own.
template <class Value>
Value call_apart(Value (*read)(const fs::path&), const fs::path& path) {
    Reader reader(read, path, size_of(path));
    Receiver pipe(reader.pipe());
    std::string error;
    try {
        std::uint8_t answer = error_follows;
        pipe.value(answer);
        if (answer == value_follows) {
            Value value{};
            transfer(pipe, value);
            return value;
        }
        pipe.list(error);
    } catch (const BrokenPipe&) {
        error = path.string() + ": cannot read: " + cause_of(reader.end());
    }
    throw ResultError(error);
}

}  // namespace

Contents read_apart(const fs::path& path) {
    return call_apart(read_here, path);
}

Checkpoint read_checkpoint_apart(const fs::path& path) {
    return call_apart(read_checkpoint, path);
}

bool is_own_result_apart(const fs::path& path) {
    try {
        return call_apart(is_own_result, path);
    } catch (const ResultError&) {
        return false;
    }
}

std::optional<std::string_view> other_than_run(const Contents& contents) {
    if (std::holds_alternative<BucklingResult>(contents)) return "buckling modes";
    if (std::holds_alternative<TorqueDragResult>(contents)) return "torque and drag";
    if (std::holds_alternative<ModesResult>(contents)) return "modes of vibration";
    return std::nullopt;
}

}  // namespace drillstrand::program
