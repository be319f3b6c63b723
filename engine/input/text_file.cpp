#include "input/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <string_view>
#include <system_error>

#include "input/wording.hpp"

namespace drillstrand {

namespace {

constexpr std::size_t largest_file = std::size_t{64} << 20U;  // bytes

/// An open file, closed with the object.
class Descriptor {
  public:
    /// Never waits: not for somebody to write into a named pipe either.
    explicit Descriptor(const std::filesystem::path& path)
        : number_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    [[nodiscard]] int number() const { return number_; }

  private:
    int number_;
};

std::string reason(int error) {
    return std::generic_category().message(error);
}

/// What is no regular file, in words; empty for regular ones.
std::string_view other_kind(mode_t mode) {
    if (S_ISREG(mode)) return "";
    if (S_ISDIR(mode)) return "a directory";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, const SourceLocation& asked_at) {
    const auto fail = [&](const std::string& why) -> void {
        throw InputError(asked_at,
                         fmt::format("cannot read {}: {}", in_quotes(path.string()), why));
    };
    const auto check = [&](int result, const struct stat& status) {
        if (result != 0)
            fail(fmt::format("{}; expected an existing, readable file", reason(errno)));
        const std::string_view kind = other_kind(status.st_mode);
        if (!kind.empty()) fail(fmt::format("it is {}; expected a file", kind));
        if (status.st_size > static_cast<off_t>(largest_file))
            fail("larger than 64 MiB; expected a text file");
    };
    // A name with a zero byte would open the file named by what stands before it.
    if (path.native().find('\0') != std::string::npos) fail("no such file name");
    struct stat status {};
    // before opening, which alone can start a device; after it, as the name may change hands
    check(::stat(path.c_str(), &status), status);
    const Descriptor file(path);
    check(file.number() < 0 ? -1 : ::fstat(file.number(), &status), status);

    std::string text;
    std::array<char, 65536> buffer{};
    for (;;) {
        const ssize_t count = ::read(file.number(), buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(reason(errno));
        if (count <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(count));
        // files of the system state no size
        if (text.size() > largest_file) fail("larger than 64 MiB; expected a text file");
    }
}

}  // namespace drillstrand
